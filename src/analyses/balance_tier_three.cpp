#include "analyses/balance_tier_three.h"

#include "analyses/arrangement.h"
#include "analyses/motions.h"
#include "analyses/progress.h"
#include "analyses/simulate.h"
#include "analyses/stability_model.h"
#include "linalg/session.h"
#include "model/errors.h"

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
    explicit PositionGrowth(const model::Case &scene) {
        model::Case real = scene;
        real.formulation = model::FormChoice::automatic;
        try {
            const StabilityModel model = stability_model(real, search_speeds(*scene.speeds));
            _from = model.from;
            _solver = std::make_unique<MotionSolver>(scene.rotor, model.form, model.order,
                                                     arrangement_at_balance(scene.rotor),
                                                     model.harmonics);
        } catch (const model::BadInput &) {        // no such position: nothing to say
        } catch (const model::AnalysisFailure &) { // no spectrum: nothing either
        }
    }

    [[nodiscard]] std::optional<double> at(double speed) const {
        try {
            if (!_solver || std::abs(speed) < _from)
                return std::nullopt;
            return growth_of(_solver->at(speed));
        } catch (const model::AnalysisFailure &) {
            return std::nullopt;
        }
    }

  private:
    std::unique_ptr<MotionSolver> _solver;
    double _from = 0; ///< rad/s
};

} // namespace

std::vector<SimulatedSpeed> simulated_speeds(const model::Case &scene,
                                             std::vector<std::string> &notes) {
    std::vector<SimulatedSpeed> out;
    const int count = scene.balance.simulated;
    if (count == 0 || scene.rotor.balancers.empty() || linalg::process_rank() != 0)
        return out;
    model::Case run = scene;
    run.simulate.run_up.clear();
    run.simulate.torque.reset();
    run.simulate.other_starts.clear();
    run.formulation = model::FormChoice::automatic;
    const PositionGrowth growth(scene);
    const double step = (scene.speeds->to - scene.speeds->from) / count;
    for (int i = 0; i < count; ++i) {
        const double speed = scene.speeds->from + (i + 0.5) * step; // inside, never at rest
        run.speeds = model::SpeedRange{speed, speed, 1};
        try {
            const SimulateResult result = simulate(run);
            if (result.restart) // interrupted: what there is
                return out;
            out.push_back(
                {speed, outcome_name(result.outcome), result.residual_ratio, growth.at(speed)});
        } catch (const model::AnalysisFailure &failure) {
            notes.push_back(
                fmt::format("no motion in time at {:.6g} rad/s: {}", speed, failure.what()));
        }
        report_progress(0.5 + 0.5 * (i + 1) / count);
    }
    return out;
}

} // namespace whirl::analyses
