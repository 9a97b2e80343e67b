// Limits of standards, against their formulas by hand.

#include "operation/limits.h"

#include "model/rpm.h"

#include <gtest/gtest.h>

namespace limits_test {
namespace {

using namespace whirl;
using operation::pedestal_limits;
using operation::shaft_limits;
using results::Measure;

model::Operation up_to(double rpm) { return {0.5 * rpm / model::rpm, rpm / model::rpm}; }

TEST(VibrationLimits, OfShaftsByApi617) {
    model::Limits limits;
    limits.shaft_standard = model::ShaftStandard::api617;
    const auto limit = [&](double rpm) { return shaft_limits(limits, up_to(rpm)).at(0).value; };
    // Half of what stands for peak to peak: 25.4 um up to 12000 rpm, 25.4 sqrt(12000/N) above.
    EXPECT_DOUBLE_EQ(limit(3000), 12.7e-6);
    EXPECT_DOUBLE_EQ(limit(12000), 12.7e-6);
    EXPECT_NEAR(limit(48000), 6.35e-6, 1e-18);
    EXPECT_NEAR(limit(15000), 11.3592e-6, 1e-10); // 25.4 * 0.894427 / 2
}

TEST(VibrationLimits, OfShaftsByIso) {
    model::Limits limits;
    limits.shaft_standard = model::ShaftStandard::iso20816;
    const auto limit = [&](model::Zone zone, double rpm) {
        limits.zone = zone;
        return shaft_limits(limits, up_to(rpm)).at(0);
    };
    EXPECT_NEAR(limit(model::Zone::a_b, 3600).value, 40e-6, 1e-18); // 4800/60 = 80 um
    EXPECT_NEAR(limit(model::Zone::b_c, 3600).value, 75e-6, 1e-18);
    EXPECT_NEAR(limit(model::Zone::c_d, 3600).value, 110e-6, 1e-18);
    EXPECT_TRUE(limit(model::Zone::c_d, 30000).why.empty());
    EXPECT_FALSE(limit(model::Zone::c_d, 31000).why.empty());
    EXPECT_FALSE(limit(model::Zone::c_d, 200).why.empty()); // from 100 rpm on
}

TEST(VibrationLimits, OfPedestals) {
    model::Limits limits;
    limits.velocity = 4.5e-3;
    limits.velocity_reading = model::Reading::peak;
    EXPECT_EQ(pedestal_limits(limits, up_to(1500)).at(0).what, Measure::velocity);
    limits.velocity_reading = model::Reading::rms;
    EXPECT_EQ(pedestal_limits(limits, up_to(1500)).at(0).what, Measure::velocity_rms);
    limits.velocity.reset();
    const auto iso = [&](int group, bool flexible, model::Zone zone) {
        limits.pedestals = model::HousingClass{group, flexible};
        limits.zone = zone;
        const auto found = pedestal_limits(limits, up_to(1500));
        EXPECT_EQ(found.size(), 2U);
        EXPECT_EQ(found.at(1).what, Measure::amplitude_rms);
        return std::pair(1e3 * found.at(0).value, 1e6 * found.at(1).value);
    };
    using model::Zone;
    const auto expect = [](std::pair<double, double> found, double velocity, double displacement) {
        EXPECT_DOUBLE_EQ(found.first, velocity);
        EXPECT_DOUBLE_EQ(found.second, displacement);
    };
    expect(iso(1, false, Zone::a_b), 2.3, 29);
    expect(iso(1, false, Zone::b_c), 4.5, 57);
    expect(iso(1, false, Zone::c_d), 7.1, 90);
    expect(iso(1, true, Zone::a_b), 3.5, 45);
    expect(iso(1, true, Zone::b_c), 7.1, 90);
    expect(iso(1, true, Zone::c_d), 11, 140);
    expect(iso(2, false, Zone::a_b), 1.4, 22);
    expect(iso(2, false, Zone::b_c), 2.8, 45);
    expect(iso(2, false, Zone::c_d), 4.5, 71);
    expect(iso(2, true, Zone::a_b), 2.3, 37);
    expect(iso(2, true, Zone::b_c), 4.5, 71);
    expect(iso(2, true, Zone::c_d), 7.1, 113);
}

TEST(VibrationLimits, NoneAsNoneIsGiven) {
    EXPECT_TRUE(shaft_limits({}, up_to(1500)).empty());
    EXPECT_TRUE(pedestal_limits({}, up_to(1500)).empty());
}

TEST(VibrationLimits, TheHighestSpeed) {
    EXPECT_EQ(operation::top_speed({100, 200}), 200);
    EXPECT_EQ(operation::top_speed({100, 200, 220}), 220);
}

} // namespace
} // namespace limits_test
