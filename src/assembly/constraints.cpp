#include "assembly/constraints.h"

#include <utility>
#include <vector>

namespace whirl::assembly {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

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

/// One column for each unknown that is no pivot.
Sparse motions_without(const Constraints &constraints, Eigen::Index size) {
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

} // namespace

Sparse constrained_motions(Eigen::MatrixXd rows, const Eigen::VectorXd &scale) {
    return motions_without(reduced(std::move(rows), scale), scale.size());
}

} // namespace whirl::assembly
