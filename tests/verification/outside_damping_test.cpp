// Damping of the shaft that does not turn with it: proportional (alpha, beta) and modal.

#include "analyses/response.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/formulation.h"
#include "support/rigid_jeffcott.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using results::Form;
using Complex = std::complex<double>;

/// Rounding of an eigenvalue problem of some fifty unknowns whose stiffnesses span six decades.
constexpr double rounding = 1e-8;

double damping_ratio(Complex value) { return -value.real() / std::abs(value); }

/// Frequencies of the modes at rest without damping in one plane, ascending.
std::vector<double> undamped(const model::Rotor &rotor, int order, int wanted) {
    return tests::frequencies(
        tests::spectrum_of(model::without_damping(rotor), Form::hyperbolic, order, 0, wanted));
}

TEST(ProportionalDamping, GivesAFreeShaftItsRatios) {
    model::Rotor rotor = tests::uniform_shaft(1.2, 0.04);
    const int order = 8;
    // Two rigid motions in each plane, then bending.
    const std::vector<double> w = undamped(rotor, order, 8);
    rotor.shaft.alpha = 3;
    rotor.shaft.beta = 2e-6;
    for (const Form form : {Form::planar_damped, Form::general}) {
        const modes::Spectrum found = tests::spectrum_of(rotor, form, order, 0, 8);
        for (const std::size_t i : {4U, 6U}) {
            ASSERT_GT(w[i], 100);
            const double ratio = rotor.shaft.alpha / (2 * w[i]) + rotor.shaft.beta * w[i] / 2;
            double nearest = 1e300;
            for (const modes::WhirlMode &mode : found.modes)
                nearest = std::min(nearest, std::abs(damping_ratio(mode.eigenvalue) - ratio));
            EXPECT_LT(nearest, rounding * ratio) << results::form_name(form);
        }
    }
}

/// Without rotary inertia a free shaft's bending modes v turn alone: with internal damping eta that
/// turns and beta that does not, l^2 + (alpha + (beta + eta) w^2) l + w^2 - i W eta w^2 = 0.
TEST(ProportionalDamping, WorksAgainstInternalDamping) {
    model::Rotor rotor = tests::uniform_shaft(1.2, 0.04);
    rotor.shaft.rotary_inertia = false;
    const int order = 8;
    const double w = undamped(rotor, order, 6)[4];
    rotor.shaft.alpha = 1;
    rotor.shaft.beta = 2e-6;
    rotor.shaft.internal_damping = 3e-6;
    const double square = w * w;
    for (const double speed : {0.5 * w, 1.5 * w, 3 * w}) {
        const Complex b = rotor.shaft.alpha + 5e-6 * square;
        const Complex c = square - Complex(0, speed) * 3e-6 * square;
        const Complex root = std::sqrt(b * b - 4.0 * c);
        const Complex forward = (-b + root) / 2.0;
        for (const Form form : {Form::planar_damped, Form::general}) {
            const modes::Spectrum found = tests::spectrum_of(rotor, form, order, speed, 8);
            double nearest = 1e300;
            for (const modes::WhirlMode &mode : found.modes)
                nearest = std::min(nearest, std::abs(mode.eigenvalue - forward));
            EXPECT_LT(nearest, rounding * w) << results::form_name(form) << " " << speed;
        }
    }
}

TEST(ProportionalDamping, IsTheSameInEveryForm) {
    model::Rotor rotor = tests::two_disc_rotor(1e7, 1e7, 0, 500);
    rotor.shaft.alpha = 20;
    rotor.shaft.beta = 1e-5;
    const auto spectrum = [&rotor](Form form) {
        return modes::SpectrumSolver(rotor, form, 4).at(250, 6).modes;
    };
    const std::vector<modes::WhirlMode> general = spectrum(Form::general);
    for (const Form form : {Form::planar_damped, Form::rotating}) {
        const std::vector<modes::WhirlMode> other = spectrum(form);
        ASSERT_EQ(other.size(), general.size());
        for (std::size_t i = 0; i < general.size(); ++i)
            EXPECT_LT(std::abs(other[i].eigenvalue - general[i].eigenvalue),
                      rounding * std::abs(general[i].eigenvalue));
    }
}

/// The response is solved as a whole and, for its error, element by element on a finer mesh.
TEST(ProportionalDamping, IsInTheResponseAndItsError) {
    for (const double asymmetry : {0.0, 0.2})
        for (const double kyy : {1e7, 2e7}) {
            if (asymmetry != 0 && kyy != 1e7)
                continue; // many frequencies: not computed
            model::Case scene;
            scene.rotor = tests::two_disc_rotor(1e7, kyy);
            scene.rotor.shaft.alpha = 20;
            scene.rotor.shaft.beta = 1e-5;
            for (model::Segment &segment : scene.rotor.shaft.segments) {
                segment.asymmetry = asymmetry;
                segment.asymmetry_angle = 0.3;
            }
            scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-4)};
            scene.speeds = model::SpeedRange{20, 400, 8};
            const auto result = analyses::unbalance_response(scene);
            for (const auto &node : result.nodes)
                for (const auto &error : node.error) // some 1e-5: damping in one mesh alone, 1e-2
                    EXPECT_LT(error, 1e-4) << asymmetry << " " << kyy;
        }
}

