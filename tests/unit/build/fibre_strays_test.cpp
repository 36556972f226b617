// Fibres far from all others: named with their place, left out where that is asked for, and told of; and fibres whose steps
// vary, walked for formats that keep one step.
#include "build/fibre_strays.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <unistd.h>

#include "base/error.h"
#include "build/even_steps.h"
#include "build/fiblet_encode.h"
#include "build/fiblet_source.h"
#include "ingest/fiblet_conversion.h"
#include "io/fiblet_file.h"
#include "support/random_fibres.h"

namespace radiata {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// 50 fibres near the centre, with a column of each kind, and then one at x = `far`.
model::Tractogram withStray(float far, std::size_t strays = 1) {
    test::Fibres fibres = test::randomFibres(5, 50, 80, 0.2, 0.1);
    for (std::size_t i = 0; i < strays; ++i) fibres.add({glm::vec3(far, 0, 0), glm::vec3(far, 0.2F, 0)});
    fibres.add({glm::vec3(1, 2, 3), glm::vec3(1, 2.2F, 3)});
    model::Tractogram all;
    all.header.source = "stray.tck";
    all.header.remarks = "Something was assumed. ";
    all.header.vertex_columns = {{"v", 2}};
    all.header.fibre_columns = {{"f", 1}};
    all.fibres.clear(1, 1);
    all.fibres.points = fibres.points;
    all.fibres.offsets = fibres.offsets;
    for (std::size_t i = 0; i < 2 * fibres.points.size(); ++i) all.fibres.vertex_values[0].push_back(float(i));
    for (std::size_t f = 0; f < all.fibreCount(); ++f) all.fibres.fibre_values[0].push_back(float(f));
    all.groups = {{"g", {0, 50}, {}, {}}};
    all.measures.damaged_fibres = 2;
    return all;
}

std::string refusal(const model::Tractogram& tracts, const FibletOptions& options) {
    try {
        encodeFiblets(tracts, options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kInvalidArgument);
        return error.what();
    }
    return "nothing refused";
}

TEST(FibreStrays, AreNamedWithTheirPlaceAndWhatHelps) {
    EXPECT_THAT(refusal(withStray(15'000), {}), AllOf(HasSubstr("stray.tck: fibre 50 reaches (15000.0, 0.2, 0.0) mm, 14999 mm"),
                                                      HasSubstr("all but 1 stay within "),
                                                      HasSubstr("2^20 cells along the extent of 15"), HasSubstr("--within ")));
    // 5 m are not too much; nor are 15 for a larger bound.
    EXPECT_EQ(refusal(withStray(5'000), {}), "nothing refused");
    EXPECT_EQ(refusal(withStray(15'000), {.bound_um = 40}), "nothing refused");
    // Of so many, none is a stray.
    const std::string many = refusal(withStray(15'000, 40), {.leave_strays = true});
    EXPECT_THAT(many, AllOf(HasSubstr("too much for a bound of 10 um; allow "), HasSubstr("whether the coordinates")));
    // A bound that no cells of a brain hold.
    EXPECT_THAT(refusal(withStray(60), {.bound_um = 0.05}), HasSubstr("too much for a bound of 0.05 um; allow 0."));
}

TEST(FibreStrays, AreLeftOutButKeepTheirNumbersAndAreToldOf) {
    const model::Tractogram all = withStray(15'000);
    const fs::path file = fs::temp_directory_path() / ("radiata_strays_" + std::to_string(::getpid()) + ".fiblet");
    FibletOptions within, leave;
    within.within_mm = 500;
    leave.leave_strays = true;
    for (const FibletOptions& options : {within, leave}) {
        const model::FibletSet set = encodeFiblets(all, options);
        std::string said;
        const ingest::Conversion done =
            ingest::convertToFiblets([&] { return model::sourceOf(all); }, "a", file, {.fiblets = options}, {},
                                     [&](const std::string& sentence) { said += sentence; });
        EXPECT_EQ(said.empty(), !options.leave_strays) << said;
        const model::FibletSet read = io::readFiblets(file);
        EXPECT_EQ(read.codes, set.codes);
        EXPECT_EQ(read.remarks, set.remarks);
        EXPECT_THAT(read.remarks,
                    AllOf(testing::StartsWith("Something was assumed. 1 fibre reaches farther than "),
                          HasSubstr("is left out; it keeps its number. 2 fibres are left out, but keep their numbers: they "
                                    "have coordinates that are not finite"),
                          testing::EndsWith("centre.")));
        EXPECT_EQ(sourceOf(read)->header().remarks, read.remarks);
        ASSERT_EQ(read.fibres(), 52U);
        EXPECT_EQ(read.fibre_first[50], read.fibre_first[51]) << "the stray has no fiblets";
        EXPECT_EQ(read.groups[0].fibres, (std::vector<std::uint32_t>{0, 50}));
        EXPECT_EQ(read.fibre_columns[0].values[51], 51);
        // The last fibre's values are its own, two components for each of its two points.
        const model::Tractogram back = model::readAll(*sourceOf(read));
        const double first = 2.0 * double(all.fibres.offsets[51]);
        ASSERT_EQ(back.fibre(51).size(), 2U);
        EXPECT_NEAR(double(back.fibres.vertex_values[0][2 * back.fibres.offsets[51]]), first, 1e-3 * first);
    }
    fs::remove(file);
    EXPECT_EQ(encodeFiblets(withStray(60), {}).remarks.find("reaches"), std::string::npos);
}

TEST(FibreStrays, AreFoundAmongTwoAndInAnyBatches) {
    model::Tractogram two;
    two.header.source = "two";
    two.fibres.points = {{99'000, 0, 0}, {99'000, 1, 0}, {5, 0, 0}, {5, 1, 0}};
    two.fibres.offsets = {0, 2, 4};
    EXPECT_EQ(middleOfFibres(*model::sourceOf(two), 1), glm::dvec3(5, 0, 0));
    const model::FibletSet set = encodeFiblets(two, {.leave_strays = true});
    EXPECT_EQ(set.heads.size(), 1U);
    EXPECT_EQ(set.heads[0].fibre, 1U);
    EXPECT_EQ(middleOfFibres(*model::sourceOf({}), 1), glm::dvec3(0));
}

/// A wave of steps that grow from 0.1 to 0.5 mm.
std::vector<glm::vec3> growing() {
    std::vector<glm::vec3> points;
    for (double x = 0, i = 0; i < 100; x += 0.1 + 0.004 * i, ++i) points.emplace_back(x, 3 * std::sin(x / 4), 20);
    return points;
}

TEST(EvenSteps, WalkFibresOfVaryingStepsToTheirEnds) {
    const std::vector<glm::vec3> fibre = growing();
    EXPECT_FALSE(hasEvenSteps(fibre));
    Walk walk;
    ASSERT_TRUE(walkEvenly(fibre, {0, 50, 65537}, walk));
    EXPECT_TRUE(hasEvenSteps(walk.points));
    EXPECT_EQ(walk.points.front(), fibre.front());
    EXPECT_LT(glm::distance(walk.points.back(), fibre.back()), 1e-4F * 0.3F);
    EXPECT_LE(1e3 * walk.max_error_mm, 50);
    const double first = glm::distance(walk.points[1], walk.points[0]);
    for (std::size_t i = 1; i < walk.points.size(); ++i)
        EXPECT_NEAR(double(glm::distance(walk.points[i], walk.points[i - 1])), first, 1e-3 * first + 1e-5);
    // A finer bound needs more points, a given step is kept to within one segment.
    Walk fine;
    ASSERT_TRUE(walkEvenly(fibre, {0, 1, 65537}, fine));
    EXPECT_GT(fine.points.size(), walk.points.size());
    ASSERT_TRUE(walkEvenly(fibre, {0.05, 50, 65537}, fine));
    EXPECT_NEAR(double(glm::distance(fine.points[1], fine.points[0])), 0.05, 1e-3);
    EXPECT_FALSE(walkEvenly(fibre, {0, 1, 50}, fine)) << "more points than there may be";
}

TEST(EvenSteps, LeaveEvenFibresAndNameThoseThatCannotBeWalked) {
    model::Tractogram all;
    all.header.source = "some";
    const test::Fibres even = test::randomFibres(6, 3, 100, 0.2, 0.2);
    all.fibres.points = even.points;
    all.fibres.offsets = even.offsets;
    const std::vector<glm::vec3> uneven = growing();
    all.fibres.points.insert(all.fibres.points.end(), uneven.begin(), uneven.end());
    all.fibres.offsets.push_back(all.fibres.points.size());
    EvenStepTally tally;
    EvenSteps walked(model::sourceOf(all), {0, 100, 65537}, tally);
    const model::Tractogram out = model::readAll(walked);
    EXPECT_EQ(tally.walked, 1U);
    EXPECT_EQ(tally.errors.points, uneven.size());
    EXPECT_GT(tally.errors.max_um, 0);
    EXPECT_LE(tally.errors.max_um, 100);
    for (std::size_t i = 0; i < even.points.size(); ++i) EXPECT_EQ(out.fibres.points[i], even.points[i]);
    EvenSteps impossible(model::sourceOf(all), {0, 1, 80}, tally);
    try {
        model::readAll(impossible);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("some: the steps of fibre 3 vary"));
    }
}

}  // namespace
}  // namespace radiata
