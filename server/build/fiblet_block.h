// Encoding of whole fibres, cut into fiblets, with a codec that is settled.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "build/fiblet_encode.h"
#include "build/fiblet_pages.h"
#include "build/fiblet_piece.h"

namespace radiata {

/// Some consecutive fibres, encoded.
struct FibletBlock {
    std::vector<LooseFiblet> fiblets;
    std::vector<std::uint32_t> heap;
    double max_error_mm = 0;
    /// Sum of the errors in whole nanometres (of each fiblet), so that it does not depend on who adds up what first.
    std::uint64_t sum_error_nm = 0;
    std::uint64_t points = 0, measured = 0;
    /// For each point column: ranges and values as in model::PointColumn.
    std::vector<std::vector<glm::vec2>> ranges;
    std::vector<std::vector<std::uint8_t>> values;

    void append(const FibletBlock& block);
    model::FibletErrors errors() const;
};

/// Thread-safe.
class FibletEncoder {
public:
    FibletEncoder(const FibletPlan& plan, const FibletOptions& options);

    /// \param points  of the fibre, constant steps but for the last; not empty
    /// \param values  for each point column points.size() numbers
    /// \throws UnheldBound naming the fibre
    void encode(std::span<const glm::vec3> points, std::span<const std::vector<float>> values, std::uint64_t number,
                FibletBlock& block) const;

private:
    void encodePart(std::span<const glm::vec3> points, model::FibletParts& parts, FibletBlock& block) const;
    FibletPiece choose(const FibletTargets& targets, std::uint64_t fibre) const;
    /// Replaces the piece by the first that holds the bound, or else by the best of all that were tried.
    void search(const FibletTargets& targets, float turn, std::uint32_t beam, FibletPiece& best) const;
    void searchAllCaps(const FibletTargets& targets, std::uint32_t beam, FibletPiece& best) const;
    void put(const FibletPiece& piece, const FibletTargets& targets, std::uint32_t tail, model::FibletParts& parts,
             FibletBlock& block) const;

    CodeTables tables_;
    glm::dvec3 origin_mm_;
    FibletOptions options_;
    std::string source_;
    float bound_mm_;
    bool walked_;
};

}  // namespace radiata
