#include "rigid/projection.h"

#include "assembly/assemble.h"

#include <algorithm>
#include <map>

namespace whirl::rigid {

std::optional<RigidRotor> rigid_projection(const model::Rotor &rotor, double bearing_speed) {
    const bool pedestals = std::any_of(rotor.bearings.begin(), rotor.bearings.end(),
                                       [](const model::Bearing &b) { return b.pedestal; });
    if (pedestals || !rotor.bearings_isotropic())
        return std::nullopt;
    model::Rotor body = rotor;
    body.shaft.rigid = true;
    const assembly::Discretization d(body, 1);
    using assembly::Term;
    std::map<Term, Eigen::Matrix2d> sums; // over (w at mid-length, phi)
    for (const Term term : {Term::mass, Term::gyroscopic, Term::stiffness, Term::damping})
        sums[term] = Eigen::Matrix2d::Zero();
    assembly::assemble_rotating_parts(
        d, [&](Term term, std::span<const int> unknowns, const Eigen::MatrixXd &block) {
            for (std::size_t i = 0; i < unknowns.size(); ++i)
                for (std::size_t j = 0; j < unknowns.size(); ++j)
                    sums[term](unknowns[i], unknowns[j]) +=
                        block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        });
    assembly::assemble_supports(d, bearing_speed,
                                [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                                    sums[term](i, j) += block(0, 0);
                                });
    const Eigen::Matrix2d &M = sums[Term::mass];
    const double offset = M(0, 1) / M(0, 0); // of the centre of mass from mid-length
    Eigen::Matrix2d T;                       // (w at mid-length, phi) from (w at the centre, phi)
    T << 1, -offset, 0, 1;
    const Eigen::Matrix2d inertia = T.transpose() * M * T;
    const Eigen::Matrix2d K = T.transpose() * sums[Term::stiffness] * T;
    const Eigen::Matrix2d H = T.transpose() * sums[Term::damping] * T;
    return RigidRotor{inertia(0, 0), rotor.shaft.length() / 2 + offset,
                      inertia(1, 1), sums[Term::gyroscopic](1, 1),
                      K(0, 0),       K(0, 1),
                      K(1, 1),       H(0, 0),
                      H(0, 1),       H(1, 1)};
}

} // namespace whirl::rigid
