#include "simulation/run.h"

#include "linalg/dense/products.h"
#include "model/errors.h"
#include "process/interruption.h"
#include "process/progress.h"
#include "reduction/damped_motions.h"
#include "simulation/dry/dry_state.h"
#include "simulation/held_motion.h"
#include "simulation/restart.h"
#include "simulation/scene_outside.h"
#include "simulation/trend.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::simulation {

namespace {

/// From this ratio of fastest decay to spin speed on the implicit method needs fewer evaluations.
/// Fast shapes that are hardly damped are left to the explicit one, which follows them better.
constexpr double stiff_from = 300;

/// Fastest decay of the shaft on its supports, 1/s.
double fastest_decay(const reduction::ReducedRotor &rotor, double speed) {
    return -reduction::damped_eigenvalues(rotor, std::abs(speed)).real().minCoeff();
}

/// Deflections and velocities at time 0 of the steady motion under the eccentricities that are
/// there from the start: (p; p'), 4r entries.
/// @throws model::AnalysisFailure at a resonance without damping.
Eigen::VectorXd steady_motion(const MovingParts &parts) {
    using Complex = std::complex<double>;
    const reduction::ReducedRotor &rotor = parts.rotor;
    const Eigen::Index r = rotor.size();
    const double speed = parts.spin.at(0, 0).speed;
    const Complex i(0, 1);
    const reduction::ReducedRotor::Supports at = rotor.supports_at(speed);
    Eigen::MatrixXcd A = at.stiffness.cast<Complex>() + i * speed * at.damping;
    if (rotor.mass_deviation.size() > 0)
        A -= speed * speed * rotor.mass_deviation;
    for (const Eigen::Index plane : {Eigen::Index{0}, r}) {
        A.block(plane, plane, r, r) += rotor.elastic + i * speed * rotor.internal;
        A.block(plane, plane, r, r).diagonal().array() -= speed * speed;
    }
    const Eigen::MatrixXcd across = i * speed * speed * rotor.gyroscopic + speed * rotor.internal;
    A.topRightCorner(r, r) += across;
    A.bottomLeftCorner(r, r) -= across;
    Eigen::VectorXcd load = Eigen::VectorXcd::Zero(2 * r);
    for (const FixedMass &mass : parts.fixed) {
        if (mass.from > 0)
            continue;
        const Complex force = mass.mass.moment * speed * speed * std::exp(i * mass.phase);
        load.head(r) += force * mass.row;
        load.tail(r) -= i * force * mass.row;
    }
    const Eigen::PartialPivLU<Eigen::MatrixXcd> factors(A);
    const Eigen::VectorXcd p = linalg::solved(factors, load);
    constexpr double resonance = 1e-13; // of the condition: no digit is left
    if (!p.allFinite() || linalg::reciprocal_condition(factors) < resonance)
        throw model::AnalysisFailure(
            model::Sentence("no steady motion to start from at {}: the rotor is at a resonance "
                            "without damping, or free to move",
                            model::as::speed(speed)));
    Eigen::VectorXd state(4 * r);
    state << p.real(), (i * speed * p).real();
    return state;
}

/// Planes of the balancers, then stations.
std::vector<reduction::Row> recorded_rows(const MotionScene &scene) {
    std::vector<reduction::Row> rows;
    for (const FreeParts &free : scene.parts.free)
        rows.push_back(scene.parts.planes[static_cast<std::size_t>(free.plane)].w);
    rows.insert(rows.end(), scene.stations.rows.begin(), scene.stations.rows.end());
    return rows;
}

RotorMotion moving(const MotionScene &scene, bool given) {
    RotorMotion motion(scene.parts);
    motion.set_dry(dry_state(motion.parts(), scene.start_angles, scene.fastest, given));
    return motion;
}

} // namespace

Run::Run(const model::Case &scene, const MotionScene &motion)
    : _scene(scene), _prepared(motion),
      _motion(moving(motion, !scene.simulate.ball_angles.empty())),
      _recorder(_motion, recorded_rows(motion), scene.simulate.time, scene.simulate.output_points),
      _scales(scales_of(motion)),
      _method(fastest_decay(motion.parts.rotor, motion.fastest) > stiff_from * motion.fastest
                  ? OdeMethod::implicit_stiff
                  : OdeMethod::explicit_high_order),
      _stations(_motion, recorded_rows(motion), motion.parts.free.size(), scene.simulate.time,
                std::max(motion.fastest, fastest_outside(scene, 0)), axes().speed),
      _solver(problem(), _method) {
    if (_motion.dry().any())
        _dry.emplace(_motion, motion.fastest, std::make_unique<OdeSolver>(problem(), _method));
}

