#include "modes/planar_damped.h"

#include "assembly/planes.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "modes/following/sorted_modes.h"
#include "modes/following/winding.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using ComplexSparse = linalg::SymmetricFactor::Sparse;
constexpr Complex imaginary(0, 1);

/// Values of a matrix in the order of a pattern that holds all its entries.
Eigen::VectorXd values_on(const ComplexSparse &pattern, const linalg::Matrix &A) {
    Eigen::SparseMatrix<double> entries = A.view();
    entries.prune(0.0);
    const ComplexSparse full = entries.cast<Complex>();
    ComplexSparse zero = pattern;
    zero.coeffs().setZero();
    const ComplexSparse on = zero + full; // the union of both patterns is the larger one
    return on.coeffs().real();
}

/// Sorts an eigenpair in: a whirl mode, or motion without whirl.
void take(Complex value, const Eigen::VectorXcd &vector, double residual, double rounding,
          double speed, GeneralSpectrum::Modes &out) {
    WhirlMode mode;
    mode.eigenvalue = {value.real(), std::abs(value.imag())};
    mode.shape = vector;
    mode.residual = residual;
    mode.rounding = rounding;
    set_planar_whirl(mode, value, value.imag() > 0, speed);
    sort_in(value, std::move(mode), out);
}

bool parallel(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b) {
    return std::abs(a.dot(b)) > 0.999 * a.norm() * b.norm();
}

} // namespace

class PlanarDamped::AtSpeed {
  public:
    AtSpeed(const PlanarDamped &rotor, double speed)
        : _rotor(rotor), _speed(speed), _Q(rotor._pattern),
          _D(rotor._C.cast<Complex>() + imaginary * (rotor._Cx - speed * rotor._G)),
          _K(rotor._K.cast<Complex>() + imaginary * (rotor._Kx - speed * rotor._Kc)),
          _absM(rotor._M.cwiseAbs()), _absD(_D.cwiseAbs()), _absK(_K.cwiseAbs()),
          _static(*rotor._factor) {
        set(0);
        _static.factorize(_Q);
    }

    /// Rayleigh quotient iteration, which is cubic with a symmetric matrix; false where it does not
    /// settle.
    [[nodiscard]] bool refine(Pair &pair) {
        constexpr int most_steps = 10;
        constexpr double enough = 1e-12;
        constexpr double nearly = 1e-6; ///< a change after which the next one is rounding
        Products of = products(pair.vector);
        pair.value = of.rayleigh(pair.value);
        double last = std::numeric_limits<double>::infinity();
        for (int step = 0; step < most_steps; ++step) {
            factorize(pair.value);
            const Eigen::VectorXcd z = _rotor._factor->solve(of.slope(pair.value));
            pair.vector = z / z.cwiseAbs().maxCoeff();
            of = products(pair.vector);
            const Complex before = pair.value;
            pair.value = of.rayleigh(before);
            if (std::abs(pair.value - before) > nearly * std::abs(before))
                continue;
            assess(pair, of);
            if (pair.residual <= enough || (pair.residual >= 0.5 * last && pair.residual < 1e-9))
                return true;
            last = pair.residual;
        }
        return false;
    }

    /// Argument of det Q(z) over that of the undamped rotor at another z, without the eigenvalues
    /// given of both: what is far from them is nearly the same in both and drops out.
    [[nodiscard]] double phase(Complex z, Complex undamped, const std::vector<Pair> &without) {
        set(z);
        _rotor._factor->factorize(_Q);
        double phase = _rotor._factor->determinant_phase();
        const Complex turning = -imaginary * _speed * undamped;
        for (Eigen::Index p = 0; p < _D.size(); ++p)
            _Q.valuePtr()[p] =
                undamped * undamped * _rotor._M(p) + turning * _rotor._G(p) + _rotor._K(p);
        _rotor._factor->factorize(_Q);
        phase -= _rotor._factor->determinant_phase();
        for (const Pair &pair : without)
            phase += std::arg((undamped - imaginary * pair.undamped) / (z - pair.value));
        return phase;
    }

  private:
    const PlanarDamped &_rotor;
    double _speed;
    Sparse _Q;
    Eigen::VectorXcd _D, _K;
    Eigen::VectorXd _absM, _absD, _absK;
    linalg::SymmetricFactor _static; ///< of Q(0)

    /// A vector times the three matrices, and x^T A x of each.
    struct Products {
        Eigen::VectorXcd M, D, K;
        Complex xMx, xDx, xKx;

        /// x^T Q(l) x = 0 at the l nearest the one given.
        [[nodiscard]] Complex rayleigh(Complex near) const {
            const Complex root = std::sqrt(xDx * xDx - 4.0 * xMx * xKx);
            // Both without cancellation.
            const Complex q = -(xDx + (std::real(std::conj(xDx) * root) >= 0 ? root : -root)) / 2.0;
            const Complex first = q / xMx;
            const Complex second = xKx / q;
            return std::abs(first - near) <= std::abs(second - near) ? first : second;
        }
        /// Q'(l) x
        [[nodiscard]] Eigen::VectorXcd slope(Complex l) const { return (2.0 * l) * M + D; }
    };

