#include "modes/roots/whole_pencil.h"

#include "linalg/unit_scales.h"
#include "modes/roots/iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXcd;

/// An entry is a sum of some four terms, each rounded by half an epsilon, and scaled.
constexpr double of_entries = 2 * std::numeric_limits<double>::epsilon();

// Products of complex numbers without the checks for infinities.
void add_product(double a, Complex b, Complex &sum) {
    sum = {sum.real() + a * b.real(), sum.imag() + a * b.imag()};
}
void add_product(Complex a, Complex b, Complex &sum) {
    sum = {sum.real() + a.real() * b.real() - a.imag() * b.imag(),
           sum.imag() + a.real() * b.imag() + a.imag() * b.real()};
}
double conjugate(double a) { return a; }
Complex conjugate(Complex a) { return std::conj(a); }

} // namespace

template <class Scalar>
void WholePencil<Scalar>::put(const Eigen::SparseMatrix<Scalar> &A,
                              std::vector<Scalar> &entries) const {
    entries.assign(static_cast<std::size_t>(_Q.nonZeros()), Scalar(0));
    for (int column = 0; column < A.outerSize(); ++column) {
        int place = _Q.outerIndexPtr()[column];
        for (typename Eigen::SparseMatrix<Scalar>::InnerIterator entry(A, column); entry; ++entry) {
            while (_Q.innerIndexPtr()[place] != entry.row())
                ++place;
            entries[static_cast<std::size_t>(place)] =
                _scales(entry.row()) * _scales(column) * entry.value();
        }
    }
}

template <class Scalar>
void WholePencil<Scalar>::set(const QuadraticOf<Scalar> &problem, double scale) {
    using Diagonal = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
    const Diagonal mass = problem.M.diagonal();
    const Diagonal stiffness = problem.K.diagonal();
    _scales = linalg::scales_at(scale, mass.cwiseAbs(), stiffness.cwiseAbs());
    const Eigen::SparseMatrix<Scalar> all = problem.M + problem.D + problem.K;
    _Q = all.template cast<Complex>();
    put(problem.M, _M);
    put(problem.D, _D);
    put(problem.K, _K);
}

template <class Scalar> bool WholePencil<Scalar>::factorize(Complex l) {
    const Complex squared = l * l;
    Complex *out = _Q.valuePtr();
    for (std::size_t p = 0; p < _M.size(); ++p) {
        Complex sum = _K[p];
        add_product(_M[p], squared, sum);
        add_product(_D[p], l, sum);
        out[p] = sum;
    }
    return _factors.factorize(_Q);
}

template <class Scalar> void WholePencil<Scalar>::multiply(const Vector &x, Products &out) const {
    for (Vector *part : {&out.M, &out.D, &out.K})
        part->setZero(x.size());
    for (Eigen::Index column = 0; column < x.size(); ++column) {
        const Complex factor = x(column);
        for (int p = _Q.outerIndexPtr()[column]; p < _Q.outerIndexPtr()[column + 1]; ++p) {
            const auto place = static_cast<std::size_t>(p);
            const int row = _Q.innerIndexPtr()[p];
            add_product(_M[place], factor, out.M.data()[row]);
            add_product(_D[place], factor, out.D.data()[row]);
            add_product(_K[place], factor, out.K.data()[row]);
        }
    }
}

template <class Scalar>
void WholePencil<Scalar>::multiply_adjoint(const Vector &y, Products &out) const {
    for (Vector *part : {&out.M, &out.D, &out.K})
        part->resize(y.size());
    for (Eigen::Index column = 0; column < y.size(); ++column) {
        Complex mass = 0;
        Complex damping = 0;
        Complex stiffness = 0;
        for (int p = _Q.outerIndexPtr()[column]; p < _Q.outerIndexPtr()[column + 1]; ++p) {
            const auto place = static_cast<std::size_t>(p);
            const Complex factor = y.data()[_Q.innerIndexPtr()[p]];
            add_product(conjugate(_M[place]), factor, mass);
            add_product(conjugate(_D[place]), factor, damping);
            add_product(conjugate(_K[place]), factor, stiffness);
        }
        out.M(column) = mass;
        out.D(column) = damping;
        out.K(column) = stiffness;
    }
}

