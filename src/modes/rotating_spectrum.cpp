#include "modes/rotating_spectrum.h"

#include "assembly/frequency_scales.h"
#include "assembly/planes.h"
#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "linalg/quadratic/quadratic_problem.h"
#include "linalg/sparse_sum.h"
#include "modes/hill/fixed_frame_whirl.h"
#include "reduction/projection.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::modes {

namespace {

using assembly::i_unit;

/// @throws linalg::SolverError where those found are not all up to the radius
const RotatingSpectrum::Eigenvalues &reaching(const RotatingSpectrum::Eigenvalues &found,
                                              double radius) {
    if (found.complete_radius < radius)
        throw linalg::SolverError("the eigenvalues differ by too many orders of magnitude");
    return found;
}

template <class System> System reduced(System system, const Eigen::MatrixXd *shapes) {
    return shapes != nullptr ? reduction::Projection(*shapes).of(system) : std::move(system);
}

} // namespace

RotatingSpectrum::RotatingSpectrum(const assembly::Discretization &discretization,
                                   double bearing_speed,
                                   const std::vector<balancers::BalancerElement> &balancers,
                                   int harmonics, const Eigen::MatrixXd *shapes)
    : _discretization(discretization), _harmonics(harmonics),
      _system(
          reduced(assembly::assemble_rotating(discretization, bearing_speed, balancers), shapes)),
      _M(_system.M.view()), _C(_system.C.view()), _Cs(_system.Cs.view()), _K(_system.K.view()),
      _Ks(_system.Ks.view()), _Kss(_system.Kss.view()),
      _stations(shapes != nullptr ? Stations::for_orbits(discretization).over(*shapes)
                                  : Stations::for_orbits(discretization)) {
    if (shapes != nullptr)
        _method = linalg::QuadraticMethod::dense;
    _parts = _system.M.size();
    for (auto balancer = balancers.rbegin(); balancer != balancers.rend(); ++balancer)
        for (int j = 0; j < balancer->unknowns(); ++j) {
            _parts -= 2;
            if (balancer->parts.diameter)
                _held.emplace_back(_parts, std::sqrt(*balancer->parts.diameter));
        }
    if (harmonics > 0)
        _supports = reduced(assembly::periodic_supports(discretization, bearing_speed,
                                                        2 * (discretization.planar_size() +
                                                             balancers::unknowns_of(balancers))),
                            shapes);
}

RotatingSpectrum RotatingSpectrum::rough(const assembly::Discretization &d,
                                         const std::vector<balancers::BalancerElement> &balancers,
                                         const Eigen::MatrixXd &shapes) {
    RotatingSpectrum out(d, 0, balancers, 0, &shapes);
    out._rough = true;
    std::size_t next = 0;
    for (const auto *A : {&out._M, &out._C, &out._Cs, &out._K, &out._Ks, &out._Kss})
        out._full[next++] = *A;
    return out;
}

assembly::SystemAtSpeed RotatingSpectrum::hill_system(double speed) const {
    return assembly::hill_system(_system, *_supports, speed, _harmonics);
}

double RotatingSpectrum::motion_energy(const Eigen::VectorXcd &xy) const {
    const Eigen::Index n = xy.size() / 2;
    return _stations.deflection_energy(xy(Eigen::seqN(0, n, 2))) +
           _stations.deflection_energy(xy(Eigen::seqN(1, n, 2)));
}

int RotatingSpectrum::largest_term(const Eigen::VectorXcd &vector) const {
    const Eigen::MatrixXcd terms = assembly::hill_terms(vector, _system.M.size());
    double most = motion_energy(terms.col(_harmonics));
    int term = 0;
    for (int k = 1; k <= _harmonics; ++k) {
        const double size = std::max(motion_energy(terms.col(_harmonics + k)),
                                     motion_energy(terms.col(_harmonics - k)));
        if (size * equal_share > most) {
            most = size;
            term = k;
        }
    }
    return term;
}

/// All others have no part along the diameters, up to rounding.
bool RotatingSpectrum::held(const Eigen::VectorXcd &vector) const {
    double along = 0;
    for (const auto &[first, diameter] : _held)
        along += std::norm(diameter.real() * vector(first) + diameter.imag() * vector(first + 1));
    return along > 0.5 * vector.segment(_parts, _system.M.size() - _parts).squaredNorm();
}

