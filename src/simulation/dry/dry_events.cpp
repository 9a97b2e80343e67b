#include "simulation/dry/dry_events.h"

#include "linalg/check.h"
#include "linalg/roots.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::simulation {

namespace {

/// rad: parts nearer than that touch. The distance of parts that touch is wrong by no more.
constexpr double touching = 1e-11;
/// Of the scale of rates: parts slower than that relative to each other or to the rotor stay
/// together, or stand. The energy of that motion is lost: 1e-12 of theirs.
constexpr double at_rest = 1e-6;
/// Of the scale of rates: how far a part that comes to rest moves on before it is seen.
constexpr double seen = 1e-9;
/// Of the torque m R^2 scale^2: how far a constraint may be overstrained.
constexpr double overstrained = 1e-9;
constexpr int pieces = 4; ///< in which gaps are looked at between the ends of a step
constexpr long most_impacts_at_once = 1000;

/// Value and slope at the ends of a step make a cubic.
double cubic(double a, double da, double b, double db, double length, double s) {
    const double s2 = s * s;
    const double s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * length * da + (3 * s2 - 2 * s3) * b +
           (s3 - s2) * length * db;
}

} // namespace

DryEvents::DryEvents(RotorMotion &motion, double scale,
                     std::function<std::unique_ptr<OdeSolver>()> solver)
    : _motion(motion), _scale(scale), _make_solver(std::move(solver)),
      _rates(static_cast<std::size_t>(motion.size())) {}

void DryEvents::begin(double t, Eigen::VectorXd &state) {
    DryState &dry = _motion.dry();
    std::fill(dry.slip.begin(), dry.slip.end(), 0);
    choose(t, state);
}

/// What is positive until an event: gaps, pressures, speeds against friction, reserves of friction.
std::vector<double> DryEvents::values(double t, const double *state) {
    _motion.rates(t, state, _rates.data());
    const DryState &dry = _motion.dry();
    const double *angles = state + _motion.first_angle();
    const double *rates = angles + _motion.coordinates();
    std::vector<double> out;
    for (std::size_t k = 0; k < dry.gaps.size(); ++k) {
        const double strain = overstrained * _motion.torque_scale(dry.gaps[k].second, _scale);
        out.push_back(dry.closed[k] ? _motion.pressure(k) + strain
                                    : _motion.gap_of(dry.gaps[k], angles) + touching);
    }
    for (std::size_t i = 0; i < dry.slip.size(); ++i) {
        if (!dry.resists[i])
            continue;
        const double strain = overstrained * _motion.torque_scale(static_cast<int>(i), _scale);
        out.push_back(dry.stands(i) ? _motion.friction_reserve(i) + strain
                                    : dry.slip[i] * rates[i] + seen * _scale);
        _lifted = _lifted || _motion.lifts(i);
    }
    return out;
}

/// A gap that is open at both ends of a step may close in between.
bool DryEvents::gap_dips(const Gap &gap, const double *before, const double *after, double length,
                         double &share) const {
    const auto at = [&](const double *state) {
        const double *angles = state + _motion.first_angle();
        const double *rates = angles + _motion.coordinates();
        return std::pair(_motion.gap_of(gap, angles), rates[gap.second] - rates[gap.first]);
    };
    const auto [a, da] = at(before);
    const auto [b, db] = at(after);
    for (int i = 1; i < pieces; ++i) {
        share = static_cast<double>(i) / pieces;
        if (cubic(a, da, b, db, length, share) < -touching)
            return true;
    }
    return false;
}

std::optional<DryEvents::Event> DryEvents::within(double from, const Eigen::VectorXd &before,
                                                  double to, const double *after) {
    const std::vector<double> at_end = values(to, after);
    double end = to - from;
    std::vector<std::size_t> suspects;
    for (std::size_t i = 0; i < at_end.size(); ++i)
        if (at_end[i] <= 0)
            suspects.push_back(i);
    const DryState &dry = _motion.dry();
    for (std::size_t k = 0; k < dry.gaps.size() && suspects.empty(); ++k) {
        double share = 1;
        if (!dry.closed[k] && gap_dips(dry.gaps[k], before.data(), after, to - from, share)) {
            suspects.push_back(k);
            end *= share;
        }
    }
    if (suspects.empty())
        return std::nullopt;
    Event event{to, Eigen::Map<const Eigen::VectorXd>(after, _motion.size())};
    if (!_solver)
        _solver = _make_solver();
    const auto state_at = [&](double since) {
        if (since <= 0)
            return before.data();
        double t = from;
        _solver->start(t, before.data());
        while (t < from + since)
            t = _solver->step(from + since);
        return _solver->state();
    };
    for (const std::size_t i : suspects) {
        const auto value = [&](double since) { return values(from + since, state_at(since))[i]; };
        const double first = value(0);
        const double last = value(end);
        if (last > 0)
            continue;
        if (first > 0)
            end = linalg::root_between(value, 0, first, end, last, 1e-12);
        else
            end = std::min(end, 1e-3 * (to - from)); // already past: at once
    }
    const double *there = state_at(end);
    event.time = from + end;
    event.state = Eigen::Map<const Eigen::VectorXd>(there, _motion.size());
    return event;
}

