#include "criterion/undamped_rotor.h"

#include "assembly/system.h"
#include "linalg/semidefinite_pair.h"

#include <Eigen/Core>

#include <cmath>
#include <complex>

namespace whirl::criterion {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Entries between unknowns of different planes (`across`), or of the same one.
Sparse part_of(const Sparse &K, bool across) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < K.outerSize(); ++column)
        for (Sparse::InnerIterator it(K, column); it; ++it)
            if ((it.row() % 2 != it.col() % 2) == across && it.value() != 0)
                entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(it.col()),
                                     it.value());
    Sparse out(K.rows(), K.cols());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

struct Constraints {
    Eigen::MatrixXd rows;
    std::vector<Eigen::Index> pivots; ///< column of each row
};

/// Reduced row echelon form with full choice of the pivots; dependent rows are dropped.
/// @param scale  of each unknown: coefficients times theirs are comparable
Constraints reduced(Eigen::MatrixXd rows, const Eigen::VectorXd &scale) {
    Constraints out;
    rows = rows * scale.asDiagonal();
    const double size = rows.cwiseAbs().maxCoeff();
    Eigen::Index done = 0;
    while (done < rows.rows()) {
        Eigen::Index row = 0;
        Eigen::Index column = 0;
        const double pivot = rows.bottomRows(rows.rows() - done).cwiseAbs().maxCoeff(&row, &column);
        if (pivot <= 1e-12 * size)
            break;
        rows.row(done).swap(rows.row(done + row));
        rows.row(done) /= rows(done, column);
        for (Eigen::Index i = 0; i < rows.rows(); ++i)
            if (i != done)
                rows.row(i) -= rows(i, column) * Eigen::RowVectorXd(rows.row(done));
        out.pivots.push_back(column);
        ++done;
    }
    out.rows = rows.topRows(done);
    for (Eigen::Index i = 0; i < done; ++i)
        out.rows.row(i) *= scale(out.pivots[static_cast<std::size_t>(i)]);
    out.rows = out.rows * scale.cwiseInverse().asDiagonal();
    return out;
}

/// Columns: motions that obey the constraints, one for each unknown that is no pivot.
Sparse free_motions(const Constraints &constraints, Eigen::Index size) {
    std::vector<bool> is_pivot(static_cast<std::size_t>(size), false);
    for (const Eigen::Index pivot : constraints.pivots)
        is_pivot[static_cast<std::size_t>(pivot)] = true;
    std::vector<Eigen::Triplet<double>> entries;
    int column = 0;
    for (Eigen::Index unknown = 0; unknown < size; ++unknown) {
        if (is_pivot[static_cast<std::size_t>(unknown)])
            continue;
        entries.emplace_back(static_cast<int>(unknown), column, 1.0);
        for (std::size_t i = 0; i < constraints.pivots.size(); ++i) {
            const double value = constraints.rows(static_cast<Eigen::Index>(i), unknown);
            if (value != 0)
                entries.emplace_back(static_cast<int>(constraints.pivots[i]), column, -value);
        }
        ++column;
    }
    Sparse T(size, column);
    T.setFromTriplets(entries.begin(), entries.end());
    return T;
}

/// x = u, y = -i v: an entry k from y to x becomes -i k, one from x to y becomes i k.
Sparse imaginary_part(const Sparse &K) {
    Sparse out = part_of(K, true);
    for (int column = 0; column < out.outerSize(); ++column)
        for (Sparse::InnerIterator it(out, column); it; ++it)
            if (it.row() % 2 == 0)
                it.valueRef() = -it.value();
    return out;
}

} // namespace

UndampedRotor::UndampedRotor(const assembly::Discretization &rotor, bool planar,
                             double bearing_speed)
    : _planar(planar) {
    if (planar) {
        const assembly::PlanarSystem system = assembly::assemble_planar(rotor, bearing_speed);
        _K = system.K.view();
        _A = linalg::Matrix::sum(1, system.M, -1, system.G).view();
    } else {
        const assembly::FixedSystem system = assembly::assemble_fixed(rotor, bearing_speed);
        const linalg::Matrix S = assembly::hyperbolic_coupling(rotor);
        const Sparse K = system.K.view();
        _K = part_of(K, false);
        if (!rotor.rotor().bearings_orthotropic())
            _K_imaginary = imaginary_part(K);
        _A = linalg::Matrix::sum(1, system.M, -1, S).view();
    }
}

/// Of the rotor that can only move as the columns of T.
std::vector<double> UndampedRotor::roots(const Sparse &T, double from, double to) const {
    const Sparse K = T.transpose() * _K * T;
    const Sparse A = T.transpose() * _A * T;
    if (_K_imaginary.nonZeros() == 0)
        return linalg::SemidefinitePair(K, A).roots(from, to);
    using Complex = std::complex<double>;
    const Sparse skew = T.transpose() * _K_imaginary * T;
    const Eigen::SparseMatrix<Complex> hermitian =
        K.cast<Complex>() + Complex(0, 1) * skew.cast<Complex>();
    return linalg::HermitianPair(hermitian, A.cast<Complex>()).roots(from, to);
}

std::vector<double> UndampedRotor::critical_speeds(double from, double to) const {
    Sparse all(_K.rows(), _K.rows());
    all.setIdentity();
    return roots(all, from, to);
}

std::vector<double>
UndampedRotor::pinned_critical_speeds(const std::vector<assembly::Combination> &places, double from,
                                      double to) const {
    Eigen::MatrixXd rows =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(places.size()), _K.rows());
    for (std::size_t i = 0; i < places.size(); ++i)
        for (const auto &[unknown, value] : places[i]) {
            const auto row = static_cast<Eigen::Index>(i);
            if (_planar) {
                rows(row, unknown) += value;
            } else { // forward: (x, i y) alike
                rows(row, 2 * unknown) += value;
                rows(row, 2 * unknown + 1) += value;
            }
        }
    const Eigen::VectorXd size =
        _K.diagonal().cwiseAbs() + to * to * Eigen::VectorXd(_A.diagonal().cwiseAbs());
    const Eigen::VectorXd scale =
        size.unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
    return roots(free_motions(reduced(rows, scale), _K.rows()), from, to);
}

} // namespace whirl::criterion
