// Whirl speeds of the rotors of Friswell, Penny, Garvey and Lees (2010), chapter 5, against the
// exact solution of the continuous equations (transfer matrices in 80-bit arithmetic), printed to
// 1e-9 rad/s. One element of order 10 a segment.

#include "results/formulation.h"
#include "results/whirl.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using results::Form;
using results::Whirl;
using Values = std::vector<std::complex<double>>;

struct Row {
    std::string name;
    model::Rotor rotor;
    Form form = Form::general; ///< the smallest one that fits
    double speed = 0;          ///< rad/s
    Values values;             ///< 1/s
};

void PrintTo(const Row &row, std::ostream *out) { *out << row.name; }

/// Undamped frequencies, each twice where the rotor is at rest.
Values undamped(const std::vector<double> &list, int copies = 1) {
    Values out;
    for (const double w : list)
        for (int i = 0; i < copies; ++i)
            out.emplace_back(0, w);
    return out;
}

model::Rotor overhung() { // 5.9.9
    model::Rotor rotor = tests::friswell_shaft();
    rotor.discs = {tests::disc(1.5, 51.52526111, 0.423580584, 0.805082205)};
    rotor.bearings = {tests::bearing(0, 1e7, 1e7), tests::bearing(1, 1e7, 1e7)};
    return rotor;
}

model::Rotor overhung_anisotropic() { // 6.8.1: nu = 0.3, 25 mm
    model::Rotor rotor = tests::friswell_shaft();
    for (model::Segment &segment : rotor.shaft.segments) {
        segment.outer_start = segment.outer_end = 0.025;
        segment.material.G = 211e9 / 2.6;
    }
    rotor.discs = {tests::disc(1.5, 15.3, 0.062, 0.120)};
    rotor.bearings = {tests::bearing(0, 1e7, 2e7), tests::bearing(1, 1e7, 2e7, 0, 6e4)};
    return rotor;
}

const std::vector<double> row_591{85.389371234,   87.795757223,  251.780522966,  294.705832592,
                                  600.081288407,  826.656769092, 1038.404205182, 1087.370266371,
                                  1506.532678585, 1961.833105133};

std::vector<Row> rows() {
    const double full = 4000 * tests::rpm;
    return {
        {"rest_591", tests::two_disc_rotor(1e6, 1e6), Form::planar, 0,
         undamped({86.658012966, 274.307101616, 716.563496678, 1065.441759970, 1681.792116588,
                   2370.084476467},
                  2)},
        {"turning_591", tests::two_disc_rotor(1e6, 1e6), Form::planar, full, undamped(row_591)},
        {"turning_592", tests::two_disc_rotor(1e6, 0.8e6), Form::hyperbolic, full,
         undamped({82.325386021, 86.863596420, 239.638609059, 287.242525983, 583.395771128,
                   806.498905095, 1017.968249296, 1074.485832445, 1495.347187987, 1957.205562876})},
        {"turning_594", tests::two_disc_rotor(1e6, 1e6, 5e5), Form::general, full,
         undamped({73.209787782, 92.915592723, 208.316360312, 312.188177352, 561.721073757,
                   840.193619676, 975.802970361, 1142.607470699})},
        {"rest_595",
         tests::two_disc_rotor(1e6, 1e6, 0, 3e3),
         Form::general,
         0,
         {{-4.423815931, 87.257832294},
          {-4.423815931, 87.257832294},
          {-78.234444264, 292.415405960},
          {-78.234444264, 292.415405960},
          {-566.247445994, 649.495679085},
          {-566.247445994, 649.495679085},
          {-657.041125857, 836.263249145},
          {-657.041125857, 836.263249145}}},
        {"rest_599", overhung(), Form::planar, 0,
         undamped({90.143011079, 630.501650602, 830.311450402, 1628.010635058, 2541.735624286}, 2)},
        {"turning_681",
         overhung_anisotropic(),
         Form::general,
         1000 * tests::rpm,
         {{-0.020340403, 42.292103490},
          {-0.028243441, 46.459606122},
          {-0.617589769, 391.753748903},
          {-1.357336104, 406.427970678}}},
    };
}

class ExactRow : public testing::TestWithParam<Row> {};

TEST_P(ExactRow, IsMetToTenDigits) {
    const Row &row = GetParam();
    const int wanted = static_cast<int>(row.values.size());
    const modes::Spectrum found = tests::spectrum_of(row.rotor, row.form, 10, row.speed, wanted);
    ASSERT_GE(found.modes.size(), row.values.size());
    for (std::size_t i = 0; i < row.values.size(); ++i) {
        const std::complex<double> l = found.modes[i].eigenvalue;
        const std::complex<double> exact = row.values[i];
        EXPECT_NEAR(l.imag(), exact.imag(), 1e-9 * exact.imag()) << i;
        // Real parts: seven digits, and what the printed digits of small ones leave.
        EXPECT_NEAR(l.real(), exact.real(), 1e-7 * std::abs(exact.real()) + 6e-10) << i;
    }
}

