// Writing .trx files: arrays into a folder, which is then packed.
#include <minizip/zip.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/trx.h"
#include "io/write_file.h"

namespace radiata::io {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kBatchPoints = std::size_t{1} << 18;
constexpr std::size_t kCopyBytes = std::size_t{1} << 20;

/// Removed with all in it unless it was kept.
class PartFolder {
public:
    explicit PartFolder(fs::path path) : path_(std::move(path)) {
        std::error_code failure;
        fs::remove_all(path_, failure);
        fs::create_directories(path_, failure);
        if (failure) throw Error(Code::kUnavailable, path_.string() + ": cannot be created (" + failure.message() + ")");
    }
    ~PartFolder() {
        std::error_code ignored;
        if (!kept_) fs::remove_all(path_, ignored);
    }
    PartFolder(const PartFolder&) = delete;
    PartFolder& operator=(const PartFolder&) = delete;
    const fs::path& path() const { return path_; }
    void moveTo(const fs::path& target) {
        std::error_code failure;
        fs::rename(path_, target, failure);
        if (failure)
            throw Error(Code::kUnavailable, target.string() + ": cannot be given its name (" + failure.message() + ")");
        kept_ = true;
    }

private:
    fs::path path_;
    bool kept_ = false;
};

/// Dots separate the parts of an array's name, slashes folders.
std::string cleaned(std::string name) {
    for (char& c : name) {
        if (c == '/' || c == '\\' || c == '.' || (c >= 0 && c < ' ')) c = '_';
    }
    return name;
}

std::string arrayName(const model::ColumnName& column) {
    return cleaned(column.name) + (column.components > 1 ? "." + std::to_string(column.components) : "") + ".float32";
}

using Files = std::vector<std::unique_ptr<WriteFile>>;

Files openColumns(const std::vector<model::ColumnName>& columns, const fs::path& folder) {
    Files files;
    if (columns.empty()) return files;
    fs::create_directories(folder);
    for (const model::ColumnName& column : columns) files.push_back(std::make_unique<WriteFile>(folder / arrayName(column)));
    return files;
}

void writeGroups(const std::vector<model::FibreGroup>& groups, const fs::path& folder) {
    for (const model::FibreGroup& group : groups) {
        fs::create_directories(folder / "groups");
        const std::string name = cleaned(group.name);
        WriteFile file(folder / "groups" / (name + ".uint32"));
        file.writeNumbers<std::uint32_t>(group.fibres);
        file.finish();
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            fs::create_directories(folder / "dpg" / name);
            WriteFile value(folder / "dpg" / name / arrayName(group.columns[c]));
            value.writeNumbers<float>(group.values[c]);
            value.finish();
        }
    }
}

std::string headerJson(const model::TractogramHeader& header, std::uint64_t fibres, std::uint64_t points) {
    const glm::dmat4 matrix = header.voxel_to_world.value_or(glm::dmat4(1.0));
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (int r = 0; r < 4; ++r) rows.push_back({matrix[0][r], matrix[1][r], matrix[2][r], matrix[3][r]});
    const glm::ivec3 size = glm::max(header.grid_size, glm::ivec3(1));
    const nlohmann::ordered_json json{{"DIMENSIONS", {size.x, size.y, size.z}},
                                      {"VOXEL_TO_RASMM", rows},
                                      {"NB_VERTICES", points},
                                      {"NB_STREAMLINES", fibres}};
    return json.dump() + "\n";
}

void writeArrays(model::TractogramSource& source, const fs::path& folder) {
    const model::TractogramHeader& header = source.header();
    WriteFile positions(folder / "positions.3.float32"), offsets(folder / "offsets.uint64");
    const Files vertex = openColumns(header.vertex_columns, folder / "dpv");
    const Files fibre = openColumns(header.fibre_columns, folder / "dps");
    model::FibreBatch batch;
    std::uint64_t fibres = 0, points = 0;
    offsets.writeNumbers<std::uint64_t>(std::array{points});
    while (source.read(batch, kBatchPoints)) {
        positions.writeNumbers<glm::vec3>(batch.points);
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) batch.offsets[f] = points + batch.offsets[f + 1];
        offsets.writeNumbers<std::uint64_t>(std::span(batch.offsets).first(batch.fibreCount()));
        for (std::size_t c = 0; c < vertex.size(); ++c) vertex[c]->writeNumbers<float>(batch.vertex_values[c]);
        for (std::size_t c = 0; c < fibre.size(); ++c) fibre[c]->writeNumbers<float>(batch.fibre_values[c]);
        fibres += batch.fibreCount();
        points += batch.points.size();
    }
    positions.finish();
    offsets.finish();
    for (const Files* files : {&vertex, &fibre}) {
        for (const auto& file : *files) file->finish();
    }
    writeGroups(source.groups(), folder);
    WriteFile json(folder / "header.json");
    json.write(headerJson(header, fibres, points));
    json.finish();
}

/// Copies one file into the zip file that is open.
void packFile(zipFile zip, const fs::path& file, const std::string& name, const fs::path& target) {
    const auto fail = [&] {
        throw Error(Code::kUnavailable, target.string() + ": cannot be written (" + std::strerror(errno) + ")");
    };
    zip_fileinfo info{};
    info.tmz_date = {0, 0, 0, 1, 0, 1980};  // equal fibres give equal bytes
    if (zipOpenNewFileInZip64(zip, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, 0, 0, 1) != ZIP_OK) fail();
    std::ifstream in(file, std::ios::binary);
    std::vector<char> block(kCopyBytes);
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0) {
        if (zipWriteInFileInZip(zip, block.data(), static_cast<unsigned>(in.gcount())) != ZIP_OK) fail();
    }
    if (in.bad() || zipCloseFileInZip(zip) != ZIP_OK) fail();
}

void pack(const fs::path& folder, const fs::path& target) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(folder).generic_string());
    }
    std::sort(names.begin(), names.end());
    fs::path part = folder;
    part += ".zip";
    zipFile zip = zipOpen64(part.c_str(), APPEND_STATUS_CREATE);
    if (zip == nullptr) throw Error(Code::kUnavailable, target.string() + ": cannot be created (" + std::strerror(errno) + ")");
    std::error_code failure;
    try {
        for (const std::string& name : names) packFile(zip, folder / name, name, target);
    } catch (...) {
        zipClose(zip, nullptr);
        fs::remove(part, failure);
        throw;
    }
    if (zipClose(zip, nullptr) == ZIP_OK) fs::rename(part, target, failure);
    if (!fs::exists(part)) return;
    fs::remove(part, failure);
    throw Error(Code::kUnavailable, target.string() + ": cannot be written");
}

}  // namespace

void writeTrx(model::TractogramSource& source, const fs::path& path) {
    const bool folder = !path.has_filename();
    const fs::path target = folder ? path.parent_path() : path;
    if (folder && fs::exists(target) && !(fs::is_directory(target) && fs::is_empty(target))) {
        throw Error(Code::kInvalidArgument,
                    target.string() + ": there is something of this name; a new or empty folder is needed");
    }
    fs::path part = target;
    part += ".part";
    PartFolder gathered(part);
    writeArrays(source, gathered.path());
    if (folder) {
        gathered.moveTo(target);
    } else {
        pack(gathered.path(), target);
    }
}

}  // namespace radiata::io
