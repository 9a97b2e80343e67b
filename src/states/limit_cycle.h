#pragma once

#include "model/case.h"
#include "simulation/motion.h"
#include "simulation/ode_solver.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
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

/// Limit cycles of a rotor on bearings alike in all directions at one speed, by shooting: Newton's
/// method for the start and the period of a motion that returns, which `simulate`'s integrator
/// follows over a period. Its derivative over the start, by central differences, has the Floquet
/// multipliers as eigenvalues. One shot is enough: a period is some turns of the rotor, over which
/// unstable motions grow by a few orders at most.
class LimitCycles {
  public:
    /// @param parts   of a motion that is alike in time (not_alike_in_time())
    /// @param method  that suits it
    LimitCycles(const simulation::MovingParts &parts, double speed, double moment,
                simulation::OdeMethod method);

    /// The cycle that a motion is next to, from where it is: the first return to there is the
    /// guess.
    /// @param start  as LimitCycle::start
    /// @returns none: no return near the start, or none that Newton's method makes one
    /// @throws linalg::SolverError where the motion cannot be followed
    [[nodiscard]] std::optional<LimitCycle> next_to(const Eigen::VectorXd &start) const;
    /// The cycle next to another one, of the same turns.
    [[nodiscard]] std::optional<LimitCycle> refined(const LimitCycle &guess) const;

    /// Calls with times and states in rotor axes at equal steps from the start to the end.
    using Observer = std::function<void(double time, const Eigen::VectorXd &state)>;
    void follow(const Eigen::VectorXd &start, double time, int steps, const Observer &at) const;

    [[nodiscard]] const simulation::RotorMotion &motion() const { return _motion; }

  private:
    simulation::RotorMotion _motion;
    double _speed;
    double _moment;
    simulation::OdeMethod _method;

    [[nodiscard]] Eigen::VectorXd sizes(const Eigen::VectorXd &start) const;
    [[nodiscard]] Eigen::VectorXd after(const Eigen::VectorXd &start, double time) const;
    [[nodiscard]] Eigen::VectorXd rates(const Eigen::VectorXd &state) const;
    [[nodiscard]] std::optional<LimitCycle> newton(LimitCycle guess) const;
};

} // namespace whirl::states
