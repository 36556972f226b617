#include "build/fiblet_walk.h"

#include <algorithm>
#include <cmath>

namespace radiata {
namespace {

double distanceToSegment(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 d = b - a;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * d);
}

/// The fraction of [from, to] at which it leaves the ball around `centre`, which has `from` inside and `to` outside.
double exitOfBall(glm::dvec3 centre, double radius, glm::dvec3 from, glm::dvec3 to) {
    const glm::dvec3 d = to - from, f = from - centre;
    const double a = glm::dot(d, d), b = glm::dot(f, d), c = std::min(glm::dot(f, f) - radius * radius, 0.0);
    const double root = std::sqrt(b * b - a * c);
    return std::clamp(b > 0 ? -c / (b + root) : (root - b) / a, 0.0, 1.0);
}

}  // namespace

void walk(std::span<const glm::vec3> line, double step_mm, Walk& out) {
    out.points.clear();
    out.places.clear();
    out.sum_error_mm = out.max_error_mm = 0;
    if (line.empty()) return;
    out.points.push_back(line[0]);
    out.places.push_back(0);
    glm::dvec3 centre(line[0]), at = centre;
    std::size_t passed = 1, next = 1;  // vertices [passed, next) lie between the last two points
    double fraction = 0;               // of the segment before `next`, where `at` is
    const auto settle = [&](glm::dvec3 to) {
        for (; passed < next; ++passed) {
            const double error = distanceToSegment(glm::dvec3(line[passed]), centre, to);
            out.sum_error_mm += error;
            out.max_error_mm = std::max(out.max_error_mm, error);
        }
    };
    while (next < line.size()) {
        const glm::dvec3 vertex(line[next]);
        if (glm::distance(vertex, centre) < step_mm) {
            at = vertex;
            fraction = 0;
            ++next;
            continue;
        }
        const double t = exitOfBall(centre, step_mm, at, vertex);
        const glm::dvec3 to = at + t * (vertex - at);
        settle(to);
        fraction += t * (1 - fraction);
        centre = at = to;
        out.points.emplace_back(to);
        out.places.push_back(double(next - 1) + fraction);
    }
    const glm::dvec3 end(line.back());
    settle(end);
    if (glm::distance(end, centre) > 1e-5 * step_mm) {
        out.points.push_back(line.back());
        out.places.push_back(double(line.size() - 1));
    }
}

}  // namespace radiata
