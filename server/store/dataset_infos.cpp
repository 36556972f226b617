#include "store/dataset_infos.h"

#include <filesystem>
#include <limits>
#include <system_error>

#include "base/error.h"
#include "io/fiblet_file.h"
#include "io/tractogram.h"

namespace radiata::store {

model::DatasetInfo fibletInfo(const std::string& id, const model::FibletSet& set, const model::FibreMemory& memory) {
    model::DatasetInfo info;
    info.id = id;
    info.kind = model::DatasetKind::kTractogram;
    info.fibres = set.fibres();
    info.points = set.points;
    info.gpu_bytes = memory.device_bytes;
    info.fiblet_pages = memory.pages;
    info.resident_pages = memory.resident_pages;
    for (const model::FibreGroup& group : set.groups) info.fibre_groups.push_back({group.name, group.fibres.size()});
    for (const model::FibreColumn& column : set.fibre_columns) info.fibre_columns.push_back(column.name);
    for (const model::PointColumn& column : set.point_columns) {
        if (column.component == 0) info.vertex_columns.push_back(column.name);
    }
    info.remarks = set.remarks;
    info.step_mm = set.codec.step_mm;
    if (set.walked) {
        info.set_anew_mean_um = set.walk_errors.mean_um;
        info.set_anew_max_um = set.walk_errors.max_um;
    }
    info.error_mean_um = set.errors.mean_um;
    info.error_max_um = set.errors.max_um;
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const shader::FibletPage& page : set.pages) {
        low = glm::min(low, page.low);
        high = glm::max(high, page.high);
    }
    if (set.pages.empty()) low = high = glm::vec3(0);
    info.bounds_min = set.origin_mm + glm::dvec3(low);
    info.bounds_max = set.origin_mm + glm::dvec3(high);
    return info;
}

model::DatasetInfo meshInfo(const std::string& id, const model::TriangleMesh& mesh) {
    model::DatasetInfo info;
    info.id = id;
    info.kind = model::DatasetKind::kMesh;
    info.points = mesh.points.size();
    info.triangles = mesh.triangles.size();
    if (mesh.points.empty()) return info;
    info.bounds_min = info.bounds_max = mesh.points.front();
    for (const glm::vec3& point : mesh.points) {
        info.bounds_min = glm::min(info.bounds_min, glm::dvec3(point));
        info.bounds_max = glm::max(info.bounds_max, glm::dvec3(point));
    }
    return info;
}

model::DatasetInfo tractHeaderInfo(const std::string& id, const std::filesystem::path& path) {
    model::DatasetInfo info;
    info.id = id;
    info.kind = model::DatasetKind::kTractogram;
    try {
        if (io::isFibletName(path)) return fibletInfo(id, io::readFibletHeader(path));
        const auto source = io::openTractogram(path);
        info.fibres = source->header().fibre_count.value_or(0);
        info.points = source->header().point_count.value_or(0);
        // Headers lie at times; more than a byte each is impossible in every format, compressed ones at most 1032 to 1.
        std::error_code failure;
        const std::uint64_t bytes = std::filesystem::file_size(path, failure);
        const bool packed = path.extension() == ".gz" || path.extension() == ".trx" || path.extension() == ".vtp";
        const std::uint64_t most = failure ? model::kFibreCountMax : packed ? 1032 * bytes : bytes;
        if (info.fibres > most) info.fibres = 0;
        if (info.points > most) info.points = 0;
    } catch (const Error&) {
        // The list goes on; whoever asks for this dataset gets the reader's sentence.
    }
    return info;
}

}  // namespace radiata::store
