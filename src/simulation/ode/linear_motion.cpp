#include "simulation/ode/linear_motion.h"

#include <Eigen/Eigenvalues>

#include <complex>

namespace whirl::simulation {

namespace {

/// So much of the digits may be lost on the way through the eigenvectors: half of what the finest
/// tolerance leaves.
constexpr double worst_condition = 1e6;

/// The complex matrix that does to x + i y what this one (2r x 2r) does to (x; y).
std::optional<Eigen::MatrixXcd> complex_form(const Eigen::MatrixXd &real) {
    const Eigen::Index r = real.rows() / 2;
    Eigen::MatrixXcd out(r, r);
    out.real() = real.topLeftCorner(r, r);
    out.imag() = real.bottomLeftCorner(r, r);
    const double apart =
        (real.bottomRightCorner(r, r) - real.topLeftCorner(r, r)).cwiseAbs().maxCoeff() +
        (real.topRightCorner(r, r) + real.bottomLeftCorner(r, r)).cwiseAbs().maxCoeff();
    if (!(apart <= 1e-12 * real.cwiseAbs().maxCoeff()))
        return std::nullopt;
    return out;
}

} // namespace

std::optional<LinearMotion> rotor_alone(const reduction::ReducedRotor &rotor, double speed) {
    const Eigen::Index r = rotor.size();
    if (rotor.supports.size() > 1 || rotor.mass_beside.size() > 0)
        return std::nullopt;
    const auto stiffness = complex_form(rotor.supports.front().stiffness);
    const auto damping = complex_form(rotor.supports.front().damping);
    if (!stiffness || !damping)
        return std::nullopt;
    const std::complex<double> turning(0, speed);
    Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(2 * r, 2 * r);
    A.topRightCorner(r, r).setIdentity();
    A.bottomLeftCorner(r, r) = -*stiffness - rotor.elastic + turning * rotor.internal;
    A.bottomRightCorner(r, r) = -*damping - rotor.internal + turning * rotor.gyroscopic;
    A.diagonal().array() -= turning;
    // On (p, p' / |speed|), whose columns are of one size.
    Eigen::VectorXd size = Eigen::VectorXd::Ones(2 * r);
    size.tail(r).setConstant(std::abs(speed));
    A = size.cwiseInverse().asDiagonal() * A * size.asDiagonal();
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> eigen(A);
    if (eigen.info() != Eigen::Success)
        return std::nullopt;
    const Eigen::MatrixXcd &V = eigen.eigenvectors();
    // Squares of singular values: exact enough up to a condition of 1e8.
    const Eigen::MatrixXcd gram = V.adjoint() * V;
    const Eigen::VectorXd squares =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
    if (!(squares.maxCoeff() < worst_condition * worst_condition * squares.minCoeff()))
        return std::nullopt;
    return LinearMotion{eigen.eigenvalues(), size.asDiagonal() * V,
                        V.inverse() * size.cwiseInverse().asDiagonal()};
}

} // namespace whirl::simulation
