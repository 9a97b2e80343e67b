#include "stability/hill/periodic_motions.h"

#include "linalg/check.h"
#include "periodic/collocation.h"
#include "stability/hill/hill_motions.h"
#include "stability/motion_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace whirl::stability {

namespace {

using Complex = std::complex<double>;
using periodic::FloquetMotion;
using Floquet = std::vector<FloquetMotion>;

/// With so few planar unknowns nothing is gained by a reduction, nor with so large a part of them.
constexpr int few_unknowns = 16;
constexpr double large_share = 0.7;
/// Roots of the reduced rotor as far as a search needs them, over the spin speed.
constexpr double agreement = 1e-7;
/// Part of a shape that the others must lack for it to be taken in: at first, and where more is
/// needed. The errors of roots are the squares of it.
constexpr std::array new_parts{1e-3, 1e-5, 1e-6};
/// Motions up to this multiple of the spin speed may meet.
constexpr double slow_enough = 4;
/// Stiffness in one direction is at most twice its average over the directions.
constexpr double of_average = 1.5;
/// Speeds of which the motions are kept.
constexpr std::size_t most_kept = 4000;
/// Rounding that is always allowed for, over speed and modulus.
constexpr double ever_there = 1e-11;

/// Largest alias_distance over the speed of those up to a frequency to the nearest of the others.
double largest_change(const Floquet &some, const Floquet &others, double reach, double speed) {
    double worst = 0;
    for (const FloquetMotion &motion : some) {
        if (motion.frequency > reach)
            continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const FloquetMotion &other : others)
            nearest = std::min(nearest, alias_distance(motion.value, other.value, 2 * speed) -
                                            100 * (other.noise + motion.noise));
        worst = std::max(worst, nearest / speed);
    }
    return worst;
}

} // namespace

PeriodicMotions::PeriodicMotions(const assembly::Discretization &discretization,
                                 std::vector<balancers::BalancerElement> balancers, bool driven,
                                 double top, std::shared_ptr<const Eigen::MatrixXd> shapes,
                                 std::shared_ptr<StepExperience> experience)
    : _discretization(discretization), _balancers(std::move(balancers)), _driven(driven), _top(top),
      _reduced(!shapes && !discretization.rigid() && discretization.planar_size() > few_unknowns),
      _grows(_reduced), _shapes(std::move(shapes)),
      _experience(experience ? std::move(experience) : std::make_shared<StepExperience>()) {
    if (_reduced && _top > 0)
        set_shapes();
}

void PeriodicMotions::set_shapes() const {
    _planar = std::make_unique<reduction::PlanarShapes>(_discretization, 2 * _top);
    _shapes = std::make_shared<Eigen::MatrixXd>(_planar->matrix());
    if (!_whole)
        _whole = std::make_unique<periodic::WholeRotor>(_discretization, _balancers);
}

void PeriodicMotions::set_top(double speed) const {
    if (std::abs(speed) <= _top)
        return;
    _top = std::abs(speed);
    if (!_reduced)
        return;
    _system.forget();
    _known.clear();
    _corrected.clear();
    _good_at.clear();
    set_shapes();
}

const periodic::System &PeriodicMotions::system(double speed) const {
    return _system.at(_discretization, speed, _balancers, _shapes.get());
}

/// Of the octave of the range that the speed lies in: all that may meet at its largest speed at the
/// least. Slow speeds then take no more steps than fast ones.
double PeriodicMotions::octave_reach(double speed) const {
    const int octave =
        speed == 0 ? 0 : std::max(0, static_cast<int>(std::log2(_top / std::abs(speed))));
    auto &reach = _experience->reach;
    if (_top != _experience->top)
        reach.clear();
    _experience->top = _top;
    if (const auto known = reach.find(octave); known != reach.end())
        return known->second;
    const double top = std::ldexp(_top, -octave);
    // Speeds over an octave: the reach lies in a wide gap of all their moduli.
    constexpr int samples = 5;
    std::vector<std::vector<double>> sizes(samples);
    for (int k = 0; k < samples; ++k) {
        const double sample = top * (k + 0.5) / samples;
        for (const FloquetMotion &motion : periodic::steady_motions(system(sample), sample))
            if (motion.value.imag() >= 0)
                sizes[static_cast<std::size_t>(k)].push_back(motion.frequency);
    }
    return reach[octave] = motion_reach(std::move(sizes), slow_enough * top);
}

