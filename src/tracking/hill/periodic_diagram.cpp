#include "tracking/hill/periodic_diagram.h"

#include "linalg/check.h"
#include "model/errors.h"
#include "process/processes.h"
#include "tracking/crossing_step.h"
#include "tracking/hill/whole_and_reduced.h"
#include "tracking/spectra.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace whirl::tracking {

namespace {

using Speeds = std::vector<double>;

Speeds with(const Speeds &some, const Speeds &others) {
    Speeds out;
    std::set_union(some.begin(), some.end(), others.begin(), others.end(), std::back_inserter(out));
    return out;
}

constexpr int parts = 200;    ///< of the range, by speeds that are searched whatever is asked for
constexpr double same = 1e-6; ///< of a part

/// Those of the speeds that are not the choice of whoever asked.
Speeds evenly_spread(const Speeds &all) {
    const double width = (all.back() - all.front()) / parts;
    Speeds out;
    for (const double speed : all)
        if (const double place = (speed - all.front()) / width;
            std::abs(place - std::round(place)) <= same)
            out.push_back(speed);
    return out;
}

/// Speeds of the range that own ones do not have already and the matrix resolves, evenly spread.
/// @param every  of the parts
Speeds spread_over(const Speeds &own, const modes::SpectrumSolver &reduced, int wanted, double slow,
                   int every) {
    const double width = (own.back() - own.front()) / parts;
    Speeds out;
    for (int i = 0; width > 0 && i <= parts; i += every) {
        const double speed = own.front() + width * i;
        const auto above = std::lower_bound(own.begin(), own.end(), speed - same * width);
        if ((above == own.end() || *above > speed + same * width) && std::abs(speed) > slow &&
            reduced.by_matrix(speed, wanted))
            out.push_back(speed);
    }
    return out;
}

/// Whether a line may come to a multiple between two speeds: in a band on the multiple and beside
/// it its distance changes by less than that of lines that do not lock. Where a bearing table is
/// steeper than most_change() a line may pass a multiple between speeds that are both far from it:
/// that crossing shows by its sides, a narrow band in the same step may not.
bool may_meet(const modes::Spectrum &a, const modes::Spectrum &b, const Speeds &multiples) {
    const double step = b.speed - a.speed;
    return std::ranges::any_of(multiples, [&](double multiple) {
        const auto near = [&](const modes::Spectrum &at) {
            return std::ranges::any_of(at.modes, [&](const modes::WhirlMode &mode) {
                const double off = mode.eigenvalue.imag() - multiple * std::abs(at.speed);
                return std::abs(off) <= most_change(step, multiple);
            });
        };
        return near(a) || near(b);
    });
}

/// The speeds asked for and others, evenly spread over the range, so closely that reduced bands
/// open and close between two of them: where a motion comes near one of the multiples. There are
/// none at slow speeds, where all motions are above those multiples, nor where the matrix does not
/// resolve the modes.
struct SearchSpeeds {
    Speeds all;
    std::vector<modes::Spectrum> known{}; ///< on process 0, of some
};
SearchSpeeds with_search_speeds(const Speeds &own, const modes::SpectrumSolver &reduced, int wanted,
                                const Speeds &multiples) {
    constexpr double slow_multiple = 4; // at slow speeds all motions are above that
    constexpr int coarse = 5;           // of the parts
    const double largest = multiples.empty() ? 0 : *std::ranges::max_element(multiples);
    const double slow = largest <= slow_multiple ? reduced.slow() : 0;
    const Speeds few = with(evenly_spread(own), spread_over(own, reduced, wanted, slow, coarse));
    SearchSpeeds out{with(own, few), spectra_at(reduced, few, wanted)};
    const Speeds more = spread_over(out.all, reduced, wanted, slow, 1);
    std::vector<char> needed(more.size(), 0);
    if (process::process_rank() == 0)
        for (std::size_t i = 0; i < more.size(); ++i) {
            const auto above = std::ranges::upper_bound(few, more[i]) - few.begin();
            needed[i] = above == 0 || above == std::ssize(few) ||
                        may_meet(out.known[static_cast<std::size_t>(above) - 1],
                                 out.known[static_cast<std::size_t>(above)], multiples);
        }
    process::broadcast(needed);
    Speeds chosen;
    for (std::size_t i = 0; i < more.size(); ++i)
        if (needed[i] != 0)
            chosen.push_back(more[i]);
    out.all = with(out.all, chosen);
    return out;
}

/// On process 0. @returns nothing where a mode of the whole rotor is not found
std::optional<Crossings> completed(const modes::SpectrumSolver &solver,
                                   const modes::SpectrumSolver &reduced, const Speeds &speeds,
                                   int modes, const Speeds &multiples, FollowedLines &found) try {
    const WholeAndReduced rotors{solver, reduced,
                                 modes_to_follow(solver.discretization().rotor(), modes)};
    const double low = found.spectra.front().speed;
    const double high = found.spectra.back().speed;
    Crossings crossed = crossings(reduced, found.tracking, found.spectra, multiples);
    std::optional<mesh_error::FinerModel> finer;
    if (speeds.empty())
        finer.emplace(solver.discretization().rotor(), solver);
    rotors.improve(crossed, low, high, finer ? &*finer : nullptr);
    const std::vector<char> drawn_lines =
        lines_drawn(found.tracking.lines, found.spectra, modes, crossed);
    for (std::size_t k = 0; k < found.spectra.size(); ++k) {
        if (!std::binary_search(speeds.begin(), speeds.end(), found.spectra[k].speed))
            continue;
        std::vector<int> drawn;
        for (std::size_t i = 0; i < drawn_lines.size(); ++i)
            if (const int place = found.tracking.lines[i].place[k];
                place != Line::absent && drawn_lines[i] != 0)
                drawn.push_back(place);
        const bool slow = std::abs(found.spectra[k].speed) <= reduced.slow();
        // Near rest aliases of all motions lie so close that the one meant may not be found.
        if (!rotors.improve(found.spectra[k], drawn, !slow) && !slow)
            return std::nullopt;
    }
    return crossed;
} catch (const model::Failure &) { // of process 0 alone: the others wait for its answer
    return std::nullopt;
}

} // namespace

std::optional<PeriodicDiagram> periodic_diagram(const modes::SpectrumSolver &solver,
                                                const Speeds &speeds, const Speeds &naming,
                                                int modes, const Speeds &multiples) try {
    const Speeds own = with(speeds, naming);
    const int wanted = modes_to_follow(solver.discretization().rotor(), modes);
    const std::unique_ptr<modes::SpectrumSolver> reduced =
        solver.by_monodromy(own.front(), own.back(), wanted);
    SearchSpeeds search = with_search_speeds(own, *reduced, wanted, multiples);
    PeriodicDiagram out{followed_lines(*reduced, search.all, modes, false,
                                       evenly_spread(search.all), std::move(search.known)),
                        {}};
    std::vector<char> good(1, 1);
    if (process::process_rank() == 0) {
        std::optional<Crossings> crossed =
            completed(solver, *reduced, speeds, modes, multiples, out.found);
        good[0] = crossed ? 1 : 0;
        if (crossed)
            out.crossed = *std::move(crossed);
    }
    process::broadcast(good);
    return good[0] != 0 ? std::optional(std::move(out)) : std::nullopt;
} catch (const linalg::SolverError &) { // no shapes
    return std::nullopt;
}

} // namespace whirl::tracking
