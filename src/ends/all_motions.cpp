#include "ends/all_motions.h"

#include "assembly/frequency_scales.h"
#include "ends/resolved_reach.h"
#include "modes/roots/roots.h"
#include "modes/zero_modes.h"
#include "stability/motion_reach.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace whirl::ends {

namespace {

/// The range and the bends of bearing tables inside of it, ascending. At rest, where frequencies of
/// both directions are equal and balls do not stand anywhere by themselves, the range is cut.
std::vector<double> borders(const model::Rotor &rotor, double from, double to) {
    std::vector<double> out{from, to};
    for (const double bend : rotor.table_bends())
        if (bend > from && bend < to)
            out.push_back(bend);
    if (from < 0 && to > 0)
        out.push_back(0);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    if (out.size() < 2) // one speed
        out = {from, from + std::max(1.0, std::abs(from))};
    return out;
}

/// Relative distance within which a root of the reduced rotor and one of the whole rotor are the
/// same.
constexpr double same_root = 1e-3;
/// Relative distance at which fast motions of the reduced rotor lead to those of the whole rotor.
/// (Whatever is found there is a motion of the whole rotor.)
constexpr double nearby = 0.05;

/// Of such a root only a lower bound is known, as its inverse is zero within rounding: motions of
/// nearly massless parts, which cannot be followed from speed to speed.
bool is_lost(const Root &root, double shift, double fast) {
    const double distance = std::abs(root.value - shift);
    return root.noise >= std::abs(root.value) && distance / (1 + root.noise / distance) > fast;
}

/// Whether a motion of the whole rotor, found from another root, is that of this root.
bool is_that(const WholeMotion &found, const Root &root) {
    // An angle of 1.4e-3, above the rounding of vectors of one root.
    constexpr double parallel = 1 - 1e-6;
    return std::abs(found.value - root.value) <= found.noise + root.noise &&
           std::abs(found.right.dot(root.right)) >
               parallel * found.right.norm() * root.right.norm();
}

} // namespace

AllMotions::AllMotions(const assembly::Discretization &discretization, results::Form form,
                       const balancers::Arrangement &arrangement,
                       std::shared_ptr<const Eigen::MatrixXd> shapes, double from, double to)
    : _discretization(discretization), _form(form), _shapes(std::move(shapes)),
      _whole(discretization, form,
             balancers::balancer_elements(discretization.rotor(), arrangement)),
      _rotor(_whole, _shapes.get(), borders(discretization.rotor(), from, to),
             synchronous::table_speeds(discretization.rotor())),
      _slow(assembly::support_scale(discretization)), _from(from), _to(to) {
    const double growing = stability::growth_reach(discretization.rotor(), form,
                                                   std::max(std::abs(from), std::abs(to)));
    _growth_reach = std::isfinite(growing) ? growing : 0;
    if (!results::in_rotating_axes(form)) {
        const double speed = to != 0 ? to : from;
        _zeros = modes::zero_modes(discretization, form, speed, speed).eigenvalues;
    }
}

AllMotions::AllMotions(const assembly::Discretization &discretization, modes::FormMatrices whole,
                       std::shared_ptr<const Eigen::MatrixXd> shapes, double from, double to)
    : _discretization(discretization), _form(results::Form::general), _shapes(std::move(shapes)),
      _whole(std::move(whole)), _rotor(_whole, _shapes.get(), {from, to}, {}),
      _slow(assembly::support_scale(discretization)), _from(from), _to(to) {}

AllMotions::AllMotions(stability::BandFinder &finder, const std::vector<double> &speeds)
    : AllMotions(finder.discretization(), finder.model().form, finder.arrangement(),
                 finder.good_shapes(speeds), speeds.front(), speeds.back()) {}

double AllMotions::least_reach() const { return 2.1 * std::max(std::abs(_from), std::abs(_to)); }

double AllMotions::reach() const {
    if (_reach)
        return *_reach;
    // Speeds over the range: the reach lies in a wide gap of all their moduli.
    const int samples = _from == _to ? 1 : 5;
    std::vector<std::vector<double>> sizes(static_cast<std::size_t>(samples));
    for (int k = 0; k < samples; ++k) {
        const double speed = _from + (_to - _from) * (k + 0.5) / samples;
        for (const Root &root : decomposed_at(speed, _rotor.piece_of(speed)).roots)
            if (root.value.imag() >= 0)
                sizes[static_cast<std::size_t>(k)].push_back(std::abs(root.value));
    }
    _reach = stability::motion_reach(std::move(sizes), least_reach());
    return *_reach;
}

double AllMotions::shift_at(double speed) const { return modes::usual_shift(speed, _slow); }

Spectrum AllMotions::at(double speed, int piece) const {
    Spectrum out = decomposed_at(speed, piece);
    if (!_shapes && _growth_reach > least_reach())
        find_signs(out, _growth_reach);
    return out;
}

