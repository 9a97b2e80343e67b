#pragma once

#include "linalg/eigenpair.h"
#include "modes/form_matrices.h"
#include "modes/roots/whole_pencil.h"

#include <optional>
#include <utility>

namespace whirl::modes {

/// The whole rotor in rotating axes: its eigenpairs at a speed from guesses.
class RotatingPencil {
  public:
    /// @param matrices  form rotating
    /// @param slow      of the order of the motions on the supports, 1/s
    RotatingPencil(FormMatrices matrices, double slow)
        : _matrices(std::move(matrices)), _slow(slow) {}

    void set_speed(double speed);

    /// The eigenpair next to one that is nearly one. A real value stays real.
    /// @param farthest  that it may go away, in parts of its value
    /// @returns with its left vector; nothing where it does not converge or goes away
    [[nodiscard]] std::optional<linalg::ComplexPair> refined(const linalg::ComplexPair &guess,
                                                             double farthest = 1e-3);

  private:
    FormMatrices _matrices;
    double _slow;
    double _speed = 0;
    WholePencil<double> _pencil;
};

} // namespace whirl::modes
