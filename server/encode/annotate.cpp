#include "encode/annotate.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <ft2build.h>
#include FT_FREETYPE_H

#include "base/error.h"

namespace radiata::encode {
namespace {

constexpr int kSideMin = 48;  // px; smaller pictures get no marks
constexpr double kTextHeight = 1.0 / 42;
constexpr int kBarSideMin = 160;  // px; smaller pictures get no legend
constexpr int kTextMin = 10;      // px
constexpr double kLineSpacing = 1.3;

struct Rect {
    int left, top, right, bottom;
    bool overlaps(const Rect& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

/// Coverage of a line of text, 0 to 255.
struct Mask {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> coverage;
    std::uint8_t& at(int x, int y) { return coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x]; }
    std::uint8_t at(int x, int y) const { return coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x]; }
};

Mask emptyMask(int width, int height) {
    Mask mask{width, height, {}};
    mask.coverage.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return mask;
}

/// Largest coverage within a disc: the outline is what the text covers when it is drawn this much fatter.
Mask dilate(const Mask& mask, int radius) {
    Mask fat = emptyMask(mask.width, mask.height);
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            const std::uint8_t value = mask.at(x, y);
            if (value == 0) continue;
            for (int dy = -radius; dy <= radius; ++dy) {
                for (int dx = -radius; dx <= radius; ++dx) {
                    const int u = x + dx;
                    const int v = y + dy;
                    if (dx * dx + dy * dy > radius * radius + radius || u < 0 || v < 0 || u >= mask.width || v >= mask.height) {
                        continue;
                    }
                    fat.at(u, v) = std::max(fat.at(u, v), value);
                }
            }
        }
    }
    return fat;
}

void blend(Picture& picture, const Mask& mask, int left, int top, int color) {
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            const int alpha = mask.at(x, y);
            if (alpha == 0) continue;
            std::uint8_t* pixel =
                picture.rgba.data() + (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(picture.width) +
                                       static_cast<std::size_t>(left + x)) *
                                          4;
            for (int c = 0; c < 3; ++c) {
                pixel[c] = static_cast<std::uint8_t>((pixel[c] * (255 - alpha) + color * alpha + 127) / 255);
            }
        }
    }
}

/// First pixel of a box of this extent whose start, middle or end lies at the anchor, `margin` inside the picture's edge.
int place(float anchor, model::MarkAlign align, int extent, int side, int margin) {
    const double position = margin + static_cast<double>(anchor) * (side - 2 * margin);
    if (align == model::MarkAlign::kStart) return static_cast<int>(std::lround(position));
    if (align == model::MarkAlign::kEnd) return static_cast<int>(std::lround(position)) - extent;
    return static_cast<int>(std::lround(position - extent / 2.0));
}

int textSize(const Picture& picture) { return std::max(kTextMin, static_cast<int>(std::lround(picture.height * kTextHeight))); }

/// The table from bottom to top in a dark frame one pixel wide.
void fillBar(Picture& picture, const ColourTable& table, const Rect& box) {
    for (int y = box.top; y < box.bottom; ++y) {
        const int entry = 255 * (box.bottom - 2 - y) / std::max(1, box.bottom - box.top - 3);
        const glm::vec3 colour = table[static_cast<std::size_t>(std::clamp(entry, 0, 255))];
        for (int x = box.left; x < box.right; ++x) {
            const bool frame = y == box.top || y == box.bottom - 1 || x == box.left || x == box.right - 1;
            std::uint8_t* pixel =
                picture.rgba.data() +
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)) * 4;
            for (int c = 0; c < 3; ++c) pixel[c] = frame ? 0 : static_cast<std::uint8_t>(std::lround(255 * colour[c]));
        }
    }
}

}  // namespace

struct Annotator::Impl {
    FT_Library library = nullptr;
    FT_Face face = nullptr;
    ~Impl() {
        if (face) FT_Done_Face(face);
        if (library) FT_Done_FreeType(library);
    }

    /// Width of one line of text in 64ths of a pixel.
    long widthOf(const std::string& text) {
        long width = 0;
        for (const char c : text) {
            if (FT_Load_Char(face, static_cast<unsigned char>(c), FT_LOAD_TARGET_LIGHT) == 0) width += face->glyph->advance.x;
        }
        return width;
    }

