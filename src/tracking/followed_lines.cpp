#include "tracking/followed_lines.h"

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "balancers/linear_element.h"
#include "process/processes.h"
#include "tracking/spectra.h"

#include <algorithm>

namespace whirl::tracking {

namespace {

/// Whether a line that is among the `modes` lowest at some speed has left the computed part of the
/// spectrum, by speeds: there more modes find it again.
std::vector<char> left_spectrum(const std::vector<Line> &lines, std::size_t speeds, int modes) {
    std::vector<char> out(speeds, 0);
    for (const Line &line : lines)
        if (among_lowest(line, modes))
            for (std::size_t k = 0; k < speeds; ++k)
                out[k] = out[k] != 0 || line.absence[k] == Absence::beyond;
    return out;
}

/// Solves these of the speeds anew.
void solve_again(const modes::SpectrumSolver &solver, const std::vector<double> &speeds,
                 const std::vector<char> &these, int wanted, bool follow,
                 std::vector<modes::Spectrum> &spectra) {
    std::vector<double> some;
    for (std::size_t k = 0; k < speeds.size(); ++k)
        if (these[k] != 0)
            some.push_back(speeds[k]);
    std::vector<modes::Spectrum> found = spectra_at(solver, some, wanted, follow);
    if (found.empty()) // on process 0 alone
        return;
    spectra.resize(speeds.size());
    auto next = found.begin();
    for (std::size_t k = 0; k < speeds.size(); ++k)
        if (these[k] != 0)
            spectra[k] = std::move(*next++);
}

} // namespace

bool among_lowest(const Line &line, int modes) {
    return std::ranges::any_of(
        line.place, [modes](int place) { return place != Line::absent && place < modes; });
}

int modes_to_follow(const model::Rotor &rotor, int modes) {
    // With balancers some of the slowest modes are the balls', of each unknown two, but not at
    // rest.
    const int of_balls = 2 * balancers::unknowns_of(balancers::balancer_elements(
                                 rotor, balancers::arrangement_at_balance(rotor)));
    return modes + (rotor.balancers.empty() ? 2 : std::max({4, modes / 2, of_balls}));
}

FollowedLines followed_lines(const modes::SpectrumSolver &solver, const std::vector<double> &speeds,
                             int modes, bool follow) {
    const int more_modes = std::max(4, modes / 2);
    int computed = modes_to_follow(solver.discretization().rotor(), modes);
    constexpr int attempts = 4;
    FollowedLines out;
    std::vector<char> again(speeds.size(), 1);
    for (int attempt = 1;; ++attempt) {
        solve_again(solver, speeds, again, computed, follow, out.spectra);
        if (process::process_rank() == 0) {
            out.tracking = track(solver, out.spectra, modes);
            again = left_spectrum(out.tracking.lines, speeds.size(), modes);
        }
        process::broadcast(again);
        if (attempt == attempts || std::ranges::count(again, 0) == std::ssize(again))
            return out;
        computed += more_modes;
    }
}

} // namespace whirl::tracking