TEST_P(ExactRow, ErrorBoundsOfThePairsAreKeptAndSmall) {
    const Row &row = GetParam();
    const int wanted = static_cast<int>(row.values.size());
    for (const auto &mode : tests::spectrum_of(row.rotor, row.form, 10, row.speed, wanted).modes) {
        EXPECT_LT(mode.residual, 1e-9);
        EXPECT_GT(mode.rounding, 0);
        EXPECT_LT(mode.rounding, 1e-10);
    }
}

INSTANTIATE_TEST_SUITE_P(Friswell, ExactRow, testing::ValuesIn(rows()),
                         [](const auto &instance) { return instance.param.name; });

TEST(ThreeForms, GiveTheSameNumbersForAnIsotropicRotor) {
    const model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    for (const double speed : {0.0, 1000 * tests::rpm, 4000 * tests::rpm, -4000 * tests::rpm}) {
        const auto planar = tests::spectrum_of(rotor, Form::planar, 10, speed, 12);
        const auto hyperbolic = tests::spectrum_of(rotor, Form::hyperbolic, 10, speed, 12);
        const auto general = tests::spectrum_of(rotor, Form::general, 10, speed, 12);
        ASSERT_GE(planar.modes.size(), 12U);
        ASSERT_GE(hyperbolic.modes.size(), 12U);
        ASSERT_GE(general.modes.size(), 12U);
        for (std::size_t i = 0; i < 12; ++i) {
            const double w = planar.modes[i].eigenvalue.imag();
            EXPECT_NEAR(hyperbolic.modes[i].eigenvalue.imag(), w, 1e-10 * w) << speed << " " << i;
            EXPECT_NEAR(general.modes[i].eigenvalue.imag(), w, 1e-10 * w) << speed << " " << i;
            EXPECT_NEAR(general.modes[i].eigenvalue.real(), 0, 1e-10 * w) << speed << " " << i;
            if (speed != 0) {
                EXPECT_EQ(hyperbolic.modes[i].whirl, planar.modes[i].whirl) << speed << " " << i;
                EXPECT_EQ(general.modes[i].whirl, planar.modes[i].whirl) << speed << " " << i;
            }
        }
    }
}

TEST(WhirlDirection, IsAgainstTheSenseOfTheSpin) {
    // Gyroscopic moments raise forward and lower backward whirl: lower of each pair backward. With
    // the spin reversed the same rotor shows the same senses relative to it.
    const model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    for (const Form form : {Form::planar, Form::hyperbolic, Form::general}) {
        for (const double speed : {4000 * tests::rpm, -4000 * tests::rpm}) {
            const modes::SpectrumSolver solver(rotor, form, 8);
            const modes::Spectrum found = solver.at(speed, 6);
            for (std::size_t i = 0; i < 6; ++i) {
                EXPECT_NEAR(found.modes[i].eigenvalue.imag(), row_591[i], 1e-8 * row_591[i]);
                EXPECT_EQ(found.modes[i].whirl, i % 2 == 0 ? Whirl::backward : Whirl::forward)
                    << results::form_name(form) << " " << speed << " " << i;
                EXPECT_NEAR(found.modes[i].forward_fraction, i % 2 == 0 ? 0 : 1, 1e-8);
            }
        }
    }
}

TEST(WhirlDirection, OfAnisotropicBearingsIsMixedNearTheirOwnFrequencies) {
    // 5.9.3: bearings of 1e6 and 2e5 N/m hold the planes apart at low speed; six digits printed.
    const auto found = tests::spectrum_of(tests::two_disc_rotor(1e6, 0.2e6), Form::hyperbolic, 10,
                                          4000 * tests::rpm, 6);
    const std::vector<double> printed{53.692, 86.525, 140.457, 276.864, 494.831, 756.370};
    for (std::size_t i = 0; i < printed.size(); ++i) // computed with six classical elements
        EXPECT_NEAR(found.modes[i].eigenvalue.imag() / printed[i], 1, 1e-3) << i;
    const bool any_mixed = std::any_of(found.modes.begin(), found.modes.end(),
                                       [](const auto &mode) { return mode.whirl == Whirl::mixed; });
    EXPECT_TRUE(any_mixed); // Friswell et al. show this rotor for its mixed modes
}

} // namespace
