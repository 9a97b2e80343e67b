#include "modes/refined_spectrum.h"

#include "assembly/frequency_scales.h"
#include "linalg/check.h"
#include "modes/planar_whirl.h"
#include "modes/roots/reduced_form.h"
#include "modes/roots/whole_pencil.h"
#include "modes/zero_modes.h"
#include "reduction/planar_shapes.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
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
constexpr int largest_whole = 160;

/// Two that were found from different guesses are the same motion.
bool same_root(const WholeRoot &a, const WholeRoot &b) {
    constexpr double near = 1e-7;
    constexpr double parallel = 1 - 1e-6;
    return std::abs(a.value - b.value) <= near * std::abs(a.value) &&
           std::abs(a.right.dot(b.right)) > parallel * a.right.norm() * b.right.norm();
}

} // namespace

class RefinedSpectrum::Data {
  public:
    virtual ~Data() = default;
    virtual Spectrum modes(double speed, int wanted) = 0;
    virtual std::vector<WhirlMode> near(double speed, const std::vector<WhirlMode> &guesses) = 0;
    virtual void expect(const std::vector<double> &speeds, int wanted) = 0;
};

namespace {

/// @tparam Scalar  of the matrices: real in form general, complex in form planar_damped
template <class Scalar> class Refined : public RefinedSpectrum::Data {
  public:
    Refined(const assembly::Discretization &d, const FormMatrices &matrices)
        : _d(d), _matrices(matrices), _relaxation(Relaxation::of(d.rotor().shaft)),
          _supports(assembly::support_scale(d)), _elastic(assembly::elastic_scale(d)) {}

    void expect(const std::vector<double> &speeds, int wanted) override {
        constexpr std::size_t counts = 8;
        const auto [low, high] = std::ranges::minmax(speeds);
        for (std::size_t k = 0; k <= counts; ++k) {
            const double speed = speeds[k * (speeds.size() - 1) / counts];
            if (_known.contains({speed, wanted}))
                continue;
            try {
                _known.emplace(std::pair(speed, wanted), modes(speed, wanted));
            } catch (const linalg::SolverError &) { // told when it is asked for
                return;
            }
        }
        _counted.push_back({low, high, wanted});
    }

    Spectrum modes(double speed, int wanted) override {
        if (const auto known = _known.find({speed, wanted}); known != _known.end())
            return known->second;
        set(speed);
        const bool counts = std::ranges::none_of(_counted, [&](const Range &range) {
            return speed >= range.from && speed <= range.to && wanted <= range.wanted;
        });
        for (int basis = _basis; basis < bases; ++basis) {
            const ReducedForm *form = reduced(basis, wanted);
            if (form == nullptr)
                continue;
            try {
                if (std::optional<Spectrum> found = modes(*form, speed, wanted, counts)) {
                    if (counts)
                        _basis = basis;
                    return *std::move(found);
                }
            } catch (const linalg::SolverError &) { // of the dense problem: another basis may do
            }
            if (form->is_whole())
                break;
        }
        throw linalg::SolverError("the shapes of the rotor miss some of its eigenvalues");
    }

    std::vector<WhirlMode> near(double speed, const std::vector<WhirlMode> &guesses) override {
        set(speed);
        std::vector<WhirlMode> out;
        for (const WhirlMode &mode : guesses) {
            WholeRoot guess{real ? mode.eigenvalue : mode.rotating_value, mode.shape, {}};
            guess.left = left_of(mode);
            const std::optional<WholeRoot> found = _pencil.refined(guess);
            constexpr double far = 0.2;
            if (!found || !(std::abs(found->value - guess.value) <= far * std::abs(guess.value)))
                return {};
            out.push_back(mode_of(*found, speed));
        }
        return out;
    }

  private:
    static constexpr bool real = std::is_same_v<Scalar, double>;
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
    };
    std::vector<Range> _counted;                       ///< at speeds in it, the ends among them
    std::map<std::pair<double, int>, Spectrum> _known; ///< there, by how many were wanted

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
        if (!real) // a symmetric matrix
            return mode.shape.conjugate();
        if (mode.left.size() == mode.shape.size())
            return mode.left.conjugate();
        Eigen::VectorXcd out = mode.shape.conjugate(); // in the mirror, as for most supports
        for (Eigen::Index k = 1; k < out.size(); k += 2)
            out(k) = -out(k);
        return out;
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
            known->second = std::make_unique<ReducedForm>(_matrices, Eigen::MatrixXd());
            return known->second.get();
        }
        // Free motions, and bearings that push away, are held by the mass.
        for (const double top : {0.0, 0.3, 3.0, 30.0}) {
            try {
                const reduction::PlanarShapes shapes(_d, top * _elastic, at_rest);
                known->second = std::make_unique<ReducedForm>(_matrices, shapes.matrix());
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

    /// Which of the roots, ascending from the centre, are wanted, and a circle around them.
    struct Choice {
        std::vector<std::size_t> wanted;
        Circle circle;
        double complete_radius = 0; ///< 1/s
    };
    /// Those that whirl with the lowest frequencies, up to twice as far from the centre as there
    /// are as many (heavily damped ones of low frequency are as far), and those without whirl that
    /// are no farther than as many.
    [[nodiscard]] std::optional<Choice> choice(const std::vector<Root> &roots, double centre,
                                               double speed, int wanted, bool all) const {
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
        std::ranges::sort(out.wanted);
        if (out.wanted.empty())
            return std::nullopt;
        out.complete_radius = std::max(0.0, near - centre);
        out.circle = {centre, infinite};
        double widest = 1;
        for (std::size_t i = out.wanted.back();
             i + 1 < roots.size() && i < out.wanted.back() + beyond && widest < clear; ++i)
            if (const double ratio = away(i + 1) / away(i); ratio > widest) {
                widest = ratio;
                out.circle.radius = std::sqrt(away(i) * away(i + 1));
            }
        return std::isfinite(out.circle.radius) || all ? std::optional(out) : std::nullopt;
    }

    std::optional<Spectrum> modes(const ReducedForm &form, double speed, int wanted, bool counts) {
        const ZeroModes zeros = zero_modes(_d, results::Form::general, speed, speed);
        const double c = centre(wanted);
        const double shift = c > 0 ? c : 0.31 * std::max(std::abs(speed), _supports);
        std::vector<Root> roots =
            all_roots(form.template at<Scalar>(speed), shift, zeros.eigenvalues);
        if (real)
            std::erase_if(roots, [](const Root &root) { return root.value.imag() < 0; });
        std::ranges::stable_sort(roots, {},
                                 [c](const Root &root) { return std::abs(root.value - c); });
        const std::optional<Choice> chosen = choice(roots, c, speed, wanted, form.is_whole());
        if (!chosen)
            return std::nullopt;
        std::vector<WholeRoot> found;
        for (const std::size_t i : chosen->wanted) {
            Root &root = roots[i];
            std::optional<WholeRoot> whole =
                _pencil.refined({root.value, form.lifted(root.right), form.lifted(root.left)});
            if (!whole || std::ranges::any_of(
                              found, [&](const WholeRoot &a) { return same_root(a, *whole); }))
                return std::nullopt;
            constexpr double far = 0.02; // more than shapes that do may leave out
            counts = counts || std::abs(whole->value - root.value) > far * std::abs(root.value) ||
                     (real && (root.value.imag() == 0) != (whole->value.imag() == 0));
            root.value = whole->value;
            found.push_back(*std::move(whole));
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

Spectrum RefinedSpectrum::modes(double speed, int wanted) { return _data->modes(speed, wanted); }

std::vector<WhirlMode> RefinedSpectrum::near(double speed, const std::vector<WhirlMode> &guesses) {
    return _data->near(speed, guesses);
}

} // namespace whirl::modes
