#include "analyses/discretization_error.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::analyses {

std::unique_ptr<SpectrumSolver> finer_solver(const model::Rotor &rotor, Form form, int order,
                                             int refinement) {
    const bool classical = order == 1;
    return std::make_unique<SpectrumSolver>(rotor, form, classical ? 1 : order + 1,
                                            classical ? 2 * refinement : refinement,
                                            SpectrumSolver::hill_harmonics + 2);
}

std::vector<double> discretization_errors(const Spectrum &coarse, const Spectrum &fine, int order) {
    const double factor = order == 1 ? 4.0 / 3.0 : 1.0;
    std::vector<double> errors;
    for (const WhirlMode &mode : coarse.modes) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const WhirlMode &other : fine.modes) {
            // Between crossing modes the sense of whirl tells which is which.
            const double penalty = mode.whirl == other.whirl ? 0 : 1e-3 * std::abs(mode.eigenvalue);
            const double distance = std::abs(mode.eigenvalue - other.eigenvalue);
            if (distance + penalty < nearest)
                nearest = distance + (penalty > 0 && distance < penalty ? 0 : penalty);
        }
        const double size = std::abs(mode.eigenvalue);
        errors.push_back(size == 0 ? 0 : factor * nearest / size);
    }
    return errors;
}

int resolve_order(const model::Case &scene, const Formulation &formulation) {
    const model::Shaft &shaft = scene.rotor.shaft;
    if (!shaft.order_auto || shaft.rigid)
        return shaft.rigid ? 1 : shaft.order;
    const model::SpeedRange range = scene.speeds.value_or(model::SpeedRange{});
    const std::vector<double> ends = range.count > 1 ? std::vector<double>{range.from, range.to}
                                                     : std::vector<double>{range.from};
    const auto modes = static_cast<std::size_t>(scene.campbell.modes);
    double worst = 0;
    for (const int order : {3, 4, 5, 6, 8, 10, 12, 14, 17, 20, 24, 29}) {
        const SpectrumSolver solver(scene.rotor, formulation.form, order);
        const auto finer = finer_solver(scene.rotor, formulation.form, order);
        worst = 0;
        for (const double speed : ends) {
            Spectrum coarse = solver.at(speed, scene.campbell.modes);
            if (coarse.modes.size() > modes)
                coarse.modes.resize(modes);
            const Spectrum fine = finer->at(speed, scene.campbell.modes + 2);
            for (const double error : discretization_errors(coarse, fine, order))
                worst = std::max(worst, error);
        }
        if (worst <= shaft.tolerance)
            return order;
    }
    throw model::AnalysisFailure(
        fmt::format("order = \"auto\": the highest order 29 leaves an estimated error of {:.1e}, "
                    "the case asks for {:.1e}; use more elements a segment",
                    worst, shaft.tolerance));
}

} // namespace whirl::analyses
