#include "analyses/accuracy.h"
#include "closed_form/beam_frequencies.h"
#include "elements/section.h"
#include "mesh_error/safety.h"
#include "model/errors.h"
#include "results/accuracy.h"
#include "support/balancer_scenes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace {

using namespace whirl;

model::Case shaft_on_springs() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.08, tests::steel());
    scene.rotor.discs = {tests::disc_at(0.4, 30, 0.2, 0.35)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 5e7), tests::isotropic_bearing(1, 5e7)};
    scene.speeds = model::SpeedRange{0, 800, 5};
    scene.campbell.modes = 6;
    return scene;
}

/// Rows of one family and one number of elements a span, by order or by refinement.
std::map<int, results::AccuracyRow> rows(const results::AccuracyResult &result,
                                         const std::string &family, int elements) {
    std::map<int, results::AccuracyRow> found;
    for (const results::AccuracyRow &row : result.rows)
        if (row.method == "full" && row.family == family &&
            (elements == 0 || row.elements == elements))
            found[elements == 0 ? row.elements : row.order] = row;
    return found;
}

TEST(Accuracy, classical_elements_converge_with_the_square_of_their_length) {
    const results::AccuracyResult result = analyses::accuracy(shaft_on_springs());
    EXPECT_DOUBLE_EQ(result.speed, 800);
    const auto classical = rows(result, "classical", 0);
    ASSERT_EQ(classical.size(), 7U);
    for (const int elements : {16, 32, 64}) {
        const double rate =
            std::log2(*classical.at(elements).true_error / *classical.at(2 * elements).true_error);
        EXPECT_NEAR(rate, 2, 0.1) << elements;
        // Order 5 on the same elements is as good as the truth: what is left is the safety.
        EXPECT_NEAR(*classical.at(elements).error_estimate / *classical.at(elements).true_error,
                    mesh_error::estimate_safety, 0.01);
    }
}

TEST(Accuracy, raising_the_order_converges_exponentially) {
    const results::AccuracyResult result = analyses::accuracy(shaft_on_springs());
    const auto by_order = rows(result, "order-p", 2);
    ASSERT_EQ(by_order.size(), 7U);
    // Every two orders gain more than every two before on the way to rounding.
    const double second = *by_order.at(4).true_error / *by_order.at(6).true_error;
    const double third = *by_order.at(6).true_error / *by_order.at(8).true_error;
    EXPECT_GT(second, 100);
    EXPECT_GT(third, second);
    EXPECT_LT(*by_order.at(10).true_error, 1e-10);
    // The best classical row has more unknowns and far fewer digits.
    const auto classical = rows(result, "classical", 0);
    EXPECT_GT(classical.at(128).unknowns, by_order.at(10).unknowns);
    EXPECT_GT(*classical.at(128).true_error, 1e4 * *by_order.at(10).true_error);
    for (const results::AccuracyRow &row : result.rows)
        EXPECT_GT(row.seconds, 0);
}

/// Followed modes are those of the whole rotor; a rotor without damping needs no following.
TEST(Accuracy, followed_modes_have_the_error_of_the_whole_rotor) {
    model::Case scene = shaft_on_springs();
    for (const results::AccuracyRow &row : analyses::accuracy(scene).rows)
        EXPECT_EQ(row.method, "full");
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows.front().c.diagonal() << 100, 200;
    const results::AccuracyResult result = analyses::accuracy(scene);
    int followed = 0;
    for (std::size_t i = 1; i < result.rows.size(); ++i) {
        const results::AccuracyRow &row = result.rows[i];
        if (row.method != "reduced")
            continue;
        ++followed;
        const results::AccuracyRow &full = result.rows[i - 1];
        EXPECT_EQ(full.method, "full");
        EXPECT_EQ(full.unknowns, row.unknowns);
        EXPECT_NEAR(*row.true_error, *full.true_error, 1e-11) << row.order; // rounding of both
    }
    EXPECT_GT(followed, 7);
    scene.speeds->count = 1; // nothing to follow
    for (const results::AccuracyRow &row : analyses::accuracy(scene).rows)
        EXPECT_EQ(row.method, "full");
}