Spectrum AllMotions::decomposed_at(double speed, int piece) const {
    const double shift = shift_at(speed);
    Spectrum out{{speed, {}}, _rotor.at(speed, piece)};
    out.roots = modes::all_roots(out.problem, shift, _zeros);
    constexpr double beyond = 10; // of all that is looked at
    std::erase_if(out.roots, [&](const Root &root) {
        return is_lost(root, shift, beyond * std::max(least_reach(), _slow));
    });
    return out;
}

WholeMotion AllMotions::lifted(const Root &root, double speed) const {
    return {speed, root.value, _rotor.lifted(root.right), _rotor.lifted(root.left), root.rate};
}

std::optional<WholeMotion> AllMotions::of_whole(const WholeMotion &guess) const {
    if (!_whole_at || _whole_at->speed != guess.speed)
        _whole_at = WholeAt{guess.speed, _whole.at(guess.speed)};
    return at_its_speed(_whole_at->problem, guess, _pencil);
}

bool AllMotions::conserves(double speed) const {
    // Relative, of sums of element matrices; a real asymmetry is an input, far larger.
    constexpr double rounding = 1e-12;
    if (_discretization.rotor().damped())
        return false;
    const modes::QuadraticAt at = _whole.at(speed);
    const auto with_transposed = [](const Eigen::SparseMatrix<double> &A, double sign) {
        return Eigen::SparseMatrix<double>(A + sign * Eigen::SparseMatrix<double>(A.transpose()))
                   .norm() <= rounding * A.norm();
    };
    return with_transposed(at.D, 1) && with_transposed(at.K, -1) && with_transposed(at.M, -1);
}

void AllMotions::count_resolved() {
    _resolved = ends::resolved_up_to(_discretization, _shapes.get(), (_from + _to) / 2);
    _drives_all = true;
}

const Spectrum &AllMotions::with_signs_at(double speed) const {
    if (_with_signs && _with_signs->speed == speed)
        return *_with_signs;
    _with_signs = at(speed);
    if (!_shapes) // on the reduced rotor they are no motions of this mesh
        find_signs(*_with_signs, std::numeric_limits<double>::infinity());
    return *_with_signs;
}

void AllMotions::find_signs(Spectrum &spectrum, double up_to) const {
    for (Root &root : spectrum.roots) {
        const std::complex<double> before = root.value;
        if (root.sign() != 0 || before.imag() < 0 || std::abs(before) > up_to ||
            within_reach(std::abs(before)))
            continue;
        const auto found = of_whole(lifted(root, spectrum.speed));
        if (!found || std::abs(found->value - before) > root.noise ||
            std::ranges::any_of(spectrum.roots, [&](const Root &other) {
                return &other != &root && is_that(*found, other);
            }))
            continue;
        for (Root &both : spectrum.roots)
            if (both.value == before || both.value == std::conj(before)) {
                both.value = {found->value.real(), both.value.imag() < 0
                                                       ? -std::abs(found->value.imag())
                                                       : std::abs(found->value.imag())};
                both.noise = found->noise;
                both.sharp = true;
            }
    }
}

/// The reduced rotor has fast motions only roughly: up to this part of its value a root may lie
/// beyond a bound.
bool AllMotions::is_rough() const { return _drives_all && _shapes != nullptr; }

/// Whether the decay of a motion of this size is judged, too.
bool AllMotions::decides_decay(double size) const {
    return within_reach(size) || (_drives_all && size <= (1 + nearby) * _resolved);
}

/// The motion of the whole rotor that a root of the reduced one leads to; none where there is none.
std::optional<WholeMotion> AllMotions::of_whole(const Root &root, double speed) const {
    auto found = of_whole(lifted(root, speed));
    // Next to zero by the slow motions, as shapes are looked for (stability/range_shapes).
    constexpr double agreeing = 1e-6;
    const double away = std::max((is_rough() ? nearby : same_root) * std::abs(root.value),
                                 agreeing * shift_at(speed));
    return found && std::abs(found->value - root.value) <= away ? std::move(found) : std::nullopt;
}

namespace {

/// Takes the value where its logarithmic decrement is the smallest so far.
void take_least_damped(std::complex<double> value, std::complex<double> &least) {
    constexpr double swings = 1e-6; // Im over modulus: of a real root that rounding has moved off
    if (value.imag() > swings * std::abs(value) &&
        (least == 0.0 || value.real() / value.imag() > least.real() / least.imag()))
        least = value;
}

} // namespace

std::optional<double> AllMotions::least_log_dec(double speed, const FastestGrowing &found) const {
    const std::complex<double> root = found.least_damped;
    if (_form != results::Form::general || root == 0.0)
        return std::nullopt;
    std::complex<double> value = found.value;
    if (std::abs(value - root) > same_root * std::abs(root)) {
        const auto whole = of_whole(
            lifted(modes::with_vectors(_rotor.at(speed, _rotor.piece_of(speed)), root), speed));
        if (!whole || std::abs(whole->value - root) > same_root * std::abs(root))
            return std::nullopt;
        value = whole->value;
    }
    return -2 * std::numbers::pi * value.real() / value.imag();
}

