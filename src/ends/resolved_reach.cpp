#include "ends/resolved_reach.h"

#include "assembly/planar_part.h"
#include "linalg/dense/definite.h"
#include "mesh_error/safety.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace whirl::ends {

namespace {

/// Frequencies at rest, ascending, rad/s; none where neither matrix is positive definite. By the
/// inverse problem, where it can be: unknowns without mass are its zeros.
Eigen::VectorXd frequencies(const assembly::Discretization &d, const Eigen::MatrixXd *shapes,
                            double bearing_speed) {
    const assembly::PlanarPair pair = assembly::planar_pair(d, bearing_speed);
    const auto dense = [shapes](const Eigen::SparseMatrix<double> &A) {
        const Eigen::MatrixXd all(A); // of one plane, as the shapes are
        return shapes != nullptr ? Eigen::MatrixXd(shapes->transpose() * all * *shapes) : all;
    };
    const Eigen::MatrixXd K = dense(pair.K);
    const Eigen::MatrixXd M = dense(pair.M);
    if (const auto inverse = linalg::symmetric_pair_values(M, K); inverse && inverse->allFinite()) {
        const double least = 1e-14 * inverse->maxCoeff(); // below: rounding of zero
        const auto massless = (inverse->array() <= least).count();
        return inverse->tail(inverse->size() - massless).reverse().cwiseInverse().cwiseSqrt();
    }
    const auto squares = linalg::symmetric_pair_values(K, M);
    if (!squares || !squares->allFinite())
        return {};
    return squares->cwiseMax(0).cwiseSqrt();
}

} // namespace

double resolved_up_to(const assembly::Discretization &discretization, const Eigen::MatrixXd *shapes,
                      double bearing_speed) {
    constexpr double resolved = 0.01; // 1 %, as the note to users says (analyses/notes)
    if (discretization.rigid())
        return std::numeric_limits<double>::infinity();
    const assembly::Discretization finer(discretization.rotor(),
                                         mesh_error::finer_order(discretization.order()));
    const Eigen::VectorXd own = frequencies(discretization, shapes, bearing_speed);
    const Eigen::VectorXd better = frequencies(finer, nullptr, bearing_speed);
    for (Eigen::Index k = 0; k < std::min(own.size(), better.size()); ++k)
        if (mesh_error::estimate_safety * (own(k) - better(k)) > resolved * better(k))
            return k > 0 ? std::sqrt(better(k - 1) * better(k)) : 0; // amid what there is
    return std::numeric_limits<double>::infinity();
}

} // namespace whirl::ends