/// |y|^T (|l|^2 |M| + |l| |D| + |K|) |x|.
template <class Scalar>
double WholePencil<Scalar>::entries_between(const Vector &y, double size, const Vector &x) const {
    const Eigen::VectorXd a = y.cwiseAbs2().cwiseSqrt();
    const Eigen::VectorXd b = x.cwiseAbs2().cwiseSqrt();
    double sum = 0;
    for (Eigen::Index column = 0; column < b.size(); ++column) {
        double force = 0;
        for (int p = _Q.outerIndexPtr()[column]; p < _Q.outerIndexPtr()[column + 1]; ++p) {
            const auto place = static_cast<std::size_t>(p);
            force +=
                a.data()[_Q.innerIndexPtr()[p]] *
                (size * (size * std::abs(_M[place]) + std::abs(_D[place])) + std::abs(_K[place]));
        }
        sum += force * b(column);
    }
    return sum;
}

template <class Scalar>
std::optional<WholeRoot> WholePencil<Scalar>::refined(const WholeRoot &guess) {
    /// Beside the quotient by so much: of eigenvalues that are nearer together one iteration takes
    /// all parts alike, and hardly any of others. Where that does not settle, nearer: what is left
    /// at last rounding distinguishes by chance alone.
    double offset = 1e-8;
    constexpr double nearer = 0.1;
    constexpr double enough = 1e-13; // of the value: of the order of its rounding
    constexpr int most_shifts = 8;   // cubic in the shift: a guess that needs more is none
    constexpr int solves = 3;        ///< with one shift, at most
    Vector x = _scales.cwiseInverse().asDiagonal() * guess.right;
    Vector y = _scales.cwiseInverse().asDiagonal() * guess.left;
    x.normalize();
    y.normalize();
    Products right;
    Products left;
    multiply(x, right);
    multiply_adjoint(y, left);
    Complex l = guess.value;
    for (int shifts = 0; shifts < most_shifts; ++shifts) {
        if (!factorize(l * (1 + offset)))
            return std::nullopt;
        offset *= nearer;
        const Complex shift = l;
        for (int solve = 0; solve < solves; ++solve) {
            const Vector to_right = 2.0 * l * right.M + right.D;
            const Vector to_left = 2.0 * std::conj(l) * left.M + left.D;
            const Vector new_x = _factors.solution(to_right).normalized();
            const Vector new_y = _factors.adjoint_solution(to_left).normalized();
            if (!new_x.allFinite() || !new_y.allFinite())
                return std::nullopt;
            const double right_turned = turned(x, new_x);
            const double left_turned = turned(y, new_y);
            x = new_x;
            y = new_y;
            multiply(x, right);
            multiply_adjoint(y, left);
            l = next_root(y.dot(right.M), y.dot(right.D), y.dot(right.K), shift);
            const Vector slope_x = 2.0 * l * right.M + right.D;
            const Complex slope = y.dot(slope_x);
            const Vector off = l * l * right.M + l * right.D + right.K;
            const double size = std::abs(l * slope);
            const double turn = std::max(right_turned, left_turned);
            // Angle that vectors turn in a step, rad: below it the second-order residual is
            // meaningful.
            constexpr double near = 0.02;
            constexpr double slow = 0.2; // another shift is better
            if (turn > near) {
                if (turn > slow)
                    break;
                continue;
            }
            // Of second order in what both vectors are off: Q^-1 Q x is what the right one is.
            // (Turns do not show parts along eigenvectors whose eigenvalues are about as near to
            // the shift.)
            const Vector left_off =
                std::conj(l) * std::conj(l) * left.M + std::conj(l) * left.D + left.K;
            const double residual = std::abs(left_off.dot(_factors.solution(off))) / size;
            const double rounding = of_entries * entries_between(y, std::abs(l), x) / size;
            if (residual <= std::max(enough, rounding)) {
                WholeRoot out;
                out.value = l;
                out.residual = residual;
                out.rounding = rounding;
                out.right = _scales.asDiagonal() * x;
                out.left = _scales.asDiagonal() * y;
                return out;
            }
            if (!(std::abs(l - shift) <= 0.5 * std::abs(shift)))
                return std::nullopt; // it leads away
        }
    }
    return std::nullopt;
}

template <class Scalar> Vector in_mirror(const Vector &right) {
    Vector out = right.conjugate();
    if constexpr (std::is_same_v<Scalar, double>)
        for (Eigen::Index k = 1; k < out.size(); k += 2)
            out(k) = -out(k);
    return out;
}

template Vector in_mirror<double>(const Vector &);
template Vector in_mirror<Complex>(const Vector &);

