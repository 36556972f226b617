#include "store/catalog_ids.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/error.h"
#include "io/mesh_file.h"
#include "store/tract_files.h"

namespace radiata::store {
namespace {

constexpr std::string_view kSuffixes[] = {".nii.gz", ".nii", ".mif.gz", ".mif", ".mih", ".nrrd", ".nhdr", ".hdr"};

bool validId(const std::string& id) {
    return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
}

}  // namespace

std::string stemOf(const std::filesystem::path& path) {
    const std::string file = (path.has_filename() ? path : path.parent_path()).filename().string();
    if (isTractName(path)) {
        const std::string whole = file.ends_with(".gz") ? file.substr(0, file.size() - 3) : file;
        return whole.substr(0, whole.rfind('.'));
    }
    if (io::isMeshName(path)) return path.stem().string();
    for (const std::string_view suffix : kSuffixes) {
        if (file.size() > suffix.size() && file.ends_with(suffix)) return file.substr(0, file.size() - suffix.size());
    }
    return {};
}

std::string idOf(const std::string& stem) {
    std::string id;
    for (const char c : stem.substr(0, 60)) {
        const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        id += validId(std::string(1, lower)) ? lower : '_';
    }
    return id;
}

std::string printable(const std::string& id) {
    std::string text = id.substr(0, 64);
    for (char& c : text) {
        if (c < ' ' || c > '~') c = '?';
    }
    return text;
}

void checkId(const std::string& id) {
    if (validId(id)) return;
    throw Error(Code::kInvalidArgument,
                "dataset id '" + printable(id) + "' must be 1 to 64 characters of a-z, 0-9, '_' and '-'");
}

}  // namespace radiata::store
