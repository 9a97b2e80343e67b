#include "synchronous/symmetric.h"

#include "assembly/frequency_scales.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::synchronous {

namespace {

using assembly::Discretization;
using linalg::Matrix;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool symmetric_bearings(const model::Rotor &rotor) {
    return rotor.every_row([](const model::BearingCoefficients &row) {
        return model::symmetric(row.k) && model::symmetric(row.m) && model::symmetric(row.kt);
    });
}

/// Roots of (K - W^2 A) x = 0 through K + t A, positive definite for t > 0 where the free rigid
/// rotor is a long one: its roots are sqrt(W^2 + t). @throws linalg::SolverError for others.
std::vector<linalg::RealPair> lifted_roots(const Discretization &d, const Matrix &K,
                                           const Matrix &A, int wanted) {
    const double t = std::pow(0.3 * assembly::elastic_scale(d), 2);
    std::vector<linalg::RealPair> out;
    for (linalg::RealPair pair :
         linalg::DefinitePair(Matrix::sum(1, K, t, A), A).smallest(wanted)) {
        const double square = pair.value * pair.value - t;
        const bool zero = square < 1e-6 * t;
        pair.residual *= zero ? 0 : pair.value * pair.value / square;
        pair.value = zero ? 0 : std::sqrt(square);
        out.push_back(pair);
    }
    return out;
}

} // namespace

bool SymmetricSynchronous::exists(const Discretization &d, results::Form form) {
    if (form == results::Form::planar || form == results::Form::hyperbolic)
        return true;
    if (form == results::Form::hill || d.rotor().damped() || !symmetric_bearings(d.rotor()) ||
        d.rotor().shaft.axial_torque != 0)
        return false;
    if (form == results::Form::rotating)
        return true;
    return modes::zero_modes(d, results::Form::general, 0, 0).eigenvalues == 0;
}

SymmetricSynchronous::SymmetricSynchronous(const Discretization &rotor, results::Form form,
                                           int whirl_sign)
    : _d(rotor), _form(form), _doubled(form == results::Form::general) {
    if (form == results::Form::planar) {
        const assembly::PlanarSystem system = assembly::assemble_planar(rotor, 0);
        _A = Matrix::sum(1, system.M, -whirl_sign, system.G);
    } else if (form == results::Form::rotating) {
        const assembly::RotatingSystem system = held_in_rotating_axes(rotor, 0);
        _A = Matrix::sum(-1, system.Kss, 0, system.Kss);
    } else {
        const assembly::FixedSystem system = assembly::assemble_fixed(rotor, 0);
        _A = _doubled ? doubled(system.M, &system.G)
                      : Matrix::sum(1, system.M, 1, assembly::hyperbolic_coupling(rotor));
    }
}

Matrix SymmetricSynchronous::stiffness(double bearing_speed) const {
    if (_form == results::Form::planar)
        return assembly::assemble_planar(_d, bearing_speed).K;
    if (_form == results::Form::rotating)
        return held_in_rotating_axes(_d, bearing_speed).K;
    Matrix K = assembly::assemble_fixed(_d, bearing_speed).K;
    return _doubled ? doubled(K, nullptr) : std::move(K);
}

/// K lets rigid motions free, or is not positive: as eigenvalues of the even quadratic problem
/// about a shift; the roots at zero are left out.
SymmetricSynchronous::Passages SymmetricSynchronous::about_a_shift(const Matrix &K, int wanted,
                                                                   int zeros) const {
    const Matrix minus_A = Matrix::sum(-1, _A, 0, _A);
    const Matrix none = Matrix::sum(0, _A, 0, _A);
    const Sparse A = _A.view();
    linalg::QuadraticOptions options;
    options.shift = 0.3 * (_form == results::Form::rotating ? assembly::support_scale(_d)
                                                            : assembly::elastic_scale(_d));
    options.zeros = zeros;
    options.fewest = 1;
    // Roots of zero come as +-sqrt(rounding) on either axis, others far above.
    const double least =
        (zeros > 0 || _form == results::Form::rotating ? 1e-3 : 1e-7) * options.shift;
    for (int ask = 2 * wanted + zeros + 2;; ask *= 2) {
        options.wanted = std::min(2 * K.size(), ask);
        const linalg::QuadraticResult found = linalg::solve_quadratic(minus_A, none, K, options);
        Passages out;
        for (const linalg::ComplexPair &pair : found.pairs) {
            const double w = pair.value.real();
            if (w <= least || std::abs(pair.value.imag()) >= 1e-6 * w)
                continue;
            const Eigen::VectorXd x = pair.vector.real();
            out.list.push_back({{w, x, pair.residual, pair.rounding}, x.dot(A * x) > 0});
        }
        std::ranges::stable_sort(out.list, {}, [](const auto &root) { return root.pair.value; });
        const double radius = found.complete_radius;
        out.complete_to = radius >= options.shift ? options.shift + radius : 0;
        const auto sure = std::ranges::count_if(
            out.list, [&](const auto &root) { return root.pair.value <= out.complete_to; });
        if (sure >= wanted || std::isinf(radius) || options.wanted == 2 * K.size()) {
            out.list.resize(static_cast<std::size_t>(sure));
            return out;
        }
    }
}

SymmetricSynchronous::Passages SymmetricSynchronous::constant(double bearing_speed,
                                                              int wanted) const {
    const Matrix K = stiffness(bearing_speed);
    const results::Form motions =
        _form == results::Form::planar ? results::Form::planar : results::Form::hyperbolic;
    const int zeros = _doubled ? 0 : modes::zero_modes(_d, motions, bearing_speed, 0).eigenvalues;
    Passages out;
    try {
        const std::vector<linalg::RealPair> pairs =
            zeros > 0 ? lifted_roots(_d, K, _A, wanted + zeros)
                      : linalg::DefinitePair(K, _A).smallest(wanted);
        out.complete_to = static_cast<int>(pairs.size()) < wanted + zeros
                              ? infinity
                              : std::max(0.0, pairs.empty() ? 0 : pairs.back().value);
        for (const linalg::RealPair &pair : pairs)
            if (pair.value > 0)
                out.list.push_back({pair, true});
        return out;
    } catch (const linalg::Unresolved &) {
        throw;
    } catch (const linalg::SolverError &) {
        return about_a_shift(K, wanted, zeros);
    }
}

SynchronousRoots SymmetricSynchronous::named(const Passages &found) const {
    SynchronousRoots out;
    out.complete_to = found.complete_to;
    int negative = 0;
    for (std::size_t i = 0; i < found.list.size(); ++i) {
        const CrossingPair &root = found.list[i];
        const int branch = root.downwards ? ++negative : negative--;
        if (!_doubled)
            out.roots.push_back({root.pair, branch});
        else if (i % 2 == 0)
            out.roots.push_back({root.pair, (branch + 1) / 2});
    }
    return out;
}

SynchronousRoots SymmetricSynchronous::at_bearing_speed(double speed, int wanted) const {
    return named(constant(speed, multiplicity() * wanted));
}

SynchronousRoots SymmetricSynchronous::lowest(int wanted, double top) const {
    for (int ask = multiplicity() * wanted;; ask *= 2) {
        Passages found = constant(0, ask);
        const bool more = static_cast<int>(found.list.size()) >= ask;
        if (!more || found.complete_to > top || ask > 10000)
            return named(found);
    }
}

} // namespace whirl::synchronous
