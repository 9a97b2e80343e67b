#include "tracking/tracking.h"

#include "model/errors.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>

namespace whirl::tracking {

namespace {

/// Halvings of a step: 1/256 of it tells a crossing from a veering as well as a picture can.
constexpr int deepest = 8;

/// Speeds solved within one step: five events.
constexpr int most_in_step = 40;

/// Modes of one speed in another.
struct Followed {
    std::vector<int> to;            ///< places, or Matching::none
    std::vector<Absence> lost_from; ///< why a mode of the first has no continuation
    std::vector<Absence> lost_to;   ///< why a mode of the second has no origin
};

/// Of two steps one after the other.
Followed joined(const Followed &first, const Followed &second) {
    Followed out;
    out.to.assign(first.to.size(), Matching::none);
    out.lost_from = first.lost_from;
    out.lost_to = second.lost_to;
    std::vector<int> origin(second.lost_from.size(), Matching::none); // of each mode between
    for (std::size_t i = 0; i < first.to.size(); ++i) {
        if (first.to[i] == Matching::none)
            continue;
        const auto middle = static_cast<std::size_t>(first.to[i]);
        origin[middle] = static_cast<int>(i);
        out.to[i] = second.to[middle];
        if (out.to[i] == Matching::none)
            out.lost_from[i] = second.lost_from[middle];
    }
    for (std::size_t middle = 0; middle < origin.size(); ++middle)
        if (origin[middle] == Matching::none && second.to[middle] != Matching::none)
            out.lost_to[static_cast<std::size_t>(second.to[middle])] = first.lost_to[middle];
    return out;
}

Followed plain(const Matching &matching, const modes::Spectrum &a, const modes::Spectrum &b) {
    Followed out;
    out.to = matching.to;
    out.lost_from.assign(matching.to.size(), Absence::none);
    out.lost_to.assign(matching.from.size(), Absence::none);
    for (std::size_t i = 0; i < matching.to.size(); ++i)
        if (matching.to[i] == Matching::none)
            out.lost_from[i] = fate(a, static_cast<int>(i), b);
    for (std::size_t j = 0; j < matching.from.size(); ++j)
        if (matching.from[j] == Matching::none)
            out.lost_to[j] = fate(b, static_cast<int>(j), a);
    return out;
}

/// Before its first and after its last speed a line is absent for the reason given there.
void set_absence(Line &line, Absence before, Absence after) {
    line.absence.assign(line.place.size(), Absence::none);
    for (std::size_t k = 0; k < line.place.size() && line.place[k] == Line::absent; ++k)
        line.absence[k] = before;
    for (std::size_t k = line.place.size(); k > 0 && line.place[k - 1] == Line::absent; --k)
        line.absence[k - 1] = after;
}

/// Lines while they grow from speed to speed.
class GrowingLines {
  public:
    explicit GrowingLines(std::size_t speeds) : _speeds(speeds) {}

    void begin(std::size_t speed, std::size_t place, Absence before) {
        Line line;
        line.place.assign(_speeds, Line::absent);
        line.place[speed] = static_cast<int>(place);
        _now.resize(std::max(_now.size(), place + 1));
        _now[place] = _lines.size();
        _lines.push_back(std::move(line));
        _before.push_back(before);
        _after.push_back(Absence::none);
    }

    void step(std::size_t speed, const Followed &followed) {
        const std::vector<std::size_t> last = std::move(_now);
        _now.assign(followed.lost_to.size(), 0);
        std::vector<bool> continued(followed.lost_to.size(), false);
        for (std::size_t i = 0; i < followed.to.size(); ++i) {
            if (followed.to[i] == Matching::none) {
                _after[last[i]] = followed.lost_from[i];
                continue;
            }
            const auto j = static_cast<std::size_t>(followed.to[i]);
            _now[j] = last[i];
            continued[j] = true;
            _lines[last[i]].place[speed] = followed.to[i];
        }
        for (std::size_t j = 0; j < continued.size(); ++j)
            if (!continued[j])
                begin(speed, j, followed.lost_to[j]);
    }

    [[nodiscard]] std::vector<Line> finished() {
        for (std::size_t i = 0; i < _lines.size(); ++i)
            set_absence(_lines[i], _before[i], _after[i]);
        return std::move(_lines);
    }

