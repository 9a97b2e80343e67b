#include "criterion/pendulum.h"

#include "assembly/system.h"
#include "closed_form/pendulum_balancer.h"
#include "criterion/pendulum_motion.h"
#include "model/case.h"
#include "model/errors.h"
#include "model/variants.h"
#include "process/progress.h"
#include "results/formulation.h"
#include "results/sentence.h"
#include "results/whirl.h"
#include "rigid/projection.h"
#include "synchronous/critical_speeds.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::criterion {

namespace {

using results::Sentence;
namespace as = results::as;

using closed_form::PendulumRotor;

std::vector<balancers::PlacedPendulums> pendulums_of(const model::Case &scene) {
    std::vector<balancers::PlacedPendulums> out = balancers::pendulums_in(scene.rotor);
    for (const balancers::PlacedPendulums &pendulums : out)
        if (!(pendulums.pivot > 0))
            throw model::BadInput(fmt::format(
                "{}: {}.pivot: expected a radius above 0 m (the pendulums "
                "stand still nowhere else), got {:.6g} m",
                scene.file.string(), scene.rotor.balancer_path(pendulums.index), pendulums.pivot));
    return out;
}

/// What the pendulums are to balance, at the right places.
std::vector<model::Imbalance> drive_of(const model::Case &scene,
                                       const std::vector<balancers::PlacedPendulums> &pendulums,
                                       std::vector<results::Sentence> &notes) {
    std::vector<model::Imbalance> drive = model::with_balancer_imbalances(scene.rotor).imbalances;
    if (drive.empty()) {
        notes.emplace_back("pendulums without an imbalance to balance (balancer.imbalance or "
                           "[[imbalance]]): their efficiency is that of small angles");
        const balancers::PlacedPendulums &first = pendulums.front();
        drive.push_back({"", first.z, 1e-6 * first.mass * first.arm, 0});
    }
    return drive;
}

/// The planar rotor that stands for the flexible one at a balancer.
struct PlanarEquivalent {
    PendulumRotor rotor;
    double mass = 0;    ///< M_Sigma, kg
    double omega_0 = 0; ///< rad/s
};

PlanarEquivalent planar_equivalent(const PendulumShaft &shaft, std::size_t index,
                                   double bearing_speed) {
    const assembly::Discretization &d = shaft.rotor();
    const balancers::PlacedPendulums &p = shaft.pendulums()[index];
    const assembly::PlanarSystem system = assembly::assemble_planar(d, bearing_speed);
    const Eigen::MatrixXd M = system.M.view();
    const Eigen::MatrixXd G = system.G.view();
    const auto deflection = [&d](const Eigen::VectorXd &v, double z) {
        double sum = 0;
        for (const auto &[unknown, value] : d.deflection_at(z))
            sum += value * v(unknown);
        return sum;
    };
    // A mode with a node at the balancer would be an infinite mass there.
    const double largest_mass = 100 * rigid::rigid_body(d.rotor(), bearing_speed).mass;
    for (const modes::WhirlMode &mode :
         synchronous::synchronous_modes(d, results::Form::planar, bearing_speed, 4)) {
        Eigen::VectorXd v = mode.shape.real();
        const double here = deflection(v, p.z);
        if (mode.whirl != results::Whirl::forward || here == 0)
            continue;
        v /= here;
        PlanarEquivalent out;
        const Eigen::MatrixXd difference = M - G;
        const Eigen::VectorXd forces = difference * v;
        out.mass = v.dot(forces);
        if (!(out.mass > 0) || out.mass > largest_mass)
            continue;
        out.omega_0 = mode.eigenvalue.imag();
        double damping = 0;
        assembly::assemble_supports(
            d, bearing_speed, [&](assembly::Term term, int i, int j, const Eigen::Matrix2d &block) {
                if (term == assembly::Term::damping)
                    damping += v(i) * block(0, 0) * v(j);
            });
        out.rotor.mass_ratio = 2 * p.mass / out.mass;
        out.rotor.pivot_ratio = p.pivot / p.arm;
        out.rotor.external_damping = damping / (out.mass * out.omega_0);
        out.rotor.hinge_damping = p.damping / (p.mass * p.arm * p.arm * out.omega_0);
        for (const model::Imbalance &imbalance : shaft.drive())
            out.rotor.imbalance += deflection(v, imbalance.z) * imbalance.mr *
                                   std::polar(1.0, imbalance.phase) / (2 * p.mass * p.arm);
        return out;
    }
    throw model::AnalysisFailure("pendulum balancer: the rotor has no forward critical speed with "
                                 "motion at the balancer to compare with");
}

void fill_planar(const PlanarEquivalent &planar, results::PendulumBalance &out) {
    out.rho = planar.rotor.effectiveness();
    out.threshold = closed_form::efficiency_threshold(planar.rotor);
    out.limit = closed_form::efficiency_limit(planar.rotor);
    out.mass = planar.mass;
    out.omega_0 = planar.omega_0;
    out.external_damping = planar.rotor.external_damping;
    out.hinge_damping = planar.rotor.hinge_damping;
    for (const double speed : out.speeds) {
        const double ratio = speed / planar.omega_0;
        out.approximate.push_back(closed_form::approximate_efficiency(planar.rotor, ratio));
        out.planar.emplace_back();
        if (speed <= 0 || planar.rotor.imbalance == 0.0)
            continue;
        const auto motions = closed_form::steady_motions(planar.rotor, ratio);
        if (!motions.empty())
            out.planar.back() = closed_form::exact_efficiency(planar.rotor, motions.front(), ratio);
    }
}

/// Efficiency over the range of speeds of one rotor, at enough points for a curve.
results::PendulumCurve efficiency_curve(const PendulumRotor &rotor,
                                        const model::PendulumDesign &design, double from,
                                        double to) {
    constexpr int points = 240; // of a curve in a figure: smooth on a page
    results::PendulumCurve curve;
    curve.arm = design.arm;
    curve.pivot = design.pivot;
    curve.rho = rotor.effectiveness();
    curve.external_damping = rotor.external_damping;
    for (int i = 0; i <= points; ++i) {
        const double ratio = from + (to - from) * i / points;
        if (ratio <= 0)
            continue;
        curve.ratios.push_back(ratio);
        curve.approximate.push_back(closed_form::approximate_efficiency(rotor, ratio));
        const auto motions = closed_form::steady_motions(rotor, ratio);
        curve.stable.push_back(!motions.empty() && motions.front().stable);
        curve.exact.emplace_back();
        if (!motions.empty())
            curve.exact.back() = closed_form::exact_efficiency(rotor, motions.front(), ratio);
    }
    return curve;
}

/// The planar rotor with pendulums of another design, of the same masses, hinges and imbalance.
PendulumRotor redesigned(PendulumRotor rotor, const balancers::PlacedPendulums &own,
                         const model::PendulumDesign &design) {
    const double arms = own.arm / design.arm;
    rotor.pivot_ratio = design.pivot / design.arm;
    rotor.imbalance *= arms;
    rotor.hinge_damping *= arms * arms;
    return rotor;
}

void compare_designs(const model::BalanceSettings &wanted, const balancers::PlacedPendulums &own,
                     const PlanarEquivalent &planar, results::PendulumBalance &out) {
    if (wanted.designs.empty() && wanted.external_damping.empty())
        return;
    std::vector<double> dampings = wanted.external_damping;
    if (dampings.empty())
        dampings.push_back(planar.rotor.external_damping);
    const double from = out.speeds.front() / planar.omega_0;
    const double to = out.speeds.back() / planar.omega_0;
    PendulumRotor rotor = planar.rotor;
    rotor.external_damping = dampings.front();
    for (const model::PendulumDesign &design : wanted.designs)
        out.designs.push_back(efficiency_curve(redesigned(rotor, own, design), design, from, to));
    for (const double H : dampings) {
        rotor.external_damping = H;
        out.dampings.push_back(efficiency_curve(rotor, {own.arm, own.pivot}, from, to));
    }
}

/// Steady motions at all speeds: up and down the speeds, each from those of its neighbour.
std::vector<std::vector<PendulumSteadyMotion>> swept_motions(PendulumShaft &shaft,
                                                             const std::vector<double> &speeds) {
    std::vector<std::vector<PendulumSteadyMotion>> all(speeds.size());
    for (std::size_t k = 0; k < speeds.size(); ++k)
        if (speeds[k] > 0)
            all[k] =
                shaft.motions(speeds[k], k > 0 ? all[k - 1] : std::vector<PendulumSteadyMotion>{});
    for (std::size_t k = speeds.size(); k-- > 1 && speeds[k - 1] > 0;) {
        std::vector<PendulumSteadyMotion> starts = all[k - 1];
        starts.insert(starts.end(), all[k].begin(), all[k].end());
        all[k - 1] = shaft.motions(speeds[k - 1], starts);
    }
    return all;
}

void fill_states(PendulumShaft &shaft, double bearing_speed, const std::vector<double> &speeds,
                 std::vector<results::PendulumBalance> &out) {
    const PendulumStability stability(shaft, bearing_speed);
    const auto all = swept_motions(shaft, speeds);
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        process::report_progress(static_cast<double>(k) / static_cast<double>(speeds.size()));
        for (results::PendulumBalance &balance : out)
            balance.states.emplace_back();
        if (speeds[k] <= 0)
            continue;
        const Eigen::VectorXcd held = shaft.held(speeds[k]);
        for (const PendulumSteadyMotion &motion : all[k]) {
            results::PendulumState state;
            state.growth = stability.growth(speeds[k], motion);
            state.stable = state.growth < stability.rounding(speeds[k]);
            const double widest =
                std::max(motion.phi.cwiseAbs().maxCoeff(), motion.psi.cwiseAbs().maxCoeff());
            state.collision = widest >= std::numbers::pi / 4;
            for (std::size_t j = 0; j < out.size(); ++j) {
                const auto at = static_cast<Eigen::Index>(j);
                state.ratio = std::abs(motion.deflection(at)) / std::abs(held(at));
                state.phi = motion.phi(at);
                state.psi = motion.psi(at);
                out[j].states.back().push_back(state);
            }
        }
    }
}

} // namespace

