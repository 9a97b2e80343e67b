#include "simulation/motion.h"

#include "linalg/dense/products.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::simulation {

namespace {

using Eigen::Index;
using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using ConstPair = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2>>;
using Pair = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2>>;
using Planar = Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic>>;
using ConstPlanar = Eigen::Map<const Eigen::Matrix<double, 2, Eigen::Dynamic>>;

/// Im(a^H b) of two complex vectors.
double turning(const ConstPair &a, const ConstPair &b) {
    return a.col(0).dot(b.col(1)) - a.col(1).dot(b.col(0));
}

/// y of (1 + B Q) y = b in the place of b: B couples the planes by the shapes of the rotor, Q is of
/// the masses in each plane.
/// @tparam size  four unknowns a plane: known to the compiler, much faster
/// @param products  2P x 2P: B is this, alike in both directions
/// @param coupling  Q
template <int size>
void solve_planes(const Eigen::MatrixXd &products, const PlaneBlocks &coupling, Eigen::MatrixXd &y,
                  int columns) {
    const Index entries = products.rows();
    using Square = Eigen::Matrix<double, size, size>;
    Square A = Square::Identity(2 * entries, 2 * entries);
    for (Index i = 0; i < entries; ++i)
        for (Index k = 0; k < entries; ++k) {
            const Index block = 4 * (k / 2);
            A.template block<2, 4>(2 * i, block) +=
                products(i, k) * coupling.block<2, 4>(2 * (k % 2), block);
        }
    const Eigen::PartialPivLU<Square> lu(A);
    for (int column = 0; column < columns; ++column)
        y.col(column) = lu.solve(y.col(column).eval());
}

/// A matrix over the gyroscopic one in both directions: both on the real form of r unknowns.
Eigen::MatrixXd above_turned(const Eigen::MatrixXd &matrix, const Eigen::MatrixXd &gyroscopic) {
    const Index r = gyroscopic.rows();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(4 * r, 2 * r);
    out.topRows(2 * r) = matrix;
    out.block(2 * r, 0, r, r) = gyroscopic;
    out.block(3 * r, r, r, r) = gyroscopic;
    return out;
}

} // namespace

RotorMotion::RotorMotion(MovingParts parts) : _parts(std::move(parts)) {
    const reduction::ReducedRotor &rotor = _parts.rotor;
    const Index r = rotor.size();
    const auto planes = static_cast<Index>(_parts.planes.size());
    _rows.resize(r, 2 * planes);
    for (Index i = 0; i < planes; ++i) {
        _rows.col(2 * i) = _parts.planes[static_cast<std::size_t>(i)].w;
        _rows.col(2 * i + 1) = _parts.planes[static_cast<std::size_t>(i)].phi;
    }
    _products = _rows.transpose() * _rows;
    _tables = rotor.supports.size() > 1;
    _internal = !rotor.internal.isZero(0);
    for (const reduction::ReducedRotor::Supports &at : rotor.supports) {
        const double size = at.stiffness.cwiseAbs().maxCoeff();
        const Eigen::MatrixXd skew = at.stiffness - at.stiffness.transpose();
        _circulating = _circulating || skew.cwiseAbs().maxCoeff() > 1e-13 * size;
    }
    _stiffness = rotor.supports.front().stiffness;
    _stiffness.topLeftCorner(r, r) += rotor.elastic;
    _stiffness.bottomRightCorner(r, r) += rotor.elastic;
    _of_place = above_turned(_stiffness, rotor.gyroscopic);
    _of_velocity = above_turned(rotor.supports.front().damping, rotor.gyroscopic);
    if (rotor.mass_deviation.size() > 0) // no planes (motion_scene)
        _inverse_mass = (Eigen::MatrixXd::Identity(2 * r, 2 * r) + rotor.mass_deviation).inverse();
    _motions.resize(_parts.planes.size());
    _free_equations.resize(static_cast<std::size_t>(_parts.free_angles()));
    for (Eigen::ArrayXd *each : {&_turned, &_cosines, &_sines})
        each->resize(_parts.free_angles());
    _fixed_equations.resize(_parts.fixed.size());
    _forces.setZero(2 * r, 2);
    _planes.setZero(4 * planes, 2);
    _loads.resize(4 * planes, 2);
    _coupling.resize(4, 4 * planes);
    _by_place.resize(4 * r);
    _by_velocity.resize(4 * r);
    _push.resize(2 * r);
    _slip.resize(r, 2);
    _inner.setZero(r, 2);
    _external.setZero(2 * r);
    for (const FreeParts &free : _parts.free) {
        const auto size = static_cast<std::size_t>(free.motion->size());
        _plane_of.insert(_plane_of.end(), size, free.plane);
        _free_from.insert(_free_from.end(), size, free.from);
    }
    set_dry({});
}

