// One axis of a plot: which value stands where, and where its ticks are.
#pragma once

#include <string>
#include <vector>

namespace radiata::lab {

struct Tick {
    double at = 0;      ///< 0 to 1 along the axis
    std::string label;  ///< empty: a small one
};

class Axis {
public:
    /// \param values  what must fit; on a logarithmic axis those that are not positive stand at `zeroAt()`
    Axis(const std::vector<double>& values, bool logarithmic);

    /// Where a value stands, 0 to 1.
    double place(double value) const;
    std::vector<Tick> ticks() const;

private:
    std::vector<Tick> decades() const;
    std::vector<Tick> steps() const;

    bool logarithmic_, has_zero_ = false;
    double low_ = 0, high_ = 1;  ///< of the value or its decimal logarithm
    double from_ = 0.03;         ///< place of low_; beyond it the zeros have room
};

}  // namespace radiata::lab
