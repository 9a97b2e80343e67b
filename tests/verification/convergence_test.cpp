// How fast elements converge: measured orders, and unknowns against digits.

#include "results/formulation.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using results::Form;

/// First six whirl speeds of example 5.9.1 at 4000 rpm, exact.
const std::vector<double> exact_591{85.389371234,  87.795757223,  251.780522966,
                                    294.705832592, 600.081288407, 826.656769092};

/// Relative errors of the first six whirl speeds.
std::vector<double> errors_591(Form form, int order, int refinement) {
    const auto found = tests::frequencies(tests::spectrum_of(
        tests::two_disc_rotor(1e6, 1e6), form, order, 4000 * tests::rpm, 6, refinement));
    std::vector<double> errors;
    for (std::size_t i = 0; i < exact_591.size(); ++i)
        errors.push_back(found.at(i) / exact_591[i] - 1);
    return errors;
}

double largest_of(const std::vector<double> &errors) {
    double largest = 0;
    for (const double error : errors)
        largest = std::max(largest, std::abs(error));
    return largest;
}

TEST(Convergence, ClassicalElementIsOfOrderTwo) {
    // Its constant shear strain leaves h^2; on coarser meshes the h^4 of bending still shows.
    for (const Form form : {Form::planar, Form::general}) {
        std::vector<double> coarse = errors_591(form, 1, 8);
        for (const int refinement : {16, 32}) {
            const std::vector<double> fine = errors_591(form, 1, refinement);
            for (std::size_t i = 0; i < fine.size(); ++i) {
                const double rate = std::log2(std::abs(coarse[i] / fine[i]));
                EXPECT_NEAR(rate, 2, 0.2) << "mode " << i << ", refinement " << refinement;
            }
            coarse = fine;
        }
    }
}

TEST(Convergence, FortyEightClassicalElementsKeepFiveToSixDigits) {
    // At most 5e-6 in the first modes, measured with an independent program.
    const double largest = largest_of(errors_591(Form::planar, 1, 16));
    EXPECT_GT(largest, 1e-7);
    EXPECT_LT(largest, 6e-6);
}

TEST(Convergence, OrderPIsOfOrderTwiceP) {
    // One halving in the four upper modes, whose errors stand far above the last digits of the
    // reference.
    for (const int p : {2, 3}) {
        const std::vector<double> coarse = errors_591(Form::planar, p, p == 2 ? 4 : 2);
        const std::vector<double> fine = errors_591(Form::planar, p, p == 2 ? 8 : 4);
        for (std::size_t i = 2; i < 6; ++i)
            EXPECT_NEAR(std::log2(std::abs(coarse[i] / fine[i])), 2 * p, 0.1) << p << " " << i;
    }
}

TEST(Convergence, ErrorsFallExponentiallyWithTheOrder) {
    double before = 1;
    for (const int p : {2, 3, 4, 5}) {
        const double largest = largest_of(errors_591(Form::planar, p, 1));
        EXPECT_LT(largest, 0.1 * before) << p;
        before = largest;
    }
    // From here on the ten digits of the masses in the reference show.
    EXPECT_LT(largest_of(errors_591(Form::planar, 7, 1)), 3e-10);
}

/// Friswell et al. (2010), example 5.9.10: diameter linear from 25 to 40 mm.
model::Rotor tapered_rotor() {
    model::Rotor rotor;
    rotor.shaft.segments = {tests::cylinder(1.5, 0.025)};
    rotor.shaft.segments[0].outer_end = 0.040;
    rotor.discs = {tests::disc(0.75, 15.33489914, 0.061946603, 0.119803900)};
    rotor.bearings = {tests::bearing(0, 1e7, 1e7, 0, 1e3), tests::bearing(1.5, 1e7, 1e7, 0, 1e3)};
    return rotor;
}

modes::Spectrum taper(int order, int refinement) {
    return tests::spectrum_of(tapered_rotor(), Form::general, order, 3000 * tests::rpm, 4,
                              refinement);
}

TEST(Taper, MeetsTheContinuumToItsPrintedDigits) {
    // Richardson extrapolation of 50, 100 and 200 slices of the continuum, Hz and 1/s.
    const std::vector<double> hertz{13.917863, 13.953344, 92.162020, 111.987588};
    const std::vector<double> real{-0.003347, -0.003393, -0.633847, -1.190123};
    const modes::Spectrum found = taper(8, 1);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(found.modes[i].eigenvalue.imag() / (2 * std::numbers::pi), hertz[i], 1e-6);
        EXPECT_NEAR(found.modes[i].eigenvalue.real(), real[i], 1e-6);
    }
}

TEST(Taper, OrderEightBeatsTheClassicalElementByFourDigitsAtEqualUnknowns) {
    // Order 8 on two spans has 36 unknowns a plane, as the classical element on 17 spans; it gets
    // 18. The reference, order 14 on four spans, must itself meet the continuum.
    const std::vector<double> reference = tests::frequencies(taper(14, 2));
    EXPECT_NEAR(reference[0] / (2 * std::numbers::pi), 13.917863, 6e-7);
    const std::vector<double> high = tests::frequencies(taper(8, 1));
    const std::vector<double> classical = tests::frequencies(taper(1, 9));
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_GT(std::abs(classical[i] - reference[i]), 1e4 * std::abs(high[i] - reference[i]))
            << i;
}

} // namespace
