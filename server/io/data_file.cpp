#include "io/data_file.h"

#include <algorithm>

#include "base/error.h"
#include "io/text.h"

namespace radiata::io {

std::filesystem::path dataFileBeside(const std::filesystem::path& header_path, const std::string& name) {
    const std::string file = header_path.filename().string();
    const std::filesystem::path relative(name);
    const bool climbs = std::ranges::any_of(relative, [](const std::filesystem::path& part) { return part == ".."; });
    if (relative.is_absolute() || climbs || name.find('\0') != std::string::npos) {
        throw Error(Code::kInvalidArgument, file + ": the data file " + shown(name) +
                                                " is not inside the header's folder; a relative name without '..' is read");
    }
    std::error_code failure;
    const auto folder = std::filesystem::canonical(header_path.has_parent_path() ? header_path.parent_path() : ".", failure);
    const auto target = failure ? std::filesystem::path() : std::filesystem::canonical(folder / relative, failure);
    if (failure || !std::filesystem::is_regular_file(target, failure)) {
        throw Error(Code::kNotFound, file + ": there is no data file " + shown(name) + " in the header's folder");
    }
    if (std::ranges::mismatch(folder, target).in1 != folder.end()) {
        throw Error(Code::kInvalidArgument,
                    file + ": the data file " + shown(name) + " is a link that leads out of the header's folder");
    }
    return target;
}

}  // namespace radiata::io
