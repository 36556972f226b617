#include "tools/lab/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace radiata::lab {
namespace {

constexpr double kZero = 0.04, kAfterZero = 0.14, kEnd = 0.97;

std::string label(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

}  // namespace

Axis::Axis(const std::vector<double>& values, bool logarithmic) : logarithmic_(logarithmic) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : values) {
        if (logarithmic && !(value > 0)) {
            has_zero_ = true;
            continue;
        }
        const double at = logarithmic ? std::log10(value) : value;
        low = std::min(low, at);
        high = std::max(high, at);
    }
    if (!(low <= high)) {
        // Nothing but zeros, or nothing at all.
        low = logarithmic ? -4 : 0;
        high = 0;
    }
    if (logarithmic) {
        // At least one decade, so that labels are there.
        const double room = std::max(0.08, 0.5 * (1.1 - (high - low)));
        low -= room;
        high += room;
        if (has_zero_) from_ = kAfterZero;
    } else {
        low = std::min(low, 0.0);
        if (!(low < high)) high = low + 1;
    }
    low_ = low;
    high_ = high;
}

double Axis::place(double value) const {
    if (logarithmic_ && !(value > 0)) return kZero;
    const double at = logarithmic_ ? std::log10(value) : value;
    return from_ + (kEnd - from_) * (at - low_) / (high_ - low_);
}

std::vector<Tick> Axis::ticks() const { return logarithmic_ ? decades() : steps(); }

std::vector<Tick> Axis::decades() const {
    std::vector<Tick> ticks;
    if (has_zero_) ticks.push_back({kZero, "0"});
    const int first = static_cast<int>(std::floor(low_)), last = static_cast<int>(std::ceil(high_));
    const bool few = high_ - low_ < 3;
    const int stride = std::max(1, (last - first + 7) / 8);
    for (int decade = first; decade <= last; ++decade) {
        for (int digit = 1; digit < 10; ++digit) {
            const double value = digit * std::pow(10.0, decade), at = std::log10(value);
            if (at < low_ || at > high_) continue;
            const bool named = digit == 1 ? (decade - first) % stride == 0 : few && (digit == 2 || digit == 5);
            if (digit == 1 || few) ticks.push_back({place(value), named ? label(value) : ""});
        }
    }
    return ticks;
}

std::vector<Tick> Axis::steps() const {
    const double rough = (high_ - low_) / 6, power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = power;
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
        step = factor * power;
        if (step >= rough) break;
    }
    std::vector<Tick> ticks;
    for (double value = std::ceil(low_ / step) * step; value <= high_ + 1e-9 * step; value += step) {
        ticks.push_back({place(value), label(std::abs(value) < 1e-9 * step ? 0 : value)});
    }
    return ticks;
}

}  // namespace radiata::lab
