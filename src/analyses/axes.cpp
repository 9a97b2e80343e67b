#include "analyses/axes.h"

#include "linalg/roots.h"
#include "model/errors.h"
#include "rigid/composite_rotor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

namespace whirl::analyses {

namespace {

using model::SweepAxis;
using model::SweepChange;

/// What leaves the entries of an axis as the case has them.
double no_change(const SweepAxis &axis) {
    switch (axis.change) {
    case SweepChange::factor:
        return 1;
    case SweepChange::shift:
        return 0;
    case SweepChange::value:
        break;
    }
    return axis.entries.front().given;
}

double number_of(const SweepAxis &axis, const model::Case &scene) {
    return rigid::dimensionless_number(scene.rotor, *axis.dimensionless);
}

/// Whether a number is the one that is wanted: what the last digits of an entry change in it is
/// far less than this, in the axes of a picture nobody sees it.
bool reached(double number, double wanted) {
    constexpr double relative = 1e-10;
    constexpr double rounding = 1e-14; // of numbers of order 1 that are differences, as c_y
    return std::abs(number - wanted) <= relative * std::abs(wanted) + rounding;
}

/// Places to look at for the entry, outwards from where it is: as far as no rotor goes.
/// @param up  away from zero; else to zero and beyond it
std::vector<double> outwards(double from, bool up) {
    constexpr int doublings = 40; // 1e12
    constexpr int decades = 12;   // either way from 1 in SI, where the case gives no size
    std::vector<double> places;
    if (from == 0) {
        for (int k = -decades; k <= decades; ++k)
            places.push_back((up ? 1 : -1) * std::pow(10.0, k));
        return places;
    }
    for (int k = 1; k <= doublings; ++k)
        places.push_back(std::ldexp(from, up ? k : -k));
    if (up)
        return places;
    places.push_back(0);
    for (int k = -doublings; k <= doublings; ++k)
        places.push_back(-std::ldexp(from, k));
    return places;
}

/// Looks outwards from the entry that the case gives for the next one with which the rotor has a
/// number.
class NumberSearch {
  public:
    /// @param number  over the entry. @throws model::BadInput where there is no such rotor
    NumberSearch(std::function<double(double entry)> number, double wanted)
        : _number(std::move(number)), _wanted(wanted) {}

    /// None: no entry has it, see range().
    [[nodiscard]] std::optional<double> outwards_from(double start) {
        if (const auto off = off_at(start)) {
            if (reached(_wanted + *off, _wanted))
                return start;
            _tried.push_back({start, *off});
        }
        const std::vector<double> up = outwards(start, true);
        const std::vector<double> down = outwards(start, false);
        for (std::size_t i = 0; i < std::max(up.size(), down.size()) && !_found; ++i)
            for (const bool is_up : {true, false}) {
                const std::vector<double> &places = is_up ? up : down;
                if (i < places.size() && !_ended[is_up ? 1 : 0] && !_found)
                    step(is_up, places[i]);
            }
        return _found;
    }

    /// What can be had, empty: nothing; and why there is no more of it.
    [[nodiscard]] std::string range() const {
        return _least > _largest ? "" : fmt::format("from {:.6g} to {:.6g}", _least, _largest);
    }
    [[nodiscard]] const std::string &refused() const { return _refused; }

  private:
    struct Tried {
        double entry;
        double off; ///< the number less the wanted one
    };

    std::function<double(double)> _number;
    double _wanted;
    std::deque<Tried> _tried; ///< by how far up
    std::array<bool, 2> _ended{};
    double _least = HUGE_VAL;
    double _largest = -HUGE_VAL;
    std::optional<double> _found;
    std::string _refused; ///< by the model, why

    double off(double entry) {
        const double number = _number(entry);
        _least = std::min(_least, number);
        _largest = std::max(_largest, number);
        return number - _wanted;
    }
    std::optional<double> off_at(double entry) {
        try {
            return off(entry);
        } catch (const model::BadInput &why) {
            _refused = why.what();
            return std::nullopt;
        }
    }

    void step(bool up, double entry) {
        if (const auto off = off_at(entry)) {
            add(up, {entry, *off});
            return;
        }
        if (_tried.empty())
            return;
        // Up to the last rotor that there is.
        constexpr int halvings = 30; // 1e-9 of the step
        double beyond = entry;
        for (int i = 0; i < halvings && !_found; ++i) {
            const double middle =
                std::midpoint((up ? _tried.back() : _tried.front()).entry, beyond);
            if (const auto off = off_at(middle))
                add(up, {middle, *off});
            else
                beyond = middle;
        }
        _ended[up ? 1 : 0] = true;
    }

    void add(bool up, const Tried &last) {
        if (up)
            _tried.push_back(last);
        else
            _tried.push_front(last);
        if (reached(_wanted + last.off, _wanted))
            _found = last.entry;
        const auto tried = [&](std::size_t i) {
            return up ? _tried[_tried.size() - 1 - i] : _tried[i];
        };
        if (_found || _tried.size() < 2)
            return;
        if (!look_between(last, tried(1)) && _tried.size() > 2)
            look_around(last, tried(1), tried(2));
    }

