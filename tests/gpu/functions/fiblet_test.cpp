// Fiblets decoded on the device and on the CPU against the twin in double precision: 0.2 um on fiblets from streamlines of up
// to 120 mm about the origin, all widths and caps, rear and front first directions, shortened last segments.
#include <algorithm>
#include <bit>
#include <cstdio>

#include "build/fiblet_code.h"
#include "build/fiblet_encode.h"
#include "gpu/functions/function_runner.h"
#include "reference/fiblet.h"
#include "shaders/test/fiblet_io.glsl"
#include "support/random_fibres.h"

namespace radiata {
namespace {

class FibletFunctions : public test::FunctionTest {
protected:
    void compare(const model::FibletSet& set, const char* name) {
        std::vector<shader::FibletPointInput> inputs;
        std::vector<glm::dvec3> expected;
        std::vector<glm::dvec3> on_cpu;
        int widths[4] = {};
        for (std::uint32_t f = 0; f < set.heads.size(); ++f) {
            const model::FibletHead& head = set.heads[f];
            ++widths[head.shape >> 6 & 3];
            const std::uint32_t first = set.pages[f / shader::FIBLET_PAGE].first_word + model::fibletWord(head);
            const auto points = reference::fibletPoints({head.place0, head.place1, head.direction, head.fibre, head.shape},
                                                        std::span(set.codes).subspan(first), set.codec.cell_mm,
                                                        set.codec.step_mm, set.codec.cap_ratio);
            glm::vec3 offsets[64];
            ASSERT_EQ(decodeOffsets(head, set.codes.data() + first, set.codec, offsets), points.size());
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                inputs.push_back({head, first, i});
                expected.push_back(points[i]);
                on_cpu.push_back(fibletStart(head, set.codec) + glm::dvec3(offsets[i]));
            }
        }
        std::vector<float> shared(18 + set.codes.size());
        std::copy_n(reinterpret_cast<const float*>(&set.codec), 18, shared.begin());
        std::transform(set.codes.begin(), set.codes.end(), shared.begin() + 18,
                       [](std::uint32_t w) { return std::bit_cast<float>(w); });
        const auto points = runFunction<glm::vec3>("test_fiblet", {}, inputs, shared);
        double device_um = 0, cpu_um = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            device_um = std::max(device_um, 1e3 * glm::distance(glm::dvec3(points[i]), expected[i]));
            cpu_um = std::max(cpu_um, 1e3 * glm::distance(on_cpu[i], expected[i]));
        }
        std::printf("%s: %zu points, widths %d %d %d %d, device %.4f um, CPU %.4f um\n", name, points.size(), widths[0],
                    widths[1], widths[2], widths[3], device_um, cpu_um);
        EXPECT_LT(device_um, 0.2) << name;
        EXPECT_LT(cpu_um, 0.1) << name;
    }
};

TEST_F(FibletFunctions, DecodeAsTheTwinDoes) {
    const test::Fibres gentle = test::randomFibres(1, 40, 400, 0.1, 0.13);
    for (const double bound : {0.7, 2.0, 4.0, 30.0}) {
        compare(encodeFiblets(gentle.points, gentle.offsets, {.bound_um = bound}), "gentle");
    }
    const test::Fibres wild = test::randomFibres(2, 40, 200, 0.5, 3.14159265358979);
    compare(encodeFiblets(wild.points, wild.offsets, {.bound_um = 100}), "any turn");
}

}  // namespace
}  // namespace radiata
