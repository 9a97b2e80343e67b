#include "modes/refined_spectrum.h"

#include "assembly/frequency_scales.h"
#include "linalg/check.h"
#include "linalg/dense/products.h"
#include "modes/planar_whirl.h"
#include "modes/roots/followed_roots.h"
#include "modes/roots/reduced_form.h"
#include "modes/roots/roots.h"
#include "modes/roots/whole_pencil.h"
#include "modes/zero_modes.h"
#include "reduction/orthonormal.h"
#include "reduction/planar_shapes.h"
#include "results/formulation.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

/// Bases of growing size; the last one is the whole rotor, where it is small enough.
constexpr int bases = 4;
/// Unknowns of one plane up to which all of them are taken at last.
constexpr int largest_whole = 60;

/// Two that were found from different guesses are the same motion.
template <class Found> bool same_root(const Found &a, const Found &b) {
    // Relative: far above what refinement leaves (1e-13); nearer ones differ by their vectors.
    constexpr double near = 1e-7;
    // An angle of 1.4e-3, above the rounding of vectors of one motion.
    constexpr double parallel = 1 - 1e-6;
    return std::abs(a.value - b.value) <= near * std::abs(a.value) &&
           std::abs(a.right.dot(b.right)) > parallel * a.right.norm() * b.right.norm();
}

} // namespace

class RefinedSpectrum::Data {
  public:
    virtual ~Data() = default;
    virtual Spectrum modes(double speed, int wanted) = 0;
    virtual Spectrum reduced_modes(double speed, int wanted) = 0;
    [[nodiscard]] virtual double left_out() const = 0;
    [[nodiscard]] virtual std::optional<ModeBasis> basis(double speed,
                                                         const Eigen::VectorXcd &values,
                                                         const Eigen::MatrixXcd &right,
                                                         const Eigen::MatrixXcd &left) const = 0;
    virtual std::vector<WhirlMode> near(double speed, const std::vector<WhirlMode> &guesses) = 0;
    virtual void expect(const std::vector<double> &speeds, int wanted) = 0;
    virtual void expect_reduced(const std::vector<double> &speeds, int wanted) = 0;
};

