#include "analyses/show.h"
#include "closed_form/composite_rotor_scales.h"
#include "results/show.h"
#include "support/balancer_parts.h"
#include "support/random.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>

namespace show_balancers_test {

using namespace whirl;
using std::numbers::pi;

// Sums of a few products in double precision.
constexpr double rounding = 1e-13;

model::Balancer balls(double z, int n, double mass, double imbalance) {
    model::Balancer balancer;
    balancer.z = z;
    tests::row(balancer).n = n;
    tests::row(balancer).mass = mass;
    tests::row(balancer).radius = 0.2;
    tests::row(balancer).damping = 3;
    balancer.imbalance = imbalance;
    balancer.imbalance_radius = 0.2;
    return balancer;
}

/// Gorbenko's base set on two equal bearings 0.7 m apart.
model::Case base_set() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.9, 0.08, tests::weightless_steel());
    scene.rotor.discs = {tests::disc_at(0.4, 57.83, 0.413, 0.289)};
    scene.rotor.bearings = {tests::isotropic_bearing(0.1, 2e6, 500),
                            tests::isotropic_bearing(0.8, 2e6, 500)};
    scene.rotor.balancers = {balls(0.5, 2, 2, 0.4)};
    return scene;
}

/// Inertia tensor and centre of mass of discs and points, added up in three dimensions.
class Body {
  public:
    void add_disc(const model::Disc &disc) {
        _mass += disc.mass;
        _first += disc.mass * Eigen::Vector3d(0, 0, disc.z);
        _origin += Eigen::Vector3d(disc.Id, disc.Id, disc.Ip).asDiagonal();
        _origin += disc.mass * disc.z * disc.z * Eigen::Vector3d(1, 1, 0).asDiagonal();
    }
    void add_point(double mass, double radius, double angle, double z) {
        const Eigen::Vector3d r(radius * std::cos(angle), radius * std::sin(angle), z);
        _mass += mass;
        _first += mass * r;
        _origin += mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    }
    void add_tensor(const Eigen::Matrix2d &diametral) {
        _origin.topLeftCorner<2, 2>() += diametral;
    }
    [[nodiscard]] double mass() const { return _mass; }
    [[nodiscard]] Eigen::Vector3d center() const { return _first / _mass; }
    [[nodiscard]] Eigen::Matrix3d about_center() const {
        const Eigen::Vector3d c = center();
        return _origin -
               _mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
    }

  private:
    double _mass = 0;
    Eigen::Vector3d _first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d _origin = Eigen::Matrix3d::Zero();
};

/// @returns principal axes across the shaft, of the smaller inertia first
Eigen::Matrix2d expect_inertia_of(const Body &body, const results::ShowResult &result) {
    const Eigen::Matrix3d inertia = body.about_center();
    EXPECT_NEAR(result.mass / body.mass(), 1, rounding);
    EXPECT_NEAR(result.center_of_mass / body.center().z(), 1, rounding);
    EXPECT_NEAR(result.Ip / inertia(2, 2), 1, rounding);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(
        Eigen::MatrixXd(inertia.topLeftCorner<2, 2>()));
    const Eigen::Vector2d values = principal.eigenvalues();
    EXPECT_NEAR(result.Id / values.mean(), 1, rounding);
    EXPECT_NEAR(result.dI.value(), (values[1] - values[0]) / 2, rounding);
    return principal.eigenvectors();
}

