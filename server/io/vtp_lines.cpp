#include "io/vtp_lines.h"

#include <algorithm>

#include "base/checked.h"
#include "base/error.h"
#include "io/fibre_builder.h"
#include "io/text.h"
#include "io/vtp_document.h"
#include "io/vtp_numbers.h"

namespace radiata::io {
namespace {

constexpr std::size_t kBatchFibres = std::size_t{1} << 16;

class VtpSource : public model::TractogramSource {
public:
    VtpSource(const std::filesystem::path& path, VtkSpace space) : document_(readVtpDocument(path)), builder_(header_) {
        header_.source = document_.name();
        header_.format = "vtp";
        header_.remarks = document_.remarks;
        setSpace(space);
        std::uint64_t cells = 0;
        for (const VtpPiece& piece : document_.pieces) {
            lines_ = checkedAdd(lines_, piece.lines, header_.source);
            cells = checkedAdd(cells, piece.cells, header_.source);
        }
        if (lines_ == 0 && cells > 0) throw Error(Code::kCorrupt, header_.source + ": has cells, but none of them are lines");
        header_.fibre_count = lines_;
        nextPiece();
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        builder_.begin(batch);
        while (builder_.fibres() < lines_ && batch.fibreCount() < kBatchFibres &&
               (batch.fibreCount() == 0 || batch.points.size() < points_wanted)) {
            if (line_ == document_.pieces[piece_].lines) {
                ++piece_;
                nextPiece();
            }
            readLine(batch);
        }
        return batch.fibreCount() > 0;
    }

    std::uint64_t damagedFibres() const override { return builder_.damagedFibres(); }
    /// Arrays lie one behind the other and are read side by side, so this is the share of lines.
    std::uint64_t bytesRead() const override {
        const double share = lines_ == 0 ? 1 : static_cast<double>(builder_.fibres()) / static_cast<double>(lines_);
        return static_cast<std::uint64_t>(share * static_cast<double>(bytesTotal()));
    }
    std::uint64_t bytesTotal() const override {
        std::error_code failure;
        return std::filesystem::file_size(document_.path, failure);
    }

private:
    /// An array of the piece, and its numbers.
    struct Column {
        const VtpArray* array = nullptr;
        VtpNumbers numbers;
        std::vector<float> held;
        std::uint64_t components() const { return static_cast<std::uint64_t>(array->components); }
    };

    void setSpace(VtkSpace space) {
        const bool lps = document_.space.find("SPACE=LPS") != std::string::npos;
        const bool said = lps || document_.space.find("SPACE=RAS") != std::string::npos;
        if (space == VtkSpace::kLps || (space == VtkSpace::kAuto && lps)) sign_ = {-1, -1, 1};
        if (space == VtkSpace::kAuto && !said) {
            header_.remarks += "The file does not say which way its axes point; RAS is assumed, --vtk-space lps asks for LPS. ";
        }
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(Code::kCorrupt, header_.source + ": line " + std::to_string(builder_.fibres()) + " " + what);
    }

    Column column(const VtpArray& array, std::uint64_t tuples) const {
        const std::uint64_t count = checkedMultiply(tuples, static_cast<std::uint64_t>(array.components), header_.source);
        return {&array, VtpNumbers(document_, array, count), {}};
    }

    /// Those of a piece that the header names; the first piece makes the header.
    std::vector<Column> columns(const std::vector<VtpArray>& arrays, std::uint64_t tuples, bool first,
                                std::vector<model::ColumnName>& names) const {
        if (first) {
            for (const VtpArray& array : arrays) names.push_back({array.name, array.components});
        }
        std::vector<Column> found;
        for (std::size_t c = 0; c < names.size(); ++c) {
            auto own = first ? arrays.begin() + static_cast<std::ptrdiff_t>(c)
                             : std::find_if(arrays.begin(), arrays.end(), [&](const VtpArray& array) {
                                   return array.name == names[c].name && array.components == names[c].components;
                               });
            if (own == arrays.end()) {
                throw Error(Code::kCorrupt, header_.source + ": piece " + std::to_string(piece_) + " has no array " +
                                                shown(names[c].name) + " of " + std::to_string(names[c].components) +
                                                " components, which an earlier piece has");
            }
            found.push_back(column(*own, tuples));
        }
        return found;
    }

