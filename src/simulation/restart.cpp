#include "simulation/restart.h"

#include "balancers/kind.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <complex>
#include <variant>

namespace whirl::simulation {

namespace {

using Eigen::Index;

std::vector<double> whole_rotor(const reduction::ReducedRotor &rotor, const double *p) {
    const Eigen::Map<const Eigen::MatrixXd> values(p, rotor.size(), 2);
    const Eigen::MatrixXd q = rotor.shapes * values;
    return {q.data(), q.data() + q.size()};
}

void on_shapes(const reduction::ReducedRotor &rotor, const std::vector<double> &whole, double *p) {
    const Eigen::Map<const Eigen::MatrixXd> q(whole.data(), rotor.shapes.rows(), 2);
    Eigen::Map<Eigen::MatrixXd>(p, rotor.size(), 2) = rotor.mass_times.transpose() * q;
}

void add(std::vector<double> &sizes, const Eigen::Matrix2d &m) {
    sizes.insert(sizes.end(), m.data(), m.data() + m.size());
}

void add_supports(std::vector<double> &sizes, const model::Rotor &rotor) {
    for (const model::Bearing &b : rotor.bearings) {
        sizes.push_back(b.z);
        sizes.insert(sizes.end(), b.speeds.begin(), b.speeds.end());
        for (const model::BearingCoefficients &at : b.rows)
            for (const Eigen::Matrix2d *m : {&at.k, &at.c, &at.m, &at.kt, &at.ct})
                add(sizes, *m);
        const model::Pedestal pedestal = b.pedestal.value_or(model::Pedestal{});
        for (const Eigen::Vector2d &v : {pedestal.mass, pedestal.k, pedestal.c})
            sizes.insert(sizes.end(), v.data(), v.data() + v.size());
    }
}

void add_balancer(std::vector<double> &sizes, const model::Balancer &b) {
    const auto kind = balancers::kind_of(b);
    const balancers::PartsInertia parts = kind->inertia();
    const std::vector<balancers::CircledMass> circled = kind->circled();
    sizes.insert(sizes.end(), {b.z, b.imbalance, b.imbalance_phase, b.imbalance_radius.value_or(0),
                               b.tilt_inertia ? 1.0 : 0, parts.mass, parts.on_circle, parts.own,
                               kind->reach().imbalance});
    for (const std::complex<double> of_races : {kind->race_centre(), kind->out_of_round()})
        sizes.insert(sizes.end(), {of_races.real(), of_races.imag()});
    if (const auto *balls = std::get_if<model::Balls>(&b.parts)) {
        sizes.push_back(balls->release_speed.value_or(0));
        sizes.insert(sizes.end(), balls->walls.begin(), balls->walls.end());
        if (balls->contact || !balls->walls.empty()) {
            sizes.insert(sizes.end(), {balls->contact ? 1.0 : 0, balls->restitution});
            for (const model::BallRow &row : balls->rows)
                sizes.push_back(row.diameter);
        }
        if (balls->tilt > 0)
            sizes.insert(sizes.end(), {balls->tilt, balls->tilt_angle});
    }
    for (const balancers::CircledMass &mass : circled)
        sizes.insert(sizes.end(), {mass.moment, mass.inertia});
    const balancers::SmallMotions small =
        kind->small_motions(std::vector<double>(circled.size(), 0.0));
    for (const Eigen::MatrixXd &part : {small.inertia, small.damping})
        sizes.insert(sizes.end(), part.data(), part.data() + part.size());
    sizes.insert(sizes.end(), small.restoring.begin(), small.restoring.end());
}

void add_segment(std::vector<double> &sizes, const model::Segment &s) {
    sizes.insert(sizes.end(), {s.length, s.outer_start, s.outer_end, s.inner_start, s.inner_end,
                               s.material.E, s.material.G, s.material.rho, s.asymmetry,
                               s.asymmetry_angle, s.shear_coefficient, s.mass_outer, s.mass_inner});
    for (const model::Layer &layer : s.layers)
        sizes.insert(sizes.end(), {layer.outer, layer.inner, layer.material.E, layer.material.G,
                                   layer.material.rho});
}

/// What a restart holds of the state, the motion of the shaft aside.
struct StatePart {
    std::vector<double> model::Restart::*list;
    int first, count; ///< in the state
};
std::array<StatePart, 4> parts_of(const RotorMotion &motion) {
    const int n = motion.coordinates();
    const int angles = n - motion.first_angle();
    return {{{&model::Restart::angles, n - angles, angles},
             {&model::Restart::rates, 2 * n - angles, angles},
             {&model::Restart::spin, 2 * n, motion.books() - 2 * n},
             {&model::Restart::books, motion.books(), motion.size() - motion.books()}}};
}

/// All that makes this rotor another one.
std::vector<double> signature_of(const model::Rotor &rotor) {
    std::vector<double> sizes{rotor.shaft.internal_damping, rotor.shaft.axial_force,
                              rotor.shaft.rigid ? 1.0 : 0.0,
                              rotor.shaft.rotary_inertia ? 1.0 : 0.0};
    sizes.insert(sizes.end(), {rotor.shaft.alpha, rotor.shaft.beta, rotor.shaft.axial_torque,
                               static_cast<double>(rotor.shaft.torque_kind)});
    sizes.insert(sizes.end(), rotor.shaft.modal_damping.begin(), rotor.shaft.modal_damping.end());
    for (const model::Segment &s : rotor.shaft.segments)
        add_segment(sizes, s);
    for (const model::Disc &d : rotor.discs)
        sizes.insert(sizes.end(), {d.z, d.mass, d.Id, d.Ip});
    add_supports(sizes, rotor);
    for (const model::Anisotropy &a : rotor.anisotropies)
        sizes.insert(sizes.end(), {a.z, a.dI, a.angle});
    for (const model::Balancer &b : rotor.balancers)
        add_balancer(sizes, b);
    for (const model::Imbalance &i : rotor.imbalances)
        sizes.insert(sizes.end(), {i.z, i.mr, i.phase});
    return sizes;
}

} // namespace

model::Restart restart_of(const model::Rotor &rotor_of_case, const RotorMotion &motion,
                          const double *state, const results::MotionSeries &series) {
    const reduction::ReducedRotor &rotor = motion.parts().rotor;
    const int n = motion.coordinates();
    model::Restart restart;
    restart.signature = signature_of(rotor_of_case);
    restart.displacements = whole_rotor(rotor, state);
    restart.velocities = whole_rotor(rotor, state + n);
    for (const auto &[list, first, count] : parts_of(motion))
        (restart.*list).assign(state + first, state + first + count);
    restart.series = {series.time, series.speed};
    for (const auto *lists : {&series.amplitude, &series.x, &series.y, &series.angles})
        restart.series.insert(restart.series.end(), lists->begin(), lists->end());
    return restart;
}

Eigen::VectorXd state_of(const model::Restart &restart, const model::Case &scene,
                         const RotorMotion &motion, std::size_t stations) {
    const reduction::ReducedRotor &rotor = motion.parts().rotor;
    const int n = motion.coordinates();
    const auto whole = static_cast<std::size_t>(2 * rotor.shapes.rows());
    const auto angles = static_cast<std::size_t>(motion.parts().free_angles());
    const std::size_t rows = scene.rotor.balancers.size() + stations;
    const bool fits = restart.displacements.size() == whole && restart.velocities.size() == whole &&
                      restart.largest.size() == rows && restart.last.size() == rows &&
                      restart.peaks.size() == stations && restart.peak_times.size() == stations &&
                      restart.series.size() == 2 + 3 * rows + angles &&
                      std::ranges::all_of(parts_of(motion),
                                          [&](const StatePart &part) {
                                              return std::ssize(restart.*part.list) == part.count;
                                          }) &&
                      std::ranges::all_of(restart.series, [&](const std::vector<double> &column) {
                          return column.size() == restart.series.front().size();
                      });
    if (!fits || restart.signature != signature_of(scene.rotor))
        throw model::BadInput(
            fmt::format("simulate.restart: expected the state of an interrupted run of this case, "
                        "got that of \"{}\", another rotor",
                        restart.case_name));
    if (!(restart.time < scene.simulate.time))
        throw model::BadInput(fmt::format("simulate.time: expected more than {} s, where the "
                                          "interrupted run stopped, got {} s",
                                          restart.time, scene.simulate.time));
    Eigen::VectorXd state(motion.size());
    on_shapes(rotor, restart.displacements, state.data());
    on_shapes(rotor, restart.velocities, state.data() + n);
    for (const auto &[list, first, count] : parts_of(motion))
        std::ranges::copy(restart.*list, state.data() + first);
    return state;
}

results::MotionSeries series_of(const model::Restart &restart) {
    results::MotionSeries series;
    series.time = restart.series[0];
    series.speed = restart.series[1];
    auto next = restart.series.begin() + 2;
    const auto rows = std::ssize(restart.largest);
    for (auto *lists : {&series.amplitude, &series.x, &series.y}) {
        lists->assign(next, next + rows);
        next += rows;
    }
    series.angles.assign(next, restart.series.end());
    return series;
}

} // namespace whirl::simulation
