#include "reference/capsule.h"

#include <algorithm>
#include <cmath>

namespace radiata::reference {
namespace {

/// From the nearest point of the axis.
glm::dvec3 fromAxis(const glm::dvec3& p, const glm::dvec3& start, const glm::dvec3& along) {
    const double length2 = glm::dot(along, along);
    const double s = length2 > 0 ? std::clamp(glm::dot(p - start, along) / length2, 0.0, 1.0) : 0.0;
    return p - start - s * along;
}

}  // namespace

CapsuleHit capsuleHit(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& start, const glm::dvec3& along,
                      double radius, double nearest) {
    const double speed = glm::length(direction);
    const auto distance = [&](double t) { return glm::length(fromAxis(origin + t * direction, start, along)); };
    // The distance from a segment is convex along a line: its least value by ternary search, the hit by bisection before it.
    const double middle = glm::dot(start + 0.5 * along - origin, direction) / (speed * speed);
    const double reach = (glm::length(along) + radius) / speed;
    double low = middle - 2 * reach, high = middle + 2 * reach;
    for (int i = 0; i < 200; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }
    const double closest = 0.5 * (low + high), least = distance(closest);
    CapsuleHit result;
    result.sure = std::abs(least - radius) > 1e-4 * radius;
    if (least > radius) return result;
    double outside = middle - 2 * reach, inside = closest;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.5 * (outside + inside);
        (distance(t) > radius ? outside : inside) = t;
    }
    result.t = inside;
    result.sure = result.sure && std::abs(result.t - nearest) * speed > 1e-4 * radius;
    result.hit = result.t >= nearest;
    result.normal = glm::normalize(fromAxis(origin + result.t * direction, start, along));
    return result;
}

}  // namespace radiata::reference
