#include "build/phantom_bundles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "build/phantom_random.h"

namespace radiata::phantom {
namespace {

struct ControlPoint {
    glm::dvec3 p_mm;
    double radius_mm;
};
using Course = std::vector<ControlPoint>;

template <typename Value>
Value catmullRom(const Value& a, const Value& b, const Value& c, const Value& d, double t) {
    return 0.5 * (2.0 * b + t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a))));
}

Strand strandAlong(const Course& course) {
    Strand strand;
    const auto at = [&](std::ptrdiff_t i) -> const ControlPoint& {
        return course[std::clamp<std::ptrdiff_t>(i, 0, static_cast<std::ptrdiff_t>(course.size()) - 1)];
    };
    for (std::ptrdiff_t i = 0; i + 1 < static_cast<std::ptrdiff_t>(course.size()); ++i) {
        const int steps = std::max(2, static_cast<int>(std::ceil(glm::distance(at(i).p_mm, at(i + 1).p_mm))));
        const bool last = i + 2 == static_cast<std::ptrdiff_t>(course.size());
        for (int step = 0; step < steps + (last ? 1 : 0); ++step) {
            const double t = static_cast<double>(step) / steps;
            strand.points.push_back(catmullRom(at(i - 1).p_mm, at(i).p_mm, at(i + 1).p_mm, at(i + 2).p_mm, t));
            strand.radii.push_back(glm::mix(at(i).radius_mm, at(i + 1).radius_mm, t));
        }
    }
    const std::size_t count = strand.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3& before = strand.points[i == 0 ? 0 : i - 1];
        const glm::dvec3& after = strand.points[std::min(i + 1, count - 1)];
        strand.tangents.push_back(glm::normalize(after - before));
    }
    return strand;
}

/// Fans by the angle of the precentral gyrus in the coronal plane: from the midline over the top to the side.
std::vector<Course> corticospinal() {
    std::vector<Course> courses;
    for (int i = 0; i < 9; ++i) {
        const double spread = i / 8.0;  // leg to face
        const double angle = glm::mix(80.0, 22.0, spread) * std::numbers::pi / 180;
        const glm::dvec3 cortex(6 + 52 * std::cos(angle), -24 + 14 * spread, 14 + 58 * std::sin(angle));
        const double ahead = 5 * (spread - 0.5);  // order of the fibres in the internal capsule: face in front
        courses.push_back({{{7, -30 + 0.3 * ahead, -62}, 6},
                           {{8, -27 + 0.3 * ahead, -38}, 6},
                           {{14, -21 + 0.5 * ahead, -14}, 6},
                           {{23, -16 + ahead, 5}, 6},
                           {{28, -17 + ahead, 20}, 6},
                           {{29 + 4 * (spread - 0.4), -18 + ahead, 34}, 6.5},
                           {glm::mix(glm::dvec3(30, -18, 38), cortex, 0.5), 7},
                           {cortex, 8}});
    }
    return courses;
}

/// From one cortex to the other, front (genu) to back (splenium), fanning from the side of the hemispheres to their top.
std::vector<Course> callosum() {
    std::vector<Course> courses;
    constexpr int kRows = 22;
    for (int row = 0; row < kRows; ++row) {
        const double u = 2.0 * row / (kRows - 1) - 1;  // -1 genu, 1 splenium
        const double bend = u * u * u;                 // the forceps turn forward and backward
        const glm::dvec3 middle(0, -6 - 34 * u, 26 - 17 * u * u);
        const glm::dvec3 shoulder(15, middle.y - 4 * bend, middle.z + 3);
        const glm::dvec3 semiovale(28, middle.y - 18 * bend - 9 * (1 - u * u), 32 - 16 * u * u);
        const glm::dvec3 top(22 - 8 * u * u, middle.y - 28 * bend - 4, 66 - 38 * u * u);
        const glm::dvec3 side(50 - 16 * u * u, middle.y - 26 * bend - 9 * (1 - u * u), 38 - 20 * u * u);
        for (const double fan : {0.0, 0.4, 0.75, 1.0}) {  // end to the side ... to the top
            const glm::dvec3 through = glm::mix(semiovale, 0.5 * (shoulder + top) + glm::dvec3(4, 0, 0), fan);
            const glm::dvec3 arc = glm::mix(side, top, fan);
            const double bulge =
                9 * std::sin(std::numbers::pi * fan) * (1 - 0.5 * u * u);  // ends lie on an arc, not on its chord
            const Course half{{middle, 4.5}, {shoulder, 4.5}, {through, 6.5}, {arc + bulge * glm::dvec3(0.8, 0, 0.6), 9}};
            Course whole;
            for (std::size_t i = half.size() - 1; i > 0; --i) {
                whole.push_back({half[i].p_mm * glm::dvec3(-1, 1, 1), half[i].radius_mm});
            }
            whole.insert(whole.end(), half.begin(), half.end());
            courses.push_back(whole);
        }
    }
    return courses;
}

