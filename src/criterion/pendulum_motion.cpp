#include "criterion/pendulum_motion.h"

#include "assembly/planar_part.h"
#include "assembly/system.h"
#include "closed_form/pendulum_balancer.h"
#include "criterion/rotor.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/least_squares.h"
#include "linalg/dense/products.h"
#include "modes/support_damping.h"
#include "reduction/orthonormal.h"
#include "results/formulation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>

namespace whirl::criterion {

namespace {

using Complex = std::complex<double>;

/// At phi = psi = 0 the four masses are a ring as far as the tilt of the shaft is concerned.
model::Rotor with_rings(model::Rotor rotor,
                        const std::vector<balancers::PlacedPendulums> &pendulums) {
    for (const balancers::PlacedPendulums &pendulum : pendulums) {
        const double radius = pendulum.pivot + pendulum.arm;
        model::Disc ring;
        ring.z = pendulum.z;
        ring.mass = 4 * pendulum.mass;
        ring.Id = 2 * pendulum.mass * radius * radius;
        ring.Ip = 2 * ring.Id;
        rotor.discs.push_back(ring);
    }
    return rotor;
}

/// Places of the balancers, then of the imbalances. The mesh has nodes at all of them.
std::vector<assembly::Combination>
places_of(const assembly::Discretization &d,
          const std::vector<balancers::PlacedPendulums> &pendulums,
          const std::vector<model::Imbalance> &drive) {
    std::vector<assembly::Combination> places = deflections_at(d, pendulums);
    std::ranges::move(deflections_at(d, drive), std::back_inserter(places));
    return places;
}

model::Rotor with_imbalances(model::Rotor rotor, const std::vector<model::Imbalance> &drive) {
    rotor.imbalances = drive; // nodes where they act
    return rotor;
}

} // namespace

PendulumShaft::PendulumShaft(model::Rotor rotor, int order,
                             std::vector<balancers::PlacedPendulums> pendulums,
                             std::vector<model::Imbalance> drive)
    : _pendulums(std::move(pendulums)), _drive(std::move(drive)),
      _d(with_imbalances(with_rings(std::move(rotor), _pendulums), _drive), order),
      _receptance(_d, results::Form::planar, places_of(_d, _pendulums, _drive)) {}

void PendulumShaft::solve_at(double speed) {
    const auto count = static_cast<Eigen::Index>(_pendulums.size());
    Eigen::MatrixXcd R;
    try {
        R = _receptance.at(speed);
    } catch (const linalg::SolverError &) { // at a resonance: beside it
        R = _receptance.at(speed * (1 + 1e-11));
    }
    _R = R.topLeftCorner(count, count);
    _held = Eigen::VectorXcd::Zero(count);
    for (std::size_t k = 0; k < _drive.size(); ++k)
        _held += R.col(count + static_cast<Eigen::Index>(k)).head(count) * _drive[k].mr *
                 std::polar(1.0, _drive[k].phase);
}

Eigen::VectorXcd PendulumShaft::held(double speed) {
    solve_at(speed);
    return _held;
}

/// Solves u - held - R f(u) = 0 from u; false where Newton's method does not converge.
bool PendulumShaft::newton(Eigen::VectorXcd &u) const {
    const Eigen::Index n = u.size();
    for (int iteration = 0; iteration < 60; ++iteration) {
        Eigen::VectorXcd force(n);
        Eigen::VectorXd slope(2 * n);
        for (Eigen::Index j = 0; j < n; ++j) {
            const balancers::PlacedPendulums &p = _pendulums[static_cast<std::size_t>(j)];
            const double x = std::hypot(p.pivot, u(j).real());
            const double y = std::hypot(p.pivot, u(j).imag());
            const double size = 2 * p.mass * p.arm;
            force(j) = size * Complex(u(j).real() / x, u(j).imag() / y);
            slope(j) = size * p.pivot * p.pivot / (x * x * x);
            slope(n + j) = size * p.pivot * p.pivot / (y * y * y);
        }
        const Eigen::VectorXcd rest = u - _held - _R * force;
        Eigen::MatrixXd J(2 * n, 2 * n);
        J << _R.real(), -_R.imag(), _R.imag(), _R.real();
        J = Eigen::MatrixXd::Identity(2 * n, 2 * n) - J * slope.asDiagonal();
        Eigen::VectorXd g(2 * n);
        g << rest.real(), rest.imag();
        const Eigen::VectorXd step = linalg::least_squares(J, g);
        if (!step.allFinite())
            return false;
        u.real() -= step.head(n);
        u.imag() -= step.tail(n);
        if (step.norm() <= 1e-13 * u.norm() || u.isZero(0))
            return true;
    }
    return false;
}

/// One balancer: D u - 2 m l (...) = D held with D = 1/R is the planar problem at a speed ratio
/// whose 1 - R_w^2 and R_w H have the ratio of Re D and Im D.
std::vector<Eigen::VectorXcd> PendulumShaft::closed_form_starts() const {
    std::vector<Eigen::VectorXcd> starts;
    const balancers::PlacedPendulums &p = _pendulums.front();
    const Complex D = 1.0 / _R(0, 0);
    if (!std::isfinite(D.real()) || !std::isfinite(D.imag()))
        return starts;
    const double scale = 2 * std::abs(D.real()) + 2 * p.mass; // keeps 1 - R_w^2 within +-1/2
    const double ratio = std::sqrt(1 - D.real() / scale);
    closed_form::PendulumRotor planar;
    planar.mass_ratio = 2 * p.mass / (scale * ratio * ratio);
    planar.pivot_ratio = p.pivot / p.arm;
    planar.external_damping = D.imag() / (ratio * scale);
    planar.imbalance = D * _held(0) / (2 * p.mass * p.arm);
    for (const closed_form::PendulumMotion &motion : closed_form::steady_motions(planar, ratio))
        starts.emplace_back(Eigen::VectorXcd::Constant(1, p.arm * motion.position));
    return starts;
}

PendulumSteadyMotion PendulumShaft::motion_of(const Eigen::VectorXcd &u) const {
    PendulumSteadyMotion motion{u, Eigen::VectorXd(u.size()), Eigen::VectorXd(u.size())};
    for (Eigen::Index j = 0; j < u.size(); ++j) {
        const double a = _pendulums[static_cast<std::size_t>(j)].pivot;
        motion.phi(j) = std::atan(u(j).imag() / a);
        motion.psi(j) = -std::atan(u(j).real() / a);
    }
    return motion;
}

std::vector<PendulumSteadyMotion>
PendulumShaft::motions(double speed, const std::vector<PendulumSteadyMotion> &given) {
    solve_at(speed);
    const Eigen::Index n = _held.size();
    Eigen::VectorXd small(n); // force over deflection of small angles
    for (Eigen::Index j = 0; j < n; ++j) {
        const balancers::PlacedPendulums &p = _pendulums[static_cast<std::size_t>(j)];
        small(j) = 2 * p.mass * p.arm / p.pivot;
    }
    const Eigen::MatrixXcd linear =
        Eigen::MatrixXcd::Identity(n, n) - _R * small.cast<Complex>().asDiagonal();
    std::vector<Eigen::VectorXcd> starts{_held, linalg::least_squares(linear, _held).col(0)};
    if (n == 1)
        for (Eigen::VectorXcd &start : closed_form_starts())
            starts.push_back(std::move(start));
    for (const PendulumSteadyMotion &motion : given)
        starts.push_back(motion.deflection);
    std::vector<Eigen::VectorXcd> found;
    for (Eigen::VectorXcd &u : starts) {
        if (!u.allFinite() || !newton(u))
            continue;
        const bool known = std::ranges::any_of(
            found, [&u](const auto &other) { return (u - other).norm() <= 1e-8 * u.norm(); });
        if (!known)
            found.push_back(u);
    }
    std::ranges::sort(found, {}, [](const auto &u) { return u.norm(); });
    std::vector<PendulumSteadyMotion> out;
    for (const Eigen::VectorXcd &u : found)
        out.push_back(motion_of(u));
    return out;
}

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Modes at rest of least frequency and static deflections under unit forces, orthonormal with M.
Eigen::MatrixXd basis_of(const assembly::PlanarSystem &system, const Eigen::MatrixXd &forces,
                         int modes) {
    // Of a shape's length: what is left is rounding of the shapes before.
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
