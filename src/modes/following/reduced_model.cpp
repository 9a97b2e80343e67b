#include "modes/following/reduced_model.h"

#include "linalg/dense/blas.h"

#include <algorithm>
#include <cmath>

namespace whirl::modes {

namespace {

/// Part of a shape (of length 1) outside the space that is left out.
constexpr double negligible = 1e-8;

Eigen::MatrixXd parts_of(const Eigen::MatrixXcd &A) {
    Eigen::MatrixXd out(A.rows(), 2 * A.cols());
    out << A.real(), A.imag();
    return out;
}

/// A complex matrix, given by its parts, times another in real products.
Eigen::MatrixXcd parts_times(const Eigen::MatrixXd &parts, const Eigen::MatrixXcd &Y) {
    const Eigen::Index m = Y.cols();
    Eigen::MatrixXd both(2 * Y.rows(), 2 * m);
    both << Y.real(), Y.imag(), -Y.imag(), Y.real();
    const Eigen::MatrixXd product = linalg::product(parts, both);
    Eigen::MatrixXcd out(parts.rows(), m);
    out.real() = product.leftCols(m);
    out.imag() = product.rightCols(m);
    return out;
}

} // namespace

Eigen::MatrixXcd ReducedMatrices::times(const Eigen::MatrixXcd &Y) const {
    return parts_times(all, Y);
}

Eigen::VectorXcd ReducedMatrices::times(const Eigen::VectorXcd &y) const {
    Eigen::VectorXd parts(2 * y.size());
    parts << y.real(), -y.imag();
    Eigen::VectorXcd out(all.rows());
    out.real() = linalg::product(all, parts);
    parts << y.imag(), y.real();
    out.imag() = linalg::product(all, parts);
    return out;
}

ReducedModel::ReducedModel(const SymmetricProblem &problem)
    : _problem(problem), _basis(problem.size(), 0), _K_basis(problem.size(), 0) {}

void ReducedModel::add(const std::vector<Eigen::VectorXcd> &vectors) {
    const Eigen::Index before = size();
    for (const Eigen::VectorXcd &vector : vectors)
        append(vector.normalized());
    project(before);
    _parts = parts_of(_basis);
}

void ReducedModel::add_with_changes(double speed, const std::vector<SymmetricPair> &pairs) {
    constexpr double beside = 1e-2; // of the eigenvalue: the pair itself does not drown the others
    std::vector<Eigen::VectorXcd> shapes;
    for (const SymmetricPair &pair : pairs)
        shapes.push_back(pair.vector);
    SymmetricProblem::Products of;
    for (const SymmetricPair &pair : pairs) {
        _problem.multiply(pair.vector, speed, of);
        const Eigen::VectorXcd change =
            _problem.factorize(pair.value * (1 + beside), speed).solve(pair.value * of.D1 + of.K1);
        if (change.norm() > 0)
            shapes.push_back(change);
    }
    add(shapes);
}

/// What of a vector is outside the space (Gram and Schmidt, twice).
void ReducedModel::append(Eigen::VectorXcd x) {
    const Eigen::Index before = size();
    if (before == x.size())
        return;
    Eigen::VectorXcd Kx;
    for (int pass = 0; pass < 2; ++pass) {
        x -= _basis * (_K_basis.adjoint() * x).eval();
        // With K times what is left: a difference of such products would be rounding.
        Kx = _problem.times(SymmetricProblem::stiffness, x);
        const double square = x.dot(Kx).real();
        if (pass == 0 && !(square > negligible * negligible))
            return;
        x /= std::sqrt(square);
        Kx /= std::sqrt(square);
    }
    for (const auto &[matrix, column] : {std::pair(&_basis, &x), std::pair(&_K_basis, &Kx)}) {
        matrix->conservativeResize(Eigen::NoChange, before + 1);
        matrix->col(before) = *column;
    }
}

/// The matrices on the columns of the basis from one on.
void ReducedModel::project(Eigen::Index first) {
    const Eigen::Index further = size() - first;
    std::array<Eigen::MatrixXcd, 5> times;
    times.fill(Eigen::MatrixXcd(_problem.size(), further));
    SymmetricProblem::Products of;
    for (Eigen::Index i = 0; i < further; ++i) {
        _problem.multiply(_basis.col(first + i), 0, of);
        times[0].col(i) = of.M;
        times[1].col(i) = of.D;
        times[2].col(i) = of.K;
        times[3].col(i) = of.D1;
        times[4].col(i) = of.K1;
    }
    const std::array<Eigen::MatrixXcd *, 5> reduced{&_M, &_D, &_K, &_D1, &_K1};
    for (std::size_t k = 0; k < times.size(); ++k) {
        reduced[k]->conservativeResize(size(), size());
        reduced[k]->rightCols(further) = _basis.transpose() * times[k];
        reduced[k]->bottomLeftCorner(further, first) =
            reduced[k]->topRightCorner(first, further).transpose();
    }
    _all.resize(5 * size(), 2 * size());
    _all << parts_of(_M), parts_of(_D), parts_of(_K), parts_of(_D1), parts_of(_K1);
}

Eigen::VectorXcd ReducedModel::coordinates(const Eigen::VectorXcd &vector) const {
    return _K_basis.adjoint() * vector;
}

void ReducedModel::set_vectors(const std::vector<SymmetricPair *> &pairs) const {
    Eigen::MatrixXcd coordinates(size(), std::ssize(pairs));
    for (std::size_t i = 0; i < pairs.size(); ++i)
        coordinates.col(static_cast<Eigen::Index>(i)) = pairs[i]->reduced;
    const Eigen::MatrixXcd vectors = parts_times(_parts, coordinates);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i]->vector = vectors.col(static_cast<Eigen::Index>(i));
        const double scale = 1 / std::sqrt(pairs[i]->vector.cwiseAbs2().maxCoeff());
        pairs[i]->vector *= scale;
        pairs[i]->reduced *= scale;
    }
}

ReducedMatrices ReducedModel::at(double speed) const {
    const Eigen::Index n = size();
    ReducedMatrices out{_all.topRows(3 * n)};
    out.all.bottomRows(2 * n) += speed * _all.bottomRows(2 * n);
    return out;
}

void ReducedModel::set_rates(double speed, const std::vector<SymmetricPair *> &pairs) const {
    const Eigen::Index n = size();
    Eigen::MatrixXcd Y(n, std::ssize(pairs));
    for (std::size_t i = 0; i < pairs.size(); ++i)
        Y.col(static_cast<Eigen::Index>(i)) = pairs[i]->reduced;
    const Eigen::MatrixXcd products = parts_times(_all, Y);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const auto form = [&](Eigen::Index matrix) {
            return Y.col(column).cwiseProduct(products.col(column).segment(matrix * n, n)).sum();
        };
        const std::complex<double> l = pairs[i]->value;
        const std::complex<double> change = form(3);
        pairs[i]->rate = -(l * change + form(4)) / (2.0 * l * form(0) + form(1) + speed * change);
    }
}

} // namespace whirl::modes
