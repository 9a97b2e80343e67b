#include "modes/roots/reduced_form.h"

#include "assembly/planes.h"
#include "linalg/dense/complex_factors.h"
#include "linalg/dense/products.h"
#include "modes/roots/iteration.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace whirl::modes {

namespace {

using Part = FormMatrices::Part;
using Complex = std::complex<double>;
using Vector = Eigen::VectorXcd;

// Products with real matrices take half as many multiplications.
Vector product(const Eigen::MatrixXd &A, const Vector &x) {
    Vector out(A.rows());
    out.real() = A * x.real();
    out.imag() = A * x.imag();
    return out;
}
Vector product(const Eigen::MatrixXcd &A, const Vector &x) { return linalg::times(A, x); }
Vector adjoint_product(const Eigen::MatrixXd &A, const Vector &x) {
    Vector out(A.cols());
    out.real() = A.transpose() * x.real();
    out.imag() = A.transpose() * x.imag();
    return out;
}
Vector adjoint_product(const Eigen::MatrixXcd &A, const Vector &x) { return A.adjoint() * x; }

/// l^2 M + l D + K
template <class Scalar> Eigen::MatrixXcd value_at(const DenseQuadratic<Scalar> &p, Complex l) {
    Eigen::MatrixXcd out(p.M.rows(), p.M.cols());
    const Complex squared = l * l;
    for (Eigen::Index k = 0; k < out.size(); ++k) {
        const Scalar m = p.M.data()[k];
        const Scalar d = p.D.data()[k];
        const Scalar e = p.K.data()[k];
        if constexpr (std::is_same_v<Scalar, double>)
            out.data()[k] = {squared.real() * m + l.real() * d + e,
                             squared.imag() * m + l.imag() * d};
        else
            out.data()[k] = {squared.real() * m.real() - squared.imag() * m.imag() +
                                 l.real() * d.real() - l.imag() * d.imag() + e.real(),
                             squared.real() * m.imag() + squared.imag() * m.real() +
                                 l.real() * d.imag() + l.imag() * d.real() + e.imag()};
    }
    return out;
}
} // namespace

ReducedForm::ReducedForm(const FormMatrices &whole, std::vector<Eigen::MatrixXd> shapes)
    : _whole(whole), _shapes(std::move(shapes)), _planes(results::is_planar(whole.form()) ? 1 : 2),
      _M(projected(whole.mass())), _real(projected(Part::real)),
      _imaginary(projected(Part::imaginary)) {}

ReducedForm::Terms ReducedForm::projected(Part part) const {
    const FormMatrices::Terms terms = _whole.terms(part);
    return {projected(*terms.D), projected(*terms.Ds), projected(*terms.K), projected(*terms.Ks)};
}

Eigen::Block<Eigen::MatrixXd> ReducedForm::between(Eigen::MatrixXd &A, Eigen::Index row,
                                                   Eigen::Index column) const {
    const auto first = [this](Eigen::Index plane) { return plane == 0 ? 0 : _shapes[0].cols(); };
    const auto shapes = [this](Eigen::Index p) {
        return _shapes[static_cast<std::size_t>(p)].cols();
    };
    return A.block(first(row), first(column), shapes(row), shapes(column));
}

/// Zero of a matrix that has no entries.
Eigen::MatrixXd ReducedForm::projected(const FormMatrices::Sparse &A) const {
    Eigen::Index size = is_whole() ? _whole.size() : 0;
    for (const Eigen::MatrixXd &of : _shapes)
        size += of.cols();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
    if (A.nonZeros() == 0)
        return out;
    if (is_whole())
        return A;
    const Eigen::Index n = _shapes.front().rows();
    for (int column = 0; column < _planes; ++column) { // A by the columns of one plane
        const Eigen::MatrixXd &shapes = _shapes[static_cast<std::size_t>(column)];
        Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(A.rows(), shapes.cols());
        for (Eigen::Index j = 0; j < n; ++j)
            for (FormMatrices::Sparse::InnerIterator entry(A, _planes * j + column); entry; ++entry)
                forces.row(entry.row()) += entry.value() * shapes.row(j);
        for (int row = 0; row < _planes; ++row) {
            const Eigen::MatrixXd of_row = forces(Eigen::seqN(row, n, _planes), Eigen::all);
            between(out, row, column) =
                linalg::transposed_times(_shapes[static_cast<std::size_t>(row)], of_row);
        }
    }
    return out;
}

