#include "encode/picture.h"

#include <string>

#include "base/error.h"

namespace radiata::encode {

void check(const PictureView& picture) {
    const std::string size = std::to_string(picture.width) + "x" + std::to_string(picture.height);
    if (picture.width < 1 || picture.height < 1) {
        throw Error(Code::kInvalidArgument, "picture to encode: size is " + size + "; both sides must be at least 1");
    }
    const std::uint64_t pixels = static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height);
    if (pixels > kPixelsMax) {
        throw Error(Code::kInvalidArgument,
                    "picture to encode: size is " + size + "; at most " + std::to_string(kPixelsMax) + " pixels are encoded");
    }
    if (picture.rgba.size() != pixels * 4) {
        throw Error(Code::kInvalidArgument, "picture to encode: " + std::to_string(picture.rgba.size()) + " bytes for " + size +
                                                " pixels; 4 bytes a pixel are needed");
    }
}

}  // namespace radiata::encode
