// Encoding one fiblet: codes that keep the decoded points near the given ones. Each direction is aimed from the point that was
// decoded so far to the next given point, so errors do not add up (position feedback). Either the code nearest to each aim is
// taken, or a bounded number of best beginnings is kept and continued (beam search).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "build/fiblet_code.h"

namespace radiata {

/// What one fiblet is to reproduce.
struct FibletTargets {
    std::uint32_t segments = 0;          ///< up to FIBLET_SEGMENTS
    std::array<glm::vec3, 64> points{};  ///< segments + 1, mm, relative to the place that point 0 will be decoded to
    float last_length_mm = 0;            ///< of the last segment
};

/// One way to encode it.
struct FibletPiece {
    std::uint32_t width_choice = 0, cap = 0;
    glm::ivec2 direction{0};
    std::array<std::uint16_t, 62> codes{};
    float max_error_mm = 0;
    double sum_error_mm = 0;  ///< over points 0 to segments
};

/// The turns of all codes of up to 8 bits under every cap of a codec.
class CodeTables {
public:
    /// \param bound_mm  the search avoids distances above three quarters of it
    CodeTables(const shader::FibletCodec& codec, float bound_mm);

    struct Table {
        std::vector<Turn> turns;
        std::vector<float> x, y, z;  ///< where a step after the turn leads, mm, in the frame before it
    };
    const Table& table(std::uint32_t width_choice, std::uint32_t cap) const {
        return tables_[width_choice * shader::FIBLET_CAPS + cap];
    }
    const shader::FibletCodec& codec() const { return codec_; }
    /// What a distance costs in the search, from its square.
    float cost(float square) const { return square + 8 * std::max(square - dear_, 0.0F); }
    /// The cap under which codes of a width did best where the largest turn is this: smaller than the turn, because a turn that
    /// is missed is made up for by the next ones, while a wider cap is coarser everywhere (measured: `radiata-lab
    /// fiblet-codec`). \param turn  rad
    std::uint32_t bestCap(float turn, std::uint32_t width_choice, bool search) const;

private:
    float dear_;
    shader::FibletCodec codec_;
    std::vector<Table> tables_;
};

/// With codes of one width under one cap, each the nearest to its aim.
FibletPiece encodeGreedy(const FibletTargets& targets, std::uint32_t width_choice, std::uint32_t cap, const CodeTables& tables);

inline constexpr std::uint32_t kBeamUsual = 8, kBeamMax = 64;

/// The same with a search that keeps the `beam` best beginnings, by the sum of the squared distances.
/// \param beam  1 to kBeamMax
FibletPiece encodeBeam(const FibletTargets& targets, std::uint32_t width_choice, std::uint32_t cap, const CodeTables& tables,
                       std::uint32_t beam);

}  // namespace radiata
