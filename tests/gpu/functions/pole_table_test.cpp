// The pole-frame table: circles of rays of a camera, and first hits on them, against the reference. Near, inside the glyph, far
// away and orthographic, with the camera in the poles of the basis too.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "gpu/functions/march_runner.h"
#include "plan/camera_rays.h"
#include "reference/camera_rays.h"
#include "shaders/test/camera_io.glsl"

namespace radiata {
namespace {

using namespace test;

const std::vector<ShLayout> kLayouts{{2, false}, {8, false}, {16, false}, {4, true}, {16, true}};
constexpr int kWidth = 800, kHeight = 600;
const glm::dvec3 kCentre{60, -40, 30};  // of a glyph of radius about 1, world mm

struct View {
    std::vector<float> pole_and_table;
    std::vector<RayInput> rays;  // about the glyph's centre
};

model::Camera cameraAt(const glm::dvec3& towards_eye, double distance, bool perspective) {
    model::Camera camera;
    camera.eye_mm = kCentre + distance * glm::normalize(towards_eye);
    camera.target_mm = distance < 1 ? kCentre - glm::normalize(towards_eye) : kCentre;
    camera.up = {0.3, 1, 0.2};
    camera.perspective = perspective;
    camera.height_mm = 4;
    camera.field_of_view_deg = 2 * std::atan(2 / distance) * 180 / std::numbers::pi;
    return camera;
}

std::vector<model::Camera> cameras() {
    std::vector<model::Camera> all;
    for (const glm::dvec3& way : {glm::dvec3(0, 0, 1), glm::dvec3(1e-6, 0, -1), glm::dvec3(-1, 0.4, 0.3)}) {
        all.push_back(cameraAt(way, 10, false));
        for (const double distance : {0.3, 1.5, 10.0, 1000.0, 1e6}) all.push_back(cameraAt(way, distance, true));
    }
    return all;
}

class PoleTableFunctions : public MarchTest {
protected:
    /// Rays through points within 1.2 of the centre, in the float32 that the renderer uses.
    View view(ShLayout layout, const std::vector<float>& glyph, const model::Camera& camera, std::mt19937& random) {
        const plan::SceneBounds scene{kCentre - 2.0, kCentre + 2.0};
        const plan::RebasedCamera rebased = plan::rebaseCamera(camera, scene, kHeight);
        const shader::CameraRays& rays = rebased.rays;
        const glm::vec3 centre(kCentre - rebased.reference_mm);
        View view;
        view.pole_and_table =
            runFunctionToFloats("test_pole_table_" + nameOf(layout), {}, std::vector<shader::PoleInput>{{rays, centre}},
                                3 + poleTableCount(layout.lmax, layout.full), glyph);
        std::uniform_real_distribution<double> unit(-1, 1);
        while (view.rays.size() < 150) {
            const glm::dvec3 offset = 1.2 * glm::dvec3(unit(random), unit(random), unit(random));
            const glm::dvec3 pixel = reference::projectPoint(camera, kWidth, kHeight, kCentre + offset);
            if (camera.perspective && pixel.z < 0.05) continue;
            const float right = float(pixel.x) - 0.5F * kWidth, up = 0.5F * kHeight - float(pixel.y);
            const glm::vec3 origin = right * rays.step_right + up * rays.step_up;
            const glm::vec3 way = origin * rays.inverse_distance + rays.forward;
            const float t_min = camera.perspective ? rays.near_depth * glm::length(way) : -4.0F;
            view.rays.push_back({origin - centre, t_min, glm::normalize(way), std::uint32_t(random() % 2)});
        }
        return view;
    }

    std::vector<float> circles(ShLayout layout, const std::vector<float>& glyph, const View& view, std::uint32_t from_table) {
        std::vector<float> shared = glyph;
        shared.push_back(0);
        shared.insert(shared.end(), view.pole_and_table.begin(), view.pole_and_table.end());
        return runFunctionToFloats("test_circle_" + nameOf(layout), {from_table}, view.rays, circleWidth(layout), shared);
    }

