#include "model/tractogram.h"

#include <algorithm>

#include "base/checked.h"
#include "base/error.h"

namespace radiata::model {
namespace {

constexpr std::size_t kReadAllPoints = std::size_t{1} << 20;

std::uint64_t bytesOf(const FibreBatch& batch) {
    std::uint64_t bytes = batch.points.size() * sizeof(glm::vec3) + batch.offsets.size() * sizeof(std::uint64_t);
    for (const auto& values : batch.vertex_values) bytes += values.size() * sizeof(float);
    for (const auto& values : batch.fibre_values) bytes += values.size() * sizeof(float);
    return bytes;
}

std::size_t findColumn(const std::vector<ColumnName>& columns, const std::string& name, const std::string& source,
                       const char* kind) {
    std::string known;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].name == name) return i;
        known += (i == 0 ? "" : ", ") + columns[i].name;
    }
    throw Error(Code::kNotFound, source + ": there is no " + kind + " column '" + name + "'; " +
                                     (columns.empty() ? "there are none" : "there are: " + known));
}

/// The fibres [first, last) of a batch.
void copyFibres(const FibreBatch& all, const TractogramHeader& header, std::size_t first, std::size_t last, FibreBatch& out) {
    const std::uint64_t begin = all.offsets[first], end = all.offsets[last];
    const auto at = [](const auto& values, std::uint64_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
    out.first_fibre = first;
    out.first_point = begin;
    out.points.assign(at(all.points, begin), at(all.points, end));
    for (std::size_t f = first; f < last; ++f) out.offsets.push_back(all.offsets[f + 1] - begin);
    for (std::size_t c = 0; c < header.vertex_columns.size(); ++c) {
        const auto n = static_cast<std::uint64_t>(header.vertex_columns[c].components);
        out.vertex_values[c].assign(at(all.vertex_values[c], begin * n), at(all.vertex_values[c], end * n));
    }
    for (std::size_t c = 0; c < header.fibre_columns.size(); ++c) {
        const auto n = static_cast<std::uint64_t>(header.fibre_columns[c].components);
        out.fibre_values[c].assign(at(all.fibre_values[c], first * n), at(all.fibre_values[c], last * n));
    }
}

class MemorySource : public TractogramSource {
public:
    explicit MemorySource(const Tractogram& tractogram) : tractogram_(tractogram) {}

    const TractogramHeader& header() const override { return tractogram_.header; }

    bool read(FibreBatch& batch, std::size_t points_wanted) override {
        const TractogramHeader& names = tractogram_.header;
        batch.clear(names.vertex_columns.size(), names.fibre_columns.size());
        const FibreBatch& all = tractogram_.fibres;
        if (next_ == all.fibreCount()) return false;
        std::size_t last = next_ + 1;
        while (last < all.fibreCount() && all.offsets[last] - all.offsets[next_] < points_wanted) ++last;
        copyFibres(all, names, next_, last, batch);
        next_ = last;
        return true;
    }

    std::vector<FibreGroup> groups() override { return tractogram_.groups; }
    std::uint64_t damagedFibres() const override { return tractogram_.measures.damaged_fibres; }
    std::uint64_t bytesRead() const override { return sizeof(glm::vec3) * tractogram_.fibres.offsets[next_]; }
    std::uint64_t bytesTotal() const override { return sizeof(glm::vec3) * tractogram_.fibres.points.size(); }

private:
    const Tractogram& tractogram_;
    std::size_t next_ = 0;
};

}  // namespace

void FibreBatch::clear(std::size_t vertex_columns, std::size_t fibre_columns) {
    first_fibre = first_point = 0;
    points.clear();
    offsets.assign(1, 0);
    vertex_values.resize(vertex_columns);
    fibre_values.resize(fibre_columns);
    for (auto& values : vertex_values) values.clear();
    for (auto& values : fibre_values) values.clear();
}

std::size_t Tractogram::fibreColumn(const std::string& name) const {
    return findColumn(header.fibre_columns, name, header.source, "per-fibre");
}

std::size_t Tractogram::vertexColumn(const std::string& name) const {
    return findColumn(header.vertex_columns, name, header.source, "per-vertex");
}

const FibreGroup& Tractogram::group(const std::string& name) const {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const FibreGroup& group) { return group.name == name; });
    if (found != groups.end()) return *found;
    std::string known;
    for (const FibreGroup& group : groups) known += (known.empty() ? "" : ", ") + group.name;
    throw Error(Code::kNotFound, header.source + ": there is no group '" + name + "'; " +
                                     (known.empty() ? "there are none" : "there are: " + known));
}

void append(FibreBatch& to, const FibreBatch& batch) {
    const std::uint64_t base = to.points.size();
    to.points.insert(to.points.end(), batch.points.begin(), batch.points.end());
    for (std::size_t f = 1; f < batch.offsets.size(); ++f) to.offsets.push_back(base + batch.offsets[f]);
    const auto join = [](auto& columns, const auto& more) {
        columns.resize(more.size());
        for (std::size_t c = 0; c < more.size(); ++c) columns[c].insert(columns[c].end(), more[c].begin(), more[c].end());
    };
    join(to.vertex_values, batch.vertex_values);
    join(to.fibre_values, batch.fibre_values);
}

Tractogram readAll(TractogramSource& source, std::uint64_t bytes_max) {
    Tractogram all;
    all.header = source.header();
    all.fibres.clear(all.header.vertex_columns.size(), all.header.fibre_columns.size());
    FibreBatch batch;
    std::uint64_t bytes = 0;
    while (source.read(batch, kReadAllPoints)) {
        bytes = checkedAdd(bytes, bytesOf(batch), all.header.source);
        if (bytes > bytes_max) {
            throw Error(Code::kResourceExhausted,
                        all.header.source + ": its fibres need more than " + std::to_string(bytes_max) + " bytes of memory");
        }
        all.measures.add(batch);
        append(all.fibres, batch);
    }
    all.groups = source.groups();
    all.measures.damaged_fibres = source.damagedFibres();
    all.header.fibre_count = all.measures.fibres;
    all.header.point_count = all.measures.points;
    return all;
}

std::unique_ptr<TractogramSource> sourceOf(const Tractogram& tractogram) { return std::make_unique<MemorySource>(tractogram); }

}  // namespace radiata::model
