// How rays meet glyphs. Mirrors IntersectionMethod and its settings in proto/radiata/v1/quality.proto.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace radiata::model {

enum class Intersection {
    kMarch,
    kPoleTable,
    kPolynomial,
    kPolynomialDouble,
    kLaguerre,
    kRayMarchPeeters,
    kRayMarchVanAlmsick,
    kTensorMarch,
    kTensorInterval,
    kTensorAffine,
    kTessellated
};

struct MethodName {
    Intersection method;
    std::string_view name;
};

/// By these names methods are asked for and reported.
constexpr std::array<MethodName, 11> kMethodNames = {{
    {Intersection::kMarch, "march"},
    {Intersection::kPoleTable, "pole-table"},
    {Intersection::kPolynomial, "polynomial"},
    {Intersection::kPolynomialDouble, "polynomial-double"},
    {Intersection::kLaguerre, "laguerre"},
    {Intersection::kRayMarchPeeters, "ray-march-peeters"},
    {Intersection::kRayMarchVanAlmsick, "ray-march-van-almsick"},
    {Intersection::kTensorMarch, "tensor-march"},
    {Intersection::kTensorInterval, "tensor-interval"},
    {Intersection::kTensorAffine, "tensor-affine"},
    {Intersection::kTessellated, "tessellated"},
}};

constexpr std::string_view methodName(Intersection method) {
    for (const MethodName& row : kMethodNames) {
        if (row.method == method) return row.name;
    }
    return "";
}

/// The march, with or without its table.
constexpr bool marches(Intersection method) { return method == Intersection::kMarch || method == Intersection::kPoleTable; }
constexpr bool byPolynomial(Intersection method) {
    return method == Intersection::kPolynomial || method == Intersection::kPolynomialDouble ||
           method == Intersection::kLaguerre;
}
constexpr bool byEqualSteps(Intersection method) {
    return method == Intersection::kRayMarchPeeters || method == Intersection::kRayMarchVanAlmsick;
}

/// Whether the method has a form that finds all hits of a ray; the others stop at the first.
constexpr bool findsAllHits(Intersection method) { return marches(method) || byPolynomial(method); }

struct PolynomialSettings {
    bool bracket_stop = true;  ///< a root is done when its bracket is narrow; false: when a step is short, as in the paper
    /// Bracket: width over max(1, |u|); step: over the bound of all roots; laguerre: of imaginary parts over max(1, |u|).
    /// Absent: see polynomialTolerance().
    std::optional<double> tolerance;
    bool operator==(const PolynomialSettings&) const = default;
};

/// The tolerance in use: 2e-4 for the paper's rule; for brackets 1e-6, in double 1e-12; for laguerre 1e-3.
constexpr double polynomialTolerance(Intersection method, const PolynomialSettings& settings) {
    if (settings.tolerance) return *settings.tolerance;
    if (method == Intersection::kLaguerre) return 1e-3;
    if (!settings.bracket_stop) return 2e-4;
    return method == Intersection::kPolynomialDouble ? 1e-12 : 1e-6;
}

struct RayMarchSettings {
    int steps = 100;                 ///< pieces of the ray within the bounding volume
    std::optional<int> refinements;  ///< absent: see rayMarchRefinements()
    bool operator==(const RayMarchSettings&) const = default;
};

/// 10 bisections (Peeters), 4 steps of regula falsi (van Almsick).
constexpr int rayMarchRefinements(Intersection method, const RayMarchSettings& settings) {
    return settings.refinements.value_or(method == Intersection::kRayMarchPeeters ? 10 : 4);
}

/// Boxes that the traversal visits.
enum class GlyphBoxes {
    kTight,     ///< certified, a few per cent larger than the glyph
    kCylinder,  ///< around van Almsick's cylinder about the z axis, as in Peters et al. 2023, Table 1
};

}  // namespace radiata::model
