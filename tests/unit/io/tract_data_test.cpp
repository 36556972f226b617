// Real tractograms against what other programs say about them (refs/tracts.json, trx_tt.json in the folder named by
// RADIATA_DATA); without that folder, a generated file against numbers counted here.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/tractogram.h"
#include "unit/io/tract_bytes.h"

namespace radiata::io {
namespace {

using model::Tractogram;

/// Bounds and first point to a float's step at 200 mm; lengths to 1e-6 of themselves.
void compare(const Tractogram& tracts, const nlohmann::json& reference) {
    EXPECT_EQ(tracts.measures.fibres, reference.at("streamlines").get<std::uint64_t>());
    EXPECT_EQ(tracts.measures.points, reference.at("points").get<std::uint64_t>());
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(tracts.measures.bounds_min[i], reference.at("bbox_min")[static_cast<std::size_t>(i)].get<double>(), 2e-5);
        EXPECT_NEAR(tracts.measures.bounds_max[i], reference.at("bbox_max")[static_cast<std::size_t>(i)].get<double>(), 2e-5);
    }
    if (reference.contains("length_mm")) {
        const double total = reference.at("length_mm").at("total").get<double>();
        EXPECT_NEAR(tracts.measures.length_mm, total, 1e-6 * total);
        EXPECT_EQ(tracts.measures.longest_fibre_points, reference.at("points_max").get<std::uint64_t>());
    }
    const nlohmann::json& first = reference.contains("first_streamline") ? reference.at("first_streamline")[0]
                                                                         : reference.value("first_point", nlohmann::json());
    for (int i = 0; i < 3 && !first.is_null(); ++i) {
        EXPECT_NEAR(tracts.fibres.points.at(0)[i], first[static_cast<std::size_t>(i)].get<double>(), 2e-5);
    }
}

nlohmann::json readJson(const std::filesystem::path& path) { return nlohmann::json::parse(std::ifstream(path)); }

TEST(TractData, IsReadAsItsReferencesSay) {
    const char* folder = std::getenv("RADIATA_DATA");
    const std::filesystem::path data = folder == nullptr ? "" : folder;
    int compared = 0;
    for (const char* list : {"tracts.json", "trx_tt.json"}) {
        if (data.empty()) break;
        const nlohmann::json references = readJson(data / "refs" / list);
        for (const auto& [name, reference] : references.items()) {
            if (!name.starts_with("share/")) continue;  // others are made by a script
            SCOPED_TRACE(name);
            compare(model::readAll(*openTractogram(data / name.substr(6))), reference);
            ++compared;
        }
    }
    if (!data.empty()) {
        EXPECT_EQ(compared, 11);
    }
    const test::TempFolder own;
    compare(
        model::readAll(*openTractogram(own.write("a.tck", test::tckBytes(test::tckLines(), test::twoTracks())))),
        {{"streamlines", 2}, {"points", 4}, {"bbox_min", {-7, 2, -9}}, {"bbox_max", {2, 8, 3}}, {"first_point", {1, 2, 3}}});
}

TEST(TractData, StepsGroupsAndColumnsOfRealFilesAreFound) {
    const char* folder = std::getenv("RADIATA_DATA");
    if (folder == nullptr || *folder == '\0') return;
    const std::filesystem::path data = folder;
    TractOptions options;
    options.columns = {data / "tracts/sag_sd_stream_500_fa.tsf", data / "tracts/sag_sd_stream_500_meanfa.txt"};
    const Tractogram tracts = model::readAll(*openTractogram(data / "tracts/sag_sd_stream_500.tck", options));
    EXPECT_NEAR(tracts.measures.constantStepMm(), 0.1, 1e-6);
    // tcksample writes the mean of what it sampled: to the six digits that it prints.
    for (std::size_t f = 0; f < tracts.fibreCount(); ++f) {
        double sum = 0;
        for (std::uint64_t p = tracts.fibres.offsets[f]; p < tracts.fibres.offsets[f + 1]; ++p)
            sum += tracts.fibres.vertex_values[0][p];
        const double mean = tracts.fibres.fibre_values[0][f];
        ASSERT_NEAR(sum / static_cast<double>(tracts.fibre(f).size()), mean, 0.02) << f;
    }
    const Tractogram afq = model::readAll(*openTractogram(data / "formats/nv_afq_sub01.trx"));
    EXPECT_EQ(afq.group("ARC_L").fibres.size(), 486U);
    EXPECT_EQ(afq.group("ARC_R").fibres.back(), 21U);
    EXPECT_EQ(model::readAll(*openTractogram(data / "tracts/atlas_icbm152_adult.tt.gz")).measures.constantStepMm(), 0);
    const Tractogram atlas = model::readAll(*openTractogram(data / "tracts/hcp842_const05_4k.trk"));
    EXPECT_NEAR(atlas.measures.constantStepMm(), 0.5, 1e-6);
    EXPECT_EQ(atlas.header.fibre_columns.at(0).name, "bundle");
}

}  // namespace
}  // namespace radiata::io
