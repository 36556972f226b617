// The cylinder's box holds the whole glyph, is as wide as it is deep, and is never smaller than the certified one made so,
// which it replaces only in comparisons.
#include "build/cylinder_box.h"

#include <random>

#include <gtest/gtest.h>

#include "math/sh_evaluate.h"

namespace radiata {
namespace {

TEST(CylinderBoxes, HoldTheGlyphInEveryLayout) {
    std::mt19937_64 random(71);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::normal_distribution<double> normal;
    for (const ShLayout layout :
         {ShLayout{2, false}, ShLayout{4, false}, ShLayout{8, false}, ShLayout{16, false}, ShLayout{5, true}}) {
        const CylinderBoxes boxes(layout);
        for (int glyph = 0; glyph < 20; ++glyph) {
            std::vector<float> coefficients(layout.count());
            for (float& value : coefficients) value = unit(random);
            glm::vec3 low, high;
            boxes.box(coefficients, low, high);
            EXPECT_EQ(low, -high);
            EXPECT_EQ(high.x, high.y);
            std::vector<double> basis(layout.count());
            glm::dvec3 largest(0);
            for (int i = 0; i < 2000; ++i) {
                const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
                evaluateSh(layout, d, basis);
                double f = 0;
                for (std::size_t j = 0; j < basis.size(); ++j) f += basis[j] * double{coefficients[j]};
                largest = glm::max(largest, glm::abs(f * d));
            }
            EXPECT_TRUE(glm::all(glm::lessThanEqual(largest, glm::dvec3(high))));
        }
    }
}

TEST(CylinderBoxes, OfASphereIsTight) {
    std::vector<float> sphere(15, 0.0F);
    sphere[0] = 3.5449077F;  // radius 1
    glm::vec3 low, high;
    CylinderBoxes({4, false}).box(sphere, low, high);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(high[axis], 1, 1e-4);
}

}  // namespace
}  // namespace radiata