std::vector<double> RotorMotion::jumps() const {
    std::vector<double> times = _parts.excitation.jumps();
    if (!_parts.motor)
        for (const double jump : _parts.spin.jumps())
            times.push_back(jump);
    for (const FixedMass &mass : _parts.fixed)
        if (mass.from > 0)
            times.push_back(mass.from);
    for (const FreeParts &free : _parts.free)
        if (free.from > 0)
            times.push_back(free.from);
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

int RotorMotion::coordinates() const { return first_angle() + _parts.free_angles(); }

int RotorMotion::size() const { return 2 * coordinates() + (_parts.motor ? 2 : 0) + 3; }

Spin::At RotorMotion::spin(double t, const double *state) const {
    if (!_parts.motor)
        return _parts.spin.at(t, _piece);
    const double *own = state + 2 * coordinates();
    return {own[0], own[1], 0};
}

balancers::PlaneVector RotorMotion::at_plane(int plane, const double *p) const {
    const Index r = _rows.rows();
    const double *w = _rows.col(2 * plane).data();
    const double *phi = _rows.col(2 * plane + 1).data();
    balancers::PlaneVector out = balancers::PlaneVector::Zero();
    for (Index i = 0; i < r; ++i) {
        const Eigen::Vector2d at(p[i], p[r + i]);
        out.head<2>() += w[i] * at;
        out.tail<2>() += phi[i] * at;
    }
    return out;
}

balancers::PlaneMotion RotorMotion::motion_of(int plane, const double *state) const {
    return {at_plane(plane, state), at_plane(plane, state + coordinates())};
}

balancers::PlaneVector RotorMotion::fixed_motion(const FixedMass &mass, const double *p) const {
    if (mass.plane >= 0)
        return at_plane(mass.plane, p);
    const Eigen::Vector2d w = deflection(mass.row, p);
    return {w(0), w(1), 0, 0};
}

Eigen::Vector2d RotorMotion::deflection(const reduction::Row &row, const double *state) const {
    const ConstPair motion(state, _rows.rows(), 2);
    return {motion.col(0).dot(row), motion.col(1).dot(row)};
}

void RotorMotion::rotor_forces(const Spin::At &spin, const double *p, const double *v) const {
    const reduction::ReducedRotor &rotor = _parts.rotor;
    const Index r = rotor.size();
    Pair f(_forces.col(0).data(), r, 2);
    Pair per_spin(_forces.col(1).data(), r, 2);
    _by_place.noalias() = _of_place * ConstMap(p, 2 * r);
    _by_velocity.noalias() = _of_velocity * ConstMap(v, 2 * r);
    _push = _by_place.head(2 * r) + _by_velocity.head(2 * r);
    if (_tables) {
        const reduction::ReducedRotor::Supports at = rotor.supports_at(spin.speed);
        const reduction::ReducedRotor::Supports &first = rotor.supports.front();
        const Eigen::MatrixXd stiffness = at.stiffness - first.stiffness;
        const Eigen::MatrixXd damping = at.damping - first.damping;
        _push.noalias() += stiffness * ConstMap(p, 2 * r);
        _push.noalias() += damping * ConstMap(v, 2 * r);
    }
    f.col(0) = -_push.head(r) - spin.speed * _by_velocity.segment(3 * r, r);
    f.col(1) = spin.speed * _by_velocity.segment(2 * r, r) - _push.tail(r);
    per_spin.col(0) = -0.5 * _by_place.segment(3 * r, r);
    per_spin.col(1) = 0.5 * _by_place.segment(2 * r, r);
    if (_internal) {
        const ConstPair x(p, r, 2);
        const ConstPair u(v, r, 2);
        _slip.col(0) = u.col(0) + spin.speed * x.col(1);
        _slip.col(1) = u.col(1) - spin.speed * x.col(0);
        _inner.noalias() = rotor.internal * _slip;
        f -= _inner;
    }
}

void RotorMotion::outside_forces(double t) const {
    if (_parts.excitation.none())
        return;
    _external.setZero();
    _base = _parts.excitation.add_loads(t, _piece, _external);
    _forces.col(0) += _external;
}

void RotorMotion::mass_loads(const Spin::At &spin, const double *state) const {
    const int n = coordinates();
    _loads.setZero();
    _coupling.setZero();
    for (std::size_t i = 0; i < _motions.size(); ++i)
        _motions[i] = motion_of(static_cast<int>(i), state);
    const double *angles = state + first_angle();
    const auto free = std::ssize(_free_equations);
    _turned = Eigen::Map<const Eigen::ArrayXd>(angles, free) + spin.angle;
    _cosines = _turned.cos();
    _sines = _turned.sin();
    balancers::Directions towards{_cosines.data(), _sines.data()};
    balancers::MassEquation *equation = _free_equations.data();
    for (const FreeParts &parts : _parts.free) {
        const int size = parts.motion->size();
        parts.motion->equations(_motions[static_cast<std::size_t>(parts.plane)],
                                {spin.angle, spin.speed}, angles, angles + n, towards, equation);
        angles += size;
        towards.cosines += size;
        towards.sines += size;
        const Index at = 4 * parts.plane;
        for (const balancers::MassEquation *end = equation + size; equation != end; ++equation) {
            balancers::MassEquation &e = *equation;
            e.b += e.u.head<2>().dot(_base);
            const auto i = static_cast<std::size_t>(equation - _free_equations.data());
            add_sliding(i, e);
            if (is_held(i)) { // its angle has the acceleration of the spin
                _loads.col(0).segment<4>(at) += e.force;
                _loads.col(1).segment<4>(at) += e.per_spin - e.u;
                _coupling.block<2, 2>(2, at + 2) += e.tilt;
                continue;
            }
            const balancers::PlaneVector per_torque = e.u / e.a;
            _loads.col(0).segment<4>(at) += e.force + per_torque * e.b;
            _loads.col(1).segment<4>(at) += e.per_spin + per_torque * e.by_spin;
            _coupling.middleCols<4>(at).noalias() -= per_torque * _friction[i].row.transpose();
            _coupling.block<2, 2>(2, at + 2) += e.tilt;
        }
    }
    fixed_loads(spin);
}

void RotorMotion::fixed_loads(const Spin::At &spin) const {
    const Index r = _rows.rows();
    for (std::size_t i = 0; i < _parts.fixed.size(); ++i) {
        const FixedMass &mass = _parts.fixed[i];
        balancers::MassEquation &e = _fixed_equations[i];
        if (!is_there(mass)) {
            e = {};
            continue;
        }
        const auto plane = static_cast<std::size_t>(std::max(mass.plane, 0));
        const bool own = mass.plane < 0; // a mere eccentricity: where it is makes no difference
        e = mass.mass.equation(own ? balancers::PlaneMotion{} : _motions[plane],
                               spin.angle + mass.phase, spin.speed);
        e.b += e.u.head<2>().dot(_base);
        if (!own) {
            const Index at = 4 * mass.plane;
            _loads.col(0).segment<4>(at) += e.force;
            _loads.col(1).segment<4>(at) -= e.u;
            _coupling.block<2, 2>(2, at + 2) += e.tilt;
            continue;
        }
        for (Index axis = 0; axis < 2; ++axis) {
            _forces.col(0).segment(axis * r, r) += e.force(axis) * mass.row;
            _forces.col(1).segment(axis * r, r) -= e.u(axis) * mass.row;
        }
    }
}

/// rows^T f + B P of a column, into _planes.
void RotorMotion::gather(Index column) const {
    const Index entries = _rows.cols();
    const ConstPair f(_forces.col(column).data(), _rows.rows(), 2);
    Planar y(_planes.col(column).data(), 2, entries);
    const ConstPlanar P(_loads.col(column).data(), 2, entries);
    y.noalias() = f.transpose().lazyProduct(_rows);
    y.noalias() += P.lazyProduct(_products);
}

/// (1 + B Q) y = rows^T f + B P, then p'' = f + rows (P - Q y). Two columns: without the spin's
/// acceleration and for one unit of it, which not every caller needs. Leaves p'' in _forces and y
/// in _planes.
void RotorMotion::solve_accelerations(int columns) const {
    const Index entries = _rows.cols();
    if (_inverse_mass.size() > 0)
        _forces.leftCols(columns) = Eigen::MatrixXd(_inverse_mass * _forces.leftCols(columns));
    if (entries == 0)
        return;
    const auto planes = entries / 2;
    for (Index column = 0; column < columns; ++column)
        gather(column);
    switch (planes) { // sizes known to the compiler are much faster
    case 1:
        solve_planes<4>(_products, _coupling, _planes, columns);
        break;
    case 2:
        solve_planes<8>(_products, _coupling, _planes, columns);
        break;
    case 3:
        solve_planes<12>(_products, _coupling, _planes, columns);
        break;
    default:
        solve_planes<Eigen::Dynamic>(_products, _coupling, _planes, columns);
    }
    for (Index column = 0; column < columns; ++column) {
        for (Index plane = 0; plane < planes; ++plane)
            _loads.col(column).segment<4>(4 * plane).noalias() -=
                _coupling.middleCols<4>(4 * plane) * _planes.col(column).segment<4>(4 * plane);
        const ConstPlanar load(_loads.col(column).data(), 2, entries);
        Pair(_forces.col(column).data(), _rows.rows(), 2).noalias() +=
            _rows.lazyProduct(load.transpose());
    }
}

/// Torque of the drive for no acceleration of the spin, and per unit of it.
Eigen::Vector2d RotorMotion::torque(const double *state, int columns) const {
    const Index r = _parts.rotor.size();
    Eigen::Vector2d torque(0, _parts.polar_inertia);
    const ConstPair turned(_by_place.data() + 2 * r, r, 2);
    for (Index column = 0; column < columns; ++column)
        torque(column) -= turning(turned, ConstPair(_forces.col(column).data(), r, 2)) / 2;
    if (_internal)
        torque(0) -= turning(ConstPair(state, r, 2), ConstPair(_inner.data(), r, 2));
    for (std::size_t i = 0; i < _parts.fixed.size(); ++i) {
        const FixedMass &mass = _parts.fixed[i];
        const balancers::MassEquation &e = _fixed_equations[i];
        for (Index column = 0; column < columns; ++column) {
            torque(column) += mass.plane >= 0
                                  ? e.u.dot(_planes.col(column).segment<4>(4 * mass.plane))
                                  : e.u.dot(fixed_motion(mass, _forces.col(column).data()));
        }
        torque += Eigen::Vector2d(e.b, e.a);
    }
    return torque + free_torque(columns);
}

/// Acceleration of a free angle (fixed frame): the motion alone with all that holds it, or by the
/// spin's acceleration.
double RotorMotion::coupled_acceleration(std::size_t i, Eigen::Index column) const {
    const balancers::MassEquation &e = _free_equations[i];
    if (is_held(i))
        return column == 0 ? 0 : 1;
    const DryTorque &f = _friction[i];
    const double own = column == 0 ? f.push - e.b : -e.by_spin;
    return (own - f.row.dot(_planes.col(column).segment<4>(4 * _plane_of[i]))) / e.a;
}

/// What the free parts ask of the drive.
Eigen::Vector2d RotorMotion::free_torque(int columns) const {
    Eigen::Vector2d torque(0, 0);
    for (std::size_t i = 0; i < _free_equations.size(); ++i) {
        const balancers::MassEquation &e = _free_equations[i];
        const double lever = _dry.slip[i] * e.lever;
        Eigen::Vector2d own = e.torque;
        own(0) += _base(1) * e.offset(0) - _base(0) * e.offset(1) + _friction[i].stand +
                  _friction[i].wall;
        const bool held = is_held(i);
        if (held) // what its own equation asks for
            own += Eigen::Vector2d(e.b, e.a + e.by_spin);
        if (lever != 0)
            own(0) -= lever * (e.normal + e.normal_y.head<2>().dot(_base));
        for (Index column = 0; column < columns; ++column) {
            const double *y = _planes.col(column).data() + 4 * _plane_of[i];
            own(column) +=
                y[1] * e.offset(0) - y[0] * e.offset(1) + y[2] * e.swash(0) + y[3] * e.swash(1);
            if (e.by_spin != 0)
                own(column) += e.by_spin * coupled_acceleration(i, column);
            if (held)
                own(column) += Eigen::Map<const Eigen::Vector4d>(y).dot(e.u);
            if (lever != 0)
                own(column) -= lever * Eigen::Map<const Eigen::Vector4d>(y).dot(e.normal_y);
        }
        torque += own;
    }
    return torque;
}

void RotorMotion::rates(double t, const double *state, double *rates) const {
    const int n = coordinates();
    const int r2 = first_angle();
    Spin::At now = spin(t, state);
    rotor_forces(now, state, state + n);
    outside_forces(t);
    mass_loads(now, state);
    const int held = add_constraint_columns();
    const int columns = held > 0 || _parts.motor || now.acceleration != 0 ? 2 : 1;
    solve_accelerations(columns + held);
    if (held > 0)
        apply_constraints(now, state, held);
    const Eigen::Vector2d needed = torque(state, columns);
    if (_parts.motor) {
        const double given = _parts.motor->torque - _parts.motor->slope * now.speed;
        now.acceleration = (given - needed(0)) / needed(1);
        rates[2 * n] = now.speed;
        rates[2 * n + 1] = now.acceleration;
    }
    const double torque = needed(0) + now.acceleration * needed(1);
    if (columns == 2) {
        _forces.col(0) += now.acceleration * _forces.col(1);
        _planes.col(0) += now.acceleration * _planes.col(1);
    }
    settle_friction();
    std::copy(state + n, state + 2 * n, rates);
    std::copy(_forces.data(), _forces.data() + r2, rates + n);
    double *own = rates + n + r2;
    for (std::size_t i = 0; i < _free_equations.size(); ++i, ++own) {
        const balancers::MassEquation &e = _free_equations[i];
        if (is_held(i)) {
            *own = 0;
            continue;
        }
        *own = coupled_acceleration(i, 0) - e.by_spin * now.acceleration / e.a;
        if (!e.in_rotor)
            *own -= now.acceleration;
    }
    keep_energy_balance(now, torque, state, rates + books());
}

} // namespace whirl::simulation
