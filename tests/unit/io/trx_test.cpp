// .trx folders and zip files: columns, groups, number types, and files that contradict themselves.
#include "io/trx.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "base/error.h"
#include "io/tractogram.h"
#include "unit/io/tract_bytes.h"

namespace radiata::io {
namespace {

using namespace test;
using model::Tractogram;
using Entries = std::map<std::string, std::string>;

Tractogram read(const std::filesystem::path& path) { return model::readAll(*openTractogram(path)); }

/// Three streamlines of 2, 0 and 3 points with a column of each kind and two overlapping groups.
Entries example() {
    return {
        {"header.json",
         R"({"DIMENSIONS":[4,5,6],"VOXEL_TO_RASMM":[[2,0,0,-3],[0,2,0,0],[0,0,2,0],[0,0,0,1]],"NB_STREAMLINES":3,"NB_VERTICES":5})"},
        {"positions.3.float32", encode({1, 2, 3, 1, 2, 4, 5, 5, 5, 6, 6, 6, 7, 7, 7}, "float32", false)},
        {"offsets.uint32", encode({0, 2, 2, 5}, "uint32", false)},
        {"dpv/fa.float16", encode({}, "float32", false) + std::string("\x00\x38\x00\x3c\x00\xc0\x01\x00\xff\x7b", 10)},
        {"dpv/rgb.3.uint8", encode({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, "uint8", false)},
        {"dps/weight.float64", encode({0.5, 0.25, -1}, "float64", false)},
        {"groups/left.uint32", encode({2, 0, 2}, "uint32", false)},
        {"groups/all.uint32", encode({0, 1, 2}, "uint32", false)},
        {"dpg/left/volume.float32", encode({12.5}, "float32", false)}};
}

std::filesystem::path writeFolder(const TempFolder& folder, const Entries& entries) {
    const auto root = folder.path() / "a.trx";
    std::filesystem::remove_all(root);
    for (const auto& [name, bytes] : entries) {
        std::filesystem::create_directories((root / name).parent_path());
        std::ofstream(root / name, std::ios::binary) << bytes;
    }
    return root;
}

std::string failure(const std::filesystem::path& path) {
    try {
        read(path);
    } catch (const Error& error) {
        EXPECT_NE(error.code(), Code::kInternal);
        return error.what();
    }
    return "no failure";
}

void expectExample(const Tractogram& tracts) {
    EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 2, 2, 5}));
    EXPECT_EQ(tracts.fibres.points.at(1), glm::vec3(1, 2, 4));
    EXPECT_EQ(tracts.header.vertex_columns, (std::vector<model::ColumnName>{{"fa", 1}, {"rgb", 3}}));
    EXPECT_EQ(tracts.fibres.vertex_values[0], (std::vector<float>{0.5F, 1, -2, 0x1p-24F, 65504}));
    EXPECT_EQ(tracts.fibres.vertex_values[1][14], 15);
    EXPECT_EQ(tracts.fibres.fibre_values.at(0), (std::vector<float>{0.5, 0.25, -1}));
    ASSERT_EQ(tracts.groups.size(), 2U);
    EXPECT_EQ(tracts.group("left").fibres, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(tracts.group("all").fibres.size(), 3U);
    EXPECT_EQ(tracts.group("left").columns, (std::vector<model::ColumnName>{{"volume", 1}}));
    EXPECT_EQ(tracts.group("left").values, (std::vector<std::vector<float>>{{12.5}}));
    EXPECT_EQ(tracts.header.grid_size, glm::ivec3(4, 5, 6));
    EXPECT_EQ((*tracts.header.voxel_to_world)[3][0], -3);
}

TEST(Trx, AFolderIsReadWithColumnsAndGroups) {
    const TempFolder folder;
    expectExample(read(writeFolder(folder, example())));
}

TEST(Trx, ReadsBackTheSameAsZipAndAsFolder) {
    const TempFolder folder;
    const Tractogram tracts = read(writeFolder(folder, example()));
    writeTractogram(*model::sourceOf(tracts), folder.path() / "b.trx");
    expectExample(read(folder.path() / "b.trx"));
    writeTractogram(*model::sourceOf(tracts), folder.path() / "c.trx" / "");
    EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "c.trx"));
    expectExample(read(folder.path() / "c.trx"));
    EXPECT_THROW(writeTractogram(*model::sourceOf(tracts), folder.path() / "c.trx" / ""), Error);
    writeTractogram(*model::sourceOf(tracts), folder.path() / "d.trx");
    const auto bytes = [&](const char* name) {
        std::ifstream file(folder.path() / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_EQ(bytes("b.trx"), bytes("d.trx"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 4) << "nothing else stays";
}

TEST(Trx, OffsetsMayLackTheEndAndBe64Bit) {
    const TempFolder folder;
    for (const bool end : {false, true}) {
        Entries entries = example();
        entries.erase("offsets.uint32");
        entries["offsets.uint64"] = end ? encode({0, 2, 2, 5}, "uint64", false) : encode({0, 2, 2}, "uint64", false);
        expectExample(read(writeFolder(folder, entries)));
    }
    EXPECT_EQ(read(writeFolder(folder, {{"header.json", R"({"NB_STREAMLINES":0,"NB_VERTICES":0})"}})).fibreCount(), 0U);
}

TEST(Trx, ContradictionsAreRefusedWithASentence) {
    const TempFolder folder;
    const auto with = [&](const std::function<void(Entries&)>& change) {
        Entries entries = example();
        change(entries);
        return failure(writeFolder(folder, entries));
    };
    EXPECT_EQ(with([](Entries& e) {
                  e["groups/left.uint32"] = encode({0, 3}, "uint32", false);
              }),
              "a.trx/groups/left.uint32: names streamline 3; there are 3, counted from 0");
    EXPECT_THAT(with([](Entries& e) {
                    e["offsets.uint32"] = encode({0, 3, 2, 5}, "uint32", false);
                }),
                testing::HasSubstr("offset 2 is 2; offsets go from 0 upwards to the 5 vertices"));
    EXPECT_THAT(with([](Entries& e) {
                    e["offsets.uint32"] = encode({0, 2, 4000000000, 5}, "uint32", false);
                }),
                testing::HasSubstr("offset 2 is 4000000000"));
    EXPECT_THAT(with([](Entries& e) {
                    e["offsets.uint32"] = encode({0, 2, 2, 4}, "uint32", false);
                }),
                testing::HasSubstr("offset 3 is 4"));
    EXPECT_EQ(with([](Entries& e) { e["dps/weight.float64"].resize(16); }),
              "a.trx/dps/weight.float64: has 16 bytes; 3 streamlines need 24");
    EXPECT_EQ(with([](Entries& e) { e["positions.3.float32"].resize(48); }),
              "a.trx/positions.3.float32: has 48 bytes; 5 vertices need 60");
    EXPECT_THAT(with([](Entries& e) { e["header.json"] = R"({"NB_STREAMLINES":5000000000,"NB_VERTICES":5})"; }),
                testing::HasSubstr("holds 5000000000 fibres; at most 4294967295"));
    EXPECT_THAT(with([](Entries& e) { e["header.json"] = R"({"NB_STREAMLINES":3,"NB_VERTICES":18446744073709551615})"; }),
                testing::HasSubstr("does not fit 64 bits"));
    EXPECT_THAT(with([](Entries& e) { e["header.json"] = R"({"NB_STREAMLINES":-3,"NB_VERTICES":5})"; }),
                testing::HasSubstr("NB_STREAMLINES is missing or is no whole number"));
    EXPECT_THAT(with([](Entries& e) { e["header.json"] = "["; }), testing::HasSubstr("is no JSON object"));
    EXPECT_THAT(with([](Entries& e) { e.erase("header.json"); }), testing::HasSubstr("has no header.json"));
    EXPECT_THAT(with([](Entries& e) { e.erase("positions.3.float32"); }), testing::HasSubstr("has no positions.3"));
    EXPECT_THAT(with([](Entries& e) { e["dpv/fa.float32"] = std::string(20, '\0'); }),
                testing::HasSubstr("has two columns 'fa'"));
    EXPECT_THAT(with([](Entries& e) { e["groups/left.uint32"] = std::string(4000, '\0'); }),
                testing::HasSubstr("lists 1000 of 3"));
    // A zip file whose directory promises more than its bytes can hold, or the same bytes twice.
    writeTrx(*model::sourceOf(read(writeFolder(folder, example()))), folder.path() / "good.trx");
    std::ifstream in(folder.path() / "good.trx", std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    const std::size_t directory = good.find("PK\x01\x02");
    ASSERT_NE(directory, good.npos);
    const auto patched = [&](std::size_t at, std::uint32_t value) {
        std::string bytes = good;
        std::memcpy(&bytes[directory + at], &value, 4);
        return folder.write("bomb.trx", bytes);
    };
    EXPECT_THAT(failure(patched(24, 0xfffffff0U)), testing::HasSubstr("cannot hold 4294967280"));
    EXPECT_THAT(failure(patched(20, 0x7ffffff0U)), testing::HasSubstr("they overlap"));
    EXPECT_THAT(failure(folder.write("b.trx", "no zip")), testing::HasSubstr("is neither a folder nor a zip file"));
}

TEST(Trx, LinksOutOfAFolderAreNotFollowed) {
    const TempFolder folder;
    const auto secret = folder.write("secret", std::string(12, 'x'));
    const auto root = writeFolder(folder, example());
    std::filesystem::create_symlink(secret, root / "dps" / "stolen.float32");
    EXPECT_EQ(read(root).header.fibre_columns.size(), 1U);
}

TEST(Trx, CutAndDamagedZipFilesAreTold) {
    const TempFolder folder;
    writeTractogram(*model::sourceOf(read(writeFolder(folder, example()))), folder.path() / "b.trx");
    std::ifstream file(folder.path() / "b.trx", std::ios::binary);
    const std::string good(std::istreambuf_iterator<char>(file), {});
    for (std::size_t size = 1; size < good.size(); size += 61) {
        EXPECT_NE(failure(folder.write("c.trx", good.substr(0, size))), "no failure") << size;
    }
    // A bit of the positions.
    std::string flipped = good;
    const std::size_t at = flipped.find(encode({5, 5, 5}, "float32", false));
    ASSERT_NE(at, flipped.npos);
    flipped[at + 1] = static_cast<char>(flipped[at + 1] ^ 4);
    EXPECT_THAT(failure(folder.write("c.trx", flipped)), testing::HasSubstr("do not have the checksum"));
}

}  // namespace
}  // namespace radiata::io
