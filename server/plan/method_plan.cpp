#include "plan/method_plan.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "plan/tensor_methods.h"

namespace radiata::plan {
namespace {

using model::Intersection;

std::uint32_t bits(double value) { return std::bit_cast<std::uint32_t>(static_cast<float>(value)); }

std::string bandsOf(const LayerFacts& facts, int limit) {
    return facts.layout.full && !facts.odd_bands_only ? "odd bands too" : "bands up to " + std::to_string(limit);
}

/// Even bands, or for the polynomial odd ones, up to a highest one.
void checkBands(Intersection method, const LayerFacts& facts, int limit, int compiled, const std::string& where) {
    if (!model::byPolynomial(method) && !model::byEqualSteps(method)) return;
    const bool odd = method == Intersection::kPolynomial && facts.odd_bands_only;
    const int highest = method == Intersection::kPolynomialDouble || method == Intersection::kLaguerre ? 4 : 12;
    if ((facts.layout.full && !odd) || compiled > highest) {
        const std::string able = method == Intersection::kPolynomial ? "even bands, or odd bands alone," : "even bands";
        throw Error(Code::kUnsupported, where + ": the method " + std::string(model::methodName(method)) + " draws " + able +
                                            " up to " + std::to_string(highest) + ", this layer has " + bandsOf(facts, limit) +
                                            "; use the march or set lmax");
    }
}

std::string moduleOf(Intersection method) {
    switch (method) {
        case Intersection::kMarch:
        case Intersection::kPoleTable:
        case Intersection::kTensorMarch:
        case Intersection::kTensorInterval:
        case Intersection::kTensorAffine:
        case Intersection::kTessellated:
            return "";
        case Intersection::kPolynomial:
            return "polynomial_";
        case Intersection::kPolynomialDouble:
            return "polynomial_double_";
        case Intersection::kLaguerre:
            return "laguerre_";
        case Intersection::kRayMarchPeeters:
        case Intersection::kRayMarchVanAlmsick:
            return "ray_march_";
    }
    return "";
}

/// In the order of the constants in shaders/glyph/intersect_*.glsl, from id 9 on.
std::vector<std::uint32_t> constantsOf(const model::Quality& quality) {
    const Intersection method = quality.intersection;
    switch (method) {
        case Intersection::kMarch:
        case Intersection::kPoleTable:
        case Intersection::kTessellated:
            return {};
        case Intersection::kPolynomial:
        case Intersection::kPolynomialDouble:
            return {quality.polynomial.bracket_stop ? 1U : 0U, bits(model::polynomialTolerance(method, quality.polynomial))};
        case Intersection::kLaguerre:
            return {bits(model::polynomialTolerance(method, quality.polynomial))};
        case Intersection::kTensorMarch:
        case Intersection::kTensorInterval:
        case Intersection::kTensorAffine:
            return tensorConstants(quality);
        case Intersection::kRayMarchPeeters:
        case Intersection::kRayMarchVanAlmsick:
            return {method == Intersection::kRayMarchVanAlmsick ? 1U : 0U, static_cast<std::uint32_t>(quality.ray_march.steps),
                    static_cast<std::uint32_t>(model::rayMarchRefinements(method, quality.ray_march))};
    }
    return {};
}

}  // namespace

GlyphPlan planMethod(const model::Quality& quality, const model::GlyphLayer& layer, const LayerFacts& facts,
                     const Abilities& abilities, const std::string& where) {
    const int lmax = layer.lmax.value_or(facts.layout.lmax);
    if (lmax > facts.layout.lmax) {
        throw Error(Code::kInvalidArgument, where + ".lmax is " + std::to_string(lmax) + "; the dataset has bands up to " +
                                                std::to_string(facts.layout.lmax));
    }
    const Intersection method = quality.intersection;
    // Even layouts have even bands only: an odd limit means the band below it.
    const int limit = facts.layout.full ? lmax : lmax - lmax % 2;
    const int compiled = std::max(2, limit + limit % 2);
    checkBands(method, facts, limit, compiled, where);
    if (method == Intersection::kPolynomialDouble && !abilities.float64) {
        throw Error(Code::kUnsupported,
                    "quality.intersection is polynomial-double, which needs shaders in double precision; this "
                    "device has none; polynomial does the same in single precision");
    }
    int module_k = compiled;
    if (method == Intersection::kPolynomialDouble || method == Intersection::kLaguerre) module_k = 4;
    // The polynomial of odd bands has degree 4 at least.
    if (method == Intersection::kPolynomial && facts.layout.full) module_k = std::max(4, compiled);
    GlyphPlan plan;
    plan.layout_name = (facts.layout.full ? "full" : "even") + std::to_string(module_k);
    plan.used = static_cast<std::uint32_t>(ShLayout{limit, facts.layout.full}.count());
    plan.both_lobes = layer.negative_lobes == model::NegativeLobes::kShown;
    plan.method_module = moduleOf(method);
    plan.method_constants = constantsOf(quality);
    return plan;
}

bool hasTable(Intersection method) { return model::marches(method) || method == Intersection::kRayMarchVanAlmsick; }

std::string tableModule(Intersection method, const GlyphPlan& glyphs) {
    return (method == Intersection::kRayMarchVanAlmsick ? "glyph_van_almsick_table_" : "glyph_table_") + glyphs.layout_name;
}

std::uint32_t tableFloats(Intersection method, const GlyphPlan& glyphs) {
    const int k = std::stoi(glyphs.layout_name.substr(4));
    const bool full = glyphs.layout_name.starts_with("full");
    // The rotated coefficients, and radius and half length of the cylinder.
    if (method == Intersection::kRayMarchVanAlmsick) return static_cast<std::uint32_t>(ShLayout{k, full}.count() + 2);
    return static_cast<std::uint32_t>(poleTableCount(k, full));
}

}  // namespace radiata::plan
