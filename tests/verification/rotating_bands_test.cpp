// Unstable bands must not depend on the grid of speeds: scenes in which motions collide between
// grid speeds, against eigenvalues of dense state matrices, and random rotors from two grids.

#include "analyses/stability.h"
#include "analyses/stability_ends.h"
#include "assembly/rotating_system.h"
#include "results/formulation.h"
#include "stability/band_finder.h"
#include "stability/rotor_at_speeds.h"
#include "support/dense_eigenvalues.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace {

using namespace whirl;
using Bands = std::vector<results::Interval>;

const model::Material steel{"steel", 2.1e11, 2.1e11 / 2.6, 7850};

model::Rotor shaft_with(double diameter, const std::vector<model::Disc> &discs,
                        const std::vector<model::Anisotropy> &anisotropies, double left_k,
                        double right_k, double c) {
    model::Rotor rotor;
    rotor.shaft.segments = {{1.0, diameter, diameter, 0, 0, steel, 2}};
    rotor.shaft.order = 4;
    rotor.discs = discs;
    rotor.anisotropies = anisotropies;
    rotor.bearings = {tests::round_bearing(0, left_k, c), tests::round_bearing(1, right_k, c)};
    return rotor;
}

/// Three collisions of lightly damped motions, each within one step of 101 speeds.
model::Rotor three_collisions() {
    return shaft_with(
        0.03300844447257618,
        {tests::disc(0.526, 20.289493259295536, 0.23900392178376423, 0.37845124191657686),
         tests::disc(0.193, 28.80073171815462, 0.2861412884021721, 0.3716375690457993),
         tests::disc(0.171, 6.149679516762891, 0.30108010413718217, 0.26700934355010925)},
        {{"", 0.526, 0.0017695157278915443, 0.5603810380614256},
         {"", 0.193, 0.01558784581625635, 0.43200862505777304},
         {"", 0.171, 0.0025833537721388937, 1.6109162387153777}},
        4242259.348993412, 78205251.70239034, 245.2665552024163);
}

/// A collision of width 0.35 rad/s without any damping.
model::Rotor undamped_collision() {
    return shaft_with(
        0.056863505359228135,
        {tests::disc(0.07, 7.952630678771468, 0.3457580820489213, 0.6272924854536326),
         tests::disc(0.288, 12.208199716196638, 0.259833565568647, 0.2246286927192274),
         tests::disc(0.437, 22.130089747496065, 0.26227783172444186, 0.14364007796167638)},
        {{"", 0.07, 0.013184323350058081, 0.2807605591277992},
         {"", 0.288, 0.027252988153773236, 1.9520172887989502},
         {"", 0.437, 0.003393527030355293, 0.05950243640981068}},
        506576.4459012249, 1099344.8594763563, 0);
}

stability::BandsFound bands_of(const model::Rotor &rotor, double from, double to, int count) {
    stability::StabilityModel model;
    model.rotor = rotor;
    model.form = results::Form::rotating;
    model.order = rotor.shaft.order;
    stability::BandFinder finder(model, {});
    return analyses::bands_between_ends(finder, model::SpeedRange{from, to, count}.values()).found;
}

/// Largest real part of the dense state matrix, which shares the matrices but no solver.
double dense_growth(const model::Rotor &rotor, double speed) {
    const assembly::Discretization d(rotor, rotor.shaft.order);
    const assembly::RotatingSystem system = assembly::assemble_rotating(d, 0, {});
    return tests::largest_real_part(tests::dense_eigenvalues(system, speed));
}

bool has_band(const Bands &bands, double from, double to, double tolerance) {
    return std::any_of(bands.begin(), bands.end(), [&](const auto &band) {
        return std::abs(band.from - from) < tolerance && std::abs(band.to - to) < tolerance;
    });
}

