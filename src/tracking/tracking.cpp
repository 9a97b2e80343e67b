#include "tracking/tracking.h"

#include "model/errors.h"
#include "results/formulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

namespace whirl::tracking {

namespace {

/// Halvings of a step between two nodes, a tenth of the range: what happens within 1/20000 of the
/// range is settled by slopes.
constexpr int deepest = 11;

/// Speeds solved within such a step: some five events, one or two for each halving.
constexpr int most_in_step = 60;

using SharedSnapshot = std::shared_ptr<const Snapshot>;

/// Modes of one speed in another.
struct Followed {
    std::vector<int> to;            ///< places, or Matching::none
    std::vector<Absence> lost_from; ///< why a mode of the first has no continuation
    std::vector<Absence> lost_to;   ///< why a mode of the second has no origin
    bool sure = true;               ///< by the vectors; else settled by groups of modes
};

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

/// Speeds at which lines are followed, ascending: the nodes given and those solved between them.
struct Chain {
    std::vector<SharedSnapshot> nodes;
    std::vector<Followed> steps; ///< from each node to the next

    void append(Followed followed, SharedSnapshot node) {
        steps.push_back(std::move(followed));
        nodes.push_back(std::move(node));
    }

    /// Where it is not sure what modes become from one node to the next, as where one of these lies
    /// where two lines cross, so that modes there are a mixture of both: from side to side it may
    /// be. The nodes between are dropped.
    /// @param important  as for match_by_vectors()
    /// @param widest     rad/s
    void step_over_crossings(int important, double widest) {
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (!steps[i].sure)
                step_over(i, important, widest);
    }
    /// Important modes that were lost on the way.
    void note_gaps(int important, std::vector<Gap> &gaps) const {
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const modes::Spectrum &a = nodes[i]->spectrum;
            const modes::Spectrum &b = nodes[i + 1]->spectrum;
            const auto note = [&](const modes::Spectrum &at, const std::vector<Absence> &lost) {
                const std::vector<char> low = at.lowest(important);
                for (std::size_t k = 0; k < lost.size(); ++k)
                    if (!steps[i].sure && lost[k] == Absence::lost && low[k] != 0)
                        gaps.push_back({a.speed, b.speed, at.modes[k].eigenvalue.imag()});
            };
            note(a, steps[i].lost_from);
            note(b, steps[i].lost_to);
        }
    }

  private:
    /// Over a step, with as few of its neighbours as need be.
    void step_over(std::size_t &step, int important, double widest) {
        const auto speed = [this](std::size_t node) { return nodes[node]->spectrum.speed; };
        for (std::size_t width = 2; width <= steps.size(); ++width)
            for (std::size_t before = 0; before < width; ++before) {
                if (before > step || step - before + width > steps.size())
                    continue;
                const std::size_t first = step - before;
                const std::size_t last = first + width;
                if (std::abs(speed(last) - speed(first)) > widest)
                    continue;
                const Matching across = match_by_vectors(*nodes[first], *nodes[last], important);
                if (across.ambiguous)
                    continue;
                steps[first] = plain(across, nodes[first]->spectrum, nodes[last]->spectrum);
                const auto begin = static_cast<std::ptrdiff_t>(first) + 1;
                const auto end = static_cast<std::ptrdiff_t>(last);
                steps.erase(steps.begin() + begin, steps.begin() + end);
                nodes.erase(nodes.begin() + begin, nodes.begin() + end);
                step = first;
                return;
            }
    }
};

/// Follows modes from one node to another, with more speeds in between where it must.
class ModeFollower {
  public:
    /// @param important  that many of the lowest modes must be followed
    /// @param budget     speeds that may be solved beside those given, in all
    /// @param finest     steps that are no longer are not halved to distinguish crossings from
    ///          veerings
    /// @param between    spectra solved in between before, and now
    /// @param out        where gaps are noted, and that the budget did not suffice
    ModeFollower(const modes::SpectrumSolver &solver, int important, int budget, double finest,
                 SpectraBetween &between, Tracking &out)
        : _solver(solver), _important(important), _budget(budget), _finest(finest),
          _between(between), _out(out) {}