    /// Lines of whole words that fit into a width; a longer word has a line of its own.
    std::vector<std::string> wrap(const std::string& text, int size_px, int border, int width) {
        FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size_px));
        std::vector<std::string> lines;
        std::istringstream words(text);
        for (std::string word; words >> word;) {
            const std::string longer = lines.empty() ? word : lines.back() + " " + word;
            if (lines.empty() || (widthOf(longer) >> 6) + 1 + 2 * border > width) {
                lines.push_back(word);
            } else {
                lines.back() = longer;
            }
        }
        return lines;
    }

    /// As much of a text's beginning as fits into a width.
    std::string shortened(const std::string& text, int size_px, int border, int width) {
        FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size_px));
        const auto fits = [&](const std::string& part) { return (widthOf(part) >> 6) + 1 + 2 * border <= width; };
        if (fits(text)) return text;
        std::string part = text;
        while (!part.empty() && !fits(part + "..")) part.pop_back();
        return part + "..";
    }

    /// One line of text with `border` empty pixels on each side.
    Mask write(const std::string& text, int size_px, int border) {
        FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size_px));
        const int ascent = static_cast<int>(face->size->metrics.ascender >> 6);
        const int descent = static_cast<int>(-(face->size->metrics.descender >> 6));
        Mask mask = emptyMask(static_cast<int>(widthOf(text) >> 6) + 1 + 2 * border, ascent + descent + 2 * border);
        long pen = 0;
        for (const char c : text) {
            if (FT_Load_Char(face, static_cast<unsigned char>(c), FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) continue;
            const FT_GlyphSlot glyph = face->glyph;
            const int left = border + static_cast<int>(pen >> 6) + glyph->bitmap_left;
            const int top = border + ascent - glyph->bitmap_top;
            for (int y = 0; y < static_cast<int>(glyph->bitmap.rows); ++y) {
                for (int x = 0; x < static_cast<int>(glyph->bitmap.width); ++x) {
                    if (left + x < 0 || top + y < 0 || left + x >= mask.width || top + y >= mask.height) continue;
                    std::uint8_t& value = mask.at(left + x, top + y);
                    value = std::max(value, glyph->bitmap.buffer[y * glyph->bitmap.pitch + x]);
                }
            }
            pen += glyph->advance.x;
        }
        return mask;
    }
};

Annotator::Annotator(const std::filesystem::path& font) : impl_(std::make_unique<Impl>()) {
    if (FT_Init_FreeType(&impl_->library) != 0) throw Error(Code::kInternal, "FreeType does not start");
    if (FT_New_Face(impl_->library, font.c_str(), 0, &impl_->face) != 0) {
        throw Error(Code::kNotFound, "font " + font.string() +
                                         " for the marks is not there or no font; the Debian package "
                                         "fonts-dejavu-core has " +
                                         kDefaultFont);
    }
}

Annotator::~Annotator() = default;
Annotator::Annotator(Annotator&&) noexcept = default;
Annotator& Annotator::operator=(Annotator&&) noexcept = default;

void Annotator::draw(Picture& picture, std::span<const model::Mark> marks) {
    if (picture.width < kSideMin || picture.height < kSideMin) return;
    check(picture);
    const int text_px = textSize(picture);
    const int margin = text_px / 3;
    std::vector<Rect> taken;
    for (const model::Mark& mark : marks) {
        const int size_px = std::max(kTextMin, static_cast<int>(std::lround(static_cast<float>(text_px) * mark.size)));
        const int border = std::max(1, size_px / 10);
        const bool in_block = mark.line > 0;
        int line = mark.line;
        for (const std::string& text :
             in_block ? impl_->wrap(mark.text, size_px, border, picture.width - 2 * margin) : std::vector{mark.text}) {
            const Mask mask = impl_->write(text, size_px, border);
            const int left = place(mark.x, mark.horizontal, mask.width, picture.width, margin);
            if (left < 0 || left + mask.width > picture.width) break;
            // A line of a block moves on until it has room.
            for (bool fits = false; !fits; ++line) {
                const int shift = static_cast<int>(std::lround(line * text_px * kLineSpacing));
                const int top = place(mark.y, mark.vertical, mask.height, picture.height, margin) +
                                (mark.vertical == model::MarkAlign::kEnd ? -shift : shift);
                if (top < 0 || top + mask.height > picture.height) break;
                // Lines of one block may share their borders.
                const Rect core{left + border, top + 2 * border, left + mask.width - border, top + mask.height - 2 * border};
                fits = std::ranges::none_of(taken, [&](const Rect& other) { return core.overlaps(other); });
                if (!fits && !in_block) break;
                if (!fits) continue;
                taken.push_back(core);
                blend(picture, dilate(mask, border), left, top, 0);
                blend(picture, mask, left, top, 255);
            }
        }
    }
}

void Annotator::drawBars(Picture& picture, std::span<const model::ColourBar> bars) {
    if (picture.width < kBarSideMin || picture.height < kBarSideMin) return;
    check(picture);
    const int text_px = textSize(picture);
    const int margin = text_px / 3, border = std::max(1, text_px / 10);
    int right = picture.width - margin;
    for (const model::ColourBar& bar : bars) {
        const std::string name = impl_->shortened(bar.title, text_px, border, right - picture.width / 2);
        const Mask title = impl_->write(name, text_px, border), low = impl_->write(bar.low, text_px, border),
                   high = impl_->write(bar.high, text_px, border);
        const int numbers = std::max(low.width, high.width);
        const int width = std::max(title.width, numbers + text_px);
        if (right - width < picture.width / 2) return;
        const int top = margin + title.height, bottom = top + picture.height / 3;
        fillBar(picture, colourTable(bar.map), {right - text_px, top, right, bottom});
        for (const auto& [mask, left, y] :
             {std::tuple{&title, right - title.width, margin}, std::tuple{&high, right - text_px - high.width, top},
              std::tuple{&low, right - text_px - low.width, bottom - low.height}}) {
            blend(picture, dilate(*mask, border), left, y, 0);
            blend(picture, *mask, left, y, 255);
        }
        right -= width + text_px;
    }
}

}  // namespace radiata::encode
