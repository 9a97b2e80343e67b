#include "tracking/hill/of_whole_rotor.h"

#include "modes/hill/series_modes_near.h"
#include "results/damping.h"
#include "tracking/bands/locked_whirl.h"
#include "tracking/crossing_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace whirl::tracking {

namespace {

/// Of what a rotor on few shapes has wrong, over the speed or the eigenvalue.
constexpr double farthest = 1e-5;

bool near(std::complex<double> a, std::complex<double> b, double speed) {
    return std::abs(a - b) <= farthest * std::max(std::abs(speed), std::abs(a));
}

} // namespace

modes::WhirlMode OfWholeRotor::of_all_unknowns(const modes::WhirlMode &mode) const {
    return modes::over_all_unknowns(mode, _few.shapes(), _few.unknowns());
}

bool OfWholeRotor::improve(modes::Spectrum &spectrum, const std::vector<int> &places,
                           bool all) const {
    std::vector<modes::WhirlMode> guesses;
    for (const int place : places)
        guesses.push_back(spectrum.modes[static_cast<std::size_t>(place)]);
    const Found found =
        spectrum.speed == 0 ? at_rest(guesses) : at_speed(spectrum.speed, guesses, all);
    bool each = true;
    for (std::size_t i = 0; i < found.size(); ++i) {
        modes::WhirlMode &mode = spectrum.modes[static_cast<std::size_t>(places[i])];
        if (found[i] && near(found[i]->eigenvalue, mode.eigenvalue, spectrum.speed))
            mode = *found[i];
        else
            mode.confirmed = each = false;
    }
    return each;
}

OfWholeRotor::Found
OfWholeRotor::at_speed(double speed, const std::vector<modes::WhirlMode> &guesses, bool all) const {
    Found found(guesses.size());
    for (std::size_t i = 0; i < guesses.size(); ++i) {
        const std::vector<modes::WhirlMode> one = _whole.near(speed, {of_all_unknowns(guesses[i])});
        if (!one.empty() && near(one[0].eigenvalue, guesses[i].eigenvalue, speed))
            found[i] = one[0];
        else if (all)
            return found;
    }
    Found out = found;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (found[i] && found[j] &&
                modes::met_twice({guesses[i].rotating_value, guesses[j].rotating_value},
                                 {found[i]->rotating_value, found[j]->rotating_value}))
                out[i] = out[j] = std::nullopt;
    return out;
}

/// Of the whole rotor's modes at rest, found at once, the nearest to each of the guesses.
OfWholeRotor::Found OfWholeRotor::at_rest(const std::vector<modes::WhirlMode> &guesses) const {
    constexpr std::size_t more = 4;
    std::vector<modes::WhirlMode> all = _whole.at(0, static_cast<int>(guesses.size() + more)).modes;
    Found out(guesses.size());
    for (std::size_t i = 0; i < guesses.size(); ++i) {
        const modes::WhirlMode &guess = guesses[i];
        const auto distance = [&](const modes::WhirlMode &mode) {
            return std::abs(mode.eigenvalue - guess.eigenvalue);
        };
        const auto nearest = std::ranges::min_element(all, {}, distance);
        if (nearest == all.end())
            return out;
        out[i] = *nearest;
        all.erase(nearest);
    }
    return out;
}

std::vector<OfWholeRotor::Next> OfWholeRotor::next_to(double multiple, double speed) const {
    constexpr std::size_t enough = 8;
    const double target = multiple * std::abs(speed);
    std::vector<Next> out;
    for (int wanted = _wanted;; wanted *= 2) {
        const modes::Spectrum few = _few.at(speed, wanted, modes::Errors::of_right_vectors);
        if (static_cast<int>(few.modes.size()) == wanted &&
            few.modes.back().eigenvalue.imag() < 1.5 * target)
            continue;
        for (const modes::WhirlMode &mode : few.modes)
            if (!(multiple == 1 && locked(mode, speed)))
                out.push_back({speed, mode.eigenvalue.imag() - target, mode});
        break;
    }
    std::ranges::sort(out, {}, [](const Next &a) { return std::abs(a.distance); });
    out.resize(std::min(enough, out.size()));
    return out;
}

std::optional<std::pair<OfWholeRotor::Next, OfWholeRotor::Next>>
OfWholeRotor::leaving(double multiple, double speed, double near, double far) const {
    constexpr double most = 0.2; // of twice the distance, and of the speed
    std::optional<std::pair<Next, Next>> out;
    double best = most;
    const std::vector<Next> there = next_to(multiple, speed + far);
    for (const Next &a : next_to(multiple, speed + near))
        for (const Next &b : there) {
            const double off =
                std::abs(std::abs(b.distance / a.distance) - 2) / 2 +
                std::abs(b.mode.eigenvalue.real() - a.mode.eigenvalue.real()) / std::abs(speed);
            if (a.distance != 0 && std::abs(a.distance) < most * std::abs(speed) && off < best) {
                best = off;
                out = {a, b};
            }
        }
    return out;
}

