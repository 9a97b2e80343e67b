// Where a mode dissipates: powers of the parts against the energy of the motion, which is made of
// the masses and stiffnesses alone, and against rotors of few unknowns written down here.

#include "modes/dissipation/dissipation.h"

#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "balancers/arrangement.h"
#include "linalg/dense/products.h"
#include "modes/formulation.h"
#include "support/balancer_scenes.h"
#include "support/rotating_scenes.h"
#include "support/test_rotors.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using modes::PartPower;
using modes::SpectrumSolver;
using modes::WhirlMode;
using Complex = std::complex<double>;

double sum_of(const std::vector<PartPower> &parts) {
    double sum = 0;
    for (const PartPower &part : parts)
        sum += part.power;
    return sum;
}
double size_of(const std::vector<PartPower> &parts) {
    double size = 0;
    for (const PartPower &part : parts)
        size += std::abs(part.power);
    return size;
}
double power_of(const std::vector<PartPower> &parts, const std::string &of) {
    double sum = 0;
    for (const PartPower &part : parts)
        sum += part.of == of ? part.power : 0;
    return sum;
}

/// 1/4 (|l|^2 q^H M q + q^H K q), of K the symmetric part.
double energy(Complex l, const Eigen::VectorXcd &q, const Eigen::MatrixXd &M,
              const Eigen::MatrixXd &K) {
    return (std::norm(l) * q.dot(M * q).real() + q.dot(K * q).real()) / 4;
}

Eigen::MatrixXd dense(const linalg::Matrix &matrix) {
    return Eigen::MatrixXd(Eigen::SparseMatrix<double>(matrix.view()));
}

/// Of all modes: the parts lose what the energy falls by. The eigenpairs are good to 1e-12 of their
/// own scale; powers that are small against the energy times the frequency feel that.
void expect_balance_in_fixed_axes(const model::Case &scene, double speed, int modes) {
    const results::Formulation used = modes::choose_formulation(scene);
    const SpectrumSolver solver(scene.rotor, used.form, scene.rotor.shaft.order);
    const assembly::FixedSystem system = assembly::assemble_fixed(solver.discretization(), speed);
    const Eigen::MatrixXd M = dense(system.M);
    const Eigen::MatrixXd K = dense(system.K);
    int oscillating = 0;
    for (const WhirlMode &mode : solver.at(speed, modes).modes) {
        const auto [x, y] = solver.planes(mode);
        Eigen::VectorXcd q(2 * x.size());
        q(Eigen::seqN(0, x.size(), 2)) = x;
        q(Eigen::seqN(1, x.size(), 2)) = y;
        const Complex l = mode.eigenvalue;
        const double E = energy(l, q, M, K);
        const std::vector<PartPower> parts = modes::part_powers(solver, mode, speed);
        EXPECT_NEAR(sum_of(parts), -2 * l.real() * E,
                    1e-9 * size_of(parts) + 1e-11 * std::abs(l) * E)
            << results::form_name(used.form) << ", " << l;
        ++oscillating;
    }
    EXPECT_EQ(oscillating, modes);
}

model::Case damped_rotor() {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e6, 1e6, 0, 200);
    scene.rotor.shaft.order = 4;
    scene.rotor.bearings[1].rows[0].k(0, 1) = 2e5;
    scene.rotor.bearings[1].rows[0].k(1, 0) = -2e5;
    scene.rotor.shaft.internal_damping = 2e-5;
    return scene;
}

TEST(Dissipation, balances_the_energy_of_a_rotor_that_is_the_same_from_every_direction) {
    for (const double speed : {0.0, 300.0, -900.0})
        expect_balance_in_fixed_axes(damped_rotor(), speed, 8);
}