    /// Floats per output of test_circle: e, then the coefficients.
    static std::size_t circleWidth(ShLayout layout) { return 3 + 2 * std::size_t(layout.lmax / layout.step() + 1); }

    /// Largest |g - f| over a number of angles of all circles.
    static double worstError(const reference::ShFunction& f, const std::vector<RayInput>& rays,
                             const std::vector<float>& circles) {
        const ShLayout layout = f.layout();
        double worst = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const float* circle = &circles[i * circleWidth(layout)];
            const glm::dvec3 d(rays[i].direction), e(circle[0], circle[1], circle[2]);
            for (int j = 0; j < 24; ++j) {
                const double phi = j * std::numbers::pi / 12;
                double g = 0;
                for (int h = 0; h <= layout.lmax / layout.step(); ++h) {
                    const double angle = h * layout.step() * phi;
                    g += double(circle[3 + 2 * h]) * std::cos(angle) + double(circle[4 + 2 * h]) * std::sin(angle);
                }
                worst = std::max(worst, std::abs(g - f(std::sin(phi) * e - std::cos(phi) * d)));
            }
        }
        return worst;
    }
};

TEST_F(PoleTableFunctions, CirclesAreThoseOfTheReference) {
    std::mt19937 random(21);
    for (const ShLayout layout : kLayouts) {
        const std::vector<float> glyph = randomGlyph(random, layout);
        const reference::ShFunction f(layout, glyph);
        double sum = 0, worst_table = 0, worst_samples = 0;
        for (const float c : glyph) sum += std::abs(c);
        for (const model::Camera& camera : cameras()) {
            const View view = this->view(layout, glyph, camera, random);
            const double table = worstError(f, view.rays, circles(layout, glyph, view, 1)) / sum;
            EXPECT_LT(table, 2e-6) << nameOf(layout) << " camera " << camera.eye_mm.x << " " << camera.eye_mm.y << " "
                                   << camera.eye_mm.z << " perspective " << camera.perspective;
            worst_table = std::max(worst_table, table);
            worst_samples = std::max(worst_samples, worstError(f, view.rays, circles(layout, glyph, view, 0)) / sum);
        }
        std::printf("%s: circles off by %.2g from the table and %.2g from samples, of the sum of |coefficients|\n",
                    nameOf(layout).c_str(), worst_table, worst_samples);
        EXPECT_LT(worst_samples, 2e-6) << nameOf(layout);
    }
}

TEST_F(PoleTableFunctions, FirstHitsAreThoseOfTheReference) {
    std::mt19937 random(22);
    for (const ShLayout layout : kLayouts) {
        const BoundsEvaluator evaluator(layout);
        const std::vector<float> glyph = randomGlyph(random, layout);
        const float radius = certifiedRadius(evaluator, glyph);
        Comparison sum;
        for (const model::Camera& camera : cameras()) {
            const View view = this->view(layout, glyph, camera, random);
            const auto outputs = marchFromTable(layout, glyph, radius, view.pole_and_table, view.rays);
            const Comparison part = compare(glyph, layout, view.rays, outputs, 1e-4);
            EXPECT_EQ(part.wrong, 0) << nameOf(layout) << " camera " << camera.eye_mm.x << " " << camera.eye_mm.y << " "
                                     << camera.eye_mm.z << " perspective " << camera.perspective;
            sum = {sum.rays + part.rays, sum.wrong + part.wrong, std::max(sum.worst, part.worst)};
        }
        std::printf("%s by table: %d rays, %d wrong, worst error %.2g\n", nameOf(layout).c_str(), sum.rays, sum.wrong,
                    sum.worst);
        EXPECT_GT(sum.rays, 2500);
    }
}

}  // namespace
}  // namespace radiata
