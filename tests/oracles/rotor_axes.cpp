#include "oracles/rotor_axes.h"

#include "oracles/dense_rotor.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace whirl::oracles {

namespace {

/// A += factor (d d^T) x block, d = (cos angle, sin angle): a quadratic form of what a 4 x 4 block
/// says of one direction.
void add_along(Eigen::MatrixXd &A, Eigen::Index first, const Eigen::MatrixXd &block, double factor,
               double angle) {
    const Eigen::Index y = A.rows() / 2;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (Eigen::Index i = 0; i < block.rows(); ++i)
        for (Eigen::Index j = 0; j < block.cols(); ++j) {
            const double value = factor * block(i, j);
            A(first + i, first + j) += c * c * value;
            A(first + i, y + first + j) += c * s * value;
            A(y + first + i, first + j) += s * c * value;
            A(y + first + i, y + first + j) += s * s * value;
        }
}

constexpr double quarter_turn = 1.5707963267948966;

/// Different along an angle and across it.
void add_axes(Eigen::MatrixXd &A, Eigen::Index first, const Eigen::MatrixXd &block, double along,
              double across, double angle) {
    add_along(A, first, block, along, angle);
    add_along(A, first, block, across, angle + quarter_turn);
}

const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);

} // namespace

RotorAxes::RotorAxes(const CaseRotor &rotor, int parts) {
    CaseRotor round = rotor; // nodes, and the lengths between them
    for (const InertialAnisotropy &item : rotor.anisotropies)
        round.imbalances.push_back({item.z, 0, 0});
    _z = dense_rotor(round, parts).z;
    const Eigen::Index n = 2 * nodes();
    for (Eigen::MatrixXd *A : {&_springs, &_inertia, &_drag})
        *A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    double start = 0;
    std::size_t node = 0;
    for (const Segment &segment : rotor.shaft) {
        if (segment.outer_end != segment.left.outer || segment.inner_end != segment.left.inner)
            throw std::runtime_error("no cones");
        const double end = start + segment.left.length;
        for (; node + 1 < _z.size() && _z[node] < end - 1e-9 * rotor.length(); ++node) {
            Cylinder piece = segment.left;
            piece.length = _z[node + 1] - _z[node];
            const BeamMatrices beam = beam_matrices(piece, rotor.axial_force);
            const auto first = static_cast<Eigen::Index>(2 * node);
            const double e = segment.asymmetry;
            const double angle = segment.asymmetry_angle;
            add_axes(_springs, first, beam.stiffness - beam.bending, 1, 1, 0);
            add_axes(_springs, first, beam.bending, 1 + e, 1 - e, angle);
            // Rotary inertia: gyroscopic = polar inertia = twice the diametral one I. The section's
            // mass is farther out along the stiff axis: its inertia about that axis is I (1 - e).
            add_axes(_inertia, first, beam.mass - beam.gyroscopic / 2, 1, 1, 0);
            add_axes(_inertia, first, beam.gyroscopic / 2, 1 - e - 2, 1 + e - 2, angle);
        }
        start = end;
    }
    for (const RigidDisc &disc : rotor.discs) {
        const Eigen::Index w = deflection(disc.z);
        add_axes(_inertia, w, one, disc.mass, disc.mass, 0);
        add_axes(_inertia, w + 1, one, disc.Id - disc.Ip, disc.Id - disc.Ip, 0);
    }
    for (const InertialAnisotropy &item : rotor.anisotropies)
        add_axes(_inertia, deflection(item.z) + 1, one, -item.dI, item.dI, item.angle);
    for (const Support &s : rotor.supports) {
        const Eigen::Index w = deflection(s.z);
        const auto invariant = [](const Block &b) {
            return b[0][0] == b[1][1] && b[0][1] == -b[1][0];
        };
        if (!invariant(s.k) || !invariant(s.c) || !invariant(s.kt) || !invariant(s.ct) ||
            s.pedestal)
            throw std::runtime_error("bearings the same from every direction only");
        for (const auto &[at, k, c] : {std::tuple(w, s.k, s.c), std::tuple(w + 1, s.kt, s.ct)}) {
            add_axes(_springs, at, one, k[0][0], k[0][0], 0);
            _springs(at, n + at) += k[0][1];
            _springs(n + at, at) += k[1][0];
            // What stands still in the rotor moves at speed x (-y, x).
            _drag(at, n + at) -= c[0][0];
            _drag(n + at, at) += c[0][0];
            _drag(at, at) += c[0][1];
            _drag(n + at, n + at) -= c[1][0];
            _conservative = _conservative && c[0][0] == 0 && c[0][1] == 0 && k[0][1] == 0;
        }
    }
}

Eigen::Index RotorAxes::deflection(double place) const {
    for (std::size_t i = 0; i < _z.size(); ++i)
        if (std::abs(_z[i] - place) < 1e-9 * _z.back())
            return static_cast<Eigen::Index>(2 * i);
    throw std::runtime_error("no node there");
}

Eigen::MatrixXd RotorAxes::loads(const std::vector<double> &places) const {
    const Eigen::Index n = 2 * nodes();
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(2 * n, 2 * static_cast<Eigen::Index>(places.size()));
    for (Eigen::Index j = 0; j < P.cols() / 2; ++j) {
        const Eigen::Index w = deflection(places[static_cast<std::size_t>(j)]);
        P(w, 2 * j) = P(n + w, 2 * j + 1) = 1;
    }
    return P;
}

