#include "io/track_columns.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "io/byte_source.h"
#include "io/fibre_builder.h"
#include "io/tck.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::uint64_t kTextMax = std::uint64_t{1} << 33;

/// Values of one .tsf file, fibre by fibre.
class ScalarFile {
public:
    explicit ScalarFile(const std::filesystem::path& path) : numbers_(path, "mrtrix track scalars", 1) {}

    std::string name() const { return numbers_.source().name(); }

    /// Appends the next fibre's values. \return how many
    std::size_t readFibre(std::vector<float>& out, std::uint64_t fibre) {
        std::size_t count = 0;
        for (;;) {
            const std::span<const float> values = numbers_.buffered();
            if (values.empty() && count > 0) numbers_.failCutOff(fibre);
            if (values.empty()) failTooFew(fibre);  // MRtrix3 writes no end mark into these files
            std::size_t run = 0;
            while (run < values.size() && !std::isnan(values[run]) && !std::isinf(values[run])) ++run;
            if (count + run > kFibrePointsMax) {
                throw Error(Code::kResourceExhausted, name() + ": fibre " + std::to_string(fibre) + " has more than " +
                                                          std::to_string(kFibrePointsMax) +
                                                          " values; separators seem to be missing");
            }
            out.insert(out.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(run));
            count += run;
            const bool stopped = run < values.size();
            if (stopped && std::isinf(values[run])) failTooFew(fibre);
            numbers_.take(run + (stopped ? 1 : 0));
            if (stopped) return count;
        }
    }

    /// \throws Error(kCorrupt) if values of more fibres follow
    void requireEnd(std::uint64_t fibres) {
        const std::span<const float> values = numbers_.buffered();
        if (!values.empty() && !std::isinf(values.front())) {
            throw Error(Code::kCorrupt, name() + ": goes on after the values of all " + std::to_string(fibres) +
                                            " fibres; the two files do not belong together");
        }
    }

private:
    [[noreturn]] void failTooFew(std::uint64_t fibres) const {
        throw Error(Code::kCorrupt, name() + ": holds values of " + std::to_string(fibres) +
                                        " fibres, and the tracks go on; the two files do not belong together");
    }

    TckNumbers numbers_;
};

struct TextColumn {
    std::string file;
    int components = 1;
    std::uint64_t rows = 0;
    std::vector<float> values;
};

float numberOf(std::string_view text, const std::string& file, std::size_t line) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || failure == std::errc::invalid_argument) {
        throw Error(Code::kCorrupt, file + ": line " + std::to_string(line) + " holds " + shown(text) + ", which is no number");
    }
    if (failure == std::errc::result_out_of_range) value = std::numeric_limits<double>::quiet_NaN();
    return static_cast<float>(value);
}

TextColumn readText(const std::filesystem::path& path) {
    ByteSource source(path);
    if (source.fileBytes() > kTextMax) {
        throw Error(Code::kResourceExhausted, source.name() + ": a column of text has at most " + std::to_string(kTextMax) +
                                                  " bytes, this file has " + std::to_string(source.fileBytes()));
    }
    std::string text(source.fileBytes(), '\0');
    text.resize(source.read(std::as_writable_bytes(std::span(text))));
    TextColumn column;
    column.file = source.name();
    bool even = true;
    std::size_t width = 0, number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line(text.data() + begin, end - begin);
        begin = end + 1;
        ++number;
        line = line.substr(0, line.find('#'));
        std::size_t in_line = 0;
        for (std::size_t at = line.find_first_not_of(" \t\r,"); at != line.npos; at = line.find_first_not_of(" \t\r,", at)) {
            const std::size_t stop = std::min(line.find_first_of(" \t\r,", at), line.size());
            column.values.push_back(numberOf(line.substr(at, stop - at), column.file, number));
            at = stop;
            ++in_line;
        }
        if (in_line == 0) continue;
        if (column.rows == 0) width = in_line;
        even = even && in_line == width;
        ++column.rows;
    }
    if (even && column.rows > 1 && width > 1) {
        column.components = static_cast<int>(width);
    } else {
        column.rows = column.values.size();
    }
    return column;
}

