#include "analyses/rigid_limit.h"
#include "model/errors.h"
#include "support/balancer_parts.h"
#include "support/rigid_rotors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::analyses {

namespace {

using namespace whirl::tests;

/// The rows of the stiffness sweep, or those of the mesh sweep with elements of one order.
std::vector<results::RigidLimitRow> stiffness_rows(const results::RigidLimitResult &result) {
    std::vector<results::RigidLimitRow> rows;
    for (const results::RigidLimitRow &row : result.rows)
        if (row.elements.empty())
            rows.push_back(row);
    return rows;
}

std::vector<results::RigidLimitRow> mesh_rows(const results::RigidLimitResult &result, int order) {
    std::vector<results::RigidLimitRow> rows;
    for (const results::RigidLimitRow &row : result.rows)
        if (!row.elements.empty() && row.order == order)
            rows.push_back(row);
    return rows;
}

results::RigidLimitRow row_named(const results::RigidLimitResult &result,
                                 const std::string &quantity) {
    for (const results::RigidLimitRow &row : result.rows)
        if (row.quantity == quantity)
            return row;
    ADD_FAILURE() << "no row " << quantity;
    return {};
}

model::Case scaled(model::Case scene, double factor) {
    scene.rotor.shaft.segments[0].material.E *= factor;
    scene.rotor.shaft.segments[0].material.G *= factor;
    return scene;
}

std::string failure_of(const model::Case &scene) {
    try {
        static_cast<void>(rigid_limit(scene));
    } catch (const model::AnalysisFailure &failure) {
        return failure.what();
    }
    return "";
}

/// w1, w2 of two_support_case() with a rigid shaft: M (A - C) w^4 - [(A - C) k11 + M k33] w^2
/// + k11 k33 - k14^2 = 0, A - C = 2 kg m2.
std::array<double, 2> rigid_two_support_speeds() {
    const double k11 = 2e6 + 3e6, k14 = 3e6 * 0.5 - 2e6 * 0.4, k33 = 2e6 * 0.16 + 3e6 * 0.25;
    const double b = 2 * k11 + 60 * k33;
    const double root = std::sqrt(b * b - 4 * 60 * 2 * (k11 * k33 - k14 * k14));
    return {std::sqrt((b - root) / 240), std::sqrt((b + root) / 240)};
}

/// The same with E and G of the massless shaft `factor` times as large: the compliance under a
/// force and a moment at the disc by the rules of statics, W from det[1/W^2 - F diag(M, A - C)].
std::array<double, 2> flexible_two_support_speeds(double factor) {
    const double a = 0.4, b = 0.5, L = 0.9, E = 2e11 * factor, G = 7.7e10 * factor;
    const double nu = E / (2 * G) - 1;
    const double EI = E * M_PI * std::pow(0.06, 4) / 64;
    const double shear = 6 * (1 + nu) / (7 + 6 * nu) * G * M_PI * 0.06 * 0.06 / 4; // Cowper
    const double k1 = 2e6, k2 = 3e6;
    const double f11 =
        a * a * b * b / (3 * EI * L) + a * b / (shear * L) + (b * b / k1 + a * a / k2) / (L * L);
    const double f12 = a * b * (b - a) / (3 * EI * L) + (a / k2 - b / k1) / (L * L);
    const double f22 =
        (a * a - a * b + b * b) / (3 * EI * L) + 1 / (shear * L) + (1 / k1 + 1 / k2) / (L * L);
    const double sum = 60 * f11 + 2 * f22;
    const double root = std::sqrt(sum * sum - 4 * 60 * 2 * (f11 * f22 - f12 * f12));
    return {std::sqrt(2 / (sum + root)), std::sqrt(2 / (sum - root))};
}

/// First-order convergence: each difference falls like 1/stiffness. The fit takes differences below
/// 1 %, where the next term changes the slope by less than that.
void expect_first_order(const results::RigidLimitRow &row) {
    ASSERT_TRUE(row.rate) << row.quantity;
    EXPECT_NEAR(*row.rate, -1, 3e-3) << row.quantity;
    ASSERT_FALSE(row.relative_difference.empty());
    for (std::size_t k = 1; k < row.relative_difference.size(); ++k)
        EXPECT_LT(*row.relative_difference[k], *row.relative_difference[k - 1]) << row.quantity;
    EXPECT_LT(*row.relative_difference.back(), 1e-4) << row.quantity;
}

} // namespace

TEST(RigidLimit, TwoSupportRotorConvergesToItsResonances) {
    const results::RigidLimitResult result = rigid_limit(two_support_case());
    const auto rows = stiffness_rows(result);
    ASSERT_EQ(rows.size(), 2u);
    // The source's numbers, of which the first is rounded up wrongly there; all digits given.
    EXPECT_NEAR(rows[0].closed_form, 272.886055, 1e-6);
    EXPECT_NEAR(rows[1].closed_form, 737.473073, 1e-6);
    for (const results::RigidLimitRow &row : rows)
        expect_first_order(row);
    EXPECT_EQ(result.bearing_stiffness, 5e6);
    // 48 EI/L^3 by hand.
    EXPECT_NEAR(result.stiffness / (48 * 2e11 * M_PI * std::pow(0.06, 4) / 64 / std::pow(0.9, 3)),
                1, 1e-13);
}