Eigen::MatrixXd RotorAxes::form(double speed, const std::vector<double> &places) const {
    const Eigen::MatrixXd P = loads(places);
    const Eigen::MatrixXd Z = _springs + speed * _drag - speed * speed * _inertia;
    const Eigen::MatrixXd motion = Z.partialPivLu().inverse() * P;
    const Eigen::MatrixXd R = speed * speed * (P.transpose() * motion);
    return (R + R.transpose()) / 2;
}

double RotorAxes::largest(double speed, const std::vector<double> &places) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(form(speed, places));
    return solver.eigenvalues()(solver.eigenvalues().size() - 1);
}

std::vector<double> RotorAxes::critical_speeds(double from, double to,
                                               const std::vector<double> &held) const {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < _springs.rows(); ++i)
        free.push_back(i);
    for (const double place : held) {
        const Eigen::Index w = deflection(place);
        std::erase_if(free, [&](Eigen::Index i) { return i == w || i == 2 * nodes() + w; });
    }
    const Eigen::MatrixXd K = _springs(free, free);
    const Eigen::MatrixXd A = _inertia(free, free);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pairs(A, K);
    std::vector<double> out;
    for (const double mu : pairs.eigenvalues())
        if (mu > 0 && 1 / std::sqrt(mu) > from && 1 / std::sqrt(mu) < to)
            out.push_back(1 / std::sqrt(mu));
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<double> RotorAxes::sign_changes(double from, double to,
                                            const std::vector<double> &places) const {
    if (_conservative) {
        std::vector<double> out = critical_speeds(from, to);
        for (const double zero : critical_speeds(from, to, places))
            out.push_back(zero);
        std::sort(out.begin(), out.end());
        return out;
    }
    // Zeros of det P^T (Z^-1 + Z^-T) P: Z u = P s, Z^T v = P s, P^T (u + v) = 0, quadratic in the
    // speed. All speeds from B0 y + speed B1 y + speed^2 B2 y = 0 as 1/speed of a standard problem.
    // Unknowns in units by which each spring is 1.
    Eigen::MatrixXd units = Eigen::MatrixXd::Zero(_springs.rows(), _springs.cols());
    for (Eigen::Index i = 0; i < units.rows(); ++i)
        units(i, i) = 1 / std::sqrt(_springs(i, i));
    const Eigen::MatrixXd P = units * loads(places) * units.rows() / units.trace();
    const Eigen::Index N = P.rows();
    const Eigen::Index m = 2 * N + P.cols();
    std::vector<Eigen::MatrixXd> B(3, Eigen::MatrixXd::Zero(m, m));
    const std::vector<Eigen::MatrixXd> Z{_springs, to * _drag, -to * to * _inertia};
    for (std::size_t power = 0; power < 3; ++power) {
        const Eigen::MatrixXd scaled = units * Z[power] * units;
        B[power].block(0, 0, N, N) = scaled;
        B[power].block(N, N, N, N) = scaled.transpose();
    }
    B[0].block(0, 2 * N, N, P.cols()) = -P;
    B[0].block(N, 2 * N, N, P.cols()) = -P;
    B[0].block(2 * N, 0, P.cols(), N) = P.transpose();
    B[0].block(2 * N, N, P.cols(), N) = P.transpose();
    const Eigen::MatrixXd inverse = B[0].partialPivLu().inverse();
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * m, 2 * m);
    Eigen::EigenSolver<Eigen::MatrixXd> solver;
    double unit = 1;                                       // of the speed, over `to`
    for (int tries = 0; tries < 4; ++tries, unit *= 0.7) { // the QR method may not converge
        companion.topLeftCorner(m, m) = -unit * (inverse * B[1]);
        companion.topRightCorner(m, m) = -unit * unit * (inverse * B[2]);
        companion.bottomLeftCorner(m, m).setIdentity();
        solver.compute(companion, false);
        if (solver.info() == Eigen::Success)
            break;
    }
    if (solver.info() != Eigen::Success)
        throw std::runtime_error("no convergence");
    std::vector<double> out;
    const Eigen::VectorXcd all = solver.eigenvalues();
    for (const std::complex<double> &mu : all) {
        const std::complex<double> speed = mu == 0.0 ? 0 : unit * to / mu;
        // A pair that rounding parted by the root of it; a false one changes nothing.
        if (std::abs(speed.imag()) < 1e-5 * std::abs(speed) && speed.real() > from &&
            speed.real() < to)
            out.push_back(speed.real());
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<Band> RotorAxes::bands(double from, double to,
                                   const std::vector<double> &places) const {
    std::vector<double> looks{from};
    std::vector<double> edges{from};
    for (const double speed : sign_changes(from, to, places))
        if (speed > edges.back() * (1 + 1e-9))
            edges.push_back(speed);
    edges.push_back(to);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        looks.push_back((edges[i] + edges[i + 1]) / 2);
    looks.push_back(to);
    const auto inside = [&](Real speed) { return largest(static_cast<double>(speed), places) < 0; };
    std::vector<Band> out;
    bool was = false;
    for (std::size_t i = 1; i < looks.size(); ++i) {
        const bool is = i + 1 < looks.size() ? inside(looks[i]) : was;
        if (is == was)
            continue;
        double a = looks[i - 1];
        double b = looks[i];
        for (int step = 0; step < 60 && i > 1; ++step) {
            const double middle = (a + b) / 2;
            (inside(middle) == was ? a : b) = middle;
        }
        const double end = i > 1 ? (a + b) / 2 : from;
        if (is)
            out.emplace_back(end, to);
        else
            out.back().second = end;
        was = is;
    }
    return out;
}

} // namespace whirl::oracles