    [[nodiscard]] Products products(const Eigen::VectorXcd &x) const {
        const Eigen::Index n = x.size();
        Products of{Eigen::VectorXcd(n), Eigen::VectorXcd(n), Eigen::VectorXcd(n), 0, 0, 0};
        const int *start = _Q.outerIndexPtr();
        const int *rows = _Q.innerIndexPtr();
        const double *M = _rotor._M.data();
        const Complex *D = _D.data();
        const Complex *K = _K.data();
        const Complex *in = x.data();
        for (Eigen::Index j = 0; j < n; ++j) {
            double mr = 0;
            double mi = 0;
            double dr = 0;
            double di = 0;
            double kr = 0;
            double ki = 0;
            for (int p = start[j]; p < start[j + 1]; ++p) {
                const double re = in[rows[p]].real();
                const double im = in[rows[p]].imag();
                mr += M[p] * re;
                mi += M[p] * im;
                dr += D[p].real() * re - D[p].imag() * im;
                di += D[p].real() * im + D[p].imag() * re;
                kr += K[p].real() * re - K[p].imag() * im;
                ki += K[p].real() * im + K[p].imag() * re;
            }
            of.M(j) = {mr, mi};
            of.D(j) = {dr, di};
            of.K(j) = {kr, ki};
        }
        of.xMx = x.cwiseProduct(of.M).sum();
        of.xDx = x.cwiseProduct(of.D).sum();
        of.xKx = x.cwiseProduct(of.K).sum();
        return of;
    }

    void set(Complex l) {
        const Complex square = l * l;
        const double *M = _rotor._M.data();
        const Complex *D = _D.data();
        const Complex *K = _K.data();
        Complex *Q = _Q.valuePtr();
        for (Eigen::Index p = 0; p < _D.size(); ++p)
            Q[p] = {square.real() * M[p] + l.real() * D[p].real() - l.imag() * D[p].imag() +
                        K[p].real(),
                    square.imag() * M[p] + l.real() * D[p].imag() + l.imag() * D[p].real() +
                        K[p].imag()};
    }

    void factorize(Complex l) {
        set(l);
        try {
            _rotor._factor->factorize(_Q);
        } catch (const linalg::SolverError &) { // on the eigenvalue itself
            set(l * (1 + 1e-14));
            _rotor._factor->factorize(_Q);
        }
    }

    void assess(Pair &pair, const Products &of) const {
        const Complex l = pair.value;
        const double scale = std::abs(l) * _static.solve(of.slope(l)).norm();
        const Eigen::VectorXcd r = (l * l) * of.M + l * of.D + of.K;
        pair.residual = scale > 0 ? _static.solve(r).norm() / scale : 0;
        const double derivative = std::abs(l * (2.0 * l * of.xMx + of.xDx));
        const double entries = absolute_form(std::abs(l), pair.vector.cwiseAbs());
        pair.rounding =
            derivative > 0 ? std::numeric_limits<double>::epsilon() * entries / derivative : 0;
    }

    /// |x|^T (|K| + |l| |D| + |l|^2 |M|) |x|
    [[nodiscard]] double absolute_form(double size, const Eigen::VectorXd &x) const {
        double sum = 0;
        for (Eigen::Index j = 0; j < x.size(); ++j) {
            double column = 0;
            for (int p = _Q.outerIndexPtr()[j]; p < _Q.outerIndexPtr()[j + 1]; ++p)
                column +=
                    (_absK(p) + size * (_absD(p) + size * _absM(p))) * x(_Q.innerIndexPtr()[p]);
            sum += x(j) * column;
        }
        return sum;
    }
};

PlanarDamped::PlanarDamped(const assembly::Discretization &discretization, double bearing_speed)
    : _discretization(discretization), _bearing_speed(bearing_speed) {
    const assembly::DampedPlanarSystem system =
        assembly::assemble_damped_planar(discretization, bearing_speed);
    Eigen::SparseMatrix<double> all(system.M.size(), system.M.size());
    all.setIdentity();
    for (const linalg::Matrix *A :
         {&system.M, &system.C, &system.Cx, &system.G, &system.K, &system.Kx, &system.Kc})
        all += Eigen::SparseMatrix<double>(A->view()).cwiseAbs();
    all += Eigen::SparseMatrix<double>(all.transpose());
    all.prune(0.0); // hierarchical functions hardly couple
    _pattern = all.cast<Complex>();
    _pattern.makeCompressed();
    for (const auto &[values, A] :
         {std::pair(&_M, &system.M), std::pair(&_C, &system.C), std::pair(&_Cx, &system.Cx),
          std::pair(&_G, &system.G), std::pair(&_K, &system.K), std::pair(&_Kx, &system.Kx),
          std::pair(&_Kc, &system.Kc)})
        *values = values_on(_pattern, *A);
    _factor = std::make_unique<linalg::SymmetricFactor>(_pattern);
    // Free motions are decided by the constraints, not by pivots.
    if (zero_modes(discretization, results::Form::planar, bearing_speed, 0).eigenvalues != 0)
        return;
    try {
        _undamped = std::make_unique<linalg::DefinitePencil>(system.K, system.M, system.G);
    } catch (const linalg::SolverError &) {
        _undamped.reset(); // a bearing pushes away, or something that moves has no mass
    }
}

