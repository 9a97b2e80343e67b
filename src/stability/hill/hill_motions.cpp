#include "stability/hill/hill_motions.h"

#include "stability/hill/motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::stability {

namespace {

using Complex = std::complex<double>;
using Pairs = std::vector<linalg::ComplexPair>;

constexpr double settled = 1e-8;  ///< of the spin speed
constexpr int fewest_aliases = 8; ///< next to zero: some motions that count at every speed
/// Motions up to this multiple of the spin speed are looked at in any flexible rotor: pairs of them
/// resonate at twice and four times the spin speed.
constexpr double slow_motions = 4;
/// Aliases next to zero have |Im l| up to the spin speed, and a little more.
constexpr double strip = 1.05;

/// What rounding leaves open of an eigenvalue, much where two of them meet, 1/s.
double blur(const linalg::ComplexPair &pair) {
    return (100 * pair.rounding + 10 * pair.residual) * std::abs(pair.value);
}

/// Largest distance over the speed of those of `some` that count to the nearest of the others.
double largest_distance(const modes::RotatingSpectrum &spectrum, const Pairs &some,
                        const Pairs &others, double speed, int terms) {
    double worst = 0;
    for (const linalg::ComplexPair &pair : some) {
        if (std::abs(pair.value.imag()) > speed || spectrum.largest_term(pair.vector) > terms)
            continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const linalg::ComplexPair &other : others)
            nearest = std::min(nearest, apart(pair.value, other.value, 2 * speed) - blur(other));
        worst = std::max(worst, (nearest - blur(pair)) / speed);
    }
    return worst;
}

} // namespace

double apart(Complex a, Complex b, double repeats) {
    return std::min(alias_distance(a, b, repeats), alias_distance(a, std::conj(b), repeats));
}

HillMotions::HillMotions(const assembly::Discretization &discretization,
                         std::vector<balancers::BalancerElement> balancers, int fewest, int least)
    : _discretization(discretization), _balancers(std::move(balancers)), _fewest(fewest),
      _tables(discretization.rotor().bearings_depend_on_speed()), _most(std::max(1, least)),
      _last(_most) {
    const int unknowns = 2 * (discretization.planar_size() + balancers::unknowns_of(_balancers));
    // Unknowns of a series that a speed may cost; 8 to 32 harmonics whatever it is.
    constexpr int largest_problem = 1600;
    _limit = std::clamp(largest_problem / (2 * unknowns), 8, 32);
}

const modes::RotatingSpectrum &HillMotions::spectrum(double speed, int harmonics) const {
    if (_tables && speed != _spectra_speed) {
        _spectra.clear();
        _spectra_speed = speed;
    }
    auto &entry = _spectra[harmonics];
    if (!entry)
        entry = std::make_unique<modes::RotatingSpectrum>(_discretization, _tables ? speed : 0,
                                                          _balancers, harmonics);
    return *entry;
}

/// From the motions without what turns: how fast those are that grow, or all of a rigid rotor.
HillMotions::Reach HillMotions::reach(double signed_speed) const {
    const double speed = std::abs(signed_speed);
    const bool rigid = _discretization.rigid();
    const double all = rigid ? std::numeric_limits<double>::infinity() : 0;
    const auto average = spectrum(signed_speed, 0).eigenvalues(signed_speed, all, _fewest);
    double growth = 0;
    double slow = 0;
    double fast = 0; // the fastest of those that grow
    for (const linalg::ComplexPair &pair : average.pairs) {
        const double frequency = pair.value.imag();
        growth = std::max(growth, pair.value.real());
        if (rigid || frequency < slow_motions * speed)
            slow = std::max(slow, frequency);
        if (pair.value.real() > blur(pair))
            fast = std::max(fast, frequency);
    }
    Reach out;
    out.radius = strip * std::hypot(speed, 2 * growth);
    const double natural = std::max(slow, fast);
    // Stiffness in one direction is at most twice its average over the directions.
    out.terms = std::max(1, static_cast<int>(std::floor((1.5 * natural + speed) / (2 * speed))));
    return out;
}

HillMotions::Found HillMotions::at(double signed_speed) const {
    if (signed_speed == 0) // at rest the terms of the series do not see each other
        return {spectrum(0, 1).aliases(0, 0, _fewest).pairs, 1};
    const double speed = std::abs(signed_speed);
    const Reach wanted = reach(signed_speed);
    const auto aliases = [&](int N) {
        return spectrum(signed_speed, N).aliases(signed_speed, wanted.radius, fewest_aliases).pairs;
    };
    double worst = 1;
    Pairs before;
    for (int N = std::max(_last, wanted.terms + 1); N < _limit; ++N) {
        if (before.empty())
            before = aliases(N);
        Pairs after = aliases(N + 1);
        const modes::RotatingSpectrum &coarse = spectrum(signed_speed, N);
        const modes::RotatingSpectrum &fine = spectrum(signed_speed, N + 1);
        worst = std::max(largest_distance(coarse, before, after, speed, wanted.terms),
                         largest_distance(fine, after, before, speed, wanted.terms));
        if (worst < settled) {
            // Of what is enough: the next speed begins with a harmonic less.
            constexpr double more_than_enough = 1e-3;
            _last = worst < more_than_enough * settled ? std::max(1, N - 1) : N;
            _most = std::max(_most, N);
            std::erase_if(after, [&](const linalg::ComplexPair &pair) {
                return std::abs(pair.value.imag()) > strip * speed ||
                       fine.largest_term(pair.vector) > wanted.terms;
            });
            return {std::move(after), N + 1};
        }
        before = std::move(after);
    }
    throw NotSettled(
        model::Sentence("the Hill series does not settle at {}: with {} harmonics "
                        "eigenvalues still change by {} of the spin speed, or unstable "
                        "modes are too fast for it; raise speeds.from (harmonics lie 2 "
                        "x speed apart) or check the anisotropy of the bearings",
                        model::as::speed(signed_speed), _limit, model::as::number(worst, 2)));
}

} // namespace whirl::stability
