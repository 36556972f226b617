// The words of an enum of the contract: TRAVERSAL_RAY_QUERY of Traversal is "ray-query". One spelling for options, JSON and
// messages.
#pragma once

#include <map>
#include <string>

#include <google/protobuf/descriptor.h>

namespace radiata::client {

/// The name without the enum's own name before it, in lower case, with hyphens.
std::string enumWord(const google::protobuf::EnumValueDescriptor& value);

/// Word to value for CLI11, without UNSPECIFIED; `unspecified` names that value when the command line has a word for it
/// ("auto").
template <typename Enum>
std::map<std::string, Enum> enumWords(const google::protobuf::EnumDescriptor* type, const std::string& unspecified = "") {
    std::map<std::string, Enum> words;
    for (int i = 0; i < type->value_count(); ++i) {
        const google::protobuf::EnumValueDescriptor& value = *type->value(i);
        const std::string word = value.number() == 0 ? unspecified : enumWord(value);
        if (!word.empty()) words[word] = static_cast<Enum>(value.number());
    }
    return words;
}

}  // namespace radiata::client