/// From eigenvalues without vectors, refined on the whole rotor; nothing where a motion that counts
/// is neutral within rounding, as its sign then needs the vectors.
std::optional<FastestGrowing> AllMotions::by_values(double speed, double above,
                                                    double up_to) const {
    constexpr double hardly = 1e-5; // where three roots meet rounding moves them by nearly as much
    const double shift = shift_at(speed);
    std::optional<std::complex<double>> best;
    std::complex<double> least = 0;
    const DenseProblem problem = _rotor.at(speed, _rotor.piece_of(speed));
    for (const std::complex<double> &value : modes::all_values(problem, shift, _zeros)) {
        const double size = std::abs(value);
        const bool slow = within_reach(size);
        if (value.imag() < 0 || size > up_to || size <= above || (value.real() < 0 && !slow))
            continue;
        if (!slow || std::abs(value.real()) <= hardly * std::max(size, shift))
            return std::nullopt;
        if (!best || value.real() > best->real())
            best = value;
        take_least_damped(value, least);
    }
    if (!best)
        return std::nullopt;
    const auto found = of_whole(lifted(modes::with_vectors(problem, *best), speed));
    if (!found || std::abs(found->value - *best) > same_root * std::abs(*best) ||
        std::abs(found->value.real()) <= found->noise)
        return std::nullopt;
    return FastestGrowing{found->value, true, least, found->noise};
}

FastestGrowing AllMotions::fastest_growing(double speed, double above, double up_to) const {
    if (!_drives_all)
        if (const auto first = by_values(speed, above, up_to))
            return *first;
    std::vector<Root> roots = (_drives_all ? with_signs_at(speed) : at(speed)).roots;
    const auto asked_for = [=](std::complex<double> value, double margin = 0) {
        return std::abs(value) <= up_to * (1 + margin) && std::abs(value) > above * (1 - margin);
    };
    const double margin = is_rough() ? nearby : 0;
    std::erase_if(roots, [&](const Root &root) { return !asked_for(root.value, margin); });
    std::ranges::sort(roots, std::ranges::greater{}, [](const Root &a) { return a.value.real(); });
    std::complex<double> least = 0;
    for (const Root &root : roots)
        if (within_reach(std::abs(root.value)))
            take_least_damped(root.value, least);
    bool neutral = false;
    // A reduced rotor has few of the motions beyond what the elements resolve.
    const bool all_there = !_drives_all || !_shapes || up_to <= _resolved;
    bool counted = all_there && std::ranges::all_of(roots, [this](const Root &root) {
                       return !_drives_all || root.sign() != 0 || root.sharp ||
                              within_reach(std::abs(root.value));
                   });
    constexpr double none = 1e-6; // at rest, of the motions on the supports: a ball that lies still
    const double zero = std::max(least_reach(), none * _slow);
    // Of the slow motions: inverse iteration knows a root to a part of itself, and of one as near
    // to zero less than the decomposition does.
    constexpr double next_to_zero = 1e-8;
    std::optional<std::complex<double>> best;
    double noise = 0; // of that one
    for (const Root &root : roots) {
        const double size = std::abs(root.value);
        // A root below its noise is ignored, but for one that may be zero.
        const bool known = size <= zero || root.noise < size;
        neutral = neutral || (root.sign() == 0 && known && within_reach(size));
        if (root.value.imag() < 0 || root.sign() == 0 || !(root.sign() > 0 || decides_decay(size)))
            continue; // a zero that rounding blurs must not hide one that grows
        // Of its real part: how far the reduced rotor may be off for a motion as fast.
        constexpr double roughly = 0.5;
        if (best && root.value.real() + roughly * std::abs(root.value.real()) < best->real())
            break;
        if (root.sign() < 0 && neutral && !best)
            return {0, counted, least};
        const auto found = of_whole(root, speed);
        if (!found && size <= next_to_zero * shift_at(speed)) {
            best = root.value;
            noise = root.noise;
        } else if (!found)
            counted = counted && (!_drives_all || root.sign() < 0);
        else if (std::abs(found->value.real()) <= found->noise)
            neutral = neutral || within_reach(size);
        else if (asked_for(found->value) && !(best && best->real() > found->value.real())) {
            best = found->value;
            noise = found->noise;
        }
        if (best && !is_rough())
            break;
    }
    if (best && (best->real() > 0 || !neutral))
        return {*best, counted, least, noise};
    const auto first =
        std::ranges::find_if(roots, [](const Root &root) { return root.sign() != 0; });
    return {first == roots.end() || neutral ? 0 : first->value, counted, least};
}

} // namespace whirl::ends
