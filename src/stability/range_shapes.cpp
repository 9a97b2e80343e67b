#include "stability/range_shapes.h"

#include "assembly/frequency_scales.h"
#include "linalg/check.h"
#include "modes/form_matrices.h"
#include "modes/roots/roots.h"
#include "modes/roots/whole_pencil.h"
#include "modes/zero_modes.h"
#include "reduction/planar_shapes.h"
#include "reduction/projection.h"
#include "stability/motion_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>

namespace whirl::stability {

namespace {

/// Nothing is gained with so large a part of all shapes, nor where other ones are hardly fewer.
constexpr double large_part = 0.8;
constexpr double hardly_fewer = 0.85;
/// Part of a motion's length that the basis may lack: first of the motions it does not reproduce,
/// in steps, then of all. Eigenvalues are off by its square.
constexpr std::array left_of_lacking{3e-2, 1e-2, 3e-3, 1e-3, 1e-5};
constexpr double left_of_all_rotating = 1e-4;
constexpr double left_of_all_fixed = 1e-3;
/// How far an eigenvalue may be from that of the whole rotor, which results have in the end: over
/// it or the spin speed of motions that matter (reach_at), in rotating axes, where roots meet next
/// to zero, and in fixed ones; over it of faster ones, as far as there are some.
constexpr double agreeing_rotating = 1e-7;
constexpr double agreeing_fixed = 1e-5;
constexpr double agreeing_fast = 1e-3;

using MotionVectors = std::vector<Eigen::VectorXcd>;

/// |l| up to which the motions at a speed must be those of the whole rotor, rad/s: a little above
/// the speed, for combination resonances in rotating axes, and all that may begin or cease to grow.
/// Where something drives all, those that grow are looked at as far as there are shapes.
double reach_at(double speed, const model::Rotor &rotor, results::Form form) {
    constexpr double slow = 1.3; // of the speed: a little above it, as said above
    const double growing = growth_reach(rotor, form, std::abs(speed));
    return std::max(slow * std::abs(speed), std::isfinite(growing) ? growing : 0);
}

/// The motions of the whole rotor at one speed, next to those of a reduced one.
class Comparison {
  public:
    Comparison(const modes::FormMatrices &whole, double speed)
        : _whole(whole.at(speed)), _speed(std::abs(speed)),
          _fewest(fewest_motions(whole.discretization().rotor())),
          _reach(reach_at(speed, whole.discretization().rotor(), whole.form())),
          _agreeing(results::in_rotating_axes(whole.form()) ? agreeing_rotating : agreeing_fixed),
          _shift(modes::usual_shift(speed, assembly::support_scale(whole.discretization()))) {
        if (!results::in_rotating_axes(whole.form()))
            _zeros =
                modes::zero_modes(whole.discretization(), whole.form(), speed, speed).eigenvalues;
        _pencil.set(_whole, _shift);
    }

    void with(const Eigen::MatrixXd &shapes) {
        const reduction::Projection basis(shapes);
        std::vector<modes::Root> roots = modes::all_roots<double>(
            {basis.of(_whole.M), basis.of(_whole.D), basis.of(_whole.K), {}, {}}, _shift, _zeros);
        keep_values(roots);
        std::erase_if(roots, [](const modes::Root &root) { return root.value.imag() < 0; });
        std::ranges::sort(roots, {}, [](const auto &root) { return std::abs(root.value); });
        _agrees = true;
        _motions.clear();
        _lacking.clear();
        for (int k = 0; k < std::ssize(roots); ++k) {
            const modes::Root &root = roots[static_cast<std::size_t>(k)];
            const double size = std::abs(root.value);
            const bool is_slow = size <= _reach;
            const bool matters = k < _fewest || is_slow || root.sign() > 0;
            if (!matters || root.noise >= size) // of the latter nothing is known
                continue;
            auto found =
                _pencil.refined({root.value, basis.lifted(root.right), basis.lifted(root.left)});
            const double allowed =
                root.noise + (is_slow ? _agreeing * std::max(size, _speed) : agreeing_fast * size);
            const bool same = found && std::abs(found->value - root.value) <= allowed;
            _agrees = _agrees && (same || !is_slow);
            if (!found)
                continue;
            for (Eigen::VectorXcd *vector : {&found->right, &found->left}) {
                if (!same)
                    _lacking.push_back(*vector);
                _motions.push_back(std::move(*vector));
            }
        }
    }

    /// With the last basis all motions that matter agree with the whole rotor.
    [[nodiscard]] bool agrees() const { return _agrees; }
    /// No motion that matters is missing: the determinant counts no other eigenvalue up to the next
    /// gap.
    [[nodiscard]] bool complete_with(const Eigen::MatrixXd &shapes) {
        with(shapes);
        constexpr double beyond = 1.02; // hardly, for beyond that shapes need have no motions
        std::vector<double> sizes;
        for (const std::complex<double> value : _values)
            sizes.push_back(std::abs(value));
        sizes.push_back(beyond * _reach);
        std::ranges::sort(sizes);
        double below = _reach;
        double radius = _reach;
        double widest = 1;
        for (const double above : sizes) {
            if (above <= _reach)
                continue;
            if (above / below > widest) {
                widest = above / below;
                radius = std::sqrt(above * below);
            }
            if (above >= beyond * _reach)
                break;
            below = above;
        }
        return modes::complete_within(_pencil, {0, radius}, _values).value_or(false);
    }
    /// Of the whole rotor, right and left vectors: all, and those that the shapes lack.
    [[nodiscard]] const MotionVectors &motions() const { return _motions; }
    [[nodiscard]] const MotionVectors &lacking() const { return _lacking; }

