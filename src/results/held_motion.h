#pragma once

#include "results/steady_states.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::results {

/// The motion at one speed, over the last part of the time that it was held.
struct HeldMotion {
    bool up = true;                          ///< reached from the speed below
    double speed = 0;                        ///< rad/s
    std::vector<double> amplitude;           ///< of each station, largest |w|, m
    std::vector<double> rms;                 ///< of each station, root mean square of |w|, m
    std::vector<double> planes;              ///< of each balancer, largest |w| of its plane, m
    std::vector<std::vector<double>> angles; ///< of each balancer at the end, (-pi, pi], rad
    std::vector<std::vector<double>> rates;  ///< mean turning in the rotor, rad/s
    bool settled = false;                    ///< both halves of that part are alike
    bool at_rest = false;                    ///< all parts of balancers stand still in the rotor
    std::optional<std::size_t> state;        ///< steady state that it came to rest in: its place

    /// Largest |w| of the balancers' planes, without balancers of the stations, m.
    [[nodiscard]] double largest() const;
};

/// A sudden change of the motion between two speeds held one after the other.
struct MotionJump {
    bool up = true;
    double from = 0, to = 0;      ///< rad/s, as they were passed
    double before = 0, after = 0; ///< largest(), m
};

/// One of many motions from other starts.
struct StartedMotion {
    std::vector<double> start_angles; ///< of all balls and pairs, rad
    /// How it went at the end; none: its balls would overlap at the start, or it was interrupted.
    std::optional<HeldMotion> motion;
    std::optional<std::size_t> end; ///< its place among the ends
};

/// A way in which motions end.
struct MotionEnd {
    std::optional<std::size_t> state; ///< its place among the steady states; none: no such state
    bool at_rest = false;             ///< all parts of balancers stand still in the rotor
    int count = 0;                    ///< of motions
    /// Share of the motions, and of random starts the interval of Clopper and Pearson, 95 %, for
    /// the probability.
    double share = 0;
    std::optional<double> low, high;
    double least = 0, largest = 0; ///< HeldMotion::largest() over the motions, m
    int unsettled = 0;             ///< motions that still changed at the end
};

/// Where motions from many starts end.
struct ManyStarts {
    std::vector<StartedMotion> motions; ///< of a grid: the first angle runs fastest
    std::vector<double> grid;           ///< of a grid: the values of either angle, rad
    std::vector<MotionEnd> ends;        ///< states by their numbers, then what is none
    int left_out = 0;                   ///< starts that are none, and motions not followed
    std::optional<SteadyStates> states; ///< at the last speed; none: no answer
};

/// A sweep in time over the speeds of [simulate.sweep].
struct HeldSweep {
    double size = 0;                 ///< m; deflections below a hundredth of this count as none
    std::vector<HeldMotion> motions; ///< in the order of time
    std::vector<MotionJump> jumps;   ///< in the order of time
    /// Speeds at which the motion depends on where the rotor comes from, from and to, rad/s.
    std::vector<std::pair<double, double>> hysteresis;
    /// All steady states at these speeds; none: no balancers, or no answer.
    std::optional<SteadyStates> states;
};

} // namespace whirl::results
