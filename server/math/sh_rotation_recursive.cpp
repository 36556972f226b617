#include "math/sh_rotation_recursive.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"

namespace radiata {
namespace {

/// Real harmonics of one band without Condon-Shortley phase: sin |m| phi at -m, cos m phi at m. Band 1 is then (y, z, x).
struct Band {
    int l;
    std::vector<double> entries;

    explicit Band(int band) : l(band), entries(static_cast<std::size_t>((2 * band + 1) * (2 * band + 1)), 0.0) {}
    double& at(int row, int column) { return entries[static_cast<std::size_t>((row + l) * (2 * l + 1) + column + l)]; }
    double at(int row, int column) const { return entries[static_cast<std::size_t>((row + l) * (2 * l + 1) + column + l)]; }
};

void checkRotation(const glm::dmat3& rotation) {
    const glm::dmat3 rest = glm::transpose(rotation) * rotation - glm::dmat3(1.0);
    double worst = std::abs(glm::determinant(rotation) - 1);
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) worst = std::abs(rest[c][r]) <= worst ? worst : std::abs(rest[c][r]);
    }
    if (!(worst < 1e-9)) {
        throw Error(Code::kInvalidArgument,
                    "rotation of spherical harmonics: the matrix is not a rotation (off by " + std::to_string(worst) + ")");
    }
}

/// Function P of Table 2: band 1's row i with the band below.
double product(const Band& one, const Band& below, int i, int row, int column) {
    const int top = below.l;
    if (column == top + 1) return one.at(i, 1) * below.at(row, top) - one.at(i, -1) * below.at(row, -top);
    if (column == -top - 1) return one.at(i, 1) * below.at(row, -top) + one.at(i, -1) * below.at(row, top);
    return one.at(i, 0) * below.at(row, column);
}

double partV(const Band& one, const Band& below, int m, int n) {
    if (m == 0) return product(one, below, 1, 1, n) + product(one, below, -1, -1, n);
    if (m > 0) {
        const double first = product(one, below, 1, m - 1, n) * (m == 1 ? std::numbers::sqrt2 : 1);
        return m == 1 ? first : first - product(one, below, -1, -m + 1, n);
    }
    const double second = product(one, below, -1, -m - 1, n) * (m == -1 ? std::numbers::sqrt2 : 1);
    return m == -1 ? second : second + product(one, below, 1, m + 1, n);
}

double partW(const Band& one, const Band& below, int m, int n) {
    return m > 0 ? product(one, below, 1, m + 1, n) + product(one, below, -1, -m - 1, n)
                 : product(one, below, 1, m - 1, n) - product(one, below, -1, -m + 1, n);
}

Band nextBand(const Band& one, const Band& below) {
    const int l = below.l + 1;
    Band band(l);
    for (int m = -l; m <= l; ++m) {
        for (int n = -l; n <= l; ++n) {
            const int a = std::abs(m);
            const double scale = 1.0 / (std::abs(n) < l ? (l + n) * (l - n) : 2 * l * (2 * l - 1));
            const double u = std::sqrt((l + m) * (l - m) * scale);
            const double v = 0.5 * std::sqrt((m == 0 ? 2 : 1) * (l + a - 1) * (l + a) * scale) * (m == 0 ? -1 : 1);
            const double w = m == 0 ? 0 : -0.5 * std::sqrt((l - a - 1) * (l - a) * scale);
            double sum = 0;
            if (u != 0) sum += u * product(one, below, 0, m, n);
            if (v != 0) sum += v * partV(one, below, m, n);
            if (w != 0) sum += w * partW(one, below, m, n);
            band.at(m, n) = sum;
        }
    }
    return band;
}

std::vector<Band> bandsOf(int lmax, const glm::dmat3& rotation) {
    std::vector<Band> bands{Band(0)};
    bands[0].at(0, 0) = 1;
    constexpr std::array<int, 3> kAxis{1, 2, 0};  // y, z, x
    if (lmax >= 1) bands.emplace_back(1);
    for (int row = -1; lmax >= 1 && row <= 1; ++row) {
        for (int column = -1; column <= 1; ++column) {
            bands[1].at(row, column) =
                rotation[kAxis[static_cast<std::size_t>(column + 1)]][kAxis[static_cast<std::size_t>(row + 1)]];
        }
    }
    for (int l = 2; l <= lmax; ++l) bands.push_back(nextBand(bands[1], bands.back()));
    return bands;
}