class ColumnSource : public model::TractogramSource {
public:
    ColumnSource(std::unique_ptr<model::TractogramSource> source, const std::vector<std::filesystem::path>& files)
        : source_(std::move(source)), header_(source_->header()) {
        own_vertex_ = header_.vertex_columns.size();
        own_fibre_ = header_.fibre_columns.size();
        for (const auto& file : files) {
            const std::string suffix = file.extension().string(),
                              prefix = header_.source.substr(0, header_.source.find('.')) + "_";
            std::string name = file.stem().string();
            if (name.size() > prefix.size() && name.starts_with(prefix)) name.erase(0, prefix.size());
            if (suffix == ".tsf") {
                scalars_.push_back(std::make_unique<ScalarFile>(file));
                header_.vertex_columns.push_back({name, 1});
            } else if (suffix == ".txt" || suffix == ".csv" || suffix == ".dat") {
                texts_.push_back(readText(file));
                header_.fibre_columns.push_back({name, texts_.back().components});
            } else {
                throw Error(Code::kUnsupported, file.filename().string() +
                                                    ": columns of a track file are read from .tsf, .txt, .csv and .dat files");
            }
        }
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        const bool more = source_->read(batch, points_wanted);
        batch.vertex_values.resize(own_vertex_ + scalars_.size());
        batch.fibre_values.resize(own_fibre_ + texts_.size());
        for (std::size_t c = 0; c < scalars_.size(); ++c) addScalars(*scalars_[c], batch, batch.vertex_values[own_vertex_ + c]);
        for (std::size_t c = 0; c < texts_.size(); ++c) addText(texts_[c], batch, batch.fibre_values[own_fibre_ + c]);
        fibres_ += batch.fibreCount();
        if (!more) requireEnd();
        return more;
    }

    std::vector<model::FibreGroup> groups() override { return source_->groups(); }
    std::uint64_t damagedFibres() const override { return source_->damagedFibres(); }
    std::uint64_t bytesRead() const override { return source_->bytesRead(); }
    std::uint64_t bytesTotal() const override { return source_->bytesTotal(); }

private:
    void addScalars(ScalarFile& file, const model::FibreBatch& batch, std::vector<float>& values) const {
        values.clear();
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            const std::size_t points = batch.fibre(f).size(), before = values.size();
            const std::size_t count = file.readFibre(values, fibres_ + f);
            // A fibre that was left out for its coordinates has no points, but values in the other file.
            if (points == 0 && source_->damagedFibres() > 0) values.resize(before);
            if (values.size() - before != points) {
                throw Error(Code::kCorrupt, file.name() + ": holds " + std::to_string(count) + " values of fibre " +
                                                std::to_string(fibres_ + f) + ", which has " + std::to_string(points) +
                                                " points");
            }
        }
    }

    void addText(const TextColumn& column, const model::FibreBatch& batch, std::vector<float>& values) const {
        const std::uint64_t n = static_cast<std::uint64_t>(column.components), end = fibres_ + batch.fibreCount();
        if (end > column.rows) failCount(column, end, "at least ");
        const auto begin = column.values.begin();
        values.assign(begin + static_cast<std::ptrdiff_t>(fibres_ * n), begin + static_cast<std::ptrdiff_t>(end * n));
    }

    void requireEnd() {
        for (const auto& file : scalars_) file->requireEnd(fibres_);
        for (const TextColumn& column : texts_) {
            if (column.rows != fibres_) failCount(column, fibres_, "");
        }
    }

    [[noreturn]] void failCount(const TextColumn& column, std::uint64_t fibres, const std::string& bound) const {
        throw Error(Code::kCorrupt, column.file + ": holds values of " + std::to_string(column.rows) + " fibres, and " +
                                        header_.source + " has " + bound + std::to_string(fibres));
    }

    std::unique_ptr<model::TractogramSource> source_;
    model::TractogramHeader header_;
    std::vector<std::unique_ptr<ScalarFile>> scalars_;
    std::vector<TextColumn> texts_;
    std::size_t own_vertex_ = 0, own_fibre_ = 0;
    std::uint64_t fibres_ = 0;
};

}  // namespace

std::unique_ptr<model::TractogramSource> withColumns(std::unique_ptr<model::TractogramSource> source,
                                                     const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return source;
    return std::make_unique<ColumnSource>(std::move(source), files);
}

}  // namespace radiata::io