std::vector<results::PendulumBalance> pendulum_balance(const model::Case &scene,
                                                       const BalanceScene &shared,
                                                       std::vector<results::Sentence> &notes) {
    const std::vector<balancers::PlacedPendulums> pendulums = pendulums_of(scene);
    std::vector<results::PendulumBalance> out;
    if (pendulums.empty())
        return out;
    if (shared.rotor.shaft.axial_torque != 0)
        throw model::AnalysisFailure("the efficiency of pendulums is computed for a shaft without "
                                     "axial torque, which couples x and y; leave out "
                                     "shaft.axial_torque");
    if (shared.rotor.rotating_anisotropy())
        notes.emplace_back(model::Weight::information,
                           "the pendulum part takes the mean of the rotor's inertias and bending "
                           "stiffnesses about its two axes");
    PendulumShaft shaft(model::with_mean_bearings(shared.rotor), shared.order, pendulums,
                        drive_of(scene, pendulums, notes));
    if (!scene.rotor.bearings_isotropic())
        notes.emplace_back(
            model::Weight::information,
            "the pendulum part takes the mean of the bearings' x and y coefficients");
    if (scene.rotor.bearings_depend_on_speed())
        notes.emplace_back(
            model::Weight::information,
            "the planar equivalent and the stability of the pendulums take the bearings as at {}",
            as::speed(shared.from));
    for (std::size_t j = 0; j < pendulums.size(); ++j) {
        results::PendulumBalance balance;
        balance.name = pendulums[j].name;
        balance.z = pendulums[j].z;
        balance.speeds = shared.speeds;
        const PlanarEquivalent planar = planar_equivalent(shaft, j, shared.from);
        fill_planar(planar, balance);
        compare_designs(scene.balance, pendulums[j], planar, balance);
        out.push_back(balance);
    }
    fill_states(shaft, shared.from, shared.speeds, out);
    return out;
}

} // namespace whirl::criterion
