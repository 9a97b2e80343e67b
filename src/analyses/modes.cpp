#include "analyses/modes.h"

#include "analyses/critical.h"
#include "analyses/notes/ball_positions.h"
#include "assembly/discretization.h"
#include "assembly/planes.h"
#include "linalg/check.h"
#include "mesh_error/estimate.h"
#include "model/case.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/dissipation/dissipation.h"
#include "modes/formulation.h"
#include "modes/orbits.h"
#include "modes/spectrum.h"
#include "results/modes.h"
#include "results/sentence.h"
#include "results/whirl.h"
#include "synchronous/critical_speeds.h"
#include "tracking/mode_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

std::vector<std::complex<double>> scaled(const Eigen::VectorXcd &values,
                                         std::complex<double> largest) {
    std::vector<std::complex<double>> out;
    for (const std::complex<double> &value : values)
        out.push_back(value / largest);
    return out;
}

/// The component of largest modulus, the first of equal ones; 1 where all are zero.
std::complex<double> largest_component(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y) {
    constexpr double rounding = 1e-6; // of shapes on fine meshes: some 1e-9
    std::complex<double> largest = 0;
    for (const Eigen::VectorXcd *values : {&x, &y})
        for (const std::complex<double> &value : *values)
            if (std::abs(value) > (1 + rounding) * std::abs(largest)) // not for rounding to choose
                largest = value;
    return largest == 0.0 ? 1.0 : largest;
}

/// Shares of all parts; they add up to 1.
/// @param real  of the eigenvalue; 0: no damping that could be told from rounding
std::vector<results::Dissipation> dissipation_of(const std::vector<modes::PartPower> &parts,
                                                 double real) {
    constexpr double cancelled = 1e-9;
    constexpr double rounding = 1e-14; // of the sums that a power is made of
    double sum = 0;
    double size = 0;
    for (const modes::PartPower &part : parts) {
        sum += part.power;
        size += std::abs(part.power);
    }
    const bool known = real != 0 && std::abs(sum) > cancelled * size;
    std::vector<results::Dissipation> out;
    for (const modes::PartPower &part : parts) {
        const double power = std::abs(part.power) > rounding * size ? part.power : 0;
        out.push_back(
            {part.of, part.z, part.name, known ? std::optional(power / sum) : std::nullopt});
    }
    return out;
}

/// The modes of one rotor as shapes.
class Shapes {
  public:
    /// @param names  of modes; null where they are not known
    Shapes(const modes::SpectrumSolver &solver, const tracking::ModeNames *names)
        : _solver(solver), _names(names),
          _stations(modes::Stations::for_drawing(solver.discretization())) {}

    [[nodiscard]] const std::vector<double> &z() const { return _stations.z(); }

    /// A mode of a spectrum.
    [[nodiscard]] results::ModeShape of(const modes::Spectrum &spectrum, std::size_t index) const {
        const modes::WhirlMode &mode = spectrum.modes[index];
        const auto planes = _solver.planes(mode);
        const Eigen::VectorXcd x = _stations.deflections(planes.first);
        const Eigen::VectorXcd y = _stations.deflections(planes.second);
        const std::complex<double> largest = largest_component(x, y);
        return {_names ? _names->of(spectrum.speed, index) : "",
                spectrum.speed,
                mode.eigenvalue,
                mode.whirl,
                mode.forward_fraction,
                scaled(x, largest),
                scaled(y, largest),
                dissipation_of(modes::part_powers(_solver, mode, spectrum.speed),
                               mode.eigenvalue.real()),
                mode.plane};
    }

    /// The modes with the lowest frequencies at a speed.
    [[nodiscard]] modes::Spectrum lowest(double speed, int modes) const {
        const modes::Spectrum *known = _names ? _names->at(speed) : nullptr;
        if (known == nullptr || static_cast<int>(known->modes.size()) < modes)
            return _solver.at(speed, modes);
        modes::Spectrum spectrum = *known;
        spectrum.modes.resize(static_cast<std::size_t>(modes));
        return spectrum;
    }

