#include "reference/tensor_function.h"

#include <string>

#include "base/error.h"

namespace radiata::reference {
namespace {

/// One index fewer: sums over the last one, weighted by x.
std::vector<double> contract(const std::vector<double>& entries, const glm::dvec3& x) {
    std::vector<double> result(entries.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = entries[3 * i] * x.x + entries[3 * i + 1] * x.y + entries[3 * i + 2] * x.z;
    }
    return result;
}

}  // namespace

TensorFunction::TensorFunction(int order, std::span<const double> components) : order_(order) { expand(components); }

TensorFunction::TensorFunction(int order, std::span<const float> components) : order_(order) {
    expand(std::vector<double>(components.begin(), components.end()));
}

void TensorFunction::expand(std::span<const double> components) {
    const auto n = static_cast<std::size_t>(order_);
    if (components.size() != (n + 1) * (n + 2) / 2) {
        throw Error(Code::kInternal,
                    "TensorFunction: " + std::to_string(components.size()) + " components for order " + std::to_string(order_));
    }
    std::size_t size = 1;
    for (std::size_t i = 0; i < n; ++i) size *= 3;
    entries_.resize(size);
    for (std::size_t entry = 0; entry < size; ++entry) {
        std::size_t y = 0, z = 0;
        for (std::size_t rest = entry; rest > 0; rest /= 3) {
            y += rest % 3 == 1;
            z += rest % 3 == 2;
        }
        entries_[entry] = components[(y + z) * (y + z + 1) / 2 + z];
    }
}

double TensorFunction::operator()(const glm::dvec3& x) const {
    std::vector<double> rest = contract(entries_, x);
    for (int i = 1; i < order_; ++i) rest = contract(rest, x);
    return rest[0];
}

glm::dvec3 TensorFunction::gradient(const glm::dvec3& x) const {
    std::vector<double> rest = entries_;
    for (int i = 1; i < order_; ++i) rest = contract(rest, x);
    return static_cast<double>(order_) * glm::dvec3(rest[0], rest[1], rest[2]);
}

}  // namespace radiata::reference
