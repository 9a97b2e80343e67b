#pragma once

#include "stability/hill/coalescence.h"
#include "stability/unstable_bands.h"

namespace whirl::stability {

/// What became of two motions that may meet.
struct CoalescenceVerdict {
    enum class Kind {
        grows,  ///< at `speed`
        stable, ///< nowhere in between
        unsure  ///< mean and difference of the two are not smooth between the speeds given
    };
    Kind kind = Kind::unsure;
    double speed = 0; ///< rad/s
};

/// Looks for a speed at which two motions that coalesce grow. The mean s and the squared half
/// difference q of their eigenvalues are smooth in the speed even where the eigenvalues s +-
/// sqrt(q) are not; interpolated, they lead to the place where s + sqrt(q) grows most, and what is
/// found there judges the interpolation.
///
/// Motions without damping whose opposite actions are known at both ends are distinguished
/// everywhere but inside their band: the sign of the difference of their frequencies brackets it.
/// None is seen of bands in which growth stays within the noise of the two.
[[nodiscard]] CoalescenceVerdict examine(const MotionsAt &at, const Coalescence &coalescence);

} // namespace whirl::stability