    /// With the vectors of its modes.
    [[nodiscard]] SharedSnapshot node(modes::Spectrum spectrum) const {
        modes::ModeBasis basis = _solver.basis(spectrum);
        return std::make_shared<const Snapshot>(Snapshot{std::move(spectrum), std::move(basis)});
    }

    /// Modes of the last node in the next one. Where overlaps are ambiguous the step is halved,
    /// down to 1/2048 of it, and there settled by groups of modes.
    void follow(const SharedSnapshot &next, Chain &chain) {
        _left_in_step = most_in_step;
        const std::size_t first = chain.steps.size();
        const SharedSnapshot last = chain.nodes.back();
        follow(last, next, 0, chain);
        exchange(*last, first, chain);
    }

  private:
    const modes::SpectrumSolver &_solver;
    int _important;
    int _budget;
    double _finest; // rad/s
    int _left_in_step = 0;
    SpectraBetween &_between;
    Tracking &_out;

    void follow(const SharedSnapshot &a, const SharedSnapshot &b, int depth, Chain &chain) {
        const Matching direct = match_by_vectors(*a, *b, _important);
        const bool last = depth == deepest || _budget <= 0 || _left_in_step <= 0;
        const bool planar = results::is_planar(_solver.form());
        const double from = a->spectrum.speed;
        const double to = b->spectrum.speed;
        const bool fine = std::abs(to - from) <= _finest;
        const bool exchanged = !fine && (may_veer(*a, *b, direct, _important, planar) ||
                                         may_turn_real(*a, *b, direct));
        const bool clear = !direct.ambiguous || (fine && direct.but_for_ends);
        if (clear && (last || !exchanged)) {
            chain.append(plain(direct, a->spectrum, b->spectrum), b);
            return;
        }
        const SharedSnapshot between = last ? nullptr : between_of(*a, *b);
        if (!between) {
            _out.cut_short = _out.cut_short || _budget <= 0;
            chain.append(settled(*a, *b), b);
            return;
        }
        follow(a, between, depth + 1, chain);
        follow(between, b, depth + 1, chain);
    }

    /// Half way between two nodes; null where the spectrum is not to be had.
    [[nodiscard]] SharedSnapshot between_of(const Snapshot &a, const Snapshot &b) {
        const double middle = (a.spectrum.speed + b.spectrum.speed) / 2;
        const auto wanted =
            static_cast<int>(std::max(a.spectrum.modes.size(), b.spectrum.modes.size()));
        if (_solver.by_matrix() && !_solver.by_matrix(middle, wanted))
            return nullptr;
        --_budget;
        --_left_in_step;
        try {
            const auto [known, is_new] = _between.try_emplace(middle);
            if (is_new || static_cast<int>(known->second.modes.size()) < wanted)
                known->second = spectrum_between(middle, wanted);
            return node(known->second);
        } catch (const model::AnalysisFailure &) { // a speed that nobody asked for
            _between.erase(middle);
            return nullptr;
        }
    }

    /// At a speed between two nodes. No result lists its modes, so that it need not be refined on
    /// the whole rotor: the reduced one tells well enough which mode becomes which.
    [[nodiscard]] modes::Spectrum spectrum_between(double speed, int wanted) const {
        const modes::Errors errors =
            _solver.refines() ? modes::Errors::of_right_vectors : modes::Errors::with_left_vectors;
        return _solver.at(speed, wanted, errors);
    }

    [[nodiscard]] static Followed settled(const Snapshot &a, const Snapshot &b) {
        Followed out = plain(match_by_groups(a, b), a.spectrum, b.spectrum);
        out.sure = false;
        return out;
    }

