#include "tracking/mode_matching.h"

#include "tracking/bands/locked_whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace whirl::tracking {

namespace {

/// An overlap above this cannot belong to two modes: overlaps of one mode with the modes of
/// another speed sum to 1.
constexpr double sure = 0.7;
/// Nor where another mode has more than this share of it: vectors of damped modes are not
/// orthogonal, and large overlaps may cancel.
constexpr double rival = 0.6;
/// Below this it is no continuation at all.
constexpr double possible = 0.25;
/// A mode that has this share of itself in a group of modes belongs to it.
constexpr double belongs = 0.6;

bool is_zero(const modes::Spectrum &spectrum, Eigen::Index i) {
    return spectrum.modes[static_cast<std::size_t>(i)].eigenvalue == 0.0;
}

Eigen::MatrixXd overlaps_of(const Snapshot &a, const Snapshot &b) {
    const auto rows = std::ssize(a.spectrum.modes);
    const auto columns = std::ssize(b.spectrum.modes);
    if (rows == 0 || columns == 0)
        return Eigen::MatrixXd::Zero(rows, columns);
    Eigen::MatrixXd overlap = modes::overlaps(a.basis, b.basis);
    // Zero modes of a free rotor differ in nothing but their order, which is always the same.
    for (Eigen::Index i = 0; i < std::min(rows, columns); ++i) {
        if (!is_zero(a.spectrum, i) || !is_zero(b.spectrum, i))
            break;
        overlap.row(i).setZero();
        overlap.col(i).setZero();
        overlap(i, i) = 1;
    }
    return overlap;
}

void join(Matching &matching, Eigen::Index i, Eigen::Index j) {
    matching.to[static_cast<std::size_t>(i)] = static_cast<int>(j);
    matching.from[static_cast<std::size_t>(j)] = static_cast<int>(i);
}

Matching nothing_matched(const Snapshot &a, const Snapshot &b) {
    return {std::vector<int>(a.spectrum.modes.size(), Matching::none),
            std::vector<int>(b.spectrum.modes.size(), Matching::none), false, false};
}

bool is_sure(const Eigen::MatrixXd &overlap, Eigen::Index i, Eigen::Index j) {
    const double own = overlap(i, j);
    if (own < sure)
        return false;
    for (Eigen::Index k = 0; k < overlap.cols(); ++k)
        if (k != j && overlap(i, k) > rival * own)
            return false;
    for (Eigen::Index k = 0; k < overlap.rows(); ++k)
        if (k != i && overlap(k, j) > rival * own)
            return false;
    return true;
}

/// Pairs (cost, i, j) taken in ascending order of cost, each row and column once.
using Candidates = std::vector<std::tuple<double, Eigen::Index, Eigen::Index>>;
void take_best(Candidates candidates, Matching &matching) {
    std::ranges::sort(candidates);
    for (const auto &[cost, i, j] : candidates)
        if (matching.to[static_cast<std::size_t>(i)] == Matching::none &&
            matching.from[static_cast<std::size_t>(j)] == Matching::none)
            join(matching, i, j);
}

std::complex<double> value(const modes::Spectrum &spectrum, Eigen::Index i) {
    return spectrum.modes[static_cast<std::size_t>(i)].eigenvalue;
}

/// Frequency in rotating axes, over the spin speed, below which a mode is nearly at rest there.
constexpr double near_standstill = 1e-3;

/// Two modes of different speeds, one of which stands still in the rotor (its eigenvalue in
/// rotating axes is real) while the other does nearly so: how far apart their eigenvalues in
/// rotating axes are, where one can become the other. Such a pair has met on the real axis between
/// the two speeds, where both vectors become one: overlaps say nothing there. Nor do they where
/// both stand still beside others of the same eigenvalue, as balls of several balancers do at low
/// speeds; such lines lie on each other.
std::optional<double> distance_at_lock(const Snapshot &at_a, const Snapshot &at_b, Eigen::Index i,
                                       Eigen::Index j) {
    const modes::Spectrum &a = at_a.spectrum;
    const modes::Spectrum &b = at_b.spectrum;
    const results::Form form =
        at_a.basis.of_series() ? results::Form::hill : results::Form::rotating;
    const modes::WhirlMode &one = a.modes[static_cast<std::size_t>(i)];
    const modes::WhirlMode &other = b.modes[static_cast<std::size_t>(j)];
    if (one.rotating_vector.size() == 0 || other.rotating_vector.size() == 0)
        return std::nullopt;
    const double speed = std::abs(b.speed);
    const std::complex<double> value_a(one.rotating_value.real(),
                                       turn_in_rotor(one, a.speed, form));
    const std::complex<double> value_b(other.rotating_value.real(),
                                       turn_in_rotor(other, b.speed, form));
    const double slow = std::max(value_a.imag(), value_b.imag());
    const double distance = std::abs(value_a - value_b);
    const bool locks = locked(one, a.speed) != locked(other, b.speed);
    // One may be just before the meeting and the other far behind it.
    constexpr double behind = 1e-2;
    const bool becomes =
        locks && slow <= 0.5 * speed && distance <= std::max(3 * slow, behind * speed);
    const bool stays = slow <= near_standstill * speed && distance <= near_standstill * speed;
    return becomes || stays ? std::optional(distance) : std::nullopt;
}

/// Square of the distance of the eigenvalue at b from where that at a goes with the mean of both
/// slopes.
double squared_discontinuity(const Snapshot &a, const Snapshot &b, Eigen::Index i, Eigen::Index j) {
    const double step = b.spectrum.speed - a.spectrum.speed;
    const std::complex<double> before = step > 0 ? a.basis.rate_above(i) : a.basis.rate_below(i);
    const std::complex<double> after = step > 0 ? b.basis.rate_below(j) : b.basis.rate_above(j);
    const std::complex<double> change = (before + after) / 2.0 * step;
    const std::complex<double> difference = value(b.spectrum, j) - value(a.spectrum, i);
    const bool known = std::isfinite(change.real()) && std::isfinite(change.imag());
    return std::norm(known ? difference - change : difference);
}

/// The mode of b where a mode of a goes with its slope, ten times nearer than the next one; or
/// none.
int expected_at(const Snapshot &a, const Snapshot &b, Eigen::Index i) {
    double nearest = std::numeric_limits<double>::infinity();
    double next = nearest;
    int place = Matching::none;
    for (Eigen::Index j = 0; j < std::ssize(b.spectrum.modes); ++j) {
        const double distance = squared_discontinuity(a, b, i, j);
        if (distance < nearest) {
            next = std::exchange(nearest, distance);
            place = static_cast<int>(j);
        } else {
            next = std::min(next, distance);
        }
    }
    return nearest < 0.1 * 0.1 * next ? place : Matching::none;
}

/// By the vectors of a mode at two speeds.
bool nearly_alike(const modes::ModeBasis &a, const modes::ModeBasis &b, Eigen::Index i,
                  Eigen::Index j) {
    // The product is 1 for a mode and itself and 0 for two modes of one speed.
    constexpr double nearly = 0.1;
    return std::abs(modes::overlap(a, b, i, j) - 1.0) < nearly;
}

/// The plain case, without the products of all modes with all others: every mode is where its slope
/// leads, far from the others, and its vectors are nearly the same.
std::optional<Matching> continued(const Snapshot &a, const Snapshot &b) {
    const std::size_t count = a.spectrum.modes.size();
    if (count == 0 || count != b.spectrum.modes.size() || !a.basis.is_complex() ||
        !a.basis.aliases.empty() || is_zero(a.spectrum, 0) || is_zero(b.spectrum, 0))
        return std::nullopt;
    Matching out = nothing_matched(a, b);
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(count); ++i) {
        const int j = expected_at(a, b, i);
        if (j == Matching::none || out.from[static_cast<std::size_t>(j)] != Matching::none ||
            !nearly_alike(a.basis, b.basis, i, j))
            return std::nullopt;
        join(out, i, j);
    }
    return out;
}

