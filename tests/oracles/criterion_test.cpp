// Receptance, influence coefficients, the criterion and rigid bodies against each other and
// closed forms.

#include "oracles/balls.h"
#include "oracles/criterion.h"
#include "oracles/influence.h"
#include "oracles/rigid_rotor.h"
#include "oracles/rotating_state.h"
#include "oracles/rotor_axes.h"
#include "oracles/statics.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>

namespace {

using namespace whirl::oracles;

CaseRotor long_rotor(const std::vector<std::string> &settings = {}) {
    std::vector<std::string> all{"bearing[0].c=0", "bearing[1].c=0"};
    all.insert(all.end(), settings.begin(), settings.end());
    return read_case(WHIRL_ROOT "/cases/excess_planes/case.toml", all);
}

TEST(Receptance, of_slow_forces_is_the_static_deflection) {
    const SteppedRotor rotor = stepped(long_rotor());
    const ComplexMatrix H = receptance(rotor, Complex(0, 1e-6L), 1e-6L, {0.2, 0.6, 0.95});
    const Real expected = static_deflection(rotor, 0.6, 1, 0, 0.95).x;
    EXPECT_NEAR(static_cast<double>(H(2, 1).real() / expected), 1, 1e-14);
    EXPECT_NEAR(static_cast<double>(H(1, 2).real() / H(2, 1).real()), 1, 1e-14);
}

TEST(Influence, beam_on_two_supports) {
    CaseRotor rotor = long_rotor();
    const Cylinder &c = rotor.shaft[0].left; // 1.2 m, supports at its ends
    const Real I = std::numbers::pi_v<Real> * std::pow(static_cast<Real>(c.outer), 4) / 64;
    const Real EI = c.E * I;
    const Real nu = c.E / (2 * static_cast<Real>(c.G)) - 1;
    const Real S = 6 * (1 + nu) / (7 + 6 * nu) * c.G * std::numbers::pi_v<Real> *
                   std::pow(static_cast<Real>(c.outer) / 2, 2);
    const Real L = c.length;
    const RealMatrix F = MasslessShaft(rotor).coefficients({L / 2});
    const Real springs = (1 / Real(2e6) + 1 / Real(3e6)) / 4;
    EXPECT_NEAR(static_cast<double>(F(0, 0) / (L * L * L / (48 * EI) + L / (4 * S) + springs)), 1,
                1e-15);
    // Moment in the middle: L/(12 EI) + 1/(S L) and the tilt of the supports
    const Real tilt = (1 / Real(2e6) + 1 / Real(3e6)) / (L * L);
    EXPECT_NEAR(static_cast<double>(F(1, 1) / (L / (12 * EI) + 1 / (S * L) + tilt)), 1, 1e-15);
    rotor.supports[1].z = 0.8; // force at the free end, 0.4 m beyond
    rotor.supports[0].k = rotor.supports[1].k = {{{1e30, 0}, {0, 1e30}}};
    const Real a = 0.4L;
    const Real b = 0.8L;
    EXPECT_NEAR(static_cast<double>(MasslessShaft(rotor).coefficients({L})(0, 0) /
                                    (a * a * (a + b) / (3 * EI) + a / S + a * a / (b * S))),
                1, 1e-14);
}

TEST(Influence, lumped_masses_converge_to_the_transfer_matrix) {
    const CaseRotor rotor = long_rotor();
    const MasslessShaft shaft(rotor);
    const std::vector<Real> exact =
        signature(criterion_form(stepped(rotor), 880, {0.2, 0.6, 0.95}));
    const auto by_lumps = [&](int slices) {
        return signature(
            lumped_criterion_form(shaft, lumps_of(rotor, slices), 880, {0.2L, 0.6L, 0.95L})
                .cast<Complex>());
    };
    const std::vector<Real> coarse = by_lumps(12);
    const std::vector<Real> fine = by_lumps(24);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(static_cast<double>(fine[i] / exact[i]), 1, 2e-2) << i;
        const Real limit = (4 * fine[i] - coarse[i]) / 3;
        EXPECT_NEAR(static_cast<double>(limit / exact[i]), 1, 2e-4) << i;
    }
}