linalg::QuadraticResult RotatingSpectrum::solve_hill(double speed, int wanted, double radius,
                                                     double shift) const {
    linalg::QuadraticOptions options;
    options.shift = shift;
    options.fewest = 1;
    options.method = _method;
    options.enough = radius + shift;
    if (speed != 0) {
        const assembly::SystemAtSpeed hill = hill_system(speed);
        options.wanted = std::min(wanted, hill.M.size());
        return linalg::solve_quadratic(hill.M, hill.D, hill.K, options);
    }
    // At rest nothing turns: constant coefficients.
    options.wanted = std::min(wanted, _system.M.size());
    linalg::QuadraticResult found = linalg::solve_quadratic(
        _system.M, linalg::Matrix::sum(1, _system.C, 1, _supports->C.cosine),
        linalg::Matrix::sum(1, _system.K, 1, _supports->K.cosine), options);
    const Eigen::Index n = _system.M.size();
    for (linalg::ComplexPair &pair : found.pairs) {
        pair.vector.conservativeResize(n * (2 * _harmonics + 1));
        pair.vector.tail(2 * _harmonics * n).setZero();
    }
    return found;
}

/// A motion at rest in rotating axes has one alias that is its own conjugate: that one replaces
/// `pair`, whichever alias is largest.
void RotatingSpectrum::take_self_conjugate(double speed, std::vector<linalg::ComplexPair> &all,
                                           linalg::ComplexPair &pair) {
    const double places = std::round(pair.value.imag() / std::abs(2 * speed));
    const double near = 1e-7 * std::abs(speed);
    if (places == 0 || !(std::abs(pair.value.imag() - places * std::abs(2 * speed)) <= near))
        return;
    for (linalg::ComplexPair &alias : all)
        if (alias.vector.size() > 0 && alias.value.imag() == 0 &&
            std::abs(alias.value.real() - pair.value.real()) <= near) {
            std::swap(pair, alias);
            alias.vector.resize(0); // not to be taken again
            return;
        }
}

RotatingSpectrum::Eigenvalues RotatingSpectrum::solve(double speed, int wanted, double radius,
                                                      double shift, Keep keep) const {
    linalg::QuadraticOptions options;
    options.shift = shift;
    options.fewest = 1;
    linalg::QuadraticResult found;
    if (_rough) {
        const auto &[M, C, Cs, K, Ks, Kss] = _full;
        found.pairs = linalg::all_pairs(M, C + speed * Cs, K + speed * (Ks + speed * Kss), shift);
        found.method = linalg::QuadraticMethod::dense;
        found.complete_radius = std::numeric_limits<double>::infinity();
    } else if (_harmonics == 0) {
        options.wanted = std::min(wanted, _system.M.size());
        options.method = _method;
        options.enough = radius + shift;
        found = linalg::solve_quadratic(
            _M, _C + speed * _Cs, linalg::sum(1, _K, speed, _Ks, speed * speed, _Kss), options);
    } else {
        found = solve_hill(speed, keep == Keep::best ? wanted * (2 * _harmonics + 1) : wanted,
                           radius, shift);
    }
    Eigenvalues out;
    out.shift = shift;
    out.exhausted = found.method == linalg::QuadraticMethod::dense;
    out.complete_radius = std::max(0.0, found.complete_radius - shift);
    const int last = keep == Keep::best ? 0 : std::max(1, _harmonics - 1);
    for (linalg::ComplexPair &pair : found.pairs) {
        if (_harmonics > 0 && largest_term(pair.vector) > last)
            continue;
        out.pairs.emplace_back();
        std::swap(out.pairs.back(), pair);
    }
    if (_harmonics > 0 && keep == Keep::best && speed != 0) {
        for (linalg::ComplexPair &pair : out.pairs)
            take_self_conjugate(speed, found.pairs, pair);
        drop_alias_of_straight(_stations, _system.M.size(), speed, out.pairs);
    }
    std::sort(out.pairs.begin(), out.pairs.end(),
              [](const auto &a, const auto &b) { return std::abs(a.value) < std::abs(b.value); });
    return out;
}

RotatingSpectrum::Eigenvalues RotatingSpectrum::up_to(double speed, double radius, int least,
                                                      Keep keep, Reach reach) const {
    // The shift is no eigenvalue, and of the size of what is looked for: the motions on the
    // supports, or, where those are far slower than the elastic ones wanted besides, these.
    const bool near_zero = keep == Keep::accurate && speed != 0; // every motion has an alias there
    const double slow =
        0.31 * (near_zero ? std::abs(speed)
                          : std::max(std::abs(speed), assembly::support_scale(_discretization)));
    const double fast = 0.31 * std::max(std::abs(speed), assembly::elastic_scale(_discretization));
    try {
        return up_to(speed, radius, least, keep, reach, slow);
    } catch (const linalg::SolverError &) {
        if (fast == slow)
            throw;
        return up_to(speed, radius, least, keep, reach, fast);
    }
}