Run::Scales Run::scales_of(const MotionScene &motion) {
    double moment = motion.moment;
    for (const FixedMass &mass : motion.parts.fixed)
        moment += std::abs(mass.mass.moment);
    const double mass = motion.parts.rotor.mass;
    const double speed = motion.fastest;
    return {0.01 * moment / std::sqrt(mass), speed, moment * moment / mass * speed * speed};
}

/// The error allowed in each unknown: the tolerance times the size of its kind.
void Run::allowed_error(const double *state, double *allowed) const {
    // Dampers so strong that they make the motion stiff lose energy by velocities that are small
    // differences: what is wrong with these counts ten thousand times. (A flexible rotor
    // on dampers of 1e6 N s/m misses 5e-5 of its energy without this, 1e-6 where it counts a
    // thousand times, 3e-7 so.)
    const double tolerance =
        _scene.simulate.tolerance * (_method == OdeMethod::implicit_stiff ? 1e-4 : 1);
    const int n = _motion.coordinates();
    const int shapes = _motion.first_angle();
    // Of all shapes the same energy may be wrong: that of a fast one moves the balls as much as
    // that of a slow one, and there is less displacement in it.
    const double p = tolerance * std::max(Eigen::Map<const Eigen::VectorXd>(state, shapes).norm(),
                                          _scales.displacement);
    const Eigen::VectorXd &frequencies = _motion.parts().rotor.frequencies;
    for (int i = 0; i < shapes; ++i) {
        allowed[n + i] = p * _scales.speed;
        allowed[i] =
            p * _scales.speed / std::max(_scales.speed, frequencies(i % frequencies.size()));
    }
    std::fill(allowed + shapes, allowed + n, tolerance);
    std::fill(allowed + n + shapes, allowed + 2 * n, tolerance * _scales.speed);
    if (_motion.parts().motor) {
        allowed[2 * n] = tolerance;
        allowed[2 * n + 1] = tolerance * _scales.speed;
    }
    double *books = allowed + _motion.books();
    const double *values = state + _motion.books();
    books[0] = tolerance * std::max(std::abs(values[0]), _scales.energy);
    books[1] = tolerance * std::max(std::abs(values[1]), _scales.energy);
    books[2] = tolerance * std::max(std::abs(values[2]), _scales.energy / _scales.speed);
}

OdeProblem Run::problem() {
    return {_motion.size(),
            [this](double t, const double *y, double *rates) { _motion.rates(t, y, rates); },
            [this](const double *y, double *allowed) { allowed_error(y, allowed); }, axes()};
}

/// Those of the rotor, where all that acts goes round with it: imbalances, and balls that rest in
/// it. What stands still (weight, forces from outside) or is pushed back across its path by
/// bearings that differ would go round in them.
TurningAxes Run::axes() const {
    const MovingParts &parts = _motion.parts();
    if (_method == OdeMethod::implicit_stiff || parts.motor || !parts.spin.constant() ||
        !parts.excitation.none() || _scene.simulate.gravity != 0 ||
        !_scene.rotor.bearings_isotropic())
        return {};
    return {parts.spin.at(0, 0).speed, parts.rotor.size(), {0, _motion.coordinates()}};
}

/// All at rest in the rotor, the free masses at their angles; or the rotor in its steady motion.
Eigen::VectorXd Run::first_state() const {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(_motion.size());
    for (std::size_t i = 0; i < _prepared.start_angles.size(); ++i)
        state(_motion.first_angle() + static_cast<Eigen::Index>(i)) = _prepared.start_angles[i];
    if (_motion.parts().motor)
        state(2 * _motion.coordinates() + 1) = _motion.parts().spin.at(0, 0).speed;
    if (_scene.simulate.steady_start)
        state.head(2 * _motion.coordinates()) = steady_motion(_motion.parts());
    return state;
}

/// Times at which the solver must stop: outputs and jumps.
std::vector<double> Run::stops() const {
    std::vector<double> stops = _recorder.times();
    for (const double jump : _motion.jumps())
        if (jump < _scene.simulate.time)
            stops.push_back(jump);
    std::ranges::sort(stops);
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    return stops;
}