TEST(ShowBalancers, composite_rotor_is_the_body_of_its_points) {
    model::Case scene = base_set();
    scene.rotor.balancers.push_back(balls(0.75, 4, 0.5, 0.2)); // E = 2
    // Balanced without symmetry: two balls anywhere, the other two close the sum -n/E = -2.
    auto &position = scene.rotor.balancers[1].position;
    const std::complex<double> rest = -2.0 - std::polar(1.0, 2.0) - std::polar(1.0, 3.5);
    const double opening = std::acos(std::abs(rest) / 2);
    position = {2.0, 3.5, std::arg(rest) + opening, std::arg(rest) - opening};
    scene.rotor.anisotropies = {{"", 0.4, 0.02, 0.3}};

    Body body;
    body.add_disc(scene.rotor.discs[0]);
    for (const double angle : {0.0, 2 * pi / 3, -2 * pi / 3}) // imbalance and two balls at E = 2
        body.add_point(2, 0.2, angle, 0.5);
    body.add_point(1, 0.2, 0, 0.75);
    for (const double angle : position)
        body.add_point(0.5, 0.2, angle, 0.75);
    const Eigen::Vector2d smaller(std::cos(0.3), std::sin(0.3));
    body.add_tensor(0.02 * (Eigen::Matrix2d::Identity() - 2 * smaller * smaller.transpose()));

    const results::ShowResult result = analyses::show(scene);
    ASSERT_LT(body.center().head<2>().norm(), 1e-15) << "the positions balance";
    const Eigen::Matrix2d principal = expect_inertia_of(body, result);
    const Eigen::Vector2d axis(std::cos(*result.dI_angle), std::sin(*result.dI_angle));
    EXPECT_NEAR(std::abs(axis.dot(principal.col(0))), 1, rounding);
}

TEST(ShowBalancers, drawn_composite_rotors_are_the_bodies_of_their_points) {
    tests::Random random(3216);
    for (int drawn = 0; drawn < 24;) {
        model::Case scene = base_set();
        const int n = 2 + static_cast<int>(random(0, 5));
        const double E = random(1.05, 2.5);
        const double imbalance = random(0.1, 0.6);
        const double z = random(0.2, 0.8);
        const double ball = E * imbalance / (n * 0.2);
        scene.rotor.discs = {tests::disc_at(0.4, random(30, 80), random(0.3, 1), random(0.1, 0.5))};
        scene.rotor.balancers = {balls(z, n, ball, imbalance)};
        // All but two stand anywhere, these close the sum -n/E.
        std::vector<double> position;
        std::complex<double> rest = -n / E;
        for (int k = 0; k < n - 2; ++k) {
            position.push_back(random(-pi, pi));
            rest -= std::polar(1.0, position.back());
        }
        if (std::abs(rest) > 2)
            continue;
        ++drawn;
        const double opening = std::acos(std::abs(rest) / 2);
        position.push_back(std::arg(rest) + opening);
        position.push_back(std::arg(rest) - opening);
        scene.rotor.balancers[0].position = position;
        Body body;
        body.add_disc(scene.rotor.discs[0]);
        body.add_point(imbalance / 0.2, 0.2, 0, z);
        std::complex<double> D = 0;
        for (const double angle : position) {
            body.add_point(ball, 0.2, angle, z);
            D += std::polar(1.0 / n, 2 * angle);
        }
        const results::ShowResult result = analyses::show(scene);
        expect_inertia_of(body, result);
        ASSERT_TRUE(result.balancers.at(0).D);
        EXPECT_LT(std::abs(*result.balancers[0].D - D), 1e-12); // angles of a sum that closes
        EXPECT_NEAR(result.balancers[0].E, E, 1e-12);
    }
}

TEST(ShowBalancers, paper_numbers_of_the_base_set) {
    const results::ShowResult result = analyses::show(base_set());
    const results::BalancerNumbers &balancer = result.balancers.at(0);
    const double half_digit = 0.0005; // three decimals are printed
    EXPECT_NEAR(balancer.E, 2, rounding);
    EXPECT_NEAR(balancer.dimensionless.m, 0.063, half_digit);
    EXPECT_NEAR(balancer.dimensionless.A_m, 0.272, half_digit);
    EXPECT_NEAR(balancer.dimensionless.A_m0, 0.136, half_digit);
    EXPECT_NEAR(balancer.dimensionless.rotor.C, 0.901, half_digit);
    EXPECT_NEAR(balancer.bare.Ip / balancer.bare.Id, 0.7, half_digit);
    EXPECT_NEAR(balancer.bare.z_GA, 0.1, rounding);
    EXPECT_NEAR(balancer.D->real(), -0.5, rounding);
}

