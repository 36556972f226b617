#include "service/view_ids.h"

#include <array>
#include <random>

#include "base/error.h"

namespace radiata::service {

std::string ViewIds::add(std::uint64_t view) {
    constexpr std::array<char, 17> kDigits = {"0123456789abcdef"};
    std::random_device random;
    std::string id;
    while (id.size() < 32) {
        std::uint32_t bits = random();
        for (int i = 0; i < 8; ++i, bits >>= 4) id += kDigits[bits & 15];
    }
    std::lock_guard lock(mutex_);
    views_[id] = view;
    return id;
}

void ViewIds::remove(const std::string& id) {
    std::lock_guard lock(mutex_);
    views_.erase(id);
}

std::uint64_t ViewIds::find(const std::string& id) const {
    std::lock_guard lock(mutex_);
    const auto found = views_.find(id);
    if (found == views_.end()) {
        // What was asked for is not repeated: it may be a near miss of somebody else's name, and ends up in logs.
        throw Error(Code::kNotFound, "view_id: no open view has this id of " + std::to_string(id.size()) +
                                         " characters; it was closed or the server restarted, open a new one");
    }
    return found->second;
}

}  // namespace radiata::service
