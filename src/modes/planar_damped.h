#pragma once

#include "assembly/discretization.h"
#include "linalg/definite_pencil.h"
#include "modes/following/symmetric_problem.h"
#include "modes/general_spectrum.h"

#include <memory>
#include <optional>

namespace whirl::modes {

/// Whirl modes of a damped rotor that is the same from every direction, on w = x + i y alone:
/// Q(l) = l^2 M + l (C + i Cx - i speed G) + K + i Kx - i speed Kc, complex and symmetric. The sign
/// of Im l is the direction of whirl.
///
/// Each eigenvalue starts from one of the rotor without damping and cross coupling, of which the
/// inertia says that none is missing, and is refined with the full matrices
/// (following/eigenpair_refinement.h). The argument around a circle of det Q over that of the
/// undamped rotor, the eigenvalues known of both divided out, then counts what is missing within:
/// where there is something (creeping motions against strong dampers), the real form of twice the
/// size takes its place.
class PlanarDamped {
  public:
    /// Bearings as at `bearing_speed` (rad/s).
    PlanarDamped(const assembly::Discretization &discretization, double bearing_speed);

    /// At least `wanted` whirl modes of least modulus, or all. The shape w of a mode goes with
    /// `rotating_value`, its eigenvalue with the sign of the whirl.
    /// @throws linalg::SolverError
    [[nodiscard]] Spectrum modes(double speed, int wanted) const;

  private:
    const assembly::Discretization &_discretization;
    double _bearing_speed;
    std::unique_ptr<SymmetricProblem> _problem;
    std::unique_ptr<linalg::DefinitePencil> _undamped; ///< none: no start from there
    mutable std::unique_ptr<GeneralSpectrum> _general;
    mutable int _failures = 0; ///< speeds at which the undamped rotor was no good start

    [[nodiscard]] std::optional<Spectrum> from_undamped(double speed, int wanted, int ask) const;
    [[nodiscard]] Spectrum of_real_form(double speed, int wanted) const;
};

} // namespace whirl::modes
