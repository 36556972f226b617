#include "encode/jpeg.h"

#include <memory>
#include <string>

#include <turbojpeg.h>

#include "base/error.h"

namespace radiata::encode {
namespace {

struct HandleDeleter {
    void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, HandleDeleter>;

struct BufferDeleter {
    void operator()(unsigned char* buffer) const { tjFree(buffer); }
};

Handle checked(tjhandle handle) {
    if (!handle) throw Error(Code::kInternal, std::string("TurboJPEG does not start: ") + tjGetErrorStr2(nullptr));
    return Handle(handle);
}

}  // namespace

std::vector<std::uint8_t> encodeJpeg(const PictureView& picture, int quality) {
    check(picture);
    if (quality < 1 || quality > 100) {
        throw Error(Code::kInvalidArgument, "JPEG quality is " + std::to_string(quality) + "; it must be 1 to 100");
    }
    const Handle handle = checked(tjInitCompress());
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    const int failed = tjCompress2(handle.get(), picture.rgba.data(), picture.width, 0, picture.height, TJPF_RGBA, &bytes,
                                   &size, TJSAMP_444, quality, 0);
    const std::unique_ptr<unsigned char, BufferDeleter> owner(bytes);
    if (failed != 0) throw Error(Code::kInvalidArgument, std::string("JPEG encoder: ") + tjGetErrorStr2(handle.get()));
    return {bytes, bytes + size};
}

Picture decodeJpeg(std::span<const std::uint8_t> bytes) {
    const Handle handle = checked(tjInitDecompress());
    Picture picture;
    int subsampling = 0;
    int colorspace = 0;
    if (tjDecompressHeader3(handle.get(), bytes.data(), bytes.size(), &picture.width, &picture.height, &subsampling,
                            &colorspace) != 0) {
        throw Error(Code::kCorrupt, std::string("JPEG: the header is not valid: ") + tjGetErrorStr2(handle.get()));
    }
    const std::uint64_t pixels = static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height);
    if (picture.width < 1 || picture.height < 1 || pixels > kPixelsMax) {
        throw Error(Code::kCorrupt, "JPEG: the header says " + std::to_string(picture.width) + "x" +
                                        std::to_string(picture.height) + " pixels; at most " + std::to_string(kPixelsMax) +
                                        " are decoded");
    }
    picture.rgba.resize(pixels * 4);
    if (tjDecompress2(handle.get(), bytes.data(), bytes.size(), picture.rgba.data(), picture.width, 0, picture.height,
                      TJPF_RGBA, 0) != 0) {
        throw Error(Code::kCorrupt, std::string("JPEG: the data is not valid: ") + tjGetErrorStr2(handle.get()));
    }
    return picture;
}

}  // namespace radiata::encode