    /// Goes on to the next piece with lines, if there is one.
    void nextPiece() {
        while (piece_ < document_.pieces.size() && document_.pieces[piece_].lines == 0) ++piece_;
        if (piece_ == document_.pieces.size()) return;
        const VtpPiece& piece = document_.pieces[piece_];
        points_.emplace(column(piece.coordinates, piece.points));
        ids_.emplace(document_, piece.ids, std::nullopt);
        offsets_.emplace(document_, piece.offsets, piece.lines);
        vertex_ = columns(piece.point_data, piece.points, first_, header_.vertex_columns);
        fibre_ = columns(piece.cell_data, piece.cells, first_, header_.fibre_columns);
        for (Column& values : fibre_) {
            values.numbers.skip(checkedMultiply(piece.cells_ahead, values.components(), header_.source));
        }
        first_ = held_ = false;
        line_ = next_ = 0;
        before_ = 0;
    }

    void readLine(model::FibreBatch& batch) {
        const VtpPiece& piece = document_.pieces[piece_];
        const std::int64_t end = offsets_->readId();
        if (end < before_ || static_cast<std::uint64_t>(end - before_) > kFibrePointsMax) {
            fail("ends at the offset " + std::to_string(end) + ", after one that ends at " + std::to_string(before_) +
                 "; offsets must ascend, by at most " + std::to_string(kFibrePointsMax));
        }
        for (; before_ < end; ++before_) {
            const std::int64_t id = ids_->readId();
            if (id < 0 || static_cast<std::uint64_t>(id) >= piece.points) {
                fail("names point " + std::to_string(id) + "; there are " + std::to_string(piece.points) + ", counted from 0");
            }
            addPoint(static_cast<std::uint64_t>(id), batch);
        }
        values_.clear();
        for (Column& values : fibre_) values.numbers.read(values.components(), values_);
        builder_.endFibre(values_);
        ++line_;
    }

    void addPoint(std::uint64_t id, model::FibreBatch& batch) {
        if (!held_ && id != next_) hold();
        values_.clear();
        append(*points_, id, values_);
        const glm::vec3 p(sign_ * glm::vec3(values_[0], values_[1], values_[2]));
        if (!usable(p)) builder_.damage();
        builder_.addPoint(p);
        for (std::size_t c = 0; c < vertex_.size(); ++c) append(vertex_[c], id, batch.vertex_values[c]);
        ++next_;
    }

    void append(Column& column, std::uint64_t id, std::vector<float>& out) const {
        if (!held_) return column.numbers.read(column.components(), out);
        const auto first = column.held.begin() + static_cast<std::ptrdiff_t>(id * column.components());
        out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(column.components()));
    }

    /// Lines that jump among the points need them all. Memory grows with what is decoded, not with what is claimed.
    void hold() {
        const VtpPiece& piece = document_.pieces[piece_];
        const auto all = [&](Column& own) {
            own = column(*own.array, piece.points);
            own.numbers.read(piece.points * own.components(), own.held);
        };
        all(*points_);
        for (Column& values : vertex_) all(values);
        held_ = true;
    }

    VtpDocument document_;
    model::TractogramHeader header_;
    FibreBuilder builder_;
    glm::vec3 sign_{1};
    std::uint64_t lines_ = 0;
    std::size_t piece_ = 0;
    std::uint64_t line_ = 0, next_ = 0;
    std::int64_t before_ = 0;
    bool first_ = true, held_ = false;
    std::optional<Column> points_;
    std::optional<VtpNumbers> ids_, offsets_;
    std::vector<Column> vertex_, fibre_;
    std::vector<float> values_;
};

}  // namespace

std::unique_ptr<model::TractogramSource> openVtpLines(const std::filesystem::path& path, VtkSpace space) {
    return std::make_unique<VtpSource>(path, space);
}

}  // namespace radiata::io
