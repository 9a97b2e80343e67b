#include "properties/certificate_checks.h"

#include "assembly/planes.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "balancers/linear_element.h"
#include "ends/all_motions.h"
#include "forced/response_peaks.h"
#include "linalg/check.h"
#include "model/variants.h"
#include "modes/form_matrices.h"
#include "modes/formulation.h"
#include "modes/roots/whole_pencil.h"
#include "modes/spectrum.h"
#include "properties/draw.h"
#include "properties/random_scenes.h"
#include "results/formulation.h"
#include "stability/band_finder.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::properties {

namespace {

using Complex = std::complex<double>;
using results::Form;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Q(l) = l^2 M + l D + K of the whole rotor at one speed, in the axes of a form.
struct DenseRotor {
    Eigen::MatrixXd M, D, K;
    std::vector<Complex> values; ///< both conjugates

    DenseRotor(const assembly::Discretization &d, Form form, double speed) {
        if (results::in_rotating_axes(form)) {
            const model::Rotor &rotor = d.rotor();
            const assembly::RotatingSystem s = assembly::assemble_rotating(
                d, speed,
                balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor)));
            M = s.M.view();
            D = Eigen::MatrixXd(s.damping(speed).view());
            K = Eigen::MatrixXd(s.stiffness(speed).view());
        } else {
            const assembly::FixedSystem s = assembly::assemble_fixed(d, speed);
            M = s.M.view();
            D = Eigen::MatrixXd(s.C.view()) + speed * Eigen::MatrixXd(s.G.view());
            K = Eigen::MatrixXd(s.K.view()) + speed * Eigen::MatrixXd(s.Kc.view());
        }
        values = eigenvalues(std::max(std::abs(speed), 10.0));
    }

    /// The eigenvalue next to a value, as the state matrix has it.
    [[nodiscard]] Complex listed(Complex value) const {
        return *std::min_element(values.begin(), values.end(), [&](Complex a, Complex b) {
            return std::abs(a - value) < std::abs(b - value);
        });
    }

    /// The same by inverse iteration with vectors of both sides, where it is farther away than
    /// `enough`: the state matrix blurs.
    [[nodiscard]] Complex next_to(Complex value, double enough) const {
        Complex l = listed(value);
        if (std::abs(l - value) <= enough)
            return l;
        Eigen::VectorXcd x = Eigen::VectorXcd::Ones(M.rows());
        Eigen::VectorXcd y = x;
        const Complex start = l;
        for (int step = 0; step < 6; ++step) {
            const Eigen::MatrixXcd Q = l * l * M + l * D + K;
            const Eigen::VectorXd scale = Q.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
            const Eigen::MatrixXcd scaled = scale.asDiagonal() * Q * scale.asDiagonal();
            const Eigen::PartialPivLU<Eigen::MatrixXcd> right(scaled);
            const Eigen::PartialPivLU<Eigen::MatrixXcd> left(scaled.adjoint());
            const Eigen::MatrixXcd slope = 2.0 * l * M + D;
            const auto turned = [&scale](const auto &lu, const Eigen::VectorXcd &b) {
                const Eigen::VectorXcd v = lu.solve(Eigen::VectorXcd(scale.asDiagonal() * b));
                return Eigen::VectorXcd(scale.asDiagonal() * v.normalized());
            };
            for (int turn = 0; turn < (step == 0 ? 3 : 1); ++turn) {
                x = turned(right, slope * x);
                y = turned(left, slope.adjoint() * y);
            }
            const Complex change = y.dot(Q * x) / y.dot(slope * x);
            if (!std::isfinite(std::abs(change)))
                break; // the eigenvalue itself
            l -= change;
            if (std::abs(change) <= 4 * epsilon * std::abs(l))
                break;
        }
        return std::abs(l - start) <= 1e-3 * std::abs(start) ? l : start;
    }

  private:
    /// By the state matrix in nu = shift / (l - shift): slow motions, which count, are its largest
    /// eigenvalues, and the stiffness of a fine mesh does not blur them.
    [[nodiscard]] std::vector<Complex> eigenvalues(double size) const {
        const double shift = 0.37 * size;
        const Eigen::MatrixXd Q = shift * shift * M + shift * D + K;
        const Eigen::VectorXd scale = Q.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
        const auto scaled = [&scale](const Eigen::MatrixXd &A) -> Eigen::MatrixXd {
            return scale.asDiagonal() * A * scale.asDiagonal();
        };
        const Eigen::FullPivLU<Eigen::MatrixXd> lu(scaled(Q));
        const Eigen::Index n = M.rows();
        Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        state.topLeftCorner(n, n) = -shift * lu.solve(scaled(2 * shift * M + D));
        state.topRightCorner(n, n) = -shift * shift * lu.solve(scaled(M));
        state.bottomLeftCorner(n, n).setIdentity();
        std::vector<Complex> out;
        for (const Complex nu : state.eigenvalues())
            out.push_back(shift + shift / nu);
        return out;
    }
};

