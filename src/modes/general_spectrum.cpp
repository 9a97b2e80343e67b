#include "modes/general_spectrum.h"

#include "assembly/frequency_scales.h"
#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::modes {

namespace {

/// Positive by more than residual and rounding of the entries explain.
bool grows(const linalg::ComplexPair &pair) {
    return pair.value.real() > 10 * (pair.residual + pair.rounding) * std::abs(pair.value);
}

} // namespace

GeneralSpectrum::GeneralSpectrum(const assembly::Discretization &discretization,
                                 double bearing_speed)
    : _discretization(discretization), _bearing_speed(bearing_speed),
      _system(assembly::assemble_fixed(discretization, bearing_speed)) {}

GeneralSpectrum::GeneralSpectrum(const assembly::Discretization &discretization,
                                 assembly::FixedSystem system)
    : _discretization(discretization), _bearing_speed(0), _system(std::move(system)) {}

GeneralSpectrum::Modes GeneralSpectrum::solve(double speed, int wanted, Errors errors) const {
    using linalg::Matrix;
    const Matrix D = Matrix::sum(1, _system.C, speed, _system.G);
    const Matrix K = Matrix::sum(1, _system.K, speed, _system.Kc);
    const ZeroModes zeros =
        zero_modes(_discretization, results::Form::general, _bearing_speed, speed);
    linalg::QuadraticOptions options;
    options.zeros = zeros.eigenvalues;
    options.condition = errors == Errors::with_left_vectors;
    options.wanted = std::min(D.size(), wanted + (zeros.eigenvalues + 1) / 2);
    if (zeros.eigenvalues > 0)
        options.shift = 0.3 * assembly::elastic_scale(_discretization);
    linalg::QuadraticResult found;
    try {
        found = linalg::solve_quadratic(_system.M, D, K, options);
    } catch (const linalg::SolverError &) {
        // Motions that creep, as against strong dampers, have eigenvalues so near zero that the
        // others drown beside them; a shift towards the others brings both to one size.
        if (options.shift != 0)
            throw;
        options.shift = 0.3 * assembly::elastic_scale(_discretization);
        options.wanted = std::min(D.size(), options.wanted + 4);
        found = linalg::solve_quadratic(_system.M, D, K, options);
    }
    std::sort(found.pairs.begin(), found.pairs.end(),
              [](const auto &a, const auto &b) { return std::abs(a.value) < std::abs(b.value); });
    Modes out;
    out.complete_radius = std::max(0.0, found.complete_radius - options.shift);
    out.dense = found.method == linalg::QuadraticMethod::dense;
    out.modes = zeros.modes;
    int skip = zeros.eigenvalues;
    for (const linalg::ComplexPair &pair : found.pairs) {
        if (skip > 0) { // the blurred zeros; a complex pair stands for two
            skip -= pair.value.imag() != 0 ? 2 : 1;
        } else if (pair.value.imag() <=
                   std::max(real_axis, 10 * pair.residual) * std::abs(pair.value)) {
            out.overdamped.push_back(pair.value.real());
            if (grows(pair))
                out.growing.push_back(pair.value.real());
        } else {
            WhirlMode mode;
            mode.eigenvalue = pair.value;
            mode.shape = pair.vector;
            mode.left = pair.left;
            mode.residual = pair.residual;
            mode.rounding = pair.rounding;
            out.modes.push_back(std::move(mode));
        }
    }
    return out;
}

GeneralSpectrum::Modes GeneralSpectrum::modes(double speed, int wanted, Errors errors) const {
    const int all = _system.M.size();
    int ask = std::min(all, wanted);
    Modes out;
    // Where double precision does not resolve as many side by side, fewer: the caller sees it.
    for (bool solved = false; !solved;) {
        try {
            out = solve(speed, ask, errors);
            solved = true;
        } catch (const linalg::SolverError &) {
            if (ask <= 4)
                throw;
            ask = std::max(4, ask * 2 / 3);
        }
    }
    if (ask < std::min(all, wanted))
        return out;
    while (true) {
        const int found = static_cast<int>(out.modes.size());
        if (found >= wanted || ask == all || std::isinf(out.complete_radius))
            return out;
        // Real eigenvalues took the places; ask for as many more.
        ask = std::min(all, ask + std::max(4, wanted - found));
        try {
            out = solve(speed, ask, errors);
        } catch (const linalg::SolverError &) {
            return out; // what lies above cannot be resolved beside what is found
        }
    }
}

} // namespace whirl::modes
