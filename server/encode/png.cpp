// libpng reports errors by longjmp: every object with a destructor is made before setjmp, none between it and the jump.
#include "encode/png.h"

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <string>

#include <png.h>

#include "base/error.h"

namespace radiata::encode {
namespace {

constexpr int kLevel = 1;
constexpr png_uint_32 kSideMax = 1U << 20;

struct Sink {
    std::vector<std::uint8_t> bytes;
    std::string failure;
};

struct Source {
    std::span<const std::uint8_t> bytes;
    std::size_t offset = 0;
    std::string failure;
};

template <typename State>
void onError(png_structp png, png_const_charp message) {
    auto* state = static_cast<State*>(png_get_error_ptr(png));
    try {
        state->failure = message;
    } catch (...) {  // without memory for it the message stays empty
    }
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onWrite(png_structp png, png_bytep data, png_size_t size) {
    auto* sink = static_cast<Sink*>(png_get_io_ptr(png));
    bool stored = true;
    try {
        sink->bytes.insert(sink->bytes.end(), data, data + size);
    } catch (...) {
        stored = false;
    }
    if (!stored) png_error(png, "out of memory");
}

void onFlush(png_structp) {}

void onRead(png_structp png, png_bytep data, png_size_t size) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (size > source->bytes.size() - source->offset) png_error(png, "the data ends too early");
    std::memcpy(data, source->bytes.data() + source->offset, size);
    source->offset += size;
}

bool write(png_structp png, png_infop info, const PictureView& picture, Sink& sink) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &sink, onWrite, onFlush);
    png_set_compression_level(png, kLevel);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);
    for (int y = 0; y < picture.height; ++y) {
        png_write_row(png, picture.rgba.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) * 4);
    }
    png_write_end(png, info);
    return true;
}

/// Size and transformations; after it rows come as RGBA.
bool readHeader(png_structp png, png_infop info, Source& source, Picture& picture, int& passes) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_read_fn(png, &source, onRead);
    png_set_user_limits(png, kSideMax, kSideMax);
    png_read_info(png, info);
    const png_uint_32 width = png_get_image_width(png, info);
    const png_uint_32 height = png_get_image_height(png, info);
    if (static_cast<std::uint64_t>(width) * height > kPixelsMax) png_error(png, "the header claims too many pixels");
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) != static_cast<std::size_t>(width) * 4) png_error(png, "unknown kind of pixels");
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    return true;
}

bool readRows(png_structp png, Picture& picture, int passes) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    for (int pass = 0; pass < passes; ++pass) {
        for (int y = 0; y < picture.height; ++y) {
            png_read_row(png, picture.rgba.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) * 4,
                         nullptr);
        }
    }
    png_read_end(png, nullptr);
    return true;
}

struct Writer {
    png_structp png = nullptr;
    png_infop info = nullptr;
    explicit Writer(Sink& sink) : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, onError<Sink>, onWarning)) {
        if (png) info = png_create_info_struct(png);
    }
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

struct Reader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    explicit Reader(Source& source) : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, onError<Source>, onWarning)) {
        if (png) info = png_create_info_struct(png);
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

}  // namespace

std::vector<std::uint8_t> encodePng(const PictureView& picture) {
    check(picture);
    Sink sink;
    sink.bytes.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) / 2 + 1024);
    Writer writer(sink);
    if (!writer.info || !write(writer.png, writer.info, picture, sink)) {
        throw Error(Code::kResourceExhausted, "PNG encoder: " + (sink.failure.empty() ? "out of memory" : sink.failure));
    }
    return std::move(sink.bytes);
}

Picture decodePng(std::span<const std::uint8_t> bytes) {
    Source source{bytes, 0, {}};
    Picture picture;
    int passes = 0;
    Reader reader(source);
    if (!reader.info || !readHeader(reader.png, reader.info, source, picture, passes)) {
        throw Error(Code::kCorrupt, "PNG: the header is not valid: " + source.failure);
    }
    picture.rgba.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4);
    if (!readRows(reader.png, picture, passes)) throw Error(Code::kCorrupt, "PNG: the data is not valid: " + source.failure);
    return picture;
}

}  // namespace radiata::encode