/// The reference itself against the closed form of a pinned Timoshenko shaft.
TEST(Accuracy, reference_is_exact_to_its_digits) {
    model::Case scene = shaft_on_springs();
    scene.rotor.discs.clear();
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e16), tests::isotropic_bearing(1, 1e16)};
    scene.campbell.modes = 4;
    const results::AccuracyResult result = analyses::accuracy(scene);
    closed_form::UniformShaft shaft = closed_form::circular_shaft(1, 0.04, 0, 2e11, 7800);
    shaft.shear_modulus = tests::steel().G;
    shaft.shear_coefficient =
        elements::shear_coefficient(model::ShearFormula::cowper, tests::steel().poisson_ratio(), 0);
    ASSERT_EQ(result.reference_frequencies.size(), 4U);
    for (const int n : {1, 2}) {
        const auto exact = closed_form::timoshenko_whirl(shaft, n, 800);
        // Springs 1e8 times stiffer than the shaft leave 1e-8.
        EXPECT_NEAR(result.reference_frequencies[static_cast<std::size_t>(2 * n - 2)] / -exact[1],
                    1, 3e-8);
        EXPECT_NEAR(result.reference_frequencies[static_cast<std::size_t>(2 * n - 1)] / exact[2], 1,
                    3e-8);
    }
}

TEST(Accuracy, refuses_a_rigid_shaft) {
    model::Case scene = shaft_on_springs();
    scene.rotor.shaft.rigid = true;
    EXPECT_THROW((void)analyses::accuracy(scene), model::BadInput);
}

// A shaft without mass bends as a cubic, which every order from 2 on has in it: what is left is
// rounding. Full matrices of many unknowns would take long, and lose the slow motions among the
// fast.
TEST(Accuracy, shafts_of_hardly_any_mass_have_few_rows_and_these_are_exact) {
    model::Case scene = shaft_on_springs();
    scene.rotor.shaft = tests::uniform_shaft(1, 0.08, tests::weightless_steel());
    scene.rotor.anisotropies = {{"", 0.4, 0.05, 0}};
    const results::AccuracyResult result = analyses::accuracy(scene);
    ASSERT_EQ(result.model.formulation.form, results::Form::rotating);
    EXPECT_FALSE(result.model.notes.empty());
    int compared = 0;
    for (const results::AccuracyRow &row : result.rows) {
        EXPECT_LE(row.unknowns, 110);
        if (row.order < 2)
            continue;
        ASSERT_TRUE(row.true_error) << row.order;
        EXPECT_LT(*row.true_error, 1e-11) << row.order; // 1e3 of rounding of full matrices
        ++compared;
    }
    EXPECT_GE(compared, 8);
}

// Balls that balance nothing are free to turn together: motions without damping and with it, all at
// rest in the rotor, of which rounding picks others on every mesh.
TEST(Accuracy, free_motions_of_balls_do_not_pass_for_errors) {
    model::Case scene = shaft_on_springs();
    for (const double z : {0.1, 0.8})
        scene.rotor.balancers.push_back(tests::ball_balancer(z, 2, 0.05, 0.15, 0.5));
    scene.speeds = model::SpeedRange{0, 500, 5};
    for (const int modes : {6, 7, 8, 9}) {
        scene.campbell.modes = modes;
        for (const results::AccuracyRow &row : analyses::accuracy(scene).rows) {
            SCOPED_TRACE(testing::Message() << modes << " modes, order " << row.order << ", "
                                            << row.elements << " elements");
            ASSERT_TRUE(row.error_estimate && row.true_error);
            if (row.order >= 6) // far below what parts the free motions, 0.5/0.05 1/s of 500
                EXPECT_LT(std::max(*row.error_estimate, *row.true_error), 1e-5);
        }
    }
}

} // namespace
