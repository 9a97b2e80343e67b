#include "mesh_error/estimate.h"

#include "mesh_error/finer_model.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "results/formulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::mesh_error {

namespace {

/// Largest error of the whirl modes asked for at some speeds; infinite where the finer model has
/// more of them: too few functions for the modes.
double worst_error(const model::Case &scene, results::Form form, int order,
                   const std::vector<double> &speeds) {
    const auto modes = static_cast<std::size_t>(scene.campbell.modes);
    const modes::SpectrumSolver solver(scene.rotor, form, order);
    const FinerModel finer(scene.rotor, solver);
    double worst = 0;
    for (const double speed : speeds) {
        modes::Spectrum coarse = solver.at(speed, scene.campbell.modes);
        if (coarse.modes.size() > modes)
            coarse.modes.resize(modes);
        for (const double error : finer.errors(coarse))
            worst = std::max(worst, error);
        if (coarse.modes.size() == modes)
            continue;
        const auto fine = finer.solver().at(speed, scene.campbell.modes).modes.size();
        if (coarse.modes.size() < std::min(modes, fine))
            worst = std::numeric_limits<double>::infinity();
    }
    return worst;
}

} // namespace

int lowest_order(double tolerance, const std::function<double(int order)> &error) {
    double worst = 0;
    for (const int order : {3, 4, 5, 6, 8, 10, 12, 14, 17, 20, 24, 29}) {
        worst = error(order);
        if (worst <= tolerance)
            return order;
    }
    throw model::AnalysisFailure(
        fmt::format("order = \"auto\": the highest order 29 leaves an estimated error of {:.1e}, "
                    "the case asks for {:.1e}; use more elements a segment",
                    worst, tolerance));
}

int resolve_order(const model::Case &scene, const results::Formulation &formulation) {
    const model::Shaft &shaft = scene.rotor.shaft;
    if (!shaft.order_auto || shaft.rigid)
        return shaft.rigid ? 1 : shaft.order;
    const model::SpeedRange range = scene.speeds.value_or(model::SpeedRange{});
    std::vector<double> speeds{range.from};
    if (range.count > 1)
        speeds.insert(speeds.end(), {(range.from + range.to) / 2, range.to});
    return lowest_order(shaft.tolerance, [&](int order) {
        return worst_error(scene, formulation.form, order, speeds);
    });
}

int resolve_order_in_best_form(model::Case scene) {
    scene.formulation = model::FormChoice::automatic;
    return resolve_order(scene, modes::choose_formulation(scene));
}

} // namespace whirl::mesh_error