TEST(Dissipation, balances_the_energy_with_everything_that_damps_or_feeds) {
    model::Case scene = damped_rotor();
    model::Rotor &rotor = scene.rotor;
    model::BearingCoefficients &first = rotor.bearings[0].rows[0];
    first.k << 1.2e6, 3e5, -1e5, 8e5;
    first.c << 300, 40, -60, 150;
    first.m << 0.5, 0.1, -0.2, 0.7;
    first.kt.diagonal().setConstant(3e3);
    first.ct.diagonal().setConstant(5);
    rotor.bearings[1].pedestal = model::Pedestal(8, 5e6, 400);
    rotor.bearings[1].pedestal->c.y() = 900;
    model::Bearing seal = tests::bearing(0.8, 2e5, 2e5, 0, 80);
    seal.seal = true;
    rotor.bearings.push_back(seal);
    rotor.shaft.alpha = 0.4;
    rotor.shaft.beta = 1e-5;
    rotor.shaft.axial_torque = 3e3;
    for (const double speed : {0.0, 450.0})
        expect_balance_in_fixed_axes(scene, speed, 8);
}

TEST(Dissipation, balances_the_energy_with_modal_damping) {
    model::Case scene = damped_rotor();
    scene.rotor.bearings = {tests::bearing(0, 1e6, 2e6, 0, 100), tests::bearing(1.5, 1e6, 1e6)};
    scene.rotor.shaft.modal_damping = {0.01, 0.02, 0.03};
    expect_balance_in_fixed_axes(scene, 400, 6);
}

/// Massless shaft of stiffness k with internal damping eta, a disc m with a damper c: l^2 m + l (c
/// + eta k) + k - i speed eta k = 0, and what each force takes of w' is theirs alone.
TEST(Dissipation, jeffcott_rotor_with_internal_damping) {
    constexpr double eta = 4e-4;
    constexpr double c = 60;
    constexpr double mass = 10;
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.03, tests::weightless_steel());
    scene.rotor.shaft.internal_damping = eta;
    scene.rotor.discs = {tests::disc_at(0.5, mass, 1e-9, 1e-9)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e15), tests::isotropic_bearing(1, 1e15),
                            tests::isotropic_bearing(0.5, 0, c)};
    const SpectrumSolver solver(scene.rotor, modes::choose_formulation(scene).form, 1);
    for (const double speed : {100.0, 500.0}) {
        int compared = 0;
        for (const WhirlMode &mode : solver.at(speed, 12).modes) {
            if (-mode.eigenvalue.real() > mode.eigenvalue.imag())
                continue; // the massless shaft itself creeps back at 1/eta
            const std::vector<PartPower> parts = modes::part_powers(solver, mode, speed);
            const Complex l = mode.eigenvalue;
            const double turn = mode.whirl == results::Whirl::forward ? speed : -speed;
            // k from the real and imaginary parts of the equation: |l|^2 m + ... = 0 on (Re, Im).
            const Complex k = -(l * l * mass + l * c) / (1.0 + eta * (l - Complex(0, turn)));
            ASSERT_NEAR(k.imag() / k.real(), 0, 1e-6) << l;
            const double inner = eta * k.real() * (std::norm(l) - turn * l.imag());
            const double outer = c * std::norm(l);
            // 1e-6: bearings of 1e15 N/m give way by 1e-9 of the shaft, the disc tilts.
            EXPECT_NEAR(power_of(parts, "internal damping") / power_of(parts, "bearing"),
                        inner / outer, 1e-6 * std::abs(inner / outer))
                << speed << " " << results::whirl_name(mode.whirl);
            ++compared;
        }
        EXPECT_EQ(compared, 2);
    }
}

/// A rotor that differs between two axes of its own, on damped bearings, in rotating axes.
TEST(Dissipation, balances_the_energy_seen_from_an_asymmetric_rotor) {
    model::Case scene = damped_rotor();
    scene.rotor.shaft.segments[1].asymmetry = 0.15;
    scene.rotor.shaft.segments[1].asymmetry_angle = 0.4;
    scene.rotor.anisotropies = {{"", 0.5, 0.03, 0.2}};
    const results::Formulation used = modes::choose_formulation(scene);
    ASSERT_EQ(used.form, results::Form::rotating);
    const double speed = 250;
    const SpectrumSolver solver(scene.rotor, used.form, 4);
    const assembly::RotatingSystem system =
        assembly::assemble_rotating(solver.discretization(), speed, {});
    for (const WhirlMode &mode : solver.at(speed, 6).modes) {
        const std::vector<PartPower> parts = modes::part_powers(solver, mode, speed);
        const double E = energy(mode.rotating_value, mode.rotating_vector, dense(system.M),
                                dense(system.stiffness(speed)));
        EXPECT_NEAR(sum_of(parts), -2 * mode.rotating_value.real() * E,
                    1e-9 * size_of(parts) + 1e-11 * std::abs(mode.rotating_value * E));
        EXPECT_GT(size_of(parts), 0);
    }
}

