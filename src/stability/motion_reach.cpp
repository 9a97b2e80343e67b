#include "stability/motion_reach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace whirl::stability {

double motion_reach(std::vector<std::vector<double>> sizes, double least) {
    constexpr std::size_t fewest = 8; // slowest motions at a speed, which always count
    std::vector<double> all;
    for (std::vector<double> &here : sizes) {
        std::ranges::sort(here);
        if (!here.empty())
            least = std::max(least, here[std::min(here.size(), fewest) - 1]);
        all.insert(all.end(), here.begin(), here.end());
    }
    std::ranges::sort(all);
    double below = least;
    double widest = 1;
    double reach = 2 * least;
    for (const double size : all) {
        if (size <= least)
            continue;
        const double above = std::min(size, 2 * least);
        if (above / below > widest) {
            widest = above / below;
            reach = std::sqrt(above * below);
        }
        if (size >= 2 * least)
            break;
        below = size;
    }
    return reach;
}

bool bearings_drive(const model::Rotor &rotor) {
    return rotor.shaft.axial_torque != 0 || !rotor.every_row([](const auto &at) {
        return model::symmetric(at.k) && !model::pushes_away(at.c);
    });
}

int fewest_motions(const model::Rotor &rotor) {
    constexpr int driven = 24; // fast ones too
    constexpr int usual = 8;
    return bearings_drive(rotor) ? driven : usual;
}

double growth_reach(const model::Rotor &rotor, results::Form form, double speed) {
    constexpr double without_end = std::numeric_limits<double>::infinity();
    const auto quotient = [](const Eigen::Matrix2d &k, const Eigen::Matrix2d &c) {
        if (model::pushes_away(c))
            return without_end;
        if (model::symmetric(k))
            return 0.0;
        const Eigen::Matrix2d damping = (c + c.transpose()) / 2;
        const double skew = std::abs(k(0, 1) - k(1, 0)) / 2;
        return skew / std::sqrt(std::max(
                          damping(0, 0) * damping(1, 1) - damping(0, 1) * damping(1, 0), 0.0));
    };
    if (!rotor.shaft.torque_has_potential())
        return without_end;
    double of_bearings = 0;
    for (const model::Bearing &bearing : rotor.bearings)
        for (const model::BearingCoefficients &at : bearing.rows) {
            if (!model::symmetric(at.m))
                return without_end;
            of_bearings = std::max({of_bearings, quotient(at.k, at.c), quotient(at.kt, at.ct)});
        }
    if (results::in_rotating_axes(form))
        return speed + of_bearings;
    return rotor.shaft.internal_damping != 0 ? std::max(speed, of_bearings) : of_bearings;
}

} // namespace whirl::stability