/// Eigenvalues from those of the undamped rotor, by modulus; false where one does not settle or two
/// become one.
bool PlanarDamped::refined(AtSpeed &problem, int ask, std::vector<Pair> &pairs) const {
    for (Pair &pair : pairs)
        if (!problem.refine(pair))
            return false;
    std::sort(pairs.begin(), pairs.end(),
              [](const Pair &a, const Pair &b) { return std::abs(a.value) < std::abs(b.value); });
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t j = i + 1; j < pairs.size(); ++j)
            if (std::abs(pairs[i].value - pairs[j].value) < 1e-7 * std::abs(pairs[i].value) &&
                parallel(pairs[i].vector, pairs[j].vector))
                return false;
    return static_cast<int>(pairs.size()) >= ask;
}

/// Radius about 0 between the `wanted`th and the last of the pairs in which none is missing; 0
/// where some are.
double PlanarDamped::complete_radius(AtSpeed &problem, const std::vector<Pair> &pairs, int wanted) {
    double radius = 0;
    double widest = 1;
    for (auto i = static_cast<std::size_t>(wanted); i < pairs.size(); ++i) {
        const double inner = std::abs(pairs[i - 1].value);
        const double outer = std::abs(pairs[i].value);
        if (outer > widest * inner) {
            widest = outer / inner;
            radius = std::sqrt(outer * inner);
        }
    }
    if (radius == 0)
        return 0;
    // What is left turns slowly around the circles.
    std::vector<double> undamped;
    for (const Pair &pair : pairs)
        undamped.push_back(std::abs(pair.undamped));
    const double known =
        circle_of_known(undamped, *std::max_element(undamped.begin(), undamped.end()), radius);
    const auto phases = [&](const std::vector<double> &angles) {
        std::vector<double> out;
        out.reserve(angles.size());
        for (const double angle : angles)
            out.push_back(
                problem.phase(std::polar(radius, angle), std::polar(known, angle), pairs));
        return out;
    };
    const auto turned = winding(phases, {0.1, 2 * std::numbers::pi, 24, true});
    return turned && std::abs(*turned) < 1 ? radius : 0;
}

GeneralSpectrum::Modes PlanarDamped::modes(double speed, int wanted) const {
    constexpr int beyond = 4; ///< more eigenvalues than wanted, to place the circle among
    constexpr int most_failures = 2;
    const auto all = static_cast<int>(2 * _pattern.rows());
    if (!_undamped || _failures >= most_failures)
        return of_real_form(speed, wanted);
    AtSpeed problem(*this, speed);
    for (int ask = std::min(all, wanted + beyond);;) {
        std::vector<Pair> pairs;
        for (const linalg::RealPair &pair : _undamped->smallest(speed, ask))
            pairs.push_back({pair.value, {0, pair.value}, pair.vector.cast<Complex>(), 0, 0});
        double radius = 0;
        try {
            const bool settled = refined(problem, ask, pairs);
            if (settled && static_cast<int>(pairs.size()) == all)
                radius = std::numeric_limits<double>::infinity();
            else if (settled)
                radius = complete_radius(problem, pairs, std::min(wanted, ask - 1));
        } catch (const linalg::SolverError &) {
            radius = 0; // a pivot that happens to be zero
        }
        if (radius == 0) {
            ++_failures;
            return of_real_form(speed, wanted);
        }
        GeneralSpectrum::Modes out;
        out.complete_radius = radius;
        for (const Pair &pair : pairs)
            if (std::abs(pair.value) < radius)
                take(pair.value, pair.vector, pair.residual, pair.rounding, speed, out);
        if (static_cast<int>(out.modes.size()) >= wanted || ask == all)
            return out;
        ask = std::min(all, ask + std::max(beyond, wanted - static_cast<int>(out.modes.size())));
    }
}

/// Of a mode (x, y) of the real form, x + i y whirls with exp(l t) and the conjugate of x - i y
/// with exp(conj(l) t). Both are there where two directions share an eigenvalue, as at rest; then
/// each of the modes stands for one of them.
GeneralSpectrum::Modes PlanarDamped::of_real_form(double speed, int wanted) const {
    if (!_general)
        _general = std::make_unique<GeneralSpectrum>(_discretization, _bearing_speed);
    GeneralSpectrum::Modes found = _general->modes(speed, wanted);
    std::vector<WhirlMode> planar;
    for (WhirlMode &mode : found.modes) {
        const assembly::Planes planes(mode.shape);
        const Eigen::VectorXcd with = planes.towards();
        const Eigen::VectorXcd against = planes.against().conjugate();
        const auto taken = [&](const Eigen::VectorXcd &w, Complex value) {
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