TEST(RigidLimit, FrequenciesOfThePapersAreThoseOfTheRotorWithItsBalancers) {
    model::Case scene = two_support_case();
    const double mass = 60;
    model::Balancer balls;
    balls.z = 0.4; // at the centre of mass: z = l1
    tests::row(balls).n = 2;
    tests::row(balls).mass = 0.5;
    tests::row(balls).radius = 0.1;
    scene.rotor.balancers = {balls};
    const results::RigidLimitResult result = rigid_limit(scene);
    EXPECT_NEAR(result.omega_0, std::sqrt(5e6 / (mass + 1)), 1e-6);
    // Two balls against each other: A, C grow by m R^2 and 2 m R^2, about two axes by +-m R^2; of
    // the slopes' moments (A - C -+ a).
    const double own = 0.5 * 0.1 * 0.1;
    const double k33 = 2e6 * 0.16 + 3e6 * 0.25;
    ASSERT_EQ(result.partial_frequencies.size(), 3U);
    EXPECT_NEAR(result.partial_frequencies[0], result.omega_0, 1e-9);
    EXPECT_NEAR(result.partial_frequencies[1], std::sqrt(k33 / (2 - own - own)), 1e-6);
    EXPECT_NEAR(result.partial_frequencies[2], std::sqrt(k33 / (2 - own + own)), 1e-6);
    EXPECT_FALSE(result.z_max);
}

TEST(RigidLimit, AdditionalSpeedsOfPlanesConverge) {
    model::Case scene = two_support_case();
    scene.rotor.planes = {{"left", 0.1}, {"", 0.4}, {"right", 0.85}};
    const results::RigidLimitResult result = rigid_limit(scene);
    // The source's numbers at -0.3, 0 and 0.45 m from the centre of mass.
    for (const auto &[name, speed] :
         {std::pair("additional speed, pinned at left", 512.017736),
          std::pair("additional speed, pinned at z = 0.4 m", 731.436942),
          std::pair("additional speed, pinned at right", 320.390663)}) {
        const results::RigidLimitRow row = row_named(result, name);
        EXPECT_NEAR(row.closed_form, speed, 1e-6);
        expect_first_order(row);
    }
}

TEST(RigidLimit, EndsOfTheUnstableRangeConverge) {
    const results::RigidLimitResult result = rigid_limit(anisotropic_case());
    // The source's numbers, printed with six decimals.
    for (const auto &[name, value] : {std::pair("forward critical speed 2", 2.282177),
                                      std::pair("forward critical speed 3", 3.952847),
                                      std::pair("unstable range, lower end", 2.381264),
                                      std::pair("unstable range, upper end", 3.788366),
                                      std::pair("permissible anisotropy", 0.055266)}) {
        const results::RigidLimitRow row = row_named(result, name);
        EXPECT_NEAR(row.closed_form, value, 6e-7) << name;
        expect_first_order(row);
    }
}

TEST(RigidLimit, WithoutUpperEndTheRangeHasOne) {
    model::Case scene = anisotropic_case();
    scene.rotor.discs[0].Ip = 1.0; // the source: unstable from 4.11 on
    const results::RigidLimitResult result = rigid_limit(scene);
    const results::RigidLimitRow row = row_named(result, "unstable above");
    EXPECT_NEAR(row.closed_form, 4.11, 5e-3);
    expect_first_order(row);
}

TEST(RigidLimit, BalancersCriticalAndAdditionalSpeedsConverge) {
    const results::RigidLimitResult result = rigid_limit(balancer_case());
    int additional = 0;
    for (const results::RigidLimitRow &row : stiffness_rows(result)) {
        additional += row.quantity.starts_with("additional") ? 1 : 0;
        ASSERT_TRUE(row.rate) << row.quantity;
        EXPECT_NEAR(*row.rate, -1, 3e-3) << row.quantity;
    }
    EXPECT_EQ(additional, 2); // one for each principal plane
}

TEST(RigidLimit, RigidModelIsTheClosedForm) {
    std::vector<model::Case> scenes{two_support_case(), anisotropic_case(), balancer_case()};
    scenes[0].rotor.planes = {{"", 0.2}};
    for (model::Case &scene : scenes) {
        scene.rotor.shaft.rigid = true;
        const results::RigidLimitResult result = rigid_limit(scene);
        EXPECT_FALSE(result.rows.empty());
        for (const results::RigidLimitRow &row : result.rows)
            for (const auto &difference : row.relative_difference) {
                ASSERT_TRUE(difference) << row.quantity;
                EXPECT_LT(*difference, 1e-9) << row.quantity; // rounding of 1e6 N/m against itself
            }
        for (const results::RigidLimitRow &row : stiffness_rows(result))
            EXPECT_TRUE(row.stiffness.size() == 1 && std::isinf(row.stiffness[0]));
    }
}