/// Seen from an axisymmetric rotor the shares are those in the fixed axes but for terms of the
/// order of the damping ratio squared: whirl that is seen slower or turned round is so for all.
TEST(Dissipation, shares_are_alike_in_both_frames) {
    model::Case scene = damped_rotor();
    const double speed = 250;
    const SpectrumSolver fixed(scene.rotor, results::Form::planar_damped, 4);
    const SpectrumSolver turning(scene.rotor, results::Form::rotating, 4);
    const std::vector<WhirlMode> a = fixed.at(speed, 6).modes;
    const std::vector<WhirlMode> b = turning.at(speed, 6).modes;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_NEAR(std::abs(a[i].eigenvalue - b[i].eigenvalue), 0,
                    1e-8 * std::abs(a[i].eigenvalue));
        const auto here = modes::part_powers(fixed, a[i], speed);
        const auto there = modes::part_powers(turning, b[i], speed);
        ASSERT_EQ(here.size(), there.size());
        const double ratio = a[i].eigenvalue.real() / std::abs(a[i].eigenvalue);
        const double seen = std::abs(a[i].eigenvalue.imag() - speed) / speed;
        for (std::size_t k = 0; k < here.size(); ++k)
            EXPECT_NEAR(here[k].power / sum_of(here), there[k].power / sum_of(there),
                        20 * ratio * ratio / (seen * seen) * size_of(here) / std::abs(sum_of(here)))
                << here[k].of << " " << a[i].eigenvalue;
    }
}

/// A ball on a circle in the rotor with its own angle as the unknown.
struct Ball {
    double mass, radius, drag, angle;
};

/// A mass on isotropic springs with such balls, in rotating axes: unknowns u (x, y), then each
/// angle times the radius. M q'' + (G + C) q' + (K + N) q = 0, N skew from the damper.
struct BallRotor {
    Eigen::MatrixXd M, C, G, K, N;

    BallRotor(double mass, double k, double c, double speed, const std::vector<Ball> &balls) {
        const auto n = static_cast<Eigen::Index>(2 + balls.size());
        M = C = G = K = N = Eigen::MatrixXd::Zero(n, n);
        Eigen::MatrixXd J(2, 2);
        J << 0, -1, 1, 0;
        const auto add_mass = [&](double m, const Eigen::MatrixXd &moves) { // 2 x n: of a point
            const Eigen::MatrixXd square = linalg::transposed_times(moves, moves);
            M += m * square;
            G += 2 * speed * m * linalg::transposed_times(moves, linalg::times(J, moves));
            K -= speed * speed * m * square;
        };
        Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(2, n);
        moves.leftCols(2).setIdentity();
        add_mass(mass, moves);
        for (std::size_t j = 0; j < balls.size(); ++j) {
            const Ball &ball = balls[j];
            const auto own = static_cast<Eigen::Index>(2 + j);
            Eigen::MatrixXd with = moves;
            with.col(own) << -std::sin(ball.angle), std::cos(ball.angle);
            add_mass(ball.mass, with);
            // Along its circle: the term of second order of |u + R e^(i angle)|^2 takes back what
            // the straight line along the tangent would give.
            K(own, own) += speed * speed * ball.mass;
            C(own, own) += ball.drag;
        }
        K.topLeftCorner(2, 2) += k * Eigen::Matrix2d::Identity();
        C.topLeftCorner(2, 2) += c * Eigen::Matrix2d::Identity();
        N.topLeftCorner(2, 2) = c * speed * J;
    }

