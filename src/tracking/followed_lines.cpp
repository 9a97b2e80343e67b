#include "tracking/followed_lines.h"

#include "assembly/discretization.h"
#include "process/processes.h"
#include "tracking/spectra.h"

#include <algorithm>

namespace whirl::tracking {

namespace {

/// Where a line leaves the computed part of the spectrum more modes find it again.
bool left_spectrum(const Line &line) {
    return std::count(line.absence.begin(), line.absence.end(), Absence::beyond) > 0;
}

} // namespace

bool among_lowest(const Line &line, int modes) {
    return std::any_of(line.place.begin(), line.place.end(),
                       [modes](int place) { return place != Line::absent && place < modes; });
}

FollowedLines followed_lines(const modes::SpectrumSolver &solver, const std::vector<double> &speeds,
                             int modes, bool follow) {
    // With balancers some of the slowest modes are the balls': lines leave and come back.
    const int more_modes = std::max(4, modes / 2);
    const bool balanced = !solver.discretization().rotor().balancers.empty();
    int computed = modes + (balanced ? more_modes : 2);
    FollowedLines out;
    for (int attempt = 0;; ++attempt) {
        out.spectra = spectra_at(solver, speeds, computed, follow);
        std::vector<char> more(1, 0);
        if (process::process_rank() == 0) {
            out.tracking = track(solver, out.spectra, modes);
            const std::vector<Line> &lines = out.tracking.lines;
            more[0] =
                attempt < 3 && std::any_of(lines.begin(), lines.end(), [modes](const Line &l) {
                    return among_lowest(l, modes) && left_spectrum(l);
                });
        }
        process::broadcast(more);
        if (more[0] == 0)
            return out;
        computed += more_modes;
    }
}

} // namespace whirl::tracking
