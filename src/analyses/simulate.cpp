#include "analyses/simulate.h"

#include "balancers/kind.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "process/interruption.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/formulation.h"
#include "simulation/equations.h"
#include "simulation/linear_growth.h"
#include "simulation/ode_solver.h"
#include "simulation/outcome.h"
#include "simulation/recorder.h"
#include "simulation/restart.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

/// From this ratio of fastest decay to spin speed on the implicit method needs fewer evaluations.
/// Fast shapes that are hardly damped are left to the explicit one, which follows them better.
constexpr double stiff_from = 300;

/// Fastest decay of the shaft on its supports, 1/s.
double fastest_decay(const reduction::ReducedRotor &rotor, double speed) {
    const Eigen::Index r = rotor.size();
    const reduction::ReducedRotor::Supports at = rotor.supports_at(speed);
    // On (q, q' / |speed|), so that all entries are frequencies, whatever the unit of time.
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4 * r, 4 * r);
    A.topRightCorner(2 * r, 2 * r).diagonal().setConstant(std::abs(speed));
    A.bottomLeftCorner(2 * r, 2 * r) = -at.stiffness;
    A.bottomRightCorner(2 * r, 2 * r) = -at.damping;
    for (const Eigen::Index plane : {Eigen::Index{0}, r}) {
        A.block(2 * r + plane, plane, r, r) -= rotor.elastic;
        A.block(2 * r + plane, 2 * r + plane, r, r) -= rotor.internal;
    }
    A.bottomLeftCorner(2 * r, 2 * r) /= std::abs(speed);
    A.block(2 * r, 3 * r, r, r) -= speed * rotor.gyroscopic;
    A.block(3 * r, 2 * r, r, r) += speed * rotor.gyroscopic;
    return -A.eigenvalues().real().minCoeff();
}

/// Sizes below which an error does not matter, by kinds of unknowns.
struct Scales {
    double displacement = 0; ///< modal, sqrt(kg) m
    double speed = 0;        ///< rad/s
    double energy = 0;       ///< J
};

Scales scales_of(const simulation::MotionScene &motion) {
    double moment = 0;
    for (const simulation::FixedMass &mass : motion.parts.fixed)
        moment += std::abs(mass.mass.moment);
    moment += motion.moment;
    const double mass = motion.parts.rotor.mass;
    const double speed = motion.fastest;
    return {0.01 * moment / std::sqrt(mass), speed, moment * moment / mass * speed * speed};
}

/// The error allowed in each unknown: `tolerance` times the size of its kind.
void allowed_error(const simulation::RotorMotion &motion, const Scales &scales, double tolerance,
                   const double *state, double *allowed) {
    const int n = motion.coordinates();
    const int shapes = motion.first_angle();
    const auto norm = [&](int first) {
        return Eigen::Map<const Eigen::VectorXd>(state + first, shapes).norm();
    };
    // Of all shapes the same energy may be wrong: that of a fast one moves the balls as much as
    // that of a slow one, and there is less displacement in it.
    const double p = tolerance * std::max(norm(0), scales.displacement);
    const Eigen::VectorXd &frequencies = motion.parts().rotor.frequencies;
    for (int i = 0; i < shapes; ++i) {
        allowed[n + i] = p * scales.speed;
        allowed[i] = p * scales.speed / std::max(scales.speed, frequencies(i % frequencies.size()));
    }
    std::fill(allowed + shapes, allowed + n, tolerance);
    std::fill(allowed + n + shapes, allowed + 2 * n, tolerance * scales.speed);
    if (motion.parts().motor) {
        allowed[2 * n] = tolerance;
        allowed[2 * n + 1] = tolerance * scales.speed;
    }
    double *books = allowed + motion.books();
    const double *values = state + motion.books();
    books[0] = tolerance * std::max(std::abs(values[0]), scales.energy);
    books[1] = tolerance * std::max(std::abs(values[1]), scales.energy);
    books[2] = tolerance * std::max(std::abs(values[2]), scales.energy / scales.speed);
}

