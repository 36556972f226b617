#include "reference/fibre_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata::reference {
namespace {

constexpr double kUnsurePixels = 2e-3;
constexpr double kUnsureDepth = 1e-3;

/// The camera as a pyramid or box of sight lines. Places are pixels from the upper left corner.
struct Sight {
    glm::dvec3 eye, right, up, forward;
    double scale;  ///< perspective: pixels at unit depth; orthographic: pixels per mm
    bool perspective;
    double centre_x, centre_y;

    Sight(const model::Camera& camera, int width, int height) : perspective(camera.perspective) {
        eye = camera.eye_mm;
        forward = glm::normalize(camera.target_mm - camera.eye_mm);
        right = glm::normalize(glm::cross(forward, camera.up));
        up = glm::cross(right, forward);
        centre_x = 0.5 * width;
        centre_y = 0.5 * height;
        scale = perspective ? 0.5 * height / std::tan(0.5 * camera.field_of_view_deg * std::numbers::pi / 180)
                            : height / camera.height_mm;
    }
    double depth(const glm::dvec3& p) const { return glm::dot(p - eye, forward); }
    glm::dvec2 place(const glm::dvec3& p) const {
        const double w = perspective ? depth(p) : 1;
        return {centre_x + scale * glm::dot(p - eye, right) / w, centre_y - scale * glm::dot(p - eye, up) / w};
    }
    /// Signed distance, up to a factor, from the plane of all points that stand at a column (axis 0) or row (axis 1).
    double beyond(const glm::dvec3& p, int axis, double at) const {
        const double offset = axis == 0 ? (at - centre_x) / scale : (centre_y - at) / scale;
        return glm::dot(p - eye, axis == 0 ? right : up) - offset * (perspective ? depth(p) : 1);
    }
};

void show(FibrePixel& pixel, std::uint32_t who, double depth, bool sure) {
    const bool close = who != pixel.who && std::abs(depth - pixel.depth_mm) < kUnsureDepth;
    if (depth < pixel.depth_mm || (depth == pixel.depth_mm && who < pixel.who)) {
        pixel = {who, depth, sure && !close};
    } else if (close) {
        pixel.sure = false;
    }
}

/// A place that is on the edge of being seen makes pixels unsure that it would be the nearest in.
void doubt(FibrePixel& pixel, double depth) {
    if (depth < pixel.depth_mm + kUnsureDepth) pixel.sure = false;
}

}  // namespace

std::vector<FibrePixel> fibrePicture(std::span<const FibreSegment> segments, const model::Camera& camera, int width, int height,
                                     int line_width) {
    const Sight sight(camera, width, height);
    std::vector<FibrePixel> picture(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const glm::ivec2 size(width, height);
    // Doubts first count against what is shown in the end, so they are kept and applied last.
    struct Doubt {
        std::size_t pixel;
        double depth;
    };
    std::vector<Doubt> doubts;
    for (const FibreSegment& segment : segments) {
        const glm::dvec2 a = sight.place(segment.from), b = sight.place(segment.to);
        const glm::dvec2 extent = glm::abs(b - a);
        const bool unsure_axis = std::abs(extent.x - extent.y) < kUnsurePixels;
        for (int axis = 0; axis < 2; ++axis) {
            const bool drawn = (axis == 0) == (extent.x >= extent.y);
            if (!drawn && !unsure_axis) continue;
            const int other = 1 - axis;
            const double low = std::min(a[axis], b[axis]), high = std::max(a[axis], b[axis]);
            const int first = std::max(0, static_cast<int>(std::floor(low - 0.51)));
            const int last = std::min(size[axis] - 1, static_cast<int>(std::ceil(high - 0.49)));
            for (int i = first; i <= last; ++i) {
                const double centre = i + 0.5;
                const bool inside = centre >= low && centre < high;
                const bool at_end = std::min(std::abs(centre - low), std::abs(centre - high)) < kUnsurePixels;
                if (!inside && !at_end) continue;
                const double from = sight.beyond(segment.from, axis, centre), to = sight.beyond(segment.to, axis, centre);
                const double s = from == to ? 0 : std::clamp(from / (from - to), 0.0, 1.0);
                const glm::dvec3 crossing = segment.from + s * (segment.to - segment.from);
                const double across = sight.place(crossing)[other], depth = sight.depth(crossing);
                const double corner = across - 0.5 * (line_width - 1);
                for (int shift : {-1, 0, 1}) {
                    const int start = static_cast<int>(std::floor(corner + shift * kUnsurePixels));
                    const bool doubtful = !drawn || !inside || shift != 0;
                    for (int j = std::max(start, 0); j < std::min(start + line_width, size[other]); ++j) {
                        const int x = axis == 0 ? i : j, y = axis == 0 ? j : i;
                        const std::size_t at =
                            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
                        const bool sure = !unsure_axis && !at_end;
                        if (!doubtful) {
                            show(picture[at], segment.who, depth, sure);
                        }
                        const bool moves = shift != 0 && start != static_cast<int>(std::floor(corner));
                        if (doubtful && (shift == 0 || moves)) doubts.push_back({at, depth});
                        // A pixel that the line leaves when shifted is doubtful too.
                        if (!doubtful && std::abs(corner - std::round(corner)) < kUnsurePixels) doubts.push_back({at, depth});
                    }
                }
            }
        }
    }
    for (const Doubt& each : doubts) doubt(picture[each.pixel], each.depth);
    return picture;
}

}  // namespace radiata::reference
