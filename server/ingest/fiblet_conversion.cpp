#include "ingest/fiblet_conversion.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <limits>

#include <zlib.h>

#include "base/error.h"
#include "build/fiblet_batches.h"
#include "ingest/fiblet_merge.h"
#include "ingest/fiblet_runs.h"

namespace radiata::ingest {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMiddlePoints = 1 << 18;  ///< in memory while the fibres' middle is looked for

/// Of what the runs are; the number changes when the same input would give others.
std::string keyOf(const FibletOptions& o, const std::string& state) {
    std::array<char, 320> text{};
    std::snprintf(text.data(), text.size(),
                  "runs of fiblets 2\nbound %.17g, walk %.17g (%d), step %.17g of %.17g at most, beam %u, width %u\n",
                  o.bound_um, o.walk_bound_um, int(o.walk_rather), o.step_mm, o.longest_step_mm, o.beam, o.least_width);
    return text.data() + state;
}

std::size_t batchPoints(const model::TractogramHeader& header, std::uint64_t memory_bytes) {
    std::uint64_t bytes = sizeof(glm::vec3);
    for (const model::ColumnName& column : header.vertex_columns) bytes += 4 * std::uint64_t(column.components);
    return std::size_t(std::clamp<std::uint64_t>(memory_bytes / 8 / bytes, 1, 1 << 20));
}

/// From the source to complete runs.
class Encoding {
public:
    Encoding(FibletRuns& runs, const FibletPlan& plan, const model::TractogramHeader& header, const ConversionOptions& options)
        : runs_(runs),
          codec_(plan.set.codec),
          batches_(plan, header, options.fiblets),
          done_(runs.sums().fibres),
          run_bytes_(options.memory_bytes / 6) {
        clear();
        run_.fibre_columns.resize(header.fibre_columns.size());
    }

    void add(const model::FibreBatch& batch) {
        const std::uint64_t end = batch.first_fibre + batch.fibreCount();
        if (end <= done_) return;
        const std::size_t first = std::max(done_, batch.first_fibre) - batch.first_fibre;
        const std::size_t before = run_.block.fiblets.size(), fibres = run_.fiblets.size();
        batches_.encode(batch, first, run_.block);
        run_.fiblets.resize(fibres + batch.fibreCount() - first, 0);
        for (std::size_t i = before; i < run_.block.fiblets.size(); ++i)
            ++run_.fiblets[fibres + (run_.block.fiblets[i].head.fibre - batch.first_fibre - first)];
        for (std::size_t c = 0; c < run_.fibre_columns.size(); ++c) {
            const std::vector<float>& values = batch.fibre_values[c];
            const std::size_t components = values.size() / batch.fibreCount();
            run_.fibre_columns[c].insert(run_.fibre_columns[c].end(), values.begin() + std::ptrdiff_t(first * components),
                                         values.end());
        }
        done_ = end;
        if (run_.bytes() >= run_bytes_) store();
    }

    void finish() {
        if (!run_.fiblets.empty()) store();
    }

private:
    void store() {
        runs_.add(run_, codec_);
        clear();
    }
    void clear() {
        run_.block = batches_.begin();
        run_.fiblets.clear();
        for (auto& column : run_.fibre_columns) column.clear();
    }

    FibletRuns& runs_;
    shader::FibletCodec codec_;
    FibletBatches batches_;
    std::uint64_t done_, run_bytes_;
    Run run_;
};

FibletProgress partOf(const FibletProgress& progress, double begin, double end) {
    return [&progress, begin, end](double share) {
        if (progress) progress(begin + (end - begin) * share);
    };
}

Conversion convertOnce(const OpenTractogram& open, const std::string& state, const fs::path& out,
                       const ConversionOptions& options, const FibletProgress& progress,
                       const std::function<void(const std::string&)>& log);

}  // namespace

std::string stateOf(const std::vector<fs::path>& files) {
    std::string state;
    for (const fs::path& file : files) {
        std::error_code failure;
        if (fs::is_directory(file, failure)) {
            std::vector<fs::path> inside;
            for (const auto& entry : fs::directory_iterator(file, failure)) inside.push_back(entry.path());
            std::sort(inside.begin(), inside.end());
            state += stateOf(inside);
            continue;
        }
        std::vector<char> beginning(1 << 20);
        std::ifstream in(file, std::ios::binary);
        in.read(beginning.data(), std::streamsize(beginning.size()));
        const auto got = std::size_t(std::max<std::streamsize>(in.gcount(), 0));
        state += fs::weakly_canonical(file, failure).string() + ", " + std::to_string(fs::file_size(file, failure)) + ", " +
                 std::to_string(fs::last_write_time(file, failure).time_since_epoch().count()) + ", " +
                 std::to_string(crc32_z(0, reinterpret_cast<const Bytef*>(beginning.data()), got)) + "\n";
    }
    return state;
}