/// The pair that approaches fastest of those that touch. @returns whether there was one.
bool DryEvents::collide(double t, Eigen::VectorXd &state) {
    const DryState &dry = _motion.dry();
    const int n = _motion.coordinates();
    const double *angles = state.data() + _motion.first_angle();
    const double *rates = angles + n;
    const Gap *worst = nullptr;
    double approach = -1e-3 * at_rest * _scale;
    for (const Gap &gap : dry.gaps) {
        const double rate = rates[gap.second] - rates[gap.first];
        if (_motion.gap_of(gap, angles) <= 2 * touching && rate < approach) {
            worst = &gap;
            approach = rate;
        }
    }
    if (!worst)
        return false;
    const Eigen::VectorXd response = _motion.impulse_response(t, state.data(), *worst);
    const Eigen::Index at = _motion.first_angle();
    const double mobility = response(at + worst->second) - response(at + worst->first);
    const bool rests = -approach < at_rest * _scale;
    const double restitution = rests ? 0 : worst->restitution;
    const double before = _motion.energy(t, state.data());
    const double momentum = _motion.momentum(t, state.data());
    state.segment(n, n) -= (1 + restitution) * approach / mobility * response;
    // What keeps the spin as it is gives an impulse, and the work of that impulse.
    const double impulse = _motion.momentum(t, state.data()) - momentum;
    const double work = _motion.spin(t, state.data()).speed * impulse;
    const double lost = before + work - _motion.energy(t, state.data());
    _created = std::max(_created, -lost / std::abs(before));
    state.tail<3>() += Eigen::Vector3d(work, lost, impulse);
    _impacts += rests ? 0 : 1;
    return true;
}

void DryEvents::pass(Event &event) {
    long done = 0;
    while (collide(event.time, event.state))
        if (++done > most_impacts_at_once)
            throw linalg::SolverError("balls collide without end at one moment");
    choose(event.time, event.state);
}

/// Opens the gap, or lets go the part, whose constraint is overstrained most.
bool DryEvents::free_the_worst() {
    DryState &dry = _motion.dry();
    double worst = -overstrained / 2;
    std::optional<std::size_t> gap;
    std::optional<std::size_t> part;
    for (std::size_t k = 0; k < dry.gaps.size(); ++k)
        if (const double share =
                _motion.pressure(k) / _motion.torque_scale(dry.gaps[k].second, _scale);
            dry.closed[k] && share < worst) {
            worst = share;
            gap = k;
        }
    for (std::size_t i = 0; i < dry.slip.size(); ++i)
        if (const double share =
                _motion.friction_reserve(i) / _motion.torque_scale(static_cast<int>(i), _scale);
            dry.stands(i) && share < worst) {
            worst = share;
            part = i;
        }
    if (part)
        dry.slip[*part] = _motion.holding_torque(*part) > 0 ? -1 : 1;
    else if (gap)
        dry.closed[*gap] = false;
    return part || gap;
}

/// All that could touch or stand does, until it would need to pull, or more friction than there is.
void DryEvents::choose(double t, Eigen::VectorXd &state) {
    DryState &dry = _motion.dry();
    double *angles = state.data() + _motion.first_angle();
    double *rates = angles + _motion.coordinates();
    const double slow = at_rest * _scale;
    for (std::size_t k = 0; k < dry.gaps.size(); ++k) {
        const Gap &gap = dry.gaps[k];
        dry.closed[k] = _motion.gap_of(gap, angles) <= 1e2 * touching &&
                        std::abs(rates[gap.second] - rates[gap.first]) <= slow;
    }
    for (std::size_t i = 0; i < dry.slip.size(); ++i) {
        if (!dry.resists[i])
            continue;
        dry.slip[i] = std::abs(rates[i]) <= slow ? 0 : rates[i] > 0 ? 1 : -1;
        if (dry.slip[i] == 0)
            rates[i] = 0; // what the integrator has left of it
    }
    const std::size_t most = dry.gaps.size() + dry.slip.size();
    for (std::size_t pass = 0; pass <= most; ++pass) {
        _motion.rates(t, state.data(), _rates.data());
        if (!free_the_worst())
            return;
    }
}

} // namespace whirl::simulation