std::optional<OfWholeRotor::Next> OfWholeRotor::of_whole(double multiple, const Next &few) const {
    const std::vector<modes::WhirlMode> whole = _whole.near(few.speed, {of_all_unknowns(few.mode)});
    if (whole.empty() || !near(whole[0].eigenvalue, few.mode.eigenvalue, few.speed))
        return std::nullopt;
    return Next{few.speed, whole[0].eigenvalue.imag() - multiple * std::abs(few.speed), whole[0]};
}

/// The few shapes' root with what the whole rotor's distance is there, or just beside, and its
/// slope: a motion on the multiple itself is taken for one that stays there.
std::optional<OfWholeRotor::Place> OfWholeRotor::crossing(double multiple, double speed) const {
    constexpr double beside = 1e-6;
    const double step = beside * std::abs(speed);
    std::optional<Place> out = crossing(multiple, speed, speed, step);
    return out ? out : crossing(multiple, speed, speed + step, step);
}

/// @param at  where distances are taken, and so far beyond, rad/s
std::optional<OfWholeRotor::Place> OfWholeRotor::crossing(double multiple, double speed, double at,
                                                          double step) const {
    const std::vector<Next> here = next_to(multiple, at);
    if (here.empty())
        return std::nullopt;
    const auto distance = [&](const Next &other) {
        return std::abs(other.mode.eigenvalue - here[0].mode.eigenvalue);
    };
    const std::vector<Next> all = next_to(multiple, at + step);
    const auto there = std::ranges::min_element(all, {}, distance);
    const auto whole = of_whole(multiple, here[0]);
    if (there == all.end() || !whole)
        return std::nullopt;
    const double slope = (there->distance - here[0].distance) / step;
    const double change = at - speed - whole->distance / slope;
    if (!(std::abs(change) <= farthest * std::abs(speed)))
        return std::nullopt;
    return Place{speed + change, whole->mode.eigenvalue.real()};
}

/// Outside a band the square of the distance is smooth up to its end and beyond: there, what both
/// rotors differ by moves the end by that over the slope.
std::optional<OfWholeRotor::Place> OfWholeRotor::band_end(double multiple, double speed,
                                                          double outwards) const {
    const auto few = leaving(multiple, speed, outwards / 4, outwards);
    if (!few)
        return std::nullopt;
    const auto near = of_whole(multiple, few->first);
    const auto far = of_whole(multiple, few->second);
    if (!near || !far)
        return std::nullopt;
    const auto square = [](const Next &a) { return a.distance * a.distance; };
    const auto at_end = [](double a, double b) { return (4 * a - b) / 3; }; // a line's at 0
    const double difference =
        at_end(square(*near) - square(few->first), square(*far) - square(few->second));
    const double slope =
        at_end(square(few->first) / (outwards / 4), square(few->second) / outwards);
    const double change = -difference / slope;
    if (!(std::abs(change) <= std::min(std::abs(outwards), farthest * std::abs(speed))))
        return std::nullopt;
    return Place{speed + change, at_end(near->mode.eigenvalue.real(), far->mode.eigenvalue.real())};
}

void OfWholeRotor::improve(Crossings &crossed, double low, double high) const {
    constexpr double least_part = 0.02; // of the way to the next end of any band
    constexpr double most = 1e-3;       // of the speed
    std::map<std::pair<double, double>, std::optional<Place>> ends; // by multiple and speed
    const auto way = [&](double multiple, double speed) {
        double least = std::min(most * std::abs(speed), std::min(speed - low, high - speed));
        for (const results::Locked &other : crossed.locked)
            for (const double end : {other.from, other.to})
                if (other.multiple == multiple && end != speed)
                    least = std::min(least, std::abs(end - speed));
        return least_part * least;
    };
    for (const results::Locked &band : crossed.locked)
        for (const auto &[speed, side] : {std::pair(band.from, -1.0), std::pair(band.to, 1.0)})
            if (speed > low && speed < high && speed != 0 &&
                ends.count({band.multiple, speed}) == 0)
                ends[{band.multiple, speed}] =
                    band_end(band.multiple, speed, side * way(band.multiple, speed));
    for (const auto &[end, place] : ends)
        if (!place)
            crossed.unconfirmed.push_back(end.second);
    for (results::Locked &band : crossed.locked)
        for (double *speed : {&band.from, &band.to})
            if (const auto end = ends.find({band.multiple, *speed});
                end != ends.end() && end->second)
                *speed = end->second->speed;
    for (results::Crossing &c : crossed.found) {
        const auto end = ends.find({c.multiple, c.speed});
        const auto place = end != ends.end() ? end->second : crossing(c.multiple, c.speed);
        if (!place) {
            if (end == ends.end())
                crossed.unconfirmed.push_back(c.speed);
            continue;
        }
        const bool undamped = c.damping.ratio == 0.0;
        c.speed = place->speed;
        c.frequency = c.multiple * std::abs(c.speed);
        c.damping = results::damping_of({undamped ? 0 : place->real, c.frequency});
    }
}

} // namespace whirl::tracking
