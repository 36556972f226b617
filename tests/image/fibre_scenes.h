// Tractograms for pictures, and what the reference says that they show.
#pragma once

#include <vector>

#include "build/fiblet_encode.h"
#include "model/frame.h"
#include "reference/fiblet.h"
#include "reference/fibre_picture.h"
#include "shaders/shared/fiblet_draw.glsl"
#include "support/random_fibres.h"

namespace radiata::test {

/// \param centre_mm  where they are shifted to
inline model::FibletSet randomTractogram(std::uint32_t seed, std::size_t fibres, std::size_t points, double step_mm,
                                         double extent_mm, const glm::dvec3& centre_mm = glm::dvec3(0)) {
    std::mt19937 random(seed);
    Fibres made;
    for (std::size_t f = 0; f < fibres; ++f) {
        std::vector<glm::vec3> fibre = randomFibre(random, 2 + random() % points, step_mm, 0.2, extent_mm);
        for (glm::vec3& point : fibre) point += glm::vec3(centre_mm);
        made.add(fibre);
    }
    return encodeFiblets(made.points, made.offsets, {});
}

/// All segments of decoded fiblets, in double, numbered as in shaders/shared/fiblet_draw.glsl.
inline std::vector<reference::FibreSegment> decodedSegments(const model::FibletSet& set) {
    std::vector<reference::FibreSegment> segments;
    for (std::uint32_t f = 0; f < set.heads.size(); ++f) {
        const model::FibletHead& head = set.heads[f];
        const std::uint32_t first = set.pages[f / shader::FIBLET_PAGE].first_word + model::fibletWord(head);
        const auto points = reference::fibletPoints({head.place0, head.place1, head.direction, head.fibre, head.shape},
                                                    std::span(set.codes).subspan(first), static_cast<double>(set.codec.cell_mm),
                                                    static_cast<double>(set.codec.step_mm), set.codec.cap_ratio);
        for (std::uint32_t i = 0; i + 1 < points.size(); ++i) {
            segments.push_back({set.origin_mm + points[i], set.origin_mm + points[i + 1], f << 6U | i});
        }
    }
    return segments;
}

/// A request for one layer of fibres, without marks.
inline model::FrameRequest fibreRequest(const std::string& dataset, int width, int height, int samples = 1) {
    model::FrameRequest request;
    request.width = width;
    request.height = height;
    request.quality.samples = samples;
    request.scene.annotations.hidden = true;
    model::TractogramLayer layer;
    layer.dataset_id = dataset;
    request.scene.layers.emplace_back().content = layer;
    return request;
}

inline glm::dvec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// Any camera about a ball: near and far, inside too, of both kinds.
inline model::Camera randomCamera(std::mt19937& random, const glm::dvec3& centre_mm, double radius_mm) {
    std::uniform_real_distribution<double> unit(0, 1);
    model::Camera camera;
    camera.perspective = unit(random) < 0.6;
    camera.target_mm = centre_mm + 0.5 * radius_mm * unit(random) * randomDirection(random);
    const double distance = radius_mm * std::pow(10, 1.6 * unit(random) - 1);
    camera.eye_mm = camera.target_mm + distance * randomDirection(random);
    camera.up = randomDirection(random);
    camera.field_of_view_deg = 5 + 70 * unit(random);
    camera.height_mm = radius_mm * std::pow(10, 1.5 * unit(random) - 1);
    return camera;
}

}  // namespace radiata::test