bool whirls(Complex value) { return value.imag() > modes::real_axis * std::abs(value); }

void check_whirl_speeds(const modes::Spectrum &spectrum, const std::string &kind, bool refined,
                        const DenseRotor &dense, bool rotating, int number, Findings &out) {
    double last = 0;
    int listed = 0;
    for (const modes::WhirlMode &mode : spectrum.modes) {
        const Complex value = rotating ? mode.rotating_value : mode.eigenvalue;
        const double size = std::abs(mode.eigenvalue);
        // What the program states of rounding, once for each of the two solutions.
        const double stated = refined ? mode.residual : 0;
        const double each = mode.rounding + (refined ? 0 : mode.residual);
        const double rounding = 2 * each + 4 * epsilon;
        const Complex whole = dense.next_to(value, (2 * stated + rounding) * size);
        out.numbers.push_back({"whirl speed, " + kind, number, spectrum.speed,
                               std::abs(whole - value) / size, stated, rounding});
        last = std::max(last, mode.eigenvalue.imag());
    }
    if (rotating || spectrum.modes.empty())
        return;
    constexpr double beside = 1 - 1e-6;
    const auto counts = [&](Complex value) {
        return whirls(value) && value.imag() < beside * last &&
               std::abs(value) < beside * spectrum.complete_radius;
    };
    for (const modes::WhirlMode &mode : spectrum.modes)
        listed += counts(mode.eigenvalue) ? 1 : 0;
    out.counts.push_back(
        {"whirl speeds", number, spectrum.speed, listed,
         static_cast<int>(std::count_if(dense.values.begin(), dense.values.end(), counts))});
}

void check_growing(const ends::AllMotions &motions, bool reduced, double speed,
                   const DenseRotor &dense, int number, Findings &out) {
    const double reach = motions.reach();
    for (const Complex value : dense.values) {
        const double size = std::max(std::abs(value), std::abs(speed));
        constexpr double near_axis = 1e-6; // neither grows nor dies out, or nearly
        if (std::abs(value) < 1.01 * reach && std::abs(value.real()) < near_axis * size)
            return;
        if (std::abs(std::abs(value) / reach - 1) < 0.01)
            return;
    }
    const auto grows = [reach](Complex value) {
        return value.real() > 0 && std::abs(value) < reach;
    };
    int counted = 0;
    for (const ends::Root &root : motions.at(speed).roots)
        counted += grows(root.value) ? 1 : 0;
    out.counts.push_back(
        {"growing motions", number, speed, counted,
         static_cast<int>(std::count_if(dense.values.begin(), dense.values.end(), grows))});
    const Complex fastest = motions.fastest_growing(speed).value;
    const double size = std::max(std::abs(fastest), std::abs(speed));
    constexpr double solved = 1e-10; // a root of the whole rotor: nothing is left but rounding
    const Complex whole = dense.next_to(fastest, solved * size);
    out.numbers.push_back({reduced ? "growth, reduced" : "growth, whole", number, speed,
                           std::abs(whole - fastest) / size, 0, solved});
}

/// A quantity of the response, of the dense rotor: x and y of q, and what rounding makes of it.
class DenseResponse {
  public:
    DenseResponse(const assembly::Discretization &d, Form form, double speed)
        : _rotating(results::in_rotating_axes(form)), _speed(speed) {
        const Eigen::VectorXcd load = speed * speed * forced::imbalance_loads(d);
        if (_rotating) {
            const assembly::RotatingSystem s = assembly::assemble_rotating(d, speed, {});
            const Eigen::MatrixXd K = s.stiffness(speed).view();
            _Z = K.cast<Complex>();
            _load = assembly::in_pairs(load.real().cast<Complex>(), load.imag().cast<Complex>());
        } else {
            const DenseRotor rotor(d, form, speed);
            const Complex w(0, speed);
            _Z = w * w * rotor.M + w * rotor.D + rotor.K;
            _load = assembly::in_pairs(load, Complex(0, -1) * load);
        }
        _scale = _Z.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
        _lu.compute(_scale.asDiagonal() * _Z * _scale.asDiagonal());
        _inverse = _lu.inverse();
        _q = solved(_load);
        for (int step = 0; step < 2; ++step)
            _q += solved(_load - _Z * _q);
        _entries = epsilon * (_Z.cwiseAbs() * _q.cwiseAbs());
    }

