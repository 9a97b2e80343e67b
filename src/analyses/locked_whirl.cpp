#include "analyses/locked_whirl.h"

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

std::complex<double> seen_from_rotor(const WhirlMode &mode) {
    return {mode.eigenvalue.real(), mode.frequency_rotating};
}

} // namespace

bool locked(const WhirlMode &mode, double speed) {
    return mode.frequency_rotating == 0 && speed != 0 && mode.eigenvalue.imag() == std::abs(speed);
}

double end_of_lock(const SpectrumSolver &solver, const Spectrum &held, std::size_t held_place,
                   const Spectrum &free, std::size_t free_place) {
    std::complex<double> inside = seen_from_rotor(held.modes[held_place]);
    std::complex<double> outside = seen_from_rotor(free.modes[free_place]);
    double locked_at = held.speed;
    double free_at = free.speed;
    const auto wanted = static_cast<int>(std::max(held.modes.size(), free.modes.size()));
    for (int step = 0; step < 60 && std::abs(free_at - locked_at) > 1e-11 * std::abs(free_at);
         ++step) {
        const double middle = (free_at + locked_at) / 2;
        const Spectrum between = solver.at(middle, wanted);
        const auto distance = [&](const WhirlMode &mode) {
            const std::complex<double> here = seen_from_rotor(mode);
            return std::min(std::abs(here - inside), std::abs(here - outside));
        };
        const auto nearest = std::min_element(
            between.modes.begin(), between.modes.end(),
            [&](const WhirlMode &a, const WhirlMode &b) { return distance(a) < distance(b); });
        if (nearest == between.modes.end())
            break;
        const bool still = locked(*nearest, middle);
        (still ? locked_at : free_at) = middle;
        (still ? inside : outside) = seen_from_rotor(*nearest);
    }
    return locked_at;
}

} // namespace whirl::analyses
