#include "tools/lab/tract_scenes.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <utility>

#include "io/tractogram.h"

namespace radiata::lab {
namespace {

/// Directions turn uniformly within a cap, as probabilistic tracking without a prior would have it.
model::Tractogram generated(std::size_t fibres, std::size_t points, double step_mm, double cap_rad) {
    std::mt19937 random(2022);
    std::uniform_real_distribution<double> unit(-1, 1);
    model::Tractogram all;
    all.header.source = all.header.format = "memory";
    for (std::size_t f = 0; f < fibres; ++f) {
        glm::dvec3 p = 60.0 * glm::dvec3(unit(random), unit(random), unit(random));
        glm::dvec3 d = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)) + 1e-3);
        for (std::size_t i = 0; i < points; ++i) {
            all.fibres.points.emplace_back(p);
            const double cosine = 1 - (1 - std::cos(cap_rad)) * 0.5 * (1 + unit(random)),
                         angle = 3.14159265358979 * unit(random);
            const glm::dvec3 a = glm::normalize(glm::cross(d, std::abs(d.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
            d = glm::normalize(cosine * d + std::sqrt(std::max(0.0, 1 - cosine * cosine)) *
                                                (std::cos(angle) * a + std::sin(angle) * glm::cross(d, a)));
            p += step_mm * d;
        }
        all.fibres.offsets.push_back(all.fibres.points.size());
    }
    return all;
}

}  // namespace

std::vector<TractScene> tractScenes(std::size_t fibres) {
    std::vector<TractScene> scenes;
    scenes.push_back({"generated, 7.2 degrees", generated(fibres, 930, 0.1, 7.2 * 3.14159265358979 / 180)});
    const char* folder = std::getenv("RADIATA_DATA");
    if (!folder) return scenes;
    for (const auto& [name, file] :
         {std::pair{"iFOD1, 15 degrees", "sag_ifod1_1000.tck"}, std::pair{"SD_STREAM, 60 degrees", "sag_sd_stream_500.tck"}}) {
        const std::filesystem::path path = std::filesystem::path(folder) / "tracts" / file;
        if (!std::filesystem::exists(path)) continue;
        model::Tractogram all = model::readAll(*io::openTractogram(path));
        if (all.fibreCount() > fibres) {
            all.fibres.offsets.resize(fibres + 1);
            all.fibres.points.resize(all.fibres.offsets.back());
        }
        scenes.push_back({name, std::move(all)});
    }
    return scenes;
}

}  // namespace radiata::lab
