#include "analyses/notes/growth.h"

#include "model/errors.h"
#include "modes/formulation.h"
#include "modes/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

/// Something feeds free motions: without it all die out, or none does.
bool may_grow(const model::Rotor &rotor) {
    const model::Shaft &shaft = rotor.shaft;
    if (!rotor.anisotropies.empty() || shaft.asymmetric() || shaft.internal_damping > 0 ||
        shaft.axial_torque != 0)
        return true;
    return !rotor.every_row([](const model::BearingCoefficients &at) {
        return model::symmetric(at.k) && !model::pushes_away(at.k) && !model::pushes_away(at.c);
    });
}

/// Speeds of the case, evenly, its ends among them.
std::vector<double> some_speeds(const model::SpeedRange &range) {
    constexpr int most = 13; // speeds, each a spectrum; the note names ranges only
    const std::vector<double> all = range.values();
    const auto n = static_cast<int>(all.size());
    std::vector<double> out;
    for (int k = 0; k < std::min(n, most); ++k)
        out.push_back(all[static_cast<std::size_t>(
            n <= most ? k : std::lround(static_cast<double>(k) * (n - 1) / (most - 1)))]);
    return out;
}

/// Largest real part of the slow motions beyond what rounding can be, 1/s; 0: none grows.
double growth_at(const ModesBeside &beside, const modes::SpectrumSolver &solver, double speed,
                 int wanted) {
    constexpr double by_matrix = 1e-5; // of the moduli: what a reduced rotor leaves out there
    const modes::Spectrum spectrum = solver.at(speed, wanted);
    double out = 0;
    for (const double real : spectrum.growing)
        out = std::max(out, real);
    for (const modes::WhirlMode &found : spectrum.modes) {
        const double left_out = solver.left_out() * std::abs(found.eigenvalue);
        modes::WhirlMode mode = found;
        // Of frequency or speed, where the solver states hardly any error: an undamped
        // rotor must not grow.
        constexpr double always = 1e-9;
        const auto noise = [&] {
            return (always + 10 * (mode.residual + mode.rounding)) *
                   std::max(std::abs(mode.eigenvalue), std::abs(speed));
        };
        const double real = mode.eigenvalue.real();
        // Without damping the reduced rotor's motions are on the axis as well.
        const bool unsure = solver.by_matrix() ? std::abs(real) > noise() &&
                                                     real > -by_matrix * std::abs(mode.eigenvalue)
                                               : left_out > 0 && real > -left_out;
        if (unsure)
            mode = beside.refined(speed, found).value_or(found);
        if (mode.eigenvalue.real() > noise())
            out = std::max(out, mode.eigenvalue.real());
    }
    return out;
}

} // namespace

void note_growing_motions(const ModesBeside &beside, results::ModelSummary &model) {
    const model::Case &scene = beside.scene();
    if (!may_grow(scene.rotor) || !scene.speeds)
        return;
    const std::vector<double> speeds = some_speeds(*scene.speeds);
    std::vector<double> growing;
    double largest = 0;
    double worst = 0;
    try {
        model::Case free = scene;
        free.formulation = model::FormChoice::automatic;
        const modes::SpectrumSolver &solver = beside.in(modes::choose_formulation(free).form);
        solver.expect(speeds, scene.campbell.modes);
        for (const double speed : speeds) {
            const double growth = growth_at(beside, solver, speed, scene.campbell.modes);
            if (growth > 0)
                growing.push_back(speed);
            if (growth > largest) {
                largest = growth;
                worst = speed;
            }
        }
    } catch (const model::Failure &) { // no more than a note
        return;
    }
    if (growing.empty())
        return;
    const auto over = as::speed.range(growing.front(), growing.back());
    if (growing.size() == speeds.size() && speeds.size() > 1) {
        model.notes.emplace_back("unstable at every speed: free motions grow at all {} speeds "
                                 "examined, from {} (fastest by {} at {}), so that no steady "
                                 "motion persists",
                                 speeds.size(), over, as::rate(largest, 4), as::speed(worst));
        return;
    }
    model.notes.emplace_back("unstable: free motions grow at {} of {} speeds examined, {} "
                             "{} (fastest by {} at {}), where the steady motion stated does "
                             "not persist; `stability` finds the onset speed",
                             growing.size(), speeds.size(), growing.size() > 1 ? "from" : "at",
                             over, as::rate(largest, 4), as::speed(worst));
}

} // namespace whirl::analyses