    struct Value {
        double size = 0;     ///< semi-major axis, or that of the force
        double rounding = 0; ///< relative
    };
    /// @param k, c  of the bearing, or none: the deflection
    [[nodiscard]] Value of(const assembly::Combination &stretch,
                           const model::BearingCoefficients *bearing) const {
        Eigen::Vector2cd motion(0, 0);
        Eigen::MatrixXcd rows = Eigen::MatrixXcd::Zero(_q.size(), 2);
        for (const auto &[unknown, factor] : stretch)
            for (int i = 0; i < 2; ++i) {
                motion(i) += factor * _q(2 * unknown + i);
                rows(2 * unknown + i, i) = factor;
            }
        const double moved = motion.norm();
        double spread = 0;
        for (int i = 0; i < 2; ++i) {
            const Eigen::VectorXcd by =
                _scale.asDiagonal() * (_inverse.transpose() * (_scale.asDiagonal() * rows.col(i)));
            spread += by.cwiseAbs().dot(_entries);
        }
        if (_rotating)
            return {moved, spread / moved};
        if (bearing != nullptr)
            motion = (bearing->k.cast<Complex>() + Complex(0, _speed) * bearing->c) * motion;
        const forced::WhirlParts parts({motion(0), motion(1)});
        return {std::abs(parts.a) + std::abs(parts.d), spread / moved};
    }

  private:
    bool _rotating;
    double _speed;
    Eigen::MatrixXcd _Z;
    Eigen::VectorXcd _load, _q;
    Eigen::VectorXd _scale, _entries;
    Eigen::PartialPivLU<Eigen::MatrixXcd> _lu;
    Eigen::MatrixXcd _inverse;

    [[nodiscard]] Eigen::VectorXcd solved(const Eigen::VectorXcd &b) const {
        return _scale.asDiagonal() * _lu.solve(Eigen::VectorXcd(_scale.asDiagonal() * b));
    }
};

} // namespace

model::Case damped_scene(int number) {
    model::Case scene = random_scene(number);
    scene.rotor.shaft.order = number % 3 == 0 ? 2 : 1; // dense eigenvalues, by thousands
    const int elements = number % 4 == 1 ? 4 : 1; // more unknowns than the shapes between speeds
    for (model::Segment &segment : scene.rotor.shaft.segments)
        segment.elements = elements;
    Draw draw(static_cast<std::uint64_t>(number) + 77);
    for (model::Bearing &bearing : scene.rotor.bearings)
        for (model::BearingCoefficients &row : bearing.rows)
            if (row.c.isZero(0))
                row.c = row.k(0, 0) * draw.over_decades(1e-6, 1e-3) * Eigen::Matrix2d::Identity();
    return scene;
}

void check_eigenvalues(const model::Case &scene, int number, Findings &out) {
    const Form form = modes::choose_formulation(scene).form;
    if (form == Form::hill)
        return;
    const bool rotating = results::in_rotating_axes(form);
    const int order = scene.rotor.shaft.order;
    const std::vector<double> speeds = scene.speeds->values();
    const modes::SpectrumSolver solver(scene.rotor, form, order);
    solver.expect(speeds, scene.campbell.modes);
    const assembly::Discretization &d = solver.discretization();
    stability::StabilityModel model = stability::stability_model(scene, speeds);
    const auto arrangement = balancers::arrangement_at_balance(scene.rotor);
    stability::BandFinder finder(model, arrangement);
    const auto shapes = finder.good_shapes(stability::search_speeds(*scene.speeds));
    const ends::AllMotions motions(d, model.form, arrangement, shapes, speeds.front(),
                                   speeds.back());
    for (const double speed : speeds) {
        const DenseRotor dense(d, form, speed);
        const modes::Spectrum spectrum = solver.at(speed, scene.campbell.modes);
        check_whirl_speeds(spectrum, solver.refines() ? "refined" : "solved", solver.refines(),
                           dense, rotating, number, out);
        check_growing(motions, shapes != nullptr, speed, dense, number, out);
    }
    if (!solver.refines())
        return;
    for (const double share : {0.07, 0.29, 0.43, 0.71}) { // none of the speeds solved at first
        const double speed = speeds.front() + share * (speeds.back() - speeds.front());
        check_whirl_speeds(solver.at(speed, scene.campbell.modes), "between", true,
                           DenseRotor(d, form, speed), rotating, number, out);
    }
}

