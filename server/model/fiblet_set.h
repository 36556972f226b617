// A tractogram as fiblets, in memory as on the device and in the file (docs/formats/fiblet.md).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "model/fiblet_head.h"
#include "model/tractogram.h"

namespace radiata::model {

/// Distances between what was encoded and what is decoded, measured by decoding, um.
struct FibletErrors {
    double mean_um = 0, max_um = 0;
    std::uint64_t points = 0;  ///< of how many points
};

/// One number or vector per fibre.
struct FibreColumn {
    std::string name;
    std::uint32_t components = 1;
    std::vector<float> values;  ///< fibres * components
};

/// One number per point, in 254 steps between the smallest and largest of each fiblet; 255 stands for "no value".
struct PointColumn {
    std::string name;
    std::uint32_t component = 0;       ///< of a column of vectors, each component being a PointColumn of its own
    std::vector<glm::vec2> ranges;     ///< per fiblet, in the order of the heads: value of 0 and of 254
    std::vector<std::uint8_t> values;  ///< 64 per fiblet; point i of fiblet f is at 64 f + i
};

/// Where pages of a set can be read again, while it is drawn. Thread-safe.
class FibletPageSource {
public:
    virtual ~FibletPageSource() = default;
    /// Pages that follow each other: all of their heads and all of their codes. \throws Error(kUnavailable, kCorrupt) naming
    /// the page if they cannot be read, or are not those that were read at first
    virtual void read(std::uint32_t first_page, std::uint32_t pages, std::span<FibletHead> heads,
                      std::span<std::uint32_t> codes) const = 0;
};

struct FibletSet {
    shader::FibletCodec codec{};
    glm::dvec3 origin_mm{0};           ///< of the cells and boxes; world mm, RAS
    std::vector<FibletHead> heads;     ///< in Morton order; page p has those from FIBLET_PAGE * p on
    std::vector<std::uint32_t> codes;  ///< page by page; one word more than used, so that a code may be read as two words
    std::vector<shader::FibletPage> pages;
    std::vector<shader::FibletBox> boxes;  ///< one per head
    /// Fiblets of fibre f in order: fibre_fiblets[fibre_first[f]] up to fibre_fiblets[fibre_first[f + 1]] are indices of heads.
    std::vector<std::uint32_t> fibre_first;    ///< fibres + 1
    std::vector<std::uint32_t> fibre_fiblets;  ///< as many as heads
    std::vector<FibreColumn> fibre_columns;
    std::vector<PointColumn> point_columns;
    std::vector<FibreGroup> groups;

    std::uint64_t points = 0;                      ///< that are decoded, each fibre's counted once
    FibletErrors errors;                           ///< of decoded points against the points that were encoded
    bool walked = false;                           ///< the steps varied, so points were set anew along the lines, a step apart
    FibletErrors walk_errors;                      ///< if walked: of the original points against the encoded lines
    double bound_um = 0;                           ///< that was asked for
    std::string source;                            ///< short name for messages
    std::string remarks;                           ///< what was assumed about the input and left out of it, as sentences
    std::shared_ptr<const FibletPageSource> file;  ///< none: the set has no file

    std::uint64_t fibres() const { return fibre_first.empty() ? 0 : fibre_first.size() - 1; }
};

}  // namespace radiata::model