TEST(ShowBalancers, two_balls_of_capacity_two_leave_the_rotor_isotropic) {
    const results::ShowResult result = analyses::show(base_set());
    // A_m0 - A_m/2 = 0.08 - 0.08 kg m2: nothing but rounding may be left.
    EXPECT_NEAR(result.dI.value(), 0, 1e-16);
    EXPECT_NEAR(result.balancers.at(0).dA.value(), 0, 1e-16);
    EXPECT_NEAR(result.balancers.at(0).dA_interval.value().to, 0, 1e-16);
    EXPECT_NEAR(result.balancers.at(0).dimensionless.rotor.A.value(), 0, 1e-16);
    EXPECT_NEAR(result.balancers.at(0).dA_paper.value(), 0.08, rounding);
}

TEST(ShowBalancers, dimensionless_supports_of_two_equal_bearings) {
    const results::ShowResult result = analyses::show(base_set());
    const results::DimensionlessNumbers &d = result.balancers.at(0).dimensionless;
    const double span = 0.7;
    const double rho = std::sqrt(result.Id / result.mass) / span;
    closed_form::DimensionlessParameters expected;
    const double h_x = 1000 / std::sqrt(4e6 * result.mass);
    closed_form::set_equal_supports(expected, (result.center_of_mass - 0.1) / span, rho, h_x);
    EXPECT_NEAR(d.rotor.p2.value(), expected.p * expected.p, 1e-12);
    EXPECT_NEAR(d.rotor.c_y.value(), expected.c_y, 1e-12);
    EXPECT_NEAR(d.rotor.h_x.value(), h_x, rounding);
    EXPECT_NEAR(d.rotor.h_beta.value(), expected.h_beta, rounding);
    EXPECT_NEAR(d.rotor.h_y.value(), expected.h_y, rounding);
    EXPECT_NEAR(d.h_s.value(), 3 / 2.0 / std::sqrt(4e6 / result.mass), rounding);
    EXPECT_NEAR(d.z_A, (0.5 - result.center_of_mass) / (rho * span), rounding);
}

TEST(ShowBalancers, bearings_without_isotropic_coefficients_leave_the_masses) {
    model::Case scene = base_set();
    scene.rotor.bearings[1].rows[0].k(1, 1) *= 2;
    const results::ShowResult result = analyses::show(scene);
    const results::DimensionlessNumbers &d = result.balancers.at(0).dimensionless;
    EXPECT_FALSE(d.rotor.p2 || d.rotor.c_y || d.rotor.h_x || d.rotor.h_beta || d.rotor.h_y ||
                 d.h_s);
    EXPECT_NEAR(d.rotor.C, 0.901, 0.0005);
    EXPECT_TRUE(d.rotor.A);
    bool said = false;
    for (const auto &note : result.model.notes)
        said = said || note.find("bearing is not isotropic") != std::string::npos;
    EXPECT_TRUE(said);
}

TEST(ShowBalancers, three_balls_have_an_interval) {
    model::Case scene = base_set();
    scene.rotor.balancers = {balls(0.5, 3, 4.0 / 3, 0.4)}; // E = 2
    const results::BalancerNumbers balancer = analyses::show(scene).balancers.at(0);
    // Six digits of three balls at E = 2: |D| 0.25 to 0.728869, |1 + 2 D| 0.5 to 1.837117.
    EXPECT_NEAR(balancer.D_interval->from, 0.25, 1e-6);
    EXPECT_NEAR(balancer.D_interval->to, 0.728869, 1e-6);
    EXPECT_NEAR(balancer.dA_interval->from, 0.04 * 0.5, 1e-6);
    EXPECT_NEAR(balancer.dA_interval->to, 0.04 * 1.837117, 1e-6);
}

