#pragma once

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "results/simulate.h"

#include <complex>

namespace whirl::simulation {

/// The rotor with all imbalances there are at the end of a motion.
[[nodiscard]] model::Rotor rotor_at_end(const model::Case &scene,
                                        const results::SimulateResult &result);

/// A rotor without balancers as a case, driven over the speeds passed in a motion.
[[nodiscard]] model::Case driven(const model::Case &scene, model::Rotor rotor,
                                 const results::SimulateResult &result);

/// Steady motion under the imbalances at one speed.
class SteadyMotion {
  public:
    /// @param d  must outlive this
    /// @throws linalg::SolverError at a resonance without damping
    SteadyMotion(const assembly::Discretization &d, results::Form form, double speed);

    /// Largest deflection over a turn, m.
    [[nodiscard]] double amplitude(double z) const;
    /// The part of a deflection that stands still in the rotor, m.
    [[nodiscard]] std::complex<double> in_rotor(double z) const;
    /// Largest amplitude of balancers and stations, m.
    [[nodiscard]] double largest(const results::SimulateResult &result) const;

  private:
    const assembly::Discretization &_d;
    forced::ForcedMotion _motion;
};

} // namespace whirl::simulation
