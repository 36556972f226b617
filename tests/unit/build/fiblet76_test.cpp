// Files of the paper's 76-byte records: round trip, and a clear error for whatever is cut off or changed.
#include "ingest/fiblet76_file.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <unistd.h>

#include "base/error.h"
#include "build/fiblet_paper.h"
#include "io/fiblet_layout.h"
#include "support/random_fibres.h"

namespace radiata {
namespace {

using ::testing::HasSubstr;

class Fiblet76 : public ::testing::Test {
protected:
    void SetUp() override {
        path_ = std::filesystem::temp_directory_path() / ("radiata_" + std::to_string(::getpid()) + ".fiblet76");
        tracts_.header.source = "random";
        const test::Fibres fibres = test::randomFibres(61, 400, 300, 0.2, 0.1);
        tracts_.fibres.points = fibres.points;
        tracts_.fibres.offsets = fibres.offsets;
        // Without points: in the middle and at the end.
        tracts_.fibres.offsets.insert(tracts_.fibres.offsets.begin() + 7, tracts_.fibres.offsets[7]);
        tracts_.fibres.offsets.push_back(tracts_.fibres.offsets.back());
    }
    void TearDown() override { std::filesystem::remove(path_); }

    ingest::Fiblet76Written write(const FibletOptions& options = {}) {
        return ingest::writeFiblet76([this] { return model::sourceOf(tracts_); }, options, path_);
    }
    std::string content() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    /// What is said of a file with these bytes; empty if it is read.
    std::string said(const std::string& bytes) {
        std::ofstream(path_, std::ios::binary | std::ios::trunc).write(bytes.data(), std::streamsize(bytes.size()));
        try {
            model::readAll(*ingest::openFiblet76(path_));
        } catch (const Error& error) {
            EXPECT_NE(error.code(), Code::kInternal);
            return error.what();
        }
        return "";
    }
    /// The file with another header, whose checksum is right.
    template <typename Change>
    std::string withHeader(std::string bytes, Change&& change) {
        ingest::Fiblet76Header header;
        std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
        change(header);
        header.crc = 0;
        header.crc = io::fiblet::crcOf(std::as_bytes(std::span(&header, 1)));
        std::memcpy(bytes.data(), &header, sizeof header);
        return bytes;
    }

