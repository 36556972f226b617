// Streamlines of the test brain: step, courses, groups, the same for the same seed.
#include "build/phantom_tracts.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace radiata {
namespace {

model::Tractogram tracts(std::uint64_t seed, const PhantomTractOptions& options) {
    PhantomOptions brain;
    brain.seed = seed;
    brain.size = 24;
    const Phantom phantom(brain);
    return model::readAll(*phantomTracts(phantom, options));
}

TEST(PhantomTracts, HaveTheStepAndEveryFibreIsInTheGroupOfItsBundle) {
    const model::Tractogram all = tracts(1, {500, 0.25});
    EXPECT_EQ(all.fibreCount(), 500U);
    EXPECT_NEAR(all.measures.constantStepMm(), 0.25, 1e-5);
    EXPECT_EQ(all.measures.empty_fibres, 0U);
    EXPECT_GT(all.measures.length_mm / 500, 50);
    ASSERT_EQ(all.groups.size(), 7U);
    std::size_t members = 0;
    for (const model::FibreGroup& group : all.groups) {
        EXPECT_GT(group.fibres.size(), 5U) << group.name;
        members += group.fibres.size();
        for (const std::uint32_t f : group.fibres) {
            EXPECT_EQ(all.fibres.fibre_values[0][f], all.fibres.fibre_values[0][group.fibres.front()]);
        }
    }
    EXPECT_EQ(members, 500U);
}

TEST(PhantomTracts, RunWhereTheirBundleIsAndAlongIt) {
    PhantomOptions brain;
    brain.size = 24;
    const Phantom phantom(brain);
    const model::Tractogram all = model::readAll(*phantomTracts(phantom, {200, 0.5}));
    std::size_t inside = 0, along = 0, count = 0;
    for (std::size_t f = 0; f < all.fibreCount(); ++f) {
        const auto fibre = all.fibre(f);
        for (std::size_t i = 1; i + 1 < fibre.size(); i += 7) {
            ++count;
            const phantom::FieldSample sample = phantom.field().sample(glm::dvec3(fibre[i]));
            for (std::size_t s = 0; s < sample.count; ++s) {
                if (sample.bundles[s].id != static_cast<int>(all.fibres.fibre_values[0][f])) continue;
                ++inside;
                const glm::dvec3 tangent = glm::normalize(glm::dvec3(fibre[i + 1]) - glm::dvec3(fibre[i - 1]));
                along += std::abs(glm::dot(tangent, sample.bundles[s].tangent)) > 0.8 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(inside, count * 95 / 100);
    EXPECT_GT(along, inside * 9 / 10);
}

TEST(PhantomTracts, AreTheSameForTheSameSeedAndInAnyBatches) {
    const model::Tractogram a = tracts(3, {300, 0.5}), b = tracts(3, {300, 0.5}), c = tracts(4, {300, 0.5});
    EXPECT_EQ(a.fibres.points, b.fibres.points);
    EXPECT_NE(a.fibres.points, c.fibres.points);
    PhantomOptions brain;
    brain.seed = 3;
    brain.size = 24;
    const Phantom phantom(brain);
    const auto source = phantomTracts(phantom, {300, 0.5});
    model::FibreBatch batch, joined;
    joined.clear(1, 1);
    while (source->read(batch, 1)) append(joined, batch);
    EXPECT_EQ(joined.points, a.fibres.points);
    EXPECT_EQ(joined.vertex_values, a.fibres.vertex_values);
}

TEST(PhantomTracts, RefuseWhatCannotBe) {
    PhantomOptions brain;
    brain.size = 8;
    const Phantom phantom(brain);
    EXPECT_THROW(phantomTracts(phantom, {0, 0.5}), Error);
    EXPECT_THROW(phantomTracts(phantom, {1ULL << 32, 0.5}), Error);
    EXPECT_THROW(phantomTracts(phantom, {10, 0}), Error);
}

}  // namespace
}  // namespace radiata