void ReducedForm::add_few(const FormMatrices::Sparse &A, double factor,
                          Eigen::MatrixXd &out) const {
    for (Eigen::Index j = 0; j < A.outerSize(); ++j)
        for (FormMatrices::Sparse::InnerIterator entry(A, j); entry; ++entry) {
            if (is_whole()) {
                out(entry.row(), j) += factor * entry.value();
                continue;
            }
            const Eigen::Index row = entry.row() % _planes;
            const Eigen::Index column = j % _planes;
            const Eigen::RowVectorXd across =
                factor * entry.value() * _shapes[static_cast<std::size_t>(column)].row(j / _planes);
            between(out, row, column) +=
                _shapes[static_cast<std::size_t>(row)].row(entry.row() / _planes).transpose() *
                across;
        }
}

DenseQuadratic<double> ReducedForm::at(double speed, Part part) const {
    const Terms &terms = part == Part::real ? _real : _imaginary;
    DenseQuadratic<double> out{_M, terms.D + speed * terms.Ds, terms.K + speed * terms.Ks, {}, {}};
    if (_whole.discretization().rotor().bearings_depend_on_speed()) {
        const FormMatrices::Supports now = _whole.support_change(0, speed, part);
        add_few(now.D, 1, out.D);
        add_few(now.K, 1, out.K);
    }
    return out;
}

template <class Scalar> DenseQuadratic<Scalar> ReducedForm::at(double speed) const {
    if constexpr (std::is_same_v<Scalar, double>) {
        return at(speed, Part::real);
    } else {
        const DenseQuadratic<double> re = at(speed, Part::real);
        const DenseQuadratic<double> im = at(speed, Part::imaginary);
        const auto joined = [](const Eigen::MatrixXd &a, const Eigen::MatrixXd &b) {
            Eigen::MatrixXcd out(a.rows(), a.cols());
            out.real() = a;
            out.imag() = b;
            return out;
        };
        return {re.M.cast<Scalar>(), joined(re.D, im.D), joined(re.K, im.K), {}, {}};
    }
}

template DenseQuadratic<double> ReducedForm::at(double) const;
template DenseQuadratic<std::complex<double>> ReducedForm::at(double) const;

ModeBasis ReducedForm::basis(double speed, const Eigen::VectorXcd &values,
                             const Eigen::MatrixXcd &right, const Eigen::MatrixXcd &left) const {
    const std::complex<double> i(0, 1);
    const bool tables = _whole.discretization().rotor().bearings_depend_on_speed();
    DenseQuadraticAt out;
    out.M = _M.cast<std::complex<double>>();
    out.smooth = !tables;
    out.K = Eigen::MatrixXcd::Zero(_M.rows(), _M.cols());
    for (Eigen::MatrixXcd *A : {&out.below.D, &out.below.K, &out.above.D, &out.above.K})
        *A = out.K;
    const auto add = [&](Part part, std::complex<double> factor) {
        const Terms &terms = part == Part::real ? _real : _imaginary;
        const FormMatrices::SupportRates change =
            tables ? _whole.support_rates(speed, part) : FormMatrices::SupportRates{};
        out.K += factor * at(speed, part).K;
        for (const auto &[rates, of] :
             {std::pair(&out.below, &change.below), std::pair(&out.above, &change.above)}) {
            Eigen::MatrixXd D = terms.Ds;
            Eigen::MatrixXd K = terms.Ks;
            if (*of) {
                add_few((*of)->D, 1, D);
                add_few((*of)->K, 1, K);
            }
            rates->D += factor * D;
            rates->K += factor * K;
        }
    };
    add(Part::real, 1);
    if (_planes == 1)
        add(Part::imaginary, i);
    return basis_of(out, values, right, left);
}

