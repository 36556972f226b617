// Streamlines for tests: constant steps with random turns.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::test {

struct Fibres {
    std::vector<glm::vec3> points;
    std::vector<std::uint64_t> offsets{0};
    void add(const std::vector<glm::vec3>& fibre) {
        points.insert(points.end(), fibre.begin(), fibre.end());
        offsets.push_back(points.size());
    }
};

/// A fibre whose turns are uniform in a cap, about as probabilistic tracking makes them.
inline std::vector<glm::vec3> randomFibre(std::mt19937& random, std::size_t points, double step_mm, double cap_rad,
                                          double extent_mm = 60) {
    std::uniform_real_distribution<double> unit(-1, 1);
    glm::dvec3 p = extent_mm * glm::dvec3(unit(random), unit(random), unit(random));
    glm::dvec3 d = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)) + 1e-3);
    std::vector<glm::vec3> fibre;
    for (std::size_t i = 0; i < points; ++i) {
        fibre.emplace_back(p);
        const double cosine = 1 - (1 - std::cos(cap_rad)) * 0.5 * (1 + unit(random)), angle = 3.14159265358979 * unit(random);
        const glm::dvec3 a = glm::normalize(glm::cross(d, std::abs(d.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        d = glm::normalize(cosine * d + std::sqrt(std::max(0.0, 1 - cosine * cosine)) *
                                            (std::cos(angle) * a + std::sin(angle) * glm::cross(d, a)));
        p += step_mm * d;
    }
    return fibre;
}

inline Fibres randomFibres(std::uint32_t seed, std::size_t count, std::size_t points, double step_mm, double cap_rad) {
    std::mt19937 random(seed);
    Fibres fibres;
    for (std::size_t f = 0; f < count; ++f) fibres.add(randomFibre(random, 1 + random() % points, step_mm, cap_rad));
    return fibres;
}

}  // namespace radiata::test