RotatingSpectrum::Eigenvalues RotatingSpectrum::up_to(double speed, double radius, int least,
                                                      Keep keep, Reach reach, double shift) const {
    if (_exhausted_speed != speed)
        _exhausted.clear();
    _exhausted_speed = speed;
    const int terms = keep == Keep::best ? 1 : 2 * _harmonics + 1;
    const int all = _system.M.size() * terms;
    const int first = std::min(all, std::max(least, _usual));
    const double needed = first < all ? radius : 0; // of all asked for, those that are resolved
    const double sought =
        reach == Reach::asked && first < all ? radius : std::numeric_limits<double>::infinity();
    for (const Exhausted &known : _exhausted) {
        // What fell short of what was sought is all there is.
        const double radius_of_it = known.found.complete_radius;
        const bool final = known.sought >= sought || radius_of_it < known.sought;
        if (known.shift == shift && known.keep == keep && (final || radius_of_it >= sought))
            return reaching(known.found, needed);
    }
    double reached = 0;
    for (int wanted = first;; wanted = std::min(all, wanted + std::max(4, wanted / 2))) {
        Eigenvalues out = solve(speed, wanted, sought, shift, keep);
        if (out.exhausted) {
            std::erase_if(_exhausted, [&](const Exhausted &known) {
                return known.shift == shift && known.keep == keep;
            });
            _exhausted.push_back({shift, keep, out, sought});
            return reaching(out, needed);
        }
        // No more can be resolved beside those found: enough where they reach as far as asked.
        const bool last = out.complete_radius <= reached;
        reached = std::max(reached, out.complete_radius);
        if (last && reached < radius)
            throw linalg::SolverError("the eigenvalues differ by too many orders of magnitude");
        const bool enough = static_cast<int>(out.pairs.size()) >= least;
        if ((enough && out.complete_radius >= radius) || wanted == all || last ||
            std::isinf(out.complete_radius)) {
            _usual = wanted;
            return out;
        }
    }
}

RotatingSpectrum::Eigenvalues RotatingSpectrum::eigenvalues(double speed, double radius,
                                                            int least) const {
    Eigenvalues out = up_to(speed, radius, least, Keep::best, Reach::asked);
    for (linalg::ComplexPair &pair : out.pairs)
        pair.vector.conservativeResize(_system.M.size());
    return out;
}

RotatingSpectrum::Eigenvalues RotatingSpectrum::aliases(double speed, double radius,
                                                        int least) const {
    return up_to(speed, radius, least, Keep::accurate, Reach::asked);
}

/// The mode of an eigenpair in rotating axes as seen from the fixed frame.
WhirlMode RotatingSpectrum::in_fixed_frame(const linalg::ComplexPair &pair, double speed) const {
    const double nu = pair.value.imag();
    WhirlMode mode;
    mode.frequency_rotating = nu;
    mode.rotating_value = pair.value;
    mode.rotating_vector = pair.vector;
    mode.left = pair.left;
    double turn = 0; // rad/s, of the dominant whirl, positive with the spin
    if (speed == 0) {
        turn = nu; // both whirls have this frequency: the whole motion
        mode.shape = pair.vector.head(_system.M.size());
    } else {
        const FixedFrameWhirl whirl = fixed_frame_whirl(_stations, pair, _system.M.size(), speed);
        turn = whirl.turn;
        constexpr double shown = 0.01; // of the energy: a tenth of the deflections
        if (nu != 0 && whirl.other_size >= shown * whirl.size)
            mode.other_frequency = std::abs(whirl.other);
        mode.shape = whirl.shape();
        mode.whirl = whirl.straight      ? results::Whirl::mixed
                     : turn * speed >= 0 ? results::Whirl::forward
                                         : results::Whirl::backward;
        mode.forward_fraction = whirl.straight ? 0.5 : turn * speed >= 0 ? 1 : 0;
    }
    mode.eigenvalue = {pair.value.real(), std::abs(turn)};
    const double size = std::max(std::abs(mode.eigenvalue), 1e-300);
    mode.residual = pair.residual * std::abs(pair.value) / size;
    mode.rounding = pair.rounding * std::abs(pair.value) / size;
    return mode;
}

