#include "math/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace radiata {

std::vector<std::pair<double, double>> gaussLegendre(int n) {
    std::vector<std::pair<double, double>> rule;
    for (int i = 0; i < n; ++i) {
        double z = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 0;
        for (int step = 0; step < 100; ++step) {
            double before = 0, here = 1;
            for (int k = 1; k <= n; ++k) {
                const double next = ((2.0 * k - 1) * z * here - (k - 1.0) * before) / k;
                before = here;
                here = next;
            }
            slope = n * (z * here - before) / (z * z - 1);
            const double change = here / slope;
            z -= change;
            if (std::abs(change) < 1e-15) break;
        }
        rule.emplace_back(z, 2 / ((1 - z * z) * slope * slope));
    }
    return rule;
}

}  // namespace radiata
