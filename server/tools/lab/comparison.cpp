#include "tools/lab/comparison.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"

namespace radiata::lab {
namespace {

std::size_t indexOf(const std::vector<Measured>& measured, const std::string& name) {
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (measured[i].name == name) return i;
    }
    throw Error(Code::kInternal, "no method '" + name + "' was measured");
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f%%", 100 * share);
    return text;
}

void addPlots(Report& report, const std::string& view, const Comparison& comparison) {
    Plot wrong{view + ": wrong pixels", "glyph passes, ms (median)", "share of wrong pixels", true, true, true, {}};
    Plot depth{
        view + ": depth error", "glyph passes, ms (median)", "depth error, 99th percentile, radii", true, true, true, {}};
    std::vector<std::string> families;
    for (const Measured& method : comparison.measured) {
        if (std::find(families.begin(), families.end(), method.family) == families.end()) families.push_back(method.family);
    }
    for (const std::string& family : families) {
        Curve wrong_curve{family, {}, false}, depth_curve{family, {}, false};
        for (std::size_t i = 0; i < comparison.measured.size(); ++i) {
            const Measured& method = comparison.measured[i];
            if (method.family != family) continue;
            const Errors& errors = comparison.errors[i];
            const double ms = method.time.median();
            wrong_curve.points.push_back({ms, errors.wrong_share, method.name});
            depth_curve.points.push_back({ms, errors.depth_p99, method.name});
        }
        wrong.curves.push_back(std::move(wrong_curve));
        depth.curves.push_back(std::move(depth_curve));
    }
    report.plots.push_back(std::move(wrong));
    report.plots.push_back(std::move(depth));
}

}  // namespace

double Comparison::medianMs(const std::string& name) const { return medianMs(indexOf(measured, name)); }
const Errors& Comparison::errorsOf(const std::string& name) const { return errors[indexOf(measured, name)]; }

bool Comparison::has(const std::string& name) const {
    return std::any_of(measured.begin(), measured.end(), [&name](const Measured& method) { return method.name == name; });
}

std::size_t Comparison::best(const std::string& beginning) const {
    std::size_t best = measured.size();
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (!measured[i].name.starts_with(beginning)) continue;
        if (best == measured.size() || errors[i].wrong < errors[best].wrong ||
            (errors[i].wrong == errors[best].wrong && medianMs(i) < medianMs(best))) {
            best = i;
        }
    }
    if (best == measured.size()) throw Error(Code::kInternal, "no method '" + beginning + "...' was measured");
    return best;
}

std::vector<Candidate> candidatesOf(const model::FrameRequest& request, const std::vector<Method>& methods) {
    std::vector<Candidate> candidates;
    for (const Method& method : methods) {
        Candidate candidate{method.name, method.family, request};
        method.set(candidate.request.quality);
        candidates.push_back(std::move(candidate));
    }
    return candidates;
}

Comparison compareMethods(Report& report, render::Renderer& renderer, store::Store& store, const std::string& view,
                          const std::vector<Candidate>& candidates, const model::FrameRequest& truth, int sample) {
    Comparison result;
    result.measured = measure(renderer, candidates, report.repeats);
    result.errors = compareWithReference(store, truth, result.measured, sample);
    Table table{view,
                {"method", "ms", "spread", "of first", "missed", "false", "wrong px", "wrong", "depth p50", "p99", "max",
                 "normal p50", "p99", "max"},
                {}};
    const double first = result.measured.empty() ? 0 : result.medianMs(0);
    for (std::size_t i = 0; i < result.measured.size(); ++i) {
        const Series& time = result.measured[i].time;
        const Errors& e = result.errors[i];
        table.rows.push_back({time.name, shortNumber(time.median()), percent(time.spread()), shortNumber(time.median() / first),
                              std::to_string(e.missed), std::to_string(e.false_hits), std::to_string(e.wrong),
                              percent(e.wrong_share), shortNumber(e.depth_p50), shortNumber(e.depth_p99),
                              shortNumber(e.depth_max), shortNumber(e.normal_p50), shortNumber(e.normal_p99),
                              shortNumber(e.normal_max)});
    }
    if (!result.errors.empty()) {
        table.title += " (" + std::to_string(result.errors[0].compared) + " pixels compared, " +
                       std::to_string(result.errors[0].left_out) + " left out)";
    }
    report.tables.push_back(std::move(table));
    for (const Measured& method : result.measured) {
        report.series.push_back(method.time);
        report.series.back().name = view + ", " + method.name;
    }
    addPlots(report, view, result);
    return result;
}

std::string comparisonNote() {
    return "ms: median GPU time of the glyph passes. missed, false, wrong px: over a regular sample of pixels and those where "
           "methods differ; wrong: share of the regular sample that is missed, false or off by over 2e-3 radii. depth: radii, "
           "normal: degrees, of pixels that both hit. Reference: double precision by exhaustive bracketing; left out are "
           "pixels "
           "whose first hit comes, goes or moves by over 2e-4 radii when the ray moves by 1e-5.";
}

}  // namespace radiata::lab
