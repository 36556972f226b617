#include "io/nifti_write.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

#include <nifti2_io.h>
#include <zlib.h>

#include "base/checked.h"
#include "base/error.h"
#include "io/stored_image.h"

namespace radiata::io {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they lie in memory");

struct CloseFile {
    void operator()(gzFile_s* file) const { gzclose(file); }
};

/// What NIfTI-1 and NIfTI-2 have in common, in the types of whichever it is.
template <typename Header>
Header makeHeader(const Volume& volume, std::size_t data_offset) {
    Header header;
    std::memset(&header, 0, sizeof header);
    header.sizeof_hdr = static_cast<int>(sizeof header);
    header.datatype = DT_FLOAT32;
    header.bitpix = 32;
    const bool several = volume.size[3] > 1;
    header.dim[0] = several ? 4 : 3;
    header.pixdim[0] = 1;
    for (int i = 0; i < 7; ++i) {
        const std::int64_t length = i < 4 ? volume.size[static_cast<std::size_t>(i)] : 1;
        header.dim[i + 1] = static_cast<std::remove_reference_t<decltype(header.dim[0])>>(length);
        header.pixdim[i + 1] = 1;
    }
    using Real = std::remove_reference_t<decltype(header.srow_x[0])>;
    nifti_dmat44 matrix{};
    for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < 4; ++c) matrix.m[r][c] = volume.voxel_to_world[c][r];
    }
    for (int c = 0; c < 4; ++c) {
        header.srow_x[c] = static_cast<Real>(matrix.m[0][c]);
        header.srow_y[c] = static_cast<Real>(matrix.m[1][c]);
        header.srow_z[c] = static_cast<Real>(matrix.m[2][c]);
    }
    double b = 0, c = 0, d = 0, x = 0, y = 0, z = 0, dx = 0, dy = 0, dz = 0, handedness = 1;
    nifti_dmat44_to_quatern(matrix, &b, &c, &d, &x, &y, &z, &dx, &dy, &dz, &handedness);
    header.quatern_b = static_cast<Real>(b);
    header.quatern_c = static_cast<Real>(c);
    header.quatern_d = static_cast<Real>(d);
    header.qoffset_x = static_cast<Real>(x);
    header.qoffset_y = static_cast<Real>(y);
    header.qoffset_z = static_cast<Real>(z);
    header.pixdim[0] = static_cast<Real>(handedness);
    header.pixdim[1] = static_cast<Real>(dx);
    header.pixdim[2] = static_cast<Real>(dy);
    header.pixdim[3] = static_cast<Real>(dz);
    header.qform_code = NIFTI_XFORM_SCANNER_ANAT;
    header.sform_code = NIFTI_XFORM_SCANNER_ANAT;
    header.xyzt_units = NIFTI_UNITS_MM;
    header.vox_offset = static_cast<decltype(header.vox_offset)>(data_offset);
    header.scl_slope = 1;
    std::memcpy(header.magic, sizeof header == 348 ? "n+1" : "n+2\0\r\n\032\n", sizeof header.magic);
    return header;
}

/// Header and the four zero bytes that say "no extensions".
std::string headerBytes(const Volume& volume) {
    const bool second = std::ranges::max(volume.size) > 32767;
    std::string bytes(second ? 544 : 352, '\0');
    if (second) {
        const auto header = makeHeader<nifti_2_header>(volume, bytes.size());
        std::memcpy(bytes.data(), &header, sizeof header);
    } else {
        const auto header = makeHeader<nifti_1_header>(volume, bytes.size());
        std::memcpy(bytes.data(), &header, sizeof header);
    }
    return bytes;
}

void check(const Volume& volume, const std::string& file) {
    std::uint64_t count = 1;
    for (const std::int64_t length : volume.size) {
        if (length < 1) throw Error(Code::kInvalidArgument, file + ": an axis has length " + std::to_string(length));
        count = checkedMultiply(count, static_cast<std::uint64_t>(length), file);
    }
    if (count != volume.data.size()) {
        throw Error(Code::kInvalidArgument, file + ": the size asks for " + std::to_string(count) + " samples, there are " +
                                                std::to_string(volume.data.size()));
    }
    if (!file.ends_with(".nii") && !file.ends_with(".nii.gz")) {
        throw Error(Code::kInvalidArgument, file + ": the name must end in .nii or .nii.gz");
    }
    try {
        checkAffine(volume.voxel_to_world, file);
    } catch (const Error& error) {
        throw Error(Code::kInvalidArgument, error.what());
    }
}

bool write(gzFile_s* file, const char* bytes, std::size_t size) {
    constexpr std::size_t kStep = std::size_t{1} << 24;
    for (std::size_t at = 0; at < size; at += kStep) {
        const auto step = static_cast<unsigned>(std::min(kStep, size - at));
        if (gzwrite(file, bytes + at, step) != static_cast<int>(step)) return false;
    }
    return true;
}

}  // namespace

void writeNifti(const Volume& volume, const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    check(volume, name);
    const std::string header = headerBytes(volume);
    // "T": zlib passes the bytes through as they are.
    std::unique_ptr<gzFile_s, CloseFile> file(gzopen(path.c_str(), path.extension() == ".gz" ? "wb4" : "wbT"));
    if (!file) throw Error(Code::kUnavailable, name + ": cannot be written (" + std::strerror(errno) + ")");
    const bool written =
        write(file.get(), header.data(), header.size()) &&
        write(file.get(), reinterpret_cast<const char*>(volume.data.data()), volume.data.size() * sizeof(float));
    const bool closed = gzclose(file.release()) == Z_OK;
    if (!written || !closed) {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
        throw Error(Code::kUnavailable, name + ": could not be written to its end; the disk may be full");
    }
}

}  // namespace radiata::io