/// Whether nothing goes on from a mode at rest: it stands still there.
bool stands_at_rest(const Snapshot &here, Eigen::Index i, const Snapshot &there) {
    return there.spectrum.speed == 0 &&
           fate(here.spectrum, static_cast<int>(i), there.spectrum) == Absence::overdamped;
}

} // namespace

Matching match_by_vectors(const Snapshot &a, const Snapshot &b, int important) {
    if (const std::optional<Matching> plain = continued(a, b))
        return *plain;
    const Eigen::MatrixXd overlap = overlaps_of(a, b);
    const std::vector<char> low_a = a.spectrum.lowest(important);
    const std::vector<char> low_b = b.spectrum.lowest(important);
    const auto is_low = [](const std::vector<char> &low, auto place) {
        return low[static_cast<std::size_t>(place)] != 0;
    };
    Matching out = nothing_matched(a, b);
    Candidates candidates;
    for (Eigen::Index i = 0; i < overlap.rows(); ++i)
        for (Eigen::Index j = 0; j < overlap.cols(); ++j)
            if (overlap(i, j) >= possible)
                candidates.emplace_back(-overlap(i, j), i, j);
    take_best(std::move(candidates), out);
    const auto ends = [](const Snapshot &here, Eigen::Index i, const Snapshot &there) {
        const Absence why = fate(here.spectrum, static_cast<int>(i), there.spectrum);
        return why == Absence::overdamped || why == Absence::divergent;
    };
    bool unsure = false;
    bool ended = false;
    for (Eigen::Index i = 0; i < overlap.rows(); ++i) {
        const int j = out.to[static_cast<std::size_t>(i)];
        if (j == Matching::none && is_low(low_a, i) && !stands_at_rest(a, i, b))
            (ends(a, i, b) ? ended : unsure) = true;
        if (j != Matching::none && (is_low(low_a, i) || is_low(low_b, j)))
            unsure = unsure || !is_sure(overlap, i, j);
    }
    for (Eigen::Index j = 0; j < overlap.cols(); ++j)
        if (is_low(low_b, j) && out.from[static_cast<std::size_t>(j)] == Matching::none &&
            !stands_at_rest(b, j, a))
            (ends(b, j, a) ? ended : unsure) = true;
    out.ambiguous = unsure || ended;
    out.but_for_ends = ended && !unsure;
    return out;
}

