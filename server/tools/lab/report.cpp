#include "tools/lab/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

void printTable(const Table& table) {
    std::vector<std::size_t> width;
    for (const std::string& column : table.columns) width.push_back(column.size());
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < row.size() && c < width.size(); ++c) width[c] = std::max(width[c], row[c].size());
    }
    const auto printRow = [&width](const std::vector<std::string>& row) {
        std::printf("  ");
        for (std::size_t c = 0; c < row.size() && c < width.size(); ++c) {
            std::printf(c == 0 ? "%-*s" : "  %*s", static_cast<int>(width[c]), row[c].c_str());
        }
        std::printf("\n");
    };
    std::printf("\n  %s\n", table.title.c_str());
    printRow(table.columns);
    for (const auto& row : table.rows) printRow(row);
}

nlohmann::json toJson(const Plot& plot) {
    nlohmann::json json = {
        {"title", plot.title}, {"x", plot.x_label}, {"y", plot.y_label}, {"curves", nlohmann::json::array()}};
    for (const Curve& curve : plot.curves) {
        nlohmann::json points = nlohmann::json::array();
        for (const PlotPoint& point : curve.points) points.push_back({{"x", point.x}, {"y", point.y}, {"name", point.name}});
        json["curves"].push_back({{"name", curve.name}, {"points", points}});
    }
    return json;
}

}  // namespace

double Series::median() const { return lab::median(values); }
double Series::spread() const {
    const double middle = median();
    return middle > 0 ? (quantile(values, 0.75) - quantile(values, 0.25)) / middle : 0;
}
double Series::minimum() const { return values.empty() ? 0 : *std::min_element(values.begin(), values.end()); }

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

void print(const Report& report) {
    std::printf("%s\n  scene    %s\n  view     %s\n  device   %s\n", report.experiment.c_str(), report.scene.c_str(),
                report.view.c_str(), report.device.c_str());
    std::printf("  repeats  %d after one warm-up, interleaved\n", report.repeats);
    if (!report.series.empty()) std::printf("\n  %-44s %10s %8s %10s\n", "", "median", "spread", "minimum");
    for (const Series& series : report.series) {
        std::printf("  %-44s %10.3f %7.1f%% %10.3f  %s\n", series.name.c_str(), series.median(), 100 * series.spread(),
                    series.minimum(), series.unit.c_str());
    }
    for (const Table& table : report.tables) printTable(table);
    if (!report.notes.empty()) std::printf("\n");
    for (const std::string& note : report.notes) std::printf("  %s\n", note.c_str());
    if (!report.checks.empty()) std::printf("\n  %-60s %10s    %10s\n", "check", "value", "bound");
    for (const Check& check : report.checks) {
        std::printf("  %-60s %10.4g %s %10.4g  %s\n", check.name.c_str(), check.value, check.relation.c_str(), check.bound,
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
    for (const Table& table : report.tables) {
        json["tables"].push_back({{"title", table.title}, {"columns", table.columns}, {"rows", table.rows}});
    }
    for (const Plot& plot : report.plots) json["plots"].push_back(toJson(plot));
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