/// State at the start: all at rest, the free masses at their angles.
Eigen::VectorXd rest(const simulation::RotorMotion &motion, const simulation::MotionScene &scene) {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(motion.size());
    for (std::size_t i = 0; i < scene.start_angles.size(); ++i)
        state(motion.first_angle() + static_cast<Eigen::Index>(i)) = scene.start_angles[i];
    if (motion.parts().motor)
        state(2 * motion.coordinates() + 1) = motion.parts().spin.at(0, 0).speed;
    return state;
}

std::vector<reduction::Row> recorded_rows(const simulation::MotionScene &scene) {
    std::vector<reduction::Row> rows;
    for (const int plane : scene.plane_of)
        rows.push_back(scene.parts.planes[static_cast<std::size_t>(plane)].w);
    return rows;
}

/// One integration from its start (or restart) to its end (or interruption).
class Run {
  public:
    Run(const model::Case &scene, simulation::MotionScene &motion)
        : _scene(scene), _prepared(motion), _motion(motion.parts),
          _recorder(_motion, recorded_rows(motion), scene.simulate.time,
                    scene.simulate.output_points),
          _scales(scales_of(motion)),
          _stiff(fastest_decay(motion.parts.rotor, motion.fastest) > stiff_from * motion.fastest),
          _solver(problem(), _stiff ? simulation::OdeMethod::implicit_stiff
                                    : simulation::OdeMethod::explicit_high_order) {}

    /// @returns whether the end was reached.
    bool integrate(const model::Restart *from);

    void fill(results::SimulateResult &result) const;
    [[nodiscard]] model::Restart restart() const;

  private:
    const model::Case &_scene;
    const simulation::MotionScene &_prepared;
    simulation::RotorMotion _motion;
    simulation::MotionRecorder _recorder;
    Scales _scales;
    bool _stiff;
    simulation::OdeSolver _solver;
    double _t = 0;
    double _energy = 0;
    double _momentum = 0;

    simulation::OdeProblem problem() {
        return {_motion.size(),
                [this](double t, const double *y, double *rates) { _motion.rates(t, y, rates); },
                [this](const double *y, double *allowed) {
                    // Fast shapes gather the errors of the implicit method, in which their speed
                    // does not shorten the steps.
                    const double tolerance = _scene.simulate.tolerance * (_stiff ? 0.01 : 1);
                    allowed_error(_motion, _scales, tolerance, y, allowed);
                }};
    }

    /// Times at which the solver must stop: outputs and jumps of the acceleration.
    [[nodiscard]] std::vector<double> stops() const {
        std::vector<double> stops = _recorder.times();
        if (!_motion.parts().motor)
            for (const double jump : _motion.parts().spin.jumps())
                if (jump < _scene.simulate.time)
                    stops.push_back(jump);
        std::sort(stops.begin(), stops.end());
        stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
        return stops;
    }

    void begin(const model::Restart *from);
    bool reach(double stop);
};

void Run::begin(const model::Restart *from) {
    Eigen::VectorXd state = rest(_motion, _prepared);
    if (from) {
        _t = from->time;
        state = simulation::state_of(*from, _scene, _motion);
        _recorder.resume(
            *from, simulation::series_of(*from, _prepared.plane_of.size(),
                                         static_cast<std::size_t>(_motion.parts().free_angles())));
        _energy = from->energy;
        _momentum = from->momentum;
    } else {
        _recorder.output(0, state.data());
        _energy = _motion.energy(0, state.data());
        _momentum = _motion.momentum(0, state.data());
    }
    _motion.enter_piece(std::nextafter(_t, HUGE_VAL));
    _solver.start(_t, state.data(), from ? from->step : 0);
}

bool Run::reach(double stop) {
    while (_t < stop) {
        if (process::take_interruption())
            return false;
        _t = _solver.step(stop);
        _recorder.step(_t, _solver.state());
        process::report_progress(_t / _scene.simulate.time);
    }
    return true;
}