TEST(Criterion, bands_end_at_critical_speeds_and_at_those_of_the_pinned_rotor) {
    const CaseRotor rotor = long_rotor();
    const Lumps lumps = lumps_of(rotor, 40); // error of the order of 1/40^2
    const MasslessShaft shaft(rotor);
    const std::vector<Real> critical = lumped_critical_speeds(shaft, lumps);
    const std::vector<Real> pinned = lumped_critical_speeds(shaft, lumps, {0.2L});
    const std::vector<Band> bands = criterion_bands(stepped(rotor), 0, 600, {0.2});
    ASSERT_EQ(bands.size(), 2U);
    EXPECT_NEAR(static_cast<double>(bands[0].first / critical.at(0)), 1, 1e-4);
    EXPECT_NEAR(static_cast<double>(bands[0].second / pinned.at(0)), 1, 1e-4);
    EXPECT_NEAR(static_cast<double>(bands[1].first / critical.at(1)), 1, 3e-4);
    const std::vector<Real> zeros = pinned_speeds(stepped(rotor), 0, 600, {0.2});
    ASSERT_EQ(zeros.size(), 1U);
    EXPECT_NEAR(static_cast<double>(zeros[0] / bands[0].second), 1, 1e-15);
}

/// Critical speeds (no plane) or pinned ones by influence coefficients, extrapolated from 16 and 32
/// slices of the shaft.
std::vector<Real> by_influence(const CaseRotor &rotor, const std::vector<Real> &pinned) {
    const MasslessShaft shaft(rotor);
    const auto coarse = lumped_critical_speeds(shaft, lumps_of(rotor, 16), pinned);
    auto fine = lumped_critical_speeds(shaft, lumps_of(rotor, 32), pinned);
    for (std::size_t i = 0; i < 4 && i < coarse.size(); ++i)
        fine[i] = (4 * fine[i] - coarse[i]) / 3;
    return fine;
}

/// Every end of a band is a critical speed or one of the pinned rotor, found without the transfer
/// matrix.
TEST(Criterion, ends_of_bands_by_influence_coefficients) {
    for (const std::string name : {"disc_type_short", "excess_planes", "extractor_two_plane"}) {
        const CaseRotor rotor = read_case(WHIRL_ROOT "/cases/" + name + "/case.toml",
                                          {"bearing[0].c=0", "bearing[1].c=0"});
        for (const double plane : rotor.planes) {
            std::vector<Real> known = by_influence(rotor, {});
            for (const Real speed : by_influence(rotor, {static_cast<Real>(plane)}))
                known.push_back(speed);
            for (const auto &[from, to] :
                 criterion_bands(stepped(rotor), 0, rotor.speed_to, {plane}))
                for (const Real end : {from, to}) {
                    Real nearest = std::abs(end / rotor.speed_to - 1);
                    for (const Real speed : known)
                        nearest = std::min(nearest, std::abs(end / speed - 1));
                    EXPECT_LT(static_cast<double>(nearest), 1e-4)
                        << name << " plane " << plane << " at " << static_cast<double>(end);
                }
        }
    }
}

TEST(Criterion, of_a_stiff_shaft_is_that_of_the_rigid_rotor) {
    const CaseRotor soft = long_rotor();
    CaseRotor stiff = soft;
    for (Segment &segment : stiff.shaft) {
        segment.left.E *= 1e7;
        segment.left.G *= 1e7;
    }
    const RigidRotor body = bare_rotor(soft);
    for (const double plane : {0.2, 0.6}) {
        const std::vector<Band> rigid = rigid_bands(body, plane, 1500);
        const std::vector<Band> elastic = criterion_bands(stepped(stiff), 0, 1500, {plane});
        ASSERT_EQ(elastic.size(), rigid.size());
        for (std::size_t i = 0; i < rigid.size(); ++i) {
            EXPECT_NEAR(static_cast<double>(elastic[i].first / rigid[i].first), 1, 1e-7);
            EXPECT_NEAR(static_cast<double>(elastic[i].second / rigid[i].second), 1, 1e-7);
        }
    }
    const std::vector<Band> joint = criterion_bands(stepped(stiff), 0, 1500, {0.2, 0.95});
    ASSERT_EQ(joint.size(), 1U);
    EXPECT_NEAR(static_cast<double>(joint[0].first / rigid_joint_bands(body, 1500).at(0).first), 1,
                1e-7);
    EXPECT_EQ(rigid_rank(body, {0.2, 0.6, 0.95}), 2);
    EXPECT_EQ(rigid_rank(body, {0.2}), 1);
}

