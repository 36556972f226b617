#include "io/sample_type.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "base/error.h"

namespace radiata::io {
namespace {

/// IEEE binary16: sign, 5 bits of exponent, 10 of fraction.
struct Half {
    std::uint16_t bits = 0;

    explicit operator float() const {
        const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
        float value = exponent == 0 ? std::ldexp(static_cast<float>(fraction), -24)
                                    : std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
        if (exponent == 31) {
            value = fraction == 0 ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
        }
        return (bits & 0x8000) != 0 ? -value : value;
    }
    explicit operator double() const { return static_cast<float>(*this); }
};

template <typename Stored, bool kSwapped>
Stored load(const std::byte* at) {
    Stored value;
    if constexpr (kSwapped && sizeof(Stored) > 1) {
        std::array<std::byte, sizeof(Stored)> turned;
        std::reverse_copy(at, at + sizeof(Stored), turned.begin());
        std::memcpy(&value, turned.data(), sizeof(Stored));
    } else {
        std::memcpy(&value, at, sizeof(Stored));
    }
    return value;
}

template <typename Stored, bool kSwapped>
void decodeOrdered(double slope, double intercept, const std::byte* bytes, std::span<float> out) {
    if (slope == 1 && intercept == 0) {
        for (float& value : out) {
            value = static_cast<float>(load<Stored, kSwapped>(bytes));
            bytes += sizeof(Stored);
        }
        return;
    }
    for (float& value : out) {
        value = static_cast<float>(static_cast<double>(load<Stored, kSwapped>(bytes)) * slope + intercept);
        bytes += sizeof(Stored);
    }
}

template <typename Stored>
void decodeAs(bool swapped, double slope, double intercept, const std::byte* bytes, std::span<float> out) {
    if (swapped) {
        decodeOrdered<Stored, true>(slope, intercept, bytes, out);
    } else {
        decodeOrdered<Stored, false>(slope, intercept, bytes, out);
    }
}

void decodeBits(double slope, double intercept, const std::byte* bytes, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool set = (bytes[i / 8] & (std::byte{0x80} >> (i % 8))) != std::byte{0};
        out[i] = static_cast<float>((set ? slope : 0.0) + intercept);
    }
}

}  // namespace

std::uint64_t bitsOf(SampleType type) {
    switch (type) {
        case SampleType::kBit:
            return 1;
        case SampleType::kInt8:
        case SampleType::kUInt8:
            return 8;
        case SampleType::kInt16:
        case SampleType::kUInt16:
        case SampleType::kFloat16:
            return 16;
        case SampleType::kInt32:
        case SampleType::kUInt32:
        case SampleType::kFloat32:
            return 32;
        case SampleType::kInt64:
        case SampleType::kUInt64:
        case SampleType::kFloat64:
            return 64;
        case SampleType::kFloat128:
            return 128;
    }
    return 0;
}

void decodeSamples(SampleType type, bool swapped, double slope, double intercept, std::span<const std::byte> bytes,
                   std::span<float> out) {
    if (bytes.size() < (out.size() * bitsOf(type) + 7) / 8) {
        throw Error(Code::kInternal,
                    "decodeSamples: " + std::to_string(bytes.size()) + " bytes for " + std::to_string(out.size()) + " numbers");
    }
    const std::byte* data = bytes.data();
    switch (type) {
        case SampleType::kBit:
            return decodeBits(slope, intercept, data, out);
        case SampleType::kInt8:
            return decodeAs<std::int8_t>(swapped, slope, intercept, data, out);
        case SampleType::kUInt8:
            return decodeAs<std::uint8_t>(swapped, slope, intercept, data, out);
        case SampleType::kInt16:
            return decodeAs<std::int16_t>(swapped, slope, intercept, data, out);
        case SampleType::kUInt16:
            return decodeAs<std::uint16_t>(swapped, slope, intercept, data, out);
        case SampleType::kInt32:
            return decodeAs<std::int32_t>(swapped, slope, intercept, data, out);
        case SampleType::kUInt32:
            return decodeAs<std::uint32_t>(swapped, slope, intercept, data, out);
        case SampleType::kInt64:
            return decodeAs<std::int64_t>(swapped, slope, intercept, data, out);
        case SampleType::kUInt64:
            return decodeAs<std::uint64_t>(swapped, slope, intercept, data, out);
        case SampleType::kFloat16:
            return decodeAs<Half>(swapped, slope, intercept, data, out);
        case SampleType::kFloat32:
            return decodeAs<float>(swapped, slope, intercept, data, out);
        case SampleType::kFloat64:
            return decodeAs<double>(swapped, slope, intercept, data, out);
        case SampleType::kFloat128:
            return decodeAs<__float128>(swapped, slope, intercept, data, out);
    }
}

}  // namespace radiata::io
