// Truncated, lying, empty and oversized files: a sentence that names the file and the matter, no crash, no memory taken.
#include <sys/resource.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "base/error.h"
#include "io/sh_image.h"
#include "io/volume.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

void expectError(const std::filesystem::path& path, Code code, const std::string& part) {
    try {
        readVolume(path);
        ADD_FAILURE() << path.filename() << " was read; expected: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_THAT(error.what(), StartsWith(path.filename().string() + ": "));
        EXPECT_THAT(error.what(), HasSubstr(part));
        EXPECT_THAT(error.what(), testing::Not(HasSubstr(path.parent_path().string()))) << "no folder in a message";
    }
}

test::NiftiFile nifti(const std::function<void(test::NiftiFile&)>& change) {
    test::NiftiFile file;
    file.dim = {2, 2, 2, 6};
    file.data = std::string(4 * 48, '\0');
    change(file);
    return file;
}

class BadFiles : public testing::Test {
protected:
    void expectNifti(const std::function<void(test::NiftiFile&)>& change, Code code, const std::string& part) {
        for (const int version : {1, 2}) {
            test::NiftiFile file = nifti(change);
            file.version = version;
            const std::string bytes = test::bytes(file);
            expectError(folder_.write("bad.nii", bytes), code, part);
            expectError(folder_.write("bad.nii.gz", test::gzip(bytes)), code, part);
        }
    }
    void expectMif(const std::function<void(test::MrtrixFile&)>& change, Code code, const std::string& part) {
        test::MrtrixFile file = test::mrtrixFile({2, 2, 2, 6}, "+0,+1,+2,+3", "Float32LE");
        file.data = std::string(4 * 48, '\0');
        change(file);
        expectError(folder_.write("bad.mif", test::mifBytes(file)), code, part);
        expectError(folder_.write("bad.mif.gz", test::gzip(test::mifBytes(file))), code, part);
    }
    test::TempFolder folder_;
};

TEST_F(BadFiles, FilesThatAreNotThereOrNotFiles) {
    expectError(folder_.path() / "none.nii", Code::kNotFound, "no regular file");
    std::filesystem::create_directory(folder_.path() / "folder.nii");
    expectError(folder_.path() / "folder.nii", Code::kNotFound, "no regular file");
    expectError(folder_.write("notes.txt", "hello"), Code::kUnsupported, ".nii, .nii.gz, .mif, .mif.gz, .mih, .nrrd or .nhdr");
    for (const std::string name : {"a.nii", "a.nii.gz", "a.mif", "a.mif.gz", "a.mih"}) {
        expectError(folder_.write(name, ""), Code::kCorrupt, "empty (0 bytes)");
    }
}

TEST_F(BadFiles, EveryTruncationOfAFileIsAnError) {
    const std::string plain = test::bytes(nifti([](auto&) {}));
    const std::string packed = test::gzip(plain);
    for (std::size_t size = 1; size < plain.size(); ++size) {
        EXPECT_THROW(readVolume(folder_.write("a.nii", plain.substr(0, size))), Error) << size;
    }
    for (std::size_t size = 1; size < packed.size(); ++size) {
        EXPECT_THROW(readVolume(folder_.write("a.nii.gz", packed.substr(0, size))), Error) << size;
    }
    test::MrtrixFile file = test::mrtrixFile({2, 2, 2, 6}, "+0,+1,+2,+3", "Float32LE");
    file.data = std::string(4 * 48, '\x3f');
    const std::string mif = test::mifBytes(file);
    for (std::size_t size = 1; size < mif.size(); ++size) {
        EXPECT_THROW(readVolume(folder_.write("a.mif", mif.substr(0, size))), Error) << size;
    }
}