bool may_veer(const Snapshot &a, const Snapshot &b, const Matching &matching, int important,
              bool planar) {
    // Of a veering as wide as a hundredth of a step this much is left at the ends of the step.
    constexpr double hardly = 1e-4;
    const auto &modes = a.spectrum.modes;
    const std::vector<char> low_a = a.spectrum.lowest(important);
    const std::vector<char> low_b = b.spectrum.lowest(important);
    const auto next = [&](std::size_t i) { return static_cast<std::size_t>(matching.to[i]); };
    const auto mixed = [&](std::size_t i, std::size_t j) {
        return std::abs(modes::overlap(a.basis, b.basis, static_cast<Eigen::Index>(i),
                                       static_cast<Eigen::Index>(j))) > hardly;
    };
    for (std::size_t k = 1; k < modes.size(); ++k)
        for (std::size_t i = 0; i < k; ++i)
            if (low_a[i] != 0 && matching.to[i] > matching.to[k] &&
                matching.to[k] != Matching::none && low_b[next(k)] != 0 &&
                modes[i].rotating_vector.size() == 0 &&
                !(planar && modes[i].whirl != modes[k].whirl) &&
                (mixed(i, next(k)) || mixed(k, next(i))))
                return true;
    return false;
}

namespace {

bool heavily_damped(std::complex<double> eigenvalue) {
    constexpr double heavily = 0.3; // |Re| over Im
    return -eigenvalue.real() > heavily * eigenvalue.imag();
}

} // namespace

bool may_turn_real(const Snapshot &a, const Snapshot &b, const Matching &matching) {
    constexpr int parts = 16; // of the step, in which a cubic is tried
    const double step = b.spectrum.speed - a.spectrum.speed;
    for (std::size_t i = 0; i < matching.to.size(); ++i) {
        const int j = matching.to[i];
        if (j == Matching::none)
            continue;
        const auto place = static_cast<Eigen::Index>(i);
        const std::complex<double> from = value(a.spectrum, place);
        const std::complex<double> to = value(b.spectrum, j);
        const double rate_a = (step > 0 ? a.basis.rate_above : a.basis.rate_below)(place).imag();
        const double rate_b = (step > 0 ? b.basis.rate_below : b.basis.rate_above)(j).imag();
        if (!heavily_damped(from) || !heavily_damped(to) || !std::isfinite(rate_a) ||
            !std::isfinite(rate_b))
            continue;
        const double d0 = from.imag() * from.imag();
        const double d1 = to.imag() * to.imag();
        const double s0 = 2 * from.imag() * rate_a * step;
        const double s1 = 2 * to.imag() * rate_b * step;
        const double least =
            std::pow(modes::real_axis, 2) * std::min(std::norm(from), std::norm(to));
        for (int part = 1; part < parts; ++part) {
            const double u = static_cast<double>(part) / parts;
            const double v = 1 - u;
            if (v * v * ((1 + 2 * u) * d0 + u * s0) + u * u * ((3 - 2 * u) * d1 - v * s1) < least)
                return true;
        }
    }
    return false;
}

