#pragma once

#include "modes/roots/roots.h"
#include "states/state_search.h"
#include "support/rotating_rates.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace whirl::tests {

/// Eigenvalues about a steady state of this kind are those of differences of the motion in time,
/// whose balls count tilting too.
inline void expect_motions_in_time_about(const model::Case &scene, double speed,
                                         results::SteadyState::Kind kind) {
    const states::StateSearch search(scene, speed, speed);
    bool undecided = false;
    const auto all = search.at(speed, undecided);
    const auto state =
        std::ranges::find_if(all, [&](const auto &found) { return found.state.kind == kind; });
    ASSERT_NE(state, all.end());
    const std::vector<modes::Root> expected =
        modes::all_roots(search.equations().about(state->x, speed), speed, 0);
    model::Case started = scene;
    started.simulate.ball_angles.clear();
    for (const auto &angles : state->state.angles)
        started.simulate.ball_angles.push_back(angles);
    started.simulate.reduction_tolerance = 1e-6; // the shapes of the states
    started.simulate.time = 1;
    started.simulate.run_up = {{0, speed}, {1, speed}};
    const RotatingRates rates(started);
    const Eigen::Index r2 = search.equations().rotor_unknowns();
    Eigen::VectorXd still = Eigen::VectorXd::Zero(rates.size());
    still.head(r2) = state->x.head(r2);
    EXPECT_LT(rates.at(still).cwiseAbs().maxCoeff(), 1e-7 * speed * speed);
    constexpr double step = 1e-5;
    Eigen::MatrixXd J(rates.size(), rates.size());
    for (int i = 0; i < rates.size(); ++i) {
        const Eigen::VectorXd one = step * Eigen::VectorXd::Unit(rates.size(), i);
        J.col(i) = (rates.at(still + one) - rates.at(still - one)) / (2 * step);
    }
    const Eigen::VectorXcd found = J.eigenvalues();
    ASSERT_EQ(found.size(), std::ssize(expected));
    const double size = found.cwiseAbs().maxCoeff();
    for (const modes::Root &root : expected)
        EXPECT_LT((found.array() - root.value).abs().minCoeff(), 1e-8 * size) << root.value;
}

} // namespace whirl::tests
