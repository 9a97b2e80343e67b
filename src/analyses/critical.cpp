#include "analyses/critical.h"

#include "analyses/discretization_error.h"
#include "analyses/finer_model.h"
#include "analyses/synchronous.h"
#include "assembly/discretization.h"
#include "linalg/check.h"
#include "model/errors.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace whirl::analyses {

namespace {

/// Synchronous modes with bearing tables: each is iterated until the speed at which the bearings
/// were taken is the speed found (secant steps on their difference).
class TableIteration {
  public:
    TableIteration(const assembly::Discretization &d, Form form, int wanted)
        : _d(d), _form(form), _wanted(wanted) {}

    std::vector<WhirlMode> run() {
        std::vector<WhirlMode> out;
        for (const WhirlMode &start : synchronous_modes(_d, _form, 0, _wanted)) {
            const std::optional<WhirlMode> mode = settle(start);
            if (!mode) {
                ++unsettled;
                continue;
            }
            const bool known = std::any_of(out.begin(), out.end(), [&](const WhirlMode &other) {
                return std::abs(other.eigenvalue - mode->eigenvalue) <
                           1e-8 * std::abs(mode->eigenvalue) &&
                       other.whirl == mode->whirl;
            });
            if (!known)
                out.push_back(*mode);
        }
        std::sort(out.begin(), out.end(), [](const WhirlMode &a, const WhirlMode &b) {
            return a.eigenvalue.imag() < b.eigenvalue.imag();
        });
        return out;
    }

    int unsettled = 0; ///< modes for which no fixed speed was found

  private:
    const assembly::Discretization &_d;
    Form _form;
    int _wanted;

    /// The mode at other bearing coefficients that resembles `mode` most.
    WhirlMode resembling(const WhirlMode &mode, double bearing_speed) const {
        const std::vector<WhirlMode> all = synchronous_modes(_d, _form, bearing_speed, _wanted + 4);
        const auto likeness = [&](const WhirlMode &other) {
            if (_form == Form::planar && other.whirl != mode.whirl)
                return 0.0;
            const double cosine =
                std::abs(other.shape.dot(mode.shape)) / (other.shape.norm() * mode.shape.norm());
            return cosine /
                   (1 + std::abs(std::log(other.eigenvalue.imag() / mode.eigenvalue.imag())));
        };
        return *std::max_element(all.begin(), all.end(), [&](const auto &a, const auto &b) {
            return likeness(a) < likeness(b);
        });
    }

