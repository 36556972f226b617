// NumPy's .npy files, format 1.0: magic, header of text padded to 64 bytes, little-endian data in row-major order.
// Source: NumPy Enhancement Proposal 1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "radiata/v1/frame.pb.h"

namespace radiata::client {

/// \param descr  "<f4" or "<i4"
/// \param shape  product times 4 must be data.size(); the caller has checked it
std::string npyHeader(const std::string& descr, const std::vector<std::uint64_t>& shape);

/// The file's bytes for one output of a frame: float32 or int32 as the contract says.
/// \throws ClientError(kRefused) if the server's array is not of the shape that the contract gives it for this size
std::string npyBytes(const v1::OutputArray& array, std::uint32_t width, std::uint32_t height);

}  // namespace radiata::client
