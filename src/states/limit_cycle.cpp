#include "states/limit_cycle.h"

#include "linalg/dense/general_eigen.h"
#include "linalg/dense/least_squares.h"

#include <Eigen/SVD>

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
/// Periods longer than this, in turns of the rotor, are not looked at.
constexpr double longest = 400;
/// Of multipliers about 1: which is less is not known.
constexpr double least_margin = 1e-5;

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
            balls && (balls->contact || balls->resists() || !balls->walls.empty()))
            return "balls touch, resist rolling or have walls in their race";
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

LimitCycles::LimitCycles(simulation::MovingParts parts, double moment, simulation::OdeMethod method)
    : _parts(std::move(parts)), _moment(moment), _method(method) {
    for (simulation::FixedMass &mass : _parts.fixed)
        mass.from = 0; // all have come by now
    for (simulation::FreeParts &parts : _parts.free)
        parts.from = 0;
}

simulation::RotorMotion LimitCycles::motion(double speed) const {
    simulation::MovingParts parts = _parts;
    parts.spin = simulation::Spin(speed);
    simulation::RotorMotion out(std::move(parts));
    out.enter_piece(std::numeric_limits<double>::min());
    return out;
}

Eigen::VectorXd LimitCycles::sizes(const Eigen::VectorXd &start, double speed) const {
    const Index shapes = 2 * _parts.rotor.size();
    const Index n = start.size() / 2;
    const double fast = std::abs(speed);
    const double p =
        std::max(start.head(shapes).norm(), 0.01 * _moment / std::sqrt(_parts.rotor.mass));
    Eigen::VectorXd out = Eigen::VectorXd::Ones(2 * n);
    for (Index i = 0; i < shapes; ++i) // of all shapes the same energy
        out(i) = p * fast / std::max(fast, _parts.rotor.frequencies(i % _parts.rotor.size()));
    out.segment(n, shapes).setConstant(p * fast);
    out.tail(n - shapes).setConstant(fast);
    return out;
}

void LimitCycles::follow(const Eigen::VectorXd &start, double speed, double time, int steps,
                         const Observer &at) const {
    const simulation::RotorMotion moving = motion(speed);
    const Eigen::VectorXd scale = sizes(start, speed);
    const Index used = start.size();
    const simulation::TurningAxes axes{speed, _parts.rotor.size(), {0, moving.coordinates()}};
    simulation::OdeSolver solver(
        {moving.size(),
         [&moving](double t, const double *y, double *rates) { moving.rates(t, y, rates); },
         [&](const double * /*y*/, double *allowed) {
             Eigen::Map<Eigen::VectorXd>(allowed, used) = tolerance * scale;
             std::fill(allowed + used, allowed + moving.size(), HUGE_VAL); // energy: not read
         },
         axes},
        _method);
    Eigen::VectorXd state = Eigen::VectorXd::Zero(moving.size());
    state.head(used) = start;
    solver.start(0, state.data());
    at(0, start);
    for (int k = 1; k <= steps; ++k) {
        const double stop = k == steps ? time : time * k / steps;
        while (solver.step(stop) < stop) {
        }
        state = Eigen::Map<const Eigen::VectorXd>(solver.state(), moving.size());
        axes.turn(-std::remainder(speed * stop, 2 * pi), state.data());
        at(stop, state.head(used));
    }
}

Eigen::VectorXd LimitCycles::after(const LimitCycle &cycle) const {
    Eigen::VectorXd out;
    follow(cycle.start, cycle.speed, cycle.period, 1,
           [&out](double, const Eigen::VectorXd &state) { out = state; });
    return out;
}

Eigen::VectorXd LimitCycles::rates(const Eigen::VectorXd &state, double speed) const {
    const simulation::RotorMotion moving = motion(speed);
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(moving.size());
    whole.head(state.size()) = state;
    Eigen::VectorXd out(moving.size());
    moving.rates(0, whole.data(), out.data());
    const int r = _parts.rotor.size();
    for (const Index first : {Index{0}, state.size() / 2}) {
        out.segment(first, r) += speed * state.segment(first + r, r);
        out.segment(first + r, r) -= speed * state.segment(first, r);
    }
    return out.head(state.size());
}

Eigen::VectorXd LimitCycles::missed(const LimitCycle &cycle, const Eigen::VectorXd &sizes) const {
    Eigen::VectorXd out = after(cycle) - cycle.start;
    const Index shapes = 2 * _parts.rotor.size();
    for (std::size_t i = 0; i < cycle.turns.size(); ++i)
        out(shapes + static_cast<Index>(i)) -= 2 * pi * cycle.turns[i];
    return out.cwiseQuotient(sizes);
}

