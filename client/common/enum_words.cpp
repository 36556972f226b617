#include "common/enum_words.h"

#include <cctype>

namespace radiata::client {

std::string enumWord(const google::protobuf::EnumValueDescriptor& value) {
    // "NegativeLobes" -> "NEGATIVE_LOBES_", the prefix that the style of the contract gives every value.
    std::string prefix;
    for (const char c : value.type()->name()) {
        if (std::isupper(static_cast<unsigned char>(c)) && !prefix.empty()) prefix += '_';
        prefix += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    prefix += '_';
    std::string word = value.name().starts_with(prefix) ? value.name().substr(prefix.size()) : value.name();
    for (char& c : word) c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word;
}

}  // namespace radiata::client
