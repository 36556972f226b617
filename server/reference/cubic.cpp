#include "reference/cubic.h"

#include <algorithm>
#include <cmath>

namespace radiata::reference {
namespace {

using Bernstein = std::array<double, 4>;

/// The blossom of the trilinear function restricted to the chord: each axis gets its own parameter; the Bernstein coefficient i
/// is the mean over all ways to give i of the three axes the chord's end.
Bernstein bernsteinForm(const std::array<double, 8>& corners, double isovalue, const glm::dvec3& from, const glm::dvec3& to) {
    Bernstein form{};
    constexpr std::array<double, 4> kWays{1, 3, 3, 1};
    for (unsigned ends = 0; ends < 8; ++ends) {
        glm::dvec3 p;
        std::size_t count = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const bool end = (ends >> static_cast<unsigned>(axis) & 1U) != 0;
            p[axis] = end ? to[axis] : from[axis];
            count += end ? 1 : 0;
        }
        form[count] += (cellValue(corners, p) - isovalue) / kWays[count];
    }
    return form;
}

/// Both halves of a Bernstein form, by de Casteljau.
std::pair<Bernstein, Bernstein> halves(const Bernstein& b) {
    const double b01 = 0.5 * (b[0] + b[1]), b12 = 0.5 * (b[1] + b[2]), b23 = 0.5 * (b[2] + b[3]);
    const double b012 = 0.5 * (b01 + b12), b123 = 0.5 * (b12 + b23), middle = 0.5 * (b012 + b123);
    return {{b[0], b01, b012, middle}, {middle, b123, b23, b[3]}};
}

/// The first change of sign against `positive` in [low, low + width], where the form holds.
std::optional<double> search(const Bernstein& form, double low, double width, bool positive) {
    const auto other = [&](double value) { return (value >= 0) != positive; };
    if (std::ranges::none_of(form, other)) return std::nullopt;  // the form lies in its coefficients' hull
    if (width < 1e-15) return other(form[3]) || other(form[0]) ? std::optional(low) : std::nullopt;
    const auto [first, second] = halves(form);
    if (const auto found = search(first, low, 0.5 * width, positive)) return found;
    return search(second, low + 0.5 * width, 0.5 * width, positive);
}

/// Largest excursion of the form to the other side.
double excursion(const Bernstein& form, bool positive) {
    double most = 0;
    for (int i = 0; i <= 64; ++i) {
        const double u = i / 64.0, v = 1 - u;
        const double value = v * v * v * form[0] + 3 * v * v * u * form[1] + 3 * v * u * u * form[2] + u * u * u * form[3];
        most = std::max(most, positive ? -value : value);
    }
    return most;
}

}  // namespace

double cellValue(const std::array<double, 8>& corners, const glm::dvec3& p) {
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const double wx = corner & 1U ? p.x : 1 - p.x, wy = corner & 2U ? p.y : 1 - p.y, wz = corner & 4U ? p.z : 1 - p.z;
        sum += wx * wy * wz * corners[corner];
    }
    return sum;
}

std::optional<ChordRoot> firstChordRoot(const std::array<double, 8>& corners, double isovalue, const glm::dvec3& from,
                                        const glm::dvec3& to) {
    const Bernstein form = bernsteinForm(corners, isovalue, from, to);
    const bool positive = form[0] >= 0;
    const std::optional<double> u = search(form, 0, 1, positive);
    if (!u) return std::nullopt;
    return ChordRoot{*u, std::min(std::abs(form[0]), excursion(form, positive))};
}

}  // namespace radiata::reference
