#include "analyses/modes.h"

#include "mesh_error/estimate.h"
#include "model/case.h"
#include "modes/formulation.h"
#include "modes/orbits.h"
#include "modes/spectrum.h"
#include "process/parallel.h"
#include "results/modes.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace whirl::analyses {

namespace {

/// Points inside each span so that the whole shaft has some 120 stations, and each span at least
/// its ends.
int inner_stations(int spans) { return std::max(0, (120 + spans - 1) / spans - 1); }

std::vector<std::complex<double>> scaled(const Eigen::VectorXcd &values,
                                         std::complex<double> largest) {
    std::vector<std::complex<double>> out;
    for (const std::complex<double> &value : values)
        out.push_back(value / largest);
    return out;
}

/// The component of largest modulus, the first of equal ones; 1 where all are zero.
std::complex<double> largest_component(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y) {
    std::complex<double> largest = 0;
    for (const Eigen::VectorXcd *values : {&x, &y})
        for (const std::complex<double> &value : *values)
            if (std::abs(value) > (1 + 1e-9) * std::abs(largest)) // not for rounding to choose
                largest = value;
    return largest == 0.0 ? 1.0 : largest;
}

results::ModeShape shape_of(const modes::SpectrumSolver &solver, const modes::Stations &stations,
                            const modes::WhirlMode &mode) {
    const Eigen::VectorXcd x = solver.x_at(mode, stations);
    const Eigen::VectorXcd y = solver.y_at(mode, stations);
    const std::complex<double> largest = largest_component(x, y);
    return {"",
            mode.eigenvalue,
            mode.whirl,
            mode.forward_fraction,
            scaled(x, largest),
            scaled(y, largest)};
}

char letter(results::Whirl whirl) {
    return whirl == results::Whirl::forward ? 'F' : whirl == results::Whirl::backward ? 'B' : 'M';
}

} // namespace

results::ModesResult mode_shapes(const model::Case &scene) {
    results::ModesResult result;
    result.speed = model::required_speeds(scene).from;
    result.model.formulation = modes::choose_formulation(scene);
    result.model.order = mesh_error::resolve_order(scene, result.model.formulation);
    const modes::SpectrumSolver solver(scene.rotor, result.model.formulation.form,
                                       result.model.order);
    result.model.elements = static_cast<int>(solver.discretization().shaft_mesh().spans.size());
    result.model.unknowns = solver.unknowns();
    const modes::Stations stations(solver.discretization(), inner_stations(result.model.elements));
    result.z = stations.z();
    modes::Spectrum spectrum = solver.at(result.speed, scene.campbell.modes);
    if (static_cast<int>(spectrum.modes.size()) > scene.campbell.modes)
        spectrum.modes.resize(static_cast<std::size_t>(scene.campbell.modes));
    std::map<results::Whirl, int> counted;
    for (const modes::WhirlMode &mode : spectrum.modes) {
        result.modes.push_back(shape_of(solver, stations, mode));
        result.modes.back().label = fmt::format("{}{}", ++counted[mode.whirl], letter(mode.whirl));
    }
    for (const double root : spectrum.growing)
        result.model.notes.push_back(
            fmt::format("divergence (static instability): a real eigenvalue of {:+.6g} 1/s, motion "
                        "grows without whirling",
                        root));
    if (static_cast<int>(result.modes.size()) < scene.campbell.modes)
        result.model.notes.push_back(
            fmt::format("{} modes were asked for, the rotor has {} that oscillate",
                        scene.campbell.modes, result.modes.size()));
    return result;
}

} // namespace whirl::analyses
