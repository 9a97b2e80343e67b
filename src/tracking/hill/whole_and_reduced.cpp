#include "tracking/hill/whole_and_reduced.h"

#include "modes/hill/series_modes_near.h"
#include "results/damping.h"
#include "tracking/bands/locked_whirl.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace whirl::tracking {

namespace {

/// Error of the reduced rotor, over the speed or the eigenvalue.
constexpr double farthest = 1e-4;

bool near(std::complex<double> a, std::complex<double> b, double speed) {
    return std::abs(a - b) <= farthest * std::max(std::abs(speed), std::abs(a));
}

using Modes = std::vector<std::optional<modes::WhirlMode>>;

/// A speed at which a line crosses or a band ends, and the real part there.
struct Place {
    double speed = 0;                ///< rad/s
    double real = 0;                 ///< 1/s
    std::optional<double> by_mesh{}; ///< of the speed, change by finer elements
};
/// A mode next to a multiple of the spin speed.
struct Next {
    double speed = 0;    ///< rad/s
    double distance = 0; ///< of its frequency from the multiple, rad/s
    modes::WhirlMode mode;
};

/// The mode of the whole rotor next to one of the reduced rotor, if there is one.
std::optional<modes::WhirlMode> of_whole(const WholeAndReduced &rotors, double speed,
                                         const modes::WhirlMode &mode) {
    const std::vector<modes::WhirlMode> found = rotors.whole.near(
        speed,
        {modes::over_all_unknowns(mode, rotors.reduced.shapes(), rotors.reduced.unknowns())});
    return !found.empty() && near(found[0].eigenvalue, mode.eigenvalue, speed)
               ? std::optional(found[0])
               : std::nullopt;
}

/// One by one: those next to their guesses, none of them met from two guesses.
Modes at_speed(const WholeAndReduced &rotors, double speed,
               const std::vector<modes::WhirlMode> &guesses, bool all) {
    Modes found(guesses.size());
    for (std::size_t i = 0; i < guesses.size(); ++i) {
        found[i] = of_whole(rotors, speed, guesses[i]);
        if (!found[i] && all)
            return found;
    }
    Modes out = found;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (found[i] && found[j] &&
                modes::met_twice({guesses[i].rotating_value, guesses[j].rotating_value},
                                 {found[i]->rotating_value, found[j]->rotating_value}))
                out[i] = out[j] = std::nullopt;
    return out;
}

/// Of the whole rotor's modes at rest, found at once, the nearest to each of the guesses.
Modes at_rest(const WholeAndReduced &rotors, const std::vector<modes::WhirlMode> &guesses) {
    constexpr std::size_t more = 4; // modes above the last guess, should their order differ
    std::vector<modes::WhirlMode> all =
        rotors.whole.at(0, static_cast<int>(guesses.size() + more)).modes;
    Modes out(guesses.size());
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

/// Of the reduced rotor those that do not stand still, the nearest ones first.
std::vector<Next> next_to(const WholeAndReduced &rotors, double multiple, double speed) {
    // Nearest candidates for one crossing, each a root of the whole rotor.
    constexpr std::size_t enough = 8;
    const double target = multiple * std::abs(speed);
    std::vector<Next> out;
    for (int wanted = rotors.wanted;; wanted *= 2) {
        const modes::Spectrum reduced =
            rotors.reduced.at(speed, wanted, modes::Errors::of_right_vectors);
        if (static_cast<int>(reduced.modes.size()) == wanted &&
            reduced.modes.back().eigenvalue.imag() < 1.5 * target)
            continue;
        for (const modes::WhirlMode &mode : reduced.modes)
            if (!(multiple == 1 && locked(mode, speed)))
                out.push_back({speed, mode.eigenvalue.imag() - target, mode});
        break;
    }
    std::ranges::sort(out, {}, [](const Next &a) { return std::abs(a.distance); });
    out.resize(std::min(enough, out.size()));
    return out;
}

/// Just outside the end of a band, at one and at four times the distance, the mode that leaves it
/// there.
std::optional<std::pair<Next, Next>> leaving(const WholeAndReduced &rotors, double multiple,
                                             double speed, double near, double far) {
    constexpr double most = 0.2; // of twice the distance, and of the speed
    std::optional<std::pair<Next, Next>> out;
    double best = most;
    const std::vector<Next> there = next_to(rotors, multiple, speed + far);
    for (const Next &a : next_to(rotors, multiple, speed + near))
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

std::optional<Next> of_whole(const WholeAndReduced &rotors, double multiple, const Next &reduced) {
    const auto whole = of_whole(rotors, reduced.speed, reduced.mode);
    if (!whole)
        return std::nullopt;
    return Next{reduced.speed, whole->eigenvalue.imag() - multiple * std::abs(reduced.speed),
                *whole};
}

/// By how much finer elements change the distance of a mode of the whole rotor, with safety, rad/s.
std::optional<double> change_by_mesh(const mesh_error::FinerModel *finer, const Next &whole) {
    if (finer == nullptr)
        return std::nullopt;
    modes::Spectrum one;
    one.speed = whole.speed;
    one.modes.push_back(whole.mode);
    const std::vector<double> errors = finer->errors_by_refinement(one);
    return errors.empty() ? std::nullopt
                          : std::optional(errors.front() * std::abs(whole.mode.eigenvalue));
}

/// The reduced rotor's root with the distance of the whole rotor there, and its slope.
/// @param at  where distances are taken, and so far beyond, rad/s
std::optional<Place> crossing(const WholeAndReduced &rotors, const mesh_error::FinerModel *finer,
                              double multiple, double speed, double at, double step) {
    const std::vector<Next> here = next_to(rotors, multiple, at);
    if (here.empty())
        return std::nullopt;
    const auto distance = [&](const Next &other) {
        return std::abs(other.mode.eigenvalue - here[0].mode.eigenvalue);
    };
    const std::vector<Next> all = next_to(rotors, multiple, at + step);
    const auto there = std::ranges::min_element(all, {}, distance);
    const auto whole = of_whole(rotors, multiple, here[0]);
    if (there == all.end() || !whole)
        return std::nullopt;
    const double slope = (there->distance - here[0].distance) / step;
    const double change = at - speed - whole->distance / slope;
    if (!(std::abs(change) <= farthest * std::abs(speed)))
        return std::nullopt;
    Place out{speed + change, whole->mode.eigenvalue.real()};
    if (const auto by_mesh = change_by_mesh(finer, *whole))
        out.by_mesh = *by_mesh / std::abs(slope * speed);
    return out;
}

/// The same at the speed, or just beside: a motion on the multiple itself is taken for one that
/// stays there.
std::optional<Place> crossing(const WholeAndReduced &rotors, const mesh_error::FinerModel *finer,
                              double multiple, double speed) {
    // Of the speed: a motion that locks stays on the multiple there, one that crosses has left
    // it.
    constexpr double offset = 1e-6;
    const double step = offset * std::abs(speed);
    std::optional<Place> out = crossing(rotors, finer, multiple, speed, speed, step);
    return out ? out : crossing(rotors, finer, multiple, speed, speed + step, step);
}

/// Outside a band the square of the distance is smooth up to its end and beyond, and so is what
/// both rotors differ by: the end of the whole one's is where the sum of both is zero.
std::optional<Place> end_of_band(const WholeAndReduced &rotors, const mesh_error::FinerModel *finer,
                                 double multiple, double speed, double outwards) {
    const auto reduced = leaving(rotors, multiple, speed, outwards / 4, outwards);
    if (!reduced)
        return std::nullopt;
    const auto near = of_whole(rotors, multiple, reduced->first);
    const auto far = of_whole(rotors, multiple, reduced->second);
    if (!near || !far)
        return std::nullopt;
    const auto square = [](const Next &a) { return a.distance * a.distance; };
    const auto at_end = [](double a, double b) { return (4 * a - b) / 3; }; // a line's at 0
    const double off_near = square(*near) - square(reduced->first);
    const double off_far = square(*far) - square(reduced->second);
    const double difference = at_end(off_near, off_far);
    const double steep_near = square(reduced->first) / (outwards / 4);
    const double steep_far = square(reduced->second) / outwards;
    const double slope = at_end(steep_near, steep_far) + (off_far - off_near) / (0.75 * outwards);
    const double bend = (steep_far - steep_near) / (0.75 * outwards);
    double change = 0; // difference + slope change + bend change^2 = 0, of its roots the small one
    for (int step = 0; step < 4; ++step)
        change = -(difference + bend * change * change) / slope;
    if (!(std::abs(change) <= std::min(std::abs(outwards), farthest * std::abs(speed))))
        return std::nullopt;
    Place out{speed + change, at_end(near->mode.eigenvalue.real(), far->mode.eigenvalue.real())};
    // The square of the distance next to the end moves with it, if by far less than the distance.
    constexpr double far_less = 0.1;
    if (const auto by_mesh = change_by_mesh(finer, *near);
        by_mesh && *by_mesh <= far_less * std::abs(near->distance))
        out.by_mesh = 2 * std::abs(near->distance) * *by_mesh / std::abs(slope * speed);
    return out;
}

} // namespace

bool WholeAndReduced::improve(modes::Spectrum &spectrum, const std::vector<int> &places,
                              bool all) const {
    std::vector<modes::WhirlMode> guesses;
    for (const int place : places)
        guesses.push_back(spectrum.modes[static_cast<std::size_t>(place)]);
    const Modes found = spectrum.speed == 0 ? at_rest(*this, guesses)
                                            : at_speed(*this, spectrum.speed, guesses, all);
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

void WholeAndReduced::improve(Crossings &crossed, double low, double high,
                              const mesh_error::FinerModel *finer) const {
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
                ends[{band.multiple, speed}] = end_of_band(*this, finer, band.multiple, speed,
                                                           side * way(band.multiple, speed));
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
        const auto place =
            end != ends.end() ? end->second : crossing(*this, finer, c.multiple, c.speed);
        if (finer != nullptr)
            crossed.by_mesh.push_back(place ? place->by_mesh : std::nullopt);
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
