#include "modes/turning/turning_basis.h"

#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::modes {

namespace {

/// Change of the eigenvalue in the fixed frame from that of the value in rotating axes: the mode
/// whirls at the spin speed plus or minus what is seen from the rotor.
std::complex<double> seen_from_ground(const WhirlMode &mode, double speed,
                                      std::complex<double> rate) {
    if (speed == 0)
        return std::numeric_limits<double>::quiet_NaN(); // both whirls at once
    const bool positive = (mode.whirl == results::Whirl::forward) == (speed > 0);
    const double turn = positive ? mode.eigenvalue.imag() : -mode.eigenvalue.imag();
    const double turn_rate = 1 + (turn >= speed ? rate.imag() : -rate.imag());
    return {rate.real(), positive ? turn_rate : -turn_rate};
}

} // namespace

ModeBasis turning_basis(const QuadraticAt &problem, const Spectrum &spectrum, bool mirrored) {
    const Eigen::Index n = problem.M.rows();
    const auto count = std::ssize(spectrum.modes);
    const auto mode = [&spectrum](Eigen::Index i) -> const WhirlMode & {
        return spectrum.modes[static_cast<std::size_t>(i)];
    };
    Eigen::VectorXcd values(count);
    Eigen::MatrixXcd X(n, count);
    Eigen::MatrixXcd Y(n, count);
    bool known = true; // left vectors
    for (Eigen::Index i = 0; i < count; ++i) {
        values(i) = mode(i).rotating_value;
        X.col(i) = mode(i).rotating_vector;
        known = known && mode(i).rotating_left.size() == n;
        if (known)
            Y.col(i) = mode(i).rotating_left;
    }
    ModeBasis out =
        known ? basis_of(problem, values, X, Y) : basis_of(problem, values, X, mirrored);
    out.copies = {out.complex_right.conjugate()};
    out.ways_back = {0};
    for (Eigen::VectorXcd *rates : {&out.rate_below, &out.rate_above})
        for (Eigen::Index i = 0; i < count; ++i)
            (*rates)(i) = seen_from_ground(mode(i), spectrum.speed, (*rates)(i));
    return out;
}

} // namespace whirl::modes
