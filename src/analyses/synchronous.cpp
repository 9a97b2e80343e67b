#include "analyses/synchronous.h"

#include "analyses/arrangement.h"
#include "analyses/orbits.h"
#include "analyses/zero_modes.h"
#include "assembly/rotating_system.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "linalg/quadratic_eigen.h"

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

using assembly::Discretization;
using linalg::Matrix;

WhirlMode mode_of(const linalg::RealPair &pair) {
    WhirlMode mode;
    mode.eigenvalue = {0, pair.value};
    mode.shape = pair.vector.cast<std::complex<double>>();
    mode.residual = pair.residual;
    mode.rounding = pair.rounding;
    return mode;
}

/// Positive roots W of det[K - W^2 A] where K lets rigid motions free: as eigenvalues of the even
/// quadratic problem about a shift; the roots at zero are left out.
std::vector<linalg::RealPair> free_roots(const Discretization &d, bool planar, const Matrix &K,
                                         const Matrix &M, const Matrix &A, int wanted) {
    const Matrix minus_A = Matrix::sum(-1, A, 0, A);
    const Matrix none = Matrix::sum(0, A, 0, A);
    const ZeroModes zeros = zero_modes(d, planar ? Form::planar : Form::hyperbolic, M, none, K);
    linalg::QuadraticOptions options;
    options.shift = 0.3 * elastic_scale(d);
    options.zeros = zeros.eigenvalues;
    options.wanted = std::min(2 * K.size(), 2 * wanted + zeros.eigenvalues + 2);
    std::vector<linalg::RealPair> out;
    for (const linalg::ComplexPair &pair : solve_quadratic(minus_A, none, K, options).pairs) {
        const double w = pair.value.real();
        // Roots of zero come as +-sqrt(rounding) on either axis, others far above.
        if (w > 1e-3 * options.shift && std::abs(pair.value.imag()) < 1e-6 * w)
            out.push_back({w, pair.vector.real(), pair.residual, pair.rounding});
    }
    return out;
}

/// The same through K + t A, positive definite for t > 0 where the free rigid rotor is a long one:
/// its roots are sqrt(W^2 + t). @throws linalg::SolverError for others.
std::vector<linalg::RealPair> lifted_roots(const Discretization &d, const Matrix &K,
                                           const Matrix &A, int wanted, int zeros) {
    const double t = std::pow(0.3 * elastic_scale(d), 2);
    std::vector<linalg::RealPair> out;
    for (linalg::RealPair pair :
         linalg::DefinitePair(Matrix::sum(1, K, t, A), A).smallest(wanted + zeros)) {
        const double square = pair.value * pair.value - t;
        if (square < 1e-6 * t)
            continue; // the roots at zero
        pair.residual *= pair.value * pair.value / square;
        pair.value = std::sqrt(square);
        out.push_back(pair);
    }
    return out;
}

std::vector<linalg::RealPair> roots(const Discretization &d, bool planar, const Matrix &K,
                                    const Matrix &M, const Matrix &A, int wanted) {
    const Matrix none = Matrix::sum(0, A, 0, A);
    const ZeroModes zeros = zero_modes(d, planar ? Form::planar : Form::hyperbolic, M, none, K);
    if (zeros.eigenvalues > 0) {
        try {
            return lifted_roots(d, K, A, wanted, zeros.eigenvalues);
        } catch (const linalg::SolverError &) {
            return free_roots(d, planar, K, M, A, wanted);
        }
    }
    return linalg::DefinitePair(K, A).smallest(wanted);
}

std::vector<WhirlMode> planar_modes(const Discretization &d, double speed, int wanted) {
    const assembly::PlanarSystem system = assembly::assemble_planar(d, speed);
    std::vector<WhirlMode> out;
    for (const bool forward : {true, false}) {
        const Matrix A = Matrix::sum(1, system.M, forward ? -1 : 1, system.G);
        for (const linalg::RealPair &pair : roots(d, true, system.K, system.M, A, wanted)) {
            out.push_back(mode_of(pair));
            out.back().whirl = forward ? Whirl::forward : Whirl::backward;
            out.back().forward_fraction = forward ? 1 : 0;
        }
    }
    return out;
}

