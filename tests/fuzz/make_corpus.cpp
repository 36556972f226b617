// Writes small valid image files as seed corpora: make_corpus FOLDER makes FOLDER/{nifti,nifti_gz,mif,mif_gz,mih,nrrd,nhdr}/…
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "unit/io/image_bytes.h"

namespace {

using namespace radiata::test;

void write(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

std::vector<double> values(std::size_t count) {
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(i % 5 == 0 ? 0.0 : static_cast<double>(i % 7));
    return result;
}

void writeNifti(const std::filesystem::path& folder) {
    for (const std::string type : {"uint8", "int16", "int32", "uint64", "float32", "float64", "float128"}) {
        for (const int version : {1, 2}) {
            for (const bool big : {false, true}) {
                NiftiFile file;
                file.version = version;
                file.big_endian = big;
                file.dim = {3, 2, 2, 6};
                file.datatype = niftiDatatype(type);
                file.slope = type == "int16" ? 0.5 : 1;
                file.sform_code = big ? 0 : 1;
                file.qform_code = big ? 1 : 0;
                file.quatern = {0.1, 0.2, 0.3, 1, 2, 3};
                file.data = encode(values(72), type, big);
                const std::string name = type + "_" + std::to_string(version) + (big ? "b" : "l");
                write(folder / "nifti" / name, bytes(file));
                write(folder / "nifti_gz" / name, gzip(bytes(file)));
            }
        }
    }
}

void writeMrtrix(const std::filesystem::path& folder) {
    const std::vector<std::pair<std::string, std::string>> types{{"bit", "Bit"},           {"int8", "Int8"},
                                                                 {"uint16", "UInt16LE"},   {"int32", "Int32BE"},
                                                                 {"float32", "Float32LE"}, {"float64", "Float64BE"}};
    for (const auto& [type, name] : types) {
        for (const std::string layout : {"+0,+1,+2,+3", "-1,-2,+3,+0"}) {
            MrtrixFile file = mrtrixFile({3, 2, 2, 6}, layout, name);
            if (type == "uint16") set(file, "scaling", "0.5,2");
            if (type == "int32") set(file, "transform", "");
            file.data = encode(values(72), type, name.ends_with("BE"));
            const std::string seed = type + (layout.front() == '+' ? "_a" : "_b");
            write(folder / "mif" / seed, mifBytes(file));
            write(folder / "mif_gz" / seed, gzip(mifBytes(file)));
            write(folder / "mih" / seed, mihText(file, "data.dat 16"));
        }
    }
}

void writeNrrd(const std::filesystem::path& folder) {
    const std::vector<std::pair<std::string, std::string>> types{{"int8", "signed char"}, {"uint16", "ushort"},
                                                                 {"int32", "int"},        {"uint64", "ulonglong"},
                                                                 {"float32", "float"},    {"float64", "double"}};
    for (const auto& [type, name] : types) {
        for (const bool big : {false, true}) {
            const std::string fields =
                std::string("NRRD0004\n# seed\ndimension: 3\nsizes: 4 3 2\nspace: left-posterior-superior\n") +
                "space directions: (1,0,0) (0,2,0) (0,0.5,3)\nspace origin: (-1,2,3)\nendian: " + (big ? "big" : "little") +
                "\ntype: " + name + "\n";
            const std::string data = encode(values(24), type, big), seed = type + (big ? "_b" : "_l");
            write(folder / "nrrd" / (seed + "_raw"), fields + "encoding: raw\n\n" + data);
            write(folder / "nrrd" / (seed + "_gzip"), fields + "encoding: gzip\n\n" + gzip(data));
            write(folder / "nhdr" / seed,
                  fields + "encoding: raw\ndata file: data.dat\nbyte skip: " + (big ? "-1" : "8") + "\n");
        }
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: make_corpus FOLDER\n");
        return 2;
    }
    try {
        writeNifti(arguments[1]);
        writeMrtrix(arguments[1]);
        writeNrrd(arguments[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_corpus: %s\n", error.what());
        return 1;
    }
    return 0;
}