  private:
    std::size_t _speeds;
    std::vector<Line> _lines;
    std::vector<Absence> _before, _after;
    std::vector<std::size_t> _now; ///< line of each mode of the last speed
};

/// Follows modes from one speed to another, with more speeds in between where it must.
class ModeFollower {
  public:
    /// @param important  that many of the lowest modes must be followed
    /// @param budget     speeds that may be solved beside those given, in all
    /// @param finest     steps that are no longer are not halved to tell crossings from veerings
    /// @param out        where gaps are noted, and that the budget did not suffice
    ModeFollower(const modes::SpectrumSolver &solver, int important, int budget, double finest,
                 Tracking &out)
        : _solver(solver), _important(important), _budget(budget), _finest(finest), _out(out) {}

    /// With the vectors of its modes.
    [[nodiscard]] Snapshot snapshot(modes::Spectrum spectrum) const {
        modes::ModeBasis basis = _solver.basis(spectrum);
        return {std::move(spectrum), std::move(basis)};
    }

    /// Modes of a in b. Where overlaps are ambiguous the step is halved, down to 1/256 of it, and
    /// there settled by groups of modes.
    [[nodiscard]] Followed follow(const Snapshot &a, const Snapshot &b) {
        _left_in_step = most_in_step;
        Followed out = follow(a, b, 0);
        keep_larger_parts(a, b, out.to);
        return out;
    }

  private:
    const modes::SpectrumSolver &_solver;
    int _important;
    int _budget;
    double _finest; // rad/s
    int _left_in_step = 0;
    Tracking &_out;

    [[nodiscard]] Followed follow(const Snapshot &a, const Snapshot &b, int depth) {
        const Matching direct = match_by_vectors(a, b, _important);
        const bool last = depth == deepest || _budget <= 0 || _left_in_step <= 0;
        const bool planar = results::is_planar(_solver.form());
        const bool fine = std::abs(b.spectrum.speed - a.spectrum.speed) <= _finest;
        if (!direct.ambiguous && (last || fine || !may_veer(a, b, direct, _important, planar)))
            return plain(direct, a.spectrum, b.spectrum);
        if (last) {
            _out.cut_short = _out.cut_short || _budget <= 0;
            return settle(a, b);
        }
        const double middle = (a.spectrum.speed + b.spectrum.speed) / 2;
        const auto wanted =
            static_cast<int>(std::max(a.spectrum.modes.size(), b.spectrum.modes.size()));
        if (_solver.by_matrix() && !_solver.by_matrix(middle, wanted))
            return settle(a, b);
        --_budget;
        --_left_in_step;
        std::optional<Snapshot> between;
        try {
            between = snapshot(_solver.at(middle, wanted));
        } catch (const model::AnalysisFailure &) { // a speed that nobody asked for
            return settle(a, b);
        }
        const Followed first = follow(a, *between, depth + 1);
        return joined(first, follow(*between, b, depth + 1));
    }

    [[nodiscard]] Followed settle(const Snapshot &a, const Snapshot &b) {
        Followed out = plain(match_by_groups(a, b), a.spectrum, b.spectrum);
        const auto note = [&](const modes::Spectrum &spectrum, const std::vector<Absence> &lost) {
            for (std::size_t i = 0; i < lost.size() && static_cast<int>(i) < _important; ++i)
                if (lost[i] == Absence::lost)
                    _out.gaps.push_back(
                        {a.spectrum.speed, b.spectrum.speed, spectrum.modes[i].eigenvalue.imag()});
        };
        note(a.spectrum, out.lost_from);
        note(b.spectrum, out.lost_to);
        return out;
    }
};

} // namespace

Tracking track(const modes::SpectrumSolver &solver, const std::vector<modes::Spectrum> &spectra,
               int important, std::optional<int> most_between) {
    // Most steps need none; an event (modes veer, or turn real) needs eight.
    const int budget = most_between.value_or(100 + 4 * static_cast<int>(spectra.size()));
    constexpr double finest = 1.0 / 400; // of the range, whatever its grid
    Tracking out;
    ModeFollower follower(solver, important, budget,
                          finest * std::abs(spectra.back().speed - spectra.front().speed), out);
    GrowingLines lines(spectra.size());
    Snapshot a = follower.snapshot(spectra.front());
    for (std::size_t i = 0; i < a.spectrum.modes.size(); ++i)
        lines.begin(0, i, Absence::none);
    out.rates.push_back({a.basis.rate_below, a.basis.rate_above});
    for (std::size_t k = 1; k < spectra.size(); ++k) {
        Snapshot b = follower.snapshot(spectra[k]);
        lines.step(k, follower.follow(a, b));
        out.rates.push_back({b.basis.rate_below, b.basis.rate_above});
        a = std::move(b);
    }
    out.lines = lines.finished();
    return out;
}

} // namespace whirl::tracking
