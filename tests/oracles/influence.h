#pragma once

#include "oracles/case_rotor.h"
#include "oracles/receptance.h"

namespace whirl::oracles {

/// The shaft of a case without its mass on two isotropic supports: influence coefficients by
/// virtual work (Maxwell and Mohr), from statics alone.
class MasslessShaft {
  public:
    /// @param factor  of E and G
    /// @param asymmetry  of a segment counts with this sign: EI(1 + sign x asymmetry)
    explicit MasslessShaft(const CaseRotor &rotor, Real factor = 1, Real asymmetry_sign = 0);

    /// Deflection w (m) and slope of the section (rad) at every place for a unit force (N) and a
    /// unit moment (N m) at every place: rows and columns w, phi of the first place, then of the
    /// second, ...
    [[nodiscard]] RealMatrix coefficients(const std::vector<Real> &places) const;

  private:
    struct Part {
        Real left, right, EI, shear;
    };
    std::vector<Part> _parts;
    std::vector<Real> _support;   ///< z, m
    std::vector<Real> _stiffness; ///< N/m

    [[nodiscard]] Real virtual_work(Real place_i, bool moment_i, Real place_j, bool moment_j) const;
};

/// Masses on the massless shaft: discs of the case, and its own mass in `lumps` thin slices.
struct Lumps {
    std::vector<Real> z;
    std::vector<Real> mass; ///< kg
    std::vector<Real> tilt; ///< Id - Ip, which a forward synchronous motion feels, kg m2
};
[[nodiscard]] Lumps lumps_of(const CaseRotor &rotor, int slices);

/// Forward critical speeds (rad/s), ascending, with the places `pinned` held:
/// eigenvalues 1/w^2 of coefficients x (mass, Id - Ip).
[[nodiscard]] std::vector<Real> lumped_critical_speeds(const MasslessShaft &shaft,
                                                       const Lumps &lumps,
                                                       const std::vector<Real> &pinned = {});

/// R = Omega^2 (receptance) at the places (1/kg) of the undamped rotor with lumped masses,
/// u = F (f + Omega^2 (M - G) u): the criterion by influence coefficients (Filimonikhin et al.).
[[nodiscard]] RealMatrix lumped_criterion_form(const MasslessShaft &shaft, const Lumps &lumps,
                                               Real speed, const std::vector<Real> &places);

} // namespace whirl::oracles
