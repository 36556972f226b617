// The lines of a NRRD header: "field: value", "key:=value", "# comment", up to an empty line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::io {

class NrrdText {
public:
    /// \throws Error(kCorrupt) unless it begins with NRRD0001 to NRRD0005 and ends with an empty line (a .nhdr file may end
    /// without
    ///         one), has each field once and is at most 1 MiB long
    explicit NrrdText(const std::filesystem::path& path);

    bool has(const std::string& field) const { return fields_.contains(field); }
    /// Value of a field that must be there. Names are in lower case and without blanks: "spacedirections".
    /// \throws Error(kCorrupt) if it is not
    const std::string& value(const std::string& field) const;
    /// Words of the value, separated by blanks.
    std::vector<std::string_view> words(const std::string& field) const;
    /// \throws Error(kCorrupt) naming field and text
    std::int64_t integer(const std::string& field, std::string_view text) const;
    double number(const std::string& field, std::string_view text) const;
    /// The parts "(x,y,z)" and "none" of a value; NaN for none. \throws Error(kCorrupt)
    std::vector<glm::dvec3> vectors(const std::string& field) const;

    /// The file's name for messages.
    const std::string& file() const { return file_; }
    /// Length of the header with its empty line.
    std::uint64_t bytes() const { return bytes_; }

private:
    void parse(std::string_view text);

    std::string file_;
    std::uint64_t bytes_ = 0;
    std::map<std::string, std::string> fields_;
};

}  // namespace radiata::io
