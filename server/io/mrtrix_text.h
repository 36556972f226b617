// The "key: value" lines of an MRtrix image header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace radiata::io {

class MrtrixText {
public:
    /// Reads "mrtrix image" and the lines up to END (or, in a .mih file, to its end); at most 16 MiB of them.
    /// \throws Error(kCorrupt) if the first line is another, END is missing in a .mif file, or a line is no "key: value"
    explicit MrtrixText(const std::filesystem::path& path);

    bool has(const std::string& key) const { return values_.contains(key); }
    /// The value of a key that must be there exactly once. \throws Error(kCorrupt)
    const std::string& only(const std::string& key) const;
    /// All numbers of a key, its lines joined; NaN and infinity are numbers here. \throws Error(kCorrupt) naming the text
    std::vector<double> numbers(const std::string& key) const;
    /// \throws Error(kCorrupt) naming key and text
    std::int64_t integer(const std::string& key, std::string_view text) const;

    /// The file's name for messages.
    const std::string& file() const { return file_; }
    /// Length of the header with its END line.
    std::uint64_t bytes() const { return bytes_; }

private:
    void parse(std::string_view text);

    std::string file_;
    std::uint64_t bytes_ = 0;
    std::map<std::string, std::vector<std::string>> values_;
};

}  // namespace radiata::io
