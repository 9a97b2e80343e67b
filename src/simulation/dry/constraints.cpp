// Contact and dry friction in the equations of motion.

#include "linalg/dense/least_squares.h"
#include "simulation/motion.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace whirl::simulation {

using Eigen::Index;

void RotorMotion::set_dry(DryState dry) {
    _dry = std::move(dry);
    const std::size_t n = _free_equations.size();
    _dry.resists.resize(n, false);
    _dry.slip.resize(n, 0);
    _friction.assign(n, {});
    _multipliers.assign(_dry.any() ? _dry.gaps.size() + n : 0, 0.0);
    if (_multipliers.empty())
        return;
    const Index columns = 2 + static_cast<Index>(_multipliers.size());
    for (Eigen::MatrixXd *values : {&_forces, &_planes, &_loads})
        values->setZero(values->rows(), columns);
}

/// Friction of what moves acts against its motion: row.y + b grow by lever * normal force.
void RotorMotion::add_sliding(std::size_t i, balancers::MassEquation &e) const {
    DryTorque &f = _friction[i];
    f = {};
    f.row = e.u;
    if (_dry.resists[i] && _dry.slip[i] != 0 && !_frictionless) {
        const double lever = _dry.slip[i] * e.lever;
        f.row += lever * e.normal_y;
        e.b += lever * (e.normal + e.normal_y.head<2>().dot(_base));
    }
}

/// A column of unit torque on what each active constraint holds. @returns how many there are.
int RotorMotion::add_constraint_columns() const {
    _constraints.clear();
    std::fill(_multipliers.begin(), _multipliers.end(), 0.0);
    if (_multipliers.empty() || _frictionless)
        return 0;
    for (std::size_t i = 0; i < _free_equations.size(); ++i)
        if (_dry.stands(i))
            _constraints.push_back({-1, static_cast<int>(i), _dry.gaps.size() + i});
    for (std::size_t k = 0; k < _dry.gaps.size(); ++k) {
        const Gap &gap = _dry.gaps[k];
        if (_dry.closed[k] && !_dry.both_stand(gap)) // two that stand need not press on each other
            _constraints.push_back({gap.first, gap.second, k});
    }
    Index column = 2;
    for (const Constraint &c : _constraints)
        push_column(c, column++);
    return static_cast<int>(_constraints.size());
}

void RotorMotion::push_column(const Constraint &c, Index column) const {
    _forces.col(column).setZero();
    _loads.col(column).setZero();
    for (const auto &[i, sign] : {std::pair(c.first, -1.0), std::pair(c.second, 1.0)}) {
        if (i < 0)
            continue;
        const balancers::MassEquation &e = _free_equations[static_cast<std::size_t>(i)];
        _loads.col(column).segment<4>(4 * _plane_of[static_cast<std::size_t>(i)]) -=
            e.u * (sign / e.a);
    }
}

/// Acceleration of a free angle (fixed frame) in a column: the motion alone, by the spin's
/// acceleration, or by a unit of a constraint.
double RotorMotion::free_acceleration(int i, Index column) const {
    const auto at = static_cast<std::size_t>(i);
    const balancers::MassEquation &e = _free_equations[at];
    double torque = -_friction[at].row.dot(_planes.col(column).segment<4>(4 * _plane_of[at]));
    if (column == 0)
        torque -= e.b;
    if (column == 1)
        torque -= e.by_spin;
    if (column >= 2) {
        const Constraint &c = _constraints[static_cast<std::size_t>(column - 2)];
        torque += c.second == i ? 1 : c.first == i ? -1 : 0;
    }
    return torque / e.a;
}

/// The torques with which the constraints hold; the first column takes up what they do.
void RotorMotion::apply_constraints(const Spin::At &spin, const double *state, int held) const {
    const double *angles = state + first_angle();
    const double *rates = angles + coordinates();
    const auto along = [&](const Constraint &c, Index column) {
        return (c.second < 0 ? 0 : free_acceleration(c.second, column)) -
               (c.first < 0 ? 0 : free_acceleration(c.first, column));
    };
    Eigen::MatrixXd A(held, held);
    Eigen::VectorXd lack(held);
    for (Index k = 0; k < held; ++k) {
        const Constraint &c = _constraints[static_cast<std::size_t>(k)];
        const double r = _dry.rate;
        double wanted = 0;
        if (const std::size_t k = c.multiplier; k < _dry.gaps.size())
            wanted = -2 * r * _dry.gaps[k].between(rates) - r * r * gap_of(_dry.gaps[k], angles);
        else
            wanted = -r * rates[c.second];
        if (c.first < 0)
            wanted += spin.acceleration;
        if (c.second < 0)
            wanted -= spin.acceleration;
        lack(k) = wanted - along(c, 0) - spin.acceleration * along(c, 1);
        for (Index m = 0; m < held; ++m)
            A(k, m) = along(c, 2 + m);
    }
    const Eigen::VectorXd torques = linalg::least_squares(A, lack);
    for (Index k = 0; k < held; ++k) {
        const Constraint &c = _constraints[static_cast<std::size_t>(k)];
        _multipliers[c.multiplier] = torques(k);
        _forces.col(0) += torques(k) * _forces.col(2 + k);
        _planes.col(0) += torques(k) * _planes.col(2 + k);
        for (const auto &[i, other, torque] : {std::tuple(c.first, c.second, -torques(k)),
                                               std::tuple(c.second, c.first, torques(k))}) {
            if (i < 0)
                continue;
            DryTorque &own = _friction[static_cast<std::size_t>(i)];
            own.push += torque;
            if (c.multiplier >= _dry.gaps.size())
                own.stand = torque;
            else if (other < 0)
                own.wall += torque;
        }
    }
}

double RotorMotion::gap_of(const Gap &gap, const double *angles) const {
    return gap.between(angles) + gap.offset - gap.touching;
}

/// Largest torque of friction on each part, and what friction of those that move takes.
void RotorMotion::settle_friction() const {
    for (std::size_t i = 0; i < _free_equations.size(); ++i) {
        balancers::MassEquation &e = _free_equations[i];
        const double normal = e.normal + e.normal_y.head<2>().dot(_base) +
                              e.normal_y.dot(_planes.col(0).segment<4>(4 * _plane_of[i]));
        _friction[i].limit = e.lever * normal;
        _friction[i].normal = normal;
        if (_dry.resists[i])
            e.friction += _dry.slip[i] * e.lever * normal;
    }
}

Eigen::VectorXd RotorMotion::impulse_response(double t, const double *state, const Gap &gap) const {
    _frictionless = true;
    const Spin::At now = spin(t, state);
    rotor_forces(now, state, state + coordinates());
    outside_forces(t);
    mass_loads(now, state);
    _constraints = {{gap.first, gap.second, 0}};
    push_column(_constraints.front(), 2);
    solve_accelerations(3);
    _frictionless = false;
    Eigen::VectorXd response(coordinates());
    response.head(first_angle()) = _forces.col(2);
    for (int i = 0; i < _parts.free_angles(); ++i)
        response(first_angle() + i) = free_acceleration(i, 2);
    return response;
}

} // namespace whirl::simulation
