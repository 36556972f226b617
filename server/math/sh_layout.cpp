#include "math/sh_layout.h"

namespace radiata {

std::optional<ShLayout> shLayoutOfCount(std::size_t count, std::optional<bool> full) {
    if (!full.value_or(false)) {
        for (int lmax = 0; lmax <= kLmaxLimit; lmax += 2) {
            if (ShLayout layout{lmax, false}; layout.count() == count) return layout;
        }
    }
    if (full.value_or(true)) {
        for (int lmax = 0; lmax <= kLmaxLimit; ++lmax) {
            if (ShLayout layout{lmax, true}; layout.count() == count) return layout;
        }
    }
    return std::nullopt;
}

}  // namespace radiata
