#include "tools/lab/experiment.h"

#include <algorithm>
#include <cstdio>

namespace radiata::lab {
namespace {

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const double at = q * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, values.size() - 1);
    return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

}  // namespace

double Series::median() const { return quantile(values, 0.5); }
double Series::spread() const {
    const double middle = median();
    return middle > 0 ? (quantile(values, 0.75) - quantile(values, 0.25)) / middle : 0;
}
double Series::minimum() const { return values.empty() ? 0 : *std::min_element(values.begin(), values.end()); }

const std::vector<Experiment>& experiments() {
    static const std::vector<Experiment> kAll = {
        {"glyph-frame",
         "all passes of a frame of many glyphs, by each traversal; the glyph pass against finding the same boxes", glyphFrame},
        {"march-vs-polynomial",
         "one glyph filling the picture: ns per pixel and wrong pixels of the march and of Peters' solver",
         marchVersusPolynomial},
    };
    return kAll;
}

void interleave(int repeats, const std::vector<std::function<void()>>& measurements) {
    for (int round = 0; round < repeats; ++round) {
        for (const auto& measurement : measurements) measurement();
    }
}

void print(const Report& report) {
    std::printf("%s\n  scene    %s\n  view     %s\n  device   %s\n  repeats  %d after one warm-up, interleaved\n\n",
                report.experiment.c_str(), report.scene.c_str(), report.view.c_str(), report.device.c_str(), report.repeats);
    std::printf("  %-44s %10s %8s %10s\n", "", "median", "spread", "minimum");
    for (const Series& series : report.series) {
        std::printf("  %-44s %10.3f %7.1f%% %10.3f  %s\n", series.name.c_str(), series.median(), 100 * series.spread(),
                    series.minimum(), series.unit.c_str());
    }
    for (const std::string& note : report.notes) std::printf("  %s\n", note.c_str());
    if (!report.checks.empty()) std::printf("\n  %-44s %10s    %10s\n", "check", "value", "bound");
    for (const Check& check : report.checks) {
        std::printf("  %-44s %10.4g %s %10.4g  %s\n", check.name.c_str(), check.value, check.relation.c_str(), check.bound,
                    check.holds() ? "holds" : "DOES NOT HOLD");
    }
    for (const std::string& shortfall : report.shortfalls) std::printf("  not a full run: %s\n", shortfall.c_str());
}

nlohmann::json toJson(const Report& report) {
    nlohmann::json json = {{"experiment", report.experiment}, {"scene", report.scene},     {"view", report.view},
                           {"device", report.device},         {"repeats", report.repeats}, {"notes", report.notes},
                           {"shortfalls", report.shortfalls}};
    for (const Series& series : report.series) {
        json["series"].push_back({{"name", series.name},
                                  {"unit", series.unit},
                                  {"median", series.median()},
                                  {"spread", series.spread()},
                                  {"minimum", series.minimum()},
                                  {"values", series.values}});
    }
    for (const Check& check : report.checks) {
        json["checks"].push_back({{"name", check.name},
                                  {"value", check.value},
                                  {"relation", check.relation},
                                  {"bound", check.bound},
                                  {"holds", check.holds()}});
    }
    return json;
}

}  // namespace radiata::lab
