#pragma once

#include "assembly/system.h"
#include "modes/whirl_mode.h"

#include <vector>

namespace whirl::modes {

/// Whirl modes of the real form M q'' + (C + speed G) q' + (K + speed Kc) q = 0.
class GeneralSpectrum {
  public:
    /// Bearings as at `bearing_speed` (rad/s).
    GeneralSpectrum(const assembly::Discretization &discretization, double bearing_speed);

    /// At least `wanted` whirl modes of least modulus, or all: Im > 0 or zero modes, whirl not set.
    [[nodiscard]] Spectrum modes(double speed, int wanted,
                                 Errors errors = Errors::with_left_vectors) const;

  private:
    const assembly::Discretization &_discretization;
    double _bearing_speed;
    assembly::FixedSystem _system;

    /// The problem at one speed and one shift after the other.
    class AtSpeed;
    [[nodiscard]] Spectrum solve(AtSpeed &problem, int wanted, Errors errors) const;
};

} // namespace whirl::modes