    std::optional<WhirlMode> settle(WhirlMode mode) const {
        double s0 = 0;
        double g0 = mode.eigenvalue.imag();
        double s1 = g0;
        for (int step = 0; step < 60; ++step) {
            mode = resembling(mode, s1);
            const double g1 = mode.eigenvalue.imag() - s1;
            if (std::abs(g1) < 1e-11 * mode.eigenvalue.imag())
                return mode;
            const double slope = (g1 - g0) / (s1 - s0);
            double next = s1 - g1 / slope;
            if (!std::isfinite(next) || next <= 0 || slope >= 0)
                next = s1 + g1; // plain substitution
            s0 = s1;
            g0 = g1;
            s1 = next;
        }
        return std::nullopt;
    }
};

struct Found {
    std::vector<WhirlMode> modes;
    int unsettled = 0;
};

Found solve(const model::Rotor &rotor, Form form, const assembly::Discretization &d, int wanted) {
    if (!rotor.bearings_depend_on_speed())
        return {synchronous_modes(d, form, 0, wanted), 0};
    TableIteration iteration(d, form, wanted);
    Found found{iteration.run(), 0};
    found.unsettled = iteration.unsettled;
    return found;
}

/// At least the modes asked for; more while the highest is still below the top speed.
Found solve_in_range(const model::Case &scene, Form form, const assembly::Discretization &d) {
    const double top = scene.speeds ? std::max(scene.speeds->to, scene.speeds->from) : 0;
    const auto wanted = static_cast<std::size_t>(scene.campbell.modes);
    for (std::size_t ask = wanted;; ask *= 2) {
        Found found = solve(scene.rotor, form, d, static_cast<int>(ask));
        const bool all = found.modes.size() < ask;
        const auto in_range = static_cast<std::size_t>(
            std::count_if(found.modes.begin(), found.modes.end(),
                          [top](const WhirlMode &m) { return m.eigenvalue.imag() <= top; }));
        if (all || in_range < found.modes.size() || ask > 400) {
            found.modes.resize(std::min(found.modes.size(), std::max(wanted, in_range)));
            return found;
        }
    }
}

/// Critical speeds of an asymmetric rotor are those without damping (A. N. Gorbenko's Omega_K);
/// with it, no motion stands still but at the ends of the unstable ranges.
model::Case without_damping(model::Case scene) {
    for (model::Bearing &bearing : scene.rotor.bearings) {
        for (model::BearingCoefficients &at : bearing.rows) {
            at.c.setZero();
            at.ct.setZero();
        }
        if (bearing.pedestal)
            bearing.pedestal->c = 0;
    }
    scene.rotor.shaft.internal_damping = 0;
    return scene;
}

void note_damping(Form form, bool damped, ModelSummary &model) {
    if (damped)
        model.notes.emplace_back(
            form == Form::rotating
                ? "critical speeds of the asymmetric rotor are those without damping; with it a "
                  "root is zero at the ends of the unstable ranges, which stability lists"
                : "critical speeds of the damped rotor are Im of the synchronous eigenvalue; "
                  "crossings of a Campbell diagram differ from them by the order of the damping "
                  "ratio squared");
}

void note_balls_held(Form form, ModelSummary &model) {
    if (form == Form::rotating)
        model.notes.emplace_back("forward critical speeds only, the balls of balancers held in "
                                 "place; stability lists the speeds at which they are free");
}

void refuse_hill(Form form) {
    if (form == Form::hill)
        throw model::AnalysisFailure(
            "critical speeds are not defined for this scene: with bearings that differ between "
            "their directions nothing stands still in axes that turn with an asymmetric rotor; "
            "campbell shows the crossings with 1x, stability the unstable bands");
}

/// Modes of one kind in the order of their speeds: none of the finer model is above its like.
std::vector<double> errors_by_place(const Spectrum &coarse, const Spectrum &fine, Form form) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < coarse.modes.size(); ++i) {
        const WhirlMode &mode = coarse.modes[i];
        const auto alike = [&](const WhirlMode &other) {
            return form != Form::planar || other.whirl == mode.whirl;
        };
        auto before = std::count_if(coarse.modes.begin(),
                                    coarse.modes.begin() + static_cast<std::ptrdiff_t>(i), alike);
        const auto found = std::find_if(fine.modes.begin(), fine.modes.end(),
                                        [&](const auto &m) { return alike(m) && before-- == 0; });
        errors.push_back(found == fine.modes.end()
                             ? std::numeric_limits<double>::infinity()
                             : estimate_safety * std::abs(found->eigenvalue - mode.eigenvalue) /
                                   std::abs(mode.eigenvalue));
    }
    return errors;
}

} // namespace

CriticalResult critical_speeds(const model::Case &as_given) {
    const auto start = std::chrono::steady_clock::now();
    CriticalResult result;
    ModelSummary &model = result.model;
    model.formulation = choose_formulation(as_given);
    const Form form = model.formulation.form;
    refuse_hill(form);
    const model::Case scene = form == Form::rotating ? without_damping(as_given) : as_given;
    model.order = resolve_order(scene, model.formulation);
    const assembly::Discretization d(scene.rotor, model.order);
    model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    model.unknowns = form == Form::planar ? d.planar_size() : 2 * d.planar_size();
    try {
        const Found found = solve_in_range(scene, form, d);
        const assembly::Discretization finer(scene.rotor, finer_order(model.order));
        Spectrum coarse;
        Spectrum fine;
        coarse.modes = found.modes;
        if (!scene.rotor.shaft.rigid)
            fine.modes =
                solve(scene.rotor, form, finer, static_cast<int>(found.modes.size()) + 2).modes;
        const std::vector<double> errors = scene.rotor.shaft.rigid
                                               ? std::vector<double>(found.modes.size(), 0.0)
                                               : errors_by_place(coarse, fine, form);
        for (std::size_t i = 0; i < found.modes.size(); ++i) {
            const WhirlMode &mode = found.modes[i];
            result.critical_speeds.push_back(
                {mode.eigenvalue.imag(), mode.whirl, mode.eigenvalue.real(),
                 errors[i] + mode.residual + mode.rounding, mode.residual});
        }
        note_damping(form, as_given.rotor.damped(), model);
        note_balls_held(form, model);
        if (found.unsettled > 0)
            model.notes.push_back("for some modes no speed was found at which the bearing tables "
                                  "agree with the critical speed: they have none, or several");
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(
            "the critical speeds could not be found: the eigensolver did not converge or missed "
            "some; stiffnesses, dampings or element lengths may differ by more orders of magnitude "
            "than double precision holds (campbell shows crossings speed by speed)");
    }
    if (static_cast<int>(result.critical_speeds.size()) < scene.campbell.modes)
        model.notes.push_back("the rotor has no more critical speeds than the ones listed");
    model.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace whirl::analyses
