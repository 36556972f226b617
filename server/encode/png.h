// PNG for pictures at rest: lossless, 8 bits RGB, marked sRGB. Filter and level are chosen for speed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "encode/picture.h"

namespace radiata::encode {

/// Alpha is dropped. The same pixels give the same bytes. \throws Error(kInvalidArgument) for a malformed picture
std::vector<std::uint8_t> encodePng(const PictureView& picture);

/// Any PNG, brought to 8-bit RGBA. \throws Error(kCorrupt) if the bytes are no PNG, are cut off, or claim more than kPixelsMax
Picture decodePng(std::span<const std::uint8_t> bytes);

}  // namespace radiata::encode
