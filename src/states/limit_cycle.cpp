#include "states/limit_cycle.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

namespace whirl::states {

namespace {

using Eigen::Index;
using std::numbers::pi;

/// Error of the integrator over a step, of the sizes of the motion.
constexpr double tolerance = 1e-11;
/// Steps of central differences, likewise: their error (this squared) and that of the integrator
/// over them (1e-6) leave the multipliers some 1e-6.
constexpr double difference = 1e-5;
/// What a cycle may fail to return by: what the integrator leaves over a period.
constexpr double returned = 1e-8;
/// Of multipliers about 1: which is less is not known.
constexpr double least_margin = 1e-5;

simulation::MovingParts at_constant_speed(simulation::MovingParts parts, double speed) {
    parts.spin = simulation::Spin(speed);
    for (simulation::FixedMass &mass : parts.fixed)
        mass.from = 0; // all have come by now
    return parts;
}

} // namespace

std::string not_alike_in_time(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    const model::SimulateSettings &s = scene.simulate;
    if (rotor.balancers.empty())
        return "there are no balancers";
    if (s.torque)
        return "a motor drives the rotor, whose speed is not constant";
    if (s.gravity != 0 || !s.forces.empty() || s.base)
        return "weight or forces from outside stand still while the rotor turns";
    if (!rotor.bearings_isotropic() || !rotor.support_masses_isotropic())
        return "the bearings differ between their directions";
    for (const model::Balancer &b : rotor.balancers)
        if (const auto *balls = std::get_if<model::Balls>(&b.parts);
            balls && (balls->contact || balls->resists()))
            return "balls touch or resist rolling";
    return "";
}

double LimitCycle::growth() const {
    return multipliers.size() == 0 ? -HUGE_VAL : std::log(std::abs(multipliers(0))) / period;
}

std::optional<bool> LimitCycle::stable() const {
    const double largest = multipliers.size() == 0 ? 0 : std::abs(multipliers(0));
    const double margin = std::max(least_margin, 10 * multiplier_error);
    if (std::abs(largest - 1) <= margin)
        return std::nullopt;
    return largest < 1;
}

LimitCycles::LimitCycles(const simulation::MovingParts &parts, double speed, double moment,
                         simulation::OdeMethod method)
    : _motion(at_constant_speed(parts, speed)), _speed(speed), _moment(moment), _method(method) {
    _motion.enter_piece(std::numeric_limits<double>::min());
}

Eigen::VectorXd LimitCycles::sizes(const Eigen::VectorXd &start) const {
    const simulation::MovingParts &parts = _motion.parts();
    const Index shapes = _motion.first_angle();
    const Index n = _motion.coordinates();
    const double fast = std::abs(_speed);
    const double p =
        std::max(start.head(shapes).norm(), 0.01 * _moment / std::sqrt(parts.rotor.mass));
    Eigen::VectorXd out = Eigen::VectorXd::Ones(2 * n);
    for (Index i = 0; i < shapes; ++i) // of all shapes the same energy
        out(i) = p * fast / std::max(fast, parts.rotor.frequencies(i % parts.rotor.size()));
    out.segment(n, shapes).setConstant(p * fast);
    out.tail(n - shapes).setConstant(fast);
    return out;
}

void LimitCycles::follow(const Eigen::VectorXd &start, double time, int steps,
                         const Observer &at) const {
    const Eigen::VectorXd scale = sizes(start);
    const Index used = start.size();
    const int r = _motion.parts().rotor.size();
    simulation::OdeSolver solver(
        {_motion.size(),
         [this](double t, const double *y, double *rates) { _motion.rates(t, y, rates); },
         [&](const double * /*y*/, double *allowed) {
             Eigen::Map<Eigen::VectorXd>(allowed, used) = tolerance * scale;
             std::fill(allowed + used, allowed + _motion.size(), HUGE_VAL); // energy: not read
         },
         {_speed, r, {0, _motion.coordinates()}}},
        _method);
    Eigen::VectorXd state = Eigen::VectorXd::Zero(_motion.size());
    state.head(used) = start;
    solver.start(0, state.data());
    at(0, start);
    for (int k = 1; k <= steps; ++k) {
        const double stop = k == steps ? time : time * k / steps;
        while (solver.step(stop) < stop) {
        }
        state = Eigen::Map<const Eigen::VectorXd>(solver.state(), _motion.size());
        const double turned = std::remainder(_speed * stop, 2 * pi);
        for (const Index first : {Index{0}, Index{_motion.coordinates()}}) {
            const Eigen::VectorXd x = state.segment(first, r);
            const Eigen::VectorXd y = state.segment(first + r, r);
            state.segment(first, r) = std::cos(turned) * x + std::sin(turned) * y;
            state.segment(first + r, r) = std::cos(turned) * y - std::sin(turned) * x;
        }
        at(stop, state.head(used));
    }
}

Eigen::VectorXd LimitCycles::after(const Eigen::VectorXd &start, double time) const {
    Eigen::VectorXd out;
    follow(start, time, 1, [&out](double, const Eigen::VectorXd &state) { out = state; });
    return out;
}

Eigen::VectorXd LimitCycles::rates(const Eigen::VectorXd &state) const {
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(_motion.size());
    whole.head(state.size()) = state;
    Eigen::VectorXd out(_motion.size());
    _motion.rates(0, whole.data(), out.data());
    const int r = _motion.parts().rotor.size();
    for (const Index first : {Index{0}, Index{_motion.coordinates()}}) {
        out.segment(first, r) += _speed * state.segment(first + r, r);
        out.segment(first + r, r) -= _speed * state.segment(first, r);
    }
    return out.head(state.size());
}

std::optional<LimitCycle> LimitCycles::newton(LimitCycle cycle) const {
    const Index n = _motion.coordinates();
    const Index shapes = _motion.first_angle();
    const Index size = 2 * n;
    Eigen::VectorXd on = Eigen::VectorXd::Zero(size);
    for (Index k = shapes; k < n; ++k)
        on(k) = 2 * pi * cycle.turns[static_cast<std::size_t>(k - shapes)];
    const Eigen::VectorXd scale = sizes(cycle.start);
    Eigen::MatrixXd monodromy(size, size);
    double last = HUGE_VAL;
    constexpr int most = 15;
    for (int step = 0; step < most; ++step) {
        const Eigen::VectorXd end = after(cycle.start, cycle.period);
        const Eigen::VectorXd left = (end - cycle.start - on).cwiseQuotient(scale);
        cycle.defect = left.norm();
        const bool there = cycle.defect < returned;
        if (!there && (cycle.defect > 2 * last || cycle.defect > 10))
            return std::nullopt;
        last = cycle.defect;
        for (Index k = 0; k < size; ++k) {
            Eigen::VectorXd moved = cycle.start;
            moved(k) += difference * scale(k);
            const Eigen::VectorXd more = after(moved, cycle.period);
            moved(k) -= 2 * difference * scale(k);
            monodromy.col(k) =
                (more - after(moved, cycle.period)).cwiseQuotient(scale) / (2 * difference);
        }
        if (there)
            break;
        if (step == most - 1)
            return std::nullopt;
        Eigen::MatrixXd A(size + 1, size + 1);
        A.topLeftCorner(size, size) = monodromy - Eigen::MatrixXd::Identity(size, size);
        A.topRightCorner(size, 1) = rates(end).cwiseQuotient(scale) / std::abs(_speed);
        // Across the motion: along it every start is one.
        A.bottomLeftCorner(1, size) =
            (rates(cycle.start).cwiseQuotient(scale) / std::abs(_speed)).transpose();
        A(size, size) = 0;
        Eigen::VectorXd b(size + 1);
        b << -left, 0;
        const Eigen::VectorXd x = linalg::least_squares(A, b);
        cycle.start += x.head(size).cwiseProduct(scale);
        cycle.period += x(size) / std::abs(_speed);
        if (!x.allFinite() || !(cycle.period > 0))
            return std::nullopt;
    }
    Eigen::VectorXcd found = linalg::general_eigenvalues(monodromy);
    std::sort(found.begin(), found.end(),
              [](const auto &a, const auto &b) { return std::abs(a) > std::abs(b); });
    Index along = 0;
    (found.array() - 1.0).abs().minCoeff(&along);
    cycle.multiplier_error = std::abs(found(along) - 1.0);
    cycle.multipliers.resize(size - 1);
    cycle.multipliers << found.head(along), found.tail(size - 1 - along);
    return cycle;
}

std::optional<LimitCycle> LimitCycles::refined(const LimitCycle &guess) const {
    return newton(guess);
}

std::optional<LimitCycle> LimitCycles::next_to(const Eigen::VectorXd &start) const {
    const Index n = _motion.coordinates();
    const Index shapes = _motion.first_angle();
    constexpr int a_turn = 16;   // states looked at
    constexpr int longest = 400; // turns of the rotor
    const double step = 2 * pi / std::abs(_speed) / a_turn;
    const Eigen::VectorXd scale = sizes(start);
    std::vector<double> away;
    std::vector<Eigen::VectorXd> angles;
    follow(start, longest * a_turn * step, longest * a_turn,
           [&](double, const Eigen::VectorXd &state) {
               Eigen::VectorXd apart = state - start;
               for (Index k = shapes; k < n; ++k)
                   apart(k) = std::remainder(apart(k), 2 * pi);
               away.push_back(apart.cwiseQuotient(scale).norm());
               angles.emplace_back(state.segment(shapes, n - shapes));
           });
    const double farthest = *std::ranges::max_element(away);
    constexpr double at_rest = 1e-6;
    if (farthest < at_rest)
        return std::nullopt;
    constexpr double near = 0.2; // of the farthest: a return
    constexpr int tries = 4;
    int tried = 0;
    bool left = false;
    for (std::size_t k = 1; k + 1 < away.size() && tried < tries; ++k) {
        left = left || away[k] > farthest / 2;
        if (!left || away[k] > near * farthest || away[k] > away[k - 1] || away[k] > away[k + 1])
            continue;
        ++tried;
        LimitCycle guess;
        guess.start = start;
        // The least of the parabola through the squares, which is nearly one.
        const double before = away[k - 1] * away[k - 1];
        const double here = away[k] * away[k];
        const double behind = away[k + 1] * away[k + 1];
        const double bend = before - 2 * here + behind;
        const double shift = bend > 0 ? (before - behind) / (2 * bend) : 0;
        guess.period = (static_cast<double>(k) + shift) * step;
        for (Index i = 0; i < n - shapes; ++i)
            guess.turns.push_back(
                static_cast<int>(std::lround((angles[k](i) - angles[0](i)) / (2 * pi))));
        if (auto cycle = newton(guess))
            return cycle;
    }
    return std::nullopt;
}

} // namespace whirl::states
