// The layouts that fiblets are compared with: the paper's 76 bytes and QFib's files.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <unistd.h>

#include "base/error.h"
#include "build/fiblet_paper.h"
#include "io/qfib.h"
#include "support/random_fibres.h"

namespace radiata {
namespace {

constexpr double kCap = 7.2 * 3.14159265358979 / 180;

struct Errors {
    double sum_um = 0, max_um = 0;
    std::size_t points = 0;
    double mean() const { return sum_um / double(points); }
    template <typename Points>
    void add(std::span<const glm::vec3> given, const Points& decoded) {
        ASSERT_EQ(given.size(), decoded.size());
        for (std::size_t i = 0; i < given.size(); ++i) {
            const double error = 1e3 * glm::distance(glm::dvec3(given[i]), glm::dvec3(decoded[i]));
            sum_um += error;
            max_um = std::max(max_um, error);
        }
        points += given.size();
    }
};

TEST(PaperLayout, HasThePapersErrorsAndLessWithPositionFeedback) {
    const PaperCodec codec{glm::dvec3(-80), 160, 0.1, 1 - std::cos(kCap)};
    std::mt19937 random(31);
    Errors direction, position;
    for (int f = 0; f < 300; ++f) {
        const std::vector<glm::vec3> fibre = test::randomFibre(random, 60, 0.1, kCap);
        for (const PaperAim aim : {PaperAim::kDirection, PaperAim::kPosition}) {
            const PaperFiblet fiblet = encodePaper(fibre, 7, 3, true, false, codec, aim);
            (aim == PaperAim::kDirection ? direction : position).add(fibre, decodePaper(fiblet, codec));
        }
    }
    std::printf("direction feedback %.2f, %.2f um; position feedback %.2f, %.2f um\n", direction.mean(), direction.max_um,
                position.mean(), position.max_um);
    EXPECT_LT(direction.mean(), 9);  // the paper: 5.03, 17.1
    EXPECT_LT(direction.max_um, 40);
    EXPECT_LT(position.mean(), 0.4 * direction.mean());
}

TEST(PaperLayout, HoldsItsFieldsAndShortFiblets) {
    const PaperCodec codec{glm::dvec3(-80), 160, 0.1, 0.01};
    const std::vector<glm::vec3> points{{1, 2, 3}, {1, 2.1F, 3}, {1, 2.2F, 3}};
    const PaperFiblet fiblet = encodePaper(points, 0x01020304, 200, true, true, codec, PaperAim::kPosition);
    EXPECT_EQ(fiblet[70], 4);
    EXPECT_EQ(fiblet[73], 1);
    EXPECT_EQ(fiblet[74], 200);
    EXPECT_EQ(fiblet[75], 3 | 3 << 2);
    const auto decoded = decodePaper(fiblet, codec);
    ASSERT_EQ(decoded.size(), 3U);
    for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(decoded[i], glm::dvec3(points[i])), 0.01);
    EXPECT_EQ(decodePaper(encodePaper(std::span(points).first(1), 0, 0, true, true, codec, PaperAim::kPosition), codec).size(),
              1U);
    EXPECT_THROW(encodePaper(points, 0, 256, true, true, codec, PaperAim::kPosition), Error);
    EXPECT_THROW(encodePaper({}, 0, 0, true, true, codec, PaperAim::kPosition), Error);
}

class QfibFile : public ::testing::Test {
protected:
    void SetUp() override {
        path_ = std::filesystem::temp_directory_path() / ("radiata_" + std::to_string(::getpid()) + ".qfib");
        const test::Fibres fibres = test::randomFibres(32, 30, 400, 0.1, kCap);
        tractogram_.header.source = "memory";
        for (std::size_t f = 0; f + 1 < fibres.offsets.size(); ++f) {
            const auto first = fibres.points.begin() + std::ptrdiff_t(fibres.offsets[f]),
                       last = fibres.points.begin() + std::ptrdiff_t(fibres.offsets[f + 1]);
            if (last - first < 2) continue;
            tractogram_.fibres.points.insert(tractogram_.fibres.points.end(), first, last);
            tractogram_.fibres.offsets.push_back(tractogram_.fibres.points.size());
        }
    }
    void TearDown() override { std::filesystem::remove(path_); }
    std::string content() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::string refusal(const std::string& bytes) {
        std::ofstream(path_, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
        try {
            model::readAll(*io::openQfib(path_));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    std::filesystem::path path_;
    model::Tractogram tractogram_;
};

TEST_F(QfibFile, ComesBackWithinQfibsErrors) {
    for (const int bits : {8, 16}) {
        io::writeQfib([&] { return model::sourceOf(tractogram_); }, bits, path_);
        EXPECT_EQ(
            std::filesystem::file_size(path_),
            11 + 26 * tractogram_.fibreCount() + (tractogram_.fibres.points.size() - 2 * tractogram_.fibreCount()) * bits / 8);
        const model::Tractogram back = model::readAll(*io::openQfib(path_));
        ASSERT_EQ(back.fibres.offsets, tractogram_.fibres.offsets);
        Errors errors;
        errors.add(tractogram_.fibres.points, back.fibres.points);
        std::printf("%d bits: %.2f, %.2f um\n", bits, errors.mean(), errors.max_um);
        EXPECT_LT(errors.mean(), bits == 8 ? 40 : 3);  // the paper: 18.5 um with 8 bits
    }
}

TEST_F(QfibFile, ReadsFibonacciCodesMadeByHand) {
    // Code 0 of 256 lies 1 / 256 off the z axis' end; straight fibres along z keep to it.
    const float ratio = 0.02F;
    const auto points = io::decodeQfib({0, 0, 0}, {0, 0, 0.1F}, std::vector<std::uint16_t>(5, 0), ratio, true, 8);
    ASSERT_EQ(points.size(), 7U);
    // 1 - cos of the first turn is 1 / 256 of the cap's.
    const double cosine = 1 - ratio / 256.0;
    EXPECT_NEAR((points[2].z - points[1].z) / 0.1F, cosine, 1e-6);
    EXPECT_GT(points[2].x, 0);
}

TEST_F(QfibFile, RefusesDamage) {
    io::writeQfib([&] { return model::sourceOf(tractogram_); }, 8, path_);
    const std::string bytes = content();
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 20)
        EXPECT_NE(refusal(bytes.substr(0, size)), "") << size;
    std::string other = bytes;
    other[0] = 2;
    EXPECT_THAT(refusal(other), ::testing::HasSubstr("version 2"));
    other = bytes;
    other[9] = 5;
    EXPECT_THAT(refusal(other), ::testing::HasSubstr("quantisation 5"));
    other = bytes;
    other[4] = '\x7f';
    EXPECT_NE(refusal(other), "");
    tractogram_.fibres.points.emplace_back(0);
    tractogram_.fibres.offsets.push_back(tractogram_.fibres.points.size());
    EXPECT_THROW(io::writeQfib([&] { return model::sourceOf(tractogram_); }, 8, path_), Error);
}

}  // namespace
}  // namespace radiata