    /// The mode that is critical at a speed: of its whirl the one whose frequency is next.
    [[nodiscard]] std::optional<results::ModeShape> critical(const results::CriticalSpeed &critical,
                                                             int modes) const {
        constexpr double near = 0.05;  // critical speeds of damped rotors differ from crossings
        constexpr double equal = 1e-3; // of another whirl
        const double speed = std::abs(critical.speed);
        modes::Spectrum spectrum;
        for (int found = -1; found < static_cast<int>(spectrum.modes.size()); modes *= 2) {
            found = static_cast<int>(spectrum.modes.size());
            spectrum = lowest(critical.speed, modes);
            if (!spectrum.modes.empty() &&
                spectrum.modes.back().eigenvalue.imag() > (1 + near) * speed)
                break;
        }
        // Of equal eigenvalues, as of a disc that does not tilt, neither list tells the whirl.
        std::optional<std::size_t> best;
        const auto other = [&](std::size_t i) { return spectrum.modes[i].whirl != critical.whirl; };
        const auto away = [&](std::size_t i) {
            const std::complex<double> synchronous(critical.real, speed);
            return std::abs(spectrum.modes[i].eigenvalue - synchronous) / speed +
                   (other(i) ? 1 : 0);
        };
        for (std::size_t i = 0; i < spectrum.modes.size(); ++i) {
            const double off = std::abs(spectrum.modes[i].eigenvalue.imag() - speed) / speed;
            if (off < (other(i) ? equal : near) && (!best || away(i) < away(*best)))
                best = i;
        }
        if (!best)
            return std::nullopt;
        // In axes that turn with the rotor it meets its mirror image there: of such a double root
        // rounding leaves half the digits, which the critical speed has.
        constexpr double half_the_digits = 1e-6;
        if (const std::complex<double> synchronous(critical.real, speed);
            std::abs(spectrum.modes[*best].eigenvalue - synchronous) < half_the_digits * speed)
            spectrum.modes[*best].eigenvalue = synchronous;
        return of(spectrum, *best);
    }

  private:
    const modes::SpectrumSolver &_solver;
    const tracking::ModeNames *_names;
    modes::Stations _stations;
};

/// The same mode at the same speed.
bool has(const std::vector<results::ModeShape> &shapes, const results::ModeShape &other) {
    return std::ranges::any_of(shapes, [&other](const results::ModeShape &shape) {
        return shape.label == other.label && std::abs(shape.at - other.at) < 1e-9 * other.at &&
               std::abs(shape.eigenvalue - other.eigenvalue) <= 1e-9 * std::abs(other.eigenvalue);
    });
}

/// Those of which shapes are drawn beside the modes at one speed.
std::vector<results::CriticalSpeed> shown_critical_speeds(const model::Case &scene,
                                                          std::vector<results::Sentence> &notes) {
    if (scene.modes.speed || scene.speeds->count < 2)
        return {};
    try {
        std::vector<results::CriticalSpeed> speeds =
            unjudged_critical_speeds(scene).critical_speeds;
        const auto [from, to] = std::minmax(scene.speeds->from, scene.speeds->to);
        drop_second_directions(speeds, scene.campbell.modes, {from, to});
        std::erase_if(speeds, [](const results::CriticalSpeed &c) { return c.speed == 0; });
        return speeds;
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back("no shapes at critical speeds: {}", failure.sentence());
        return {};
    }
}

void add_critical(results::ModesResult &result, const Shapes &shapes,
                  const std::vector<results::CriticalSpeed> &critical_speeds, int modes) {
    std::vector<results::Sentence> &notes = result.model.notes;
    try {
        for (const results::CriticalSpeed &critical : critical_speeds) {
            auto shape = shapes.critical(critical, modes);
            if (shape && !has(result.critical, *shape))
                result.critical.push_back(std::move(*shape));
            else if (!shape)
                notes.emplace_back(
                    "no shape at the critical speed {}: at this speed no mode of its whirl has "
                    "that frequency, as one that is heavily damped need not",
                    as::speed(critical.speed));
        }
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back("no shapes at critical speeds: {}", failure.sentence());
    }
}

/// With balancers: at the critical speeds, at which `critical` holds their parts in place. The
/// rotor stands still in axes that turn with it, bent in the shape of the eigenvector.
void add_held(results::ModesResult &result, const model::Rotor &as_given,
              const std::vector<results::CriticalSpeed> &critical_speeds) {
    if (critical_speeds.empty())
        return;
    const assembly::Discretization rotor(model::without_damping(as_given), result.model.order);
    const modes::Stations stations = modes::Stations::for_drawing(rotor);
    const int wanted = static_cast<int>(critical_speeds.size());
    const std::complex<double> i(0, 1);
    try {
        std::map<int, synchronous::SynchronousModes> found; // by the sign of the speed
        for (const results::CriticalSpeed &critical : critical_speeds) {
            const int spin = critical.speed < 0 ? -1 : 1;
            const double speed = std::abs(critical.speed);
            const double last =
                std::abs((spin > 0 ? critical_speeds.back() : critical_speeds.front()).speed);
            // As many as `critical` finds: each direction of a motion alike in two counts there.
            if (!found.contains(spin))
                found[spin] = synchronous::all_synchronous_modes(rotor, results::Form::rotating,
                                                                 2 * wanted, last, nullptr, spin);
            for (const modes::WhirlMode &mode : found[spin].modes) {
                // Found again on other shapes: a drum on soft supports has it to 1e-7 alone.
                const double rounding = 1e-9 + 10 * (mode.residual + mode.rounding);
                if (std::abs(mode.eigenvalue.imag() - speed) > rounding * speed)
                    continue; // of another speed
                const assembly::Planes planes(mode.shape);
                Eigen::VectorXcd w =
                    stations.deflections(planes.x) + i * stations.deflections(planes.y);
                if (spin < 0) // x + iy = w exp(-i |W| t)
                    w = w.conjugate().eval();
                const std::complex<double> turn = static_cast<double>(-spin) * i;
                const std::complex<double> largest = largest_component(w, turn * w);
                result.critical.push_back({"",
                                           critical.speed,
                                           {0, speed},
                                           results::Whirl::forward,
                                           1,
                                           scaled(w, largest),
                                           scaled(turn * w, largest),
                                           {}});
                break;
            }
        }
        result.model.notes.emplace_back(
            "shapes at critical speeds are those of `critical`, forward, without damping and with "
            "the parts of balancers held in place; the modes at one speed have them free");
    } catch (const linalg::SolverError &) {
        result.model.notes.emplace_back(
            "no shapes at critical speeds: the eigensolver missed some");
    }
}

