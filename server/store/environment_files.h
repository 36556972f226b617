// Environment maps of the catalogue: what is known of them, and their harmonics, made once.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "model/dataset.h"
#include "model/illumination.h"

namespace radiata::store {

/// Whether a file's name ends as a Radiance picture's does.
bool isEnvironmentName(const std::filesystem::path& path);

/// \throws as io::readEnvironmentMap()
std::shared_ptr<const model::EnvironmentMap> loadEnvironment(const std::filesystem::path& path);

/// A map that is in memory, with its harmonics. \throws Error(kInvalidArgument) as io::checkEnvironmentMap()
std::shared_ptr<const model::EnvironmentMap> completeEnvironment(model::EnvironmentMap map);

model::DatasetInfo environmentInfo(const std::string& id, const model::EnvironmentMap& map);

/// What the header alone says; size 0 if it cannot be read.
model::DatasetInfo environmentHeaderInfo(const std::string& id, const std::filesystem::path& path);

}  // namespace radiata::store