/// A circle in the widest gap between the moduli of the slowest eigenvalues.
double circle_among(const std::vector<Complex> &slowest) {
    double radius = 0;
    double widest = 1;
    for (std::size_t i = 6; i < slowest.size(); ++i) {
        const double gap = std::abs(slowest[i]) / std::abs(slowest[i - 1]);
        if (gap > widest) {
            widest = gap;
            radius = std::abs(slowest[i]) / std::sqrt(gap);
        }
    }
    return radius;
}

/// Whether none of them is left out is told by the argument of the determinant.
void check_winding(const model::Case &scene, int number, Findings &out) {
    const Form form = modes::choose_formulation(scene).form;
    if (form != Form::general)
        return;
    const assembly::Discretization d(scene.rotor, scene.rotor.shaft.order);
    Draw draw(static_cast<std::uint64_t>(number) + 4711);
    const double speed = scene.speeds->values()[1];
    const DenseRotor dense(d, form, speed);
    std::vector<Complex> slowest = dense.values;
    std::sort(slowest.begin(), slowest.end(),
              [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
    constexpr std::size_t most = 40;
    slowest.resize(std::min(slowest.size(), most));
    const double radius = circle_among(slowest);
    modes::WholePencil<double> pencil;
    pencil.set(modes::FormMatrices(d, form, {}).at(speed), radius);
    constexpr int tries = 6;
    for (int k = 0; k < tries; ++k) {
        std::vector<Complex> known;
        bool none = true; // is missing
        for (const Complex value : slowest) {
            const bool leave = std::abs(value) < radius && draw.chance(0.06);
            none = none && !leave;
            if (!leave)
                known.push_back(value);
        }
        // Both conjugates or none.
        for (const Complex value : slowest)
            if (value.imag() > 0 &&
                std::ranges::count(known, value) != std::ranges::count(known, std::conj(value)))
                std::erase_if(known,
                              [&](Complex a) { return a == value || a == std::conj(value); });
        const bool complete = modes::complete_within(pencil, {0, radius}, known).value_or(!none);
        out.counts.push_back(
            {"argument of the determinant", number, speed, complete ? 1 : 0, none ? 1 : 0});
    }
}

void check_peaks(const model::Case &as_given, int number, Findings &out) {
    model::Case scene = as_given;
    scene.rotor = model::with_balancer_imbalances(scene.rotor);
    const Form form = forced::response_formulation(scene).form;
    if (form == Form::hill)
        return;
    const assembly::Discretization d(scene.rotor, scene.rotor.shaft.order);
    std::vector<forced::Quantity> quantities;
    for (const model::Disc &disc : scene.rotor.discs)
        quantities.push_back({.stretch = d.deflection_at(disc.z), .z = disc.z});
    for (std::size_t i = 0; !results::in_rotating_axes(form) && i < scene.rotor.bearings.size();
         ++i) {
        const int bearing = static_cast<int>(i);
        quantities.push_back({forced::stretch_of_bearing(d, bearing), bearing});
    }
    forced::PeakOptions options;
    options.with_errors = false;
    const forced::CertifiedPeaks found =
        forced::response_peaks(d, form, quantities, 10, scene.speeds->to, options);
    double at = std::numeric_limits<double>::quiet_NaN();
    std::unique_ptr<DenseResponse> dense;
    for (const forced::Peak &peak : found.peaks) {
        if (!std::isfinite(peak.value))
            continue;
        if (peak.speed != at)
            dense = std::make_unique<DenseResponse>(d, form, at = peak.speed);
        const forced::Quantity &q = quantities[peak.quantity];
        std::optional<model::BearingCoefficients> bearing;
        if (q.bearing != forced::Quantity::deflection)
            bearing = scene.rotor.bearings[static_cast<std::size_t>(q.bearing)].at(at);
        const auto value = dense->of(q.stretch, bearing ? &*bearing : nullptr);
        out.numbers.push_back({"peak", number, at, std::abs(value.size / peak.value - 1),
                               found.interpolation_error,
                               value.rounding + peak.rounding + 16 * epsilon});
    }
}

} // namespace whirl::properties
