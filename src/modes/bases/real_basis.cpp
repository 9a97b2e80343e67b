#include "modes/bases/real_basis.h"

#include "results/whirl.h"

namespace whirl::modes {

namespace {

/// v of the problem: signed and real in the symmetric forms.
double real_value(const WhirlMode &mode, results::Form form, double speed) {
    const bool negative =
        form == results::Form::planar && (mode.whirl == results::Whirl::forward) != (speed >= 0);
    return negative ? -mode.eigenvalue.imag() : mode.eigenvalue.imag();
}

} // namespace

ModeBasis real_basis(const QuadraticAt &problem, const Spectrum &spectrum, results::Form form) {
    const auto count = std::ssize(spectrum.modes);
    Eigen::VectorXd values(count);
    Eigen::MatrixXd X(problem.M.rows(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const WhirlMode &mode = spectrum.modes[static_cast<std::size_t>(i)];
        values(i) = real_value(mode, form, spectrum.speed);
        X.col(i) = mode.shape.real();
    }
    ModeBasis out = basis_of(problem, values, X);
    for (Eigen::VectorXcd *rates : {&out.rate_below, &out.rate_above})
        for (Eigen::Index i = 0; i < count; ++i)
            (*rates)(i) = {0, values(i) < 0 ? -(*rates)(i).real() : (*rates)(i).real()};
    return out;
}

} // namespace whirl::modes
