#include "support/periodic_system.h"

#include "assembly/system.h"
#include "closed_form/floquet.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::tests {

namespace {

using assembly::Combination;
using Complex = std::complex<double>;
constexpr Complex i_unit(0, 1);
constexpr double pi = std::numbers::pi;

struct Directions {
    Eigen::Vector2d out, along;
};
Directions directions(double angle) {
    return {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
}

/// The matrix of u -> a u + b conj(u) on (x, y).
Eigen::Matrix2d planar(Complex a, Complex b) {
    Eigen::Matrix2d out;
    out << a.real() + b.real(), b.imag() - a.imag(), a.imag() + b.imag(), a.real() - b.real();
    return out;
}

void add(Eigen::MatrixXd &into, const Combination &rows, const Combination &columns,
         const Eigen::Matrix2d &block) {
    for (const auto &[i, a] : rows)
        for (const auto &[j, b] : columns)
            into.block<2, 2>(2 * i, 2 * j) += a * b * block;
}

Eigen::MatrixXd grown(const linalg::Matrix &matrix, int size) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
    out.topLeftCorner(matrix.size(), matrix.size()) = Eigen::MatrixXd(matrix.view());
    return out;
}

} // namespace

PeriodicSystem::PeriodicSystem(const assembly::Discretization &discretization, double speed,
                               const std::vector<std::vector<double>> &ball_angles)
    : _d(discretization), _speed(speed) {
    const model::Rotor &rotor = _d.rotor();
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
        add_points(rotor.balancers[i], ball_angles[i]);
    // Two equal masses on a diameter, without the ring that has the same mean inertia: the case
    // gives the disc's inertias with the anisotropy in their mean.
    for (const model::Anisotropy &a : rotor.anisotropies)
        for (const double side : {0.0, pi}) {
            _points.push_back({a.z, 0, a.dI / 2, a.angle + side});
            _points.push_back({a.z, 0, -a.dI / 2, a.angle + side + pi / 2});
        }
    const assembly::FixedSystem fixed = assembly::assemble_fixed(_d, speed);
    const int n = size();
    _axisymmetric = {grown(fixed.M, n), grown(fixed.C, n) + speed * grown(fixed.G, n),
                     grown(fixed.K, n) + speed * grown(fixed.Kc, n)};
}

void PeriodicSystem::add_points(const model::Balancer &b, const std::vector<double> &angles) {
    if (b.imbalance_radius) {
        const double mass = b.imbalance / *b.imbalance_radius;
        _points.push_back({b.z, mass, mass * *b.imbalance_radius * *b.imbalance_radius, 0});
    }
    if (const auto *balls = std::get_if<model::Balls>(&b.parts)) {
        const model::BallRow &row = balls->rows.at(0);
        for (const double angle : angles) {
            _points.push_back({b.z, row.mass, row.mass * row.radius * row.radius, angle});
            _moving.push_back({b.z, row.mass, angle, row.damping, 0});
        }
        return;
    }
    // Hinged arms: m l^2 f'' + H f' + m a l W^2 f + m l (acceleration of the plane along the
    // circle) = 0; opposite ones are tied to swing to the same side, so a pair is one mass.
    const auto &p = std::get<model::Pendulums>(b.parts);
    const double reach = p.pivot + p.arm;
    for (int k = 0; k < 4; ++k)
        _points.push_back({b.z, p.mass, p.mass * reach * reach, k * pi / 2});
    for (int pair = 0; pair < 2; ++pair)
        _moving.push_back({b.z, 2 * p.mass, pair * pi / 2, 2 * p.damping / (p.arm * p.arm),
                           2 * p.mass * p.pivot / p.arm});
}

int PeriodicSystem::paired() const { return 2 * _d.planar_size(); }
int PeriodicSystem::size() const { return paired() + static_cast<int>(_moving.size()); }
double PeriodicSystem::period() const { return 2 * pi / _speed; }

void PeriodicSystem::add_tilt(Instant &out, const PointMass &point, double time) const {
    const Directions at = directions(_speed * time + point.angle);
    const Combination phi = _d.slope_at(point.z);
    const Combination w = _d.deflection_at(point.z);
    add(out.M, phi, phi, point.inertia * at.out * at.out.transpose());
    add(out.D, phi, phi, 2 * _speed * point.inertia * at.out * at.along.transpose());
    add(out.M, w, w, point.mass * Eigen::Matrix2d::Identity());
}

