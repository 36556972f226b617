// NRRD files put together byte by byte: every type, both byte orders and encodings, spaces, detached data, and headers that
// lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "io/scalar_image.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

using ::testing::HasSubstr;

std::string header(const std::string& lines) { return "NRRD0004\n# made by a test\n" + lines + "\n"; }

const std::string kSmall = "dimension: 3\nsizes: 3 2 2\ntype: short\nendian: little\nencoding: raw\n";
const std::vector<double> kValues{0, 1, -2, 3, 4, 5, 6, 7, 8, 9, 10, 300};

std::string smallData() { return test::encode(kValues, "int16", false); }

model::ScalarImage readBytes(const std::string& bytes, const std::string& name = "v.nrrd") {
    const test::TempFolder folder;
    return readScalarImage(folder.write(name, bytes));
}

std::string refusal(const std::string& bytes, Code code, const std::string& name = "v.nrrd") {
    try {
        readBytes(bytes, name);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "taken";
    return {};
}

TEST(Nrrd, ReadsEveryTypeInBothByteOrdersAndEncodings) {
    const std::vector<std::pair<std::string, std::string>> types{
        {"int8", "signed char"}, {"uint8", "uchar"},     {"int16", "short"}, {"uint16", "unsigned short"},
        {"int32", "int"},        {"uint32", "uint32_t"}, {"int64", "int64"}, {"uint64", "ulonglong"},
        {"float32", "float"},    {"float64", "double"}};
    for (const auto& [type, name] : types) {
        const std::vector<double> values{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 100};
        for (const bool big : {false, true}) {
            const std::string fields =
                "dimension: 3\nsizes: 3 2 2\ntype: " + name + "\nendian: " + (big ? "big" : "little") + "\n";
            const std::string data = test::encode(values, type, big);
            for (const bool packed : {false, true}) {
                const model::ScalarImage image = readBytes(header(fields + "encoding: " + (packed ? "gzip" : "raw") + "\n") +
                                                           (packed ? test::gzip(data) : data));
                EXPECT_EQ(image.size, glm::ivec3(3, 2, 2));
                EXPECT_EQ(image.values, std::vector<float>(values.begin(), values.end())) << name << big << packed;
            }
        }
    }
}

TEST(Nrrd, PutsSpacesIntoRas) {
    const std::string frame =
        kSmall + "space dimension: 3\nspace directions: (2,0,0) (0,3,0) (0.5,0,4)\nspace origin: (10,20,30)\n";
    const auto with = [&](const std::string& space) {
        std::string fields = frame;
        fields.replace(fields.find("space dimension: 3"), 18, "space: " + space);
        return readBytes(header(fields) + smallData()).voxel_to_world;
    };
    const glm::dmat4 ras = with("right-anterior-superior"), lps = with("left-posterior-superior"), las = with("LAS");
    EXPECT_EQ(ras[0], glm::dvec4(2, 0, 0, 0));
    EXPECT_EQ(ras[2], glm::dvec4(0.5, 0, 4, 0));
    EXPECT_EQ(ras[3], glm::dvec4(10, 20, 30, 1));
    EXPECT_EQ(lps[0], glm::dvec4(-2, 0, 0, 0));
    EXPECT_EQ(lps[1], glm::dvec4(0, -3, 0, 0));
    EXPECT_EQ(lps[2], glm::dvec4(-0.5, 0, 4, 0));
    EXPECT_EQ(lps[3], glm::dvec4(-10, -20, 30, 1));
    EXPECT_EQ(las[3], glm::dvec4(-10, 20, 30, 1));
    EXPECT_EQ(readBytes(header(frame) + smallData()).voxel_to_world, ras);
}

TEST(Nrrd, TakesSpacingsKeysCommentsAndCarriageReturns) {
    std::string text = header("my key:=some value: 5\n" + kSmall + "spacings: 1.5 2 NaN\nkinds: domain domain domain\n");
    const model::ScalarImage image = readBytes(text + smallData());
    EXPECT_EQ(image.voxel_to_world[0][0], 1.5);
    EXPECT_EQ(image.voxel_to_world[2][2], 1);
    std::string with_returns;
    for (const char c : text) with_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(readBytes(with_returns + smallData()).values, image.values);
}

TEST(Nrrd, LeavesOutAxesOfOneEntry) {
    const std::string fields =
        "dimension: 4\nsizes: 1 3 2 2\ntype: short\nendian: little\nencoding: raw\nspace: RAS\n"
        "space directions: none (1,0,0) (0,1,0) (0,0,1)\n";
    EXPECT_EQ(readBytes(header(fields) + smallData()).size, glm::ivec3(3, 2, 2));
    const model::ScalarImage slice =
        readBytes(header("dimension: 2\nsizes: 4 3\ntype: short\nendian: little\nencoding: raw\n") + smallData());
    EXPECT_EQ(slice.size, glm::ivec3(4, 3, 1));
}

TEST(Nrrd, ReadsDataBesideTheHeader) {
    const test::TempFolder folder;
    folder.write("v.raw", "skipped" + smallData());
    folder.write("v.raw.gz", test::gzip("12" + smallData()));
    const auto read = [&](const std::string& lines) { return readScalarImage(folder.write("v.nhdr", header(lines))).values; };
    const std::vector<float> expected(kValues.begin(), kValues.end());
    EXPECT_EQ(read(kSmall + "data file: v.raw\nbyte skip: 7\n"), expected);
    EXPECT_EQ(read(kSmall + "datafile: ./v.raw\nbyteskip: -1\n"), expected);
    std::string packed = kSmall;
    packed.replace(packed.find("raw"), 3, "gzip");
    EXPECT_EQ(read(packed + "data file: v.raw.gz\nbyte skip: 2\n"), expected);
    const auto refused = [&](const std::string& lines, Code code) {
        try {
            read(kSmall + lines);
            ADD_FAILURE() << lines;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
        }
    };
    refused("", Code::kCorrupt);
    refused("data file: none.raw\n", Code::kNotFound);
    refused("data file: ../v.raw\n", Code::kInvalidArgument);
    refused("data file: /etc/passwd\n", Code::kInvalidArgument);
    refused("data file: LIST\n", Code::kUnsupported);
    refused("data file: v%03d.raw 1 3 1\n", Code::kUnsupported);
    refused("data file: v.raw\nline skip: 1\n", Code::kUnsupported);
    refused("data file: v.raw\nbyte skip: 8\n", Code::kCorrupt);
    refused("data file: v.raw\nbyte skip: 99999999999\n", Code::kCorrupt);
    refused("data file: v.raw\nbyte skip: -2\n", Code::kCorrupt);
}

TEST(Nrrd, SaysWhatIsWrongWithAHeader) {
    const auto changed = [](const std::string& from, const std::string& to) {
        std::string fields = kSmall;
        fields.replace(fields.find(from), from.size(), to);
        return header(fields) + smallData();
    };
    EXPECT_THAT(refusal("PNG", Code::kCorrupt), HasSubstr("begins with NRRD0001"));
    EXPECT_THAT(refusal("NRRD0009\n\n", Code::kCorrupt), HasSubstr("NRRD0009"));
    EXPECT_THAT(refusal("NRRD0004\ndimension: 3\n", Code::kCorrupt), HasSubstr("no empty line"));
    EXPECT_THAT(refusal("NRRD0004\n" + std::string(2 << 20, 'x'), Code::kCorrupt), HasSubstr("within its first"));
    EXPECT_THAT(refusal(changed("sizes: 3 2 2", "sizes: 3 2"), Code::kCorrupt),
                HasSubstr("sizes has 2 numbers, dimension is 3"));
    EXPECT_THAT(refusal(changed("sizes: 3 2 2", "sizes: 3 0 2"), Code::kCorrupt), HasSubstr("length 0"));
    EXPECT_THAT(refusal(changed("sizes: 3 2 2", "sizes: 3 2 two"), Code::kCorrupt), HasSubstr("'two'"));
    EXPECT_THAT(refusal(changed("sizes: 3 2 2", "sizes: 4 2 2"), Code::kCorrupt), HasSubstr("promises"));
    EXPECT_THAT(refusal(changed("sizes: 3 2 2", "sizes: 99999 99999 99999"), Code::kResourceExhausted), HasSubstr("at most"));
    EXPECT_THAT(refusal(changed("dimension: 3", "dimension: 30"), Code::kCorrupt), HasSubstr("1 to 16"));
    EXPECT_THAT(refusal(changed("short", "block"), Code::kUnsupported), HasSubstr("'block'"));
    EXPECT_THAT(refusal(changed("raw", "bzip2"), Code::kUnsupported), HasSubstr("raw and gzip are read"));
    EXPECT_THAT(refusal(changed("raw", "gzip"), Code::kCorrupt), HasSubstr("not gzip"));
    EXPECT_THAT(refusal(changed("little", "middle"), Code::kCorrupt), HasSubstr("little or big"));
    EXPECT_THAT(refusal(changed("endian: little\n", ""), Code::kCorrupt), HasSubstr("no 'endian'"));
    EXPECT_THAT(refusal(changed("endian: little", "endian: little\nendian: big"), Code::kCorrupt), HasSubstr("twice"));
    EXPECT_THAT(refusal(changed("endian: little", "what is this"), Code::kCorrupt), HasSubstr("'field: value'"));
    const auto framed = [](const std::string& lines) { return header(kSmall + lines) + smallData(); };
    EXPECT_THAT(refusal(framed("space directions: (1,0,0) (0,1,0)\n"), Code::kCorrupt), HasSubstr("2 entries for 3 axes"));
    EXPECT_THAT(refusal(framed("space directions: (1,0,0) (0,1,0) (1,1,0)\n"), Code::kCorrupt), HasSubstr("singular"));
    EXPECT_THAT(refusal(framed("space directions: (1,0,0) (0,1,0) (0,0,x)\n"), Code::kCorrupt), HasSubstr("vectors of three"));
    EXPECT_THAT(refusal(framed("space directions: none none none\n"), Code::kUnsupported),
                HasSubstr("none of the three of space"));
    EXPECT_THAT(refusal(framed("spacings: 1 0 1\n"), Code::kCorrupt), HasSubstr("0 mm long"));
    EXPECT_THAT(refusal(framed("space: left-posterior-superior-time\n"), Code::kUnsupported), HasSubstr("without time"));
    EXPECT_THAT(refusal(framed("space dimension: 2\n"), Code::kUnsupported), HasSubstr("3 is read"));
}

}  // namespace
}  // namespace radiata::io
