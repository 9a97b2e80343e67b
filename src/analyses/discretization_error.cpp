#include "analyses/discretization_error.h"

#include "analyses/finer_model.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::analyses {

int resolve_order(const model::Case &scene, const Formulation &formulation) {
    const model::Shaft &shaft = scene.rotor.shaft;
    if (!shaft.order_auto || shaft.rigid)
        return shaft.rigid ? 1 : shaft.order;
    const model::SpeedRange range = scene.speeds.value_or(model::SpeedRange{});
    std::vector<double> speeds{range.from};
    if (range.count > 1)
        speeds.insert(speeds.end(), {(range.from + range.to) / 2, range.to});
    const auto modes = static_cast<std::size_t>(scene.campbell.modes);
    double worst = 0;
    for (const int order : {3, 4, 5, 6, 8, 10, 12, 14, 17, 20, 24, 29}) {
        const SpectrumSolver solver(scene.rotor, formulation.form, order);
        const FinerModel finer(scene.rotor, solver);
        worst = 0;
        for (const double speed : speeds) {
            Spectrum coarse = solver.at(speed, scene.campbell.modes);
            if (coarse.modes.size() > modes)
                coarse.modes.resize(modes);
            for (const double error : finer.errors(coarse))
                worst = std::max(worst, error);
            const auto fine = finer.solver().at(speed, scene.campbell.modes).modes.size();
            if (coarse.modes.size() < std::min(modes, fine)) // too few functions for the modes
                worst = std::numeric_limits<double>::infinity();
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
