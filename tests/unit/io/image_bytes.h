// Image files put together byte by byte, sharing no code with the readers: any data type, byte order, axis order and lie.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace radiata::test {

/// A folder of its own that is removed with everything in it.
class TempFolder {
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    /// Writes a file and returns where it is.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const;

private:
    std::filesystem::path path_;
};

/// Numbers as stored bytes. \param type  int8 ... uint64, float32, float64, float128 or bit (highest bit first)
std::string encode(const std::vector<double>& values, const std::string& type, bool big_endian);
/// NIfTI's number for a type of encode(); 0 for bit.
int niftiDatatype(const std::string& type);

std::string gzip(std::string_view bytes);

struct NiftiFile {
    int version = 1;
    bool big_endian = false;
    std::vector<std::int64_t> dim{1, 1, 1, 1};  ///< lengths of the axes
    int dim0 = -1;                              ///< -1: dim.size()
    int datatype = 16;
    int bitpix = 32;
    std::array<double, 8> pixdim{1, 1, 1, 1, 1, 1, 1, 1};
    double vox_offset = -1;  ///< -1: the right one
    double slope = 1, intercept = 0;
    int qform_code = 0, sform_code = 1;
    std::array<double, 6> quatern{};  ///< b, c, d, offset x, y, z
    std::array<double, 12> srow{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    std::string magic;  ///< empty: the right one
    std::string data;   ///< after the header and four zero bytes
};
std::string bytes(const NiftiFile& file);

struct MrtrixFile {
    std::string first_line = "mrtrix image";
    std::vector<std::pair<std::string, std::string>> lines;  ///< without "file"
    std::string data;
};
/// dim, vox (1 mm), layout, datatype, transform (identity) of a sound image
MrtrixFile mrtrixFile(const std::vector<std::int64_t>& dim, const std::string& layout, const std::string& datatype);
/// Sets or replaces the value of a key; an empty value removes it.
void set(MrtrixFile& file, const std::string& key, const std::string& value);
std::string mifBytes(const MrtrixFile& file);
std::string mihText(const MrtrixFile& file, const std::string& data_entry);

/// Values in the order of a layout such as "-0,+2,+3,+1" from a function of the four voxel indices.
std::vector<double> inLayout(const std::array<std::int64_t, 4>& dim, const std::string& layout,
                             const std::function<double(std::int64_t, std::int64_t, std::int64_t, std::int64_t)>& value);

}  // namespace radiata::test