TEST(ShowBalancers, without_a_balanced_position_masses_remain) {
    model::Case scene = base_set();
    scene.rotor.balancers = {balls(0.5, 2, 1, 0.5)}; // E = 0.8
    const results::ShowResult result = analyses::show(scene);
    const results::BalancerNumbers &balancer = result.balancers.at(0);
    EXPECT_NEAR(balancer.E, 0.8, rounding);
    EXPECT_FALSE(balancer.D || balancer.dA || balancer.D_interval || balancer.curves || result.dI);
    EXPECT_FALSE(balancer.dimensionless.rotor.A);
    EXPECT_NEAR(result.mass, 57.83 + 2 + 2.5, 1e-12);
    EXPECT_FALSE(result.model.notes.empty());
}

TEST(ShowBalancers, own_eccentricity_adds_no_mass) {
    model::Case scene = base_set();
    scene.rotor.balancers[0].imbalance_radius.reset();
    const results::ShowResult result = analyses::show(scene);
    EXPECT_NEAR(result.mass, 61.83, 1e-12);
    EXPECT_NEAR(result.Ip, 0.289 + 0.16, rounding);
    EXPECT_NEAR(result.dI.value(), 0.04, rounding); // A_m |D|/2
    EXPECT_EQ(result.balancers.at(0).dimensionless.A_m0, 0);
    scene.rotor.balancers[0].imbalance = 0;
    const results::BalancerNumbers idle = analyses::show(scene).balancers.at(0);
    EXPECT_TRUE(std::isinf(idle.E));
    EXPECT_NEAR(idle.D->real(), -1, rounding);
}

TEST(ShowBalancers, pendulums_count_at_rest) {
    model::Case scene = base_set();
    model::Balancer &pendulum = scene.rotor.balancers[0];
    pendulum = {};
    pendulum.z = 0.4;
    tests::pendulums_of(pendulum).mass = 0.5;
    tests::pendulums_of(pendulum).arm = 0.12;
    tests::pendulums_of(pendulum).pivot = 0.03;
    const results::ShowResult result = analyses::show(scene);
    EXPECT_NEAR(result.mass, 59.83, 1e-12);
    EXPECT_NEAR(result.Ip, 0.289 + 4 * 0.5 * 0.15 * 0.15, rounding);
    EXPECT_NEAR(result.Id, 0.413 + 2 * 0.5 * 0.15 * 0.15, 1e-12);
    EXPECT_EQ(result.dI.value(), 0);
}

TEST(ShowBalancers, curves_are_those_of_rotors_with_scaled_masses) {
    model::Case scene = base_set();
    scene.rotor.balancers = {balls(0.5, 3, 2, 0.4)}; // E = 3
    const results::ShowResult result = analyses::show(scene);
    const results::CompositeCurves &curves = result.balancers.at(0).curves.value();
    EXPECT_EQ(curves.m.front(), 0);
    EXPECT_NEAR(curves.C.front(), 0.289 / 0.413, 1e-12);
    EXPECT_EQ(curves.A.front(), 0);
    for (const std::size_t i : {10U, 50U, 100U}) {
        // n m = 6 s, m0 = 2 s: m = 6 s/(57.83 + 8 s).
        const double s = 57.83 * curves.m[i] / (6 - 8 * curves.m[i]);
        model::Case scaled = scene;
        tests::row(scaled.rotor.balancers[0]).mass *= s;
        scaled.rotor.balancers[0].imbalance *= s;
        const results::ShowResult there = analyses::show(scaled);
        const results::BalancerNumbers &balancer = there.balancers.at(0);
        EXPECT_NEAR(balancer.dimensionless.m, curves.m[i], rounding);
        EXPECT_NEAR(balancer.dimensionless.rotor.C, curves.C[i], 1e-12);
        EXPECT_NEAR(balancer.dimensionless.A_m, curves.A_m[i], 1e-12);
        EXPECT_NEAR(balancer.dimensionless.rotor.A.value(), curves.A[i], 1e-12);
        EXPECT_NEAR(balancer.dA_paper.value() / there.Id, curves.A_paper[i], 1e-12);
        EXPECT_NEAR(balancer.dA_interval->from / there.Id, curves.A_least[i], 1e-11);
        EXPECT_NEAR(balancer.dA_interval->to / there.Id, curves.A_largest[i], 1e-11);
        EXPECT_NEAR(std::abs(curves.A_C2[i] - curves.A_C1[i]) / 2, curves.A[i], 1e-12);
        EXPECT_NEAR((curves.A_C2[i] + curves.A_C1[i]) / 2, 1, 1e-12);
    }
}

