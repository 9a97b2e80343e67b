#pragma once

#include "model/case.h"
#include "simulation/motion.h"
#include "simulation/ode_solver.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace whirl::states {

/// Why motions of this case are not the same from all sides at all times, so that no limit cycle is
/// looked for (end of a sentence); empty: they are.
[[nodiscard]] std::string not_alike_in_time(const model::Case &scene);

/// A motion that repeats itself in axes that turn with the rotor, each part of the balancers turned
/// on by whole turns: balls that stalled next to a critical speed, or swing about a place for ever.
struct LimitCycle {
    double speed = 0; ///< of the rotor, rad/s
    /// Reduced rotor in rotor axes (real, then imaginary part) and angles; then their velocities,
    /// those of the rotor in axes that stand still, seen from rotor axes.
    Eigen::VectorXd start;
    double period = 0;      ///< s
    std::vector<int> turns; ///< of each angle in the rotor over a period
    double defect = 0;      ///< what start differs by after a period, over the size of the motion
    /// Of small motions over a period, largest modulus first, without that along the cycle, which
    /// is 1.
    Eigen::VectorXcd multipliers;
    double multiplier_error = 0; ///< |what was found for that one - 1|

    /// Growth of the small motion that grows most, 1/s.
    [[nodiscard]] double growth() const;
    /// None: neither by more than the error.
    [[nodiscard]] std::optional<bool> stable() const;
};

/// A cycle on a branch over the speed.
struct BranchPoint {
    enum class Kind {
        ordinary,
        fold,  ///< the branch turns back here
        border ///< between stable and unstable
    };
    LimitCycle cycle;
    Kind kind = Kind::ordinary;
};

/// Both ends of a branch, from the slower beginning on.
struct CycleBranch {
    enum class End {
        range,    ///< the end of the speeds asked for
        standing, ///< the period grows without bounds: towards states in which the balls rest
        points,   ///< more points than are followed
        lost      ///< Newton's method leads nowhere, however short the step
    };
    std::vector<BranchPoint> points; ///< along the branch
    End first = End::range, last = End::range;
};

/// Limit cycles of a rotor on bearings alike in all directions, by shooting: Newton's method for
/// the start and the period of a motion that returns, which `simulate`'s integrator follows over a
/// period. Its derivative over the start, by differences, has the Floquet multipliers as
/// eigenvalues. One shot is enough: a period is some turns of the rotor, over which unstable
/// motions grow by a few orders at most. docs/theory.md, "Limit cycles".
class LimitCycles {
  public:
    /// @param parts   of a motion that is alike in time (not_alike_in_time())
    /// @param moment  a size of the moments of mass, kg m
    /// @param method  that suits it
    LimitCycles(simulation::MovingParts parts, double moment, simulation::OdeMethod method);

    /// The cycle that a motion is next to, from where it is: the first return to there is the
    /// guess.
    /// @param start  as LimitCycle::start
    /// @returns none: no return near the start, or none that Newton's method makes one
    /// @throws linalg::SolverError where the motion cannot be followed
    [[nodiscard]] std::optional<LimitCycle> next_to(const Eigen::VectorXd &start,
                                                    double speed) const;

    /// Distance of a state from the start of a cycle, angles but for whole turns, over the sizes of
    /// the motion.
    [[nodiscard]] double apart(const LimitCycle &cycle, const Eigen::VectorXd &state) const;

    /// The cycles that a cycle goes over into as the speed changes, through folds, by steps of arc
    /// length; folds and borders of stability as roots to some 1e-7 of the speed.
    /// @param count  of steps over the range, where the branch is not bent
    [[nodiscard]] CycleBranch branch(const LimitCycle &cycle, double from, double to,
                                     int count) const;

    /// Calls with times and states in rotor axes at equal steps from the start to the end.
    using Observer = std::function<void(double time, const Eigen::VectorXd &state)>;
    void follow(const Eigen::VectorXd &start, double speed, double time, int steps,
                const Observer &at) const;

    [[nodiscard]] const simulation::MovingParts &parts() const { return _parts; }

  private:
    simulation::MovingParts _parts;
    double _moment;
    simulation::OdeMethod _method;

    /// Over (start, period, speed), each over its size: what a shot misses its start by.
    struct Derivative {
        Eigen::MatrixXd by_start; ///< with that of the end alone: the monodromy matrix
        Eigen::VectorXd by_period, by_speed;
        Eigen::VectorXd along; ///< the motion at the start
    };
    struct Corrected {
        LimitCycle cycle;
        Derivative derivative;
        int shots = 0;
    };
    class Following;

    [[nodiscard]] double distance(const Eigen::VectorXd &a, const Eigen::VectorXd &b,
                                  const Eigen::VectorXd &sizes) const;
    [[nodiscard]] simulation::RotorMotion motion(double speed) const;
    [[nodiscard]] Eigen::VectorXd sizes(const Eigen::VectorXd &start, double speed) const;
    [[nodiscard]] Eigen::VectorXd after(const LimitCycle &cycle) const;
    [[nodiscard]] Eigen::VectorXd rates(const Eigen::VectorXd &state, double speed) const;
    [[nodiscard]] Eigen::VectorXd missed(const LimitCycle &cycle,
                                         const Eigen::VectorXd &sizes) const;
    [[nodiscard]] Derivative derivative(const LimitCycle &cycle,
                                        const Eigen::VectorXd &sizes) const;
    [[nodiscard]] std::optional<Corrected> corrected(LimitCycle guess, const Eigen::VectorXd &sizes,
                                                     Derivative derivative,
                                                     const Eigen::VectorXd *tangent) const;
};

} // namespace whirl::states