namespace {

/// @tparam Scalar  of the matrices: real in form general, complex in form planar_damped
template <class Scalar> class Refined : public RefinedSpectrum::Data {
  public:
    Refined(const assembly::Discretization &d, const FormMatrices &matrices)
        : _d(d), _matrices(matrices), _relaxation(Relaxation::of(d.rotor().shaft)),
          _supports(assembly::support_scale(d)), _elastic(assembly::elastic_scale(d)) {}

    void expect(const std::vector<double> &speeds, int wanted) override {
        // Solved in full at five speeds of the range; at others from their motions.
        constexpr int steps = 4;
        Range range{std::ranges::min(speeds), std::ranges::max(speeds), wanted};
        if (_counted && _counted->covers(range))
            return;
        range.wanted += 4; // more may be asked for next
        if (_counted)
            range = {std::min(range.from, _counted->from), std::max(range.to, _counted->to),
                     std::max(range.wanted, _counted->wanted)};
        _columns.clear();
        _between.reset();
        _counted.reset();
        std::vector<double> solved;
        _collects = true;
        for (int k = 0; k <= steps; ++k) {
            double speed = range.from + (range.to - range.from) * k / steps;
            const double nearest = *std::ranges::min_element(
                speeds, {}, [speed](double one) { return std::abs(one - speed); });
            if (std::abs(nearest - speed) < 0.3 * (range.to - range.from) / steps)
                speed = nearest;
            if (!solved.empty() && solved.back() == speed)
                continue;
            try {
                static_cast<void>(modes(speed, range.wanted, k % 2 == 0));
                solved.push_back(speed);
            } catch (const linalg::SolverError &) { // said when this speed is asked for
            }
        }
        _collects = false;
        if (solved.size() < 2)
            return;
        _counted = {solved.front(), solved.back(), range.wanted};
        _examined = _counted;
        enrich(solved);
        follow_on_shapes(range.wanted);
    }

    std::optional<ModeBasis> basis(double speed, const Eigen::VectorXcd &values,
                                   const Eigen::MatrixXcd &right,
                                   const Eigen::MatrixXcd &left) const override {
        if (_following == nullptr)
            return std::nullopt;
        return _following->basis(speed, values, amplitudes(right), amplitudes(left));
    }

    Spectrum modes(double speed, int wanted) override {
        return modes(speed, wanted, !_counted || !_counted->covers({speed, speed, wanted}));
    }

    void examine(const std::vector<double> &speeds, int wanted) {
        Range range{std::ranges::min(speeds), std::ranges::max(speeds), wanted};
        if (_examined && _examined->covers(range))
            return;
        if (_examined)
            range = {std::min(range.from, _examined->from), std::max(range.to, _examined->to),
                     std::max(range.wanted, _examined->wanted)};
        for (const double end : {range.from, range.to})
            if (!_examined || !_examined->covers({end, end, range.wanted}))
                static_cast<void>(modes(end, range.wanted, true));
        _examined = range;
    }

    void expect_reduced(const std::vector<double> &speeds, int wanted) override {
        examine(speeds, wanted);
        follow_on_shapes(_examined->wanted);
    }

    Spectrum reduced_modes(double speed, int wanted) override {
        try {
            examine({speed}, wanted);
        } catch (const linalg::SolverError &) { // no shapes do there
            return modes(speed, wanted);
        }
        const ReducedForm *form = reduced(_basis, _examined->wanted);
        const ZeroModes zeros = zero_modes(_d, results::Form::general, speed, speed);
        std::vector<Root> roots = roots_of(*form, speed, wanted, zeros);
        const std::optional<Choice> chosen =
            choice(roots, centre(wanted), speed, wanted, form->is_whole());
        if (!chosen)
            throw linalg::SolverError("the shapes of the rotor miss some of its eigenvalues");
        std::vector<WholeRoot> found;
        for (const std::size_t i : chosen->wanted) {
            const Root &root = roots[i];
            found.push_back({root.value, form->lifted(root.right), form->lifted(root.left), 0,
                             root.noise / std::abs(root.value)});
        }
        return spectrum_of(found, zeros, chosen->complete_radius, speed);
    }

    [[nodiscard]] double left_out() const override {
        constexpr double between = 4; // allowance for other speeds
        return between * _left_out;
    }

    std::vector<WhirlMode> near(double speed, const std::vector<WhirlMode> &guesses) override {
        set(speed);
        std::vector<WhirlMode> out;
        std::vector<WholeRoot> roots;
        for (const WhirlMode &mode : guesses) {
            WholeRoot guess{real ? mode.eigenvalue : mode.rotating_value, mode.shape, {}};
            guess.left = left_of(mode);
            const std::optional<WholeRoot> found = _pencil.refined(guess);
            constexpr double another = 0.2; // of the value
            if (!found ||
                !(std::abs(found->value - guess.value) <= another * std::abs(guess.value)) ||
                std::ranges::any_of(
                    roots, [&](const WholeRoot &other) { return same_root(other, *found); }))
                return {};
            out.push_back(mode_of(*found, speed));
            roots.push_back(*found);
        }
        return out;
    }

  private:
    static constexpr bool real = std::is_same_v<Scalar, double>;
    static constexpr double far = 0.02; ///< of a root: more than shapes that do may leave out
    const assembly::Discretization &_d;
    const FormMatrices &_matrices;
    Relaxation _relaxation;
    double _supports, _elastic; ///< of the order of the motions on the supports, and of the shaft
    WholePencil<Scalar> _pencil;
    std::optional<double> _speed;                         ///< that the pencil is set to
    std::map<int, std::unique_ptr<ReducedForm>> _reduced; ///< by modes at rest; null: not to be had
    int _basis = 0; ///< the least one that has done where eigenvalues were counted
    struct Range {
        double from, to; ///< rad/s
        int wanted;
        [[nodiscard]] bool covers(const Range &other) const {
            return other.from >= from && other.to <= to && other.wanted <= wanted;
        }
    };
    std::optional<Range> _counted;
    std::optional<Range> _examined; ///< at its ends, that the shapes do
    double _left_out = 0;           ///< of eigenvalues of the shapes, relative, the largest seen
    /// How many modes no basis had, by speeds so far; 0: there were as many.
    std::map<double, int> _missed;

    /// As many were missed there, or at the next speeds on both sides.
    [[nodiscard]] bool is_beyond_all_bases(double speed, int wanted) const {
        const auto missed = [wanted](int there) { return there > 0 && wanted >= there; };
        const auto above = _missed.lower_bound(speed);
        if (above == _missed.end() || !missed(above->second))
            return false;
        return above->first == speed ||
               (above != _missed.begin() && missed(std::prev(above)->second));
    }

    Spectrum modes(double speed, int wanted, bool counts) {
        if (!is_beyond_all_bases(speed, wanted)) {
            std::optional<Spectrum> found = modes_on_some_basis(speed, wanted, counts);
            _missed[speed] = found ? 0 : wanted;
            if (found)
                return *std::move(found);
        }
        throw linalg::SolverError("the shapes of the rotor miss some of its eigenvalues");
    }

    std::optional<Spectrum> modes_on_some_basis(double speed, int wanted, bool counts) {
        set(speed);
        if (!counts && _between) {
            try {
                if (std::optional<Spectrum> found = modes_between(speed, wanted))
                    return found;
            } catch (const linalg::SolverError &) { // of the dense problem
            }
            counts = true; // something is unlike what it is at the counted speeds
        }
        for (int basis = _basis; basis < bases; ++basis) {
            const ReducedForm *form = reduced(basis, wanted);
            if (form == nullptr)
                continue;
            try {
                if (std::optional<Spectrum> found = modes(*form, speed, wanted, counts)) {
                    if (counts)
                        _basis = basis;
                    return found;
                }
            } catch (const linalg::SolverError &) { // of the dense problem: another basis may do
            }
            if (form->is_whole())
                break;
        }
        return std::nullopt;
    }

    const ReducedForm *_following = nullptr; ///< on whose shapes modes are followed
    Eigen::MatrixXd _forces;                 ///< metric times these shapes: amplitudes of vectors

    /// From now on, until other speeds are expected: products are of vectors on the same shapes.
    void follow_on_shapes(int wanted) {
        _following = reduced(_basis, wanted);
        if (_following != nullptr && _following->is_whole())
            _following = nullptr;
        if (_following != nullptr)
            _forces = _shapes->metric() * _following->shapes().front();
    }

    [[nodiscard]] Eigen::MatrixXcd amplitudes(const Eigen::MatrixXcd &vectors) const {
        const Eigen::Index r = _forces.cols();
        Eigen::MatrixXcd out(planes * r, vectors.cols());
        for (Eigen::Index plane = 0; plane < planes; ++plane) {
            const Eigen::MatrixXcd of =
                vectors(Eigen::seqN(plane, _forces.rows(), planes), Eigen::all);
            out.middleRows(plane * r, r).real() =
                linalg::transposed_times(_forces, Eigen::MatrixXd(of.real()));
            out.middleRows(plane * r, r).imag() =
                linalg::transposed_times(_forces, Eigen::MatrixXd(of.imag()));
        }
        return out;
    }

    std::optional<reduction::PlanarShapes> _shapes; ///< of the least basis
    bool _collects = false;                         ///< vectors of the speeds solved
    std::vector<Eigen::MatrixXd> _columns;          ///< their parts, of each plane of the form
    /// The rotor on shapes that span these vectors: nearly exact between the speeds.
    struct Between {
        ReducedForm form;
        const ReducedForm &base;                ///< whose roots are the guesses
        std::vector<Eigen::MatrixXd> from_base; ///< amplitudes of each plane, of those of the base
        std::unique_ptr<FollowedRoots<Scalar>> followed;
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> held; ///< of the metric of the shapes
    };
    std::unique_ptr<Between> _between;

    static constexpr Eigen::Index planes = real ? 2 : 1;
    /// N x 2 of each plane: real and imaginary parts.
    [[nodiscard]] static Eigen::MatrixXd parts_of(const Eigen::VectorXcd &vector) {
        return Eigen::Map<const Eigen::MatrixXd>(reinterpret_cast<const double *>(vector.data()),
                                                 2 * planes, vector.size() / planes)
            .transpose();
    }

    void collect(Eigen::VectorXcd vector) {
        if (!_shapes)
            return;
        // As much as may be in the real part.
        vector *= std::polar(1.0, -0.5 * std::arg(Complex(vector.cwiseProduct(vector).sum())));
        Eigen::MatrixXd parts = parts_of(vector);
        const Eigen::MatrixXd forces = _shapes->metric() * parts;
        parts /= std::sqrt(parts.cwiseProduct(forces).sum());
        _columns.resize(planes, Eigen::MatrixXd(parts.rows(), 0));
        for (Eigen::Index plane = 0; plane < planes; ++plane) {
            Eigen::MatrixXd &of = _columns[static_cast<std::size_t>(plane)];
            of.conservativeResize(Eigen::NoChange, of.cols() + 2);
            of.rightCols(2) = parts.middleCols(2 * plane, 2);
        }
    }

    void enrich(const std::vector<double> &nodes) {
        const ReducedForm *base = reduced(_basis, _counted->wanted);
        if (_columns.empty() || base == nullptr || base->is_whole())
            return;
        // Of the length of a motion: what both vectors lack of one is about as small, and an
        // eigenvalue is off by their product.
        constexpr double shortest = 1e-5;
        std::vector<Eigen::MatrixXd> shapes;
        std::vector<Eigen::MatrixXd> from_base;
        for (const Eigen::MatrixXd &columns : _columns) {
            Eigen::MatrixXd of(columns.rows(), 0);
            reduction::take_in_longest_first(of, _shapes->metric(), columns, shortest);
            const Eigen::MatrixXd forces = _shapes->metric() * base->shapes()[shapes.size()];
            from_base.push_back(linalg::transposed_times(of, forces));
            shapes.push_back(std::move(of));
        }
        _columns.clear();
        _between.reset(new Between{
            ReducedForm(_matrices, std::move(shapes)), *base, std::move(from_base), {}, {}});
        _between->held.compute(_shapes->metric());
        _between->followed = std::make_unique<FollowedRoots<Scalar>>(
            _between->form, [this](double speed) { return around(speed); });
        for (const double speed : nodes)
            _between->followed->add(speed);
    }

    /// All within reach of those wanted, as exact as the shapes of the counted speeds have them.
    typename FollowedRoots<Scalar>::All around(double speed) {
        constexpr double beyond = 1.7; // of the farthest wanted: others that may take its place
        const int wanted = _counted->wanted;
        const ZeroModes zeros = zero_modes(_d, results::Form::general, speed, speed);
        typename FollowedRoots<Scalar>::All out;
        try {
            const std::vector<Root> roots = roots_of(_between->base, speed, wanted, zeros);
            const std::optional<Choice> chosen =
                choice(roots, centre(wanted), speed, wanted, false);
            if (!chosen)
                return {};
            for (const std::size_t i : chosen->wanted)
                if (std::abs(roots[i].value - centre(wanted)) <= chosen->farthest)
                    out.reach = std::max(out.reach, 1.05 * std::abs(roots[i].value));
            const DenseQuadratic<Scalar> problem = _between->form.template at<Scalar>(speed);
            for (const Root &root : roots) {
                const bool grows = grows_without_whirl(root, speed);
                if (std::abs(root.value) > beyond * out.reach && !grows)
                    continue;
                std::optional<Root> found = in_between(problem, root);
                if (found && std::ranges::none_of(
                                 out.roots, [&](const Root &a) { return same_root(a, *found); }))
                    out.roots.push_back(*std::move(found));
                else if (std::abs(root.value) <= out.reach || grows)
                    return {};
            }
        } catch (const linalg::SolverError &) {
            return {};
        }
        return out;
    }

    [[nodiscard]] std::optional<Root> in_between(const DenseQuadratic<Scalar> &problem,
                                                 Root of_base) const {
        of_base.right = from_base(of_base.right);
        of_base.left = from_base(of_base.left);
        return _between->form.iterated(problem, std::move(of_base));
    }

    [[nodiscard]] Eigen::VectorXcd from_base(const Eigen::VectorXcd &reduced) const {
        Eigen::Index rows = 0;
        for (const Eigen::MatrixXd &T : _between->from_base)
            rows += T.rows();
        Eigen::VectorXcd out(rows);
        Eigen::Index row = 0;
        Eigen::Index column = 0;
        for (const Eigen::MatrixXd &T : _between->from_base) {
            out.segment(row, T.rows()) = T * reduced.segment(column, T.cols());
            row += T.rows();
            column += T.cols();
        }
        return out;
    }

    [[nodiscard]] Eigen::VectorXcd held(const Eigen::VectorXcd &force) const {
        const Eigen::MatrixXd bent = _between->held.solve(parts_of(force));
        Eigen::VectorXcd out(force.size());
        Eigen::Map<Eigen::MatrixXd>(reinterpret_cast<double *>(out.data()), 2 * planes,
                                    bent.rows()) = bent.transpose();
        return out;
    }

    void set(double speed) {
        if (_speed == speed)
            return;
        const double scale = std::max(_supports, std::abs(speed));
        if constexpr (real)
            _pencil.set(_matrices.at(speed), scale);
        else
            _pencil.set(_matrices.complex_at(speed), scale);
        _speed = speed;
    }

    [[nodiscard]] Eigen::VectorXcd left_of(const WhirlMode &mode) const {
        if (real && mode.left.size() == mode.shape.size())
            return mode.left.conjugate();
        return in_mirror<Scalar>(mode.shape); // as for most supports
    }

    /// Null where there are no such shapes.
    const ReducedForm *reduced(int basis, int wanted) {
        const int N = _d.planar_size();
        // A mode at rest is two whirl modes; more for what speed brings down.
        const int at_rest = (wanted / 2 + 3) << basis;
        const bool whole = _d.rigid() || 2 * at_rest >= N || basis + 1 == bases;
        if (whole && N > largest_whole && !_d.rigid() && 2 * at_rest < N)
            return nullptr;
        const auto [known, is_new] = _reduced.try_emplace(whole ? 0 : at_rest);
        if (!is_new)
            return known->second.get();
        if (whole) {
            known->second =
                std::make_unique<ReducedForm>(_matrices, std::vector<Eigen::MatrixXd>());
            return known->second.get();
        }
        // Free motions, and bearings that push away, are held by the mass.
        for (const double top : {0.0, 0.3, 3.0, 30.0}) {
            try {
                const reduction::PlanarShapes shapes(_d, top * _elastic, at_rest);
                known->second = std::make_unique<ReducedForm>(
                    _matrices, std::vector<Eigen::MatrixXd>(planes, shapes.matrix()));
                if (!_shapes)
                    _shapes = shapes;
                break;
            } catch (const linalg::SolverError &) {
            }
        }
        return known->second.get();
    }

    /// The rate at which the shaft's motions come to rest is not far beyond the modes wanted: two a
    /// bending shape, whose frequencies grow with the square of its number. Then the circle is
    /// around a shift away from there.
    [[nodiscard]] double centre(int wanted) const {
        const double shapes = wanted / 2.0 + 1;
        return _relaxation.rate < shapes * shapes * _elastic ? _relaxation.shift() : 0;
    }

    [[nodiscard]] bool whirls(Complex value, double speed) const {
        return std::abs(value.imag()) > real_axis * std::abs(value) &&
               !_relaxation.stands(value, speed);
    }

    [[nodiscard]] bool grows_without_whirl(const Root &root, double speed) const {
        return !whirls(root.value, speed) && root.value.real() > root.noise;
    }

    /// Which of the roots, ascending from the centre, are wanted, and a circle around them, but for
    /// those that grow without whirl farther out.
    struct Choice {
        std::vector<std::size_t> wanted;
        double farthest = 0; ///< of those in the circle, from the centre
        Circle circle;
        double complete_radius = 0; ///< 1/s
    };
    /// Those that whirl with the lowest frequencies, up to twice as far from the centre as there
    /// are as many (heavily damped ones of low frequency are as far), and those without whirl that
    /// are no farther than as many, or grow.
    [[nodiscard]] std::optional<Choice> choice(const std::vector<Root> &roots, double centre,
                                               double speed, int wanted, bool all) const {
        // Room for heavily damped whirls: |l| is twice the frequency at a damping ratio of
        // 0.87.
        constexpr double farther = 2;
        constexpr double clear = 1.2; // a gap wide enough
        constexpr int beyond = 12;    // roots to find one among
        const auto away = [&](std::size_t i) { return std::abs(roots[i].value - centre); };
        const double infinite = std::numeric_limits<double>::infinity();
        std::vector<std::size_t> whirling;
        for (std::size_t i = 0; i < roots.size(); ++i)
            if (whirls(roots[i].value, speed))
                whirling.push_back(i);
        const auto asked = static_cast<std::size_t>(wanted);
        if (whirling.size() < asked && !all)
            return std::nullopt;
        const double near = whirling.size() < asked ? infinite : away(whirling[asked - 1]);
        std::erase_if(whirling, [&](std::size_t i) { return away(i) > farther * near; });
        std::ranges::stable_sort(whirling, {},
                                 [&](std::size_t i) { return std::abs(roots[i].value.imag()); });
        whirling.resize(std::min(whirling.size(), asked));
        Choice out;
        out.wanted = whirling;
        for (std::size_t i = 0; i < roots.size() && away(i) <= near; ++i)
            if (!whirls(roots[i].value, speed))
                out.wanted.push_back(i);
        if (out.wanted.empty())
            return std::nullopt;
        const std::size_t last = std::ranges::max(out.wanted);
        out.farthest = away(last);
        for (std::size_t i = 0; i < roots.size(); ++i)
            if (away(i) > near && grows_without_whirl(roots[i], speed))
                out.wanted.push_back(i);
        std::ranges::sort(out.wanted);
        out.complete_radius = std::max(0.0, near - centre);
        out.circle = {centre, infinite};
        double widest = 1;
        for (std::size_t i = last; i + 1 < roots.size() && i < last + beyond && widest < clear; ++i)
            if (const double ratio = away(i + 1) / away(i); ratio > widest) {
                widest = ratio;
                out.circle.radius = std::sqrt(away(i) * away(i + 1));
            }
        return std::isfinite(out.circle.radius) || all ? std::optional(out) : std::nullopt;
    }

    static void nearest_first(std::vector<Root> &roots, double centre) {
        std::ranges::stable_sort(
            roots, {}, [centre](const Root &root) { return std::abs(root.value - centre); });
    }

    /// Between the speeds solved first; nothing where not all can be had from these.
    std::optional<Spectrum> modes_between(double speed, int wanted) {
        constexpr double small = 1e-9; // of the eigenvalue: then the correction is its own error
        const ZeroModes zeros = zero_modes(_d, results::Form::general, speed, speed);
        const double c = centre(wanted);
        const ReducedForm &base = _between->base;
        const DenseQuadratic<Scalar> problem = _between->form.template at<Scalar>(speed);
        std::optional<std::vector<Root>> roots = _between->followed->at(speed);
        const bool followed = roots.has_value();
        if (followed) {
            nearest_first(*roots, c);
            // Guesses may be out of order.
            constexpr double out_of_order = 1.05;
            const std::optional<Choice> about = choice(*roots, c, speed, wanted, false);
            if (!about)
                return std::nullopt;
            const double farthest = out_of_order * about->farthest;
            for (Root &root : *roots) {
                if (std::abs(root.value - c) > farthest && !grows_without_whirl(root, speed))
                    continue;
                std::optional<Root> found = _between->form.iterated(problem, std::move(root));
                if (!found)
                    return std::nullopt;
                root = *std::move(found);
            }
            nearest_first(*roots, c);
        } else {
            roots = roots_of(base, speed, wanted, zeros);
        }
        const std::optional<Choice> chosen = choice(*roots, c, speed, wanted, false);
        if (!chosen)
            return std::nullopt;
        std::vector<WholeRoot> found;
        for (const std::size_t i : chosen->wanted) {
            const Root &of = (*roots)[i];
            const std::optional<Root> root = followed ? of : in_between(problem, of);
            std::optional<WholeRoot> whole;
            if (root)
                whole = _pencil.corrected(
                    {root->value, _between->form.lifted(root->right),
                     _between->form.lifted(root->left)},
                    [this](const auto &f) { return held(f); }, _matrices.mirrored());
            if (!whole || !(whole->residual <= small)) {
                whole = _pencil.refined(
                    whole ? *whole
                          : WholeRoot{of.value, base.lifted(of.right), base.lifted(of.left)});
            }
            if (!whole || !(std::abs(whole->value - of.value) <= far * std::abs(of.value)) ||
                std::ranges::any_of(found,
                                    [&](const WholeRoot &a) { return same_root(a, *whole); }))
                return std::nullopt;
            found.push_back(*std::move(whole));
        }
        return spectrum_of(found, zeros, chosen->complete_radius, speed);
    }

    /// All with Im >= 0, of a complex problem all: the next ones to the centre first.
    [[nodiscard]] std::vector<Root> roots_of(const ReducedForm &form, double speed, int wanted,
                                             const ZeroModes &zeros) const {
        const double c = centre(wanted);
        constexpr int more = 6; // some without whirl, and the next ones
        const double shift = c > 0 ? c : usual_shift(speed, _supports);
        std::vector<Root> roots =
            sharp_roots(form.template at<Scalar>(speed), shift, zeros.eigenvalues,
                        static_cast<int>(planes) * (wanted + more));
        if (real)
            std::erase_if(roots, [](const Root &root) { return root.value.imag() < 0; });
        nearest_first(roots, c);
        return roots;
    }

    std::optional<Spectrum> modes(const ReducedForm &form, double speed, int wanted, bool counts) {
        const ZeroModes zeros = zero_modes(_d, results::Form::general, speed, speed);
        const double c = centre(wanted);
        std::vector<Root> roots = roots_of(form, speed, wanted, zeros);
        const std::optional<Choice> chosen = choice(roots, c, speed, wanted, form.is_whole());
        if (!chosen)
            return std::nullopt;
        std::vector<WholeRoot> found;
        for (const std::size_t i : chosen->wanted) {
            Root &root = roots[i];
            const WholeRoot guess{root.value, form.lifted(root.right), form.lifted(root.left)};
            std::optional<WholeRoot> whole = _pencil.refined(guess);
            if (!whole || std::ranges::any_of(
                              found, [&](const WholeRoot &a) { return same_root(a, *whole); }))
                return std::nullopt;
            counts = counts || std::abs(whole->value - root.value) > far * std::abs(root.value) ||
                     (real && (root.value.imag() == 0) != (whole->value.imag() == 0));
            _left_out =
                std::max(_left_out, std::abs(whole->value - root.value) / std::abs(root.value));
            root.value = whole->value;
            if (_collects) {
                collect(whole->right);
                if (!_matrices.mirrored())
                    collect(whole->left);
            }
            found.push_back(*std::move(whole));
        }
        if (_collects) {
            int more = 4;
            for (std::size_t i = 0; i < roots.size() && more > 0; ++i)
                if (std::ranges::find(chosen->wanted, i) == chosen->wanted.end()) {
                    collect(form.lifted(roots[i].right));
                    --more;
                }
        }
        if (counts && std::isfinite(chosen->circle.radius) &&
            !complete(roots, zeros.eigenvalues, chosen->circle))
            return std::nullopt;
        return spectrum_of(found, zeros, chosen->complete_radius, speed);
    }

    /// All within the circle are known.
    [[nodiscard]] bool complete(const std::vector<Root> &roots, int zeros, const Circle &circle) {
        std::vector<Complex> known(static_cast<std::size_t>(zeros), 0.0);
        for (const Root &root : roots) {
            known.push_back(root.value);
            if (real && root.value.imag() != 0)
                known.push_back(std::conj(root.value));
        }
        return complete_within(_pencil, circle, known).value_or(false);
    }

    [[nodiscard]] WhirlMode mode_of(const WholeRoot &root, double speed) const {
        WhirlMode mode;
        mode.eigenvalue = {root.value.real(), std::abs(root.value.imag())};
        mode.residual = root.residual;
        mode.rounding = root.rounding;
        Eigen::Index largest = 0;
        root.right.cwiseAbs2().maxCoeff(&largest);
        mode.shape = root.right / root.right(largest);
        if (real) {
            mode.left = root.left.conjugate();
            if (root.value.imag() < 0) {
                mode.shape = mode.shape.conjugate().eval();
                mode.left = mode.left.conjugate().eval();
            }
        } else {
            set_planar_whirl(mode, root.value, root.value.imag() > 0, speed);
        }
        return mode;
    }

    [[nodiscard]] Spectrum spectrum_of(const std::vector<WholeRoot> &found, const ZeroModes &zeros,
                                       double complete_radius, double speed) const {
        Spectrum out;
        out.speed = speed;
        out.relaxation = _relaxation;
        out.modes = zeros.modes;
        for (const WholeRoot &root : found)
            out.add(root.value, mode_of(root, speed));
        out.complete_radius = complete_radius;
        return out;
    }
};

} // namespace

