#pragma once

#include "model/case.h"
#include "model/restart.h"
#include "results/simulate.h"
#include "simulation/dry/dry_events.h"
#include "simulation/equations.h"
#include "simulation/ode_solver.h"
#include "simulation/recorder.h"
#include "simulation/stations/station_recorder.h"

#include <memory>
#include <optional>

namespace whirl::simulation {

/// One integration from its start (or restart) to its end (or interruption).
class Run {
  public:
    /// Both must outlive this.
    Run(const model::Case &scene, const MotionScene &motion);

    /// @returns whether the end was reached.
    /// @throws linalg::SolverError where the integration cannot go on.
    bool integrate(const model::Restart *from);

    /// Time, speed, series, integrator, audit, stations; amplitudes of balancers.
    void fill(results::SimulateResult &result);
    /// Between two times at one speed.
    [[nodiscard]] results::HeldMotion motion_between(double from, double until) const;
    [[nodiscard]] model::Restart restart() const;

    /// Where it stands, in axes that turn with the rotor: the reduced rotor and the free angles,
    /// then their velocities (those of the rotor in axes that stand still, seen from the rotor).
    [[nodiscard]] Eigen::VectorXd end_in_rotor_axes() const;
    [[nodiscard]] OdeMethod method() const { return _method; }
    /// The mass eccentricity that all parts and imbalances make together, m.
    [[nodiscard]] double eccentricity() const;

  private:
    /// Sizes below which an error does not matter, by kinds of unknowns.
    struct Scales {
        double displacement = 0; ///< modal, sqrt(kg) m
        double speed = 0;        ///< rad/s
        double energy = 0;       ///< J
    };

    const model::Case &_scene;
    const MotionScene &_prepared;
    RotorMotion _motion;
    MotionRecorder _recorder;
    Scales _scales;
    OdeMethod _method;
    StationRecorder _stations;
    OdeSolver _solver;
    std::optional<DryEvents> _dry; ///< where parts touch or resist
    double _t = 0;
    RotorMotion::Totals _before; ///< at the start, with all that came to turn since

    [[nodiscard]] static Scales scales_of(const MotionScene &motion);
    void allowed_error(const double *state, double *allowed) const;
    [[nodiscard]] OdeProblem problem();
    [[nodiscard]] TurningAxes axes() const;
    [[nodiscard]] Eigen::VectorXd first_state() const;
    [[nodiscard]] std::vector<double> stops() const;
    void begin(const model::Restart *from);
    void disturb(double time, Eigen::VectorXd &state) const;
    void pass_jump(double time);
    bool reach(double stop);
    void step(double stop);
    void fill_audit(results::SimulateResult &result) const;
    void fill_stations(results::SimulateResult &result);
    void fill_series(results::SimulateResult &result) const;
    [[nodiscard]] double first_amplitude(std::size_t station) const;
    [[nodiscard]] results::PeakInTime refined(std::size_t station, const PeakCandidate &candidate);
    [[nodiscard]] results::PeakInTime integrated(std::size_t station,
                                                 const PeakCandidate &candidate);
    [[nodiscard]] double speed_at(double t) const;
};

} // namespace whirl::simulation
