// The machine at its operating speeds, against closed forms of two masses on springs.

#include "analyses/response.h"

#include "support/rigid_jeffcott.h"
#include "support/two_mass_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace operating_test {
namespace {

using namespace whirl;
using analyses::unbalance_response;
using results::Measure;
using results::OperatingResponse;
using results::OperatingRow;
using results::OperatingWorst;
using tests::TwoMassMachine;

// Systems of a few unknowns, well conditioned.
constexpr double rounding = 1e-10;
// The place of a maximum is flat: its value is known to the square of what its place is.
constexpr double of_search = 1e-9;

OperatingResponse operating(const model::Case &scene) {
    const auto result = unbalance_response(scene);
    EXPECT_TRUE(result.operating.has_value());
    return result.operating.value_or(OperatingResponse{});
}

const OperatingRow &row_of(const OperatingResponse &all, const std::string &of, double speed,
                           bool relative = false) {
    for (const OperatingRow &row : all.rows)
        if (row.of == of && row.speed == speed && (of != "probe" || row.relative == relative))
            return row;
    throw std::runtime_error("no such row: " + of);
}

const OperatingWorst &worst_of(const OperatingResponse &all, const std::string &of, Measure what,
                               bool relative = false) {
    for (const OperatingWorst &worst : all.worst)
        if (worst.of == of && worst.what == what && (of != "probe" || worst.relative == relative))
            return worst;
    throw std::runtime_error("no such limit: " + of);
}

/// The largest value of a function over a range, by looking at it in small steps and, about the
/// best, in smaller ones.
double largest(const std::function<double(double)> &f, double from, double to) {
    double best = from;
    for (int round = 0; round < 3; ++round) {
        constexpr int steps = 20000;
        const double low = from;
        const double high = to;
        for (int i = 0; i <= steps; ++i)
            if (const double s = low + (high - low) * i / steps; f(s) > f(best))
                best = s;
        const double step = (high - low) / steps;
        from = std::max(low, best - step);
        to = std::min(high, best + step);
    }
    return f(best);
}

void expect_close(double value, double expected, double tolerance) {
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

TEST(Operating, EveryPlaceAtEverySpeedOfTwoMasses) {
    const TwoMassMachine machine;
    model::Case scene = machine.scene();
    scene.speeds = model::SpeedRange{900, 1000, 3}; // which the operating speeds are not among
    scene.operation = model::Operation{200, 400, 450, 300};
    const OperatingResponse found = operating(scene);
    std::vector<std::string> names;
    for (const double speed : {200.0, 300.0, 400.0, 450.0}) {
        SCOPED_TRACE(speed);
        const auto [shaft, pedestal, film] = machine.at(speed);
        const OperatingRow &absolute = row_of(found, "probe", speed);
        names.push_back(absolute.at);
        expect_close(absolute.amplitude, std::abs(shaft), rounding);
        EXPECT_NEAR(absolute.phase, std::arg(shaft), rounding);
        expect_close(absolute.velocity, speed * std::abs(shaft), rounding);
        expect_close(absolute.acceleration, speed * speed * std::abs(shaft), rounding);
        EXPECT_FALSE(absolute.limit.has_value());
        EXPECT_FALSE(absolute.pass.has_value());
        expect_close(row_of(found, "probe", speed, true).amplitude, std::abs(shaft - pedestal),
                     rounding);
        const OperatingRow &bearing = row_of(found, "bearing", speed);
        EXPECT_EQ(bearing.name, "left");
        expect_close(bearing.amplitude, std::abs(shaft - pedestal), rounding);
        expect_close(*bearing.force, std::abs(film / 2.0 * (shaft - pedestal)), rounding);
        expect_close(*bearing.clearance_share, std::abs(shaft - pedestal) / 2e-4, rounding);
        expect_close(row_of(found, "pedestal", speed).amplitude, std::abs(pedestal), rounding);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"minimum", "normal", "maximum", "trip"}));
    EXPECT_EQ(found.rows.size(), 4U * (2 + 2 + 2));
}

TEST(Operating, ProbesMeasureAsTheySay) {
    const TwoMassMachine machine;
    model::Case scene = machine.scene();
    scene.operation = model::Operation{200, 400};
    scene.rotor.probes = {{"relative", 0, 0, false, true, {}},
                          {"absolute", 0.9, 0, false, false, {}},
                          {"far", 0.5, 0, false, true, 1},
                          {"on it", 1, 1.0, true, {}, 1}};
    const auto result = unbalance_response(scene);
    const auto [shaft, pedestal, film] = machine.at(400);
    const std::vector<double> expected{std::abs(shaft - pedestal), std::abs(shaft),
                                       std::abs(shaft - pedestal), std::abs(pedestal)};
    int probes = 0;
    for (const OperatingRow &row : result.operating->rows)
        if (row.of == "probe" && row.speed == 400)
            expect_close(row.amplitude, expected.at(static_cast<std::size_t>(probes++)), rounding);
    EXPECT_EQ(probes, 4); // each once: all say what they read
    // The lists over the speeds have the same, and their peaks.
    const auto at =
        static_cast<std::size_t>(std::ranges::find(result.speeds, 400.0) - result.speeds.begin());
    ASSERT_LT(at, result.speeds.size());
    for (std::size_t i = 0; i < 4; ++i) {
        expect_close(result.probes[i].amplitude[at], expected[i], rounding);
        for (const results::ResponsePeak &peak : result.peaks)
            if (peak.of == "probe" && peak.place == static_cast<int>(i)) {
                const auto there = machine.at(peak.speed);
                const std::vector<double> values{
                    std::abs(there.shaft - there.pedestal), std::abs(there.shaft),
                    std::abs(there.shaft - there.pedestal), std::abs(there.pedestal)};
                expect_close(peak.value, values[i], 1e-8); // compared with the whole rotor to 1e-9
            }
    }
}

