// Steady states are at rest in the equations of simulate, and small motions about them are those of
// these equations, by numerical differences.

#include "simulation/motion.h"
#include "states/state_search.h"
#include "states/steady_equations.h"
#include "support/balancer_scenes.h"
#include "support/ring_scenes.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace whirl::states {
namespace {

/// Accelerations in turning axes, by the equations in time at the moment when the axes coincide.
class InTime {
  public:
    InTime(const SteadyEquations &equations, double speed)
        : _motion(equations.parts()), _speed(speed) {}

    [[nodiscard]] Eigen::VectorXd accelerations(const Eigen::VectorXd &q,
                                                const Eigen::VectorXd &rates) const {
        const Eigen::Index n = q.size();
        const Eigen::Index r = _motion.parts().rotor.size();
        Eigen::VectorXd state = Eigen::VectorXd::Zero(_motion.size());
        state << q, rates, Eigen::VectorXd::Zero(_motion.size() - 2 * n);
        state.segment(n, r) -= _speed * q.segment(r, r);
        state.segment(n + r, r) += _speed * q.head(r);
        Eigen::VectorXd out(_motion.size());
        _motion.rates(0, state.data(), out.data());
        // w'' = u'' + 2 i Omega u' - Omega^2 u
        Eigen::VectorXd a = out.segment(n, n);
        a.head(r) += 2 * _speed * rates.segment(r, r) + _speed * _speed * q.head(r);
        a.segment(r, r) += -2 * _speed * rates.head(r) + _speed * _speed * q.segment(r, r);
        return a;
    }

  private:
    simulation::RotorMotion _motion;
    double _speed;
};

struct Scene {
    const char *name;
    model::Case scene;
    double speed;
};

std::vector<Scene> scenes_to_compare() {
    std::vector<Scene> out;
    out.push_back({"two planes", tests::rodrigues_rotor(2.2, 0.01, 0.01), 2.2});
    out.push_back({"flexible", tests::flexible_rotor(150), 150});
    out.push_back({"rings", tests::ring_rotor(140), 140});
    out.push_back({"pendulums", tests::pendulum_rotor_scene(1.4, 0.3, 0.05, 0.05), 140});
    model::Case anisotropic = tests::flexible_rotor(210);
    anisotropic.rotor.anisotropies.push_back({"", 0.5, 0.004, 0.3});
    anisotropic.rotor.balancers.pop_back();
    out.push_back({"anisotropic", anisotropic, 210});
    return out;
}

TEST(SteadyEquations, StatesAreAtRestInTheEquationsInTime) {
    for (const Scene &scene : scenes_to_compare()) {
        SCOPED_TRACE(scene.name);
        const StateSearch search(scene.scene, scene.speed, scene.speed);
        const InTime in_time(search.equations(), scene.speed);
        bool undecided = false;
        const auto states = search.at(scene.speed, undecided);
        EXPECT_GT(states.size(), 1);
        for (const StateSearch::Found &found : states) {
            const Eigen::VectorXd a =
                in_time.accelerations(found.x, Eigen::VectorXd::Zero(found.x.size()));
            const Eigen::Index r = search.equations().rotor_unknowns();
            // Over those of a ball that is deflected across its radius, and of the whirl.
            const double whirl = scene.speed * scene.speed * found.x.head(r).norm();
            const double ball = scene.speed * scene.speed * 1e-2;
            const double allowed = found.state.family ? 1e-4 : 1e-9;
            EXPECT_LE(a.head(r).norm(), allowed * (whirl + 1e-3 * ball));
            EXPECT_LE(a.tail(a.size() - r).norm(), allowed * ball);
        }
    }
}

TEST(SteadyEquations, SmallMotionsAreThoseOfTheEquationsInTime) {
    for (const Scene &scene : scenes_to_compare()) {
        SCOPED_TRACE(scene.name);
        const StateSearch search(scene.scene, scene.speed, scene.speed);
        const InTime in_time(search.equations(), scene.speed);
        bool undecided = false;
        for (const StateSearch::Found &found : search.at(scene.speed, undecided)) {
            const modes::DenseQuadratic<double> m = search.equations().about(found.x, scene.speed);
            const Eigen::PartialPivLU<Eigen::MatrixXd> inertia(m.M);
            const Eigen::MatrixXd by_place = -inertia.solve(m.K);
            const Eigen::MatrixXd by_rate = -inertia.solve(m.D);
            const Eigen::Index n = found.x.size();
            const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
            Eigen::MatrixXd places(n, n);
            Eigen::MatrixXd rates(n, n);
            for (Eigen::Index i = 0; i < n; ++i) {
                // Sixth order differences; steps that are small for angles and for slopes.
                const Eigen::VectorXd step = 1e-3 * Eigen::VectorXd::Unit(n, i);
                const auto place = [&](int k) -> Eigen::VectorXd {
                    return in_time.accelerations(found.x + k * step, none) -
                           in_time.accelerations(found.x - k * step, none);
                };
                const auto rate = [&](int k) -> Eigen::VectorXd {
                    return in_time.accelerations(found.x, k * step) -
                           in_time.accelerations(found.x, -k * step);
                };
                places.col(i) = (45 * place(1) - 9 * place(2) + place(3)) / 60e-3;
                rates.col(i) = (45 * rate(1) - 9 * rate(2) + rate(3)) / 60e-3;
            }
            // In every family the matrices miss what the state itself misses of rest.
            const double allowed = found.state.family ? 1e-6 : 1e-9;
            EXPECT_LE((places - by_place).norm(), allowed * by_place.norm());
            EXPECT_LE((rates - by_rate).norm(), allowed * by_rate.norm());
            // Row by row too: angles beside stiff shapes.
            for (Eigen::Index i = 0; i < n; ++i)
                EXPECT_LE((places.row(i) - by_place.row(i)).norm(),
                          1e-6 * (by_place.row(i).norm() + 1e-6 * by_place.norm()))
                    << "row " << i;
        }
    }
}

} // namespace
} // namespace whirl::states