void Run::begin(const model::Restart *from) {
    Eigen::VectorXd state = first_state();
    if (from) {
        _t = from->time;
        state = state_of(*from, _scene, _motion, _prepared.stations.rows.size());
        _recorder.resume(series_of(*from));
        _stations.resume(*from);
        _before = {from->energy, from->momentum};
    } else {
        _before = _motion.totals(0, state.data());
    }
    _motion.enter_piece(std::nextafter(_t, HUGE_VAL));
    _stations.begin(_t, state.data());
    if (!from)
        _recorder.output(0, state.data(), _stations.take_largest());
    if (_dry)
        _dry->begin(_t, state);
    _solver.start(_t, state.data(), from ? from->step : 0);
}

/// Where a speed of a sweep begins. Equal balls that lag together come so near to each other that
/// rounding cannot part them again, and they would rest together in positions that no ball keeps.
void Run::disturb(double time, Eigen::VectorXd &state) const {
    constexpr double part = 1e-6; // rad: far above rounding, far below what counts
    const bool begins = std::ranges::any_of(
        _scene.simulate.held, [time](const model::HeldSpeed &held) { return held.from == time; });
    if (!begins || _dry) // what touches or stands stays where it is
        return;
    for (int j = 0; j < _motion.parts().free_angles(); ++j)
        state(_motion.first_angle() + j) += part * std::cos(2.4 * j); // no two alike
}

/// What begins to turn with the rotor, or leaves it, brings or takes energy of its own.
void Run::pass_jump(double time) {
    Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(_solver.state(), _motion.size());
    const RotorMotion::Totals less = _motion.totals(time, state.data());
    _motion.enter_piece(std::nextafter(time, HUGE_VAL));
    disturb(time, state);
    const RotorMotion::Totals more = _motion.totals(time, state.data());
    _before.energy = _before.energy - less.energy + more.energy;
    _before.momentum = _before.momentum - less.momentum + more.momentum;
    _stations.begin(time, state.data());
    if (_dry)
        _dry->begin(time, state);
    // The integrator's own guess would follow a torque that jumps from nothing: too short to start.
    _solver.start(time, state.data(), 1e-3 / _scales.speed);
}

/// One step of the integrator, or as much of it as there is until an event.
void Run::step(double stop) {
    if (!_dry) {
        _t = _solver.step(stop);
        return;
    }
    const Eigen::VectorXd before =
        Eigen::Map<const Eigen::VectorXd>(_solver.state(), _motion.size());
    const double from = _t;
    _t = _solver.step(stop);
    const double length = _t - from;
    if (auto event = _dry->within(from, before, _t, _solver.state())) {
        _t = event->time;
        _stations.step(_t, event->state.data());
        _dry->pass(*event);
        _stations.begin(_t, event->state.data()); // velocities may have jumped
        _solver.start(_t, event->state.data(), length);
    }
}

bool Run::reach(double stop) {
    while (_t < stop) {
        if (process::take_interruption())
            return false;
        step(stop);
        _stations.step(_t, _solver.state());
        process::report_progress(_t / _scene.simulate.time);
    }
    return true;
}

bool Run::integrate(const model::Restart *from) {
    begin(from);
    const std::vector<double> jumps = _motion.jumps();
    const std::vector<double> &outputs = _recorder.times();
    for (const double stop : stops()) {
        if (stop <= _t)
            continue;
        if (!reach(stop))
            return false;
        if (std::ranges::binary_search(outputs, stop))
            _recorder.output(_t, _solver.state(), _stations.take_largest());
        if (std::ranges::binary_search(jumps, stop))
            pass_jump(stop);
    }
    return true;
}

model::Restart Run::restart() const {
    model::Restart restart = restart_of(_scene.rotor, _motion, _solver.state(), _recorder.series());
    _stations.save(restart);
    restart.case_name = _scene.name;
    restart.time = _t;
    restart.step = _solver.next_step();
    restart.energy = _before.energy;
    restart.momentum = _before.momentum;
    return restart;
}

Eigen::VectorXd Run::end_in_rotor_axes() const {
    const Eigen::Index n = _motion.coordinates();
    Eigen::VectorXd out = Eigen::Map<const Eigen::VectorXd>(_solver.state(), 2 * n);
    const TurningAxes axes{0, _motion.parts().rotor.size(), {0, _motion.coordinates()}};
    axes.turn(-_motion.spin(_t, _solver.state()).angle, out.data());
    return out;
}