TEST_F(BadFiles, TruncationsSayWhatIsMissing) {
    const std::string plain = test::bytes(nifti([](auto&) {}));
    expectError(folder_.write("a.nii", plain.substr(0, 100)), Code::kCorrupt, "has 100 bytes; a NIfTI header has 348");
    expectError(folder_.write("a.nii", plain.substr(0, 400)), Code::kCorrupt, "up to byte 544, the file has 400 bytes");
    expectError(folder_.write("a.nii.gz", test::gzip(plain.substr(0, 400))), Code::kCorrupt, "48 of 192 bytes");
    const std::string packed = test::gzip(plain);
    expectError(folder_.write("a.nii.gz", packed.substr(0, packed.size() / 2)), Code::kCorrupt, "gzip");
}

TEST_F(BadFiles, DamagedGzipIsNoticed) {
    std::string packed = test::gzip(test::bytes(nifti([](auto& file) {
        std::mt19937 random(13);
        for (char& byte : file.data) byte = static_cast<char>(random());
    })));
    packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] ^ 1);  // in the checksum
    expectError(folder_.write("a.nii.gz", packed), Code::kCorrupt, "gzip stream is damaged");
    expectError(folder_.write("a.nii.gz", test::bytes(nifti([](auto&) {}))), Code::kCorrupt, "not gzip");
}

TEST_F(BadFiles, HeadersThatAreNone) {
    expectError(folder_.write("a.nii", std::string(1000, 'x')), Code::kCorrupt, "no NIfTI file");
    expectError(folder_.write("a.mif", std::string(1000, 'x')), Code::kCorrupt, "mrtrix image");
    expectError(folder_.write("a.mif", "mrtrix tracks\nEND\n"), Code::kCorrupt, "'mrtrix tracks'");
    test::NiftiFile file = nifti([](auto& f) { f.magic = std::string("xyz\0", 4); });
    expectError(folder_.write("a.nii", test::bytes(file)), Code::kCorrupt, "magic n+1 or n+2");
}

TEST_F(BadFiles, PairsOfNiftiFilesAreNamed) {
    test::NiftiFile file = nifti([](auto& f) { f.magic = std::string("ni1\0", 4); });
    expectError(folder_.write("a.nii", test::bytes(file)), Code::kUnsupported, ".hdr and .img");
    file.version = 2;
    file.magic = std::string("ni2\0\r\n\032\n", 8);
    expectError(folder_.write("a.nii", test::bytes(file)), Code::kUnsupported, ".hdr and .img");
}

TEST_F(BadFiles, LyingDimensions) {
    const Code kCorrupt = Code::kCorrupt;
    for (const int count : {0, 8, 32767}) {
        expectNifti([=](auto& file) { file.dim0 = count; }, kCorrupt, "dim[0] is " + std::to_string(count));
    }
    expectNifti([](auto& file) { file.dim[1] = 0; }, kCorrupt, "axis 2 has length 0");
    expectNifti([](auto& file) { file.dim[3] = -5; }, kCorrupt, "axis 4 has length -5");
    expectNifti([](auto& file) { file.dim[3] = 7; }, kCorrupt, "bytes");
    expectMif([](auto& file) { set(file, "dim", "2,0,2,6"); }, kCorrupt, "axis 2 has length 0");
    expectMif([](auto& file) { set(file, "dim", "2,2,2,7"); }, kCorrupt, "bytes");
    expectMif([](auto& file) { set(file, "dim", "2,2,2,x"); }, kCorrupt, "dim has 'x'");
    expectMif([](auto& file) { set(file, "dim", "2,2,2,99999999999999999999"); }, kCorrupt, "whole number of 64 bits");
    expectMif([](auto& file) { set(file, "dim", ","); }, kCorrupt, "dim has 0 axes");
    expectMif(
        [](auto& file) {
            set(file, "dim", "2,2,2,6,2");
            set(file, "layout", "0,1,2,3,4");
        },
        Code::kUnsupported, "axes 4 and 5");
}

