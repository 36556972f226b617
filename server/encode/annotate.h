// Writes marks into a picture: light letters with a dark outline, readable on any background.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "encode/picture.h"
#include "model/annotation.h"

namespace radiata::encode {

/// Where Debian's fonts-dejavu-core puts its plain face.
inline constexpr const char* kDefaultFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// One font. Not thread-safe: each thread has its own.
class Annotator {
public:
    /// \throws Error(kNotFound) naming the file if it is no font that FreeType reads
    explicit Annotator(const std::filesystem::path& font = kDefaultFont);
    ~Annotator();
    Annotator(Annotator&&) noexcept;
    Annotator& operator=(Annotator&&) noexcept;

    /// Text is 1/42 of the picture's height, at least 10 pixels. A mark that does not fit into the picture beside those before
    /// it is left out; a picture with a side under 48 pixels gets none.
    void draw(Picture& picture, std::span<const model::Mark> marks);

    /// Draws legends side by side from the upper right corner to the left, each a third of the picture high; those that do not
    /// fit into the right half of it are left out, and so are all in pictures with a side under 160 pixels.
    void drawBars(Picture& picture, std::span<const model::ColourBar> bars);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::encode
