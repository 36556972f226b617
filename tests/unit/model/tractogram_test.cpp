// Batches, whole tractograms and what is measured about them.
#include "model/tractogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "model/tractogram_subset.h"

namespace radiata::model {
namespace {

/// Fibres of 0, 1, 2, 3, ... points, 0.5 mm apart along a turning line, with one column of each kind.
Tractogram example(std::size_t fibres) {
    Tractogram all;
    all.header.source = "example";
    all.header.vertex_columns = {{"fa", 1}, {"rgb", 3}};
    all.header.fibre_columns = {{"weight", 1}};
    all.fibres.clear(2, 1);
    for (std::size_t f = 0; f < fibres; ++f) {
        glm::dvec3 p(f, -60.0, 80.0);
        for (std::size_t i = 0; i < f; ++i) {
            const double angle = 0.1 * static_cast<double>(i);
            all.fibres.points.push_back(p);
            p += 0.5 * glm::dvec3(std::cos(angle), std::sin(angle), 0);
            all.fibres.vertex_values[0].push_back(static_cast<float>(i));
            for (int c = 0; c < 3; ++c)
                all.fibres.vertex_values[1].push_back(static_cast<float>(f + i) + 0.1F * static_cast<float>(c));
        }
        all.fibres.fibre_values[0].push_back(static_cast<float>(f) / 8);
        all.fibres.offsets.push_back(all.fibres.points.size());
    }
    all.groups.push_back({"odd", {1, 3, 5}, {}, {}});
    return all;
}

TEST(Tractogram, ComesBackTheSameThroughBatchesOfAnySize) {
    const Tractogram all = example(40);
    for (const std::size_t wanted : {std::size_t{1}, std::size_t{7}, std::size_t{100}, std::size_t{100000}}) {
        const auto source = sourceOf(all);
        FibreBatch batch, joined;
        joined.clear(2, 1);
        while (source->read(batch, wanted)) {
            EXPECT_EQ(batch.first_fibre, joined.fibreCount());
            EXPECT_EQ(batch.first_point, joined.points.size());
            EXPECT_EQ(batch.offsets.front(), 0U);
            EXPECT_EQ(batch.offsets.back(), batch.points.size());
            append(joined, batch);
        }
        EXPECT_EQ(batch.fibreCount(), 0U);
        EXPECT_EQ(joined.points, all.fibres.points);
        EXPECT_EQ(joined.offsets, all.fibres.offsets);
        EXPECT_EQ(joined.vertex_values, all.fibres.vertex_values);
        EXPECT_EQ(joined.fibre_values, all.fibres.fibre_values);
    }
}

TEST(Tractogram, IsMeasuredWhileItIsRead) {
    const Tractogram all = example(40);
    const Tractogram read = readAll(*sourceOf(all));
    EXPECT_EQ(read.header.fibre_count, 40U);
    EXPECT_EQ(read.header.point_count, 780U);
    EXPECT_EQ(read.measures.empty_fibres, 1U);
    EXPECT_EQ(read.measures.segments, 780U - 39U);
    EXPECT_EQ(read.measures.longest_fibre_points, 39U);
    EXPECT_NEAR(read.measures.length_mm, 0.5 * 741, 1e-3);  // coordinates are rounded to float
    EXPECT_NEAR(read.measures.longest_fibre_mm, 19, 1e-4);
    EXPECT_NEAR(read.measures.constantStepMm(), 0.5, 1e-6);
    EXPECT_EQ(read.measures.bounds_min.y, -60);
    EXPECT_EQ(read.groups.at(0).name, "odd");
}

TEST(Tractogram, AShorterLastSegmentLeavesTheStepConstantAndAnInnerOneDoesNot) {
    Tractogram all = example(10);
    glm::vec3& last = all.fibres.points.back();
    last = glm::mix(last, *(all.fibres.points.end() - 2), 0.6F);
    EXPECT_NEAR(readAll(*sourceOf(all)).measures.constantStepMm(), 0.5, 1e-6);
    glm::vec3& inner = *(all.fibres.points.end() - 3);
    inner = glm::mix(inner, *(all.fibres.points.end() - 4), 0.05F);
    EXPECT_EQ(readAll(*sourceOf(all)).measures.constantStepMm(), 0);
    EXPECT_EQ(readAll(*sourceOf(example(2))).measures.constantStepMm(), 0) << "one point has no step";
}

TEST(Tractogram, NamesWhatItHasWhenAskedForSomethingElse) {
    const Tractogram all = example(3);
    EXPECT_EQ(all.vertexColumn("rgb"), 1U);
    EXPECT_EQ(all.fibreColumn("weight"), 0U);
    EXPECT_EQ(all.group("odd").fibres.size(), 3U);
    EXPECT_THAT([&] { all.vertexColumn("md"); },
                testing::ThrowsMessage<Error>("example: there is no per-vertex column 'md'; there are: fa, rgb"));
    EXPECT_THAT([&] { all.group("even"); }, testing::ThrowsMessage<Error>("example: there is no group 'even'; there are: odd"));
}

TEST(Tractogram, IsNotReadBeyondTheMemoryThatWasAllowed) {
    const Tractogram all = example(40);
    EXPECT_THAT([&] { readAll(*sourceOf(all), 1000); },
                testing::ThrowsMessage<Error>("example: its fibres need more than 1000 bytes of memory"));
}

TEST(Tractogram, SomeFibresAreATractogramOfTheirOwn) {
    const Tractogram all = example(40);
    const std::vector<std::uint32_t> chosen{0, 3, 5, 6, 39};
    const Tractogram some = readAll(*subsetOf(sourceOf(all), chosen));
    ASSERT_EQ(some.fibreCount(), chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const auto own = some.fibre(i), original = all.fibre(chosen[i]);
        EXPECT_TRUE(std::equal(own.begin(), own.end(), original.begin(), original.end())) << i;
        EXPECT_EQ(some.fibres.fibre_values[0][i], all.fibres.fibre_values[0][chosen[i]]);
        for (std::size_t k = 0; k < 3 * own.size(); ++k) {
            EXPECT_EQ(some.fibres.vertex_values[1][3 * some.fibres.offsets[i] + k],
                      all.fibres.vertex_values[1][3 * all.fibres.offsets[chosen[i]] + k]);
        }
    }
    EXPECT_EQ(some.group("odd").fibres, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(readAll(*subsetOf(sourceOf(all), {})).fibreCount(), 0U);
}

}  // namespace
}  // namespace radiata::model