TEST_F(BadFiles, OversizedHeadersTakeNoMemory) {
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    expectNifti([](auto& file) { file.dim = {32767, 32767, 32767, 32767}; }, Code::kResourceExhausted, "16 GiB");
    expectNifti([](auto& file) { file.dim = {32767, 32767, 32767, 32767, 32767, 32767, 32767}; }, Code::kResourceExhausted, "");
    expectNifti([](auto& file) { file.dim = {32767, 32767, 3, 1}; }, Code::kCorrupt, "bytes");  // 12 GiB, below the cap
    expectMif([](auto& file) { set(file, "dim", "9223372036854775807,9223372036854775807,2,2"); }, Code::kResourceExhausted,
              "");
    expectMif([](auto& file) { set(file, "dim", "65536,65535,1,1"); }, Code::kCorrupt, "bytes");
    getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1024) << "kilobytes";
}

TEST_F(BadFiles, ASmallGzipFileThatUnpacksWithoutEndIsReadOnlyAsFarAsItsHeaderSays) {
    // 64 MiB of zeros in 64 kB: allowed to be there, but the header asks for 192 bytes of them.
    rusage before{}, after{};
    const std::string packed = test::gzip(test::bytes(nifti([](auto& file) { file.data = std::string(64 << 20, '\0'); })));
    const auto path = folder_.write("a.nii.gz", packed);
    getrusage(RUSAGE_SELF, &before);
    EXPECT_EQ(readVolume(path).data.size(), 48U);
    getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 8 * 1024) << "kilobytes";
}

TEST_F(BadFiles, OffsetsThatCannotBe) {
    expectNifti([](auto& file) { file.vox_offset = 100; }, Code::kCorrupt, "vox_offset");
    expectNifti([](auto& file) { file.vox_offset = -352; }, Code::kCorrupt, "vox_offset");
    expectNifti([](auto& file) { file.vox_offset = 1e9; }, Code::kCorrupt, "bytes");
    expectError(folder_.write("a.nii", test::bytes(nifti([](auto& file) { file.vox_offset = 352.5; }))), Code::kCorrupt,
                "whole number");
    expectError(folder_.write("a.nii", test::bytes(nifti([](auto& file) { file.vox_offset = std::nan(""); }))), Code::kCorrupt,
                "vox_offset");
    const std::string head = "mrtrix image\ndim: 2\nvox: 1\nlayout: +0\ndatatype: UInt8\nfile: . ";
    expectError(folder_.write("a.mif", head + "3\nEND\n12345"), Code::kCorrupt, "inside the header");
    expectError(folder_.write("a.mif", head + "-3\nEND\n12345"), Code::kCorrupt, "must not be negative");
    expectError(folder_.write("a.mif", head + "9223372036854775807\nEND\n12345"), Code::kCorrupt,
                "up to byte 9223372036854775809");
}

TEST_F(BadFiles, TypesThatAreNotNumbers) {
    for (const auto& [type, name] : {std::pair{32, "COMPLEX64"},
                                     {1792, "COMPLEX128"},
                                     {128, "RGB24"},
                                     {2304, "RGBA32"},
                                     {1, "BINARY"},
                                     {0, "UNKNOWN"},
                                     {9999, "9999"}}) {
        expectNifti([type = type](auto& file) { file.datatype = type; }, Code::kUnsupported, name);
    }
    expectMif([](auto& file) { set(file, "datatype", "CFloat32LE"); }, Code::kUnsupported, "'CFloat32LE', complex");
    expectMif([](auto& file) { set(file, "datatype", "CFloat64BE"); }, Code::kUnsupported, "complex");
    expectMif([](auto& file) { set(file, "datatype", "Float33LE"); }, Code::kUnsupported, "'Float33LE'");
    expectMif([](auto& file) { set(file, "datatype", "BitLE"); }, Code::kUnsupported, "'BitLE'");
}

