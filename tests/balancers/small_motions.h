#pragma once

#include "assembly/rotating_system.h"
#include "balancers/arrangement.h"
#include "support/rotating_rates.h"
#include "support/scenes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace whirl::tests {

using Spectrum = std::vector<std::complex<double>>;
inline double distance_to(const Spectrum &values, std::complex<double> value) {
    double nearest = HUGE_VAL;
    for (const auto other : values)
        nearest = std::min(nearest, std::abs(other - value));
    return nearest;
}

/// All eigenvalues of the rotating system with the balancers as linear elements.
inline Spectrum element_eigenvalues(const model::Case &scene,
                                    const balancers::Arrangement &arrangement) {
    const double speed = scene.speeds->from;
    const assembly::Discretization d(scene.rotor, 1);
    const assembly::RotatingSystem s =
        assembly::assemble_rotating(d, 0, balancers::balancer_elements(scene.rotor, arrangement));
    const auto n = static_cast<Eigen::Index>(s.M.size());
    // Unknowns in units of their inertia, and states (speed q, q'): rates of one size.
    const Eigen::VectorXd unit =
        Eigen::MatrixXd(s.M.view()).diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    const auto scaled = [&unit](const linalg::Matrix &matrix) -> Eigen::MatrixXd {
        return unit.asDiagonal() * Eigen::MatrixXd(matrix.view()) * unit.asDiagonal();
    };
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n) = speed * Eigen::MatrixXd::Identity(n, n);
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(scaled(s.M));
    A.bottomLeftCorner(n, n) = -factors.solve(scaled(s.stiffness(speed))) / speed;
    A.bottomRightCorner(n, n) = -factors.solve(scaled(s.damping(speed)));
    const Eigen::VectorXcd values = A.eigenvalues();
    return {values.begin(), values.end()};
}

/// A rigid rotor with its balancer away from the middle, so that it tilts.
inline model::Case tilting(model::Balancer balancer, double speed) {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(1, 0.04, weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {disc_at(0.5, 10, 0.4, 0.3)};
    scene.rotor.bearings = {isotropic_bearing(0, 5e4, 100), isotropic_bearing(1, 5e4, 100)};
    balancer.z = 0.7;
    scene.rotor.balancers = {balancer};
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.time = 20;
    return scene;
}

/// Every eigenvalue of the element is one of the linearised motion in time, but for those that
/// stand in for zeros; and the other way round, but for the motions that the rotor does not see,
/// which those of a free balancer alone are.
inline void expect_same_motions(const model::Case &scene, double tolerance, double fastest) {
    const balancers::Arrangement balanced = balancers::arrangement_at_balance(scene.rotor);
    model::Case started = scene;
    started.simulate.ball_angles = balanced;
    const RotatingRates rates(started);
    const double speed = scene.speeds->from;
    const Eigen::VectorXd still = rates.at(Eigen::VectorXd::Zero(rates.size()));
    EXPECT_LT(still.cwiseAbs().maxCoeff(), 1e-9 * speed * speed);
    Eigen::MatrixXd J = rates.jacobian();
    J.rightCols(J.cols() / 2) *= speed; // states (speed q, q')
    J.bottomRows(J.rows() / 2) /= speed;
    const Eigen::VectorXcd found = J.eigenvalues();
    const Spectrum values(found.begin(), found.end());
    const double size = found.cwiseAbs().maxCoeff();
    int compared = 0;
    double worst = 0;
    for (const auto value : element_eigenvalues(scene, balanced)) {
        if (std::abs(value) > fastest)
            continue;
        ++compared;
        worst = std::max(worst, distance_to(values, value) / size);
    }
    EXPECT_GE(compared, 14);
    EXPECT_LT(worst, tolerance) << "at " << speed;
}

} // namespace whirl::tests
