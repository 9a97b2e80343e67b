#include "tracking/bands/lock_count.h"

#include "tracking/bands/locked_whirl.h"

#include <algorithm>
#include <iterator>

namespace whirl::tracking {

Count count_of(const modes::SpectrumSolver &solver, const modes::Spectrum &spectrum) {
    const double speed = spectrum.speed;
    Count out{speed, 0, spectrum.modes};
    const auto others =
        std::partition(out.others.begin(), out.others.end(),
                       [speed](const modes::WhirlMode &mode) { return !locked(mode, speed); });
    out.motions = std::distance(others, out.others.end());
    out.others.erase(others, out.others.end());
    const auto turn = [&](const modes::WhirlMode &mode) {
        return turn_in_rotor(mode, speed, solver.form());
    };
    std::ranges::sort(out.others, {}, turn);
    return out;
}

Count count_at(const modes::SpectrumSolver &solver, double speed, int wanted) {
    return count_of(solver, solver.at(speed, wanted, modes::Errors::of_right_vectors));
}

} // namespace whirl::tracking