TEST_F(BadFiles, MatricesThatAreNoGrid) {
    const double nan = std::nan("");
    expectNifti([](auto& file) { file.srow = {}; }, Code::kCorrupt, "voxel axis 1 is 0 mm long");
    expectNifti([](auto& file) { file.srow = {1, 2, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0}; }, Code::kCorrupt, "singular");
    expectNifti([=](auto& file) { file.srow[6] = nan; }, Code::kCorrupt, "must be finite");
    expectNifti([=](auto& file) { file.srow[3] = std::numeric_limits<double>::infinity(); }, Code::kCorrupt, "must be finite");
    expectNifti([=](auto& file) { file.srow[3] = 1e10; }, Code::kCorrupt, "origin");
    expectNifti([=](auto& file) { file.srow[0] = 1e7; }, Code::kCorrupt, "1e+07 mm long");
    const auto qform = [](test::NiftiFile& file) { file.sform_code = 0, file.qform_code = 1; };
    expectNifti(
        [&](auto& file) {
            qform(file);
            file.quatern = {2, 0, 0, 0, 0, 0};
        },
        Code::kCorrupt, "quatern");
    expectNifti(
        [&](auto& file) {
            qform(file);
            file.quatern = {nan, 0, 0, 0, 0, 0};
        },
        Code::kCorrupt, "quatern");
    expectNifti(
        [&](auto& file) {
            qform(file);
            file.pixdim[2] = nan;
        },
        Code::kCorrupt, "pixdim[2]");
    expectNifti(
        [&](auto& file) {
            file.sform_code = 0;
            file.pixdim[1] = 0;
        },
        Code::kCorrupt, "pixdim[1]");
    for (const std::string vox : {"0,1,1,1", "nan,1,1,1", "-1,1,1,1", "inf,1,1,1"}) {
        expectMif([&](auto& file) { set(file, "vox", vox); }, Code::kCorrupt, "vox of axis 1");
    }
    expectMif([](auto& file) { set(file, "vox", "1,1"); }, Code::kCorrupt, "vox has 2 numbers");
    expectMif([](auto& file) { set(file, "transform", "1,1,0,0,1,1,0,0,0,0,1,0"); }, Code::kCorrupt, "singular");
    expectMif([](auto& file) { set(file, "transform", "1,0,0"); }, Code::kCorrupt, "transform has 3 numbers");
    expectMif([](auto& file) { set(file, "transform", "1,0,0,nan,0,1,0,0,0,0,1,0"); }, Code::kCorrupt, "must be finite");
}

TEST_F(BadFiles, MrtrixKeysThatAreMissingTwiceOrWrong) {
    for (const std::string key : {"dim", "vox", "layout", "datatype"}) {
        expectMif([&](auto& file) { set(file, key, ""); }, Code::kCorrupt, "no '" + key + "'");
    }
    expectMif([](auto& file) { file.lines.push_back(file.lines[0]); }, Code::kCorrupt, "'dim' 2 times");
    for (const std::string layout : {"+0,+1,+2", "+0,+1,+2,+2", "+0,+1,+2,--3", "+0,+1,+2,a", "+0,+1,+2,-"}) {
        expectMif([&](auto& file) { set(file, "layout", layout); }, Code::kCorrupt, "layout");
    }
    for (const std::string scaling : {"1", "0,1,2", "nan,1", "0,inf", "a,b"}) {
        expectMif([&](auto& file) { set(file, "scaling", scaling); }, Code::kCorrupt, "scaling");
    }
    expectMif([](auto& file) { file.first_line += "\nno colon here"; }, Code::kCorrupt, "line 2 is 'no colon here'");
    expectMif([](auto& file) { file.lines.emplace_back("file", "other.dat"); }, Code::kCorrupt, "'file' 2 times");
}

