#include "image/exact_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "build/glyph_instances.h"
#include "reference/camera_rays.h"
#include "reference/glyph_hits.h"

namespace radiata::test {
namespace {

constexpr double kTieMm = 1e-4;

struct Candidate {
    reference::ShFunction f;
    glm::dvec3 centre;
    double reach = 0;   ///< mm, no point of the glyph is farther from its centre
    double radius = 0;  ///< mm, largest of a few hundred directions: a little less than the glyph's radius
};

double sampledRadius(const reference::ShFunction& f, bool both_lobes) {
    constexpr int kSamples = 300;
    double largest = 0;
    for (int i = 0; i < kSamples; ++i) {
        const double z = 1 - (2 * i + 1.0) / kSamples, turn = 2 * std::numbers::pi * std::numbers::phi * i;
        const double value = f(glm::dvec3(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z));
        largest = std::max(largest, both_lobes ? std::abs(value) : value);
    }
    return largest;
}

/// Functions with the layer's band limit. Reach: by Cauchy-Schwarz and the addition theorem for each band.
std::vector<Candidate> candidatesOf(const model::ShImage& image, const model::GlyphLayer& layer) {
    const ShLayout data = image.layout;
    int lmax = std::min(layer.lmax.value_or(data.lmax), data.lmax);
    if (!data.full) lmax -= lmax % 2;
    const ShLayout layout{lmax, data.full};
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < image.voxels.size(); ++i) {
        const float* first = image.coefficients.data() + i * data.count();
        const std::vector<double> coefficients(first, first + layout.count());
        double reach = 0;
        for (int l = 0; l <= lmax; l += layout.step()) {
            double power = 0;
            for (int m = -l; m <= l; ++m) power += coefficients[layout.index(l, m)] * coefficients[layout.index(l, m)];
            reach += std::sqrt(power * (2 * l + 1) / (4 * std::numbers::pi));
        }
        const auto world = glm::dvec3(image.voxel_to_world * glm::dvec4(glm::dvec3(image.voxels[i]), 1.0));
        const reference::ShFunction f(layout, coefficients);
        const double radius = sampledRadius(f, layer.negative_lobes == model::NegativeLobes::kShown);
        candidates.push_back({f, world, reach * layer.scale.factor, radius * layer.scale.factor});
    }
    return candidates;
}

struct Nearest {
    bool decided = true;
    int voxel = -1;
    double from_centre = 0;                              ///< mm
    double t = std::numeric_limits<double>::infinity();  ///< mm from the ray's origin
    double shift = 0;                                    ///< GlyphHits::first_shift
    glm::dvec3 normal{0};
};

Nearest nearestHit(const std::vector<Candidate>& candidates, const reference::Ray& ray, double first, double last, bool both,
                   double scale) {
    Nearest best;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& glyph = candidates[i];
        const glm::dvec3 origin = ray.origin - glyph.centre;
        const double along = glm::dot(origin, ray.direction);
        if (glm::length(origin - along * ray.direction) > glyph.reach) continue;
        // From the point of the ray nearest to the centre, so that nothing is lost for eyes far away.
        const glm::dvec3 closest = (origin - along * ray.direction) / scale;
        const auto found = reference::glyphHits(glyph.f, closest, ray.direction, both, (first - kTieMm + along) / scale);
        if (found.hits.empty()) {
            best.decided = best.decided && found.first_shift < 1e-3;
            continue;
        }
        const double t = found.hits[0].t * scale - along;
        if (std::abs(t - first) <= kTieMm || std::abs(t - last) <= kTieMm || !(found.first_shift < 1e-3) ||
            (best.voxel >= 0 && std::abs(t - best.t) < kTieMm)) {
            best.decided = false;
        }
        if (t < best.t && t <= last) {
            best.t = t;
            best.voxel = static_cast<int>(i);
            best.from_centre = std::abs(found.hits[0].amplitude) * scale;
            best.shift = found.first_shift;
            best.normal = found.hits[0].normal;
        }
    }
    return best;
}

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