    /// Over all steps from a node on: the lines that keep_larger_parts() exchanges do so in the
    /// last one.
    static void exchange(const Snapshot &from, std::size_t first, Chain &chain) {
        std::vector<int> before_last(from.spectrum.modes.size());
        std::iota(before_last.begin(), before_last.end(), 0);
        const auto advance = [](const Followed &step, std::vector<int> places) {
            for (int &place : places)
                if (place != Matching::none)
                    place = step.to[static_cast<std::size_t>(place)];
            return places;
        };
        for (std::size_t i = first; i + 1 < chain.steps.size(); ++i)
            before_last = advance(chain.steps[i], std::move(before_last));
        Followed &last = chain.steps.back();
        std::vector<int> to = advance(last, before_last);
        keep_larger_parts(from, *chain.nodes.back(), to);
        for (std::size_t i = 0; i < to.size(); ++i)
            if (before_last[i] != Matching::none)
                last.to[static_cast<std::size_t>(before_last[i])] = to[i];
    }
};

/// Lines through the nodes of a chain, by their numbers.
class ChainLines {
  public:
    explicit ChainLines(const Chain &chain) : _chain(chain) {
        _at.emplace_back();
        for (std::size_t i = 0; i < chain.nodes.front()->spectrum.modes.size(); ++i)
            _at.back().push_back(begun(Absence::none));
        for (const Followed &step : chain.steps) {
            const std::vector<int> last = _at.back();
            std::vector<int> next(step.lost_to.size(), absent);
            for (std::size_t i = 0; i < last.size(); ++i)
                if (step.to[i] == Matching::none)
                    _after[static_cast<std::size_t>(last[i])] = step.lost_from[i];
                else
                    next[static_cast<std::size_t>(step.to[i])] = last[i];
            for (std::size_t j = 0; j < next.size(); ++j)
                if (next[j] == absent)
                    next[j] = begun(step.lost_to[j]);
            _at.push_back(std::move(next));
        }
    }

    [[nodiscard]] const Chain &chain() const { return _chain; }
    /// Of each mode of a node.
    [[nodiscard]] const std::vector<int> &at(std::size_t node) const { return _at[node]; }
    [[nodiscard]] std::size_t count() const { return _before.size(); }
    /// Why the line is not there before its first node, and after its last one.
    [[nodiscard]] Absence before(std::size_t line) const { return _before[line]; }
    [[nodiscard]] Absence after(std::size_t line) const { return _after[line]; }

    static constexpr int absent = -1; ///< no line has this number

  private:
    const Chain &_chain;
    std::vector<std::vector<int>> _at;
    std::vector<Absence> _before, _after;

    int begun(Absence before) {
        _before.push_back(before);
        _after.push_back(Absence::none);
        return static_cast<int>(_before.size()) - 1;
    }
};

/// Takes speeds between two nodes on the lines that pass there.
class Between {
  public:
    /// @param low  the node below
    Between(const ChainLines &lines, std::size_t low, const Snapshot &here, int important)
        : _lines(lines), _here(here), _of(here.spectrum.modes.size(), ChainLines::absent) {
        const double from = node(low).spectrum.speed;
        const double to = node(low + 1).spectrum.speed;
        const bool upper_nearer =
            std::abs(to - here.spectrum.speed) < std::abs(here.spectrum.speed - from);
        _nodes = {low + (upper_nearer ? 1 : 0), low + (upper_nearer ? 0 : 1)};
        for (const std::size_t node : _nodes)
            take_by_vectors(node, important);
        take_by_values(low);
    }

    /// Of each mode, or ChainLines::absent.
    [[nodiscard]] const std::vector<int> &lines() const { return _of; }

    /// Why a line that passes one of the nodes is not there.
    [[nodiscard]] Absence absence(int line) const {
        for (const std::size_t k : _nodes)
            if (const auto place = place_in(k, line))
                return fate(node(k).spectrum, static_cast<int>(*place), _here.spectrum);
        return Absence::none;
    }

  private:
    const ChainLines &_lines;
    const Snapshot &_here;
    std::vector<int> _of;
    std::array<std::size_t, 2> _nodes{}; ///< the nearer one first

    [[nodiscard]] const Snapshot &node(std::size_t k) const { return *_lines.chain().nodes[k]; }
    [[nodiscard]] bool taken(int line) const { return std::ranges::find(_of, line) != _of.end(); }
    [[nodiscard]] std::optional<std::size_t> place_in(std::size_t k, int line) const {
        const auto found = std::ranges::find(_lines.at(k), line);
        if (found == _lines.at(k).end())
            return std::nullopt;
        return static_cast<std::size_t>(found - _lines.at(k).begin());
    }

