#include "simulation/dry/dry_events.h"

#include "linalg/check.h"
#include "linalg/dense/least_squares.h"
#include "linalg/roots.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::simulation {

namespace {

/// rad: parts nearer than that touch. The distance of parts that touch is wrong by no more.
constexpr double touching = 1e-11;
/// Of the scale of rates: parts that meet slower than that stay together, or bounce would follow
/// bounce without end. The energy of that motion is lost: 1e-10 of theirs.
constexpr double together = 1e-5;
/// Of the scale of rates: how fast parts that stay together may still approach, by rounding.
constexpr double still = 1e-12;
/// Of the scale of rates: how far a part that comes to rest moves on before it is seen.
constexpr double seen = 1e-9;
/// Of the scale of rates: a part slower than that relative to the rotor stands, and two that come
/// apart slower than that touch. The energy of that motion is lost: 1e-17 of its own.
constexpr double at_rest = 2 * seen;
/// Of the torque m R^2 scale^2: how far a constraint may be overstrained.
constexpr double overstrained = 1e-9;
constexpr int pieces = 4; ///< in which gaps are looked at between the ends of a step
constexpr long most_impacts_at_once = 1000;
constexpr long most_events_at_once = 1000;

/// Value and slope at the ends of a step make a cubic.
double cubic(double a, double da, double b, double db, double length, double s) {
    const double s2 = s * s;
    const double s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * length * da + (3 * s2 - 2 * s3) * b +
           (s3 - s2) * length * db;
}

} // namespace

DryEvents::DryEvents(RotorMotion &motion, double scale, std::unique_ptr<OdeSolver> solver)
    : _motion(motion), _scale(scale), _solver(std::move(solver)),
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
        const double strain = overstrained * _motion.torque_scale(dry.gaps[k].part(), _scale);
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

/// A gap that is open at both ends of a step may close in between: after this share of it.
std::optional<double> DryEvents::dip(const Gap &gap, const double *before, const double *after,
                                     double length) const {
    const double a = _motion.gap_of(gap, before + _motion.first_angle());
    const double b = _motion.gap_of(gap, after + _motion.first_angle());
    const double da = _motion.opening(gap, before);
    const double db = _motion.opening(gap, after);
    for (int i = 1; i < pieces && a > -touching; ++i) // else they come apart
        if (const double share = static_cast<double>(i) / pieces;
            cubic(a, da, b, db, length, share) < -touching)
            return share;
    return std::nullopt;
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
    for (std::size_t k = 0; k < dry.gaps.size() && suspects.empty(); ++k)
        if (const auto share = dip(dry.gaps[k], before.data(), after, to - from);
            share && !dry.closed[k]) {
            suspects.push_back(k);
            end *= *share;
        }
    if (suspects.empty())
        return std::nullopt;
    const auto state_at = [&](double since) {
        if (from + since <= from + 1e-14 * std::abs(from))
            return before.data();
        double t = from;
        _solver->start(t, before.data(), since);
        while (t < from + since)
            t = _solver->step(from + since);
        return _solver->state();
    };
    std::optional<double> moment;
    for (const std::size_t i : suspects)
        if (const auto earlier = first_moment(i, {from, moment.value_or(end), state_at}))
            moment = earlier;
    if (!moment)
        return std::nullopt;
    return Event{from + *moment,
                 Eigen::Map<const Eigen::VectorXd>(state_at(*moment), _motion.size())};
}

/// Seconds after the start of a piece at which a value has become 0; none: it has not, or its parts
/// come apart, but a little closer than they should be.
std::optional<double> DryEvents::first_moment(std::size_t i, const Piece &piece) {
    const auto value = [&](double since) {
        return values(piece.from + since, piece.state_at(since))[i];
    };
    const double first = value(0);
    const double last = value(piece.length);
    if (last > 0)
        return std::nullopt;
    if (first > 0)
        return linalg::root_between(value, 0, first, piece.length, last, 1e-12);
    if (i >= _motion.dry().gaps.size() || _motion.dry().closed[i])
        return 1e-3 * piece.length; // already past: at once
    const auto opening = [&](double since) {
        return _motion.opening(_motion.dry().gaps[i], piece.state_at(since));
    };
    const double late = opening(piece.length);
    const double early = opening(0);
    if (late >= 0)
        return std::nullopt;
    if (early <= 0)
        return 1e-3 * piece.length;
    const double top = linalg::root_between(opening, 0, early, piece.length, late, 1e-3);
    const double most = value(top);
    return most > 0 ? linalg::root_between(value, top, most, piece.length, last, 1e-12)
                    : piece.length;
}