    std::filesystem::path path_;
    model::Tractogram tracts_;
};

TEST_F(Fiblet76, ComesBackWithinTheLayoutsErrors) {
    const ingest::Fiblet76Written done = write();
    EXPECT_EQ(done.fibres, 402U);
    EXPECT_EQ(done.points, tracts_.fibres.points.size());
    EXPECT_FALSE(done.walked);
    EXPECT_EQ(std::filesystem::file_size(path_), 104 + 76 * done.fiblets + 4 * ((done.fiblets + 1023) / 1024));
    EXPECT_GT(done.fiblets, 1024U) << "more than one block";
    const model::Tractogram back = model::readAll(*ingest::openFiblet76(path_));
    ASSERT_EQ(back.fibres.offsets, tracts_.fibres.offsets);
    double sum = 0, most = 0;
    for (std::size_t i = 0; i < back.fibres.points.size(); ++i) {
        const double error = 1e3 * glm::distance(glm::dvec3(back.fibres.points[i]), glm::dvec3(tracts_.fibres.points[i]));
        sum += error;
        most = std::max(most, error);
    }
    EXPECT_NEAR(sum / double(done.points), done.errors.mean_um, 0.02);
    EXPECT_NEAR(most, done.errors.max_um, 0.02);  // float32 points
    EXPECT_LT(done.errors.mean_um, 12);           // with turns up to 5.7 degrees at steps of 0.2 mm
    const std::string first = content();
    write();
    EXPECT_TRUE(content() == first) << "equal input gives equal bytes";
}

TEST_F(Fiblet76, SetsPointsAnewAndEndsAtWholeSteps) {
    tracts_ = {};
    tracts_.header.source = "uneven";
    for (double x = 0, i = 0; i < 100; x += 0.3 + 0.002 * i, ++i) tracts_.fibres.points.emplace_back(x, std::sin(x / 4), 20);
    tracts_.fibres.offsets = {0, 100};
    const ingest::Fiblet76Written done = write({.step_mm = 0.25});
    EXPECT_TRUE(done.walked);
    EXPECT_EQ(done.step_mm, 0.25);
    EXPECT_GT(done.end_um, 0);
    EXPECT_LE(done.end_um, 125.5);
    const model::Tractogram back = model::readAll(*ingest::openFiblet76(path_));
    EXPECT_LE(1e3 * glm::distance(back.fibres.points.back(), tracts_.fibres.points.back()), done.end_um + done.errors.max_um);
    // A fibre with more points than 256 fiblets hold.
    tracts_.fibres.points.clear();
    for (int i = 0; i < 15361; ++i) tracts_.fibres.points.emplace_back(0.1F * float(i % 1000), float(i / 1000), 0);
    tracts_.fibres.offsets = {0, 15361};
    EXPECT_THROW(write(), Error);
    tracts_ = {};
    EXPECT_EQ(write().points, 0U);
    EXPECT_EQ(said(content()), "");
}

TEST_F(Fiblet76, IsRefusedWhereverItIsCutOff) {
    write();
    const std::string bytes = content();
    // Everywhere in the header, around the borders of records, blocks and checksums, and in between.
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i <= 104 + 2 * 76; ++i) sizes.push_back(i);
    const std::size_t block = 104 + 76 * 1024;
    for (std::size_t i = block - 80; i < block + 84; ++i) sizes.push_back(i);
    for (std::size_t i = bytes.size() - 84; i < bytes.size(); ++i) sizes.push_back(i);
    for (std::size_t i = 300; i < bytes.size(); i += bytes.size() / 50) sizes.push_back(i);
    for (const std::size_t size : sizes) {
        const std::string what = said(bytes.substr(0, size));
        EXPECT_THAT(what, testing::AnyOf(HasSubstr("cut off"), HasSubstr("too early"), HasSubstr("empty"))) << size;
    }
    EXPECT_THAT(said(bytes + "x"), HasSubstr("bytes, but was written with"));
    // With a header that agrees, the records contradict it.
    EXPECT_THAT(said(withHeader(bytes.substr(0, bytes.size() - 76),
                                [&](auto& h) {
                                    h.fiblets -= 1;
                                    h.file_bytes -= 76;
                                })),
                HasSubstr("checksum of fiblets"));
}

TEST_F(Fiblet76, SurvivesFlippedBits) {
    write();
    const std::string bytes = content();
    std::size_t flipped = 0;
    for (std::size_t at = 0; at < bytes.size(); at += at < 104 ? 1 : 811, ++flipped) {
        std::string other = bytes;
        other[at] = char(other[at] ^ 1 << (at % 8));
        EXPECT_THAT(said(other), testing::AnyOf(HasSubstr("checksum"), HasSubstr("does not begin"), HasSubstr("version"),
                                                HasSubstr("cut off or damaged")))
            << at;
    }
    EXPECT_GT(flipped, 200U);
}

/// What a program that writes such files may do wrong: sizes and checksums agree.
TEST_F(Fiblet76, SaysWhatContradictsItself) {
    tracts_.fibres.points.resize(tracts_.fibres.offsets[3]);
    tracts_.fibres.offsets.resize(4);
    write();
    const std::string bytes = content();
    const auto header = [&](auto change) { return said(withHeader(bytes, change)); };
    EXPECT_THAT(header([](auto& h) { h.ratio = 2.5; }), HasSubstr("ratio 2.5"));
    EXPECT_THAT(header([](auto& h) { h.ratio = std::nan(""); }), HasSubstr("ratio"));
    EXPECT_THAT(header([](auto& h) { h.step_mm = 0; }), HasSubstr("step 0"));
    EXPECT_THAT(header([](auto& h) { h.extent_mm = INFINITY; }), HasSubstr("extent"));
    EXPECT_THAT(header([](auto& h) { h.origin_mm[1] = 1e9; }), HasSubstr("origin"));
    EXPECT_THAT(header([](auto& h) { h.fibres = 1ULL << 40; }), HasSubstr("1099511627776 fibres"));
    EXPECT_THAT(header([](auto& h) { h.fibres = 0xffffffff; }), HasSubstr("4294967295 fibres"));
    EXPECT_THAT(header([](auto& h) { h.fibres = 2; }), HasSubstr("behind the last of 2 fibres"));
    EXPECT_THAT(header([](auto& h) { ++h.points; }), HasSubstr("but its header says"));
    EXPECT_THAT(header([](auto& h) { h.fiblets = ~0ULL; }), HasSubstr("cut off or damaged"));
    EXPECT_THAT(header([](auto& h) { h.record_bytes = 75; }), HasSubstr("records of 75 bytes"));
    const auto record = [&](std::size_t byte, char value) {
        std::string other = bytes;
        other[104 + byte] = value;
        const std::size_t end = other.size() - 4;
        const std::uint32_t crc = io::fiblet::crcOf(std::as_bytes(std::span(other).subspan(104, end - 104)));
        std::memcpy(other.data() + end, &crc, 4);
        return said(other);
    };
    EXPECT_THAT(record(75, 0), HasSubstr("fiblet 0 is number 0 of fibre 0 with 0 points"));
    EXPECT_THAT(record(75, char(63 << 2 | 3)), HasSubstr("with 63 points"));
    EXPECT_THAT(record(74, 1), HasSubstr("is number 1 of fibre 0"));
    EXPECT_NE(record(70, 5), "");
    EXPECT_NE(record(73, 5), "");
}

}  // namespace
}  // namespace radiata
