// Arithmetic on sizes that come from files and requests: checked before any memory is taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error.h"

namespace radiata {

/// a * b. \throws Error(kResourceExhausted) naming `what` if it does not fit 64 bits.
inline std::uint64_t checkedMultiply(std::uint64_t a, std::uint64_t b, const std::string& what) {
    std::uint64_t product = 0;
    if (__builtin_mul_overflow(a, b, &product)) {
        throw Error(Code::kResourceExhausted,
                    what + ": " + std::to_string(a) + " times " + std::to_string(b) + " does not fit 64 bits");
    }
    return product;
}

/// a + b. \throws Error(kResourceExhausted) naming `what` if it does not fit 64 bits.
inline std::uint64_t checkedAdd(std::uint64_t a, std::uint64_t b, const std::string& what) {
    std::uint64_t sum = 0;
    if (__builtin_add_overflow(a, b, &sum)) {
        throw Error(Code::kResourceExhausted,
                    what + ": " + std::to_string(a) + " plus " + std::to_string(b) + " does not fit 64 bits");
    }
    return sum;
}

}  // namespace radiata