    /// Share of the balls in the power of the motion next to an eigenvalue, and how far it is.
    [[nodiscard]] std::pair<double, double> share_of_balls(Complex near) const {
        const Eigen::Index n = M.rows();
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        A.topRightCorner(n, n).setIdentity();
        const Eigen::PartialPivLU<Eigen::MatrixXd> mass(M);
        A.bottomLeftCorner(n, n) = -linalg::solved(mass, K + N);
        A.bottomRightCorner(n, n) = -linalg::solved(mass, C + G);
        const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
        Eigen::Index best = 0;
        for (Eigen::Index i = 1; i < 2 * n; ++i)
            if (std::abs(solver.eigenvalues()(i) - near) <
                std::abs(solver.eigenvalues()(best) - near))
                best = i;
        const Complex l = solver.eigenvalues()(best);
        const Eigen::VectorXcd q = solver.eigenvectors().col(best).head(n);
        const Eigen::VectorXcd u = q.head(2);
        const Eigen::VectorXcd rolled = q.tail(n - 2);
        const double balls =
            std::norm(l) * rolled.dot(C.bottomRightCorner(n - 2, n - 2) * rolled).real() / 2;
        const double damper = std::norm(l) * u.dot(C.topLeftCorner(2, 2) * u).real() / 2 +
                              l.imag() * u.dot(N.topLeftCorner(2, 2) * u).imag() / 2;
        EXPECT_NEAR(balls + damper, -2 * l.real() * energy(l, q, M, K),
                    1e-9 * (std::abs(balls) + std::abs(damper)));
        return {balls / (balls + damper), std::abs(l - near)};
    }
};

void expect_shares_of_balls(const model::Balancer &balancer, double k, double c, double speed) {
    constexpr double mass = 20;
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(1);
    rotor.discs = {tests::disc(0.5, mass, 5, 2)};
    rotor.bearings = {tests::round_bearing(0, k / 2, c / 2), tests::round_bearing(1, k / 2, c / 2)};
    rotor.balancers = {balancer};
    const SpectrumSolver solver(rotor, results::Form::rotating, 1);
    std::vector<Ball> balls;
    const std::vector<double> angles = balancers::arrangement_at_balance(rotor).front();
    for (const model::BallRow &row : std::get<model::Balls>(balancer.parts).rows)
        for (int j = 0; j < row.n; ++j)
            balls.push_back({row.mass, row.radius, row.damping, angles.at(balls.size())});
    const BallRotor exact(mass, k, c, speed, balls);
    int compared = 0;
    for (const WhirlMode &mode : solver.at(speed, 8).modes) {
        const auto [share, distance] = exact.share_of_balls(mode.rotating_value);
        if (distance > 1e-7 * speed) // a tilting motion, in which the balls in the middle rest
            continue;
        const std::vector<PartPower> parts = modes::part_powers(solver, mode, speed);
        // 1e-6: the exact rotor's defective pairs of balls (0, 0) lie beside none of these.
        EXPECT_NEAR(power_of(parts, "balancer") / sum_of(parts), share, 1e-6)
            << mode.rotating_value;
        ++compared;
    }
    EXPECT_GE(compared, 2);
}

TEST(Dissipation, balls_take_what_their_own_angles_say) {
    for (const double speed : {150.0, 400.0}) {
        expect_shares_of_balls(tests::ball_balancer(0.5, 3, 0.2, 0.1, 0.8), 1.2e6, 300, speed);
        expect_shares_of_balls(tests::ball_balancer(0.5, 2, 0.2, 0.1, 0.8, 0.025), 1.2e6, 300,
                               speed);
    }
}

TEST(Dissipation, balls_in_several_races) {
    model::Balancer balancer = tests::ball_balancer(0.5, 3, 0.2, 0.1, 0.8);
    auto &rows = std::get<model::Balls>(balancer.parts).rows;
    rows.push_back({4, 0.1, 0.14, 0.2});
    expect_shares_of_balls(balancer, 1.2e6, 300, 400);
}

TEST(Dissipation, nothing_without_damping) {
    model::Case scene;
    for (const double kyy : {1e6, 2e6}) { // planar and hyperbolic form
        scene.rotor = tests::two_disc_rotor(1e6, kyy);
        scene.rotor.bearings[0].pedestal = model::Pedestal(5, 4e6, 0);
        for (const results::Form form :
             {modes::choose_formulation(scene).form, results::Form::general}) {
            const SpectrumSolver solver(scene.rotor, form, 4);
            for (const WhirlMode &mode : solver.at(300, 4).modes)
                EXPECT_TRUE(modes::part_powers(solver, mode, 300).empty());
        }
    }
}

} // namespace