/// The pair that approaches fastest of those that touch. @returns whether there was one.
bool DryEvents::collide(double t, Eigen::VectorXd &state) {
    const DryState &dry = _motion.dry();
    const double *angles = state.data() + _motion.first_angle();
    const Gap *worst = nullptr;
    double approach = -together * _scale;
    for (const Gap &gap : dry.gaps) {
        const double rate = _motion.opening(gap, state.data());
        if (_motion.gap_of(gap, angles) <= 2 * touching && rate < approach) {
            worst = &gap;
            approach = rate;
        }
    }
    if (!worst)
        return false;
    const Eigen::VectorXd response = _motion.impulse_response(t, state.data(), *worst);
    const Eigen::Index at = _motion.first_angle();
    const double mobility = worst->between(response.data() + at);
    jump(t, state, -(1 + worst->restitution) * approach / mobility * response);
    ++_impacts;
    return true;
}

/// Changes the velocities and keeps the books.
void DryEvents::jump(double t, Eigen::VectorXd &state, const Eigen::VectorXd &change) {
    const RotorMotion::Totals before = _motion.totals(t, state.data());
    state.segment(change.size(), change.size()) += change;
    const RotorMotion::Totals after = _motion.totals(t, state.data());
    // What keeps the spin as it is gives an impulse, and the work of that impulse.
    const double impulse = after.momentum - before.momentum;
    const double work = _motion.spin(t, state.data()).speed * impulse;
    const double lost = before.energy + work - after.energy;
    _created = std::max(_created, -lost / std::abs(before.energy));
    state.tail<3>() += Eigen::Vector3d(work, lost, impulse);
}

/// Ends what is left of the motion of the two of each of these gaps relative to each other, of all
/// at once: the impulses that do so take energy, whatever their signs.
void DryEvents::settle(double t, Eigen::VectorXd &state, const std::vector<bool> &which) {
    std::vector<const Gap *> gaps;
    double fastest = 0;
    for (std::size_t k = 0; k < which.size(); ++k)
        if (which[k]) {
            gaps.push_back(&_motion.dry().gaps[k]);
            fastest = std::max(fastest, std::abs(_motion.opening(*gaps.back(), state.data())));
        }
    if (fastest <= still * _scale)
        return;
    const auto n = static_cast<Eigen::Index>(gaps.size());
    Eigen::MatrixXd responses(_motion.coordinates(), n);
    Eigen::VectorXd rates(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const Gap &gap = *gaps[static_cast<std::size_t>(k)];
        responses.col(k) = _motion.impulse_response(t, state.data(), gap);
        rates(k) = _motion.opening(gap, state.data());
    }
    Eigen::MatrixXd mobility(n, n);
    const Eigen::Index at = _motion.first_angle();
    for (Eigen::Index k = 0; k < n; ++k) {
        for (Eigen::Index m = 0; m < n; ++m)
            mobility(k, m) =
                gaps[static_cast<std::size_t>(k)]->between(responses.col(m).data() + at);
    }
    const Eigen::VectorXd impulses = linalg::least_squares(mobility, rates);
    jump(t, state, -(responses * impulses));
}

void DryEvents::pass(Event &event) {
    constexpr double at_once = 1e-14; // of the time itself: rounding
    _at_once = event.time - _last <= at_once * event.time ? _at_once + 1 : 0;
    _last = event.time;
    if (_at_once > most_events_at_once)
        throw linalg::SolverError("balls begin to move and come to rest without end at one moment");
    long done = 0;
    do {
        while (collide(event.time, event.state))
            if (++done > most_impacts_at_once)
                throw linalg::SolverError("balls collide without end at one moment");
        choose(event.time, event.state);
    } while (collide(event.time, event.state));
}

