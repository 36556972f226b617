#include "io/nifti_header.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <nifti2_io.h>

#include "base/error.h"
#include "io/byte_source.h"

namespace radiata::io {
namespace {

/// The fields that both versions have and that are used here, in the types of NIfTI-2.
struct Fields {
    int version = 0;
    bool swapped = false;
    int datatype = 0;
    std::array<std::int64_t, 8> dim{};
    std::array<double, 8> pixdim{};
    double vox_offset = 0;
    double slope = 0, intercept = 0;
    int qform_code = 0, sform_code = 0;
    std::array<double, 3> quaternion{}, qoffset{};
    std::array<std::array<double, 4>, 3> srow{};
};

template <typename Header>
Fields fieldsOf(const Header& header) {
    Fields fields;
    fields.datatype = header.datatype;
    for (std::size_t i = 0; i < 8; ++i) {
        fields.dim[i] = header.dim[i];
        fields.pixdim[i] = header.pixdim[i];
    }
    fields.vox_offset = static_cast<double>(header.vox_offset);
    fields.slope = header.scl_slope;
    fields.intercept = header.scl_inter;
    fields.qform_code = header.qform_code;
    fields.sform_code = header.sform_code;
    fields.quaternion = {header.quatern_b, header.quatern_c, header.quatern_d};
    fields.qoffset = {header.qoffset_x, header.qoffset_y, header.qoffset_z};
    for (std::size_t i = 0; i < 4; ++i) {
        fields.srow[0][i] = header.srow_x[i];
        fields.srow[1][i] = header.srow_y[i];
        fields.srow[2][i] = header.srow_z[i];
    }
    return fields;
}

template <typename Header>
Fields parse(const std::byte* bytes, int version) {
    Header header;
    std::memcpy(&header, bytes, sizeof header);
    const bool swapped = header.sizeof_hdr != static_cast<int>(sizeof header);
    if (swapped) swap_nifti_header(&header, version);
    Fields fields = fieldsOf(header);
    fields.version = version;
    fields.swapped = swapped;
    return fields;
}

Fields readFields(ByteSource& source) {
    // The library's own messages would go to stderr; ours go to whoever asked.
    static const bool kQuiet = (nifti_set_debug_level(0), true);
    static_cast<void>(kQuiet);
    std::array<std::byte, sizeof(nifti_2_header)> bytes{};
    const std::size_t got = source.read(bytes);
    if (got < sizeof(nifti_1_header)) {
        throw Error(Code::kCorrupt, source.name() + ": the file has " + std::to_string(got) +
                                        " bytes; a NIfTI header has 348 (version 1) or 540 (version 2)");
    }
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const int version = nifti_header_version(text, bytes.size());
    if (version == 1 && std::memcmp(text + offsetof(nifti_1_header, magic), "n+1", 4) == 0) {
        return parse<nifti_1_header>(bytes.data(), version);
    }
    if (version == 2 && std::memcmp(text + offsetof(nifti_2_header, magic), "n+2", 4) == 0) {
        if (got < bytes.size()) {
            throw Error(Code::kCorrupt,
                        source.name() + ": the file has " + std::to_string(got) + " bytes; a NIfTI-2 header has 540");
        }
        return parse<nifti_2_header>(bytes.data(), version);
    }
    if (version == 1 || version == 2) {
        throw Error(Code::kUnsupported, source.name() +
                                            ": the header belongs to a pair of files (.hdr and .img); "
                                            "one file with magic n+1 or n+2 is read");
    }
    throw Error(Code::kCorrupt, source.name() +
                                    ": this is no NIfTI file; it must begin with 348 or 540 in either byte order "
                                    "and carry the magic n+1 or n+2");
}

SampleType sampleType(int datatype, const std::string& file) {
    switch (datatype) {
        case DT_INT8:
            return SampleType::kInt8;
        case DT_UINT8:
            return SampleType::kUInt8;
        case DT_INT16:
            return SampleType::kInt16;
        case DT_UINT16:
            return SampleType::kUInt16;
        case DT_INT32:
            return SampleType::kInt32;
        case DT_UINT32:
            return SampleType::kUInt32;
        case DT_INT64:
            return SampleType::kInt64;
        case DT_UINT64:
            return SampleType::kUInt64;
        case DT_FLOAT32:
            return SampleType::kFloat32;
        case DT_FLOAT64:
            return SampleType::kFloat64;
        case DT_FLOAT128:
            return SampleType::kFloat128;
        default:
            break;
    }
    throw Error(Code::kUnsupported, file + ": datatype is " + std::to_string(datatype) + " (" +
                                        nifti_datatype_string(datatype) +
                                        "); integers of 8 to 64 bits and floats of 32, 64 and 128 bits are read");
}

std::uint64_t dataOffset(const Fields& fields, const std::string& file) {
    const double least = fields.version == 1 ? 352 : 544;
    const double offset = fields.vox_offset == 0 ? least : fields.vox_offset;
    if (!(offset >= least && offset <= 9e15) || offset != std::floor(offset)) {
        throw Error(Code::kCorrupt, file + ": vox_offset is " + std::to_string(fields.vox_offset) +
                                        "; it must be a whole number, at least " + std::to_string(static_cast<int>(least)));
    }
    return static_cast<std::uint64_t>(offset);
}

/// Voxel edge along one of the first three axes, for the two methods that need it.
double voxelEdge(const Fields& fields, std::size_t axis, const std::string& file) {
    const bool flat = static_cast<std::int64_t>(axis) > fields.dim[0] || fields.dim[axis] == 1;
    const double edge = std::abs(fields.pixdim[axis]);
    if (flat && !(edge > 0)) return 1;  // one voxel thick: any edge will do, and many writers leave 0
    if (!(edge > 0) || !std::isfinite(edge)) {
        throw Error(Code::kCorrupt, file + ": pixdim[" + std::to_string(axis) + "] is " + std::to_string(fields.pixdim[axis]) +
                                        "; without an sform it must be finite and not 0");
    }
    return edge;
}

glm::dmat4 affine(const Fields& fields, const std::string& file) {
    glm::dmat4 matrix(1.0);
    if (fields.sform_code > 0) {
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 4; ++c) matrix[c][r] = fields.srow[r][c];
        }
        return matrix;
    }
    const glm::dvec3 edge(voxelEdge(fields, 1, file), voxelEdge(fields, 2, file), voxelEdge(fields, 3, file));
    if (fields.qform_code > 0) {
        const auto& [b, c, d] = fields.quaternion;
        if (!(b * b + c * c + d * d <= 1.01)) {
            throw Error(Code::kCorrupt, file + ": quatern_b, c, d are " + std::to_string(b) + ", " + std::to_string(c) + ", " +
                                            std::to_string(d) + "; their squares must not exceed 1 together");
        }
        const nifti_dmat44 turned = nifti_quatern_to_dmat44(b, c, d, fields.qoffset[0], fields.qoffset[1], fields.qoffset[2],
                                                            edge.x, edge.y, edge.z, fields.pixdim[0] < 0 ? -1 : 1);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) matrix[column][row] = turned.m[row][column];
        }
        return matrix;
    }
    for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = edge[axis];
    return matrix;
}

}  // namespace

StoredImage readNiftiHeader(const std::filesystem::path& path) {
    ByteSource source(path);
    const std::string file = source.name();
    const Fields fields = readFields(source);
    if (fields.dim[0] < 1 || fields.dim[0] > 7) {
        throw Error(Code::kCorrupt, file + ": dim[0] is " + std::to_string(fields.dim[0]) + "; it must be 1 to 7");
    }
    StoredImage image;
    const auto axes = fourAxes(std::span(fields.dim).subspan(1, static_cast<std::size_t>(fields.dim[0])), file);
    for (std::size_t axis = 0; axis < 4; ++axis) {
        if (axes[axis] >= 0) image.size[axis] = fields.dim[static_cast<std::size_t>(axes[axis]) + 1];
    }
    image.type = sampleType(fields.datatype, file);
    image.swapped = fields.swapped;
    if (fields.slope != 0 && std::isfinite(fields.slope)) {
        image.slope = fields.slope;
        image.intercept = std::isfinite(fields.intercept) ? fields.intercept : 0;
    }
    image.voxel_to_world = affine(fields, file);
    checkAffine(image.voxel_to_world, file);
    image.data_path = path;
    image.data_offset = dataOffset(fields, file);
    return image;
}

}  // namespace radiata::io
