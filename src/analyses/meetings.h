#pragma once

#include "analyses/motions.h"

#include <complex>
#include <vector>

namespace whirl::analyses {

/// Two motions that may meet between two spin speeds: their eigenvalues at both.
struct Meeting {
    double from = 0; ///< rad/s
    double to = 0;
    std::complex<double> first_from, second_from, first_to, second_to; ///< 1/s
};

/// Pairs of motions whose frequencies change order between the two speeds, or which are too alike
/// to tell whether they do. Motions are followed by their states: those at `to` are written as
/// combinations of those at `from` (least squares), the largest coefficient tells which is which.
/// Of a pair and its conjugate one is listed; pairs too damped to open a band are left out.
[[nodiscard]] std::vector<Meeting> meetings(double from, const std::vector<Motion> &motions_from,
                                            double to, const std::vector<Motion> &motions_to);

} // namespace whirl::analyses
