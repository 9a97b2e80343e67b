#include "analyses/balance_tier_three.h"

#include "analyses/progress.h"
#include "analyses/simulate.h"
#include "linalg/session.h"
#include "model/errors.h"

#include <fmt/format.h>

namespace whirl::analyses {

std::vector<SimulatedSpeed> simulated_speeds(const model::Case &scene,
                                             std::vector<std::string> &notes) {
    std::vector<SimulatedSpeed> out;
    const int count = scene.balance.simulated;
    if (count == 0 || scene.rotor.balancers.empty() || linalg::process_rank() != 0)
        return out;
    model::Case run = scene;
    run.simulate.run_up.clear();
    run.formulation = model::FormChoice::automatic;
    const double step = (scene.speeds->to - scene.speeds->from) / count;
    for (int i = 0; i < count; ++i) {
        const double speed = scene.speeds->from + (i + 0.5) * step; // inside, never at rest
        run.speeds = model::SpeedRange{speed, speed, 1};
        try {
            const SimulateResult result = simulate(run);
            if (result.restart) // interrupted: what there is
                return out;
            out.push_back({speed, outcome_name(result.outcome), result.residual_ratio});
        } catch (const model::AnalysisFailure &failure) {
            notes.push_back(
                fmt::format("no motion in time at {:.6g} rad/s: {}", speed, failure.what()));
        }
        report_progress(0.5 + 0.5 * (i + 1) / count);
    }
    return out;
}

} // namespace whirl::analyses
