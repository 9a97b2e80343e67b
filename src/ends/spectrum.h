#pragma once

#include "modes/roots/branches.h"

#include <complex>

namespace whirl::ends {

using modes::Root;
/// Of a reduced rotor, or a whole one.
using DenseProblem = modes::DenseQuadratic<double>;

/// All eigenvalues of a rotor at one speed, both conjugates, but those that are zero at every
/// speed.
struct Spectrum : modes::RootsAt {
    DenseProblem problem; ///< whose roots they are

    [[nodiscard]] int growing() const;
    /// The root next to a value.
    [[nodiscard]] const Root &nearest(std::complex<double> value) const;
};

} // namespace whirl::ends
