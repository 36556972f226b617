// Each plot is a frame with axes and, under it, the list of the numbered points; both in one column of the picture.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "tools/lab/axis.h"
#include "tools/lab/plot.h"

namespace radiata::lab {
namespace {

constexpr double kColumn = 620, kLeft = 78, kRight = 20, kTop = 44, kHeight = 380, kBelow = 58, kLine = 17, kHeading = 46;
constexpr const char* kColours[] = {"#0b6e4f", "#b3261e", "#1f5fa8", "#b8730a", "#6a3d9a", "#5c5c5c", "#0f8b8d", "#c2378a"};

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else
            out += c;
    }
    return out;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

class Writer {
public:
    void text(double x, double y, const std::string& words, int size, const char* anchor = "start", const char* more = "") {
        out_ << "<text x='" << number(x) << "' y='" << number(y) << "' font-size='" << size << "' text-anchor='" << anchor
             << "' " << more << ">" << escaped(words) << "</text>\n";
    }
    void line(double x1, double y1, double x2, double y2, const char* style) {
        out_ << "<line x1='" << number(x1) << "' y1='" << number(y1) << "' x2='" << number(x2) << "' y2='" << number(y2) << "' "
             << style << "/>\n";
    }
    void dot(double x, double y, double radius, const char* colour) {
        out_ << "<circle cx='" << number(x) << "' cy='" << number(y) << "' r='" << number(radius) << "' fill='" << colour
             << "'/>\n";
    }
    void path(const std::vector<std::pair<double, double>>& points, const std::string& style) {
        out_ << "<polyline fill='none' " << style << " points='";
        for (const auto& [x, y] : points) out_ << number(x) << ',' << number(y) << ' ';
        out_ << "'/>\n";
    }
    std::string str() const { return out_.str(); }

private:
    std::ostringstream out_;
};

struct Placed {
    double x = 0, y = 0;
    const PlotPoint* point = nullptr;
    const char* colour = nullptr;
    int number = 0;
};

class PlotWriter {
public:
    PlotWriter(Writer& out, const Plot& plot, double left, double top)
        : out_(out),
          plot_(plot),
          left_(left + kLeft),
          top_(top + kTop),
          width_(kColumn - kLeft - kRight),
          x_axis_(coordinates(plot, &PlotPoint::x), plot.log_x),
          y_axis_(coordinates(plot, &PlotPoint::y), plot.log_y) {
        int next = 1;
        for (std::size_t c = 0; c < plot.curves.size(); ++c) {
            for (const PlotPoint& point : plot.curves[c].points) {
                placed_.push_back({atX(point.x), atY(point.y), &point, colourOf(c), point.name.empty() ? 0 : next++});
            }
        }
    }

    void write() {
        writeFrame();
        if (plot_.front) writeFront();
        for (std::size_t c = 0; c < plot_.curves.size(); ++c) writeCurve(plot_.curves[c], colourOf(c));
        for (const Placed& p : placed_) out_.dot(p.x, p.y, 3.6, p.colour);
        writeNumbers();
        writeList();
    }

    static double heightOf(const Plot& plot) {
        std::size_t lines = 0;
        for (const Curve& curve : plot.curves) {
            const bool named =
                std::any_of(curve.points.begin(), curve.points.end(), [](const PlotPoint& p) { return !p.name.empty(); });
            lines += named ? curve.points.size() : 1;
        }
        return kTop + kHeight + kBelow + static_cast<double>(lines) * kLine + 24;
    }

private:
    static const char* colourOf(std::size_t curve) { return kColours[curve % std::size(kColours)]; }
    static std::vector<double> coordinates(const Plot& plot, double PlotPoint::*which) {
        std::vector<double> values;
        for (const Curve& curve : plot.curves) {
            for (const PlotPoint& point : curve.points) values.push_back(point.*which);
        }
        return values;
    }
    double atX(double x) const { return left_ + width_ * x_axis_.place(x); }
    double atY(double y) const { return top_ + kHeight * (1 - y_axis_.place(y)); }

    void writeFrame() {
        out_.text(left_, top_ - 14, plot_.title, 15, "start", "font-weight='bold'");
        for (const Tick& tick : x_axis_.ticks()) {
            const double x = left_ + width_ * tick.at;
            out_.line(x, top_, x, top_ + kHeight, tick.label.empty() ? "stroke='#f0f0f0'" : "stroke='#d8d8d8'");
            if (!tick.label.empty()) out_.text(x, top_ + kHeight + 18, tick.label, 12, "middle");
        }
        for (const Tick& tick : y_axis_.ticks()) {
            const double y = top_ + kHeight * (1 - tick.at);
            out_.line(left_, y, left_ + width_, y, tick.label.empty() ? "stroke='#f0f0f0'" : "stroke='#d8d8d8'");
            if (!tick.label.empty()) out_.text(left_ - 7, y + 4, tick.label, 12, "end");
        }
        out_.path({{left_, top_}, {left_, top_ + kHeight}, {left_ + width_, top_ + kHeight}}, "stroke='#333'");
        out_.text(left_ + width_ / 2, top_ + kHeight + 40, plot_.x_label, 13, "middle");
        const double x = left_ - 60, y = top_ + kHeight / 2;
        const std::string turn = "transform='rotate(-90 " + number(x) + " " + number(y) + ")'";
        out_.text(x, y, plot_.y_label, 13, "middle", turn.c_str());
    }