/// Largest frequency of the motions with mean bearings, of a rigid rotor all and of an elastic one
/// those that grow; kept for speeds close by.
double PeriodicMotions::steady_reach(double speed) const {
    constexpr double hardly = 1.05; // faster, by as much the steps are shorter than need be
    const double size = std::abs(speed);
    const auto above = _steady_reach.lower_bound(size);
    if (above != _steady_reach.end() && above->first <= hardly * size)
        return hardly * above->second;
    if (above != _steady_reach.begin() && std::prev(above)->first >= size / hardly)
        return hardly * std::prev(above)->second;
    double out = 0;
    for (const FloquetMotion &motion : periodic::steady_motions(system(speed), speed))
        if (_discretization.rigid() || motion.value.real() > motion.noise)
            out = std::max(out, of_average * std::abs(motion.value.imag()));
    _steady_reach[size] = out;
    return out;
}

double PeriodicMotions::reach(double speed) const {
    const bool rigid = _discretization.rigid();
    const double out = rigid ? 0 : octave_reach(speed);
    return rigid || _driven ? std::max(out, steady_reach(speed)) : out;
}

int PeriodicMotions::steps(double speed, double reach, double density) const {
    const double angle =
        std::numbers::pi / std::abs(speed) * (of_average * reach + slow_enough * std::abs(speed));
    const double wanted = std::ceil(density * angle / periodic::resolved_angle);
    constexpr double most = 1e11; // operations
    const double each = std::pow(2.0 * system(speed).size(), 3);
    if (!(wanted * each < most))
        throw NotSettled(
            model::Sentence("the monodromy matrix at {} cannot be computed: the fastest "
                            "modes take too many periods in half a revolution; raise "
                            "speeds.from",
                            model::as::speed(speed)));
    return static_cast<int>(wanted);
}

/// With as many steps in time as suffice, verified with half as many more wherever the speed has
/// changed much.
Floquet PeriodicMotions::settled(double speed, double reach) const {
    // Ratio of speeds within which the same density of steps is trusted.
    constexpr double another = 1.5;
    constexpr double enough = 1e-10; // of the speed
    constexpr double densest = 16;   // times the usual density of steps: more do not help
    const double size = std::abs(speed);
    // Where no steps suffice they are no more at other speeds.
    for (double density = _experience->density;; density *= another) {
        const int coarse = steps(speed, reach, density);
        Floquet found = periodic::floquet_motions(system(speed), speed, coarse);
        const double known_at = _experience->settled_at;
        if (size < another * known_at && known_at < another * size)
            return found;
        const Floquet fine =
            periodic::floquet_motions(system(speed), speed, coarse + (coarse + 1) / 2);
        const double worst = std::max(largest_change(found, fine, reach, size),
                                      largest_change(fine, found, reach, size));
        if (worst <= enough) {
            _experience->density = density;
            _experience->settled_at = size;
            return found;
        }
        if (density > densest)
            throw NotSettled(
                model::Sentence("the monodromy matrix does not converge at {}: with more steps "
                                "in time its multipliers still change by {} of the spin speed",
                                model::as::speed(speed), model::as::number(worst, 2)));
    }
}

PeriodicMotions::List PeriodicMotions::listed(double speed) const {
    const bool rest = speed == 0;
    const bool rigid = _discretization.rigid();
    const double size = std::abs(speed);
    const double fastest = reach(speed);
    const Floquet found = rest ? periodic::steady_motions(system(0), 0) : settled(speed, fastest);
    List out;
    for (const FloquetMotion &motion : found) {
        if (!rigid && motion.frequency > fastest)
            continue;
        Listed one;
        one.frequency = motion.frequency;
        one.motion.value = motion.value;
        one.motion.state = motion.state;
        if (_grows)
            one.shape = motion.shape;
        one.motion.noise = motion.noise + ever_there * std::max(size, std::abs(motion.value));
        one.motion.may_meet = rigid || motion.frequency <= slow_enough * size || one.motion.grows();
        one.motion.repeats = 2 * size;   // at rest: none
        constexpr double blurred = 1e-4; // where two are about to meet
        if (std::abs(motion.action) > blurred)
            one.motion.action = motion.action > 0 ? 1 : -1;
        out.push_back(std::move(one));
    }
    return out;
}

const PeriodicMotions::List &PeriodicMotions::known(double speed) const {
    if (!_reduced || _top == 0) // new shapes in the midst of a search would mix states up
        set_top(speed);
    const auto found = _known.find(speed);
    if (found != _known.end())
        return found->second;
    if (_known.size() >= most_kept)
        _known.clear();
    return _known.emplace(speed, listed(speed)).first->second;
}