LimitCycles::Derivative LimitCycles::derivative(const LimitCycle &cycle,
                                                const Eigen::VectorXd &sizes) const {
    const Index size = cycle.start.size();
    Derivative out;
    const auto central = [&](const auto &move) {
        LimitCycle more = cycle;
        move(more, difference);
        LimitCycle less = cycle;
        move(less, -difference);
        return Eigen::VectorXd((missed(more, sizes) - missed(less, sizes)) / (2 * difference));
    };
    out.by_start.resize(size, size);
    for (Index k = 0; k < size; ++k)
        out.by_start.col(k) =
            central([&](LimitCycle &of, double step) { of.start(k) += step * sizes(k); });
    out.by_speed = central([](LimitCycle &of, double step) { of.speed *= 1 + step; });
    out.by_period = cycle.period * rates(after(cycle), cycle.speed).cwiseQuotient(sizes);
    out.along = rates(cycle.start, cycle.speed).cwiseQuotient(sizes) / std::abs(cycle.speed);
    return out;
}

/// Steps of Newton's method with one derivative as long as it leads on. Across the motion: along it
/// every start is one.
/// @param tangent  with it the speed is free, and steps are across it; null: the speed is kept
std::optional<LimitCycles::Corrected> LimitCycles::corrected(LimitCycle cycle,
                                                             const Eigen::VectorXd &sizes,
                                                             Derivative by,
                                                             const Eigen::VectorXd *tangent) const {
    const Index size = cycle.start.size();
    const Index unknowns = size + (tangent ? 2 : 1);
    double last = HUGE_VAL;
    int fresh = 0;
    constexpr int most = 30;        // shots
    constexpr int derivatives = 6;  // anew
    constexpr double slow = 0.3;    // what is left of the defect after a step
    constexpr double farthest = 10; // beside the sizes
    for (int shots = 1; shots <= most; ++shots) {
        const Eigen::VectorXd left = missed(cycle, sizes);
        cycle.defect = left.norm();
        if (!(cycle.defect < farthest))
            return std::nullopt;
        if (cycle.defect < returned) {
            Corrected out{cycle, derivative(cycle, sizes), shots};
            const Eigen::MatrixXd monodromy =
                out.derivative.by_start + Eigen::MatrixXd::Identity(size, size);
            Eigen::VectorXcd found = linalg::general_eigenvalues(monodromy);
            std::sort(found.begin(), found.end(),
                      [](const auto &a, const auto &b) { return std::abs(a) > std::abs(b); });
            Index along = 0;
            (found.array() - 1.0).abs().minCoeff(&along);
            out.cycle.multiplier_error = std::abs(found(along) - 1.0);
            constexpr double one = 1e-2;
            // Parts that rest come back after any time: no cycle.
            if (out.cycle.multiplier_error > one || out.derivative.along.norm() < one * one)
                return std::nullopt;
            out.cycle.multipliers.resize(size - 1);
            out.cycle.multipliers << found.head(along), found.tail(size - 1 - along);
            return out;
        }
        if (cycle.defect > slow * last) {
            if (++fresh > derivatives)
                return std::nullopt;
            by = derivative(cycle, sizes);
        }
        last = cycle.defect;
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(unknowns, unknowns);
        A.topLeftCorner(size, size) = by.by_start;
        A.block(0, size, size, 1) = by.by_period;
        A.block(size, 0, 1, size) = by.along.transpose();
        if (tangent) {
            A.block(0, size + 1, size, 1) = by.by_speed;
            A.row(size + 1) = tangent->transpose();
        }
        Eigen::VectorXd b = Eigen::VectorXd::Zero(unknowns);
        b.head(size) = -left;
        const Eigen::VectorXd x = linalg::least_squares(A, b);
        if (!x.allFinite())
            return std::nullopt;
        cycle.start += x.head(size).cwiseProduct(sizes);
        cycle.period *= 1 + x(size);
        if (tangent)
            cycle.speed *= 1 + x(size + 1);
        if (!(cycle.period * std::abs(cycle.speed) > 0) ||
            cycle.period * std::abs(cycle.speed) > 2 * pi * 2 * longest)
            return std::nullopt;
    }
    return std::nullopt;
}

double LimitCycles::distance(const Eigen::VectorXd &a, const Eigen::VectorXd &b,
                             const Eigen::VectorXd &sizes) const {
    Eigen::VectorXd apart = a - b;
    for (Index k = 2 * _parts.rotor.size(); k < a.size() / 2; ++k)
        apart(k) = std::remainder(apart(k), 2 * pi);
    return apart.cwiseQuotient(sizes).norm();
}