void set_sense(const Discretization &d, bool hyperbolic, std::vector<WhirlMode> &modes) {
    const Stations stations = Stations::for_orbits(d);
    const std::complex<double> i(0, 1);
    for (WhirlMode &mode : modes) {
        const Eigen::Index n = mode.shape.size() / 2;
        const Eigen::VectorXcd x = stations.deflections(mode.shape(Eigen::seqN(0, n, 2)));
        const Eigen::VectorXcd y = stations.deflections(mode.shape(Eigen::seqN(1, n, 2)));
        const OrbitSense sense =
            orbit_sense(x, hyperbolic ? Eigen::VectorXcd(i * y) : y, stations, 1);
        mode.whirl = sense.whirl;
        mode.forward_fraction = sense.forward_fraction;
    }
}

std::vector<WhirlMode> hyperbolic_modes(const Discretization &d, double speed, int wanted) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, speed);
    const Matrix A = Matrix::sum(1, system.M, 1, assembly::hyperbolic_coupling(d));
    std::vector<WhirlMode> out;
    for (const linalg::RealPair &pair : roots(d, false, system.K, system.M, A, wanted))
        out.push_back(mode_of(pair));
    set_sense(d, true, out);
    return out;
}

/// [A B; -B A]: the real form of A - i B on (Re, Im).
Matrix doubled(const Matrix &A, const Matrix *B) {
    const int n = A.size();
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const Matrix &matrix, int row, int column, double sign) {
        const linalg::SparseView view = matrix.view();
        for (int i = 0; i < n; ++i)
            for (linalg::SparseView::InnerIterator it(view, i); it; ++it)
                if (it.value() != 0)
                    entries.emplace_back(row + static_cast<int>(it.row()),
                                         column + static_cast<int>(it.col()), sign * it.value());
    };
    add(A, 0, 0, 1);
    add(A, n, n, 1);
    if (B != nullptr) {
        add(*B, 0, n, 1);
        add(*B, n, 0, -1);
    }
    return Matrix::from_entries(2 * n, entries);
}

/// The doubled problem has the eigenvalues of the complex one and their conjugates. Of each
/// vector (u1, u2), u1 + i u2 is the part that belongs to the complex problem.
bool belongs(const Eigen::VectorXcd &u, Eigen::VectorXcd &shape) {
    const Eigen::Index n = u.size() / 2;
    const std::complex<double> i(0, 1);
    shape = u.head(n) + i * u.tail(n);
    const double rest = (u.head(n) - i * u.tail(n)).norm();
    return shape.norm() > 1e-5 * (shape.norm() + rest);
}

bool present(const std::vector<WhirlMode> &modes, const WhirlMode &mode) {
    return std::any_of(modes.begin(), modes.end(), [&](const WhirlMode &other) {
        const double cosine =
            std::abs(other.shape.dot(mode.shape)) / (other.shape.norm() * mode.shape.norm());
        return std::abs(other.eigenvalue - mode.eigenvalue) < 1e-7 * std::abs(mode.eigenvalue) &&
               cosine > 0.99;
    });
}

std::vector<WhirlMode> general_modes(const Discretization &d, double speed, int wanted) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, speed);
    const Matrix M = doubled(system.M, &system.G);
    const Matrix D = doubled(system.C, &system.Kc);
    const Matrix K = doubled(system.K, nullptr);
    const ZeroModes zeros = zero_modes(d, Form::general, system.M, system.C, system.K);
    linalg::QuadraticOptions options;
    options.zeros = 2 * zeros.eigenvalues;
    if (zeros.eigenvalues > 0)
        options.shift = 0.3 * elastic_scale(d);
    std::vector<WhirlMode> out;
    // Each mode of the complex problem brings a conjugate partner into the doubled one.
    for (int ask = 2 * wanted + 4 + 2 * zeros.eigenvalues;; ask *= 2) {
        options.wanted = std::min(ask, M.size());
        linalg::QuadraticResult found;
        try {
            found = linalg::solve_quadratic(M, D, K, options);
        } catch (const linalg::SolverError &) {
            // As in GeneralSpectrum: creeping motions against strong dampers want a shift.
            if (options.shift != 0 || !out.empty())
                throw;
            options.shift = 0.3 * elastic_scale(d);
            found = linalg::solve_quadratic(M, D, K, options);
        }
        out.clear();
        for (const linalg::ComplexPair &pair : found.pairs) {
            WhirlMode mode;
            const double size = std::abs(pair.value);
            // Beyond a damping ratio of 1/sqrt(2) no response peaks: not a critical speed.
            const bool oscillates = pair.value.imag() > std::abs(pair.value.real());
            const bool zero = zeros.eigenvalues > 0 && size < 1e-3 * options.shift;
            if (!oscillates || zero || !belongs(pair.vector, mode.shape))
                continue;
            mode.eigenvalue = pair.value;
            mode.residual = pair.residual;
            mode.rounding = pair.rounding;
            if (!present(out, mode))
                out.push_back(mode);
        }
        if (static_cast<int>(out.size()) >= wanted || options.wanted == M.size() ||
            std::isinf(found.complete_radius))
            break;
    }
    set_sense(d, false, out);
    return out;
}