void PeriodicSystem::add_moving(Instant &out, const MovingMass &mass, int index,
                                double time) const {
    // Displacement d along e' = i e: force on the plane m (e' d)'' = m [e' d'' - 2 W e d' - W^2 e'
    // d]; of the mass itself m d'' + m e' . w''.
    const Directions at = directions(_speed * time + mass.angle);
    const int own = paired() + index;
    for (const auto &[i, v] : _d.deflection_at(mass.z)) {
        out.M.block<2, 1>(2 * i, own) += v * mass.mass * at.along;
        out.D.block<2, 1>(2 * i, own) -= 2 * _speed * v * mass.mass * at.out;
        out.K.block<2, 1>(2 * i, own) -= _speed * _speed * v * mass.mass * at.along;
        out.M.block<1, 2>(own, 2 * i) += v * mass.mass * at.along.transpose();
    }
    out.M(own, own) += mass.mass;
    out.D(own, own) += mass.damping;
    out.K(own, own) += _speed * _speed * mass.restoring;
}

void PeriodicSystem::add_shaft(Instant &out, double time) const {
    const model::Shaft &shaft = _d.rotor().shaft;
    for (int span = 0; span < static_cast<int>(_d.shaft_mesh().spans.size()); ++span) {
        const auto &segment = shaft.segments[static_cast<std::size_t>(
            _d.shaft_mesh().spans[static_cast<std::size_t>(span)].segment)];
        if (segment.asymmetry == 0)
            continue;
        // A slope u or curvature u along the direction g = W t + angle meets I (1 + s), across it
        // I (1 - s): the moment I u + s I exp(2 i g) conj(u).
        const Complex turned =
            segment.asymmetry * std::polar(1.0, 2 * (_speed * time + segment.asymmetry_angle));
        const std::vector<int> u = _d.beam_unknowns(span);
        const elements::PlanarMatrices &beam = _d.beam(span);
        for (std::size_t r = 0; r < u.size(); ++r)
            for (std::size_t c = 0; c < u.size(); ++c) {
                const auto i = static_cast<Eigen::Index>(r);
                const auto j = static_cast<Eigen::Index>(c);
                // Rotary inertia of the section is half its polar one; as for point masses the
                // turning part of it brings exp(2 i g) (conj phi'' + 2 i W conj phi').
                const double inertia = beam.G(i, j) / 2;
                const double bending = beam.K_bending(i, j);
                const double damping = shaft.internal_damping * bending;
                const Combination row{{u[r], 1.0}};
                const Combination column{{u[c], 1.0}};
                add(out.M, row, column, planar(0, turned * inertia));
                add(out.D, row, column,
                    planar(0, turned * (2.0 * i_unit * _speed * inertia + damping)));
                // Strain rate as seen in the rotor: u' - i W u.
                add(out.K, row, column, planar(0, turned * (bending + i_unit * _speed * damping)));
            }
    }
}

Instant PeriodicSystem::at(double time) const {
    Instant out = _axisymmetric;
    for (const PointMass &point : _points)
        add_tilt(out, point, time);
    for (std::size_t i = 0; i < _moving.size(); ++i)
        add_moving(out, _moving[i], static_cast<int>(i), time);
    add_shaft(out, time);
    return out;
}

std::vector<Complex> PeriodicSystem::multipliers(int steps) const {
    const Eigen::Index n = size();
    return closed_form::floquet_multipliers(
        [&](double time) {
            const Instant now = at(time);
            const Eigen::PartialPivLU<Eigen::MatrixXd> mass(now.M);
            Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
            state.topRightCorner(n, n).setIdentity();
            state.bottomLeftCorner(n, n) = -mass.solve(now.K);
            state.bottomRightCorner(n, n) = -mass.solve(now.D);
            return state;
        },
        period(), steps);
}

double PeriodicSystem::growth(int steps) const {
    double largest = 0;
    for (const Complex value : multipliers(steps))
        largest = std::max(largest, std::abs(value));
    return std::log(largest) / period();
}

std::vector<Complex> exponentials(const std::vector<Complex> &eigenvalues, double period) {
    std::vector<Complex> out;
    for (const Complex value : eigenvalues)
        out.push_back(std::exp(value * period));
    return out;
}

double largest_distance(const std::vector<Complex> &first, const std::vector<Complex> &second) {
    double largest = 0;
    for (const Complex value : first) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Complex other : second)
            nearest = std::min(nearest, std::abs(value - other));
        largest = std::max(largest, nearest);
    }
    return largest;
}

} // namespace whirl::tests