/// The range ends beside a resonance on either side: what counts is between the named speeds.
TEST(Operating, LargestValuesBetweenTheNamedSpeeds) {
    const TwoMassMachine machine;
    model::Case scene = machine.scene();
    scene.speeds = model::SpeedRange{10, 20, 2};
    scene.operation = model::Operation{150, 1300, 1400};
    scene.limits.emplace();
    scene.limits->shaft = 1;
    scene.limits->velocity = 1;
    scene.limits->pedestals = model::HousingClass{2, true};
    scene.limits->zone = model::Zone::b_c;
    const OperatingResponse found = operating(scene);
    const auto shaft = [&](double s) { return std::abs(machine.at(s).shaft); };
    const auto relative = [&](double s) {
        return std::abs(machine.at(s).shaft - machine.at(s).pedestal);
    };
    const auto housing = [&](double s) { return std::abs(machine.at(s).pedestal); };
    expect_close(worst_of(found, "probe", Measure::amplitude).value, largest(shaft, 150, 1400),
                 of_search);
    expect_close(worst_of(found, "probe", Measure::amplitude, true).value,
                 largest(relative, 150, 1400), of_search);
    expect_close(worst_of(found, "pedestal", Measure::velocity_rms).value,
                 largest([&](double s) { return s * housing(s) / std::numbers::sqrt2; }, 150, 1400),
                 of_search);
    expect_close(worst_of(found, "pedestal", Measure::amplitude_rms).value,
                 largest(housing, 150, 1400) / std::numbers::sqrt2, of_search);
    // Peak to peak: the amplitude may be half of it.
    EXPECT_DOUBLE_EQ(worst_of(found, "probe", Measure::amplitude).limit, 0.5);
    // Group 2, flexible, B/C: 4.5 mm/s and 71 um.
    int iso = 0;
    for (const OperatingWorst &worst : found.worst)
        if (worst.source.starts_with("ISO")) {
            EXPECT_DOUBLE_EQ(worst.limit, worst.what == Measure::velocity_rms ? 4.5e-3 : 71e-6);
            ++iso;
        }
    EXPECT_EQ(iso, 4);
}

/// Two forces of other frequencies beside the imbalance: the largest values are added.
TEST(Operating, MotionsOfOtherFrequenciesAreAddedUp) {
    const TwoMassMachine machine;
    model::Case scene = machine.scene();
    scene.operation = model::Operation{200, 400};
    model::HarmonicForce twice{"", 0.5, 50, 0.4, 2.0, {}, model::ForceDirection::forward};
    model::HarmonicForce shaken{"", 0.5, 70, 1, {}, 260.0, model::ForceDirection::x};
    scene.rotor.forces = {twice, shaken};
    scene.limits.emplace();
    scene.limits->velocity = 1;
    const OperatingResponse found = operating(scene);
    for (const double s : {200.0, 400.0}) {
        const double a = std::abs(machine.at(s).pedestal);
        const double b = std::abs(machine.under(50, 2 * s).pedestal);
        const double d = std::abs(machine.under(70, 260).pedestal);
        const OperatingRow &row = row_of(found, "pedestal", s);
        expect_close(row.amplitude, a + b + d, rounding);
        expect_close(row.velocity, s * a + 2 * s * b + 260 * d, rounding);
        expect_close(row.acceleration, s * s * a + 4 * s * s * b + 260 * 260 * d, rounding);
    }
    const auto rms = [&](double s) {
        return (s * std::abs(machine.at(s).pedestal) +
                2 * s * std::abs(machine.under(50, 2 * s).pedestal) +
                260 * std::abs(machine.under(70, 260).pedestal)) /
               std::numbers::sqrt2;
    };
    expect_close(worst_of(found, "pedestal", Measure::velocity_rms).value, largest(rms, 200, 400),
                 of_search);
}

