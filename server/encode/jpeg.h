// JPEG without chroma subsampling: direction-coloured pictures lose 6 dB and more with it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "encode/picture.h"

namespace radiata::encode {

/// 4:4:4 baseline JPEG; alpha is dropped.
/// \param quality  1 to 100
/// \throws Error(kInvalidArgument) for a malformed picture or quality
std::vector<std::uint8_t> encodeJpeg(const PictureView& picture, int quality);

/// \throws Error(kCorrupt) if the bytes are no JPEG, are cut off, or claim more than kPixelsMax
Picture decodeJpeg(std::span<const std::uint8_t> bytes);

}  // namespace radiata::encode
