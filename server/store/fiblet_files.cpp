#include "store/fiblet_files.h"

#include <chrono>
#include <cstdio>
#include <optional>

#include <zlib.h>

#include "base/error.h"
#include "build/fiblet_pages.h"
#include "io/fiblet_file.h"
#include "io/tractogram.h"

namespace radiata::store {
namespace {

model::FibletSet readBounded(const std::filesystem::path& path) {
    model::FibletSet set = io::readFiblets(path);
    boundFiblets(set);
    return set;
}

/// Of what was read or made: fibres, points and errors.
std::string described(const model::FibletSet& set) {
    char text[200];
    std::snprintf(text, sizeof text, "%llu fibres, %llu points, decoded within %.1f um of those stored",
                  static_cast<unsigned long long>(set.fibres()), static_cast<unsigned long long>(set.points),
                  set.errors.max_um);
    std::string all = text;
    if (set.walked) {
        std::snprintf(text, sizeof text,
                      "; steps vary, so lines are walked in steps of %.4f mm, %.1f um from the file's points at most",
                      double(set.codec.step_mm), set.walk_errors.max_um);
        all += text;
    }
    return all;
}

std::optional<model::FibletSet> fromCache(const std::filesystem::path& cached,
                                          const std::function<void(const std::string&)>& log) {
    std::error_code failure;
    if (!std::filesystem::is_regular_file(cached, failure)) return std::nullopt;
    try {
        return readBounded(cached);
    } catch (const Error& error) {
        if (log) log(std::string(error.what()) + "; it is made anew");
        return std::nullopt;
    }
}

}  // namespace

bool isTractName(const std::filesystem::path& path) { return io::isFibletName(path) || io::isTractogramName(path); }

std::filesystem::path cachedFiblets(const std::filesystem::path& path, const std::filesystem::path& cache_folder,
                                    const FibletOptions& options) {
    std::error_code failure;
    const auto size = std::filesystem::is_directory(path, failure) ? 0 : std::filesystem::file_size(path, failure);
    const auto changed = std::filesystem::last_write_time(path, failure).time_since_epoch().count();
    const std::string key = std::filesystem::absolute(path).lexically_normal().string() + '\n' + std::to_string(size) + '\n' +
                            std::to_string(changed) + '\n' + std::to_string(options.bound_um) + '\n' +
                            std::to_string(options.walk_bound_um) + '\n' + std::to_string(options.step_mm) + '\n' +
                            std::to_string(options.beam) + '\n' + std::to_string(options.least_width);
    char sums[32];
    const auto* bytes = reinterpret_cast<const Bytef*>(key.data());
    std::snprintf(sums, sizeof sums, "%08lx%08lx", crc32_z(0, bytes, key.size()), adler32_z(1, bytes, key.size()));
    return cache_folder / (path.stem().string() + "-" + sums + ".fiblet");
}

model::FibletSet loadTractogram(const std::filesystem::path& path, const std::filesystem::path& cache_folder,
                                const FibletOptions& options, const std::function<void(const std::string&)>& log) {
    const std::string name = path.filename().string();
    if (io::isFibletName(path)) {
        model::FibletSet set = readBounded(path);
        if (log) log(name + ": " + described(set));
        return set;
    }
    const std::filesystem::path cached =
        cache_folder.empty() ? std::filesystem::path() : cachedFiblets(path, cache_folder, options);
    if (!cached.empty()) {
        if (std::optional<model::FibletSet> set = fromCache(cached, log)) {
            set->source = name;
            if (log) log(name + ": " + described(*set) + "; from the cache");
            return std::move(*set);
        }
    }
    const auto begin = std::chrono::steady_clock::now();
    model::FibletSet set = encodeFiblets([&] { return io::openTractogram(path); }, options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (log) log(name + ": " + described(set) + "; encoded in " + std::to_string(int(seconds + 0.5)) + " s");
    if (cached.empty()) return set;
    try {
        std::error_code failure;
        std::filesystem::create_directories(cache_folder, failure);
        io::writeFiblets(set, cached);
    } catch (const Error& error) {
        if (log)
            log(name +
                ": cannot be kept in the cache, so it serves from memory and will be encoded again next time: " + error.what());
    }
    return set;
}

}  // namespace radiata::store