/// Opens the gap, or lets go the part, whose constraint is overstrained most; holds again those
/// that the freedom of others has turned back: a gap that would close, a part that would move
/// against its sense. @returns whether anything was to be changed.
/// @param first  the first of them in place of the worst: K. G. Murty's rule, that ends
bool DryEvents::amend(const Candidates &near, bool first) {
    DryState &dry = _motion.dry();
    const double *accelerations = _rates.data() + _motion.coordinates() + _motion.first_angle();
    double worst = 0;
    std::function<void()> change;
    const auto propose = [&](double excess, std::function<void()> how) {
        if (excess > worst && !(first && change)) {
            worst = excess;
            change = std::move(how);
        }
    };
    // A wall that a part is pressed against keeps it from turning back.
    const auto leans = [&dry](std::size_t i) {
        for (std::size_t k = 0; k < dry.gaps.size(); ++k)
            if (const Gap &gap = dry.gaps[k]; dry.closed[k] &&
                                              std::min(gap.first, gap.second) < 0 &&
                                              gap.part() == static_cast<int>(i))
                return true;
        return false;
    };
    for (std::size_t i = 0; i < dry.slip.size(); ++i) {
        if (!near.parts[i] || !dry.resists[i] || (!dry.stands(i) && leans(i)))
            continue;
        const double scale = _motion.torque_scale(static_cast<int>(i), _scale);
        if (!dry.stands(i))
            propose(-dry.slip[i] * accelerations[i] / (_scale * _scale),
                    [&dry, i] { dry.slip[i] = 0; });
        else if (const double reserve = _motion.friction_reserve(i) / scale;
                 reserve < -overstrained / 2)
            propose(-reserve, [&dry, i, sense = _motion.holding_torque(i) > 0 ? -1 : 1] {
                dry.slip[i] = sense;
            });
    }
    for (std::size_t k = 0; k < dry.gaps.size(); ++k) {
        if (!near.gaps[k])
            continue;
        const Gap &gap = dry.gaps[k];
        const double scale = _motion.torque_scale(gap.part(), _scale);
        if (!dry.closed[k])
            propose(-gap.between(accelerations) / (_scale * _scale),
                    [&dry, k] { dry.closed[k] = true; });
        else if (const double pressure = _motion.pressure(k) / scale; pressure < -overstrained / 2)
            propose(-pressure, [&dry, k] { dry.closed[k] = false; });
    }
    if (change)
        change();
    return static_cast<bool>(change);
}

/// All that could touch or stand does, until it would need to pull, or more friction than there is.
void DryEvents::choose(double t, Eigen::VectorXd &state) {
    DryState &dry = _motion.dry();
    const double *angles = state.data() + _motion.first_angle();
    for (std::size_t k = 0; k < dry.gaps.size(); ++k) {
        const double rate = _motion.opening(dry.gaps[k], state.data());
        dry.closed[k] = _motion.gap_of(dry.gaps[k], angles) <= 1e2 * touching &&
                        rate >= -together * _scale && rate <= at_rest * _scale;
    }
    Candidates near{dry.closed, std::vector<bool>(dry.slip.size())};
    settle(t, state, near.gaps);
    const double *rates = angles + _motion.coordinates();
    for (std::size_t i = 0; i < dry.slip.size(); ++i) {
        near.parts[i] = std::abs(rates[i]) <= at_rest * _scale;
        dry.slip[i] = near.parts[i] ? 0 : rates[i] > 0 ? 1 : -1;
    }
    stop_parts_at_rest(t, state);
    const auto resisting = static_cast<std::size_t>(std::ranges::count(dry.resists, true));
    const std::size_t most = 4 * (dry.gaps.size() + resisting);
    std::size_t pass = 0;
    do {
        if (++pass > 50 * most)
            throw linalg::SolverError("it is not clear which balls stand and touch");
        _motion.rates(t, state.data(), _rates.data());
    } while (amend(near, pass > most));
}

/// What the integrator has left of the motion of parts that stand.
void DryEvents::stop_parts_at_rest(double t, Eigen::VectorXd &state) {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(_motion.coordinates());
    for (std::size_t i = 0; i < _motion.dry().slip.size(); ++i) {
        const Eigen::Index at = _motion.first_angle() + static_cast<Eigen::Index>(i);
        if (_motion.dry().stands(i))
            change(at) = -state(_motion.coordinates() + at);
    }
    if (!change.isZero(0))
        jump(t, state, change);
}

} // namespace whirl::simulation
