#include "io/vtk_lines.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "io/fibre_builder.h"
#include "io/vtk_sections.h"

namespace radiata::io {
namespace {

constexpr std::size_t kBatchFibres = std::size_t{1} << 16;

class VtkSource : public model::TractogramSource {
public:
    VtkSource(const std::filesystem::path& path, VtkSpace space)
        : path_(path), sections_(readVtkSections(path)), builder_(header_) {
        header_.source = path.filename().string();
        header_.format = "vtk";
        header_.fibre_count = sections_.lines;
        header_.remarks = sections_.remarks;
        setSpace(space);
        points_.emplace(path, sections_.text, *sections_.points);
        if (sections_.cells) cells_.emplace(path, sections_.text, *sections_.cells);
        if (sections_.offsets) {
            cells_.emplace(path, sections_.text, *sections_.ids);
            offsets_.emplace(path, sections_.text, *sections_.offsets);
            before_ = sections_.lines > 0 ? offsets_->readId() : 0;
        }
        for (const VtkArray& array : sections_.point_data) {
            if (array.tuples != sections_.points->tuples || array.type == SampleType::kBit) continue;
            header_.vertex_columns.push_back({array.name, array.components});
            vertex_.emplace_back(path, sections_.text, array);
            vertex_arrays_.push_back(array);
        }
        for (const VtkArray& array : sections_.cell_data) {
            if (array.tuples != sections_.lines || sections_.other_cells > 0 || array.type == SampleType::kBit) continue;
            header_.fibre_columns.push_back({array.name, array.components});
            fibre_.emplace_back(path, sections_.text, array);
        }
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        builder_.begin(batch);
        while (builder_.fibres() < sections_.lines && batch.fibreCount() < kBatchFibres &&
               (batch.fibreCount() == 0 || batch.points.size() < points_wanted)) {
            readLine(batch);
        }
        return batch.fibreCount() > 0;
    }

    std::uint64_t damagedFibres() const override { return builder_.damagedFibres(); }
    std::uint64_t bytesRead() const override { return cells_ ? cells_->bytesRead() : 0; }
    std::uint64_t bytesTotal() const override {
        std::error_code failure;
        return std::filesystem::file_size(path_, failure);
    }

private:
    void setSpace(VtkSpace space) {
        const bool lps = sections_.title.find("SPACE=LPS") != std::string::npos;
        const bool said = lps || sections_.title.find("SPACE=RAS") != std::string::npos;
        if (space == VtkSpace::kLps || (space == VtkSpace::kAuto && lps)) sign_ = {-1, -1, 1};
        if (space == VtkSpace::kAuto && !said) {
            header_.remarks += "The file does not say which way its axes point; RAS is assumed, --vtk-space lps asks for LPS. ";
        }
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(Code::kCorrupt, header_.source + ": line " + std::to_string(builder_.fibres()) + " " + what);
    }

    std::uint64_t nextCount() {
        std::int64_t count = 0;
        if (offsets_) {
            const std::int64_t end = offsets_->readId();
            count = end < before_ || before_ < 0 ? -1 : end - before_;
            before_ = end;
        } else {
            count = cells_->readId();
        }
        if (count < 0 || static_cast<std::uint64_t>(count) > kFibrePointsMax) {
            fail("has a count of points that is negative, too large or no number");
        }
        return static_cast<std::uint64_t>(count);
    }

    void readLine(model::FibreBatch& batch) {
        const std::uint64_t count = nextCount();
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::int64_t id = cells_->readId();
            if (id < 0 || static_cast<std::uint64_t>(id) >= sections_.points->tuples) {
                fail("names point " + std::to_string(id) + "; there are " + std::to_string(sections_.points->tuples) +
                     ", counted from 0");
            }
            addPoint(static_cast<std::uint64_t>(id), batch);
        }
        values_.clear();
        for (std::size_t c = 0; c < fibre_.size(); ++c) {
            fibre_[c].read(static_cast<std::uint64_t>(header_.fibre_columns[c].components), values_);
        }
        builder_.endFibre(values_);
    }

    void addPoint(std::uint64_t id, model::FibreBatch& batch) {
        if (held_points_.empty() && id != next_) hold();
        const float* point = nullptr;
        if (held_points_.empty()) {
            values_.clear();
            points_->read(3, values_);
            point = values_.data();
        } else {
            point = held_points_.data() + 3 * id;
        }
        const glm::vec3 p(sign_ * glm::vec3(point[0], point[1], point[2]));
        if (!usable(p)) builder_.damage();
        builder_.addPoint(p);
        for (std::size_t c = 0; c < vertex_.size(); ++c) {
            const auto n = static_cast<std::uint64_t>(vertex_arrays_[c].components);
            if (held_values_.empty()) {
                vertex_[c].read(n, batch.vertex_values[c]);
            } else {
                const auto first = held_values_[c].begin() + static_cast<std::ptrdiff_t>(id * n);
                batch.vertex_values[c].insert(batch.vertex_values[c].end(), first, first + static_cast<std::ptrdiff_t>(n));
            }
        }
        ++next_;
    }

    /// Lines that jump among the points need them all.
    void hold() {
        VtkNumbers all(path_, sections_.text, *sections_.points);
        all.read(3 * sections_.points->tuples, held_points_);
        for (const VtkArray& array : vertex_arrays_) {
            VtkNumbers values(path_, sections_.text, array);
            held_values_.emplace_back();
            values.read(array.tuples * static_cast<std::uint64_t>(array.components), held_values_.back());
        }
    }

    std::filesystem::path path_;
    VtkSections sections_;
    model::TractogramHeader header_;
    FibreBuilder builder_;
    glm::vec3 sign_{1};
    std::optional<VtkNumbers> points_, cells_, offsets_;
    std::vector<VtkNumbers> vertex_, fibre_;
    std::vector<VtkArray> vertex_arrays_;
    std::vector<float> values_, held_points_;
    std::vector<std::vector<float>> held_values_;
    std::uint64_t next_ = 0;
    std::int64_t before_ = 0;
};

}  // namespace

std::unique_ptr<model::TractogramSource> openVtkLines(const std::filesystem::path& path, VtkSpace space) {
    return std::make_unique<VtkSource>(path, space);
}

}  // namespace radiata::io
