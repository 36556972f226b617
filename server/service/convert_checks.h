// Small checks that the conversions share.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "base/error.h"

namespace radiata::service {

[[noreturn]] inline void refuse(const std::string& sentence) { throw Error(Code::kInvalidArgument, sentence); }

/// proto3 lets any number through as an enum. \param valid  the generated X_IsValid, \param highest  the generated X_MAX
template <typename Enum>
void checkEnum(Enum value, bool (*valid)(int), Enum highest, const std::string& where) {
    const int number = static_cast<int>(value);
    if (!valid(number)) {
        refuse(where + " is " + std::to_string(number) + ", which this server does not know; 0 to " +
               std::to_string(static_cast<int>(highest)) + " are defined");
    }
}

/// For counts that the model holds as int. \throws Error(kInvalidArgument)
inline int toInt(std::uint32_t value, const std::string& where) {
    if (value > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
        refuse(where + " is " + std::to_string(value) + "; it must be below 2147483648");
    }
    return static_cast<int>(value);
}

}  // namespace radiata::service
