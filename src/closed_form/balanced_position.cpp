#include "closed_form/balanced_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::closed_form {

std::optional<std::vector<double>> symmetric_position(int balls, double capacity) {
    if (balls < 2 || !(capacity >= 1.0))
        return std::nullopt;
    const bool odd = balls % 2 == 1;
    const double cosine = odd ? -(balls / capacity - 1.0) / (balls - 1.0) : -1.0 / capacity;
    const double half_angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    std::vector<double> angles;
    for (int pair = 0; pair < balls / 2; ++pair) {
        angles.push_back(half_angle);
        angles.push_back(-half_angle);
    }
    if (odd)
        angles.push_back(std::numbers::pi);
    return angles;
}

std::complex<double> second_harmonic(std::span<const double> angles) {
    std::complex<double> sum = 0.0;
    for (const double angle : angles)
        sum += std::polar(1.0, 2.0 * angle);
    return sum / static_cast<double>(angles.size());
}

} // namespace whirl::closed_form
