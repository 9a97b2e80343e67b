#include "modes/stiffness_sign.h"

#include "assembly/system.h"

#include <Eigen/SparseCholesky>

#include <algorithm>

namespace whirl::modes {

namespace {

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
                   return model::pushes_away(row.k) || model::pushes_away(row.kt);
               });
           });
}

} // namespace whirl::modes
