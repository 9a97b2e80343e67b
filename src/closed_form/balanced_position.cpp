#include "closed_form/balanced_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::closed_form {

namespace {

/// (1/n) sum exp(i multiple a_j).
std::complex<double> mean_harmonic(const std::vector<double> &angles, double multiple) {
    std::complex<double> sum = 0.0;
    for (const double angle : angles)
        sum += std::polar(1.0, multiple * angle);
    return sum / static_cast<double>(angles.size());
}

} // namespace

double capacity(int balls, double ball_mass, double ball_radius, double imbalance_moment) {
    return balls * ball_mass * ball_radius / imbalance_moment;
}

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

double balance_defect(const std::vector<double> &angles, double capacity) {
    return std::abs(mean_harmonic(angles, 1.0) + 1.0 / capacity);
}

std::complex<double> second_harmonic(const std::vector<double> &angles) {
    return mean_harmonic(angles, 2.0);
}

} // namespace whirl::closed_form