Spectrum RotatingSpectrum::modes_of(const Eigenvalues &found, double speed) const {
    Spectrum out;
    out.relaxation = Relaxation::of(_discretization.rotor().shaft);
    out.complete_radius = std::max(0.0, found.complete_radius - std::abs(speed));
    std::vector<linalg::ComplexPair> real;
    const auto take = [&](const linalg::ComplexPair &pair, bool stands_for_motion) {
        WhirlMode mode = in_fixed_frame(pair, speed);
        // At rest balls roll freely: a double zero, which rounding moves off the real axis or not.
        const bool zero = mode.residual + mode.rounding >= 1;
        if (zero || mode.eigenvalue.imag() <= real_axis * std::abs(mode.eigenvalue) ||
            out.relaxation.stands(mode.eigenvalue, speed)) {
            out.add_without_whirl(mode.eigenvalue.real(),
                                  (pair.residual + pair.rounding) * std::abs(pair.value));
        } else if (stands_for_motion) {
            out.modes.push_back(std::move(mode));
        }
    };
    for (const linalg::ComplexPair &pair : found.pairs) {
        if (held(pair.vector))
            continue;
        if (pair.value.imag() == 0)
            real.push_back(pair);
        else
            take(pair, true);
    }
    std::stable_sort(real.begin(), real.end(),
                     [](const auto &a, const auto &b) { return a.value.real() > b.value.real(); });
    // Real ones meet their neighbours alone: of each two the one that grows more stands for both,
    // so that a mode stays one mode where they become a complex pair, be it by rounding.
    for (std::size_t i = 0; i < real.size(); ++i)
        take(real[i], i % 2 == 0);
    return out;
}

bool RotatingSpectrum::asked_for(const linalg::ComplexPair &pair, double speed,
                                 double highest) const {
    return pair.value.real() > 0 || std::abs(in_fixed_frame(pair, speed).eigenvalue) <= highest;
}

void RotatingSpectrum::judge(Eigenvalues &found, double speed, double highest) const {
    if (_harmonics > 0)
        return;
    const auto rest =
        std::stable_partition(found.pairs.begin(), found.pairs.end(),
                              [&](const auto &pair) { return asked_for(pair, speed, highest); });
    std::vector<linalg::ComplexPair> asked(found.pairs.begin(), rest);
    linalg::assess_condition(_M, _C + speed * _Cs,
                             linalg::sum(1, _K, speed, _Ks, speed * speed, _Kss), found.shift,
                             asked);
    std::move(asked.begin(), asked.end(), found.pairs.begin());
    std::sort(found.pairs.begin(), found.pairs.end(),
              [](const auto &a, const auto &b) { return std::abs(a.value) < std::abs(b.value); });
}

RotatingSpectrum::Lowest RotatingSpectrum::lowest(double speed, int wanted) const {
    double radius = std::abs(speed);
    Lowest out;
    bool any = false;
    for (int attempt = 0; attempt <= 12; ++attempt) {
        try {
            // Of the series each motion has many aliases: a second decomposition of so large a
            // matrix is for what is asked alone.
            out.found = up_to(speed, radius, wanted, Keep::best,
                              _harmonics > 0 ? Reach::asked : Reach::farthest);
        } catch (const linalg::SolverError &) {
            if (!any)
                throw;
            break; // beside those found (a rotor of few masses) no more can be resolved
        }
        const Spectrum modes = modes_of(out.found, speed);
        any = !modes.modes.empty();
        std::vector<double> moduli;
        for (const WhirlMode &mode : modes.modes)
            moduli.push_back(std::abs(mode.eigenvalue));
        std::sort(moduli.begin(), moduli.end());
        const auto last = static_cast<std::size_t>(wanted) - 1;
        const bool as_many = moduli.size() > last;
        out.enough = as_many && moduli[last] <= modes.complete_radius;
        out.highest = as_many ? (1 + 1e-9) * moduli[last] : std::numeric_limits<double>::infinity();
        if (out.enough || std::isinf(out.found.complete_radius))
            break;
        radius = as_many ? 1.001 * (moduli[last] + std::abs(speed))
                         : 1.5 * std::max(radius, out.found.complete_radius);
    }
    return out;
}

Spectrum RotatingSpectrum::modes(double speed, int wanted, Errors errors) const {
    Lowest all = lowest(speed, wanted);
    if (errors == Errors::with_left_vectors)
        judge(all.found, speed, all.highest);
    Spectrum out = modes_of(all.found, speed);
    if (_harmonics > 0 && speed != 0)
        for (WhirlMode &mode : out.modes)
            mode.confirmed = !cut_off(mode.rotating_vector);
    return out;
}

/// Whether the last terms of the series are not negligible: the eigenvalue is off by their square.
bool RotatingSpectrum::cut_off(const Eigen::VectorXcd &series) const {
    constexpr double hardly = 1e-4; // of the series: the eigenvalue is off by the square, 1e-8
    return series.tail(2 * _system.M.size()).norm() > hardly * series.norm();
}

} // namespace whirl::modes