    void take_by_vectors(std::size_t k, int important) {
        Matching matching = match_by_vectors(node(k), _here, important);
        if (matching.ambiguous)
            matching = match_by_groups(node(k), _here);
        keep_larger_parts(node(k), _here, matching.to);
        for (std::size_t i = 0; i < matching.to.size(); ++i) {
            if (matching.to[i] == Matching::none || taken(_lines.at(k)[i]))
                continue;
            int &of = _of[static_cast<std::size_t>(matching.to[i])];
            of = of == ChainLines::absent ? _lines.at(k)[i] : of;
        }
    }

    /// Lines that pass both nodes, and modes that are left: by what a line between the eigenvalues
    /// at the nodes leads to, the next ones first.
    void take_by_values(std::size_t low) {
        const double from = node(low).spectrum.speed;
        const double to = node(low + 1).spectrum.speed;
        const double share = (_here.spectrum.speed - from) / (to - from);
        std::vector<std::tuple<double, std::size_t, int>> candidates;
        for (std::size_t i = 0; i < _lines.at(low).size(); ++i) {
            const int line = _lines.at(low)[i];
            const auto j = place_in(low + 1, line);
            if (!j || taken(line))
                continue;
            const std::complex<double> a = node(low).spectrum.modes[i].eigenvalue;
            const std::complex<double> b = node(low + 1).spectrum.modes[*j].eigenvalue;
            for (std::size_t m = 0; m < _of.size(); ++m) {
                const std::complex<double> here = _here.spectrum.modes[m].eigenvalue;
                const double away = std::abs(here - (a + share * (b - a)));
                if (_of[m] == ChainLines::absent && away <= std::abs(b - a))
                    candidates.emplace_back(away, m, line);
            }
        }
        std::ranges::sort(candidates);
        for (const auto &[away, m, line] : candidates)
            if (_of[m] == ChainLines::absent && !taken(line))
                _of[m] = line;
    }
};

/// Before its first and after its last speed a line is absent for the reason given there.
void set_absence(Line &line, Absence before, Absence after) {
    for (std::size_t k = 0; k < line.place.size() && line.place[k] == Line::absent; ++k)
        line.absence[k] = before;
    for (std::size_t k = line.place.size(); k > 0 && line.place[k - 1] == Line::absent; --k)
        line.absence[k - 1] = after;
}

/// Of a line at its k-th speed that of the parabola through it and its neighbours on the line, or
/// between it and the one neighbour; not a number where it has none.
std::complex<double> slope_between(const std::vector<modes::Spectrum> &spectra, const Line &line,
                                   std::size_t k) {
    const auto value = [&](std::size_t i) {
        return spectra[i].modes[static_cast<std::size_t>(line.place[i])].eigenvalue;
    };
    const auto secant = [&](std::size_t i) {
        return (value(i + 1) - value(i)) / (spectra[i + 1].speed - spectra[i].speed);
    };
    const bool below = k > 0 && line.place[k - 1] != Line::absent;
    const bool above = k + 1 < spectra.size() && line.place[k + 1] != Line::absent;
    if (!below && !above)
        return {std::numeric_limits<double>::quiet_NaN(), 0};
    if (!below || !above)
        return secant(below ? k - 1 : k);
    const double before = spectra[k].speed - spectra[k - 1].speed;
    const double behind = spectra[k + 1].speed - spectra[k].speed;
    return (behind * secant(k - 1) + before * secant(k)) / (before + behind);
}

/// Rates that no eigenvector gives (form hill).
void add_slopes(const std::vector<modes::Spectrum> &spectra, Tracking &out) {
    for (std::size_t k = 0; k < spectra.size(); ++k)
        for (const Line &line : out.lines)
            if (const int place = line.place[k]; place != Line::absent && spectra[k].speed != 0)
                for (Eigen::VectorXcd *rates : {&out.rates[k].below, &out.rates[k].above})
                    if (!std::isfinite((*rates)(place).real()))
                        (*rates)(place) = slope_between(spectra, line, k);
}

/// Which of the speeds lines are to be followed through.
std::vector<char> are_nodes(const std::vector<modes::Spectrum> &spectra,
                            const std::vector<double> &nodes) {
    const auto is_node = [&nodes](const modes::Spectrum &spectrum) {
        return std::ranges::binary_search(nodes, spectrum.speed);
    };
    std::vector<char> out;
    for (const modes::Spectrum &spectrum : spectra)
        out.push_back(nodes.empty() || is_node(spectrum) ? 1 : 0);
    out.front() = out.back() = 1;
    return out;
}

} // namespace

