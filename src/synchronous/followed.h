#pragma once

#include "results/formulation.h"
#include "synchronous/general.h"

#include <utility>
#include <vector>

namespace whirl::synchronous {

/// Synchronous modes of a damped or coupled rotor with bearing tables: eigenvalues l(s) with the
/// coefficients of the bearings at s for which Im l(s) = s. Between two rows the coefficients are
/// linear in s; the eigenvalues at both ends, of which none is missing, are matched one to one by
/// their derivatives (left and right vectors), and each one's Im l - s is looked at as the cubic
/// through values and derivatives. Steps in which a match or the number of zeros is doubtful are
/// halved. Zeros are refined on the problem itself.
class FollowedSynchronous {
  public:
    /// @param form  general or rotating; the rotor has bearing tables
    FollowedSynchronous(const assembly::Discretization &rotor, results::Form form)
        : _d(rotor), _problem(rotor, form) {}

    struct Modes {
        std::vector<modes::WhirlMode> modes; ///< ascending; without the sense of whirl
        double complete_to = 0;              ///< rad/s; infinity: there are no more
        /// Speeds between which a motion could not be followed, rad/s.
        std::vector<std::pair<double, double>> doubtful;
    };

    /// At least `wanted` and all up to `top` (rad/s), where the model has so many.
    /// @throws linalg::SolverError
    [[nodiscard]] Modes lowest(int wanted, double top) const;

  private:
    const assembly::Discretization &_d;
    GeneralSynchronous _problem;
};

} // namespace whirl::synchronous
