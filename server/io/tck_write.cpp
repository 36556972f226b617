// Writing .tck files, and .tsf and text files for their columns.
#include <array>
#include <charconv>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "io/tck.h"
#include "io/write_file.h"

namespace radiata::io {
namespace {

constexpr std::size_t kBatchPoints = std::size_t{1} << 18;
constexpr std::size_t kCountDigits = 10;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

/// The header with its count in a field of fixed width, so that it can be written again when the count is known.
std::string headerText(const std::string& magic, std::uint64_t count) {
    std::string digits = std::to_string(count);
    digits.insert(0, kCountDigits - std::min(kCountDigits, digits.size()), '0');
    const std::string fixed = magic + "\ndatatype: Float32LE\ncount: " + digits + "\nfile: . ";
    // The offset's own digits are part of the header.
    std::size_t length = fixed.size() + std::string("\nEND\n").size();
    length += std::to_string(length + 3).size();
    const std::size_t padded = (length + 3) / 4 * 4;
    std::string text = fixed + std::to_string(padded) + "\nEND\n";
    text.resize(padded, '\n');
    return text;
}

/// "name" or, of a column with several components, "name_0", "name_1", ...; no folders within.
std::filesystem::path sideFile(const std::filesystem::path& tracks, const model::ColumnName& column, int component,
                               const std::string& suffix) {
    std::string name = column.name;
    for (char& c : name) {
        if (c == '/' || c < ' ') c = '_';
    }
    std::filesystem::path path = tracks.parent_path() / tracks.stem();
    path += "_" + name + (column.components > 1 ? "_" + std::to_string(component) : "") + suffix;
    return path;
}

/// One component of one column.
struct Side {
    std::size_t column;
    int component, components;
    std::unique_ptr<WriteFile> file;
};

std::vector<Side> openSides(const std::vector<model::ColumnName>& columns, const std::filesystem::path& path,
                            const std::string& suffix) {
    std::vector<Side> sides;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        for (int i = 0; i < columns[c].components; ++i) {
            sides.push_back({c, i, columns[c].components, std::make_unique<WriteFile>(sideFile(path, columns[c], i, suffix))});
        }
    }
    return sides;
}

void writeScalars(Side& side, const model::FibreBatch& batch, std::vector<float>& numbers) {
    const std::vector<float>& values = batch.vertex_values[side.column];
    numbers.clear();
    for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
        for (std::uint64_t p = batch.offsets[f]; p < batch.offsets[f + 1]; ++p) {
            const float value =
                values[p * static_cast<std::uint64_t>(side.components) + static_cast<std::uint64_t>(side.component)];
            // NaN would end the track and infinity the file.
            numbers.push_back(value - value == 0 ? value : 0);
        }
        numbers.push_back(kNan);
    }
    side.file->writeNumbers<float>(numbers);
}

void writeText(Side& side, const model::FibreBatch& batch) {
    const std::vector<float>& values = batch.fibre_values[side.column];
    std::string text;
    for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
        std::array<char, 32> digits{};
        const float value = values[f * static_cast<std::size_t>(side.components) + static_cast<std::size_t>(side.component)];
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
        text.append(digits.data(), end);
        text += '\n';
    }
    side.file->write(text);
}

}  // namespace

std::vector<std::filesystem::path> writeTck(model::TractogramSource& source, const std::filesystem::path& path, bool columns) {
    const model::TractogramHeader& header = source.header();
    WriteFile tracks(path);
    std::vector<Side> scalars, texts;
    if (columns) {
        scalars = openSides(header.vertex_columns, path, ".tsf");
        texts = openSides(header.fibre_columns, path, ".txt");
    }
    tracks.write(headerText("mrtrix tracks", 0));
    for (Side& side : scalars) side.file->write(headerText("mrtrix track scalars", 0));

    model::FibreBatch batch;
    std::vector<glm::vec3> triplets;
    std::vector<float> numbers;
    std::uint64_t count = 0;
    while (source.read(batch, kBatchPoints)) {
        triplets.clear();
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            const std::span<const glm::vec3> fibre = batch.fibre(f);
            triplets.insert(triplets.end(), fibre.begin(), fibre.end());
            triplets.emplace_back(kNan);
        }
        tracks.writeNumbers<glm::vec3>(triplets);
        for (Side& side : scalars) writeScalars(side, batch, numbers);
        for (Side& side : texts) writeText(side, batch);
        count += batch.fibreCount();
    }
    const std::array<glm::vec3, 1> end{glm::vec3(kInf)};
    tracks.writeNumbers<glm::vec3>(end);
    tracks.seek(0);
    tracks.write(headerText("mrtrix tracks", count));
    tracks.finish();
    std::vector<std::filesystem::path> written{path};
    for (Side& side : scalars) {
        side.file->writeNumbers<float>(std::array{kInf});
        side.file->seek(0);
        side.file->write(headerText("mrtrix track scalars", count));
    }
    for (auto* sides : {&scalars, &texts}) {
        for (Side& side : *sides) {
            side.file->finish();
            written.push_back(side.file->path());
        }
    }
    return written;
}

}  // namespace radiata::io
