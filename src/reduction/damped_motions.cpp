#include "reduction/damped_motions.h"

#include "linalg/dense/products.h"

#include <Eigen/Eigenvalues>

namespace whirl::reduction {

Eigen::VectorXcd damped_eigenvalues(const ReducedRotor &rotor, double speed) {
    const Eigen::Index r = rotor.size();
    const ReducedRotor::Supports at = rotor.supports_at(speed);
    Eigen::MatrixXd K = at.stiffness;
    Eigen::MatrixXd C = at.damping;
    for (const Eigen::Index plane : {Eigen::Index{0}, r}) {
        K.block(plane, plane, r, r) += rotor.elastic;
        C.block(plane, plane, r, r) += rotor.internal;
    }
    K.topRightCorner(r, r) += speed * rotor.internal;
    K.bottomLeftCorner(r, r) -= speed * rotor.internal;
    C.topRightCorner(r, r) += speed * rotor.gyroscopic;
    C.bottomLeftCorner(r, r) -= speed * rotor.gyroscopic;
    if (rotor.mass_deviation.size() > 0) {
        const Eigen::MatrixXd M = Eigen::MatrixXd::Identity(2 * r, 2 * r) + rotor.mass_deviation;
        const Eigen::PartialPivLU<Eigen::MatrixXd> factors(M);
        K = linalg::solved(factors, K);
        C = linalg::solved(factors, C);
    }
    // On (w q, q') with the frequency w of each shape: a fast shape's entries are then no larger
    // than its frequency, and rounding by them is small against what slow ones lose.
    const Eigen::VectorXd w = rotor.frequencies.cwiseMax(speed).replicate(2, 1);
    Eigen::MatrixXd A(4 * r, 4 * r);
    A << Eigen::MatrixXd::Zero(2 * r, 2 * r), Eigen::MatrixXd(w.asDiagonal()),
        -K * w.cwiseInverse().asDiagonal(), -C;
    return A.eigenvalues();
}

} // namespace whirl::reduction
