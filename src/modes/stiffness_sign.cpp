#include "modes/stiffness_sign.h"

#include "assembly/system.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace whirl::modes {

namespace {

/// Least eigenvalue of the symmetric part.
double least(const Eigen::Matrix2d &k) {
    const double coupling = (k(0, 1) + k(1, 0)) / 2;
    return k.trace() / 2 - std::hypot((k(0, 0) - k(1, 1)) / 2, coupling);
}

bool positive_at(const assembly::Discretization &d, double speed) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, speed);
    const Eigen::SparseMatrix<double> K = system.K.view();
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(K);
    return factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 0;
}

} // namespace

bool stiffness_positive(const model::Rotor &rotor, int order) {
    const assembly::Discretization d(rotor, order);
    if (!positive_at(d, 0))
        return false;
    return std::all_of(rotor.bearings.begin(), rotor.bearings.end(), [&](const auto &bearing) {
        return std::all_of(bearing.speeds.begin(), bearing.speeds.end(),
                           [&](double speed) { return positive_at(d, speed); });
    });
}

bool may_push_away(const model::Rotor &rotor) {
    const bool presses = rotor.shaft.axial_force < 0;
    return presses || std::any_of(rotor.bearings.begin(), rotor.bearings.end(), [](const auto &b) {
               return std::any_of(b.rows.begin(), b.rows.end(), [](const auto &row) {
                   // A share for the rounding of entries that were turned into other axes.
                   const auto negative = [](const Eigen::Matrix2d &k) {
                       return least(k) < -1e-14 * k.cwiseAbs().maxCoeff();
                   };
                   return negative(row.k) || negative(row.kt);
               });
           });
}

} // namespace whirl::modes
