// Balancers held in place as bodies of the rotor: against sums over points.

#include "balancers/held.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace {

using namespace whirl;
using std::numbers::pi;

/// A point of the plane of a balancer.
struct Point {
    double mass, x, y;
};

/// The second moments of points in a plane, xx, yy and xy, kg m2; their mass and moment of mass.
struct Sums {
    double mass = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

    explicit Sums(const std::vector<Point> &points) {
        for (const Point &p : points) {
            mass += p.mass;
            x += p.mass * p.x;
            y += p.mass * p.y;
            xx += p.mass * p.x * p.x;
            yy += p.mass * p.y * p.y;
            xy += p.mass * p.x * p.y;
        }
    }
};

Point at(double mass, double radius, double angle) {
    return {mass, radius * std::cos(angle), radius * std::sin(angle)};
}

/// The inertia tensor of disc and anisotropy about the diameter at an angle and about the axis, and
/// mass and moment of mass, against those of the points. Points in a plane: about the diameter at
/// b the sum of m (distance from it)^2.
void expect_body(const balancers::HeldMasses &held, const std::vector<Point> &points, double scale,
                 double tolerance = 1e-13) {
    const Sums sums(points);
    EXPECT_NEAR(held.disc.mass, sums.mass, tolerance * sums.mass);
    EXPECT_NEAR(held.disc.Ip, sums.xx + sums.yy, tolerance * (sums.xx + sums.yy));
    for (const double b : {0.0, 0.4, 1.3, 2.2}) {
        const double across = sums.xx * std::sin(b) * std::sin(b) +
                              sums.yy * std::cos(b) * std::cos(b) - sums.xy * std::sin(2 * b);
        // The axis of smaller inertia lies along arg(a)/2.
        const double about = held.disc.Id - std::real(held.anisotropy * std::polar(1.0, -2 * b));
        EXPECT_NEAR(about, across, tolerance * held.disc.Ip) << b;
    }
    EXPECT_NEAR(held.imbalance.real(), sums.x, tolerance * scale);
    EXPECT_NEAR(held.imbalance.imag(), sums.y, tolerance * scale);
}

class HeldBodies : public testing::TestWithParam<int> {
  protected:
    std::mt19937 _generator{static_cast<unsigned>(7 * GetParam() + 1)};

    double draw(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(_generator);
    }
    /// An imbalance as a point mass, among the points.
    void set_imbalance(model::Balancer &balancer, std::vector<Point> &points) {
        balancer.imbalance = draw(0.001, 0.1);
        balancer.imbalance_radius = draw(0.05, 0.3);
        balancer.imbalance_phase = draw(-pi, pi);
        points.push_back(at(balancer.imbalance / *balancer.imbalance_radius,
                            *balancer.imbalance_radius, balancer.imbalance_phase));
    }
};

TEST_P(HeldBodies, rows_of_balls_are_their_points) {
    model::Balancer balancer;
    model::Balls balls;
    balls.rows.clear();
    std::vector<Point> points;
    std::vector<double> angles;
    double scale = 0;
    for (int row = 0; row <= GetParam() % 3; ++row) {
        balls.rows.emplace_back();
        model::BallRow &own = balls.rows.back();
        own.n = 1 + (GetParam() + row) % 4;
        own.mass = draw(0.01, 2);
        own.radius = draw(0.05, 0.3);
        for (int i = 0; i < own.n; ++i) {
            angles.push_back(draw(-pi, pi));
            points.push_back(at(own.mass, own.radius, angles.back()));
            scale += own.mass * own.radius;
        }
    }
    balancer.parts = balls;
    set_imbalance(balancer, points);
    expect_body(balancers::held_masses(balancer, angles), points, scale);
}

// Each tied pair: hinges at +-a on its line, arms turned by f to opposite sides, so that both
// masses move across the line the same way, by l sin f.
TEST_P(HeldBodies, pendulums_are_their_four_points) {
    model::Balancer balancer;
    model::Pendulums pendulums;
    pendulums.mass = draw(0.1, 2);
    pendulums.arm = draw(0.05, 0.2);
    pendulums.pivot = draw(0.01, 0.1);
    balancer.parts = pendulums;
    const std::vector<double> angles{draw(-1.5, 1.5), draw(-1.5, 1.5)};
    std::vector<Point> points;
    for (const int pair : {0, 1}) {
        const Eigen::Vector2d line = pair == 0 ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
        const Eigen::Vector2d across(-line(1), line(0));
        const double f = angles[static_cast<std::size_t>(pair)];
        for (const double side : {1.0, -1.0}) {
            const Eigen::Vector2d hinge = side * pendulums.pivot * line;
            // The arm points outwards along the line, turned by side * f.
            const Eigen::Vector2d place =
                hinge + pendulums.arm * (side * std::cos(f) * line + std::sin(f) * across);
            points.push_back({pendulums.mass, place(0), place(1)});
        }
    }
    set_imbalance(balancer, points);
    expect_body(balancers::held_masses(balancer, angles), points,
                4 * pendulums.mass * pendulums.arm);
}

// A thin ring is a polygon of many points about its own centre: exact for second moments from
// three points on.
TEST_P(HeldBodies, rings_are_polygons_about_their_centres) {
    model::Balancer balancer;
    model::Rings rings;
    rings.n = 1 + GetParam() % 4;
    rings.mass = draw(0.1, 2);
    rings.journal_radius = draw(0.02, 0.1);
    rings.clearance = draw(0.001, 0.02);
    const double gyration = draw(1.1, 1.5) * rings.bore_radius();
    rings.inertia = rings.mass * gyration * gyration;
    balancer.parts = rings;
    std::vector<Point> points;
    std::vector<double> angles;
    for (int i = 0; i < rings.n; ++i) {
        angles.push_back(draw(-pi, pi));
        const Point centre = at(1, rings.clearance, angles.back());
        for (int k = 0; k < 7; ++k) {
            const Point rim = at(1, gyration, 2 * pi * k / 7);
            points.push_back({rings.mass / 7, centre.x + rim.x, centre.y + rim.y});
        }
    }
    set_imbalance(balancer, points);
    expect_body(balancers::held_masses(balancer, angles), points, rings.mass * gyration);
}

INSTANTIATE_TEST_SUITE_P(Drawn, HeldBodies, testing::Range(0, 20));

TEST(Held, equilateral_triangle_of_equal_masses_is_round) {
    model::Balancer balancer;
    balancer.imbalance = 0.4;
    balancer.imbalance_radius = 0.2;
    model::Balls balls;
    balls.rows.front().n = 2;
    balls.rows.front().mass = 2;
    balls.rows.front().radius = 0.2;
    balancer.parts = balls;
    const auto angles = balancers::held_angles(balancer, nullptr, "balancer[0]");
    const balancers::HeldMasses held = balancers::held_masses(balancer, angles);
    EXPECT_EQ(held.anisotropy, 0.0); // rounding alone: not a rotor that is not axisymmetric
    EXPECT_EQ(held.imbalance, 0.0);
    EXPECT_NEAR(held.disc.Ip, 6 * 0.04, 1e-15);
    balancer.tilt_inertia = false;
    EXPECT_EQ(balancers::held_masses(balancer, angles).disc.Ip, 0);
}

} // namespace
