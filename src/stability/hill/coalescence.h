#pragma once

#include "stability/hill/motions.h"

#include <array>
#include <complex>
#include <vector>

namespace whirl::stability {

/// Eigenvalues of two motions at a spin speed.
struct PairValues {
    double speed = 0;                   ///< rad/s
    std::complex<double> first, second; ///< 1/s
};

/// Two motions that may meet between two spin speeds: their eigenvalues at both.
struct Coalescence {
    double from = 0; ///< rad/s
    double to = 0;
    std::complex<double> first_from, second_from, first_to, second_to; ///< 1/s
    bool ordered = true; ///< false: at `to` it is not known which is which
    int aliases = 0;     ///< the second one is that many of its aliases away (Motion::repeats)
    std::array<int, 2> index_from{}; ///< which of the motions at `from` they are
    std::array<int, 2> index_to{};
    std::vector<PairValues> beyond; ///< the two outside of the speeds, where they are known
    int action = 0; ///< of the first one at both ends, the second has the other; 0: not known
};

/// How motions go on from one spin speed to another.
struct Continuation {
    static constexpr int nowhere = -1;     ///< no index
    std::vector<int> to;                   ///< index of each motion at the other speed, or nowhere
    std::vector<Coalescence> coalescences; ///< pairs that may open a band in between
    bool doubtful = false; ///< a motion that matters has no partner: the step is too long
};

/// Motions are followed by their states: those at `to` are written as combinations of those at
/// `from` (least squares); where one coefficient outweighs the others, that is the motion.
///
/// Two motions that became mixtures of each other are known as a pair only. Pairs that cross in
/// frequency, by themselves or a whole number of aliases away, and pairs known as pairs may meet.
/// Of a pair and its conjugate one is listed; pairs too damped to open a band are left out. Larger
/// groups of mixtures, and motions without a partner well inside of what was computed, are
/// doubtful.
[[nodiscard]] Continuation continued(double from, const std::vector<Motion> &motions_from,
                                     double to, const std::vector<Motion> &motions_to);

} // namespace whirl::stability