void checkHit(const model::Frame& frame, const model::ShImage& image, const Nearest& expected, const reference::Ray& ray,
              const glm::dvec3& forward, std::size_t at, double rounding, double radius, int lmax, ExactCheck& sum) {
    ++sum.checked;
    const model::FramePixels& pixels = frame.pixels;
    const glm::ivec3 voxel(pixels.id[4 * at + 1], pixels.id[4 * at + 2], pixels.id[4 * at + 3]);
    sum.without_steps += pixels.steps[at] <= 0;
    if (voxel != image.voxels[static_cast<std::size_t>(expected.voxel)]) {
        ++sum.wrong_id;
        return;
    }
    // first_shift: radii that the hit moves for 1e-5 radii of the ray.
    const double bound = 2e-5 * radius + rounding * std::max(1.0, expected.shift / 1e-5);
    const double depth = static_cast<double>(pixels.depth[at]) + frame.info.depth_offset_mm;
    const glm::dvec3 position = frame.info.position_origin_mm +
                                glm::dvec3(pixels.position[3 * at], pixels.position[3 * at + 1], pixels.position[3 * at + 2]);
    const double depth_error = std::abs(depth - expected.t * glm::dot(ray.direction, forward));
    const double position_error = glm::length(position - ray.origin - expected.t * ray.direction);
    const double share = std::max(depth_error, position_error) / bound;
    sum.worst_depth = std::max(sum.worst_depth, share);
    sum.wrong_depth += !(share <= 1);
    glm::dvec3 normal = expected.normal;
    if (glm::dot(normal, ray.direction) > 0) normal = -normal;  // outputs point towards the viewer
    const glm::dvec3 drawn(pixels.normal[3 * at], pixels.normal[3 * at + 1], pixels.normal[3 * at + 2]);
    const double degrees = degreesBetween(normal, drawn);
    sum.worst_normal_deg = std::max(sum.worst_normal_deg, degrees);
    // Near the centre a rounding of the position turns the direction from it, and the normal turns lmax + 1 times as fast.
    const double turned = (lmax + 1) * 4e-7 * radius / std::max(expected.from_centre, 1e-12);
    sum.wrong_normal += !(degrees <= 0.1 + turned * 180 / std::numbers::pi);
}

void add(const ExactCheck& part, ExactCheck& sum) {
    sum.checked += part.checked;
    sum.empty += part.empty;
    sum.undecided += part.undecided;
    sum.wrong_id += part.wrong_id;
    sum.wrong_depth += part.wrong_depth;
    sum.wrong_normal += part.wrong_normal;
    sum.without_steps += part.without_steps;
    sum.worst_depth = std::max(sum.worst_depth, part.worst_depth);
    sum.worst_normal_deg = std::max(sum.worst_normal_deg, part.worst_normal_deg);
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const ExactCheck& check) {
    return out << check.checked << " hits and " << check.empty << " empty pixels checked, " << check.undecided
               << " undecided, wrong: " << check.wrong_id << " ids, " << check.wrong_depth << " depths (worst "
               << check.worst_depth << " of the bound), " << check.wrong_normal << " normals (worst " << check.worst_normal_deg
               << " degrees), " << check.without_steps << " without steps";
}

ExactCheck checkAgainstReference(const model::Frame& frame, const model::ShImage& image, int pixels) {
    const model::FrameRequest& request = frame.info.request;
    const model::GlyphLayer& layer = request.scene.layers.at(0).glyphs();
    const double scale = layer.scale.factor;
    const bool both = layer.negative_lobes == model::NegativeLobes::kShown;
    const std::vector<Candidate> candidates = candidatesOf(image, layer);
    const glm::dvec3 forward = model::cameraFrame(request.camera).forward;
    glm::dvec3 low, high;
    datasetBounds(image, low, high);
    const double rounding = 4e-7 * glm::length(high - low);
    const int total = request.width * request.height;
    const int stride = std::max(1, total / pixels);
    ExactCheck sum;
    std::mutex mutex;
    parallelFor(static_cast<std::size_t>(total / stride), 16, [&](std::size_t begin, std::size_t end) {
        ExactCheck part;
        for (std::size_t i = begin; i < end; ++i) {
            // The stride is moved by a number without common factors, so that the sample walks through all columns.
            const auto at =
                static_cast<std::size_t>((static_cast<long>(i) * stride + static_cast<long>(i) * 7 % stride) % total);
            const int x = static_cast<int>(at) % request.width, y = static_cast<int>(at) / request.width;
            const reference::Ray ray = reference::cameraRay(request.camera, request.width, request.height, x + 0.5, y + 0.5);
            const double stretch = 1 / glm::dot(ray.direction, forward);
            const double infinity = std::numeric_limits<double>::infinity();
            double first = request.camera.perspective ? 0.0 : -infinity, last = infinity;
            if (request.camera.clip) {
                first = request.camera.clip->nearest_mm * stretch;
                last = request.camera.clip->farthest_mm * stretch;
            }
            const Nearest expected = nearestHit(candidates, ray, first, last, both, scale);
            if (!expected.decided) {
                ++part.undecided;
            } else if ((expected.voxel >= 0) != (frame.pixels.id[4 * at] >= 0)) {
                ++part.checked;
                ++part.wrong_id;
            } else if (expected.voxel < 0) {
                ++part.empty;
            } else {
                const double radius = candidates[static_cast<std::size_t>(expected.voxel)].radius;
                checkHit(frame, image, expected, ray, forward, at, rounding, radius, image.layout.lmax, part);
            }
        }
        const std::lock_guard lock(mutex);
        add(part, sum);
    });
    return sum;
}

}  // namespace radiata::test
