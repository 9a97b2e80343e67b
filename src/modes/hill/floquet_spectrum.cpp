#include "modes/hill/floquet_spectrum.h"

#include "modes/hill/series_pair.h"
#include "periodic/collocation.h"
#include "periodic/monodromy.h"
#include "periodic/triangular_turn.h"
#include "reduction/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace whirl::modes {

namespace {

/// Motions that lose more than exp(-20) of themselves in half a turn beside those that lose least
/// are lost in the rounding of the monodromy matrix.
constexpr double largest_spread = 20;
/// With more steps in time Hill's series costs less.
constexpr int most_steps = 800;
/// For as many terms as are followed.
constexpr int fewest_steps = 16;
/// Motions on bearings that differ are as fast as on their mean, and this much faster at most.
constexpr double of_average = 1.5;
/// Over the speed, what the turning of the bearings adds to the rate of a motion.
constexpr double turning = 4;

/// Modes of a system over amplitudes of shapes: shapes in the fixed frame over all unknowns.
Spectrum lifted(Spectrum found, const Eigen::MatrixXd *shapes) {
    if (shapes != nullptr)
        for (WhirlMode &mode : found.modes)
            mode.shape = reduction::Projection(*shapes).lifted(mode.shape);
    return found;
}

} // namespace

FloquetSpectrum::FloquetSpectrum(const assembly::Discretization &discretization,
                                 const RotatingSpectrum &rotor,
                                 std::vector<balancers::BalancerElement> balancers,
                                 std::shared_ptr<const Eigen::MatrixXd> shapes)
    : _discretization(discretization), _rotor(rotor), _balancers(std::move(balancers)),
      _shapes(std::move(shapes)), _tables(discretization.rotor().bearings_depend_on_speed()) {}

const periodic::System &FloquetSpectrum::system(double speed) const {
    return _system.at(_discretization, speed, _balancers, _shapes.get());
}

/// At one speed of those that differ by no more than a fifth.
const FloquetSpectrum::Steady &FloquetSpectrum::steady(double speed) const {
    const int power = static_cast<int>(std::lround(std::log(std::abs(speed)) / std::log(1.2)));
    const auto known = _steady.find(speed < 0 ? -power - 100000 : power);
    if (known != _steady.end())
        return known->second;
    Steady &out = _steady[speed < 0 ? -power - 100000 : power];
    for (const periodic::FloquetMotion &motion : periodic::steady_motions(system(speed), speed)) {
        out.values.push_back(motion.value);
        out.fastest = std::max(out.fastest, std::abs(motion.value));
    }
    return out;
}

std::optional<FloquetSpectrum::Steps> FloquetSpectrum::steps_for(double speed, double reach) const {
    const double half_turn = std::numbers::pi / std::abs(speed);
    double growth = 0;
    double damping = 0;
    for (const std::complex<double> &value : steady(speed).values) {
        growth = std::max(growth, value.real());
        if (std::abs(value) <= of_average * reach)
            damping = std::max(damping, -value.real());
    }
    const double angle = half_turn * (reach + turning * std::abs(speed));
    const double steps =
        std::max<double>(fewest_steps, std::ceil(angle / periodic::resolved_angle));
    if (!(steps <= most_steps))
        return std::nullopt;
    constexpr double far_faster = 8; // its exponential is left out of them
    const double spread = (growth + damping) * half_turn;
    const auto matter = std::ranges::count_if(steady(speed).values, [&](const auto &value) {
        return (growth - value.real()) * half_turn <= spread + far_faster;
    });
    return Steps{static_cast<int>(steps), spread, static_cast<int>(matter)};
}

std::optional<std::vector<periodic::FloquetSeries>>
FloquetSpectrum::motions(double speed, const Steps &steps, double fastest) const {
    if (steps.spread > largest_spread)
        return periodic::damped_series(system(speed), speed, steps.count, steps.spread,
                                       steps.matter, fastest);
    return periodic::floquet_series(system(speed), speed, steps.count, fastest);
}

