#include "tools/lab/tract_scenes.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <utility>

#include "build/fiblet_encode.h"
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

/// See ballOfFibres(). Each fibre has a seed of its own, so the source may begin anew and be cut anywhere.
class BallSource final : public model::TractogramSource {
public:
    explicit BallSource(std::size_t fibres) : fibres_(fibres) {
        header_.source = header_.format = "memory";
        header_.fibre_count = fibres;
        header_.point_count = fibres * kPoints;
    }
    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        batch.clear(0, 0);
        batch.first_fibre = next_;
        batch.first_point = next_ * kPoints;
        while (next_ < fibres_ && batch.points.size() < points_wanted) {
            add(batch.points);
            batch.offsets.push_back(batch.points.size());
        }
        return batch.fibreCount() > 0;
    }

private:
    static constexpr std::size_t kPoints = 800;
    static constexpr double kRadiusMm = 70, kStepMm = 0.1;

    void add(std::vector<glm::vec3>& points) {
        std::mt19937 random(static_cast<std::uint32_t>(31 + 7919 * next_++));
        const auto cube = [&] {
            const auto one = [&] { return static_cast<double>(random()) * 0x1p-31 - 1; };
            const double x = one(), y = one();
            return glm::dvec3(x, y, one());
        };
        const auto direction = [&] {
            for (;;) {
                const glm::dvec3 v = cube();
                if (glm::dot(v, v) > 0.01 && glm::dot(v, v) <= 1) return glm::normalize(v);
            }
        };
        glm::dvec3 p = direction();
        p *= kRadiusMm * std::cbrt(0.999 * (static_cast<double>(random()) + 1) * 0x1p-32);
        glm::dvec3 d = direction();
        for (std::size_t i = 0; i < kPoints; ++i) {
            points.emplace_back(p);
            const glm::dvec3 inward = glm::length(p) > kRadiusMm - 5 ? -0.05 * glm::normalize(p) : glm::dvec3(0);
            d = glm::normalize(d + 0.02 * cube() + inward);
            p += kStepMm * d;
        }
    }

    std::size_t fibres_, next_ = 0;
    model::TractogramHeader header_;
};

model::Tractogram firstFibres(const std::filesystem::path& path, std::size_t fibres) {
    model::Tractogram all = model::readAll(*io::openTractogram(path));
    if (all.fibreCount() > fibres) {
        all.fibres.offsets.resize(fibres + 1);
        all.fibres.points.resize(all.fibres.offsets.back());
    }
    return all;
}

}  // namespace

model::FibletSet ballOfFibres(std::size_t fibres) {
    return encodeFiblets([&] { return std::make_unique<BallSource>(fibres); }, FibletOptions{});
}

model::FrameRequest fibreFrame(int height, const std::string& dataset) {
    model::FrameRequest request;
    request.height = height;
    request.width = height * 16 / 9;
    request.quality.samples = 1;
    request.scene.annotations.hidden = true;
    model::TractogramLayer layer;
    layer.dataset_id = dataset;
    request.scene.layers.emplace_back().content = layer;
    return request;
}

std::vector<TractScene> tractScenes(std::size_t fibres, const std::string& own_file) {
    std::vector<TractScene> scenes;
    scenes.push_back({"generated, 7.2 degrees", generated(fibres, 930, 0.1, 7.2 * 3.14159265358979 / 180), true});
    if (!own_file.empty()) {
        const std::filesystem::path path = own_file;
        scenes.push_back({path.filename().string(), firstFibres(path, fibres), true});
    }
    const char* folder = std::getenv("RADIATA_DATA");
    if (!folder) return scenes;
    for (const auto& [name, file] :
         {std::pair{"iFOD1, 15 degrees", "sag_ifod1_1000.tck"}, std::pair{"SD_STREAM, 60 degrees", "sag_sd_stream_500.tck"}}) {
        const std::filesystem::path path = std::filesystem::path(folder) / "tracts" / file;
        if (!std::filesystem::exists(path)) continue;
        scenes.push_back({name, firstFibres(path, fibres)});
    }
    return scenes;
}

}  // namespace radiata::lab