RefinedSpectrum::RefinedSpectrum(const assembly::Discretization &d, const FormMatrices &matrices) {
    if (matrices.form() == results::Form::planar_damped)
        _data = std::make_unique<Refined<Complex>>(d, matrices);
    else
        _data = std::make_unique<Refined<double>>(d, matrices);
}

RefinedSpectrum::~RefinedSpectrum() = default;

void RefinedSpectrum::expect(const std::vector<double> &speeds, int wanted) {
    if (!speeds.empty())
        _data->expect(speeds, wanted);
}

void RefinedSpectrum::expect_reduced(const std::vector<double> &speeds, int wanted) {
    try {
        if (!speeds.empty())
            _data->expect_reduced(speeds, wanted);
    } catch (const linalg::SolverError &) { // said when this speed is asked for
    }
}

Spectrum RefinedSpectrum::modes(double speed, int wanted) { return _data->modes(speed, wanted); }

Spectrum RefinedSpectrum::reduced_modes(double speed, int wanted) {
    return _data->reduced_modes(speed, wanted);
}

double RefinedSpectrum::left_out() const { return _data->left_out(); }

std::optional<ModeBasis> RefinedSpectrum::basis(double speed, const Eigen::VectorXcd &values,
                                                const Eigen::MatrixXcd &right,
                                                const Eigen::MatrixXcd &left) const {
    return _data->basis(speed, values, right, left);
}

std::vector<WhirlMode> RefinedSpectrum::near(double speed, const std::vector<WhirlMode> &guesses) {
    return _data->near(speed, guesses);
}

} // namespace whirl::modes