Tracking track(const modes::SpectrumSolver &solver, const std::vector<modes::Spectrum> &spectra,
               int important, std::optional<int> most_between, const std::vector<double> &nodes,
               SpectraBetween *known) {
    const std::vector<char> is_node = are_nodes(spectra, nodes);
    const int budget =
        most_between.value_or(100 + 20 * static_cast<int>(std::ranges::count(is_node, 1)));
    constexpr double fine = 1.0 / 400; // of the range, whatever its grid
    const double finest = fine * std::abs(spectra.back().speed - spectra.front().speed);
    Tracking out;
    SpectraBetween own;
    ModeFollower follower(solver, important, budget, finest, known != nullptr ? *known : own, out);
    std::vector<SharedSnapshot> snapshots;
    Chain chain;
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        snapshots.push_back(follower.node(spectra[k]));
        const modes::ModeBasis &basis = snapshots.back()->basis;
        out.rates.push_back({basis.rate_below, basis.rate_above});
        if (k == 0)
            chain.nodes.push_back(snapshots.back());
        else if (is_node[k] != 0)
            follower.follow(snapshots.back(), chain);
    }
    chain.step_over_crossings(important, 2 * finest);
    chain.note_gaps(important, out.gaps);
    const ChainLines lines(chain);
    Line none;
    none.place.assign(spectra.size(), Line::absent);
    none.absence.assign(spectra.size(), Absence::none);
    out.lines.assign(lines.count(), none);
    const auto put = [&](std::size_t k, const std::vector<int> &of_modes) {
        for (std::size_t i = 0; i < of_modes.size(); ++i)
            if (of_modes[i] != ChainLines::absent)
                out.lines[static_cast<std::size_t>(of_modes[i])].place[k] = static_cast<int>(i);
    };
    std::vector<Line> alone; // modes between two nodes that are at neither
    const double direction = spectra.back().speed < spectra.front().speed ? -1 : 1;
    std::size_t low = 0; // the last node at or below the speed
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        while (low + 1 < chain.nodes.size() &&
               direction * (chain.nodes[low + 1]->spectrum.speed - spectra[k].speed) <= 0)
            ++low;
        if (chain.nodes[low] == snapshots[k]) {
            put(k, lines.at(low));
            continue;
        }
        const Between between(lines, low, *snapshots[k], important);
        put(k, between.lines());
        for (const std::vector<int> *passing : {&lines.at(low), &lines.at(low + 1)})
            for (const int line : *passing)
                if (Line &of = out.lines[static_cast<std::size_t>(line)];
                    of.place[k] == Line::absent)
                    of.absence[k] = between.absence(line);
        for (std::size_t i = 0; i < between.lines().size(); ++i)
            if (between.lines()[i] == ChainLines::absent) {
                alone.push_back(none);
                alone.back().place[k] = static_cast<int>(i);
                set_absence(alone.back(),
                            fate(spectra[k], static_cast<int>(i), chain.nodes[low]->spectrum),
                            fate(spectra[k], static_cast<int>(i), chain.nodes[low + 1]->spectrum));
            }
    }
    for (std::size_t line = 0; line < lines.count(); ++line)
        set_absence(out.lines[line], lines.before(line), lines.after(line));
    std::erase_if(out.lines, [](const Line &line) {
        return std::ranges::all_of(line.place, [](int place) { return place == Line::absent; });
    });
    out.lines.insert(out.lines.end(), alone.begin(), alone.end());
    if (results::Form::hill == solver.form())
        add_slopes(spectra, out);
    return out;
}

} // namespace whirl::tracking