Band turnAboutZ(int l, double angle) {
    Band band(l);
    band.at(0, 0) = 1;
    for (int m = 1; m <= l; ++m) {
        band.at(m, m) = band.at(-m, -m) = std::cos(m * angle);
        band.at(m, -m) = -std::sin(m * angle);
        band.at(-m, m) = std::sin(m * angle);
    }
    return band;
}

Band multiply(const Band& a, const Band& b) {
    Band result(a.l);
    for (int row = -a.l; row <= a.l; ++row) {
        for (int column = -a.l; column <= a.l; ++column) {
            for (int k = -a.l; k <= a.l; ++k) result.at(row, column) += a.at(row, k) * b.at(k, column);
        }
    }
    return result;
}

/// Internal convention: cos m phi stands at -m, and (-1)^m sin m phi at m.
BandMatrices toInternal(const std::vector<Band>& bands) {
    BandMatrices result;
    const auto sign = [](int m) { return m > 0 && m % 2 != 0 ? -1.0 : 1.0; };
    for (const Band& band : bands) {
        Band internal(band.l);
        for (int m = -band.l; m <= band.l; ++m) {
            for (int n = -band.l; n <= band.l; ++n) internal.at(m, n) = sign(m) * sign(n) * band.at(-m, -n);
        }
        result.push_back(std::move(internal.entries));
    }
    return result;
}

}  // namespace

BandMatrices ivanicRuedenberg(int lmax, const glm::dmat3& rotation) {
    checkRotation(rotation);
    return toInternal(bandsOf(lmax, rotation));
}

BandMatrices zyzRotation(int lmax, const glm::dmat3& rotation) {
    checkRotation(rotation);
    // Columns are images of the axes: rotation[2] = (cos alpha sin beta, sin alpha sin beta, cos beta).
    const double sine = std::hypot(rotation[2].x, rotation[2].y);
    const double beta = std::atan2(sine, rotation[2].z);
    double alpha = 0, gamma = 0;
    if (sine > 1e-12) {
        alpha = std::atan2(rotation[2].y, rotation[2].x);
        gamma = std::atan2(rotation[1].z, -rotation[0].z);
    } else {
        // About the poles only alpha + gamma or alpha - gamma is defined.
        alpha = rotation[2].z > 0 ? std::atan2(rotation[0].y, rotation[0].x) : std::atan2(-rotation[0].y, -rotation[0].x);
    }
    const glm::dmat3 quarter(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));  // about x, y to z
    const std::vector<Band> there = bandsOf(lmax, quarter), back = bandsOf(lmax, glm::transpose(quarter));
    std::vector<Band> bands;
    for (int l = 0; l <= lmax; ++l) {
        const auto i = static_cast<std::size_t>(l);
        const Band about_y = multiply(back[i], multiply(turnAboutZ(l, beta), there[i]));
        bands.push_back(multiply(turnAboutZ(l, alpha), multiply(about_y, turnAboutZ(l, gamma))));
    }
    return toInternal(bands);
}

void applyBands(const BandMatrices& bands, std::span<double> coefficients) {
    if (coefficients.size() != bands.size() * bands.size()) {
        throw Error(Code::kInternal, "applyBands: " + std::to_string(coefficients.size()) + " coefficients for " +
                                         std::to_string(bands.size()) + " bands");
    }
    std::size_t first = 0;
    for (const std::vector<double>& matrix : bands) {
        const std::size_t count = (&matrix - bands.data()) * 2 + 1;
        std::vector<double> turned(count, 0.0);
        for (std::size_t row = 0; row < count; ++row) {
            for (std::size_t column = 0; column < count; ++column) {
                turned[row] += matrix[row * count + column] * coefficients[first + column];
            }
        }
        std::copy(turned.begin(), turned.end(), coefficients.begin() + static_cast<std::ptrdiff_t>(first));
        first += count;
    }
}

}  // namespace radiata