TEST(RigidLimit, OnePercentIsWhereItIs) {
    // By the statics of the shaft and the quadratic equation of the rigid rotor: formulas of the
    // test's own.
    const model::Case scene = two_support_case();
    const results::RigidLimitResult result = rigid_limit(scene);
    ASSERT_TRUE(result.one_percent);
    const std::array<double, 2> exact = rigid_two_support_speeds();
    const auto largest = [&](double factor) {
        const std::array<double, 2> found = flexible_two_support_speeds(factor);
        return std::max(std::abs(found[0] / exact[0] - 1), std::abs(found[1] / exact[1] - 1));
    };
    const double factor = result.one_percent->factor;
    EXPECT_GT(factor, 1);
    // The difference falls like 1/factor: it is 1 % to as many digits as the factor is right.
    EXPECT_NEAR(largest(factor), 0.01, 0.01 * 1e-6);
    EXPECT_NEAR(result.one_percent->over_bearings, factor * result.stiffness / 5e6, 1e-9 * factor);
    EXPECT_NE(result.sentence.find("within 1 % once the shaft is"), std::string::npos);
    // Of a shaft that is stiff enough the answer is a softer one: the same stiffness.
    const results::RigidLimitResult stiff = rigid_limit(scaled(scene, 1000));
    ASSERT_TRUE(stiff.one_percent && stiff.as_is);
    EXPECT_LT(stiff.as_is->largest, 0.01);
    EXPECT_NEAR(stiff.one_percent->stiffness / result.one_percent->stiffness, 1, 1e-6);
    EXPECT_NE(stiff.sentence.find("with the shaft as it is"), std::string::npos);
}

TEST(RigidLimit, OneElementIsEnoughForTheLimit) {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(1.2, 0.05, steel());
    scene.rotor.shaft.segments[0].elements = 12;
    scene.rotor.bearings = {isotropic_bearing(0, 1e6), isotropic_bearing(1.2, 2e6)};
    scene.rotor.discs = {disc_at(1.2, 5, 0.05, 0.09)};
    const results::RigidLimitResult result = rigid_limit(scene);
    for (const int order : {4, 1}) {
        const auto rows = mesh_rows(result, order);
        ASSERT_FALSE(rows.empty());
        for (const results::RigidLimitRow &row : rows) {
            EXPECT_GT(row.elements.front(), 12);
            EXPECT_EQ(row.elements.back(), 1);
            EXPECT_TRUE(std::is_sorted(row.elements.rbegin(), row.elements.rend()));
            // Inertias are exact on every mesh. Speeds are as near as the shaft is stiff, 1e-3: the
            // classical element bends less, by a share of that.
            for (const auto &difference : row.relative_difference)
                EXPECT_LT(*difference, row.inertia ? 1e-12 : 1e-3) << row.quantity;
        }
    }
}

TEST(RigidLimit, SegmentsOfOneSectionAreOneElementAtLast) {
    model::Case scene = two_support_case();
    const model::Segment whole = scene.rotor.shaft.segments[0];
    scene.rotor.shaft.segments.assign(5, whole);
    for (model::Segment &segment : scene.rotor.shaft.segments)
        segment.length = whole.length / 5;
    const auto rows = mesh_rows(rigid_limit(scene), 4);
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows[0].elements.back(), 2); // a node at the disc
}

TEST(RigidLimit, SaysWhatHasNoClosedForm) {
    model::Case scene = two_support_case();
    scene.rotor.bearings[1].rows[0].k(1, 1) = 1e6;
    EXPECT_NE(failure_of(scene).find("bearing[1] differs between x and y"), std::string::npos);
    scene = two_support_case();
    scene.rotor.bearings[0].pedestal = model::Pedestal{10, 1e7, 0};
    EXPECT_NE(failure_of(scene).find("bearing[0] stands on a pedestal"), std::string::npos);
    scene = two_support_case();
    scene.rotor.bearings.pop_back();
    EXPECT_NE(failure_of(scene).find("free to move or to tilt"), std::string::npos);
}

TEST(RigidLimit, TablesAreReadAtZeroSpeed) {
    const results::RigidLimitResult constant = rigid_limit(two_support_case());
    model::Case scene = two_support_case();
    model::Bearing &bearing = scene.rotor.bearings[0];
    bearing.rows.push_back(bearing.rows[0]);
    bearing.rows[1].k *= 5;
    bearing.speeds = {0, 500};
    const results::RigidLimitResult table = rigid_limit(scene);
    ASSERT_EQ(table.rows.size(), constant.rows.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        EXPECT_EQ(table.rows[i].fe, constant.rows[i].fe);
    EXPECT_TRUE(std::any_of(table.model.notes.begin(), table.model.notes.end(), [](const auto &n) {
        return n.find("read at zero speed") != std::string::npos;
    }));
}

} // namespace whirl::analyses
