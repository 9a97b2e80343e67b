#include "tracking/followed_lines.h"

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "balancers/linear_element.h"
#include "process/processes.h"
#include "tracking/spectra.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::tracking {

namespace {

/// Whether a line that is among the `modes` lowest at some speed has left the computed part of the
/// spectrum, by speeds: there more modes find it again.
std::vector<char> left_spectrum(const FollowedLines &found, int modes) {
    const std::vector<Line> &lines = found.tracking.lines;
    const std::vector<char> low = among_lowest(lines, found.spectra, modes);
    std::vector<char> out(found.spectra.size(), 0);
    for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k] = out[k] != 0 || (low[i] != 0 && lines[i].absence[k] == Absence::beyond);
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

std::vector<char> among_lowest(const std::vector<Line> &lines,
                               const std::vector<modes::Spectrum> &spectra, int modes) {
    std::vector<char> out(lines.size(), 0);
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        const std::vector<char> low = spectra[k].lowest(modes);
        for (std::size_t i = 0; i < lines.size(); ++i)
            if (const int place = lines[i].place[k]; place != Line::absent)
                out[i] = out[i] != 0 || low[static_cast<std::size_t>(place)] != 0;
    }
    return out;
}

int modes_to_follow(const model::Rotor &rotor, int modes) {
    // With balancers some of the slowest modes are the balls', of each unknown two, but not at
    // rest.
    const int of_balls = 2 * balancers::unknowns_of(balancers::balancer_elements(
                                 rotor, balancers::arrangement_at_balance(rotor)));
    return modes + (rotor.balancers.empty() ? 2 : std::max({4, modes / 2, of_balls}));
}

FollowedLines followed_lines(const modes::SpectrumSolver &solver, const std::vector<double> &speeds,
                             int modes, bool follow, const std::vector<double> &nodes,
                             std::vector<modes::Spectrum> known) {
    const int more_modes = std::max(4, modes / 2);
    int computed = modes_to_follow(solver.discretization().rotor(), modes);
    // Each asks for half as many modes more; lines lost after them are reported as gaps.
    constexpr int attempts = 4;
    FollowedLines out;
    std::vector<char> again(speeds.size(), 1);
    out.spectra.resize(known.empty() ? 0 : speeds.size());
    for (modes::Spectrum &spectrum : known) {
        const auto k = static_cast<std::size_t>(std::ranges::lower_bound(speeds, spectrum.speed) -
                                                speeds.begin());
        out.spectra[k] = std::move(spectrum);
        again[k] = 0;
    }
    process::broadcast(again);
    SpectraBetween between;
    for (int attempt = 1;; ++attempt) {
        solve_again(solver, speeds, again, computed, follow, out.spectra);
        if (process::process_rank() == 0) {
            out.tracking = track(solver, out.spectra, modes, std::nullopt, nodes, &between);
            again = left_spectrum(out, modes);
        }
        process::broadcast(again);
        if (attempt == attempts || std::ranges::count(again, 0) == std::ssize(again))
            return out;
        computed += more_modes;
    }
}

int modes_below(const modes::SpectrumSolver &solver, double speed, double multiple, int modes) {
    const double frequency = multiple * std::abs(speed);
    const int most = 3 * modes;
    for (int ask = modes;; ask = std::min(most, 2 * ask)) {
        const modes::Spectrum spectrum = solver.at(speed, ask, modes::Errors::of_right_vectors);
        const auto below = std::ranges::count_if(spectrum.modes, [&](const modes::WhirlMode &mode) {
            return mode.eigenvalue != 0.0 && mode.eigenvalue.imag() < frequency;
        });
        if (below < ask || ask == most)
            return std::max(modes, static_cast<int>(below));
    }
}

} // namespace whirl::tracking
