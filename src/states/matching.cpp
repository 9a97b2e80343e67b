#include "states/matching.h"

#include "balancers/kind.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

namespace whirl::states {

namespace {

constexpr double near = 0.05;      ///< of the imbalance of all masses side by side
constexpr double near_angle = 0.1; ///< rad: two balls so far off make as much

/// What two positions of one balancer are apart, over what still counts as one position.
double apart(const balancers::Kind &kind, const std::vector<double> &a,
             const std::vector<double> &b, bool family) {
    const std::vector<balancers::CircledMass> masses = kind.circled();
    if (masses.empty()) {
        double most = 0;
        for (std::size_t j = 0; j < std::min(a.size(), b.size()); ++j)
            most = std::max(most, std::abs(std::remainder(a[j] - b[j], 2 * std::numbers::pi)));
        return most / near_angle;
    }
    std::map<int, std::pair<std::complex<double>, double>> sorts; // difference, side by side
    for (std::size_t j = 0; j < masses.size(); ++j) {
        auto &[difference, all] = sorts[family ? 0 : masses[j].alike];
        difference += masses[j].moment * (std::polar(1.0, a[j]) - std::polar(1.0, b[j]));
        all += masses[j].moment;
    }
    double most = 0;
    for (const auto &[number, sums] : sorts)
        most = std::max(most, std::abs(sums.first) / sums.second);
    return most / near;
}

} // namespace

std::optional<std::size_t> matching_state(const model::Rotor &rotor,
                                          const results::SteadyStates &states,
                                          const results::HeldMotion &motion) {
    if (!motion.at_rest)
        return std::nullopt;
    std::optional<std::size_t> nearest;
    double least = 1;
    for (std::size_t i = 0; i < states.states.size(); ++i) {
        const results::SteadyState &state = states.states[i];
        if (state.speed != motion.speed)
            continue;
        double most = 0;
        for (std::size_t b = 0; b < rotor.balancers.size(); ++b)
            most = std::max(most, apart(*balancers::kind_of(rotor.balancers[b]), motion.angles[b],
                                        state.angles[b], state.family));
        if (most < least) {
            least = most;
            nearest = i;
        }
    }
    return nearest;
}

} // namespace whirl::states
