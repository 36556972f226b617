// Pieces of text that headers of files are made of, and how messages show them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace radiata::io {

/// What separates words in a line.
inline constexpr std::string_view kBlanks = " \t\r";

/// Without the blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Parts of a list separated by commas or blanks, without empty ones.
std::vector<std::string_view> splitList(std::string_view list);

/// Text of a file for a message: in quotes, printable, at most 60 characters.
std::string shown(std::string_view text);

}  // namespace radiata::io
