// How one number of an image is stored, over all formats, and how it becomes a float.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace radiata::io {

enum class SampleType {
    kBit,  ///< eight to the byte, highest bit first (MRtrix)
    kInt8,
    kUInt8,
    kInt16,
    kUInt16,
    kInt32,
    kUInt32,
    kInt64,
    kUInt64,
    kFloat16,  ///< IEEE binary16 (TRX)
    kFloat32,
    kFloat64,
    kFloat128,  ///< IEEE binary128 (NIfTI's FLOAT128)
};

std::uint64_t bitsOf(SampleType type);

/// Decodes numbers to float: value = stored * slope + intercept in double, rounded once; slope 1 and intercept 0 leave a stored
/// float as it is, bit by bit. Values beyond float's range become infinite.
/// \param swapped  the bytes stand in the other order than this machine's
/// \param bytes    out.size() numbers without gaps, from the first byte on
void decodeSamples(SampleType type, bool swapped, double slope, double intercept, std::span<const std::byte> bytes,
                   std::span<float> out);

}  // namespace radiata::io
