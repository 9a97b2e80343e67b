#include "analyses/balance_twin.h"

#include "assembly/system.h"
#include "linalg/semidefinite_pair.h"

#include <Eigen/Core>

#include <cmath>

namespace whirl::analyses {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Reduced row echelon form with full choice of the pivots; dependent rows are dropped.
struct Constraints {
    Eigen::MatrixXd rows;
    std::vector<Eigen::Index> pivots; ///< column of each row
};

Constraints reduced(Eigen::MatrixXd rows) {
    Constraints out;
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

void drop_coupling(Eigen::Matrix2d &a) { a(0, 1) = a(1, 0) = 0; }

void take_mean(Eigen::Matrix2d &a) {
    const double mean = a.trace() / 2;
    a = mean * Eigen::Matrix2d::Identity();
}

} // namespace

UndampedTwin::UndampedTwin(const assembly::Discretization &rotor, bool planar, double bearing_speed)
    : _planar(planar) {
    if (planar) {
        const assembly::PlanarSystem system = assembly::assemble_planar(rotor, bearing_speed);
        _K = system.K.view();
        _A = linalg::Matrix::sum(1, system.M, -1, system.G).view();
    } else {
        const assembly::FixedSystem system = assembly::assemble_fixed(rotor, bearing_speed);
        const linalg::Matrix S = assembly::hyperbolic_coupling(rotor);
        _K = system.K.view();
        _A = linalg::Matrix::sum(1, system.M, -1, S).view();
    }
}

std::vector<double> UndampedTwin::critical_speeds(double from, double to) const {
    return linalg::SemidefinitePair(_K, _A).roots(from, to);
}

std::vector<double>
UndampedTwin::pinned_critical_speeds(const std::vector<assembly::Combination> &places, double from,
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
    const Sparse T = free_motions(reduced(rows), _K.rows());
    return linalg::SemidefinitePair(T.transpose() * _K * T, T.transpose() * _A * T).roots(from, to);
}

model::Rotor without_damping(model::Rotor rotor) {
    rotor.shaft.internal_damping = 0;
    for (model::Bearing &bearing : rotor.bearings) {
        for (model::BearingCoefficients &row : bearing.rows) {
            row.c.setZero();
            row.ct.setZero();
            drop_coupling(row.k);
            drop_coupling(row.kt);
        }
        if (bearing.pedestal)
            bearing.pedestal->c = 0;
    }
    return rotor;
}

model::Rotor with_mean_bearings(model::Rotor rotor) {
    for (model::Bearing &bearing : rotor.bearings)
        for (model::BearingCoefficients &row : bearing.rows)
            for (Eigen::Matrix2d *a : {&row.k, &row.c, &row.kt, &row.ct})
                take_mean(*a);
    return rotor;
}

} // namespace whirl::analyses