Matching match_by_groups(const Snapshot &a, const Snapshot &b) {
    const Eigen::MatrixXd overlap = overlaps_of(a, b);
    Matching out = nothing_matched(a, b);
    for (Eigen::Index i = 0; i < overlap.rows(); ++i)
        for (Eigen::Index j = 0; j < overlap.cols(); ++j)
            if (is_sure(overlap, i, j))
                join(out, i, j);
    // Of the rest each mode must lie in the space of the modes it may become.
    Eigen::VectorXd row = Eigen::VectorXd::Zero(overlap.rows());
    Eigen::VectorXd column = Eigen::VectorXd::Zero(overlap.cols());
    const auto open = [&out](Eigen::Index i, Eigen::Index j) {
        return out.to[static_cast<std::size_t>(i)] == Matching::none &&
               out.from[static_cast<std::size_t>(j)] == Matching::none;
    };
    for (Eigen::Index i = 0; i < overlap.rows(); ++i)
        for (Eigen::Index j = 0; j < overlap.cols(); ++j)
            if (open(i, j)) {
                row(i) += overlap(i, j);
                column(j) += overlap(i, j);
            }
    Candidates candidates;
    for (Eigen::Index i = 0; i < overlap.rows(); ++i)
        for (Eigen::Index j = 0; j < overlap.cols(); ++j)
            if (open(i, j) && row(i) >= belongs && column(j) >= belongs &&
                overlap(i, j) > 0.05 * row(i)) // else of another group
                candidates.emplace_back(squared_discontinuity(a, b, i, j), i, j);
    take_best(std::move(candidates), out);
    Candidates locks;
    for (Eigen::Index i = 0; i < overlap.rows(); ++i)
        for (Eigen::Index j = 0; j < overlap.cols(); ++j)
            if (open(i, j))
                if (const auto distance = distance_at_lock(a, b, i, j))
                    locks.emplace_back(*distance, i, j);
    take_best(std::move(locks), out);
    return out;
}

void keep_larger_parts(const Snapshot &a, const Snapshot &b, std::vector<int> &to) {
    if (!a.basis.of_series())
        return;
    const auto turns = [&](std::size_t i, int j) {
        return a.spectrum.modes[i].whirl != b.spectrum.modes[static_cast<std::size_t>(j)].whirl;
    };
    const auto change = [&](std::size_t i, int j) {
        return std::abs(value(b.spectrum, j) - value(a.spectrum, static_cast<Eigen::Index>(i)));
    };
    // Of the change: only where values leave no doubt that two modes were exchanged.
    constexpr double much_less = 0.1;
    const auto exchange = [&](std::size_t i, std::size_t k) {
        return to[i] != Matching::none && to[k] != Matching::none && turns(i, to[i]) &&
               turns(k, to[k]) && !turns(i, to[k]) && !turns(k, to[i]) &&
               change(i, to[k]) + change(k, to[i]) <
                   much_less * (change(i, to[i]) + change(k, to[k]));
    };
    for (std::size_t i = 0; i < to.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (exchange(i, k))
                std::swap(to[i], to[k]);
}

Absence fate(const modes::Spectrum &here, int place, const modes::Spectrum &there) {
    const modes::WhirlMode &mode = here.modes[static_cast<std::size_t>(place)];
    const bool relaxes = here.relaxation.relaxes(mode.eigenvalue);
    const std::complex<double> l =
        relaxes ? here.relaxation.in_rotating_axes(mode.eigenvalue, here.speed) : mode.eigenvalue;
    const double size = std::abs(l);
    // Two complex eigenvalues that meet on the real axis part along it as fast as they came.
    const double window = std::max(3 * l.imag(), 0.1 * size);
    const auto near = [&](double real) { return std::abs(real - l.real()) <= window; };
    const auto count = [&](const std::vector<double> &reals) {
        return std::ranges::count_if(reals, near);
    };
    // Balls that stand still in the rotor: at rest nothing whirls, and what hardly moves them at
    // low speeds is lost in rounding.
    constexpr double hardly = 1e-9;
    const double still = (there.speed == 0 ? near_standstill : hardly) * std::abs(here.speed);
    if (mode.rotating_vector.size() > 0 && mode.frequency_rotating <= still &&
        (there.speed == 0 || std::abs(mode.rotating_value) <= still))
        return Absence::overdamped;
    if (l.imag() <= 0.5 * size && count(there.overdamped) > count(here.overdamped))
        return count(there.growing) > count(here.growing) ? Absence::divergent
                                                          : Absence::overdamped;
    double highest = 0;
    for (const modes::WhirlMode &other : there.modes)
        highest = std::max(highest, other.eigenvalue.imag());
    if (std::abs(mode.eigenvalue) >= 0.9 * there.complete_radius ||
        mode.eigenvalue.imag() >= 0.9 * highest)
        return Absence::beyond;
    return Absence::lost;
}

} // namespace whirl::tracking