/// Names of the modes at the speed and of those that are critical at others.
std::optional<tracking::ModeNames>
names_at(const model::Case &scene, const modes::SpectrumSolver &solver, double speed,
         const std::vector<results::CriticalSpeed> &critical_speeds) {
    const results::Form form = solver.form();
    if (form == results::Form::hill)
        return std::nullopt;
    const int modes = scene.campbell.modes;
    tracking::ModesToName wanted{{speed},
                                 !results::in_rotating_axes(form),
                                 [modes, speed](const modes::Spectrum &s, auto i) {
                                     return s.speed == speed ? static_cast<int>(i) < modes
                                                             : tracking::near_spin(s, i);
                                 }};
    for (const results::CriticalSpeed &critical : critical_speeds)
        wanted.speeds.push_back(critical.speed);
    return tracking::mode_names(solver, scene.speeds.value_or(model::SpeedRange{speed, speed, 1}),
                                modes, scene.reduction, wanted);
}

} // namespace

results::ModesResult mode_shapes(const model::Case &scene) {
    results::ModesResult result;
    if (!scene.modes.speed && !scene.speeds)
        throw model::BadInput(
            fmt::format("{}: modes.speed: missing, expected a spin speed, as --speed \"3000 rpm\", "
                        "or a section [speeds]",
                        scene.file.string()));
    result.speed = scene.modes.speed ? *scene.modes.speed : scene.speeds->from;
    result.model.formulation = modes::choose_formulation(scene);
    result.model.order = mesh_error::resolve_order(scene, result.model.formulation);
    const modes::SpectrumSolver solver(scene.rotor, result.model.formulation.form,
                                       result.model.order);
    note_other_positions(scene.rotor, result.model.notes);
    if (!scene.reduction)
        solver.take_all_unknowns();
    result.model.elements = static_cast<int>(solver.discretization().shaft_mesh().spans.size());
    result.model.unknowns = solver.unknowns();
    std::vector<results::Sentence> critical_notes;
    const std::vector<results::CriticalSpeed> critical_speeds =
        shown_critical_speeds(scene, critical_notes);
    const std::optional<tracking::ModeNames> names = names_at(
        scene, solver, result.speed,
        scene.rotor.balancers.empty() ? critical_speeds : std::vector<results::CriticalSpeed>{});
    const Shapes shapes(solver, names ? &*names : nullptr);
    result.z = shapes.z();
    const modes::Spectrum spectrum = shapes.lowest(result.speed, scene.campbell.modes);
    for (std::size_t i = 0; i < spectrum.modes.size(); ++i)
        result.modes.push_back(shapes.of(spectrum, i));
    for (const double root : spectrum.growing)
        result.model.notes.emplace_back(model::Weight::warning,
                                        "divergence (static instability): a real eigenvalue of {}, "
                                        "motion grows without whirling",
                                        as::rate(root).with_sign());
    if (static_cast<int>(result.modes.size()) < scene.campbell.modes)
        result.model.notes.emplace_back("{} modes were asked for, the rotor has {} that oscillate",
                                        scene.campbell.modes, result.modes.size());
    if (result.model.formulation.form == results::Form::hill)
        result.model.notes.emplace_back(model::Weight::information,
                                        "where modes dissipate is not given for rotors and "
                                        "bearings that both differ between their directions");
    result.model.notes.insert(result.model.notes.end(), critical_notes.begin(),
                              critical_notes.end());
    if (scene.rotor.balancers.empty())
        add_critical(result, shapes, critical_speeds, scene.campbell.modes);
    else
        add_held(result, scene.rotor, critical_speeds);
    return result;
}

} // namespace whirl::analyses