  private:
    modes::QuadraticAt _whole;
    double _speed; ///< rad/s, its modulus
    int _fewest, _zeros = 0;
    double _reach; ///< |l| up to which all must agree, 1/s
    double _agreeing;
    double _shift;
    modes::WholePencil<double> _pencil;
    bool _agrees = false;
    std::vector<std::complex<double>> _values; ///< all eigenvalues on the last shapes, 1/s
    MotionVectors _motions, _lacking;

    void keep_values(const std::vector<modes::Root> &roots) {
        _values.assign(static_cast<std::size_t>(_zeros), 0.0);
        for (const modes::Root &root : roots)
            _values.push_back(root.value);
    }
};

/// Planar shapes of motions, a motion of length 1.
Eigen::MatrixXd parts_of(const MotionVectors &motions, const Eigen::SparseMatrix<double> &metric) {
    Eigen::MatrixXd out(metric.rows(), 4 * std::ssize(motions));
    for (Eigen::Index k = 0; k < std::ssize(motions); ++k) {
        const Eigen::VectorXcd &vector = motions[static_cast<std::size_t>(k)];
        const Eigen::MatrixXd parts = reduction::planar_parts(vector, metric.rows(), vector.size());
        const double square = parts.cwiseProduct(metric * parts).colwise().sum().maxCoeff();
        out.middleCols(4 * k, 4) = square > 0 ? Eigen::MatrixXd(parts / std::sqrt(square)) : parts;
    }
    return out;
}

/// Adds shapes until the reduced rotor reproduces the motions at one more speed.
/// @returns whether it has
bool enriched(reduction::PlanarShapes &planar, Comparison &comparison) {
    const auto too_many = [&planar] {
        return static_cast<double>(planar.matrix().cols()) >
               large_part * static_cast<double>(planar.metric().rows());
    };
    if (too_many())
        return false;
    comparison.with(planar.matrix());
    for (const double left : left_of_lacking) {
        if (comparison.lacking().empty())
            break;
        const Eigen::Index before = planar.matrix().cols();
        planar.add_longest_first(parts_of(comparison.lacking(), planar.metric()), left);
        if (planar.matrix().cols() != before)
            comparison.with(planar.matrix());
    }
    return !too_many() && comparison.agrees();
}

/// Modes and static deflections are more than the motions need: as few as span these alone.
/// @param left  of each, at most
void keep_spanning(reduction::PlanarShapes &planar, std::list<Comparison> &comparisons,
                   double left) {
    MotionVectors motions;
    for (const Comparison &comparison : comparisons)
        motions.insert(motions.end(), comparison.motions().begin(), comparison.motions().end());
    if (motions.empty())
        return;
    const Eigen::Index all = planar.matrix().cols();
    reduction::PlanarShapes smaller = planar;
    smaller.keep(Eigen::MatrixXd(all, 0));
    smaller.add_longest_first(parts_of(motions, planar.metric()), left);
    const bool fewer =
        static_cast<double>(smaller.matrix().cols()) <= hardly_fewer * static_cast<double>(all);
    if (fewer && std::ranges::all_of(comparisons, [&smaller](Comparison &comparison) {
            comparison.with(smaller.matrix());
            return comparison.agrees() && comparison.lacking().empty();
        }))
        planar = smaller;
}

} // namespace

std::shared_ptr<const Eigen::MatrixXd> range_shapes(const assembly::Discretization &d,
                                                    results::Form form,
                                                    const balancers::Arrangement &arrangement,
                                                    const std::vector<double> &speeds,
                                                    const Eigen::MatrixXd *start) {
    const modes::FormMatrices whole(d, form, balancers::balancer_elements(d.rotor(), arrangement));
    const double fastest = std::max(std::abs(speeds.front()), std::abs(speeds.back()));
    // Modes at rest are taken up to twice as far: none faster than those that can grow.
    const double top = std::max(2 * fastest, reach_at(fastest, d.rotor(), form) / 2);
    reduction::PlanarShapes planar = start != nullptr ? reduction::PlanarShapes(d, top, *start)
                                                      : reduction::PlanarShapes(d, top);
    std::list<Comparison> comparisons;
    const std::size_t last = speeds.size() - 1;
    std::vector<double> looked_at{0}; // at rest: not at all
    for (const std::size_t place : {last, std::size_t{0}, last / 2, last / 4, 3 * last / 4}) {
        if (std::ranges::find(looked_at, speeds[place]) != looked_at.end())
            continue;
        looked_at.push_back(speeds[place]);
        if (!enriched(planar, comparisons.emplace_back(whole, speeds[place])))
            return nullptr;
    }
    if (start == nullptr)
        keep_spanning(planar, comparisons,
                      results::in_rotating_axes(form) ? left_of_all_rotating : left_of_all_fixed);
    int counted = 0; // at the last and the first speed
    for (Comparison &comparison : comparisons)
        if (counted++ < 2 && !comparison.complete_with(planar.matrix()))
            return nullptr;
    return std::make_shared<const Eigen::MatrixXd>(planar.matrix());
}

} // namespace whirl::stability
