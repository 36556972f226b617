// What the catalogue tells of tractograms and meshes.
#pragma once

#include <filesystem>
#include <string>

#include "model/dataset.h"
#include "model/fiblet_set.h"
#include "model/triangle_mesh.h"

namespace radiata::store {

model::DatasetInfo fibletInfo(const std::string& id, const model::FibletSet& set, const model::FibreMemory& memory = {});
model::DatasetInfo meshInfo(const std::string& id, const model::TriangleMesh& mesh);
/// What the header alone says, which may be wrong about counts; 0 where the file is too short for them.
model::DatasetInfo tractHeaderInfo(const std::string& id, const std::filesystem::path& path);

}  // namespace radiata::store
