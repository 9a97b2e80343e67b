#include "modes/general_spectrum.h"

#include "assembly/frequency_scales.h"
#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace whirl::modes {

GeneralSpectrum::GeneralSpectrum(const assembly::Discretization &discretization,
                                 double bearing_speed)
    : _discretization(discretization), _bearing_speed(bearing_speed),
      _system(assembly::assemble_fixed(discretization, bearing_speed)) {}

class GeneralSpectrum::AtSpeed {
  public:
    AtSpeed(const GeneralSpectrum &of, double speed)
        : _M(of._system.M.view()), _D(_M), _K(_M), _speed(speed),
          _relaxation(Relaxation::of(of._discretization.rotor().shaft)),
          _elastic_scale(assembly::elastic_scale(of._discretization)),
          _zeros(zero_modes(of._discretization, results::Form::general, of._bearing_speed, speed)) {
        using linalg::Matrix;
        _D = Matrix::sum(1, of._system.C, speed, of._system.G).view();
        _K = Matrix::sum(1, of._system.K, speed, of._system.Kc).view();
    }

    [[nodiscard]] const ZeroModes &zeros() const { return _zeros; }
    [[nodiscard]] double elastic_shift() const { return 0.3 * _elastic_scale; }
    /// Nothing found yet.
    [[nodiscard]] Spectrum empty() const {
        Spectrum out;
        out.speed = _speed;
        out.relaxation = _relaxation;
        return out;
    }

    [[nodiscard]] linalg::QuadraticOptions options(int wanted) const {
        linalg::QuadraticOptions out;
        out.zeros = _zeros.eigenvalues;
        out.wanted = std::min(static_cast<int>(_M.rows()), wanted + (_zeros.eigenvalues + 1) / 2);
        out.shift = _zeros.eigenvalues > 0 ? elastic_shift() : 0;
        if (relaxes_within(wanted))
            out.shift = _relaxation.shift();
        return out;
    }

    /// @throws linalg::SolverError where the matrix at the shift is singular
    [[nodiscard]] linalg::QuadraticSolver &solver(double shift) {
        std::unique_ptr<linalg::QuadraticSolver> &out = _solvers[shift];
        if (!out)
            out = std::make_unique<linalg::QuadraticSolver>(_M, _D, _K, shift);
        return *out;
    }

  private:
    Eigen::SparseMatrix<double> _M, _D, _K;
    double _speed;
    Relaxation _relaxation;
    double _elastic_scale; ///< 1/s

    /// The rate at which the shaft's motions come to rest is not far beyond the modes wanted: two a
    /// bending shape, whose frequencies grow with the square of its number.
    [[nodiscard]] bool relaxes_within(int wanted) const {
        const double shapes = wanted / 2.0 + 1;
        return _relaxation.rate < shapes * shapes * _elastic_scale;
    }
    ZeroModes _zeros;
    std::map<double, std::unique_ptr<linalg::QuadraticSolver>> _solvers; ///< by their shifts
};

Spectrum GeneralSpectrum::solve(AtSpeed &problem, int wanted, Errors errors) const {
    linalg::QuadraticOptions options = problem.options(wanted);
    options.condition = errors == Errors::with_left_vectors;
    const ZeroModes &zeros = problem.zeros();
    linalg::QuadraticResult found;
    try {
        found = problem.solver(options.shift).solve(options);
    } catch (const linalg::SolverError &) {
        // Motions that creep, as against strong dampers, have eigenvalues so near zero that the
        // rounding of theirs hides the others; a shift towards the others brings both to one size.
        if (options.shift != 0)
            throw;
        options.shift = problem.elastic_shift();
        options.wanted = std::min(_system.M.size(), options.wanted + 4);
        found = problem.solver(options.shift).solve(options);
    }
    std::sort(found.pairs.begin(), found.pairs.end(),
              [](const auto &a, const auto &b) { return std::abs(a.value) < std::abs(b.value); });
    Spectrum out = problem.empty();
    out.complete_radius = std::max(0.0, found.complete_radius - options.shift);
    out.modes = zeros.modes;
    int skip = zeros.eigenvalues;
    for (const linalg::ComplexPair &pair : found.pairs) {
        if (skip > 0) { // the blurred zeros; a complex pair stands for two
            skip -= pair.value.imag() != 0 ? 2 : 1;
            continue;
        }
        WhirlMode mode;
        mode.eigenvalue = pair.value;
        mode.shape = pair.vector;
        mode.left = pair.left;
        mode.residual = pair.residual;
        mode.rounding = pair.rounding;
        out.add(pair.value, std::move(mode));
    }
    return out;
}

Spectrum GeneralSpectrum::modes(double speed, int wanted, Errors errors) const {
    const int all = _system.M.size();
    int ask = std::min(all, wanted);
    AtSpeed problem(*this, speed);
    Spectrum out;
    // Where double precision does not resolve as many side by side, fewer: the caller sees it.
    for (bool solved = false; !solved;) {
        try {
            out = solve(problem, ask, errors);
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
            out = solve(problem, ask, errors);
        } catch (const linalg::SolverError &) {
            return out; // what lies above cannot be resolved beside what is found
        }
    }
}

} // namespace whirl::modes
