#include "store/tract_files.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.h"
#include "build/fiblet_encode.h"
#include "build/fiblet_pages.h"
#include "ingest/fiblet_conversion.h"
#include "io/fiblet_file.h"
#include "io/tractogram.h"

namespace radiata::store {
namespace {

namespace fs = std::filesystem;

/// FNV-1a (Fowler, Noll, Vo).
class Hash {
public:
    void add(const std::string& text) {
        for (const char c : text + '\n') {
            value_ ^= static_cast<unsigned char>(c);
            value_ *= 0x100000001b3ULL;
        }
    }
    std::string hex() const {
        std::array<char, 16> digits{};
        return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value_, 16).ptr};
    }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

void addFile(Hash& hash, const fs::path& file) {
    std::error_code failure;
    hash.add(file.string());
    hash.add(std::to_string(fs::file_size(file, failure)));
    hash.add(std::to_string(fs::last_write_time(file, failure).time_since_epoch().count()));
}

/// .tsf and .txt files whose names begin with the tracks' name and an underscore.
std::vector<fs::path> columnsBeside(const fs::path& path) {
    std::vector<fs::path> columns;
    const std::string name = path.filename().string();
    const std::string stem = name.substr(0, name.find('.')) + "_";
    std::error_code failure;
    if (!name.ends_with(".tck") && !name.ends_with(".trk")) return columns;
    for (const auto& entry : fs::directory_iterator(path.has_parent_path() ? path.parent_path() : ".", failure)) {
        const fs::path& file = entry.path();
        const bool suffix = file.extension() == ".tsf" || file.extension() == ".txt";
        if (suffix && file.filename().string().starts_with(stem) && entry.is_regular_file(failure)) columns.push_back(file);
    }
    std::sort(columns.begin(), columns.end());
    return columns;
}

/// Whether the column can be read with the tracks to the end.
bool fits(const fs::path& path, io::TractOptions options, const fs::path& column,
          const std::function<void(const std::string&)>& log) {
    try {
        options.columns = {column};
        const auto source = io::openTractogram(path, options);
        model::FibreBatch batch;
        while (source->read(batch, std::size_t{1} << 18)) continue;
        return true;
    } catch (const Error& error) {
        if (log) log(std::string(error.what()) + "; the column is left out");
        return false;
    }
}

io::TractOptions optionsFor(const fs::path& path, const TractReading& reading,
                            const std::function<void(const std::string&)>& log) {
    const io::TractOptions plain{reading.vtk_space, {}};
    io::TractOptions options = plain;
    for (const fs::path& column : columnsBeside(path)) {
        if (fits(path, plain, column, log)) options.columns.push_back(column);
    }
    return options;
}

fs::path cacheFile(const fs::path& path, const TractReading& reading) {
    Hash hash;
    hash.add("fiblets 2");
    if (reading.vtk_space != io::VtkSpace::kAuto) hash.add(reading.vtk_space == io::VtkSpace::kLps ? "LPS" : "RAS");
    std::error_code failure;
    fs::path whole = fs::weakly_canonical(path, failure);
    if (failure) whole = path;
    addFile(hash, whole);
    for (const fs::path& column : columnsBeside(path)) addFile(hash, column);
    if (fs::is_directory(path, failure)) {
        std::vector<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(path, failure)) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) addFile(hash, file);
    }
    return reading.cache / (path.filename().string().substr(0, 100) + "-" + hash.hex() + ".fiblet");
}

/// What is opened is to be seen: rather lines by other points than none.
constexpr FibletOptions kOptions{.walk_rather = true, .leave_strays = true};

std::string summary(const model::FibletSet& set) {
    std::array<char, 320> text{};
    int size = std::snprintf(text.data(), text.size(), "%llu fibres, %llu points, error mean %.2f um, largest %.2f um",
                             static_cast<unsigned long long>(set.fibres()), static_cast<unsigned long long>(set.points),
                             set.errors.mean_um, set.errors.max_um);
    if (set.walked) {
        std::snprintf(
            text.data() + size, text.size() - std::size_t(size),
            ", points set anew every %.4f mm (those of the file are off these lines by %.1f um on average, %.1f at most)",
            double(set.codec.step_mm), set.walk_errors.mean_um, set.walk_errors.max_um);
    }
    return text.data();
}

std::optional<model::FibletSet> readKept(const fs::path& kept, const std::function<void(const std::string&)>& log) {
    std::error_code failure;
    if (!fs::is_regular_file(kept, failure)) return std::nullopt;
    try {
        model::FibletSet set = io::readFiblets(kept);
        boundFiblets(set);
        return set;
    } catch (const Error& error) {
        if (log) log(std::string(error.what()) + "; it is made anew");
        return std::nullopt;
    }
}

}  // namespace

bool isTractName(const fs::path& path) { return io::isFibletName(path) || io::isTractogramName(path); }

std::unique_ptr<model::TractogramSource> openTracts(const fs::path& path, const TractReading& reading,
                                                    const std::function<void(const std::string&)>& log) {
    return io::openTractogram(path, optionsFor(path, reading, log));
}

model::FibletSet loadTracts(const fs::path& path, const TractReading& reading,
                            const std::function<void(const std::string&)>& log) {
    const auto say = [&](const std::string& sentence) {
        if (log) log(path.filename().string() + ": " + sentence);
    };
    const auto sayAll = [&](const model::FibletSet& set, const std::string& from) {
        say(summary(set) + from);
        if (!set.remarks.empty()) say(set.remarks);
    };
    const fs::path& cache = reading.cache;
    if (io::isFibletName(path)) {
        model::FibletSet set = io::readFiblets(path);
        boundFiblets(set);
        sayAll(set, "");
        return set;
    }
    const fs::path kept = cache.empty() ? fs::path() : cacheFile(path, reading);
    if (auto set = cache.empty() ? std::nullopt : readKept(kept, log)) {
        set->source = path.filename().string();
        sayAll(*set, ", from the cache");
        return *std::move(set);
    }
    // The encoder reads the file several times; columns are tried once.
    const io::TractOptions options = optionsFor(path, reading, log);
    const auto open = [&] { return io::openTractogram(path, options); };
    if (!cache.empty()) {
        try {
            std::error_code failure;
            fs::create_directories(cache, failure);
            if (failure) throw Error(Code::kUnavailable, cache.string() + ": cannot be made (" + failure.message() + ")");
            // A folder that is full is not helped by what is left there for the next start.
            ingest::ConversionOptions conversion;
            conversion.keep_unfinished = false;
            conversion.fiblets = kOptions;
            ingest::convertToFiblets(open, kept.filename().string(), kept, conversion, {}, say);
            if (auto set = readKept(kept, log)) {
                set->source = path.filename().string();
                sayAll(*set, "");
                return *std::move(set);
            }
        } catch (const Error& error) {
            if (error.code() != Code::kUnavailable) throw;
            say("served from memory, nothing is kept for the next start: " + std::string(error.what()));
        }
    }
    model::FibletSet set = encodeFiblets(open, kOptions);
    sayAll(set, "");
    return set;
}

}  // namespace radiata::store
