#pragma once

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "periodic/whole_root.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::forced {

/// A motion that repeats with every turn: its parts at multiples of the spin speed in the fixed
/// frame, in steps of two from the first (0: what stands still, its amplitudes real).
struct TurnParts {
    int first = 1;
    std::vector<Phasor> parts;

    /// (x, y) when the rotor has turned through an angle, rad.
    [[nodiscard]] Eigen::Vector2d at(double angle) const;
    /// The largest distance from (0, 0) over a turn.
    [[nodiscard]] double largest() const;
    /// What that changes where the parts change by these.
    [[nodiscard]] double change_of_largest(const TurnParts &changes) const;
    /// What a probe reads that looks along `angle`: a motion in x.
    [[nodiscard]] TurnParts read(double angle) const;
    /// Without what stands still.
    [[nodiscard]] TurnParts moving() const;
    /// At `multiple` times the spin speed.
    [[nodiscard]] Phasor part(int multiple) const;

  private:
    /// The angle at which it is farthest from (0, 0), rad.
    [[nodiscard]] double farthest() const;
};

/// Steady motion of an asymmetric rotor on bearings that differ between their directions, under
/// its imbalances or its weight. In rotating axes the bearings turn backwards, so that the
/// equations repeat with half a turn and the motion has terms exp(2 i k Omega t) beside that of
/// the load (periodic::WholeRotor): in the fixed frame imbalances move it at 1, 3, 5, ... times the
/// spin speed, the weight at 0, 2, 4, ... times. docs/theory.md, "Rotor and bearings both
/// unsymmetric, driven".
class PeriodicMotion {
  public:
    /// @param gravity  m/s2 towards -y: under the weight; 0: under the imbalances
    explicit PeriodicMotion(const assembly::Discretization &discretization, double gravity = 0);

    /// @param speed  rad/s
    /// @returns false at a resonance without damping
    [[nodiscard]] bool solve(double speed);

    /// Of the last solution: deflections of a combination of planar unknowns, m.
    [[nodiscard]] TurnParts motion(const assembly::Combination &combination) const;
    /// Force of a bearing on the shaft's support, N.
    [[nodiscard]] TurnParts bearing_force(int bearing) const;
    /// Relative error of the last solution by rounding.
    [[nodiscard]] double rounding() const { return _solution.rounding; }
    /// Real unknowns in rotating axes.
    [[nodiscard]] int unknowns() const { return 2 * _discretization.planar_size(); }

  private:
    const assembly::Discretization &_discretization;
    double _gravity;
    periodic::WholeRotor _rotor;
    double _speed = 0;
    periodic::WholeRotor::Driven _solution;
};

} // namespace whirl::forced