/// The imbalance grows until the probe that reads most is at its limit between minimum and maximum
/// speed; the orbit in the bearing is looked at from rest.
TEST(Operating, ClearancesWithScaledImbalance) {
    const TwoMassMachine machine;
    model::Case scene = machine.scene();
    scene.rotor.probes = {{"DE", 0, 0, false, true, {}}};
    scene.operation = model::Operation{450, 600};
    scene.limits.emplace();
    scene.limits->shaft_standard = model::ShaftStandard::api617; // 25.4 um: slower than 12000 rpm
    scene.limits->clearance = 0.75;
    const auto relative = [&](double s) {
        return std::abs(machine.at(s).shaft - machine.at(s).pedestal);
    };
    const double scale = std::max(1.0, 12.7e-6 / largest(relative, 450, 600));
    for (const double most : {0.0, 1.01}) {
        if (most > 0)
            scene.limits->scale_most = most;
        const OperatingResponse found = operating(scene);
        const double used = most > 0 ? std::min(most, scale) : scale;
        ASSERT_TRUE(found.scale.has_value());
        expect_close(*found.scale, used, of_search);
        const OperatingWorst &worst = worst_of(found, "bearing", Measure::clearance_share);
        EXPECT_EQ(worst.from, 0);
        expect_close(worst.value, used * largest(relative, 0, 600) / 2e-4, of_search);
    }
    scene.limits->scaled = false;
    const OperatingResponse given = operating(scene);
    EXPECT_FALSE(given.scale.has_value());
    expect_close(worst_of(given, "bearing", Measure::clearance_share).value,
                 largest(relative, 0, 600) / 2e-4, of_search);
}

/// An undamped resonance between the named speeds.
TEST(Operating, ResonanceWithoutDampingInTheRange) {
    TwoMassMachine machine;
    machine.c = machine.pedestal_c = 0;
    model::Case scene = machine.scene();
    scene.operation = model::Operation{100, 600};
    scene.limits.emplace();
    scene.limits->shaft = 1;
    scene.limits->clearance = 0.75;
    scene.limits->scaled = false;
    for (const OperatingWorst &worst : operating(scene).worst) {
        EXPECT_TRUE(std::isinf(worst.value)) << worst.of;
        EXPECT_EQ(worst.pass, std::optional(false)) << worst.of;
    }
}

/// At an operating speed itself: no value and no error of it, and a warning, whatever the speeds of
/// the response.
TEST(Operating, ResonanceWithoutDampingAtAnOperatingSpeed) {
    model::Case scene = tests::RigidJeffcott{.c = 0}.scene();
    const double resonance = tests::RigidJeffcott{}.natural();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-4)};
    scene.speeds = model::SpeedRange{10, 20, 2};
    scene.operation = model::Operation{resonance, 2 * resonance};
    const auto result = unbalance_response(scene);
    ASSERT_TRUE(result.operating.has_value());
    int at_resonance = 0;
    for (const OperatingRow &row : result.operating->rows) {
        if (row.speed == resonance) {
            ++at_resonance;
            EXPECT_TRUE(std::isinf(row.amplitude)) << row.of;
            EXPECT_TRUE(std::isnan(row.error)) << row.of;
        } else {
            EXPECT_LT(row.error, 1e-6) << row.of;
        }
    }
    EXPECT_GT(at_resonance, 0);
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const model::Sentence &note) {
        return note.find("no steady motion at the operating speed") != std::string::npos &&
               note.weight() == model::Weight::warning;
    }));
}

/// An asymmetric rotor on isotropic bearings solved as one on bearings that differ is the same.
TEST(Operating, PeriodicEquationsGiveTheSame) {
    TwoMassMachine machine;
    model::Case scene = machine.scene();
    scene.rotor.anisotropies = {{"", 0.5, 0.01, 0}};
    scene.rotor.imbalances = {tests::imbalance_at(0.4, 1e-4)};
    scene.operation = model::Operation{200, 400, 500};
    scene.limits.emplace();
    scene.limits->velocity = 1;
    const OperatingResponse rotating = operating(scene);
    scene.formulation = model::FormChoice::hill;
    const OperatingResponse periodic = operating(scene);
    ASSERT_EQ(rotating.rows.size(), periodic.rows.size());
    for (std::size_t i = 0; i < rotating.rows.size(); ++i) {
        SCOPED_TRACE(rotating.rows[i].of);
        constexpr double series = 1e-8; // it ends where its terms are that small
        expect_close(periodic.rows[i].amplitude, rotating.rows[i].amplitude, series);
        expect_close(periodic.rows[i].velocity, rotating.rows[i].velocity, series);
        if (rotating.rows[i].force)
            expect_close(*periodic.rows[i].force, *rotating.rows[i].force, series);
    }
    ASSERT_EQ(rotating.worst.size(), periodic.worst.size());
    for (std::size_t i = 0; i < rotating.worst.size(); ++i)
        expect_close(periodic.worst[i].value, rotating.worst[i].value, 1e-6);
}

TEST(Operating, NothingWithoutOperatingSpeeds) {
    EXPECT_FALSE(unbalance_response(TwoMassMachine().scene()).operating.has_value());
}

} // namespace
} // namespace operating_test