Eigen::VectorXcd ReducedForm::lifted(const Eigen::VectorXcd &reduced) const {
    if (is_whole())
        return reduced;
    const auto plane = [](const Eigen::MatrixXd &shapes, const Eigen::VectorXcd &q) {
        Eigen::VectorXcd out(shapes.rows());
        out.real() = shapes * q.real();
        out.imag() = shapes * q.imag();
        return out;
    };
    if (_planes == 1)
        return plane(_shapes[0], reduced);
    return assembly::in_pairs(plane(_shapes[0], reduced.head(_shapes[0].cols())),
                              plane(_shapes[1], reduced.tail(_shapes[1].cols())));
}

Eigen::VectorXcd ReducedForm::mirrored(const Eigen::VectorXcd &right) const {
    Eigen::VectorXcd out = right.conjugate();
    if (_planes == 2)
        out.tail(_shapes[1].cols()) *= -1;
    return out;
}

template <class Scalar>
std::optional<Root> ReducedForm::iterated(const DenseQuadratic<Scalar> &p, Root guess) const {
    constexpr int most = 3;   // shifts
    constexpr int solves = 3; // with one shift, at most
    /// What vectors may still turn: an eigenvalue is off by the product of both. The correction on
    /// the whole rotor does not see it, but only what the shapes leave out.
    constexpr double near = 1e-5;
    constexpr double slow = 0.1;    // another shift is better
    constexpr double offset = 1e-8; // of |l|, as for the whole rotor
    constexpr double axis = 1e-6;   // of |l|
    const bool mirror = _whole.mirrored();
    Vector x = guess.right.normalized();
    Vector y = mirror ? mirrored(x) : Vector(guess.left.normalized());
    Complex l = guess.value;
    linalg::ComplexFactors factors;
    Vector Mx = product(p.M, x);
    Vector Dx = product(p.D, x);
    for (int shift = 0; shift < most; ++shift) {
        l = next_root(y.dot(Mx), y.dot(Dx), y.dot(product(p.K, x)), l);
        if (!(std::abs(l - guess.value) < 0.5 * std::abs(guess.value)) ||
            !factors.factorize(value_at(p, l * (1 + offset))))
            return std::nullopt;
        double turn = 1;
        for (int solve = 0; solve < solves && !(turn <= near); ++solve) {
            const Vector new_x = factors.solution(2.0 * l * Mx + Dx).normalized();
            turn = turned(x, new_x);
            x = new_x;
            if (mirror) {
                y = mirrored(x);
            } else {
                const Vector new_y =
                    factors
                        .adjoint_solution(2.0 * std::conj(l) * adjoint_product(p.M, y) +
                                          adjoint_product(p.D, y))
                        .normalized();
                turn = std::max(turned(y, new_y), turn);
                y = new_y;
            }
            if (!x.allFinite() || !y.allFinite())
                return std::nullopt;
            Mx = product(p.M, x);
            Dx = product(p.D, x);
            if (!(turn <= slow))
                break;
        }
        if (!(turn <= near))
            continue;
        // A pair may have met on the real axis on the way.
        const auto on_axis = [](Complex of) { return std::abs(of.imag()) <= axis * std::abs(of); };
        if (std::is_same_v<Scalar, double> && on_axis(l) != on_axis(guess.value))
            return std::nullopt;
        guess.value = l;
        guess.slope = 2.0 * l * y.dot(Mx) + y.dot(Dx);
        guess.right = std::move(x);
        guess.left = std::move(y);
        return guess;
    }
    return std::nullopt;
}

template std::optional<Root> ReducedForm::iterated(const DenseQuadratic<double> &, Root) const;
template std::optional<Root> ReducedForm::iterated(const DenseQuadratic<Complex> &, Root) const;

} // namespace whirl::modes