double LimitCycles::apart(const LimitCycle &cycle, const Eigen::VectorXd &state) const {
    return distance(cycle.start, state, sizes(cycle.start, cycle.speed));
}

std::optional<LimitCycle> LimitCycles::next_to(const Eigen::VectorXd &start, double speed) const {
    const Index n = start.size() / 2;
    const Index shapes = 2 * _parts.rotor.size();
    constexpr int a_turn = 16; // states looked at
    const double step = 2 * pi / std::abs(speed) / a_turn;
    const Eigen::VectorXd scale = sizes(start, speed);
    std::vector<double> away;
    std::vector<Eigen::VectorXd> angles;
    follow(start, speed, longest * a_turn * step, static_cast<int>(longest * a_turn),
           [&](double, const Eigen::VectorXd &state) {
               away.push_back(distance(state, start, scale));
               angles.emplace_back(state.segment(shapes, n - shapes));
           });
    const double farthest = *std::ranges::max_element(away);
    constexpr double at_rest = 1e-6;
    if (farthest < at_rest)
        return std::nullopt;
    constexpr double near = 0.2; // of the farthest: a return
    std::vector<std::size_t> returns;
    bool left = false;
    for (std::size_t k = 1; k + 1 < away.size(); ++k) {
        left = left || away[k] > farthest / 2;
        if (left && away[k] < near * farthest && away[k] <= away[k - 1] && away[k] <= away[k + 1])
            returns.push_back(k);
    }
    if (returns.empty())
        return std::nullopt;
    // Equal balls that change places come back half way too, but not each to where it was: what is
    // farther off than others is no return. Of the rest the first has the shortest period.
    double least = HUGE_VAL;
    for (const std::size_t k : returns)
        least = std::min(least, away[k]);
    constexpr double beside = 3; // times the least, by where the states looked at lie
    std::erase_if(returns,
                  [&](std::size_t k) { return away[k] > beside * least + 1e-2 * farthest; });
    constexpr std::size_t tries = 4;
    returns.resize(std::min(returns.size(), tries));
    std::optional<LimitCycle> nearest;
    for (const std::size_t k : returns) {
        LimitCycle guess;
        guess.speed = speed;
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
        const auto found = corrected(guess, scale, derivative(guess, scale), nullptr);
        if (!found || (nearest && apart(*nearest, start) <= apart(found->cycle, start)))
            continue;
        nearest = found->cycle;
        constexpr double there = 0.05; // Newton's method did not lead to another one
        if (apart(*nearest, start) < there)
            break;
    }
    return nearest;
}

/// A branch from one of its cycles one way.
class LimitCycles::Following {
  public:
    Following(const LimitCycles &cycles, Corrected first, Eigen::VectorXd sizes, double from,
              double to, int count)
        : _cycles(cycles), _first(std::move(first)), _sizes(std::move(sizes)),
          _from(std::min(from, to)), _to(std::max(from, to)), _count(count) {}

    /// @param direction  of the speed at first
    CycleBranch::End run(double direction, std::vector<BranchPoint> &out) {
        Corrected here = _first;
        const Index size = here.cycle.start.size();
        Eigen::VectorXd tangent = Eigen::VectorXd::Zero(size + 2);
        tangent(size + 1) = direction;
        tangent = tangent_at(here, tangent);
        const double wide = (_to - _from) / _count / std::abs(here.cycle.speed);
        constexpr double bent = 0.25; // step of a motion as a whole, of its size
        constexpr double least = 1e-4;
        double length = std::min(bent, wide / std::max(std::abs(tangent(size + 1)), 1e-6));
        while (static_cast<int>(out.size()) < 8 * _count) {
            const std::optional<Corrected> next = stepped(here, tangent, length);
            const Eigen::VectorXd turned = next ? tangent_at(*next, tangent) : tangent;
            constexpr double straight = 0.9; // cosine between tangents
            if (!next || turned.dot(tangent) < straight) {
                length /= 2;
                if (length < least * bent)
                    return CycleBranch::End::lost;
                continue;
            }
            if (next->cycle.speed < _from || next->cycle.speed > _to) {
                return add_end(here, next->cycle.speed < _from ? _from : _to, out)
                           ? CycleBranch::End::range
                           : CycleBranch::End::lost;
            }
            add_between(here, *next, tangent, turned, length, out);
            out.push_back({next->cycle});
            if (next->cycle.period * std::abs(next->cycle.speed) > 2 * pi * longest)
                return CycleBranch::End::standing;
            const double most = std::min(bent, wide / std::max(std::abs(turned(size + 1)), 1e-6));
            length = std::min(most, next->shots <= 5 ? 1.6 * length : length);
            here = *next;
            tangent = turned;
        }
        return CycleBranch::End::points;
    }