/// Numbers printed for the two-support rotor of the empirical criterion.
TEST(RigidRotor, two_supports) {
    RigidRotor body;
    body.mass = 60;
    body.A = 3;
    body.C = 1;
    body.k0 = 5e6;
    body.k1 = 3e6L * 0.5L - 2e6L * 0.4L;
    body.k2 = 2e6L * 0.16L + 3e6L * 0.25L;
    const auto omega = resonances(body);
    ASSERT_EQ(omega.size(), 2U);
    EXPECT_NEAR(static_cast<double>(omega[0]), 272.886055, 5e-7);
    EXPECT_NEAR(static_cast<double>(omega[1]), 737.473073, 5e-7);
    const std::vector<std::pair<double, double>> hats{
        {-0.3, 512.017736}, {0, 731.436942}, {0.2, 474.341649}, {0.45, 320.390663}};
    for (const auto &[z, hat] : hats)
        EXPECT_NEAR(static_cast<double>(additional_speeds(body, z).at(0)), hat, 5e-7) << z;
    body.C = 3; // spherical: one resonance, band to the additional speed
    EXPECT_EQ(resonances(body).size(), 1U);
    EXPECT_EQ(rigid_bands(body, 0.2, 1e4).size(), 1U);
    EXPECT_TRUE(rigid_joint_bands(body, 1e4).empty());
    body.C = 6; // short, |z| below sqrt((C - A)/M) = 0.224: no upper end
    EXPECT_EQ(static_cast<double>(rigid_bands(body, 0.2, 1e4).at(0).second), 1e4);
    EXPECT_LT(static_cast<double>(rigid_bands(body, 0.3, 1e4).at(0).second), 1e4);
}

TEST(Balls, symmetric_positions_balance) {
    for (const int n : {2, 3, 4, 5}) {
        const auto angles = symmetric_position(n, 2);
        Complex sum = 0;
        for (const Real angle : angles)
            sum += std::polar(Real(1), angle);
        EXPECT_NEAR(static_cast<double>(std::abs(sum + static_cast<Real>(n) / 2)), 0, 1e-15) << n;
    }
}

/// Table of the theory: n = 2, 3 exact to the digits, n >= 4 from random positions.
TEST(Balls, interval_of_the_second_harmonic) {
    struct Row {
        int n;
        double E, least, most, tolerance;
    };
    for (const Row &row :
         {Row{2, 1.2, 0.388889, 0.388889, 1e-6}, Row{2, 3, 0.777778, 0.777778, 1e-6},
          Row{3, 1.2, 0.416667, 0.444878, 1e-6}, Row{3, 1.5, 0, 0.408248, 1e-6},
          Row{3, 2, 0.25, 0.728869, 1e-6}, Row{4, 1.2, 0.3889, 0.5251, 1e-4}, Row{4, 2, 0, 1, 1e-4},
          Row{5, 2, 0, 0.6748, 1e-4}}) {
        const HarmonicInterval found =
            harmonic_interval({{row.n, 1, 1, 0}}, row.n / static_cast<Real>(row.E));
        EXPECT_NEAR(static_cast<double>(found.least), row.least, row.tolerance) << row.n;
        EXPECT_NEAR(static_cast<double>(found.most), row.most, row.tolerance) << row.n;
    }
}

/// Where the disc of a case on its massless shaft stands still without a force, by influence
/// coefficients; two-node elements are exact there.
TEST(RotorAxes, critical_speeds_are_those_of_the_disc_on_its_flexibility) {
    for (const char *name : {"keyway_shaft", "anisotropic_disc_flexible"}) {
        const CaseRotor rotor =
            read_case(std::string(WHIRL_ROOT "/cases/") + name + "/case.toml", {});
        const RotatingRotor disc = rotating_disc(rotor);
        const auto found = RotorAxes(rotor).critical_speeds(rotor.speed_from, rotor.speed_to);
        ASSERT_GE(found.size(), 2U);
        for (const double speed : found) {
            const Real below = determinant(disc.static_matrix(speed * (1 - 1e-8L)));
            const Real above = determinant(disc.static_matrix(speed * (1 + 1e-8L)));
            EXPECT_LT(static_cast<double>(below * above), 0) << name << " " << speed;
        }
    }
}

/// Of an axisymmetric rotor each eigenvalue twice, those of the exact continuum.
TEST(RotorAxes, form_of_a_round_rotor_is_that_of_the_transfer_matrix) {
    const CaseRotor rotor = long_rotor();
    const std::vector<double> places{rotor.planes.at(0), rotor.planes.at(1)};
    const auto exact = signature(criterion_form(stepped(rotor), 500, places));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> real(
        RotorAxes(rotor, 40).form(500, places));
    ASSERT_EQ(real.eigenvalues().size(), 4);
    for (Eigen::Index i = 0; i < 4; ++i) // elements converge with the square of their length
        EXPECT_NEAR(real.eigenvalues()(i) /
                        static_cast<double>(exact.at(static_cast<std::size_t>(i / 2))),
                    1, 1e-4);
}

} // namespace