Conversion convertToFiblets(const OpenTractogram& open, const std::string& state, const fs::path& out,
                            const ConversionOptions& options, const FibletProgress& progress,
                            const std::function<void(const std::string&)>& log) {
    std::string of_what = state;
    const auto finer = [&](const UnheldBound& unheld) {
        if (log) log(std::string(unheld.what()) + ", which is tried now");
    };
    const auto encode = [&](const OpenTractogram& of) {
        const auto convert = [&](const FibletOptions& fiblets) {
            ConversionOptions now = options;
            now.fiblets = fiblets;
            return convertOnce(of, of_what, out, now, progress, log);
        };
        return encodeWithFinerSteps(options.fiblets, convert, finer);
    };
    const auto left_out = [&](const StrayFibres& strays) {
        of_what += "without strays\n";
        if (log) log(std::string(strays.what()) + "; what lies farther is left out now");
    };
    if (options.fiblets.within_mm < std::numeric_limits<double>::infinity())
        of_what += "within " + std::to_string(options.fiblets.within_mm) + " mm\n";
    return encodeWithoutStrays(open, options.fiblets, kMiddlePoints, encode, left_out);
}

namespace {

Conversion convertOnce(const OpenTractogram& open, const std::string& state, const fs::path& out,
                       const ConversionOptions& options, const FibletProgress& progress,
                       const std::function<void(const std::string&)>& log) {
    const std::unique_ptr<model::TractogramSource> source = open();
    const model::TractogramHeader& header = source->header();
    const std::size_t batch_points = batchPoints(header, options.memory_bytes);
    fs::path scratch = out;
    scratch += ".runs";
    std::size_t columns = 0;
    for (const model::ColumnName& column : header.vertex_columns) columns += std::size_t(column.components);
    FibletRuns runs(scratch, keyOf(options.fiblets, state), columns);
    try {
        FibletPlan plan;
        plan.set.source = header.source;
        plan.set.bound_um = options.fiblets.bound_um;
        Conversion result;
        if (runs.plan(plan)) {
            result.continued = runs.sums().fibres;
            if (log && result.continued > 0) {
                log("continues " + scratch.string() + ", where " + std::to_string(result.continued) +
                    " fibres are encoded already");
            }
        } else {
            plan = planFiblets(open, options.fiblets, batch_points, partOf(progress, 0, 0.2));
            runs.begin(plan);
        }
        Encoding encoding(runs, plan, header, options);
        const auto take = [&](const model::FibreBatch& batch) {
            encoding.add(batch);
            return true;
        };
        readFibreBatches(*source, batch_points, take, partOf(progress, 0.2, 0.9));
        encoding.finish();

        const RunSums& sums = runs.sums();
        result.set = plan.set;
        result.set.groups = source->groups();
        result.set.remarks = remarksOf(*source);
        result.set.points = sums.points;
        FibletBlock all;
        all.measured = sums.measured;
        all.sum_error_nm = sums.sum_error_nm;
        all.max_error_mm = sums.max_error_mm;
        result.set.errors = all.errors();
        for (const model::ColumnName& column : header.fibre_columns)
            result.set.fibre_columns.push_back({column.name, std::uint32_t(column.components), {}});
        result.set.point_columns = FibletBatches(plan, header, options.fiblets).columns();
        result.fibres = sums.fibres;
        mergeRuns(runs, result.set, options.memory_bytes, out, partOf(progress, 0.9, 1));
        runs.file().remove();
        return result;
    } catch (const Error& error) {
        if (!options.keep_unfinished || runs.runs().empty() || error.code() != Code::kUnavailable) {
            runs.file().remove();
            throw;
        }
        runs.file().cut(runs.end());
        throw Error(error.code(), std::string(error.what()) + "; " + std::to_string(runs.sums().fibres) +
                                      " encoded fibres are kept in " + scratch.string() +
                                      " for the next attempt, or for you to delete");
    }
}

}  // namespace

}  // namespace radiata::ingest