TEST_F(BadFiles, HeadersWithoutEnd) {
    expectError(folder_.write("a.mif", "mrtrix image\ndim: 1\n"), Code::kCorrupt, "no END line");
    expectError(folder_.write("a.mif", "mrtrix image\n" + std::string(17 << 20, 'x')), Code::kCorrupt, "16 MiB");
    expectError(folder_.write("a.mif.gz", test::gzip("mrtrix image\n" + std::string(17 << 20, '\n'))), Code::kCorrupt,
                "16 MiB");
}

TEST_F(BadFiles, MihNamesNoFileOutsideItsFolder) {
    test::MrtrixFile file = test::mrtrixFile({2}, "+0", "UInt8");
    folder_.write("secret.dat", "12");
    folder_.write("in/side.dat", "12");
    const auto expectMih = [&](const std::string& entry, Code code, const std::string& part) {
        expectError(folder_.write("in/a.mih", test::mihText(file, entry)), code, part);
    };
    EXPECT_EQ(readVolume(folder_.write("in/a.mih", test::mihText(file, "side.dat"))).data, (std::vector<float>{'1', '2'}));
    expectMih("../secret.dat", Code::kInvalidArgument, "'../secret.dat'");
    expectMih("../in/side.dat", Code::kInvalidArgument, "without '..'");
    expectMih("deep/../../secret.dat", Code::kInvalidArgument, "without '..'");
    expectMih("/in/side.dat", Code::kInvalidArgument, "relative name");
    expectMih("/etc/passwd 0", Code::kInvalidArgument, "'/etc/passwd'");
    expectMih("missing.dat", Code::kNotFound, "'missing.dat'");
    expectMih("", Code::kNotFound, "no data file ''");
    std::filesystem::create_directory(folder_.path() / "in/deep");
    expectMih("deep", Code::kNotFound, "'deep'");
    std::filesystem::create_symlink("../secret.dat", folder_.path() / "in/link.dat");
    expectMih("link.dat", Code::kInvalidArgument, "leads out");
    std::filesystem::create_symlink("..", folder_.path() / "in/up");
    expectMih("up/secret.dat", Code::kInvalidArgument, "leads out");
    EXPECT_THROW(readVolume(folder_.write("in/a.mih", test::mihText(file, "side.dat 1"))), Error);
    expectMih("side.dat x", Code::kCorrupt, "file has 'x'");
}

TEST_F(BadFiles, MessagesShowNoControlCharactersAndAreShort) {
    test::MrtrixFile file = test::mrtrixFile({2}, "+0", "\x1b[31m\x01\xff" + std::string(5000, 'T'));
    file.data = "12";
    try {
        readVolume(folder_.write("a.mif", test::mifBytes(file)));
        FAIL();
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_LT(message.size(), 400U);
        for (const char c : message) EXPECT_TRUE(c >= 32 && c < 127);
    }
}

TEST_F(BadFiles, RandomBytesAndRandomChangesNeverDoMoreThanThrow) {
    std::mt19937 random(14);
    const std::string plain = test::bytes(nifti([](auto&) {}));
    test::MrtrixFile mrtrix = test::mrtrixFile({2, 2, 2, 6}, "-0,+1,-2,+3", "Int16BE");
    mrtrix.data = std::string(96, '\1');
    const std::string mif = test::mifBytes(mrtrix);
    int read = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string bytes = i % 2 != 0 ? plain : mif;
        for (unsigned changes = 1 + random() % 4; changes > 0; --changes) {
            bytes[random() % std::min<std::size_t>(bytes.size(), 352)] = static_cast<char>(random());
        }
        try {
            readShImage(folder_.write(i % 2 != 0 ? "a.nii" : "a.mif", bytes),
                        {.convention = {}, .axes = ShAxes::kVoxel, .full = {}});
            ++read;
        } catch (const Error& error) {
            EXPECT_NE(error.code(), Code::kInternal) << error.what();
        }
    }
    EXPECT_GT(read, 100) << "most changes should be harmless ones";
}

}  // namespace
}  // namespace radiata::io