    bool look_between(const Tried &a, const Tried &b) try {
        if ((a.off < 0) == (b.off < 0))
            return false;
        constexpr double width = 1e-15; // all digits
        const double root = linalg::root_between([this](double entry) { return off(entry); },
                                                 a.entry, a.off, b.entry, b.off, width);
        if (!reached(_wanted + off(root), _wanted))
            return false; // it jumps past
        _found = root;
        return true;
    } catch (const model::BadInput &why) { // between two rotors there is none: whole numbers
        _refused = why.what();
        return false;
    }

    /// A number that comes near and leaves again may get there in between.
    void look_around(const Tried &a, const Tried &between, const Tried &b) try {
        if (std::abs(between.off) >= std::min(std::abs(a.off), std::abs(b.off)))
            return;
        const double side = between.off < 0 ? -1 : 1; // the least is beyond zero, or touches it
        const double place =
            linalg::least_place([&](double entry) { return side * off(entry); },
                                std::min(a.entry, b.entry), std::max(a.entry, b.entry));
        const Tried nearest{place, off(place)};
        if (reached(_wanted + nearest.off, _wanted))
            _found = place;
        else
            look_between(nearest, between);
    } catch (const model::BadInput &why) {
        _refused = why.what();
    }
};

std::string names_of(const SweepAxis &axis) {
    return axis.entries.size() > 1
               ? fmt::format("{} and {} more", axis.label, axis.entries.size() - 1)
               : axis.label;
}

} // namespace

RotorsOver::RotorsOver(std::vector<SweepAxis> axes, CaseWith with)
    : _axes(std::move(axes)), _with(std::move(with)), _alone(_axes.size()) {}

model::Case RotorsOver::scene(const std::vector<double> &changes) const {
    std::vector<std::string> overrides;
    for (std::size_t i = 0; i < _axes.size(); ++i)
        for (const model::SweptEntry &entry : _axes[i].entries)
            overrides.push_back(fmt::format("{}={}", entry.path, _axes[i].at(entry, changes[i])));
    return _with(overrides);
}

double RotorsOver::change_for(std::size_t axis, double number, std::vector<double> changes) const {
    const SweepAxis &of = _axes[axis];
    // Searched over the entry itself, or over its factor.
    const double given = of.change == SweepChange::shift ? of.entries.front().given : 0;
    NumberSearch search(
        [&](double entry) {
            changes[axis] = entry - given;
            return number_of(of, scene(changes));
        },
        number);
    const double start = changes[axis] + given;
    if (const auto found = search.outwards_from(start))
        return *found - given;
    const std::string range = search.range();
    if (range.empty())
        throw model::BadInput(fmt::format("{}: no rotor has {}, whatever {} is: {}",
                                          of.dimensionless->place, of.dimensionless->name,
                                          names_of(of), search.refused()));
    throw model::BadInput(
        fmt::format("{}: expected {} {}, which is what {} can make it, got {:.6g}",
                    of.dimensionless->place, of.dimensionless->name, range, names_of(of), number));
}

/// Of an axis over a number what gives it where the others begin, those over numbers where the case
/// is: mostly, or nearly, what does so wherever they are. No change where nothing gives it there.
double RotorsOver::change_alone(std::size_t axis, double number) const {
    const auto known = _alone[axis].find(number);
    if (known != _alone[axis].end())
        return known->second;
    std::vector<double> changes;
    for (const SweepAxis &of : _axes)
        changes.push_back(of.dimensionless ? no_change(of) : of.values.front());
    double change = changes[axis];
    try {
        change = change_for(axis, number, changes);
    } catch (const model::BadInput &) { // elsewhere it may be had
    }
    return _alone[axis].emplace(number, change).first->second;
}

RotorsOver::Rotor RotorsOver::at(const std::vector<double> &values) const {
    std::vector<double> changes = values;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < _axes.size(); ++i)
        if (_axes[i].dimensionless) {
            numbers.push_back(i);
            changes[i] = _axes.size() > 1 ? change_alone(i, values[i]) : no_change(_axes[i]);
        }
    // Of two numbers one may depend on the entries of the other: in turn, until both are there.
    constexpr int turns = 30;
    for (int turn = 0; turn < turns; ++turn) {
        for (const std::size_t i : numbers)
            changes[i] = change_for(i, values[i], changes);
        model::Case at_place = scene(changes);
        if (std::ranges::all_of(numbers, [&](std::size_t i) {
                return reached(number_of(_axes[i], at_place), values[i]);
            }))
            return {std::move(at_place), changes};
    }
    throw model::BadInput(
        fmt::format("{}: expected numbers that can be had together, {} = {:.6g} and "
                    "{} = {:.6g} were not found in {} turns",
                    _axes.front().dimensionless->place, _axes.front().dimensionless->name,
                    values.front(), _axes.back().dimensionless->name, values.back(), turns));
}

std::vector<double> speeds_over(const SweepAxis &axis, const model::Case &scene) {
    std::vector<double> speeds = axis.values;
    if (axis.dimensionless) {
        const double omega_0 = number_of(axis, scene);
        for (double &speed : speeds)
            speed *= omega_0;
    }
    return speeds;
}

} // namespace whirl::analyses