double Run::speed_at(double t) const {
    if (!_motion.parts().motor)
        return _motion.parts().spin.at(t, t).speed;
    const results::MotionSeries &series = _recorder.series();
    const auto next = std::upper_bound(series.time.begin(), series.time.end(), t);
    if (next == series.time.end())
        return series.speed.back();
    const auto i = static_cast<std::size_t>(next - series.time.begin()); // > 0: it starts at 0
    const double share = (t - series.time[i - 1]) / (series.time[i] - series.time[i - 1]);
    return series.speed[i - 1] + share * (series.speed[i] - series.speed[i - 1]);
}

void Run::fill_audit(results::SimulateResult &result) const {
    const double *state = _solver.state();
    const double *books = state + _motion.books();
    const RotorMotion::Totals now = _motion.totals(_t, state);
    const double energy = now.energy - _before.energy;
    const double momentum = now.momentum - _before.momentum;
    result.audit = {energy - books[0] + books[1],
                    std::max({std::abs(energy), std::abs(books[0]), std::abs(books[1])}),
                    momentum - books[2], std::max(std::abs(momentum), std::abs(books[2]))};
    if (_motion.parts().motor) { // the spin itself takes part in the exchange
        result.audit.energy_scale = std::max(result.audit.energy_scale, std::abs(_before.energy));
        result.audit.momentum_scale =
            std::max(result.audit.momentum_scale, std::abs(_before.momentum));
    }
}

void Run::fill(results::SimulateResult &result) {
    const double *state = _solver.state();
    fill_audit(result);
    result.time = _t;
    result.speed = _motion.spin(_t, state).speed;
    const double turned =
        _motion.parts().motor ? state[2 * _motion.coordinates()] : _motion.parts().spin.turned(_t);
    result.revolutions = turned / (2 * std::numbers::pi);
    result.integrator = _method == OdeMethod::implicit_stiff
                            ? "diagonally implicit Runge-Kutta, order 5 (stiff)"
                            : "explicit Runge-Kutta, order 8";
    const OdeCounts counts = _solver.counts();
    result.steps = counts.steps;
    result.rate_evaluations = counts.rates;
    fill_stations(result);
    for (const model::HeldSpeed &held : _scene.simulate.held) {
        if (held.until > _t) // interrupted, or it grew beyond all numbers
            break;
        if (!result.sweep)
            result.sweep.emplace().size = eccentricity();
        result.sweep->motions.push_back(
            motion_between(held.until - told_by * (held.until - held.from), held.until));
        result.sweep->motions.back().speed = held.speed;
        result.sweep->motions.back().up = held.up;
    }
    fill_series(result);
    if (_dry) {
        result.impacts = _dry->impacts();
        result.audit.impact_gain = _dry->created();
        if (_dry->lifted())
            result.model.notes.emplace_back(
                model::Weight::warning, "a ball lifted off its race for a time (negative normal "
                                        "force), which the model of rolling resistance does not "
                                        "describe");
    }
    for (std::size_t i = 0; i < _motion.parts().free.size(); ++i) {
        result.balancers.emplace_back();
        result.balancers.back().z = _scene.rotor.balancers[i].z;
        result.balancers.back().amplitude = _stations.final_amplitude(i);
    }
}

results::HeldMotion Run::motion_between(double from, double until) const {
    return simulation::motion_between(_scene.rotor, _recorder.series(), from, until,
                                      eccentricity());
}

double Run::eccentricity() const {
    return 100 * _scales.displacement / std::sqrt(_motion.parts().rotor.mass);
}

/// Of the balancers' planes; without any of all stations.
void Run::fill_series(results::SimulateResult &result) const {
    result.series = _recorder.series();
    const auto planes = static_cast<std::ptrdiff_t>(_motion.parts().free.size());
    if (planes == 0)
        return;
    result.series.stations =
        largest_of({result.series.amplitude.begin() + planes, result.series.amplitude.end()},
                   result.series.time.size());
    for (auto *lists : {&result.series.amplitude, &result.series.x, &result.series.y})
        lists->resize(static_cast<std::size_t>(planes));
}

double Run::first_amplitude(std::size_t station) const {
    return _recorder.series().amplitude[_motion.parts().free.size() + station].front();
}

} // namespace whirl::simulation
