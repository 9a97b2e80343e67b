// Units as engineers write them, in the United States, Germany, France, Japan and Russia: what each
// spelling is worth, from the definitions of the units, or what the program answers. Nothing of it
// comes from UDUNITS-2.

#include "input/units.h"

#include <gtest/gtest.h>

#include <numbers>

namespace whirl::tests::unit_spellings {
namespace {

using input::Quantity;

// Exact by definition: inch, foot (1959), pound, standard gravity; the rest follows.
constexpr double inch = 0.0254;           // m
constexpr double foot = 12 * inch;        // m
constexpr double pound = 0.45359237;      // kg
constexpr double g_n = 9.80665;           // m/s2
constexpr double lbf = pound * g_n;       // N
constexpr double ounce = pound / 16;      // kg
constexpr double kgf = g_n;               // N
constexpr double dyne = 1e-5;             // N
constexpr double psi = lbf / inch / inch; // Pa
constexpr double slug = lbf / foot;       // kg
constexpr double grain = pound / 7000;    // kg
constexpr double rpm = std::numbers::pi / 30;
constexpr double turn = 2 * std::numbers::pi;
constexpr double deg = std::numbers::pi / 180;

struct Understood {
    Quantity quantity;
    const char *text;
    double value;
};

const std::vector<Understood> understood{
    // --- lengths
    {Quantity::length, "50 mm", 0.05},
    {Quantity::length, "50mm", 0.05},
    {Quantity::length, "50 мм", 0.05},
    {Quantity::length, "5 см", 0.05},
    {Quantity::length, "50 ㎜", 0.05},
    {Quantity::length, "50\u00a0mm", 0.05},
    {Quantity::length, "\u22125 mm", -0.005},
    {Quantity::length, "2 in", 2 * inch},
    {Quantity::length, "2 in.", 2 * inch},
    {Quantity::length, "2 inch", 2 * inch},
    {Quantity::length, "2 inches", 2 * inch},
    {Quantity::length, "2 Zoll", 2 * inch},
    {Quantity::length, "2 pouces", 2 * inch},
    {Quantity::length, "3 ft", 3 * foot},
    {Quantity::length, "3 feet", 3 * foot},
    {Quantity::length, "5 mil", 5e-3 * inch},
    {Quantity::length, "5 mils", 5e-3 * inch},
    {Quantity::length, "5 thou", 5e-3 * inch},
    {Quantity::length, "20 um", 20e-6},
    {Quantity::length, "20 µm", 20e-6},      // U+00B5
    {Quantity::length, "20 \u03bcm", 20e-6}, // the Greek letter
    {Quantity::length, "20 мкм", 20e-6},
    {Quantity::length, "20 microns", 20e-6},
    // --- masses
    {Quantity::mass, "5 kg", 5},
    {Quantity::mass, "5 кг", 5},
    {Quantity::mass, "5 Kg", 5},
    {Quantity::mass, "5 gm", 0.005},
    {Quantity::mass, "5 t", 5000},
    {Quantity::mass, "3 lb", 3 * pound},
    {Quantity::mass, "3 lbs", 3 * pound},
    {Quantity::mass, "3 lbs.", 3 * pound},
    {Quantity::mass, "3 lbm", 3 * pound},
    {Quantity::mass, "3 pounds", 3 * pound},
    {Quantity::mass, "3 oz", 3 * ounce},
    {Quantity::mass, "3 slugs", 3 * slug},
    {Quantity::mass, "3 lbf-s2/in", 3 * lbf / inch},
    {Quantity::mass, "3 lb-s^2/in", 3 * lbf / inch},
    {Quantity::mass, "3 kgf s2/m", 3 * kgf},
    // --- inertias
    {Quantity::inertia, "2 kg m2", 2},
    {Quantity::inertia, "2 kg·m²", 2},
    {Quantity::inertia, "2 kg⋅m^2", 2},
    {Quantity::inertia, "2 kg-m**2", 2},
    {Quantity::inertia, "2 кг·м²", 2},
    {Quantity::inertia, "2 g mm2", 2e-9},
    {Quantity::inertia, "2 lb in2", 2 * pound *inch *inch},
    {Quantity::inertia, "2 lbm-in^2", 2 * pound *inch *inch},
    {Quantity::inertia, "2 lb-ft2", 2 * pound *foot *foot},
    {Quantity::inertia, "2 lb-in-s2", 2 * lbf *inch},
    {Quantity::inertia, "2 lb-in-sec^2", 2 * lbf *inch},
    {Quantity::inertia, "2 lbf·in·s²", 2 * lbf *inch},
    {Quantity::inertia, "2 slug-ft2", 2 * slug *foot *foot},
    {Quantity::inertia, "2 kgf cm s2", 2 * kgf * 0.01},
    // --- stiffnesses
    {Quantity::stiffness, "3 N/m", 3},
    {Quantity::stiffness, "3 Н/м", 3},
    {Quantity::stiffness, "3 N·m⁻¹", 3},
    {Quantity::stiffness, "3 N m-1", 3},
    {Quantity::stiffness, "3 kN/mm", 3e6},
    {Quantity::stiffness, "3 N/µm", 3e6},
    {Quantity::stiffness, "3 MN/m", 3e6},
    {Quantity::stiffness, "3 daN/mm", 3e4},
    {Quantity::stiffness, "3 lb/in", 3 * lbf / inch},
    {Quantity::stiffness, "3 lbs/in", 3 * lbf / inch},
    {Quantity::stiffness, "3 lbf/in", 3 * lbf / inch},
    {Quantity::stiffness, "3 lb/in.", 3 * lbf / inch},
    {Quantity::stiffness, "3 pound/inch", 3 * lbf / inch},
    {Quantity::stiffness, "3 pounds per inch", 3 * lbf / inch},
    {Quantity::stiffness, "3 kip/in", 3e3 * lbf / inch},
    {Quantity::stiffness, "3 klb/in", 3e3 * lbf / inch},
    {Quantity::stiffness, "3 klbf/in", 3e3 * lbf / inch},
    {Quantity::stiffness, "3 lb/mil", 3e3 * lbf / inch},
    {Quantity::stiffness, "3 oz/in", 3 * ounce *g_n / inch},
    {Quantity::stiffness, "3 kgf/mm", 3e3 * kgf},
    {Quantity::stiffness, "3 kp/mm", 3e3 * kgf},
    {Quantity::stiffness, "3 кгс/мм", 3e3 * kgf},
    {Quantity::stiffness, "3 тс/м", 3e3 * kgf},
    {Quantity::stiffness, "3 tf/m", 3e3 * kgf},
    {Quantity::stiffness, "3 dyn/cm", 3e2 * dyne},
    {Quantity::stiffness, "3 dyne/cm", 3e2 * dyne},
    // --- damping
    {Quantity::damping, "4 N s/m", 4},
    {Quantity::damping, "4 Ns/m", 4},
    {Quantity::damping, "4 N·s/m", 4},
    {Quantity::damping, "4 N*s/mm", 4e3},
    {Quantity::damping, "4 kN-s/m", 4e3},
    {Quantity::damping, "4 Н·с/м", 4},
    {Quantity::damping, "4 kg/s", 4},
    {Quantity::damping, "4 lb s/in", 4 * lbf / inch},
    {Quantity::damping, "4 lbf-s/in", 4 * lbf / inch},
    {Quantity::damping, "4 lb-sec/in", 4 * lbf / inch},
    {Quantity::damping, "4 kgf·s/mm", 4e3 * kgf},
    {Quantity::damping, "4 kgf sec/cm", 4e2 * kgf},
    {Quantity::damping, "4 dyn s/cm", 4e2 * dyne},
    // --- against tilting
    {Quantity::tilt_stiffness, "5 Nm/rad", 5},
    {Quantity::tilt_stiffness, "5 Nmm/rad", 5e-3},
    {Quantity::tilt_stiffness, "5 N·m", 5},
    {Quantity::tilt_stiffness, "5 N m/deg", 5 / deg},
    {Quantity::tilt_stiffness, "5 in-lb/rad", 5 * lbf *inch},
    {Quantity::tilt_stiffness, "5 ft-lbf/deg", 5 * lbf *foot / deg},
    {Quantity::tilt_damping, "5 Nms/rad", 5},
    {Quantity::tilt_damping, "5 in-lb-s/rad", 5 * lbf *inch},
    // --- pressures
    {Quantity::pressure, "210 GPa", 210e9},
    {Quantity::pressure, "210000 MPa", 210e9},
    {Quantity::pressure, "210 ГПа", 210e9},
    {Quantity::pressure, "2.1e5 N/mm2", 210e9},
    {Quantity::pressure, "2.1e5 N/mm²", 210e9},
    {Quantity::pressure, "210 kN/mm2", 210e9},
    {Quantity::pressure, "2.1e4 daN/mm2", 210e9},
    {Quantity::pressure, "21000 hbar", 210e9},
    {Quantity::pressure, "2.1e12 dyn/cm2", 210e9},
    {Quantity::pressure, "30 Msi", 30e6 * psi},
    {Quantity::pressure, "30 Mpsi", 30e6 * psi},
    {Quantity::pressure, "30e6 psi", 30e6 * psi},
    {Quantity::pressure, "30000 ksi", 30e6 * psi},
    {Quantity::pressure, "30e6 lb/in2", 30e6 * psi},
    {Quantity::pressure, "30e6 lbf/in^2", 30e6 * psi},
    {Quantity::pressure, "30e6 lb/sq.in.", 30e6 * psi},
    {Quantity::pressure, "21000 kgf/mm2", 21e3 * kgf * 1e6},
    {Quantity::pressure, "2.1e6 kgf/cm²", 21e3 * kgf * 1e6},
    {Quantity::pressure, "2.1e6 кгс/см²", 21e3 * kgf * 1e6},
    // --- densities
    {Quantity::density, "7850 kg/m3", 7850},
    {Quantity::density, "7850 kg m-3", 7850},
    {Quantity::density, "7.85 g/cm³", 7850},
    {Quantity::density, "7.85 г/см3", 7850},
    {Quantity::density, "7.85 g/cc", 7850},
    {Quantity::density, "7.85 kg/dm3", 7850},
    {Quantity::density, "7.85e-9 t/mm3", 7850},
    {Quantity::density, "0.284 lb/in3", 0.284 * pound / (inch * inch * inch)},
    {Quantity::density, "0.284 lbs/cu.in.", 0.284 * pound / (inch * inch * inch)},
    {Quantity::density, "490 lb/ft^3", 490 * pound / (foot * foot * foot)},
    {Quantity::density, "7.35e-4 lbf s2/in4", 7.35e-4 * lbf / (inch * inch * inch * inch)},
    {Quantity::density, "15.2 slug/ft3", 15.2 * slug / (foot * foot * foot)},
    // --- angles
    {Quantity::angle, "30 deg", 30 * deg},
    {Quantity::angle, "30°", 30 * deg},
    {Quantity::angle, "30 º", 30 * deg}, // the ordinal sign of a Spanish keyboard
    {Quantity::angle, "30 град", 30 * deg},
    {Quantity::angle, "30 gon", 30 * turn / 400},
    {Quantity::angle, "30'", 0.5 * deg},
    {Quantity::angle, "0.5 rev", turn / 2},
    // --- angular speeds
    {Quantity::speed, "3000 rpm", 3000 * rpm},
    {Quantity::speed, "3000 RPM", 3000 * rpm},
    {Quantity::speed, "3000 r.p.m.", 3000 * rpm},
    {Quantity::speed, "3 krpm", 3000 * rpm},
    {Quantity::speed, "3000 rev/min", 3000 * rpm},
    {Quantity::speed, "3000 r/min", 3000 * rpm},
    {Quantity::speed, "3000 tr/min", 3000 * rpm},
    {Quantity::speed, "3000 tours/mn", 3000 * rpm},
    {Quantity::speed, "3000 U/min", 3000 * rpm},
    {Quantity::speed, "3000 Umdr./min", 3000 * rpm},
    {Quantity::speed, "3000 Upm", 3000 * rpm},
    {Quantity::speed, "3000 min⁻¹", 3000 * rpm},
    {Quantity::speed, "3000 min-1", 3000 * rpm},
    {Quantity::speed, "3000 1/min", 3000 * rpm},
    {Quantity::speed, "3000 об/мин", 3000 * rpm},
    {Quantity::speed, "3000 мин⁻¹", 3000 * rpm},
    {Quantity::speed, "3000 回転/分", 3000 * rpm},
    {Quantity::speed, "3000 cpm", 3000 * rpm},
    {Quantity::speed, "50 tr/s", 50 * turn},
    {Quantity::speed, "50 rev/sec", 50 * turn},
    {Quantity::speed, "50 об/с", 50 * turn},
    {Quantity::speed, "50 rps", 50 * turn},
    {Quantity::speed, "50 cps", 50 * turn},
    {Quantity::speed, "50 Hz", 50 * turn},
    {Quantity::speed, "50 Гц", 50 * turn},
    {Quantity::speed, "314 rad/s", 314},
    {Quantity::speed, "314 rad/sec", 314},
    {Quantity::speed, "314 rad·s⁻¹", 314},
    {Quantity::speed, "314 рад/с", 314},
    {Quantity::speed, "180 °/s", 180 * deg},
    // --- times, forces, torques, accelerations, rates
    {Quantity::time, "5 ms", 0.005},
    {Quantity::time, "5 msec", 0.005},
    {Quantity::time, "5 mins", 300},
    {Quantity::time, "5 мс", 0.005},
    {Quantity::force, "6 lb", 6 * lbf},
    {Quantity::force, "6 lbs", 6 * lbf},
    {Quantity::force, "6 kp", 6 * kgf},
    {Quantity::force, "6 кгс", 6 * kgf},
    {Quantity::force, "6 daN", 60},
    {Quantity::force, "6 kips", 6e3 * lbf},
    {Quantity::moment, "6 Nm", 6},
    {Quantity::moment, "6 N-m", 6},
    {Quantity::moment, "6 ft-lb", 6 * lbf *foot},
    {Quantity::moment, "6 in-lbs", 6 * lbf *inch},
    {Quantity::moment, "6 oz-in", 6 * ounce *g_n *inch},
    {Quantity::moment, "6 kgf-m", 6 * kgf},
    {Quantity::velocity, "4.5 mm/s", 4.5e-3},
    {Quantity::velocity, "0.18 in/s", 0.18 * inch},
    {Quantity::velocity, "2.8 mm/sec", 2.8e-3},
    {Quantity::acceleration, "9.81 m/s²", 9.81},
    {Quantity::acceleration, "9.81 м/с²", 9.81},
    {Quantity::acceleration, "386 in/sec^2", 386 * inch},
    {Quantity::acceleration, "2 g", 2 * g_n},
    {Quantity::rate, "5 1/s", 5},
    {Quantity::rate, "5 s^-1", 5},
    // --- imbalances
    {Quantity::imbalance, "50 g mm", 50e-6},
    {Quantity::imbalance, "50 g·mm", 50e-6},
    {Quantity::imbalance, "50 g-mm", 50e-6},
    {Quantity::imbalance, "50 gm-mm", 50e-6},
    {Quantity::imbalance, "50 g×mm", 50e-6},
    {Quantity::imbalance, "5 г·см", 50e-6},
    {Quantity::imbalance, "3 oz in", 3 * ounce *inch},
    {Quantity::imbalance, "3 oz-in", 3 * ounce *inch},
    {Quantity::imbalance, "3 oz.-in.", 3 * ounce *inch},
    {Quantity::imbalance, "3 ounce-inches", 3 * ounce *inch},
    {Quantity::imbalance, "3 g in", 3e-3 * inch},
    {Quantity::imbalance, "50 grain mm", 50 * grain * 1e-3},
};

TEST(UnitSpellings, AreWorthWhatTheirUnitsAreByDefinition) {
    // UDUNITS-2 has the grain to seven digits; the others are exact but for some roundings.
    for (const auto &[quantity, text, value] : understood) {
        const auto read = input::parse_quantity(text, quantity);
        ASSERT_TRUE(read) << text << " as " << input::describe(quantity);
        const double tolerance =
            std::string_view(text).find("grain") != std::string_view::npos ? 1e-7 : 4e-15;
        EXPECT_NEAR(*read / value, 1, tolerance) << text << " as " << input::describe(quantity);
    }
}

struct Answered {
    Quantity quantity;
    const char *text;
    const char *hint; ///< a part of it
};

const std::vector<Answered> answered{
    // --- more than one number and one unit
    {Quantity::length, "2 1/2 in", "did you mean \"2.5 in\"?"},
    {Quantity::length, "2-1/2 in", "did you mean \"2.5 in\"?"},
    {Quantity::length, "2½ in", "did you mean \"2.5 in\"?"},
    {Quantity::length, "1/2 in", "did you mean \"0.5 in\"?"},
    {Quantity::length, "-3 1/4 in", "did you mean \"-3.25 in\"?"},
    {Quantity::length, "3 ft 11", "did you mean \"47 in\"?"},
    {Quantity::length, "3 ft 11 in", "did you mean \"47 in\"?"},
    {Quantity::length, "3' 11\"", "did you mean \"47 in\"?"},
    {Quantity::length, "3'-11\"", "did you mean \"47 in\"?"},
    {Quantity::length, "1 m 20 cm", "did you mean \"120 cm\"?"},
    {Quantity::length, "50 mm 2", "one number and one unit, as \"50 mm\""},
    {Quantity::length, "50 mm +/- 0.1", "one number and one unit, as \"50 mm\""},
    {Quantity::length, "10-20 mm", "one number and one unit"},
    {Quantity::length, "5·2 mm", "one number and one unit"},
    {Quantity::mass, "5 lb 4 oz", "did you mean \"84 oz\"?"},
    {Quantity::time, "1 h 30 min", "did you mean \"90 min\"?"},
    {Quantity::stiffness, "5 10^6 N/m", "did you mean \"5e6 N/m\"?"},
    {Quantity::stiffness, "5 x 10^6 N/m", "did you mean \"5e6 N/m\"?"},
    {Quantity::stiffness, "5·10⁶ N/m", "did you mean \"5e6 N/m\"?"},
    {Quantity::stiffness, "5*10**-6 N/m", "did you mean \"5e-6 N/m\"?"},
    {Quantity::stiffness, "5D6 N/m", "did you mean \"5e6 N/m\"?"},
    // --- signs of decimals and thousands
    {Quantity::length, "12,5 mm", "write the decimal point as \".\""},
    {Quantity::speed, "12,000 rpm", "write \"12000 rpm\", or \"12.000 rpm\" if the comma"},
    {Quantity::speed, "12 000 rpm", "write \"12000 rpm\""},
    {Quantity::speed, "12'000 rpm", "write \"12000 rpm\""},
    {Quantity::speed, "1.200,5 rpm", "write \"1200.5 rpm\""},
    {Quantity::speed, "1,200.5 rpm", "write \"1200.5 rpm\""},
    // --- words of two meanings
    {Quantity::imbalance, "50 gr mm", "\"gr\" may be a gram or a grain"},
    {Quantity::density, "7.85 gr/cm3", "\"gr\" may be a gram or a grain"},
    {Quantity::mass, "2 ton", "\"ton\" may be 1000 kg, 2000 lb or 2240 lb"},
    {Quantity::angle, "30 grad", "write \"deg\" or \"gon\""},
    {Quantity::speed, "50 r/s", "write \"rad\" or \"rev\""},
    {Quantity::speed, "50 1/s", "write \"rad/s\" or \"rev/s\""},
    {Quantity::speed, "50 s⁻¹", "write \"rad/s\" or \"rev/s\""},
    {Quantity::rate, "5 Hz", "write \"1/s\""},
    {Quantity::length, "50 Mm", "write \"mm\""},
    {Quantity::length, "50 µ", "write \"um\""},
    {Quantity::time, "5 Ms", "write \"ms\""},
    // --- a mass where a force is meant
    {Quantity::stiffness, "3 kg/mm", "did you mean \"3 kgf/mm\"?"},
    {Quantity::pressure, "21000 kg/mm2", "did you mean \"21000 kgf/mm2\"?"},
    {Quantity::force, "6 kg", "did you mean \"6 kgf\"?"},
    {Quantity::mass, "6 lbf", "did you mean \"6 lb\"?"},
    // --- letters and blanks
    {Quantity::length, "50 MM", "did you mean \"50 mm\"?"},
    {Quantity::pressure, "210 GPA", "did you mean \"210 GPa\"?"},
    {Quantity::pressure, "210 Mpa", "did you mean \"210 MPa\"?"},
    {Quantity::stiffness, "3 kn/m", "did you mean \"3 kN/m\"?"},
    {Quantity::moment, "6 nm", "did you mean \"6 Nm\"?"},
    {Quantity::mass, "5 KG", "did you mean \"5 kg\"?"},
    {Quantity::imbalance, "50 gmm", "did you mean \"50 g mm\"?"},
    {Quantity::imbalance, "50 kgm", "did you mean \"50 kg m\"?"},
    {Quantity::imbalance, "3 ozin", "did you mean \"3 oz in\"?"},
    {Quantity::inertia, "2 kgm2", "did you mean \"2 kg m2\"?"},
    {Quantity::moment, "6 Ncm", "did you mean \"6 N cm\"?"},
    {Quantity::length, "5'", "did you mean \"5 ft\"?"},
    {Quantity::length, "5\"", "did you mean \"5 in\"?"},
    {Quantity::angle, "0.5 pi", "did you mean \"0.5 pi rad\"?"},
    {Quantity::speed, "3000 rmp", "did you mean \"rpm\"?"},
};

TEST(UnitSpellings, OthersAreAnsweredWithWhatIsMeant) {
    for (const auto &[quantity, text, hint] : answered) {
        EXPECT_FALSE(input::parse_quantity(text, quantity))
            << text << " as " << input::describe(quantity);
        const std::string said = input::quantity_hint(text, quantity);
        EXPECT_NE(said.find(hint), std::string::npos) << text << ": " << said;
    }
    EXPECT_GE(understood.size() + answered.size(), 150U);
}

/// What a hint proposes is a quantity of its kind.
TEST(UnitSpellings, HintsCanBeTakenAsTheyAre) {
    for (const auto &[quantity, text, hint] : answered) {
        const std::string said = input::quantity_hint(text, quantity);
        const std::string question = "did you mean \"";
        const std::size_t at = said.find(question);
        if (at == std::string::npos)
            continue;
        std::string meant = said.substr(at + question.size());
        meant = meant.substr(0, meant.find('"'));
        EXPECT_TRUE(input::parse_quantity(meant, quantity) || input::unit_factor(meant, quantity))
            << text << ": " << said;
    }
}

/// Two numbers never multiply, whatever stands between and behind them.
TEST(UnitSpellings, NoSecondNumberIsRead) {
    for (const char *between : {" ", ".", "*", "·", "-", "/", " x ", "+", " m "})
        for (const char *unit : {"mm", " mm", "", "*mm", "/mm"})
            for (const int second : {2, 12, 1}) {
                const std::string text =
                    "50 mm" + std::string(between) + std::to_string(second) + unit;
                EXPECT_FALSE(input::parse_quantity(text, Quantity::length)) << text;
            }
}

TEST(UnitSpellings, LongTextsAreRefused) {
    std::string words = "1 kg";
    for (int i = 0; i < 2000; ++i)
        words += " kg";
    EXPECT_FALSE(input::parse_quantity(words, Quantity::mass));
    EXPECT_EQ(input::quantity_hint(words, Quantity::mass), "");
    EXPECT_FALSE(input::unit_factor(words.substr(2), Quantity::mass));
    EXPECT_FALSE(input::parse_quantity("1 " + std::string(100, '(') + "m" + std::string(100, ')'),
                                       Quantity::length));
}

} // namespace
} // namespace whirl::tests::unit_spellings