/// All are forward; sorted, and one of each pair of equal ones.
void name_forward(std::vector<WhirlMode> &out) {
    for (WhirlMode &mode : out) {
        mode.whirl = Whirl::forward;
        mode.forward_fraction = 1;
    }
    // The same motion in two directions, where nothing asymmetric takes part, is one whirl.
    std::stable_sort(out.begin(), out.end(), [](const WhirlMode &a, const WhirlMode &b) {
        return a.eigenvalue.imag() < b.eigenvalue.imag();
    });
    out.erase(std::unique(out.begin(), out.end(),
                          [](const WhirlMode &a, const WhirlMode &b) {
                              return std::abs(a.eigenvalue - b.eigenvalue) <
                                     1e-9 * std::abs(a.eigenvalue);
                          }),
              out.end());
}

/// Forward modes that stand still in rotating axes, balls held in place: det[K + W Ks + W^2 Kss] =
/// 0. With damping W is complex, l = i W as in the other forms.
std::vector<WhirlMode> rotating_modes(const Discretization &d, double speed, int wanted) {
    const assembly::RotatingSystem system = assembly::assemble_rotating(
        d, speed, balancer_elements(d.rotor(), arrangement_at_balance(d.rotor())), true);
    std::vector<WhirlMode> out;
    if (!d.rotor().damped()) {
        const Matrix A = Matrix::sum(-1, system.Kss, 0, system.Kss);
        try {
            for (const linalg::RealPair &pair :
                 linalg::DefinitePair(system.K, A).smallest(2 * wanted))
                out.push_back(mode_of(pair));
        } catch (const linalg::SolverError &) {
            out.clear(); // free rigid motions: by the general route
        }
    }
    linalg::QuadraticOptions options;
    options.shift = 0.3 * support_scale(d);
    options.fewest = 1;
    for (int ask = 2 * wanted + 4; out.empty(); ask *= 2) {
        options.wanted = std::min(ask, system.K.size());
        const linalg::QuadraticResult found =
            linalg::solve_quadratic(system.Kss, system.Ks, system.K, options);
        for (const linalg::ComplexPair &pair : found.pairs) {
            WhirlMode mode;
            mode.eigenvalue = {0 - pair.value.imag(), pair.value.real()};
            mode.shape = pair.vector;
            mode.residual = pair.residual;
            mode.rounding = pair.rounding;
            const double size = std::abs(pair.value);
            const bool peaks = pair.value.real() > pair.value.imag();
            if (peaks && size > 1e-3 * options.shift && !present(out, mode))
                out.push_back(mode);
        }
        const bool resolved = static_cast<int>(found.pairs.size()) >= options.wanted;
        if (static_cast<int>(out.size()) < wanted && options.wanted < system.K.size() && resolved &&
            !std::isinf(found.complete_radius))
            out.clear();
        else
            break;
    }
    name_forward(out);
    return out;
}

} // namespace

std::vector<WhirlMode> synchronous_modes(const Discretization &rotor, Form form,
                                         double bearing_speed, int wanted) {
    std::vector<WhirlMode> modes =
        form == Form::planar       ? planar_modes(rotor, bearing_speed, wanted)
        : form == Form::hyperbolic ? hyperbolic_modes(rotor, bearing_speed, wanted)
        : form == Form::rotating   ? rotating_modes(rotor, bearing_speed, wanted)
                                   : general_modes(rotor, bearing_speed, wanted);
    std::sort(modes.begin(), modes.end(), [](const WhirlMode &a, const WhirlMode &b) {
        return a.eigenvalue.imag() < b.eigenvalue.imag();
    });
    return modes;
}

} // namespace whirl::analyses
