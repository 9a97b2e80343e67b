#pragma once

#include "linalg/definite_pencil.h"
#include "modes/whirl_mode.h"
#include "modes/zero_modes.h"

#include <memory>

namespace whirl::modes {

/// Whirl modes of (K + w speed S - w^2 M) x = 0: the planar form (S = G; w > 0 is forward at
/// positive speed) and the hyperbolic form (S = -[0 G; G 0]; frequencies come as +-w).
class SymmetricSpectrum {
  public:
    /// Bearings as at `bearing_speed` (rad/s).
    SymmetricSpectrum(const assembly::Discretization &discretization, bool planar,
                      double bearing_speed);

    /// As DefinitePencil::expect.
    void expect(int speeds);

    /// At least `wanted` modes with the lowest frequencies, or all; unsorted, whirl set only in
    /// planar form.
    [[nodiscard]] std::vector<WhirlMode> modes(double speed, int wanted) const;

  private:
    const assembly::Discretization &_discretization;
    bool _planar;
    double _bearing_speed;
    linalg::Matrix _M, _K, _S;
    bool _supported; ///< no rigid motion is free: K is positive definite
    std::unique_ptr<linalg::DefinitePencil> _pencil;

    [[nodiscard]] std::vector<WhirlMode> modes_of(const std::vector<linalg::RealPair> &pairs,
                                                  double speed) const;
    [[nodiscard]] std::vector<WhirlMode> free_modes(double speed, int wanted) const;
    [[nodiscard]] WhirlMode mode_of(double w, const Eigen::VectorXd &x, double speed) const;
};

} // namespace whirl::modes
