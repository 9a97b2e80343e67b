#include "simulation/excitation.h"

#include <algorithm>
#include <cmath>

namespace whirl::simulation {

namespace {

Eigen::Vector2d value_of(const model::StationForce &force, double t, double piece) {
    if (!force.acts_at(piece))
        return {0, 0};
    const double angle = force.frequency * t;
    return {force.x * std::cos(angle + force.phase), force.y * std::cos(angle + force.phase_y)};
}

void add_ends(const model::StationForce &force, std::vector<double> &times) {
    times.push_back(force.from);
    if (force.to)
        times.push_back(*force.to);
}

} // namespace

void Excitation::add(const reduction::Row &row, const model::StationForce &force) {
    _forces.push_back({row, force});
}

void Excitation::set_base(const reduction::Row &x_load, const reduction::Row &y_load,
                          const model::BaseMotion &base) {
    _x_load = x_load;
    _y_load = y_load;
    _base = base;
}

std::vector<double> Excitation::jumps() const {
    std::vector<double> times;
    for (const Force &force : _forces)
        add_ends(force.force, times);
    if (_base && _base->harmonic)
        add_ends(*_base->harmonic, times);
    if (_base)
        for (const model::BaseMotion::Row &row : _base->table)
            times.push_back(row.time);
    std::erase_if(times, [](double t) { return t <= 0; });
    return times;
}

Eigen::Vector2d Excitation::base(double t, double piece) const {
    if (_base->harmonic)
        return value_of(*_base->harmonic, t, piece);
    const auto &table = _base->table;
    const auto next = std::upper_bound(
        table.begin(), table.end(), piece,
        [](double time, const model::BaseMotion::Row &row) { return time < row.time; });
    if (next == table.begin() || next == table.end())
        return {0, 0};
    const model::BaseMotion::Row &a = *std::prev(next);
    const double share = (t - a.time) / (next->time - a.time);
    return {a.x + share * (next->x - a.x), a.y + share * (next->y - a.y)};
}

Eigen::Vector2d Excitation::add_loads(double t, double piece, Eigen::VectorXd &loads) const {
    const Eigen::Index r = loads.size() / 2;
    for (const Force &force : _forces) {
        const Eigen::Vector2d now = value_of(force.force, t, piece);
        loads.head(r) += now(0) * force.row;
        loads.tail(r) += now(1) * force.row;
    }
    if (!_base)
        return {0, 0};
    const Eigen::Vector2d a = base(t, piece);
    loads.head(r) -= a(0) * _x_load;
    loads.tail(r) -= a(1) * _y_load;
    return a;
}

} // namespace whirl::simulation
