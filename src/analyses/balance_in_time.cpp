#include "analyses/balance_in_time.h"

#include "analyses/simulate.h"
#include "balancers/arrangement.h"
#include "model/errors.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/simulate.h"
#include "stability/motions.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

namespace whirl::analyses {

namespace {

/// What the eigenvalues of the balanced position say at a speed; nothing where there is no such
/// position or no spectrum.
class PositionGrowth {
  public:
    explicit PositionGrowth(const std::optional<stability::StabilityModel> &model) {
        if (!model)
            return;
        _from = model->from;
        try {
            _solver = std::make_unique<stability::MotionSolver>(
                *model, balancers::arrangement_at_balance(model->rotor));
        } catch (const model::BadInput &) {        // no such position: nothing to say
        } catch (const model::AnalysisFailure &) { // no spectrum: nothing either
        }
    }

    [[nodiscard]] std::optional<double> at(double speed) const {
        try {
            if (!_solver || std::abs(speed) < _from)
                return std::nullopt;
            return stability::growth_of(_solver->at(speed));
        } catch (const model::AnalysisFailure &) {
            return std::nullopt;
        }
    }

  private:
    std::unique_ptr<stability::MotionSolver> _solver;
    double _from = 0; ///< rad/s
};

} // namespace

std::vector<results::SimulatedSpeed>
simulated_speeds(const model::Case &scene, const std::optional<stability::StabilityModel> &position,
                 std::vector<std::string> &notes) {
    std::vector<results::SimulatedSpeed> out;
    const int count = scene.balance.simulated;
    if (count == 0 || process::process_rank() != 0)
        return out;
    model::Case run = scene;
    run.simulate.run_up.clear();
    run.simulate.torque.reset();
    run.simulate.other_starts.clear();
    const PositionGrowth growth(position);
    const double step = (scene.speeds->to - scene.speeds->from) / count;
    for (int i = 0; i < count; ++i) {
        const double speed = scene.speeds->from + (i + 0.5) * step; // inside, never at rest
        run.speeds = model::SpeedRange{speed, speed, 1};
        const process::Stage stage(fmt::format("motion in time at {:.6g} rad/s", speed),
                                   static_cast<double>(i) / count, (i + 1.0) / count);
        try {
            const results::SimulateResult result = simulate(run);
            if (result.restart) // interrupted: what there is
                return out;
            out.push_back({speed, results::outcome_name(result.outcome), result.residual_ratio,
                           growth.at(speed)});
        } catch (const model::AnalysisFailure &failure) {
            notes.push_back(
                fmt::format("no motion in time at {:.6g} rad/s: {}", speed, failure.what()));
        }
    }
    return out;
}

} // namespace whirl::analyses