/// From the temporal lobe around the Sylvian fissure to the frontal lobe.
std::vector<Course> arcuate() {
    std::vector<Course> courses;
    for (int i = 0; i < 5; ++i) {
        const double s = (i - 2) / 2.0;
        courses.push_back({{{52 + s, -6 + 8 * s, -14 - 3 * s}, 7},
                           {{48 + s, -32 + 4 * s, -4}, 7},
                           {{42 + 2 * s, -50 + 2 * s, 10}, 7},
                           {{36 + 2 * s, -46 + 3 * s, 27 - s}, 7},
                           {{31 + 2 * s, -30, 32 + s}, 7},
                           {{30 + 2 * s, -18, 32 + 2 * s}, 7},
                           {{32 + 2 * s, -4, 31 + 2 * s}, 7},
                           {{40 + 2 * s, 18, 24 + 4 * s}, 7},
                           {{47 + s, 28 - 2 * s, 14 + 6 * s}, 7}});
    }
    return courses;
}

/// Over the corpus callosum and around its back into the temporal lobe.
std::vector<Course> cingulum() {
    std::vector<Course> courses;
    for (int i = 0; i < 2; ++i) {
        const double s = i - 0.5;
        courses.push_back({{{9, 38, -6 - 3 * s}, 5},
                           {{9.5, 42 + 3 * s, 8}, 5},
                           {{9.5, 32 + 2 * s, 24 + 2 * s}, 5},
                           {{9.5, 6, 36 + 3 * s}, 5},
                           {{9.5, -22, 36 + 3 * s}, 5},
                           {{10, -46 - 2 * s, 27 + 2 * s}, 5},
                           {{14, -54 - 2 * s, 10}, 5},
                           {{21, -42, -6 - s}, 5},
                           {{26, -20, -18 - s}, 5}});
    }
    return courses;
}

/// Shifts each control point by up to 1 mm, alike in all strands, so that a sheet stays a sheet; near the midline not in x.
void shift(std::vector<Course>& courses, std::uint64_t seed, std::uint64_t bundle) {
    for (Course& course : courses) {
        for (std::size_t i = 0; i < course.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const double offset = 2 * uniform(seed, bundle * 1000 + i * 3 + static_cast<std::uint64_t>(axis)) - 1;
                if (axis != 0 || std::abs(course[i].p_mm.x) > 12) course[i].p_mm[axis] += offset;
            }
        }
    }
}

/// Shifts the whole sheet by up to 1 mm in y and z, so that it stays symmetric.
void shiftSheet(std::vector<Course>& courses, std::uint64_t seed) {
    const glm::dvec3 offset(0, 2 * uniform(seed, 1) - 1, 2 * uniform(seed, 2) - 1);
    for (Course& course : courses) {
        for (ControlPoint& point : course) point.p_mm += offset;
    }
}

Bundle bundle(int id, const std::string& name, double fraction, std::vector<Course> courses, bool left) {
    Bundle result{id, name, fraction, {}};
    for (Course& course : courses) {
        for (ControlPoint& point : course) point.p_mm.x *= left ? -1 : 1;
        result.strands.push_back(strandAlong(course));
    }
    return result;
}

}  // namespace

std::vector<Bundle> bundles(std::uint64_t seed) {
    std::vector<Course> callosal = callosum(), motor = corticospinal(), arched = arcuate(), girdle = cingulum();
    shiftSheet(callosal, seed);
    shift(motor, seed, 2);
    shift(arched, seed, 4);
    shift(girdle, seed, 6);
    std::vector<Bundle> all;
    all.push_back(bundle(kCorpusCallosum, "corpus_callosum", 0.9, callosal, false));
    all.push_back(bundle(kCorticospinalLeft, "corticospinal_tract_left", 0.9, motor, true));
    all.push_back(bundle(kCorticospinalRight, "corticospinal_tract_right", 0.9, motor, false));
    all.push_back(bundle(kArcuateLeft, "arcuate_fasciculus_left", 0.8, arched, true));
    all.push_back(bundle(kArcuateRight, "arcuate_fasciculus_right", 0.8, arched, false));
    all.push_back(bundle(kCingulumLeft, "cingulum_left", 0.8, girdle, true));
    all.push_back(bundle(kCingulumRight, "cingulum_right", 0.8, girdle, false));
    return all;
}

}  // namespace radiata::phantom