// Ends to the digits of an independent solution (spectral Timoshenko elements, dense eigenvalues).
TEST(Collisions, OfDampedMotionsAreFoundFromACoarseGrid) {
    const model::Rotor rotor = three_collisions();
    const stability::BandsFound found = bands_of(rotor, 5, 2500, 101);
    EXPECT_TRUE(has_band(found.bands, 1688.2, 1701.4, 0.06));
    EXPECT_TRUE(has_band(found.bands, 1841.3, 1845.2, 0.06));
    EXPECT_TRUE(has_band(found.bands, 2208.5, 2220.0, 0.06));
    EXPECT_TRUE(found.doubtful.empty());
    EXPECT_NEAR(dense_growth(rotor, 1694.8), 1.38, 0.005);
    for (const auto &[from, to] : found.bands) { // 1e-6: what the dense solver leaves of 1e5 1/s
        const double off = 1e-4 * (to - from);
        EXPECT_GT(dense_growth(rotor, (from + to) / 2), 1e-6);
        EXPECT_LT(dense_growth(rotor, from - off), dense_growth(rotor, from + off));
        EXPECT_GT(dense_growth(rotor, to - off), dense_growth(rotor, to + off));
    }
}

TEST(Collisions, OfUndampedMotionsAreFoundFromAnyGrid) {
    for (const int count : {101, 377, 1501}) {
        const stability::BandsFound found = bands_of(undamped_collision(), 1100, 1500, count / 5);
        EXPECT_TRUE(has_band(found.bands, 1278.61, 1278.96, 0.006)) << count;
    }
}

/// Two to four anisotropic discs on a damped shaft.
model::Rotor random_rotor(std::mt19937 &random) {
    const auto uniform = [&random](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    const int discs = 2 + static_cast<int>(uniform(0, 2.999));
    model::Rotor rotor = shaft_with(uniform(0.03, 0.06), {}, {}, std::exp(uniform(13, 18)),
                                    std::exp(uniform(13, 18)), uniform(50, 400));
    rotor.shaft.segments[0].elements = 1;
    rotor.shaft.order = 3;
    for (int i = 0; i < discs; ++i) {
        const double z = (i + uniform(0.1, 0.9)) / discs;
        const double Id = uniform(0.1, 0.4);
        const double Ip = uniform(0.5, 1.8) * Id;
        rotor.discs.push_back(tests::disc(z, uniform(5, 30), Id, Ip));
        rotor.anisotropies.push_back({"", z, uniform(0.01, 0.1) * Id, uniform(0, 3.1)});
    }
    return rotor;
}

bool inside(const Bands &doubtful, double speed) {
    return std::any_of(doubtful.begin(), doubtful.end(), [&](const auto &interval) {
        return speed >= interval.from && speed <= interval.to;
    });
}

/// Every band of `some` is one of `others`, or said to be in doubt there.
void expect_contained(const stability::BandsFound &some, const stability::BandsFound &others,
                      int rotor) {
    for (const auto &[from, to] : some.bands) {
        EXPECT_TRUE(has_band(others.bands, from, to, 1e-6 * to) ||
                    inside(others.doubtful, (from + to) / 2))
            << "rotor " << rotor << ": " << from << " " << to;
    }
}

TEST(RandomRotors, BandsAreTheSameFromTwoGrids) {
    constexpr int rotors = 20;
    constexpr int fine = 1501;
    std::mt19937 random(20);
    std::size_t bands = 0;
    for (int i = 0; i < rotors; ++i) {
        const model::Rotor rotor = random_rotor(random);
        const stability::BandsFound coarse = bands_of(rotor, 5, 2500, 101);
        const stability::BandsFound all = bands_of(rotor, 5, 2500, fine);
        expect_contained(coarse, all, i);
        expect_contained(all, coarse, i);
        bands += all.bands.size();
        EXPECT_TRUE(coarse.doubtful.empty()) << "rotor " << i;
    }
    EXPECT_GT(bands, static_cast<std::size_t>(rotors)); // otherwise nothing was compared
    RecordProperty("bands", static_cast<int>(bands));
}

} // namespace