/// Planar shapes of a motion without those that are as small beside the largest: roots are off by
/// the squares.
Eigen::MatrixXd PeriodicMotions::planar_parts_above(double part,
                                                    const Eigen::VectorXcd &terms) const {
    const Eigen::Index N = _discretization.planar_size();
    Eigen::MatrixXd out =
        reduction::planar_parts(terms, N, 2 * (N + balancers::unknowns_of(_balancers)));
    const Eigen::RowVectorXd sizes =
        (out.cwiseProduct(_planar->metric() * out)).colwise().sum().cwiseMax(0).cwiseSqrt();
    for (Eigen::Index j = 0; j < out.cols(); ++j)
        if (sizes(j) < part * sizes.maxCoeff())
            out.col(j).setZero();
    return out;
}

void PeriodicMotions::use_planar() const {
    _known.clear();
    _corrected.clear();
    _system.forget();
    _reduced =
        static_cast<double>(_planar->matrix().cols()) < large_share * _discretization.planar_size();
    _shapes = _reduced ? std::make_shared<Eigen::MatrixXd>(_planar->matrix()) : nullptr;
}

/// Those that matter, or all, as the whole rotor has them; nothing where the shapes were not good
/// enough for one of them, and now there are more.
std::optional<PeriodicMotions::List> PeriodicMotions::corrected(double speed, bool all,
                                                                std::vector<Wanted> *wanted) const {
    List list = known(speed);
    double most = -std::numeric_limits<double>::infinity(); // of none
    for (const Listed &one : list)
        most = std::max(most, one.motion.value.real());
    const double size = std::abs(speed);
    const Eigen::Index shapes = _planar->matrix().cols();
    for (Listed &one : list) {
        Motion &motion = one.motion;
        // And stays so, where nothing damps; else it is next to an end of growth.
        const bool neutral = !_discretization.rotor().damped() && motion.neutral();
        const bool matters =
            motion.grows() || (!neutral && motion.value.real() >= most - 10 * agreement * size);
        // Faster ones are looked at where the rotor turns faster: fewer harmonics suffice there.
        if (motion.value.imag() < 0 || !(matters || (all && motion.may_meet)))
            continue;
        const auto root = whole_root(speed, one);
        if (!root) {
            _unconfirmed = matters ? std::max(_unconfirmed, size) : _unconfirmed;
            continue;
        }
        const double off = std::abs(root->value - motion.value);
        const double allowed = agreement * std::max(size, std::abs(motion.value));
        if (off > allowed + 10 * motion.noise)
            for (const double part : new_parts) {
                _planar->add_newest_first(planar_parts_above(part, root->terms), part);
                if (_planar->matrix().cols() > shapes)
                    break;
            }
        if (wanted != nullptr)
            wanted->push_back({root->value, motion.noise, planar_parts_above(0, root->terms)});
        const Complex before = motion.value;
        motion.value = root->value;
        if (before.imag() == 0 || before.imag() == size) // a real multiplier: its own conjugate
            motion.value.imag(before.imag());
        for (Listed &other : list)
            if (before.imag() > 0 && other.motion.value == std::conj(before))
                other.motion.value = std::conj(motion.value);
    }
    if (_planar->matrix().cols() == shapes)
        return list;
    use_planar();
    return std::nullopt;
}

std::vector<Motion> PeriodicMotions::at(double speed) const {
    set_top(speed);
    if (const auto found = _corrected.find(speed); found != _corrected.end())
        return found->second;
    std::optional<List> list;
    constexpr int tries = 6; // rounds in which motions that the shapes lack are added
    for (int k = 0; _reduced && speed != 0 && !list && k < tries; ++k)
        list = corrected(speed, false);
    if (!list)
        list = known(speed);
    std::vector<Motion> out;
    for (const Listed &one : *list) {
        out.push_back(one.motion);
        if (_grows)
            out.back().state = system(speed).whole(one.shape, speed);
    }
    if (_reduced && _corrected.size() < most_kept)
        _corrected.emplace(speed, out);
    return out;
}

std::vector<Motion> PeriodicMotions::reduced_at(double speed) const {
    std::vector<Motion> out;
    for (const Listed &one : known(speed))
        out.push_back(one.motion);
    return out;
}

const PeriodicMotions::Listed &PeriodicMotions::fastest_growing(double speed) const {
    return *std::ranges::max_element(known(speed), {},
                                     [](const Listed &one) { return one.motion.value.real(); });
}

std::optional<periodic::Neutral>
PeriodicMotions::neutral_next_to(double end, double reach,
                                 const periodic::WholeRotor *other) const {
    if (!_reduced || !_whole || end == 0)
        return std::nullopt;
    const Listed &fastest = fastest_growing(end);
    return periodic::neutral_next_to(other != nullptr ? *other : *_whole, end, fastest.motion.value,
                                     fastest.frequency, reach);
}

} // namespace whirl::stability
