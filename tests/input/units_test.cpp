#include "input/units.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace whirl::input {
namespace {

struct Known {
    const char *text;
    Quantity quantity;
    double value;
};

// Definitions: 1 in = 0.0254 m, 1 lb = 0.45359237 kg, standard gravity 9.80665 m/s2 (all exact).
constexpr double pi = std::numbers::pi;
constexpr double lbf = 0.45359237 * 9.80665;
const std::vector<Known> known{{"25 mm", Quantity::length, 0.025},
                               {"25mm", Quantity::length, 0.025},
                               {" +2.5e1 mm ", Quantity::length, 0.025},
                               {"1 in", Quantity::length, 0.0254},
                               {"3 thou", Quantity::length, 3 * 0.0254e-3},
                               {"0.5", Quantity::length, 0.5},
                               {"2 lbm", Quantity::mass, 2 * 0.45359237},
                               {"3 lb in2", Quantity::inertia, 3 * 0.45359237 * 0.0254 * 0.0254},
                               {"1e5 lbf/in", Quantity::stiffness, 1e5 * lbf / 0.0254},
                               {"1e5 lb/in", Quantity::stiffness, 1e5 * lbf / 0.0254},
                               {"2 lb s/in", Quantity::damping, 2 * lbf / 0.0254},
                               {"3 oz in", Quantity::imbalance, 3 * 0.45359237 / 16 * 0.0254},
                               {"50 hz", Quantity::speed, 100 * pi},
                               {"30 cpm", Quantity::speed, pi},
                               {"20 N/um", Quantity::stiffness, 2e7},
                               {"2 lbf s/in", Quantity::damping, 2 * lbf / 0.0254},
                               {"3 N*s/mm", Quantity::damping, 3000},
                               {"5 kN m/rad", Quantity::tilt_stiffness, 5000},
                               {"5 kNm", Quantity::tilt_stiffness, 5000},
                               {"5 N m/deg", Quantity::tilt_stiffness, 5 * 180 / pi},
                               {"2 Nm s/rad", Quantity::tilt_damping, 2},
                               {"211 GPa", Quantity::pressure, 211e9},
                               {"30 Mpsi", Quantity::pressure, 30e6 * lbf / (0.0254 * 0.0254)},
                               {"7.8 g/cm3", Quantity::density, 7800},
                               {"30 deg", Quantity::angle, pi / 6},
                               {"90°", Quantity::angle, pi / 2},
                               {"12000 rpm", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 RPM", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 rev/min", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 1/min", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 min-1", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 min^-1", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 U/min", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 r/min", Quantity::speed, 12000 * 2 * pi / 60},
                               {"12000 /min", Quantity::speed, 12000 * 2 * pi / 60},
                               {"50 Hz", Quantity::speed, 100 * pi},
                               {"1 kHz", Quantity::speed, 2000 * pi},
                               {"7 rad/s", Quantity::speed, 7},
                               {"2 min", Quantity::time, 120},
                               {"5 ms", Quantity::time, 0.005},
                               {"-2 kN", Quantity::force, -2000},
                               {"37.2 g mm", Quantity::imbalance, 37.2e-6},
                               {"5 %", Quantity::number, 0.05}};

TEST(Units, KnownValues) {
    // Three roundings (number, factor, product) stay below 1e-15.
    for (const Known &entry : known) {
        const auto value = parse_quantity(entry.text, entry.quantity);
        ASSERT_TRUE(value) << entry.text;
        EXPECT_NEAR(*value / entry.value, 1, 1e-15) << entry.text;
    }
}

TEST(Units, RefusedTexts) {
    const std::vector<std::pair<const char *, Quantity>> wrong{{"5 kg", Quantity::stiffness},
                                                               {"5 N/m", Quantity::tilt_stiffness},
                                                               {"5 N m/rad", Quantity::stiffness},
                                                               {"5 N/rad", Quantity::force},
                                                               {"100 1/s", Quantity::speed},
                                                               {"100 s-1", Quantity::speed},
                                                               {"3 m/m", Quantity::angle},
                                                               {"5 rad", Quantity::number},
                                                               {"25 banana", Quantity::length},
                                                               {"mm", Quantity::length},
                                                               {"", Quantity::length},
                                                               {"2 5 mm", Quantity::length},
                                                               {"12,000 rpm", Quantity::speed},
                                                               {"nan", Quantity::length},
                                                               {"inf m", Quantity::length},
                                                               {"1e400", Quantity::length},
                                                               {"1e308 km", Quantity::length},
                                                               {"0x10", Quantity::length},
                                                               {"1 lg(re 1 m)", Quantity::length},
                                                               {"+-3", Quantity::length},
                                                               {"3 Hz", Quantity::time}};
    for (const auto &[text, quantity] : wrong)
        EXPECT_FALSE(parse_quantity(text, quantity)) << text << " as " << describe(quantity);
}

TEST(Units, DecimalPrefixesAreExactlyRounded) {
    // 36 * 0.001 is 0.036000000000000004; a case in mm must be the same case in m.
    EXPECT_EQ(*parse_quantity("36 mm", Quantity::length), 0.036);
    for (int i = 1; i < 1000; ++i)
        EXPECT_EQ(*parse_quantity(std::to_string(i) + " mm", Quantity::length), i / 1000.0) << i;
    EXPECT_EQ(*parse_quantity("7.81 g/cm3", Quantity::density), 7810.0);
    EXPECT_EQ(scaled(3, 0.5), 1.5);
    EXPECT_EQ(scaled(3, 0.3), 3 * 0.3);
}

TEST(Units, CommonOnesAreThoseOfTheDatabase) {
    struct Same {
        const char *common;
        const char *in_full; ///< which the database alone knows
        Quantity quantity;
    };
    const std::vector<Same> same{
        {"rpm", "turn/min", Quantity::speed},   {"rad/s", "radian/second", Quantity::speed},
        {"deg", "degree", Quantity::angle},     {"m", "meter", Quantity::length},
        {"cm", "centimeter", Quantity::length}, {"mm", "millimeter", Quantity::length},
        {"g", "gram", Quantity::mass},          {"g mm", "gram millimeter", Quantity::imbalance}};
    for (const auto &[common, in_full, quantity] : same)
        EXPECT_EQ(unit_factor(common, quantity), unit_factor(in_full, quantity)) << common;
    EXPECT_FALSE(unit_factor("rpm", Quantity::length));
    EXPECT_FALSE(unit_factor("m", Quantity::angle));
}

} // namespace
} // namespace whirl::input