bool Run::integrate(const model::Restart *from) {
    begin(from);
    const std::vector<double> jumps = _motion.parts().spin.jumps();
    const std::vector<double> &outputs = _recorder.times();
    for (const double stop : stops()) {
        if (stop <= _t)
            continue;
        if (!reach(stop))
            return false;
        if (std::binary_search(outputs.begin(), outputs.end(), stop))
            _recorder.output(_t, _solver.state());
        if (!_motion.parts().motor && std::binary_search(jumps.begin(), jumps.end(), stop)) {
            const Eigen::VectorXd state =
                Eigen::Map<const Eigen::VectorXd>(_solver.state(), _motion.size());
            _motion.enter_piece(std::nextafter(stop, HUGE_VAL));
            _solver.start(_t, state.data());
        }
    }
    return true;
}

model::Restart Run::restart() const {
    model::Restart restart =
        simulation::restart_of(_scene.rotor, _motion, _solver.state(), _recorder.series());
    _recorder.save(restart);
    restart.case_name = _scene.name;
    restart.time = _t;
    restart.step = _solver.next_step();
    restart.energy = _energy;
    restart.momentum = _momentum;
    return restart;
}

void Run::fill(results::SimulateResult &result) const {
    const double *state = _solver.state();
    const double *books = state + _motion.books();
    const double energy = _motion.energy(_t, state) - _energy;
    const double momentum = _motion.momentum(_t, state) - _momentum;
    result.audit = {energy - books[0] + books[1],
                    std::max({std::abs(energy), std::abs(books[0]), std::abs(books[1])}),
                    momentum - books[2], std::max(std::abs(momentum), std::abs(books[2]))};
    if (_motion.parts().motor) { // the spin itself takes part in the exchange
        result.audit.energy_scale = std::max(result.audit.energy_scale, std::abs(_energy));
        result.audit.momentum_scale = std::max(result.audit.momentum_scale, std::abs(_momentum));
    }
    result.time = _t;
    result.speed = _motion.spin(_t, state).speed;
    const double turned =
        _motion.parts().motor ? state[2 * _motion.coordinates()] : _motion.parts().spin.turned(_t);
    result.revolutions = turned / (2 * 3.14159265358979323846);
    result.series = _recorder.series();
    result.integrator = _stiff ? "diagonally implicit Runge-Kutta, order 5 (stiff)"
                               : "explicit Runge-Kutta, order 8";
    const simulation::OdeCounts counts = _solver.counts();
    result.steps = counts.steps;
    result.rate_evaluations = counts.rates;
    for (const double amplitude : _recorder.last_amplitudes()) {
        result.balancers.emplace_back();
        result.balancers.back().amplitude = amplitude;
    }
}

void describe_model(const model::Case &scene, const simulation::MotionScene &motion,
                    results::SimulateResult &result) {
    const reduction::ReducedRotor &rotor = motion.parts.rotor;
    result.model.formulation = {results::Form::general,
                                "motion in time, fixed frame: modal coordinates of "
                                "the shaft in x and y, an angle for each ball"};
    result.model.order = motion.order;
    result.model.elements = motion.elements;
    result.model.unknowns = 2 * rotor.size() + motion.parts.free_angles();
    result.model.notes = motion.notes;
    result.modes = rotor.modes;
    result.shapes = rotor.size();
    result.response_error = rotor.response_error;
    result.frequency_error = rotor.frequency_error;
    result.start_angles = motion.start_angles;
    if (std::max(rotor.response_error, rotor.frequency_error) > scene.simulate.reduction_tolerance)
        result.model.notes.push_back(
            fmt::format("{} modes of the shaft (simulate.modes) leave a relative error of {:.1e}",
                        rotor.modes, std::max(rotor.response_error, rotor.frequency_error)));
}

