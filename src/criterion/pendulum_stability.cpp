#include "assembly/planar_part.h"
#include "assembly/system.h"
#include "criterion/pendulum_motion.h"
#include "criterion/rotor.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "modes/support_damping.h"
#include "reduction/orthonormal.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace whirl::criterion {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Modes at rest of least frequency and static deflections under unit forces, orthonormal with M.
Eigen::MatrixXd basis_of(const assembly::PlanarSystem &system, const Eigen::MatrixXd &forces,
                         int modes) {
    constexpr double newness = 1e-6;
    const Sparse M = system.M.view();
    Eigen::MatrixXd V(M.rows(), 0);
    const linalg::DefinitePair pair(system.K, system.M);
    for (const linalg::RealPair &mode : pair.smallest(std::min(modes, static_cast<int>(M.rows()))))
        reduction::take_in(V, M, mode.vector, newness);
    const Eigen::SimplicialLDLT<Sparse> factors(Sparse(system.K.view()));
    reduction::take_in(V, M, factors.solve(forces), newness);
    return V;
}

/// P + i Q on (x; y).
Eigen::MatrixXd real_form(const Eigen::MatrixXd &P, const Eigen::MatrixXd &Q) {
    Eigen::MatrixXd out(2 * P.rows(), 2 * P.cols());
    out << P, -Q, Q, P;
    return out;
}

} // namespace

PendulumStability::PendulumStability(const PendulumShaft &shaft, double bearing_speed, int modes)
    : _pendulums(shaft.pendulums()) {
    const assembly::Discretization &d = shaft.rotor();
    const auto count = static_cast<Eigen::Index>(_pendulums.size());
    std::vector<assembly::Combination> forced = deflections_at(d, _pendulums);
    std::ranges::move(deflections_at(d, d.rotor().bearings), std::back_inserter(forced)); // dampers
    const Eigen::MatrixXd forces = assembly::unit_loads(forced, d.planar_size());
    const assembly::PlanarSystem system = assembly::assemble_planar(d, bearing_speed);
    const Eigen::MatrixXd V = basis_of(system, forces, modes);
    const auto kept = [&V](const Sparse &A) -> Eigen::MatrixXd {
        const Eigen::MatrixXd of_basis = A * V;
        return V.transpose() * of_basis;
    };
    _M = kept(system.M.view());
    _G = kept(system.G.view());
    _K = kept(system.K.view());
    const auto damping = linalg::Matrix::from_entries(
        d.planar_size(), modes::planar_support_damping(d, bearing_speed));
    _Ce = kept(damping.view());
    _Ci = kept(assembly::planar_part(d, assembly::Term::damping));
    const Eigen::MatrixXd places = forces.leftCols(count);
    _places = places.transpose() * V;
    _stiffest = std::sqrt(_K.diagonal().maxCoeff());
}

/// With D = d/dt + i W the derivative in the rotating frame, e the deflection at a balancer:
/// M D^2 w - i W G D w + C_e D w + C_i w' + K w + sum 2 m l e D^2 (i cos(phi) p - cos(psi) q) = 0,
/// 2 m l^2 p'' + 2 H_1 p' + (2 m a l W^2 / cos(phi)) p + 2 m l cos(phi) Im D^2 (e w) = 0, q
/// likewise with -Re. Pendulum unknowns are scaled to a unit mass matrix.
double PendulumStability::growth(double speed, const PendulumSteadyMotion &motion) const {
    const double W = speed;
    const Eigen::Index k = _M.rows();
    const auto n = static_cast<Eigen::Index>(_pendulums.size());
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(k, k);
    const Eigen::Index size = 2 * k + 2 * n;
    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(size, size);
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
    M.topLeftCorner(2 * k, 2 * k) = real_form(_M, none);
    C.topLeftCorner(2 * k, 2 * k) = real_form(_Ce + _Ci, 2 * W * _M - W * _G);
    K.topLeftCorner(2 * k, 2 * k) = real_form(_K - W * W * (_M - _G), W * _Ce);
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(2 * k, 2 * n); // shaft forces of the pendulums
    for (Eigen::Index j = 0; j < n; ++j) {
        const balancers::PlacedPendulums &p = _pendulums[static_cast<std::size_t>(j)];
        const double cos_phi = std::cos(motion.phi(j));
        const double cos_psi = std::cos(motion.psi(j));
        const double force = std::sqrt(2 * p.mass);
        S.col(2 * j).tail(k) = force * cos_phi * _places.row(j).transpose();
        S.col(2 * j + 1).head(k) = -force * cos_psi * _places.row(j).transpose();
        const Eigen::Index at = 2 * k + 2 * j;
        C(at, at) = C(at + 1, at + 1) = p.damping / (p.mass * p.arm * p.arm);
        K(at, at) = W * W * p.pivot / (p.arm * cos_phi);
        K(at + 1, at + 1) = W * W * p.pivot / (p.arm * cos_psi);
    }
    Eigen::MatrixXd turned(2 * k, 2 * n); // i S
    turned << -S.bottomRows(k), S.topRows(k);
    M.topRightCorner(2 * k, 2 * n) = S;
    M.bottomLeftCorner(2 * n, 2 * k) = S.transpose();
    C.topRightCorner(2 * k, 2 * n) = 2 * W * turned;
    C.bottomLeftCorner(2 * n, 2 * k) = -2 * W * turned.transpose();
    K.topRightCorner(2 * k, 2 * n) = -W * W * S;
    K.bottomLeftCorner(2 * n, 2 * k) = -W * W * S.transpose();
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(M);
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * size, 2 * size); // time in 1/W
    state.topRightCorner(size, size).setIdentity();
    state.bottomLeftCorner(size, size) = -linalg::solved(lu, K) / (W * W);
    state.bottomRightCorner(size, size) = -linalg::solved(lu, C) / W;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(state, false);
    if (solver.info() == Eigen::Success)
        return W * solver.eigenvalues().real().maxCoeff();
    // Motions that creep against strong dampers beside fast ones.
    return W * linalg::general_eigen(state, linalg::Vectors::right).values.real().maxCoeff();
}

double PendulumStability::rounding(double speed) const {
    // Undamped roots lie on the imaginary axis within rounding; double ones within its root.
    return 1e-6 * speed + 1e-8 * _stiffest;
}

} // namespace whirl::criterion
