#include "modes/roots/reduced_form.h"

#include "assembly/planes.h"
#include "linalg/dense/products.h"
#include "results/formulation.h"

#include <type_traits>
#include <utility>

namespace whirl::modes {

namespace {

using Part = FormMatrices::Part;
using PlaneEntries = Eigen::Map<Eigen::MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>>;

/// The entries between amplitudes of two planes, rows and columns.
PlaneEntries between(Eigen::MatrixXd &A, int planes, Eigen::Index row, Eigen::Index column) {
    return {&A(row, column), A.rows() / planes, A.cols() / planes,
            Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>(planes * A.rows(), planes)};
}

} // namespace

ReducedForm::ReducedForm(const FormMatrices &whole, Eigen::MatrixXd shapes)
    : _whole(whole), _shapes(std::move(shapes)), _planes(results::is_planar(whole.form()) ? 1 : 2),
      _M(projected(whole.mass())), _real(projected(Part::real)),
      _imaginary(projected(Part::imaginary)) {}

ReducedForm::Terms ReducedForm::projected(Part part) const {
    const FormMatrices::Terms terms = _whole.terms(part);
    return {projected(*terms.D), projected(*terms.Ds), projected(*terms.K), projected(*terms.Ks)};
}

/// Zero of a matrix that has no entries.
Eigen::MatrixXd ReducedForm::projected(const FormMatrices::Sparse &A) const {
    const Eigen::Index size = is_whole() ? _whole.size() : _planes * _shapes.cols();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
    if (A.nonZeros() == 0)
        return out;
    if (is_whole())
        return A;
    const Eigen::Index n = _shapes.rows();
    for (int column = 0; column < _planes; ++column) { // A by the columns of one plane
        Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(A.rows(), _shapes.cols());
        for (Eigen::Index j = 0; j < n; ++j)
            for (FormMatrices::Sparse::InnerIterator entry(A, _planes * j + column); entry; ++entry)
                forces.row(entry.row()) += entry.value() * _shapes.row(j);
        for (int row = 0; row < _planes; ++row) {
            const Eigen::MatrixXd of_row = forces(Eigen::seqN(row, n, _planes), Eigen::all);
            between(out, _planes, row, column) = linalg::transposed_times(_shapes, of_row);
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
            const Eigen::RowVectorXd across = factor * entry.value() * _shapes.row(j / _planes);
            between(out, _planes, entry.row() % _planes, j % _planes) +=
                _shapes.row(entry.row() / _planes).transpose() * across;
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

Eigen::VectorXcd ReducedForm::lifted(const Eigen::VectorXcd &reduced) const {
    if (is_whole())
        return reduced;
    const auto plane = [this](const Eigen::VectorXcd &q) {
        Eigen::VectorXcd out(_shapes.rows());
        out.real() = _shapes * q.real();
        out.imag() = _shapes * q.imag();
        return out;
    };
    if (_planes == 1)
        return plane(reduced);
    const assembly::Planes both(reduced);
    return assembly::in_pairs(plane(both.x), plane(both.y));
}

} // namespace whirl::modes
