#include "io/tractogram.h"

#include <algorithm>

#include "base/error.h"
#include "io/tck.h"
#include "io/track_columns.h"
#include "io/trk.h"
#include "io/trx.h"
#include "io/tt.h"
#include "io/vtp_lines.h"

namespace radiata::io {
namespace {

std::string lowered(const std::filesystem::path& path) {
    std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name;
}

bool ends(const std::string& name, std::string_view suffix) { return name.size() > suffix.size() && name.ends_with(suffix); }

std::unique_ptr<model::TractogramSource> openByName(const std::filesystem::path& path, VtkSpace vtk_space) {
    const std::string name = lowered(path);
    if (ends(name, ".tck") || ends(name, ".tck.gz")) return openTck(path);
    if (ends(name, ".trk") || ends(name, ".trk.gz")) return openTrk(path);
    if (ends(name, ".trx")) return openTrx(path);
    if (ends(name, ".tt") || ends(name, ".tt.gz")) return openTt(path);
    if (ends(name, ".vtk")) return openVtkLines(path, vtk_space);
    if (ends(name, ".vtp")) return openVtpLines(path, vtk_space);
    throw Error(Code::kUnsupported, path.filename().string() +
                                        ": the name ends as no tractogram's does; .tck, .trk, .trx, .tt, .vtk, .vtp, and .gz "
                                        "of the first two and .tt are read");
}

}  // namespace

bool isTractogramName(const std::filesystem::path& path) {
    const std::string name = lowered(path);
    constexpr std::string_view kSuffixes[] = {".tck", ".tck.gz", ".trk", ".trk.gz", ".trx", ".tt", ".tt.gz", ".vtk", ".vtp"};
    return std::any_of(std::begin(kSuffixes), std::end(kSuffixes), [&](std::string_view suffix) { return ends(name, suffix); });
}

std::unique_ptr<model::TractogramSource> openTractogram(const std::filesystem::path& path, const TractOptions& options) {
    return withColumns(openByName(path, options.vtk_space), options.columns);
}

void requireWritableName(const std::filesystem::path& path) {
    const std::string name = lowered(path);
    if (!ends(name, ".tck") && !ends(name, ".trx")) {
        throw Error(Code::kUnsupported, path.string() + ": the name would have to end in .tck or .trx");
    }
    if (path.has_parent_path() && !std::filesystem::is_directory(path.parent_path()) && path.has_filename()) {
        throw Error(Code::kNotFound, path.string() + ": there is no folder " + path.parent_path().string());
    }
}

std::vector<std::filesystem::path> writeTractogram(model::TractogramSource& source, const std::filesystem::path& path) {
    requireWritableName(path);
    if (ends(lowered(path), ".tck")) return writeTck(source, path);
    writeTrx(source, path);
    return {path};
}

}  // namespace radiata::io