/// alpha on a rigid shaft of mass m is a damper of alpha m: l^2 m + alpha m l + k = 0.
TEST(ProportionalDamping, OfMassActsOnARigidShaft) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.05);
    rotor.shaft.rigid = true;
    rotor.shaft.alpha = 30;
    rotor.shaft.beta = 1e-3; // a rigid shaft is not strained
    rotor.bearings = {tests::bearing(0, 1e6, 1e6), tests::bearing(1, 1e6, 1e6)};
    const double mass = 7810 * std::numbers::pi / 4 * 0.05 * 0.05;
    const Complex value(-15, std::sqrt(2e6 / mass - 225));
    const modes::Spectrum found = tests::spectrum_of(rotor, Form::planar_damped, 1, 0, 4);
    double nearest = 1e300;
    for (const modes::WhirlMode &mode : found.modes)
        nearest = std::min(nearest, std::abs(mode.eigenvalue - value));
    EXPECT_LT(nearest, 1e-10 * std::abs(value));
}

/// The ratio of each undamped frequency at rest, and 0 of those beyond.
void expect_ratios(const model::Rotor &rotor, Form form, int order,
                   const std::vector<double> &frequencies, const std::vector<double> &ratios) {
    constexpr int rigid = 4; // of a free rotor
    const modes::Spectrum found =
        tests::spectrum_of(rotor, form, order, 0, static_cast<int>(2 * frequencies.size()) + rigid);
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        const double ratio = i < ratios.size() ? ratios[i] : 0;
        const Complex value = frequencies[i] * Complex(-ratio, std::sqrt(1 - ratio * ratio));
        double nearest = 1e300;
        for (const modes::WhirlMode &mode : found.modes)
            nearest = std::min(nearest, std::abs(mode.eigenvalue - value));
        EXPECT_LT(nearest, rounding * frequencies[i]) << results::form_name(form) << " " << i;
    }
}

TEST(ModalDamping, GivesTheModesAtRestExactlyTheirRatios) {
    const std::vector<double> ratios{0.01, 0.05, 0.02};
    const int order = 4;
    model::Rotor rotor = tests::two_disc_rotor(1e7, 1e7);
    const std::vector<double> both = undamped(rotor, order, 10); // each twice: x and y
    std::vector<double> w;
    for (std::size_t i = 0; i < both.size(); i += 2)
        w.push_back(both[i]);
    rotor.shaft.modal_damping = ratios;
    model::Case scene;
    scene.rotor = rotor;
    EXPECT_EQ(modes::choose_formulation(scene).form, Form::planar_damped);
    for (const Form form : {Form::planar_damped, Form::general})
        expect_ratios(rotor, form, order, w, ratios);
}

TEST(ModalDamping, CountsInEachPlane) {
    const std::vector<double> ratios{0.01, 0.05};
    const int order = 4;
    const model::Rotor of_x = tests::two_disc_rotor(1e7, 1e7);
    const model::Rotor of_y = tests::two_disc_rotor(2.5e7, 2.5e7);
    model::Rotor rotor = tests::two_disc_rotor(1e7, 2.5e7);
    rotor.shaft.modal_damping = ratios;
    for (const model::Rotor &plane : {of_x, of_y}) { // at rest the planes do not see each other
        const std::vector<double> both = undamped(plane, order, 6);
        expect_ratios(rotor, Form::general, order, {both[0], both[2], both[4]}, ratios);
    }
}

TEST(ModalDamping, LeavesOutMotionsThatStrainNothing) {
    model::Rotor rotor = tests::uniform_shaft(1.2, 0.04);
    const std::vector<double> w = undamped(rotor, 8, 8);
    rotor.shaft.modal_damping = {0.03, 0.01};
    expect_ratios(rotor, Form::planar_damped, 8, {w[4], w[6]}, {0.03, 0.01});
}

TEST(ModalDamping, IsInTheResponse) {
    // At the undamped resonance at rest of a slender, slow rotor the gyroscopic share is small, but
    // the same in both: general and planar form, and error by a finer mesh with its own modes.
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e7, 1e7);
    scene.rotor.shaft.modal_damping = {0.02, 0.03, 0.01, 0.01};
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-4)};
    scene.speeds = model::SpeedRange{20, 200, 6};
    const auto planar = analyses::unbalance_response(scene);
    scene.formulation = model::FormChoice::general;
    const auto general = analyses::unbalance_response(scene);
    for (std::size_t n = 0; n < planar.nodes.size(); ++n)
        for (std::size_t i = 0; i < planar.speeds.size(); ++i) {
            EXPECT_NEAR(planar.nodes[n].major[i] / general.nodes[n].major[i], 1, 1e-8);
            EXPECT_LT(planar.nodes[n].error[i], 1e-5); // order 4 against 8
        }
}

TEST(ModalDamping, WantsNoMoreRatiosThanModes) {
    model::Rotor rotor = tests::RigidJeffcott().scene().rotor;
    rotor.shaft.modal_damping = {0.1, 0.1, 0.1};
    EXPECT_THROW((void)tests::spectrum_of(rotor, Form::planar_damped, 1, 0, 2), model::BadInput);
}

} // namespace
