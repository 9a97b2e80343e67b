#include "tracking/hill/periodic_diagram.h"

#include "linalg/check.h"
#include "model/errors.h"
#include "process/processes.h"
#include "tracking/hill/whole_and_reduced.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

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

/// With others, evenly spread over the range, so closely that reduced bands open and close between
/// two of them. There are none where no motion comes near a multiple on which bands are so wide, or
/// near one of those asked for, nor where the matrix does not resolve the modes.
Speeds with_search_speeds(const Speeds &own, const modes::SpectrumSolver &reduced, int wanted,
                          const Speeds &multiples) {
    constexpr double slow_multiple = 4; // at slow speeds all motions are above that
    const double largest = multiples.empty() ? 0 : *std::ranges::max_element(multiples);
    const double slow = largest <= slow_multiple ? reduced.slow() : 0;
    const double width = (own.back() - own.front()) / parts;
    Speeds out;
    for (int i = 0; width > 0 && i <= parts; ++i) {
        const double speed = own.front() + width * i;
        const auto above = std::lower_bound(own.begin(), own.end(), speed - same * width);
        if ((above == own.end() || *above > speed + same * width) && std::abs(speed) > slow &&
            reduced.by_matrix(speed, wanted))
            out.push_back(speed);
    }
    return with(own, out);
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
    const Speeds all = with_search_speeds(own, *reduced, wanted, multiples);
    PeriodicDiagram out{followed_lines(*reduced, all, modes, false, evenly_spread(all)), {}};
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
