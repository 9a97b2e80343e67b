#include "analyses/general_spectrum.h"

#include "analyses/zero_modes.h"
#include "linalg/quadratic_eigen.h"

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

/// Relative to the modulus, an imaginary part below this is rounding of a real eigenvalue: two
/// real ones that nearly meet are moved by the root of the rounding.
constexpr double real_axis = 1e-6;

} // namespace

GeneralSpectrum::GeneralSpectrum(const assembly::Discretization &discretization,
                                 double bearing_speed)
    : _discretization(discretization),
      _system(assembly::assemble_fixed(discretization, bearing_speed)) {}

GeneralSpectrum::Modes GeneralSpectrum::solve(double speed, int wanted) const {
    using linalg::Matrix;
    const Matrix D = Matrix::sum(1, _system.C, speed, _system.G);
    const Matrix K = Matrix::sum(1, _system.K, speed, _system.Kc);
    const ZeroModes zeros = zero_modes(_discretization, false, D, K);
    linalg::QuadraticOptions options;
    options.wanted = std::min(D.size(), wanted + (zeros.eigenvalues + 1) / 2);
    if (zeros.eigenvalues > 0)
        options.shift = 0.3 * elastic_scale(_discretization);
    linalg::QuadraticResult found = linalg::solve_quadratic(_system.M, D, K, options);
    std::sort(found.pairs.begin(), found.pairs.end(),
              [](const auto &a, const auto &b) { return std::abs(a.value) < std::abs(b.value); });
    Modes out;
    out.complete_radius = found.complete_radius;
    for (int i = 0; i < zeros.whirl_modes; ++i) {
        WhirlMode mode;
        const Eigen::Index column = std::min<Eigen::Index>(i, zeros.motions.cols() - 1);
        mode.shape = zeros.motions.col(column).cast<std::complex<double>>();
        out.modes.push_back(mode);
    }
    int skip = zeros.eigenvalues;
    for (const linalg::ComplexPair &pair : found.pairs) {
        if (skip > 0) { // the blurred zeros; a complex pair stands for two
            skip -= pair.value.imag() != 0 ? 2 : 1;
        } else if (pair.value.imag() <= real_axis * std::abs(pair.value)) {
            out.overdamped.push_back(pair.value.real());
        } else {
            WhirlMode mode;
            mode.eigenvalue = pair.value;
            mode.shape = pair.vector;
            mode.residual = pair.residual;
            mode.rounding = pair.rounding;
            out.modes.push_back(std::move(mode));
        }
    }
    return out;
}

GeneralSpectrum::Modes GeneralSpectrum::modes(double speed, int wanted) const {
    const int all = _system.M.size();
    int ask = std::min(all, wanted);
    while (true) {
        Modes out = solve(speed, ask);
        const int found = static_cast<int>(out.modes.size());
        if (found >= wanted || ask == all || std::isinf(out.complete_radius))
            return out;
        // Real eigenvalues took the places; ask for as many more.
        ask = std::min(all, ask + std::max(4, wanted - found));
    }
}

} // namespace whirl::analyses
