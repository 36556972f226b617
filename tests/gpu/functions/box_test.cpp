// The slab test against exact whole-number arithmetic: never a miss, not even of a box without thickness or of a ray in a face;
// a box is entered in vain only if it is missed by less than 2e-6 of the parameter.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>

#include "gpu/functions/function_runner.h"
#include "shaders/test/box_io.glsl"

namespace radiata {
namespace {

using shader::BoxInput;

/// Coordinates in units of 2^-16, directions in units of 2^-20: floats hold them exactly, and products fit in 64 bits.
struct WholeBox {
    std::int64_t origin[3], direction[3], low[3], high[3];
};

constexpr std::int64_t kUnit = 1 << 16, kDirectionUnit = 1 << 20;

BoxInput toFloats(const WholeBox& x) {
    BoxInput out{};
    for (int i = 0; i < 3; ++i) {
        out.origin[i] = float(x.origin[i]) / float(kUnit);
        out.direction[i] = float(x.direction[i]) / float(kDirectionUnit);
        out.low[i] = float(x.low[i]) / float(kUnit);
        out.high[i] = float(x.high[i]) / float(kUnit);
    }
    return out;
}

struct Fraction {
    std::int64_t over = 0, under = 1;
    bool operator<(const Fraction& other) const { return over * other.under < other.over * under; }
    double value() const { return double(over) / double(under) * double(kDirectionUnit) / double(kUnit); }
};

struct Span {
    bool overlaps = true;
    double gap = 0;  // entry minus exit; of no meaning if a slab that the ray is parallel to excludes it
    double size = 0;
    bool outside_parallel = false;
};

Span exactSpan(const WholeBox& x) {
    Span span;
    Fraction entry, leave;
    bool first = true;
    for (int i = 0; i < 3; ++i) {
        if (x.direction[i] == 0) {
            span.outside_parallel |= x.origin[i] < x.low[i] || x.origin[i] > x.high[i];
            continue;
        }
        const std::int64_t sign = x.direction[i] < 0 ? -1 : 1;
        const Fraction to_low{sign * (x.low[i] - x.origin[i]), sign * x.direction[i]};
        const Fraction to_high{sign * (x.high[i] - x.origin[i]), sign * x.direction[i]};
        const Fraction& in = sign > 0 ? to_low : to_high;
        const Fraction& out = sign > 0 ? to_high : to_low;
        if (first || entry < in) entry = in;
        if (first || out < leave) leave = out;
        first = false;
    }
    span.overlaps = !span.outside_parallel && !(leave < entry);
    span.gap = entry.value() - leave.value();
    span.size = std::max(std::abs(entry.value()), std::abs(leave.value()));
    return span;
}

class BoxFunctions : public test::FunctionTest {
protected:
    void compare(const std::vector<WholeBox>& cases, const char* name) {
        std::vector<BoxInput> inputs;
        for (const WholeBox& x : cases) inputs.push_back(toFloats(x));
        const auto spans = runFunction<glm::vec2>("test_box", {}, inputs);
        int hits = 0, missed = 0, in_vain = 0, wrong = 0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const Span expected = exactSpan(cases[i]);
            const bool found = spans[i].x <= spans[i].y;
            hits += expected.overlaps;
            missed += expected.overlaps && !found;
            in_vain += found && !expected.overlaps;
            wrong += found && !expected.overlaps && (expected.outside_parallel || expected.gap > 2e-6 * expected.size);
        }
        std::printf("%s: %zu rays, %d hits, %d missed, %d in vain\n", name, cases.size(), hits, missed, in_vain);
        EXPECT_GT(hits, int(cases.size() / 20)) << name;
        EXPECT_EQ(missed, 0) << name;
        EXPECT_EQ(wrong, 0) << name;
    }
};

WholeBox randomBox(std::mt19937& random) {
    std::uniform_int_distribution<std::int64_t> place(-8 * kUnit, 8 * kUnit), way(-kDirectionUnit, kDirectionUnit);
    WholeBox x{};
    for (int i = 0; i < 3; ++i) {
        const std::int64_t a = place(random), b = place(random);
        x.low[i] = std::min(a, b);
        x.high[i] = std::max(a, b);
        x.origin[i] = place(random);
        x.direction[i] = way(random);
    }
    return x;
}

TEST_F(BoxFunctions, NeverMissAnyBox) {
    std::mt19937 random(16);
    std::vector<WholeBox> cases(20000);
    for (WholeBox& x : cases) x = randomBox(random);
    compare(cases, "any box");
}

TEST_F(BoxFunctions, NeverMissWithRaysParallelToAxesAndOriginsOnFaces) {
    std::mt19937 random(17);
    std::vector<WholeBox> cases(20000);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        WholeBox& x = cases[i] = randomBox(random);
        x.direction[i % 3] = 0;
        if (i % 2 == 0) x.direction[(i + 1) % 3] = 0;
        if (x.direction[0] == 0 && x.direction[1] == 0 && x.direction[2] == 0) x.direction[i % 3] = kDirectionUnit;
        for (int axis = 0; axis < 3; ++axis) {
            const auto choice = random() % 4;
            if (choice == 0) x.origin[axis] = x.low[axis];
            if (choice == 1) x.origin[axis] = x.high[axis];
        }
    }
    compare(cases, "parallel to axes");
}

TEST_F(BoxFunctions, NeverMissBoxesWithoutThicknessNorTheirEdges) {
    // Each ray goes exactly through a corner of its box, forwards or backwards; boxes have 0 to 3 dimensions.
    std::mt19937 random(18);
    std::uniform_int_distribution<std::int64_t> small(-7, 7), length(-12000, 12000);
    std::vector<WholeBox> cases(20000);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        WholeBox& x = cases[i] = randomBox(random);
        const std::int64_t steps = length(random);
        bool still = true;
        for (int axis = 0; axis < 3; ++axis) {
            if ((i >> axis) % 2 == 0) x.high[axis] = x.low[axis];
            std::int64_t way = small(random);
            if (axis == 2 && still && way == 0) way = 1;
            still = still && way == 0;
            x.direction[axis] = way * (kDirectionUnit / 16);
            x.origin[axis] = (random() % 2 ? x.low[axis] : x.high[axis]) - steps * way;
        }
    }
    compare(cases, "corners");
}

}  // namespace
}  // namespace radiata