Spectrum FloquetSpectrum::shown(double speed, const std::vector<periodic::FloquetSeries> &motions,
                                double complete_radius) const {
    RotatingSpectrum::Eigenvalues found;
    found.complete_radius = complete_radius;
    for (const periodic::FloquetSeries &motion : motions)
        for (const Eigen::Index place : shown_places(_rotor, motion.value, motion.terms, speed)) {
            found.pairs.push_back(series_pair(_rotor, speed, motion.value, motion.terms, place));
            linalg::ComplexPair &pair = found.pairs.back();
            pair.rounding = motion.noise / std::max(std::abs(pair.value), 1e-300);
        }
    std::sort(found.pairs.begin(), found.pairs.end(),
              [](const auto &a, const auto &b) { return std::abs(a.value) < std::abs(b.value); });
    return _rotor.modes_of(found, speed);
}

/// @param all  there are none beyond
std::optional<Spectrum> FloquetSpectrum::up_to(double speed, double reach, bool all) const {
    const std::optional<Steps> steps = steps_for(speed, reach);
    const auto found = steps ? motions(speed, *steps, of_average * reach) : std::nullopt;
    if (!found)
        return std::nullopt;
    return shown(speed, *found, all ? std::numeric_limits<double>::infinity() : reach);
}

std::optional<Spectrum> FloquetSpectrum::by_monodromy(double speed, int wanted) const {
    constexpr double more = 1.5; // growth of the reach a try: each costs a spectrum
    // So that modes a little faster at the next speed need no second try.
    constexpr double margin = 1.15;
    const double size = std::abs(speed);
    const double all = of_average * steady(speed).fastest + turning * size;
    // That most_steps reach, but for rounding; nearly all of the modes will do then.
    const double farthest =
        size * ((1 - 1e-9) * most_steps * periodic::resolved_angle / std::numbers::pi - turning);
    const auto nearly_all = [wanted](std::ptrdiff_t count) { return 4 * count >= 3 * wanted; };
    double &usual = _usual[wanted];
    if (usual == 0)
        usual = margin * (slowest(speed, wanted) + size);
    double reach = std::min(all, std::max(usual, 2 * size));
    if (reach > farthest &&
        nearly_all(std::ranges::count_if(steady(speed).values, [farthest](const auto &value) {
            return value.imag() > 0 && std::abs(value) <= farthest;
        })))
        reach = farthest;
    while (true) {
        std::optional<Spectrum> found = up_to(speed, reach, reach >= all);
        if (!found)
            return std::nullopt;
        std::vector<double> moduli;
        for (const WhirlMode &mode : found->modes)
            moduli.push_back(std::abs(mode.eigenvalue));
        std::sort(moduli.begin(), moduli.end());
        const auto last = static_cast<std::size_t>(wanted) - 1;
        if (moduli.size() > last && moduli[last] <= found->complete_radius) {
            usual = margin * (moduli[last] + size);
            return found;
        }
        if (reach >= all || (reach == farthest && nearly_all(std::ssize(moduli))))
            return found;
        const double next = std::min(
            all, moduli.size() > last ? std::max(more * reach, margin * (moduli[last] + size))
                                      : more * reach);
        reach =
            next > farthest && reach < farthest && nearly_all(std::ssize(moduli)) ? farthest : next;
    }
}

/// A power of one ratio, so that motions are followed from the same speed whatever is asked for.
double FloquetSpectrum::slow() const {
    constexpr double part = 0.2; // of the slowest motion at rest
    // Coarse, so that ranges that differ little begin at the same speed.
    constexpr double ratio = 1.2;
    if (_slow)
        return *_slow;
    double slowest = std::numeric_limits<double>::infinity();
    for (const periodic::FloquetMotion &motion : periodic::steady_motions(system(0), 0))
        slowest = std::min(slowest, std::abs(motion.value));
    _slow = slowest > 0 && std::isfinite(slowest)
                ? std::pow(ratio, std::floor(std::log(part * slowest) / std::log(ratio)))
                : 0;
    return *_slow;
}