    /// Steps: what the best method so far reaches in that time.
    void writeFront() {
        std::vector<PlotPoint> all;
        for (const Placed& p : placed_) all.push_back({p.point->x, p.point->y, {}});
        std::vector<std::pair<double, double>> steps;
        for (const std::size_t i : paretoFront(all)) {
            if (!steps.empty()) steps.emplace_back(placed_[i].x, steps.back().second);
            steps.emplace_back(placed_[i].x, placed_[i].y);
        }
        if (steps.empty()) return;
        steps.insert(steps.begin(), {steps.front().first, top_});
        steps.emplace_back(left_ + width_, steps.back().second);
        out_.path(steps, "stroke='#999' stroke-width='1.6' stroke-dasharray='6 4'");
        out_.text(left_ + width_ - 4, top_ + 14, "dashed: Pareto front", 11, "end", "fill='#777'");
    }

    void writeCurve(const Curve& curve, const char* colour) {
        if (!curve.line) return;
        std::vector<std::pair<double, double>> points;
        for (const PlotPoint& point : curve.points) points.emplace_back(atX(point.x), atY(point.y));
        out_.path(points, std::string("stroke-width='1.6' stroke='") + colour + "'");
    }

    /// Each number goes where it is least in the way of points and of the numbers before it.
    void writeNumbers() {
        std::vector<std::pair<double, double>> taken;
        for (const Placed& p : placed_) taken.emplace_back(p.x, p.y);
        for (const Placed& p : placed_) {
            if (p.number == 0) continue;
            double best_x = p.x, best_y = p.y, best = 1e30;
            for (int i = 0; i < 32; ++i) {
                const double turn = 2 * 3.14159265 * (i % 16) / 16, far = i < 16 ? 13 : 24;
                const double x = p.x + far * std::cos(turn), y = p.y - far * std::sin(turn);
                double cost = i < 16 ? 0 : 0.4;
                for (const auto& [tx, ty] : taken) {
                    const double apart = std::hypot((tx - x) * 0.8, ty - y);
                    if (apart < 15) cost += (15 - apart) / 5;
                }
                if (x < left_ + 8 || x > left_ + width_ - 8 || y < top_ + 6 || y > top_ + kHeight - 6) cost += 3;
                if (cost < best - 1e-9) best = cost, best_x = x, best_y = y;
            }
            taken.emplace_back(best_x, best_y);
            const std::string style = std::string("stroke-width='0.7' stroke='") + p.colour + "'";
            if (std::hypot(best_x - p.x, best_y - p.y) > 16) out_.line(p.x, p.y, best_x, best_y, style.c_str());
            const std::string fill =
                std::string("font-weight='bold' stroke='white' stroke-width='3' paint-order='stroke' fill='") + p.colour + "'";
            out_.text(best_x, best_y + 4, std::to_string(p.number), 12, "middle", fill.c_str());
        }
    }

    void writeList() {
        double y = top_ + kHeight + kBelow + 8;
        std::size_t at = 0;
        for (const Curve& curve : plot_.curves) {
            bool named = false;
            for (const PlotPoint& point : curve.points) {
                const Placed& p = placed_[at++];
                if (p.number == 0) continue;
                named = true;
                out_.dot(left_ - 30, y - 4, 3.6, p.colour);
                out_.text(left_ - 8, y, std::to_string(p.number), 12, "end");
                out_.text(left_, y, point.name, 12);
                y += kLine;
            }
            if (named) continue;
            out_.dot(left_ - 30, y - 4, 3.6, colourOf(static_cast<std::size_t>(&curve - plot_.curves.data())));
            out_.text(left_, y, curve.name, 12);
            y += kLine;
        }
    }

    Writer& out_;
    const Plot& plot_;
    double left_, top_, width_;
    Axis x_axis_, y_axis_;
    std::vector<Placed> placed_;
};

}  // namespace

std::string svg(const std::string& heading, const std::vector<Plot>& plots) {
    Writer body;
    // As large as fits over one plot: a letter is about 0.6 of its height wide.
    const int size = static_cast<int>(std::clamp(580 / (0.6 * static_cast<double>(heading.size())), 8.0, 17.0));
    body.text(18, 28, heading, size, "start", "font-weight='bold'");
    double top = kHeading;
    for (std::size_t i = 0; i < plots.size(); i += 2) {
        double height = 0;
        for (std::size_t j = i; j < std::min(i + 2, plots.size()); ++j) {
            PlotWriter(body, plots[j], j == i ? 0 : kColumn, top).write();
            height = std::max(height, PlotWriter::heightOf(plots[j]));
        }
        top += height;
    }
    const double width = plots.size() > 1 ? 2 * kColumn : kColumn;
    return "<svg xmlns='http://www.w3.org/2000/svg' width='" + number(width) + "' height='" + number(top) + "' viewBox='0 0 " +
           number(width) + " " + number(top) +
           "' font-family='DejaVu Sans, Helvetica, Arial, sans-serif' fill='#222'>\n<rect width='100%' height='100%' "
           "fill='white'/>\n" +
           body.str() + "</svg>\n";
}

}  // namespace radiata::lab
