#include "math/sh_convention.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.h"

namespace radiata {
namespace {

constexpr std::array<std::pair<ShConvention, std::string_view>, 4> kConventions{{
    {ShConvention::kDescoteaux07, "descoteaux07"},
    {ShConvention::kDescoteaux07Legacy, "descoteaux07_legacy"},
    {ShConvention::kTournier07, "tournier07"},
    {ShConvention::kMrtrix02, "mrtrix0.2"},
}};

/// For m > 0: the pair of coefficients (minus, plus) at -m and +m in the internal convention from those of `from`.
template <typename Real>
void pairToInternal(Real& minus, Real& plus, int m, ShConvention from) {
    const Real sign = m % 2 != 0 ? Real(-1) : Real(1);
    switch (from) {
        case ShConvention::kDescoteaux07:
            return;
        case ShConvention::kDescoteaux07Legacy:
            minus *= sign;
            return;
        case ShConvention::kMrtrix02:
            minus /= std::numbers::sqrt2_v<Real>;
            plus /= std::numbers::sqrt2_v<Real>;
            [[fallthrough]];
        case ShConvention::kTournier07:
            std::swap(minus, plus);
            minus *= sign;
            return;
    }
}

template <typename Real>
void pairFromInternal(Real& minus, Real& plus, int m, ShConvention to) {
    const Real sign = m % 2 != 0 ? Real(-1) : Real(1);
    switch (to) {
        case ShConvention::kDescoteaux07:
            return;
        case ShConvention::kDescoteaux07Legacy:
            minus *= sign;
            return;
        case ShConvention::kTournier07:
        case ShConvention::kMrtrix02:
            minus *= sign;
            std::swap(minus, plus);
            if (to == ShConvention::kMrtrix02) {
                minus *= std::numbers::sqrt2_v<Real>;
                plus *= std::numbers::sqrt2_v<Real>;
            }
            return;
    }
}

template <typename Real>
void convert(std::span<Real> coefficients, ShLayout layout, ShConvention from, ShConvention to) {
    if (coefficients.size() != layout.count()) {
        throw Error(Code::kInternal, "convertSh: " + std::to_string(coefficients.size()) + " coefficients for lmax " +
                                         std::to_string(layout.lmax));
    }
    if (from == to) return;
    for (int l = 0; l <= layout.lmax; l += layout.step()) {
        for (int m = 1; m <= l; ++m) {
            Real& minus = coefficients[layout.index(l, -m)];
            Real& plus = coefficients[layout.index(l, m)];
            pairToInternal(minus, plus, m, from);
            pairFromInternal(minus, plus, m, to);
        }
    }
}

}  // namespace

std::string_view name(ShConvention convention) {
    for (const auto& [value, text] : kConventions) {
        if (value == convention) return text;
    }
    return "?";
}

std::string_view name(ShAxes axes) { return axes == ShAxes::kWorld ? "world" : "voxel"; }

ShConvention shConventionFromName(std::string_view name) {
    for (const auto& [value, text] : kConventions) {
        if (text == name) return value;
    }
    throw Error(Code::kInvalidArgument, "SH convention '" + std::string(name) +
                                            "' is not known; descoteaux07, descoteaux07_legacy, tournier07 and mrtrix0.2 are");
}

ShAxes shAxesFromName(std::string_view name) {
    if (name == "world") return ShAxes::kWorld;
    if (name == "voxel") return ShAxes::kVoxel;
    throw Error(Code::kInvalidArgument, "SH axes '" + std::string(name) + "' are not known; world and voxel are");
}

void convertSh(std::span<float> coefficients, ShLayout layout, ShConvention from, ShConvention to) {
    convert(coefficients, layout, from, to);
}
void convertSh(std::span<double> coefficients, ShLayout layout, ShConvention from, ShConvention to) {
    convert(coefficients, layout, from, to);
}

}  // namespace radiata
