#include "analyses/modes.h"

#include "analyses/critical.h"
#include "mesh_error/estimate.h"
#include "model/case.h"
#include "model/errors.h"
#include "modes/dissipation/dissipation.h"
#include "modes/formulation.h"
#include "modes/orbits.h"
#include "modes/spectrum.h"
#include "process/parallel.h"
#include "results/modes.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::analyses {

namespace {

std::vector<std::complex<double>> scaled(const Eigen::VectorXcd &values,
                                         std::complex<double> largest) {
    std::vector<std::complex<double>> out;
    for (const std::complex<double> &value : values)
        out.push_back(value / largest);
    return out;
}

/// The component of largest modulus, the first of equal ones; 1 where all are zero.
std::complex<double> largest_component(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y) {
    std::complex<double> largest = 0;
    for (const Eigen::VectorXcd *values : {&x, &y})
        for (const std::complex<double> &value : *values)
            if (std::abs(value) > (1 + 1e-9) * std::abs(largest)) // not for rounding to choose
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

char letter(results::Whirl whirl) {
    return whirl == results::Whirl::forward ? 'F' : whirl == results::Whirl::backward ? 'B' : 'M';
}

/// The modes of one rotor as shapes.
class Shapes {
  public:
    explicit Shapes(const modes::SpectrumSolver &solver)
        : _solver(solver), _stations(modes::Stations::for_drawing(solver.discretization())) {}

    [[nodiscard]] const std::vector<double> &z() const { return _stations.z(); }

    /// A mode of a spectrum, its label counting those of its sense.
    [[nodiscard]] results::ModeShape of(const modes::Spectrum &spectrum, std::size_t index) const {
        const modes::WhirlMode &mode = spectrum.modes[index];
        const auto number = std::count_if(
            spectrum.modes.begin(), spectrum.modes.begin() + static_cast<std::ptrdiff_t>(index) + 1,
            [&mode](const modes::WhirlMode &other) { return other.whirl == mode.whirl; });
        const Eigen::VectorXcd x = _solver.x_at(mode, _stations);
        const Eigen::VectorXcd y = _solver.y_at(mode, _stations);
        const std::complex<double> largest = largest_component(x, y);
        return {fmt::format("{}{}", number, letter(mode.whirl)),
                spectrum.speed,
                mode.eigenvalue,
                mode.whirl,
                mode.forward_fraction,
                scaled(x, largest),
                scaled(y, largest),
                dissipation_of(modes::part_powers(_solver, mode, spectrum.speed),
                               mode.eigenvalue.real())};
    }

    /// The mode that is critical at a speed: of the whirl given the one whose frequency is next.
    [[nodiscard]] std::optional<results::ModeShape> critical(double speed, results::Whirl whirl,
                                                             int modes) const {
        constexpr double near = 0.05;  // critical speeds of damped rotors differ from crossings
        constexpr double equal = 1e-3; // of another whirl
        modes::Spectrum spectrum;
        for (int found = -1; found < static_cast<int>(spectrum.modes.size()); modes *= 2) {
            found = static_cast<int>(spectrum.modes.size());
            spectrum = _solver.at(speed, modes);
            if (!spectrum.modes.empty() &&
                spectrum.modes.back().eigenvalue.imag() > (1 + near) * std::abs(speed))
                break;
        }
        // Of equal eigenvalues, as of a disc that does not tilt, neither list tells the whirl.
        std::optional<std::size_t> best;
        const auto away = [&](std::size_t i) {
            const double off =
                std::abs(spectrum.modes[i].eigenvalue.imag() - std::abs(speed)) / std::abs(speed);
            return spectrum.modes[i].whirl == whirl ? off : near + off;
        };
        for (std::size_t i = 0; i < spectrum.modes.size(); ++i)
            if (away(i) < (spectrum.modes[i].whirl == whirl ? near : near + equal) &&
                (!best || away(i) < away(*best)))
                best = i;
        return best ? std::optional(of(spectrum, *best)) : std::nullopt;
    }

  private:
    const modes::SpectrumSolver &_solver;
    modes::Stations _stations;
};

/// Critical speeds without those that are the same motion in two directions: as many as modes, and
/// all in the range.
std::vector<results::CriticalSpeed> critical_speeds_of(const model::Case &scene) {
    std::vector<results::CriticalSpeed> speeds = unjudged_critical_speeds(scene).critical_speeds;
    const auto same = [](const results::CriticalSpeed &a, const results::CriticalSpeed &b) {
        return a.whirl == b.whirl && std::abs(a.speed - b.speed) < 1e-9 * a.speed;
    };
    speeds.erase(std::unique(speeds.begin(), speeds.end(), same), speeds.end());
    const double top = std::max(std::abs(scene.speeds->from), std::abs(scene.speeds->to));
    while (static_cast<int>(speeds.size()) > scene.campbell.modes && speeds.back().speed > top)
        speeds.pop_back();
    return speeds;
}

/// The same mode at the same speed.
bool has(const std::vector<results::ModeShape> &shapes, const results::ModeShape &other) {
    return std::any_of(shapes.begin(), shapes.end(), [&other](const results::ModeShape &shape) {
        return shape.label == other.label && std::abs(shape.at - other.at) < 1e-9 * other.at;
    });
}

void add_critical(results::ModesResult &result, const model::Case &scene, const Shapes &shapes) {
    std::vector<std::string> &notes = result.model.notes;
    if (!scene.rotor.balancers.empty()) {
        notes.emplace_back("no shapes at critical speeds: these are for balls held in place, and "
                           "the modes here have them free");
        return;
    }
    try {
        for (const results::CriticalSpeed &critical : critical_speeds_of(scene)) {
            if (critical.speed == 0)
                continue;
            auto shape = shapes.critical(critical.speed, critical.whirl, scene.campbell.modes);
            if (shape && !has(result.critical, *shape))
                result.critical.push_back(std::move(*shape));
            else if (!shape)
                notes.push_back(fmt::format("no shape at the critical speed {:.6g} rad/s: at this "
                                            "speed no mode of its whirl has that frequency, as "
                                            "one that is heavily damped need not",
                                            critical.speed));
        }
    } catch (const model::AnalysisFailure &failure) {
        notes.push_back(fmt::format("no shapes at critical speeds: {}", failure.what()));
    }
}

} // namespace

results::ModesResult mode_shapes(const model::Case &scene) {
    results::ModesResult result;
    const model::SpeedRange &speeds = model::required_speeds(scene);
    result.speed = speeds.from;
    result.model.formulation = modes::choose_formulation(scene);
    result.model.order = mesh_error::resolve_order(scene, result.model.formulation);
    const modes::SpectrumSolver solver(scene.rotor, result.model.formulation.form,
                                       result.model.order);
    result.model.elements = static_cast<int>(solver.discretization().shaft_mesh().spans.size());
    result.model.unknowns = solver.unknowns();
    const Shapes shapes(solver);
    result.z = shapes.z();
    const modes::Spectrum spectrum = solver.at(result.speed, scene.campbell.modes);
    for (std::size_t i = 0; i < spectrum.modes.size(); ++i)
        result.modes.push_back(shapes.of(spectrum, i));
    for (const double root : spectrum.growing)
        result.model.notes.push_back(
            fmt::format("divergence (static instability): a real eigenvalue of {:+.6g} 1/s, motion "
                        "grows without whirling",
                        root));
    if (static_cast<int>(result.modes.size()) < scene.campbell.modes)
        result.model.notes.push_back(
            fmt::format("{} modes were asked for, the rotor has {} that oscillate",
                        scene.campbell.modes, result.modes.size()));
    if (result.model.formulation.form == results::Form::hill)
        result.model.notes.emplace_back("where modes dissipate is not told of rotors and bearings "
                                        "that both differ between their directions");
    if (speeds.count > 1)
        add_critical(result, scene, shapes);
    return result;
}

} // namespace whirl::analyses