template <class Scalar>
WholeRoot WholePencil<Scalar>::corrected(const WholeRoot &guess, const Inverse &inverse,
                                         bool mirrored) const {
    const Eigen::VectorXd of_forces = _scales.cwiseInverse();
    Vector x = of_forces.asDiagonal() * guess.right;
    x.normalize();
    const Vector y =
        mirrored ? in_mirror<Scalar>(x) : Vector(of_forces.asDiagonal() * guess.left).normalized();
    Products right;
    multiply(x, right);
    WholeRoot out;
    const Complex l = next_root(y.dot(right.M), y.dot(right.D), y.dot(right.K), guess.value);
    const Complex slope = 2.0 * l * y.dot(right.M) + y.dot(right.D);
    const double size = std::abs(l * slope);
    // With Q(l + d)(x + e) = 0 and y^H Q(l) x = 0: d y^H Q'(l) x = -(Q^H y)^H e to second order.
    const Vector right_off = of_forces.asDiagonal() * (l * l * right.M + l * right.D + right.K);
    const Vector right_part = inverse(right_off);
    Vector left_off;
    Vector left_part;
    if (mirrored) {
        left_off = in_mirror<Scalar>(right_off);
        left_part = in_mirror<Scalar>(right_part);
    } else {
        Products left;
        multiply_adjoint(y, left);
        left_off = of_forces.asDiagonal() *
                   (std::conj(l) * std::conj(l) * left.M + std::conj(l) * left.D + left.K);
        left_part = inverse(left_off);
    }
    const Complex change = left_off.dot(right_part) / slope;
    out.value = l + change;
    out.residual = std::abs(l * change) > 0 ? std::abs(change) / std::abs(l) : 0;
    out.rounding = of_entries * entries_between(y, std::abs(l), x) / size;
    out.right = _scales.asDiagonal() * x - right_part;
    out.left = _scales.asDiagonal() * y - left_part;
    return out;
}

template <class Scalar> std::optional<double> WholePencil<Scalar>::determinant_phase(Complex z) {
    _factors.forget_pivots(); // those of another place may lose digits
    if (!factorize(z))
        return std::nullopt;
    return _factors.determinant_phase();
}

template class WholePencil<double>;
template class WholePencil<Complex>;

template <class Scalar>
std::optional<bool> complete_within(WholePencil<Scalar> &pencil, const Circle &circle,
                                    const std::vector<Complex> &known) {
    // Of a real problem one half of the circle is the image of the other.
    constexpr bool real = std::is_same_v<Scalar, double>;
    constexpr double length = real ? std::numbers::pi : 2 * std::numbers::pi;
    constexpr int arcs = real ? 8 : 16;
    constexpr double slow = 0.9; // an arc over which the phase turns by more is halved
    // Angle, rad: a root as near to the circle, in radii, cannot be said to lie inside.
    constexpr double shortest = 1e-5;
    constexpr double part = 0.38; // unlike parts: not both turn by a multiple of a whole turn
    constexpr int most = 400;     // factorisations: eigenvalues crowd on the circle
    int factorised = 0;
    bool lost = false;
    const auto phase = [&](double angle) {
        const Complex z = circle.centre + std::polar(circle.radius, angle);
        const std::optional<double> whole = pencil.determinant_phase(z);
        lost = lost || !whole || ++factorised > most;
        double out = whole.value_or(0);
        for (const Complex &l : known)
            out -= std::arg(z - l);
        return std::remainder(out, 2 * std::numbers::pi);
    };
    struct Arc {
        double from, to, phase_from, phase_to;
    };
    std::vector<Arc> open;
    double last = phase(0);
    for (int k = 1; k <= arcs; ++k) {
        const double to = length * k / arcs;
        const double next = phase(to);
        open.push_back({length * (k - 1) / arcs, to, last, next});
        last = next;
    }
    double sum = 0;
    const auto turn = [](double from, double to) {
        return std::remainder(to - from, 2 * std::numbers::pi);
    };
    while (!open.empty() && !lost) {
        const Arc arc = open.back();
        open.pop_back();
        const double middle = arc.from + part * (arc.to - arc.from);
        const double there = phase(middle);
        const double first = turn(arc.phase_from, there);
        const double second = turn(there, arc.phase_to);
        // Eigenvalues without end crowd where the shaft's damping brings motions to rest: together
        // they turn it by whole turns over an arc, which both parts must show as well.
        if (std::abs(first) <= slow && std::abs(second) <= slow &&
            std::abs(first + second - turn(arc.phase_from, arc.phase_to)) < 1) {
            sum += first + second;
            continue;
        }
        if (arc.to - arc.from < shortest)
            return std::nullopt;
        open.push_back({arc.from, middle, arc.phase_from, there});
        open.push_back({middle, arc.to, there, arc.phase_to});
    }
    if (lost)
        return std::nullopt;
    return std::abs(sum) < length / 4;
}

template std::optional<bool> complete_within(WholePencil<double> &, const Circle &,
                                             const std::vector<Complex> &);
template std::optional<bool> complete_within(WholePencil<Complex> &, const Circle &,
                                             const std::vector<Complex> &);

} // namespace whirl::modes