FloquetSpectrum::Followed &FloquetSpectrum::followed(double speed, int wanted) const {
    const auto [known, is_new] = _followed.try_emplace(speed < 0 ? -wanted : wanted);
    Followed &out = known->second;
    if (!is_new)
        return out;
    const double from = speed < 0 ? -slow() : slow();
    if (!by_monodromy(from, wanted))
        return out;
    const double usual = _usual[wanted];
    const double reach =
        usual > 0 ? usual : of_average * steady(from).fastest + turning * std::abs(from);
    // A few more, as they may come nearer at other speeds; all of them must be resolved.
    constexpr double more = 1.2;
    const std::optional<Steps> steps = steps_for(from, of_average * reach);
    const auto first = steps ? motions(from, *steps, more * reach) : std::nullopt;
    if (!first)
        return out;
    out.from = from;
    out.reach = reach;
    out.motions.emplace([this](double at) -> const periodic::System & { return system(at); }, from,
                        *first);
    return out;
}

std::optional<Spectrum> FloquetSpectrum::by_following(double speed, int wanted) const {
    if (std::abs(speed) > slow())
        return std::nullopt;
    Followed &all = followed(speed, wanted);
    if (!all.motions)
        return std::nullopt;
    const auto motions = all.motions->at(speed);
    if (!motions)
        return std::nullopt;
    Spectrum out = shown(speed, *motions, all.reach);
    return static_cast<int>(out.modes.size()) >= wanted ? std::optional(std::move(out))
                                                        : std::nullopt;
}

const RotatingSpectrum &FloquetSpectrum::series(double speed, int harmonics) const {
    if (harmonics == _rotor.harmonics() && !_tables)
        return _rotor;
    if (_tables && speed != _series_speed)
        _series.clear();
    _series_speed = speed;
    auto &known = _series[harmonics];
    if (!known)
        known = std::make_unique<RotatingSpectrum>(_discretization, _tables ? speed : 0, _balancers,
                                                   harmonics, _shapes.get());
    return *known;
}

/// With as few harmonics as leave hardly anything at the ends.
Spectrum FloquetSpectrum::by_series(double speed, int wanted) const {
    constexpr int fewest = 2; // harmonics to begin with: each is checked by its last terms
    const Eigen::Index n = _rotor.system().M.size();
    for (int harmonics = std::min(fewest, _rotor.harmonics());; ++harmonics) {
        Spectrum out = series(speed, harmonics).modes(speed, wanted, Errors::of_right_vectors);
        const bool last = harmonics == _rotor.harmonics();
        if (!last && !std::ranges::all_of(out.modes, &WhirlMode::confirmed))
            continue;
        for (WhirlMode &mode : out.modes)
            mode.rotating_vector.conservativeResizeLike(
                Eigen::VectorXcd::Zero(n * (2 * _rotor.harmonics() + 1)));
        return out;
    }
}

double FloquetSpectrum::slowest(double speed, int wanted) const {
    std::vector<double> moduli; // one of each conjugate pair
    for (const std::complex<double> &value : steady(speed).values)
        if (value.imag() >= 0)
            moduli.push_back(std::abs(value));
    std::sort(moduli.begin(), moduli.end());
    const auto last = std::min(static_cast<std::size_t>(wanted), moduli.size());
    return last == 0 ? 0 : moduli[last - 1];
}

bool FloquetSpectrum::loses_to_rounding(double speed, int wanted) const {
    const auto steps =
        speed != 0 ? steps_for(speed, slowest(speed, wanted) + std::abs(speed)) : std::nullopt;
    return steps && steps->spread > largest_spread;
}

bool FloquetSpectrum::resolves(double speed, int wanted) const {
    return speed != 0 && steps_for(speed, slowest(speed, wanted) + std::abs(speed)).has_value();
}

Spectrum FloquetSpectrum::modes(double speed, int wanted) const {
    std::optional<Spectrum> found;
    if (speed != 0)
        found = by_following(speed, wanted);
    if (!found && speed != 0)
        found = by_monodromy(speed, wanted);
    if (!found)
        found = by_series(speed, wanted);
    return lifted(*std::move(found), _shapes.get());
}

} // namespace whirl::modes
