#pragma once

#include "balancers/parts_motion.h"
#include "simulation/moving_parts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace whirl::simulation {

/// Two neighbours in a race, coordinates of free parts, or one of them (-1) a wall of the rotor at
/// the angle 0: angle[second] - angle[first] + offset - touching >= 0.
struct Gap {
    int first = 0, second = 0;
    double offset = 0;   ///< whole turns between their unwrapped angles, rad
    double touching = 0; ///< angle between the centres of parts that touch, rad
    double restitution = 1;

    /// That of the second less that of the first: of angles, rates or accelerations in the rotor.
    [[nodiscard]] double between(const double *values) const {
        return (second < 0 ? 0 : values[second]) - (first < 0 ? 0 : values[first]);
    }
    /// One that is no wall.
    [[nodiscard]] int part() const { return second < 0 ? first : second; }
};

/// Which free parts touch and which stand by friction; docs/theory.md, "Contact and rolling".
struct DryState {
    std::vector<Gap> gaps;
    std::vector<bool> closed;  ///< of each gap: its parts stay together while they press
    std::vector<bool> resists; ///< of each free coordinate: it has resistance to rolling
    std::vector<int>
        slip;        ///< of each: sense of its motion in the rotor; 0: one that resists stands
    double rate = 0; ///< 1/s, at which what a constraint lacks by rounding is made good

    [[nodiscard]] bool any() const {
        return !gaps.empty() || std::ranges::find(resists, true) != resists.end();
    }
    [[nodiscard]] bool stands(std::size_t i) const { return resists[i] && slip[i] == 0; }
    /// Both of a gap stand, or are walls.
    [[nodiscard]] bool both_stand(const Gap &gap) const {
        return std::ranges::all_of(std::array{gap.first, gap.second}, [this](int i) {
            return i < 0 || stands(static_cast<std::size_t>(i));
        });
    }
};

/// Contact and friction on a free coordinate at one moment.
struct DryTorque {
    balancers::PlaneVector row = balancers::PlaneVector::Zero(); ///< of y in its equation
    double push = 0;                                             ///< torque of all constraints, N m
    double stand = 0;  ///< of that the torque that keeps it standing, N m
    double wall = 0;   ///< of that the torque of walls, N m
    double limit = 0;  ///< largest torque of friction, N m
    double normal = 0; ///< force of the race, N
};

/// Holds two coordinates together, or one in the rotor (the other -1).
struct Constraint {
    int first = -1, second = 0;
    std::size_t multiplier = 0; ///< its place: that of a gap, or behind these of a part that stands
};

/// Who may touch whom, and who resists rolling: neighbours in each race by their angles at the
/// start, which they remain.
/// @param angles  of all coordinates at the start, rad
/// @param rate    1/s, see DryState
/// @param given   the case gives the start
/// @throws model::BadInput where parts overlap at the start that cannot pass each other, or a wall.
[[nodiscard]] DryState dry_state(const MovingParts &parts, const std::vector<double> &angles,
                                 double rate, bool given = true);

} // namespace whirl::simulation