/// Gorbenko's rotor with anisotropy: A = 1, C = 0.8, p = 1.25, h = 0.156.
model::Case anisotropic_rotor() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(2, 0.01, tests::weightless_steel());
    scene.rotor.discs = {tests::disc_at(1, 10, 1, 0.8)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 0.78125, 0.078),
                            tests::isotropic_bearing(2, 0.78125, 0.078)};
    scene.rotor.anisotropies = {{"", 1, 0.1, 0}};
    return scene;
}

TEST(ShowAnisotropy, numbers_of_the_base_set) {
    const results::ShowResult result = analyses::show(anisotropic_rotor());
    const results::AnisotropyChart &chart = result.anisotropy.value();
    EXPECT_NEAR(chart.p, 1.25, 1e-12);
    EXPECT_NEAR(chart.h, 0.156, 1e-12);
    EXPECT_NEAR(chart.C, 0.8, 1e-12);
    EXPECT_NEAR(chart.anisotropy, 0.1, 1e-12);
    ASSERT_EQ(chart.critical_speeds.size(), 2U); // p/sqrt(1 - C -+ a)
    EXPECT_NEAR(chart.critical_speeds[0], 1.25 / std::sqrt(0.3), 1e-11);
    EXPECT_NEAR(chart.critical_speeds[1], 1.25 / std::sqrt(0.1), 1e-11);
    EXPECT_NEAR(chart.unstable->from, 2.381264, 1e-6);
    EXPECT_NEAR(chart.unstable->to.value(), 3.788366, 1e-6);
    EXPECT_NEAR(chart.permissible, 0.055266, 1e-6);
    EXPECT_NEAR(chart.permissible_speed.value(), 2.851144, 1e-6);
    // On the limit a4 = [p2 - (1 - C) x]^2 + h^2 x - a^2 x^2 vanishes, x the squared speed.
    for (std::size_t i = 0; i < chart.speed.size(); ++i) {
        const double x = chart.speed[i] * chart.speed[i];
        const double stiff = chart.p * chart.p - (1 - chart.C) * x;
        const double damped = stiff * stiff + chart.h * chart.h * x;
        const double a2x2 = std::pow(chart.limit[i] * x, 2);
        EXPECT_NEAR(a2x2 / damped, 1, 1e-12);
        EXPECT_NEAR(chart.undamped[i] * x, std::abs(stiff), 1e-12);
    }
}

TEST(ShowAnisotropy, anisotropies_at_right_angles_cancel) {
    model::Case scene = anisotropic_rotor();
    scene.rotor.anisotropies = {{"", 1, 0.1, 0.2}, {"", 0.3, 0.1, 0.2 + pi / 2}};
    const results::ShowResult result = analyses::show(scene);
    EXPECT_NEAR(result.dI.value(), 0, 1e-15);
    EXPECT_FALSE(result.anisotropy->unstable);
}

TEST(ShowAnisotropy, no_chart_without_symmetry) {
    model::Case shifted = anisotropic_rotor();
    shifted.rotor.discs[0].z = 1.1;
    model::Case orthotropic = anisotropic_rotor();
    orthotropic.rotor.bearings[0].rows[0].k(1, 1) *= 2;
    model::Case with_balls = anisotropic_rotor();
    with_balls.rotor.balancers = {balls(1, 2, 0.1, 0.01)};
    for (const model::Case &scene : {shifted, orthotropic, with_balls}) {
        const results::ShowResult result = analyses::show(scene);
        EXPECT_FALSE(result.anisotropy);
        bool said = false;
        for (const auto &note : result.model.notes)
            said = said || note.find("no chart") != std::string::npos;
        EXPECT_TRUE(said);
        EXPECT_TRUE(result.dI);
    }
}

} // namespace show_balancers_test
