#include "balancers/equal_masses.h"

#include "closed_form/balanced_position.h"

#include <cmath>
#include <numbers>

namespace whirl::balancers {

std::vector<double> symmetric_position(int masses, double capacity) {
    using std::numbers::pi;
    if (std::isinf(capacity)) {
        // Two masses at +-pi/2, the limit of their position as E grows.
        std::vector<double> polygon;
        for (int j = 0; j < masses; ++j)
            polygon.push_back(pi * (2 * j + 1) / masses);
        return polygon;
    }
    if (masses == 1)
        return {pi};
    return closed_form::symmetric_position(masses, capacity).value();
}

std::complex<double> second_harmonic(const std::vector<double> &angles, std::size_t first,
                                     std::size_t last) {
    return closed_form::second_harmonic({angles.begin() + static_cast<std::ptrdiff_t>(first),
                                         angles.begin() + static_cast<std::ptrdiff_t>(last)});
}

} // namespace whirl::balancers