  private:
    const LimitCycles &_cycles;
    Corrected _first;
    Eigen::VectorXd _sizes;
    double _from, _to;
    int _count;

    /// The part of a direction along the branch. Where other cycles are alike (masses that can
    /// share out what they do) there are more ways on than one.
    [[nodiscard]] static Eigen::VectorXd tangent_at(const Corrected &at,
                                                    const Eigen::VectorXd &towards) {
        const Derivative &by = at.derivative;
        const Index size = by.by_start.rows();
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size + 1, size + 2);
        A.topLeftCorner(size, size) = by.by_start;
        A.block(0, size, size, 1) = by.by_period;
        A.block(0, size + 1, size, 1) = by.by_speed;
        A.block(size, 0, 1, size) = by.along.transpose();
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
        constexpr double differences = 1e-5; // error of the derivative
        Index rank = size + 1;
        while (rank > 0 && svd.singularValues()(rank - 1) < differences)
            --rank;
        const Eigen::MatrixXd ways = svd.matrixV().rightCols(size + 2 - rank);
        const Eigen::VectorXd out = ways * (ways.transpose() * towards);
        return out.normalized();
    }

    [[nodiscard]] std::optional<Corrected>
    stepped(const Corrected &from, const Eigen::VectorXd &tangent, double length) const {
        const Index size = from.cycle.start.size();
        LimitCycle guess = from.cycle;
        guess.start += length * tangent.head(size).cwiseProduct(_sizes);
        guess.period *= 1 + length * tangent(size);
        guess.speed *= 1 + length * tangent(size + 1);
        if (!(guess.period > 0))
            return std::nullopt;
        return _cycles.corrected(guess, _sizes, from.derivative, &tangent);
    }

    /// @returns whether there is one
    bool add_end(const Corrected &from, double speed, std::vector<BranchPoint> &out) const {
        LimitCycle guess = from.cycle;
        guess.speed = speed;
        const auto end = _cycles.corrected(guess, _sizes, from.derivative, nullptr);
        if (end)
            out.push_back({end->cycle});
        return end.has_value();
    }

    /// A fold or a border of stability between two points, by the secant method over the length.
    void add_between(const Corrected &a, const Corrected &b, const Eigen::VectorXd &tangent,
                     const Eigen::VectorXd &turned, double length,
                     std::vector<BranchPoint> &out) const {
        const Index speed = tangent.size() - 1;
        const bool fold = (tangent(speed) < 0) != (turned(speed) < 0);
        const bool border =
            a.cycle.stable() && b.cycle.stable() && *a.cycle.stable() != *b.cycle.stable();
        if (!fold && !border)
            return;
        const auto value = [&](const Corrected &at, const Eigen::VectorXd &along) {
            return fold ? along(speed) : at.cycle.growth();
        };
        double low = 0;
        double high = length;
        double at_low = value(a, tangent);
        double at_high = value(b, turned);
        if ((at_low < 0) == (at_high < 0))
            return;
        std::optional<Corrected> found;
        constexpr int most = 8;
        for (int k = 0; k < most; ++k) {
            const double middle = std::clamp(low - at_low * (high - low) / (at_high - at_low),
                                             low + 0.02 * (high - low), high - 0.02 * (high - low));
            auto point = stepped(a, tangent, middle);
            if (!point)
                return;
            const double here = value(*point, tangent_at(*point, tangent));
            const double before = found ? found->cycle.speed : a.cycle.speed;
            found = std::move(point);
            ((here < 0) == (at_low < 0) ? low : high) = middle;
            ((here < 0) == (at_low < 0) ? at_low : at_high) = here;
            constexpr double known = 1e-7;
            if (std::abs(found->cycle.speed - before) < known * std::abs(before) && k > 2)
                break;
        }
        out.push_back({found->cycle, fold ? BranchPoint::Kind::fold : BranchPoint::Kind::border});
    }
};

CycleBranch LimitCycles::branch(const LimitCycle &cycle, double from, double to, int count) const {
    const Eigen::VectorXd scale = sizes(cycle.start, cycle.speed);
    const auto first = corrected(cycle, scale, derivative(cycle, scale), nullptr);
    CycleBranch out;
    if (!first) {
        out.first = out.last = CycleBranch::End::lost;
        out.points.push_back({cycle});
        return out;
    }
    Following following(*this, *first, scale, from, to, count);
    out.first = following.run(-1, out.points);
    std::ranges::reverse(out.points);
    out.points.push_back({first->cycle});
    std::vector<BranchPoint> upwards;
    out.last = following.run(1, upwards);
    out.points.insert(out.points.end(), upwards.begin(), upwards.end());
    return out;
}

} // namespace whirl::states
