// Motion in time on supports whose masses differ between x and y or couple them, against linear
// systems of four unknowns solved here, and against the steady response.

#include "analyses/response.h"
#include "analyses/simulate.h"
#include "results/response.h"
#include "support/rigid_jeffcott.h"
#include "support/test_rotors.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace support_masses_motion {

using namespace whirl;
using Complex = std::complex<double>;

/// M u'' + C u' + K u = Re(f exp(i w t)) from rest, on (x, y) of the shaft, then of the pedestals.
class FromRest {
  public:
    FromRest(const Eigen::Matrix4d &M, const Eigen::Matrix4d &C, const Eigen::Matrix4d &K,
             const Eigen::Vector4cd &f, double w)
        : _w(w) {
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(8, 8);
        A.topRightCorner(4, 4).setIdentity();
        A.bottomLeftCorner(4, 4) = -M.inverse() * K;
        A.bottomRightCorner(4, 4) = -M.inverse() * C;
        const Eigen::EigenSolver<Eigen::MatrixXd> eigen(A);
        _values = eigen.eigenvalues();
        _vectors = eigen.eigenvectors();
        Eigen::VectorXcd push = Eigen::VectorXcd::Zero(8);
        push.tail(4) = M.inverse() * f;
        _steady = (Complex(0, w) * Eigen::MatrixXcd::Identity(8, 8) - A).inverse() * push;
        _free = _vectors.partialPivLu().solve(-_steady.real().cast<Complex>());
    }
    /// Deflections of the shaft.
    [[nodiscard]] Eigen::Vector2d at(double t) const {
        const Eigen::VectorXcd shares = ((_values * t).array().exp() * _free.array()).matrix();
        const Eigen::VectorXcd all = _vectors * shares + _steady * std::polar(1.0, _w * t);
        return all.head<2>().real();
    }

  private:
    double _w;
    Eigen::VectorXcd _values, _steady, _free;
    Eigen::MatrixXcd _vectors;
};

struct Scene {
    tests::RigidJeffcott rotor;
    Eigen::Matrix2d film{{2, 0.7}, {0.4, 5}};                ///< kg, of both bearings together
    Eigen::Vector2d mass{9, 21}, k{4e6, 1.5e6}, c{300, 800}; ///< of both pedestals

    [[nodiscard]] model::Case made() const {
        model::Case out = rotor.scene();
        for (model::Bearing &bearing : out.rotor.bearings) {
            bearing.rows[0].m = film / 2;
            bearing.pedestal.emplace();
            bearing.pedestal->mass = mass / 2;
            bearing.pedestal->k = k / 2;
            bearing.pedestal->c = c / 2;
        }
        out.simulate.time = 0.4;
        out.simulate.tolerance = 1e-11;
        return out;
    }
    [[nodiscard]] FromRest expected(const Eigen::Vector4cd &f, double w) const {
        const auto coupled = [](const Eigen::Matrix2d &shaft, const Eigen::Matrix2d &between,
                                const Eigen::Vector2d &below) {
            Eigen::Matrix4d out;
            out << shaft + between, -between, -between, between;
            out.bottomRightCorner<2, 2>().diagonal() += below;
            return out;
        };
        const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
        const Eigen::Matrix2d none = Eigen::Matrix2d::Zero();
        const Eigen::Matrix2d K = Eigen::Vector2d(rotor.kx, rotor.ky).asDiagonal();
        return {coupled(rotor.mass * one, film, mass), coupled(none, rotor.c * one, c),
                coupled(none, K, k), f, w};
    }
};

void expect_motion(const results::SimulateResult &result, const FromRest &expected) {
    constexpr std::size_t disc = 1; // left end, disc, right end
    double largest = 0;
    double off = 0;
    for (std::size_t k = 0; k < result.series.time.size(); ++k) {
        const Eigen::Vector2d at = expected.at(result.series.time[k]);
        largest = std::max(largest, at.norm());
        off = std::max(
            off, std::hypot(result.series.x[disc][k] - at(0), result.series.y[disc][k] - at(1)));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(off, 1e-7 * largest); // 1e-11 a step, gathered
    EXPECT_LT(std::abs(result.audit.energy_error), 1e-7 * result.audit.energy_scale);
    EXPECT_LT(std::abs(result.audit.momentum_error), 1e-7 * result.audit.momentum_scale);
}

TEST(SupportMassesInTime, UnderAnImbalanceFromRest) {
    const Scene of;
    model::Case scene = of.made();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    scene.speeds = model::SpeedRange{210, 210, 1};
    const double force = 1e-3 * 210 * 210;
    expect_motion(analyses::simulate(scene), of.expected({force, Complex(0, -force), 0, 0}, 210));
}

TEST(SupportMassesInTime, OnAFoundationThatMoves) {
    const Scene of;
    model::Case scene = of.made();
    model::StationForce shake;
    shake.x = 3;
    shake.y = 2;
    shake.frequency = 170;
    scene.simulate.base = model::BaseMotion{shake, {}};
    scene.speeds = model::SpeedRange{100, 100, 1};
    // -a on every mass; what is in the films moves with both sides.
    const Eigen::Vector4cd f(-3 * of.rotor.mass, -2 * of.rotor.mass, -3 * of.mass(0),
                             -2 * of.mass(1));
    const results::SimulateResult result = analyses::simulate(scene);
    expect_motion(result, of.expected(f, 170));
}

/// A flexible rotor that starts in its steady motion stays there, that of `response`.
TEST(SupportMassesInTime, SteadyMotionIsTheResponse) {
    model::Case scene;
    scene.rotor = tests::rotor_on_unlike_masses();
    scene.reduction = false;
    scene.simulate.time = 0.2;
    scene.simulate.tolerance = 1e-10;
    scene.simulate.steady_start = true;
    scene.speeds = model::SpeedRange{300, 300, 1};
    const results::SimulateResult motion = analyses::simulate(scene);
    const results::ResponseResult response = analyses::unbalance_response(scene);
    for (std::size_t station = 0; station < motion.stations.size(); ++station) {
        const auto node =
            std::find_if(response.nodes.begin(), response.nodes.end(),
                         [&](const auto &n) { return n.z == motion.stations[station].z; });
        ASSERT_NE(node, response.nodes.end());
        for (std::size_t k = 0; k < motion.series.time.size(); k += 50) {
            const double turned = 300 * motion.series.time[k];
            const double size = node->major[0];
            EXPECT_NEAR(motion.series.x[station][k],
                        node->x[0] * std::cos(turned + node->x_phase[0]), 1e-6 * size);
            EXPECT_NEAR(motion.series.y[station][k],
                        node->y[0] * std::cos(turned + node->y_phase[0]), 1e-6 * size);
        }
    }
}

} // namespace support_masses_motion
