// Several rows of different balls in one balancer.

#include "balancers/small_motions.h"

#include "balancers/balanced_position.h"
#include "model/errors.h"
#include "support/balancer_scenes.h"

namespace whirl {
namespace {

using tests::distance_to;
using tests::element_eigenvalues;
using tests::expect_same_motions;
using tests::tilting;

/// Rows of different balls: one mean of all displacements and the difference of the first row.
model::Balancer two_rows() {
    model::Balancer balancer = tests::ball_balancer(0, 2, 0.05, 0.06, 1.2, 0.006);
    std::get<model::Balls>(balancer.parts).rows.push_back({3, 0.02, 0.09, 0.1});
    return balancer;
}

TEST(RowsOfBalls, SmallMotionsAreThoseOfTheLinearElement) {
    for (const double speed : {30.0, 90.0, 150.0, 400.0})
        expect_same_motions(tilting(two_rows(), speed), 1e-10, 1000);
}

TEST(RowsOfBalls, EqualRowsAreOneRow) {
    model::Balancer one = tests::ball_balancer(0, 4, 0.05, 0.06, 1.2, 0.006);
    model::Balancer two = one;
    std::get<model::Balls>(two.parts).rows = {{2, 0.05, 0.06, 1.2}, {2, 0.05, 0.06, 1.2}};
    two.position = one.position = {2.0, -2.0, 1.8, -1.8};
    one.imbalance = two.imbalance = -0.05 * 0.06 * 2 * (std::cos(2.0) + std::cos(1.8));
    const tests::Spectrum a = element_eigenvalues(tilting(one, 130), {one.position});
    const tests::Spectrum b = element_eigenvalues(tilting(two, 130), {two.position});
    ASSERT_EQ(a.size(), b.size());
    for (const auto value : a) // rounding of a dense eigensolver
        EXPECT_LT(distance_to(b, value), 1e-11 * 1e3);
}

// Positions balance: sum m R exp(i a) = -m0 R0 to rounding; and no random one lies outside the
// interval of the anisotropy.
TEST(RowsOfBalls, PositionsBalanceWithinTheInterval) {
    std::vector<model::Balancer> all{two_rows(), two_rows(), two_rows()};
    std::get<model::Balls>(all[1].parts).rows = {{1, 0.05, 0.06, 1}, {1, 0.03, 0.09, 1}};
    std::get<model::Balls>(all[2].parts).rows = {
        {1, 0.05, 0.06, 1}, {2, 0.03, 0.09, 2}, {2, .02, .05, 0}};
    all[1].imbalance = 0.004;
    for (const model::Balancer &balancer : all) {
        const auto masses = balancers::kind_of(balancer)->circled();
        const auto interval = balancers::anisotropy_interval(balancer);
        ASSERT_TRUE(interval);
        const auto inertias = balancers::added_inertias(balancer);
        const auto positions = balancers::sampled_positions(balancer, 200);
        EXPECT_GE(positions.size(), masses.size() > 2 ? 150U : 1U);
        for (const auto &angles : positions) {
            std::complex<double> moment = balancer.imbalance;
            for (std::size_t j = 0; j < masses.size(); ++j)
                moment += std::polar(masses[j].moment, angles[j]);
            EXPECT_LT(std::abs(moment), 1e-14 * balancer.imbalance * 10);
            const double a =
                std::abs(inertias.parts * balancers::second_harmonic_of(balancer, angles)) / 2;
            EXPECT_GE(a, interval->least * (1 - 1e-9) - 1e-12 * inertias.parts);
            EXPECT_LE(a, interval->largest * (1 + 1e-9));
        }
    }
}

// With equal masses the search must find the ends that the closed form knows.
TEST(RowsOfBalls, SearchFindsTheEndsOfTheClosedForm) {
    model::Balancer equal = tests::ball_balancer(0, 4, 0.05, 0.06, 1, 0.006);
    model::Balancer almost = equal; // not equal by less than the tolerance of the comparison
    std::get<model::Balls>(almost.parts).rows = {{2, 0.05, 0.06, 1},
                                                 {2, 0.05 * (1 + 1e-9), 0.06, 1}};
    const auto exact = balancers::anisotropy_interval(equal).value();
    const auto found = balancers::anisotropy_interval(almost).value();
    EXPECT_NEAR(found.least, exact.least, 1e-6 * exact.largest);
    EXPECT_NEAR(found.largest, exact.largest, 1e-7 * exact.largest);
}

TEST(RowsOfBalls, OnesThatCannotCloseThePolygonAreRefused) {
    model::Balancer balancer = tests::ball_balancer(0, 1, 0.05, 0.06, 1, 0.001);
    std::get<model::Balls>(balancer.parts).rows.push_back({1, 0.01, 0.06, 1}); // 0.003 > 0.0016
    EXPECT_THROW((void)balancers::angles_at_balance(balancer, "balancer[0]"), model::BadInput);
}

} // namespace
} // namespace whirl