/// Of each balancer, in the rotor, rad.
std::vector<std::vector<double>> last_angles(const model::Case &scene,
                                             const results::MotionSeries &series) {
    std::vector<std::vector<double>> angles;
    std::size_t next = 0;
    for (const model::Balancer &b : scene.rotor.balancers) {
        angles.emplace_back();
        for (std::size_t j = 0; j < balancers::kind_of(b)->coordinates().size(); ++j)
            angles.back().push_back(series.angles[next++].back());
    }
    return angles;
}

/// A motion that grows beyond all numbers has an outcome all the same: what was followed is judged.
void end_early(results::SimulateResult &result, const std::string &failure) {
    constexpr std::size_t enough = 100; // points of the series
    if (result.series.time.size() < enough)
        throw model::AnalysisFailure(failure);
    result.time = result.series.time.back();
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        result.balancers[i].amplitude = result.series.amplitude[i].back();
    result.model.notes.push_back(
        fmt::format("{}; it was followed for {:.6g} s", failure, result.time));
}

/// One motion, told apart where it was interrupted by result.restart.
results::SimulateResult motion_from(const model::Case &scene, simulation::MotionScene &motion,
                                    const model::Restart *from) {
    results::SimulateResult result;
    describe_model(scene, motion, result);
    Run run(scene, motion);
    std::string failure;
    try {
        if (!run.integrate(from))
            result.restart = run.restart();
    } catch (const linalg::SolverError &error) {
        failure = std::string("the motion cannot be integrated: ") + error.what();
    }
    run.fill(result);
    if (result.restart)
        return result;
    if (!failure.empty())
        end_early(result, failure);
    try {
        const std::vector<double> references =
            simulation::unbalanced_amplitudes(scene, motion.order, result.speed);
        for (std::size_t i = 0; i < references.size(); ++i)
            result.balancers[i].reference = references[i];
    } catch (const model::AnalysisFailure &no_growth) { // the motion is worth having all the same
        result.model.notes.push_back(fmt::format(
            "{}; balanced is judged by the amplitude of a free rotor", no_growth.what()));
    }
    if (simulation::ends_at_constant_speed(result))
        result.linear_growth =
            simulation::linear_growth(scene, result.speed, last_angles(scene, result.series));
    simulation::classify(scene, result);
    if (!failure.empty() && result.outcome != results::Outcome::growing)
        throw model::AnalysisFailure(failure);
    return result;
}

results::OtherStart other_start(const results::SimulateResult &motion) {
    results::OtherStart out{
        motion.start_angles, motion.outcome, motion.evidence, motion.residual_ratio, {}, {}};
    for (const results::BalancerMotion &b : motion.balancers)
        out.angles.push_back(b.angles);
    for (const std::vector<double> &plane : motion.series.amplitude) {
        out.amplitude.resize(plane.size(), 0);
        for (std::size_t k = 0; k < plane.size(); ++k)
            out.amplitude[k] = std::max(out.amplitude[k], plane[k]);
    }
    return out;
}

/// The motions from simulate.other_starts; ends early where interrupted, and says so.
void add_other_starts(const model::Case &scene, simulation::MotionScene &motion,
                      results::SimulateResult &result) {
    for (const auto &start : scene.simulate.other_starts) {
        motion.start_angles = simulation::start_of(scene.rotor, start);
        const results::SimulateResult other = motion_from(scene, motion, nullptr);
        if (other.restart) {
            result.model.notes.push_back(
                fmt::format("interrupted: {} of {} other starts were followed to the end",
                            result.other_starts.size(), scene.simulate.other_starts.size()));
            return;
        }
        result.other_starts.push_back(other_start(other));
    }
}

} // namespace

results::SimulateResult simulate(const model::Case &scene, const model::Restart *from) {
    if (process::process_rank() != 0)
        return {};
    simulation::MotionScene motion = simulation::motion_scene(scene);
    results::SimulateResult result = motion_from(scene, motion, from);
    if (!result.restart)
        add_other_starts(scene, motion, result);
    return result;
}

} // namespace whirl::analyses
