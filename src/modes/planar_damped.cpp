#include "modes/planar_damped.h"

#include "assembly/planes.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "modes/following/continuation.h"
#include "modes/following/followed_modes.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::modes {

namespace {

bool parallel(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b) {
    return std::abs(a.dot(b)) > 0.999 * a.norm() * b.norm();
}

} // namespace

PlanarDamped::PlanarDamped(const assembly::Discretization &discretization, double bearing_speed)
    : _discretization(discretization), _bearing_speed(bearing_speed) {
    // Free motions are decided by the constraints, not by pivots.
    if (zero_modes(discretization, results::Form::planar, bearing_speed, 0).eigenvalues != 0)
        return;
    _problem = SymmetricProblem::with_bearings_at(bearing_speed, discretization,
                                                  results::Form::planar_damped);
    if (!_problem)
        return;
    try {
        const assembly::PlanarSystem system =
            assembly::assemble_planar(discretization, bearing_speed);
        _undamped = std::make_unique<linalg::DefinitePencil>(system.K, system.M, system.G);
    } catch (const linalg::SolverError &) {
        _undamped.reset(); // a bearing pushes away, or something that moves has no mass
    }
}

/// From so many eigenvalues of the undamped rotor those within a circle; nothing where one does not
/// settle, two become one, or some are missing. They are refined as far as rounding lets them be:
/// of the second order in what vectors are off, values alone would not tell how good these are.
std::optional<Spectrum> PlanarDamped::from_undamped(double speed, int wanted, int ask) const {
    FollowedSpeed undamped{speed, {}, 0, true};
    for (const linalg::RealPair &pair : _undamped->smallest(speed, ask)) {
        SymmetricPair &start = undamped.pairs.emplace_back();
        start.value = {0, pair.value};
        start.vector = _problem->from_form(pair.vector.cast<std::complex<double>>());
        undamped.radius = std::max(undamped.radius, std::abs(pair.value));
    }
    const auto count = static_cast<int>(undamped.pairs.size());
    FollowedSpeed damped{speed, undamped.pairs, 0, true};
    std::vector<EigenpairRefinement::Task> tasks;
    for (std::size_t i = 0; i < damped.pairs.size(); ++i)
        tasks.push_back({&damped.pairs[i], speed, distance_from_others(damped.pairs, i), 0});
    EigenpairRefinement(*_problem).refine(tasks);
    if (count < ask || coincide(damped.pairs) ||
        !std::ranges::all_of(damped.pairs, &SymmetricPair::refined))
        return std::nullopt;
    if (count == 2 * _problem->size()) {
        damped.radius = std::numeric_limits<double>::infinity();
    } else {
        damped.radius = widest_gap(damped, std::min(wanted, count - 1), false);
        if (damped.radius == 0 ||
            !none_missing(*_problem, undamped, undamped.radius, damped, damped.radius, false))
            return std::nullopt;
    }
    Spectrum out = modes_of(*_problem, damped);
    for (WhirlMode &mode : out.modes)
        mode.followed = -1;
    return out;
}

Spectrum PlanarDamped::modes(double speed, int wanted) const {
    constexpr int beyond = 4; ///< more eigenvalues than wanted, to place the circle among
    constexpr int most_failures = 2;
    if (!_undamped || _failures >= most_failures)
        return of_real_form(speed, wanted);
    const int all = 2 * _problem->size();
    for (int ask = std::min(all, wanted + beyond);;) {
        std::optional<Spectrum> out = from_undamped(speed, wanted, ask);
        if (!out) {
            ++_failures;
            return of_real_form(speed, wanted);
        }
        const auto found = static_cast<int>(out->modes.size());
        if (found >= wanted || ask == all)
            return *std::move(out);
        ask = std::min(all, ask + std::max(beyond, wanted - found));
    }
}

/// Of a mode (x, y) of the real form, x + i y whirls with exp(l t) and the conjugate of x - i y
/// with exp(conj(l) t). Both are there where two directions share an eigenvalue, as at rest; then
/// each of the modes stands for one of them.
Spectrum PlanarDamped::of_real_form(double speed, int wanted) const {
    if (!_general)
        _general = std::make_unique<GeneralSpectrum>(_discretization, _bearing_speed);
    Spectrum found = _general->modes(speed, wanted);
    std::vector<WhirlMode> planar;
    for (WhirlMode &mode : found.modes) {
        const assembly::Planes planes(mode.shape);
        const Eigen::VectorXcd with = planes.towards();
        const Eigen::VectorXcd against = planes.against().conjugate();
        const auto taken = [&](const Eigen::VectorXcd &w, std::complex<double> value) {
            return std::any_of(planar.begin(), planar.end(), [&](const WhirlMode &other) {
                return std::abs(other.rotating_value - value) <= 1e-7 * std::abs(value) &&
                       (other.rotating_value != 0.0 || other.whirl == mode.whirl) &&
                       parallel(other.shape, w);
            });
        };
        bool positive = with.norm() >= against.norm();
        if (taken(positive ? with : against,
                  positive ? mode.eigenvalue : std::conj(mode.eigenvalue)))
            positive = !positive;
        mode.shape = positive ? with : against;
        set_planar_whirl(mode, positive ? mode.eigenvalue : std::conj(mode.eigenvalue), positive,
                         speed);
        planar.push_back(std::move(mode));
    }
    found.modes = std::move(planar);
    return found;
}

} // namespace whirl::modes
