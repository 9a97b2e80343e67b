// Modes of damped rotors followed from speed to speed: against the dense state matrix, which shares
// the matrices but no solver, and against the route that takes each speed alone.

#include "assembly/discretization.h"
#include "assembly/system.h"
#include "modes/following/continuation.h"
#include "modes/following/eigenpair_refinement.h"
#include "modes/following/symmetric_problem.h"
#include "modes/spectrum.h"
#include "results/formulation.h"
#include "support/dense_eigenvalues.h"
#include "support/random.h"
#include "support/random_discs.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using results::Form;

/// Damped, the same from every direction or orthotropic, from light dampers to strong ones.
model::Rotor sample_rotor(tests::Random &random, bool isotropic, int elements = 3) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(random(0.6, 1.5), random(0.04, 0.1), tests::steel());
    rotor.shaft.segments[0].elements = elements;
    rotor.shaft.internal_damping = random.coin() ? random(1e-6, 2e-5) : 0;
    tests::add_two_discs(random, rotor);
    const double length = rotor.shaft.length();
    for (const double z : {0.0, length}) {
        model::Bearing bearing =
            tests::isotropic_bearing(z, std::pow(10, random(6, 8)), std::pow(10, random(1, 5)));
        model::BearingCoefficients &row = bearing.rows[0];
        if (!isotropic)
            row.k(1, 1) *= random(1.1, 2);
        if (random.coin()) {
            row.k(0, 1) = random(-0.03, 0.03) * row.k(0, 0);
            row.k(1, 0) = -row.k(0, 1);
        }
        if (random.coin())
            bearing.pedestal = model::Pedestal{random(1, 10), 1e8, random(0, 500)};
        rotor.bearings.push_back(bearing);
    }
    return rotor;
}

std::vector<double> sweep(double to, int count) {
    std::vector<double> speeds;
    for (int i = 0; i < count; ++i)
        speeds.push_back(to * i / (count - 1));
    return speeds;
}

std::vector<Complex> dense(const assembly::Discretization &d, double speed) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, 0);
    const auto full = [](const linalg::Matrix &A) { return Eigen::MatrixXd(A.view()); };
    return tests::dense_eigenvalues(full(system.M), full(system.C) + speed * full(system.G),
                                    full(system.K) + speed * full(system.Kc));
}

bool followed(const Spectrum &spectrum) {
    return std::all_of(spectrum.modes.begin(), spectrum.modes.end(),
                       [](const WhirlMode &mode) { return mode.followed >= 0; });
}

/// Every mode is an eigenvalue of the state matrix, and all slower whirls of that are modes.
void expect_complete(const Spectrum &found, const std::vector<Complex> &all) {
    // dgeev knows the matrix to a part of its largest eigenvalue, some 1e6 1/s for most of these
    // rotors, 1e9 1/s where a damper holds little mass. Eigenvalues that are close to others feel
    // that by their size over the gap, and no more than by its root.
    constexpr double of_dense = 1e-6;
    double largest = 0;
    for (const Complex &value : all)
        largest = std::max(largest, std::abs(value));
    const double rounding =
        static_cast<double>(all.size()) * std::numeric_limits<double>::epsilon() * largest;
    ASSERT_FALSE(found.modes.empty());
    for (const WhirlMode &mode : found.modes) {
        const double size = std::abs(mode.eigenvalue);
        double nearest = size;
        double gap = size; // to the second
        for (const Complex &value : all) {
            const double away = std::abs(value - mode.eigenvalue);
            gap = std::min(gap, std::max(away, nearest));
            nearest = std::min(nearest, away);
        }
        const double felt = std::min(rounding / gap, std::sqrt(rounding / size));
        EXPECT_LT(nearest / size, std::max(of_dense, felt))
            << mode.eigenvalue << " at " << found.speed;
    }
    if (!followed(found))
        return; // the other route promises less
    const double last = found.modes.back().eigenvalue.imag() * (1 + of_dense);
    const auto slower = std::count_if(all.begin(), all.end(), [&](const Complex &value) {
        return value.imag() > real_axis * std::abs(value) && value.imag() <= last &&
               std::abs(value) < found.complete_radius;
    });
    EXPECT_EQ(std::ssize(found.modes), slower) << found.speed;
}

} // namespace

TEST(FollowedModes, AreAllOfTheStateMatrix) {
    tests::Random random(11);
    int speeds_followed = 0;
    int speeds_seen = 0;
    for (int draw = 0; draw < 40; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic);
        const SpectrumSolver solver(rotor, isotropic ? Form::planar_damped : Form::general, 4);
        const std::vector<double> speeds = sweep(1500, 31);
        solver.follow(speeds, 8);
        for (std::size_t k = 0; k < speeds.size(); k += 6) {
            // On the speeds of the sweep and between them.
            const double speed = speeds[k] + (k % 4 == 0 ? 0 : 13.7);
            const Spectrum found = solver.at(std::min(speed, speeds.back()), 8);
            expect_complete(found, dense(solver.discretization(), found.speed));
            speeds_followed += followed(found) ? 1 : 0;
            ++speeds_seen;
        }
    }
    EXPECT_GT(speeds_followed, speeds_seen / 2); // else it is the other route that was tested
}

/// So many unknowns that guesses are made in a space of shapes.
TEST(FollowedModes, OfManyUnknownsAreAllOfTheStateMatrix) {
    tests::Random random(14);
    int speeds_followed = 0;
    int speeds_seen = 0;
    for (int draw = 0; draw < 8; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic, isotropic ? 10 : 7);
        const SpectrumSolver solver(rotor, isotropic ? Form::planar_damped : Form::general, 4);
        const std::vector<double> speeds = sweep(2500, 41);
        solver.follow(speeds, 10);
        for (std::size_t k = 1; k < speeds.size(); k += 13) {
            const Spectrum found = solver.at(speeds[k] + (k % 2 == 0 ? 0 : 13.7), 10);
            expect_complete(found, dense(solver.discretization(), found.speed));
            for (const WhirlMode &mode : found.modes)
                if (mode.followed >= 0)
                    EXPECT_LE(mode.residual, 1e-13) << mode.eigenvalue << " at " << found.speed;
            speeds_followed += followed(found) ? 1 : 0;
            ++speeds_seen;
        }
    }
    EXPECT_GT(speeds_followed, speeds_seen / 2); // else it is the other route that was tested
}

/// Supports that hardly differ: from rest on, motions in the planes turn into whirls within a few
/// rad/s. Which is which need not be known of those that are only counted, until they are asked
/// for.
TEST(FollowedModes, OfSupportsThatHardlyDifferAreAllWhenMoreAreAskedFor) {
    tests::Random random(15);
    int speeds_followed = 0;
    int speeds_seen = 0;
    for (int draw = 0; draw < 12; ++draw) {
        SCOPED_TRACE(draw);
        model::Rotor rotor = sample_rotor(random, true);
        for (model::Bearing &bearing : rotor.bearings)
            bearing.rows[0].k(1, 1) *= 1 + std::pow(10, random(-5, -2));
        const SpectrumSolver solver(rotor, Form::general, 4);
        const std::vector<double> speeds = sweep(1500, 31);
        for (const int wanted : {4, 6, 10}) {
            SCOPED_TRACE(wanted);
            solver.follow(speeds, wanted);
            for (std::size_t k = 0; k < speeds.size(); k += 5) {
                const double speed = speeds[k] + (k % 2 == 0 ? 0 : 7.3);
                const Spectrum found = solver.at(std::min(speed, speeds.back()), wanted);
                expect_complete(found, dense(solver.discretization(), found.speed));
                speeds_followed += followed(found) ? 1 : 0;
                ++speeds_seen;
            }
        }
    }
    EXPECT_GT(speeds_followed, speeds_seen / 2); // else it is the other route that was tested
}

/// The slowest eigenvalues of the state matrix, each conjugate pair once, by modulus.
FollowedSpeed slowest(const assembly::Discretization &d, double speed, std::size_t count) {
    std::vector<Complex> all = dense(d, speed);
    std::erase_if(all, [](const Complex &value) { return value.imag() < 0; });
    std::sort(all.begin(), all.end(),
              [](const Complex &a, const Complex &b) { return std::abs(a) < std::abs(b); });
    FollowedSpeed out;
    out.speed = speed;
    for (std::size_t i = 0; i < count; ++i)
        out.pairs.emplace_back().value = all[i];
    return out;
}

/// An eigenvalue just outside the circle at one speed and just inside at the other turns the ratio
/// of both determinants by 2 pi there, which points before and behind do not show.
TEST(FollowedModes, OneThatHasJustComeIntoTheCircleIsCounted) {
    tests::Random random(16);
    int seen = 0;
    for (int draw = 0; draw < 60; ++draw) {
        SCOPED_TRACE(draw);
        const model::Rotor rotor = sample_rotor(random, false);
        const assembly::Discretization d(rotor, 4);
        const auto problem = SymmetricProblem::of(d, Form::general);
        ASSERT_NE(problem, nullptr);
        const double speed = random(0, 1000);
        const FollowedSpeed a = slowest(d, speed, 12);
        const FollowedSpeed b = slowest(d, speed + random(5, 60), 12);
        for (std::size_t i = 4; i < 12; ++i) {
            const double outside = std::abs(a.pairs[i].value);
            const double inside = std::abs(b.pairs[i].value);
            const double radius = std::sqrt(outside * inside);
            // Not on a circle, to the rounding of the dense values, and no others in between.
            if (outside < 1.0001 * inside || std::abs(a.pairs[i - 1].value) > 0.999 * radius ||
                (i + 1 < 12 && std::abs(b.pairs[i + 1].value) < 1.001 * radius))
                continue;
            FollowedSpeed within_a = a;
            FollowedSpeed within_b = b;
            within_a.pairs.resize(i);
            within_b.pairs.resize(i + 1);
            EXPECT_TRUE(none_missing(*problem, within_a, radius, within_b, radius)) << i;
            within_b.pairs.resize(i);
            EXPECT_FALSE(none_missing(*problem, within_a, radius, within_b, radius)) << i;
            ++seen;
        }
    }
    EXPECT_GT(seen, 60);
}

TEST(FollowedModes, AreThoseOfEachSpeedAlone) {
    tests::Random random(12);
    for (int draw = 0; draw < 20; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic);
        const Form form = isotropic ? Form::planar_damped : Form::general;
        const SpectrumSolver solver(rotor, form, 4);
        const SpectrumSolver alone(rotor, form, 4);
        const std::vector<double> speeds = sweep(1200, 25);
        solver.follow(speeds, 8);
        for (std::size_t k = 0; k < speeds.size(); k += 3) {
            const Spectrum found = solver.at(speeds[k], 8);
            const Spectrum expected = alone.at(speeds[k], 8);
            ASSERT_EQ(found.modes.size(), expected.modes.size()) << speeds[k];
            for (const WhirlMode &mode : found.modes) {
                const WhirlMode *partner = nullptr;
                for (const WhirlMode &other : expected.modes)
                    if (partner == nullptr || std::abs(other.eigenvalue - mode.eigenvalue) <
                                                  std::abs(partner->eigenvalue - mode.eigenvalue))
                        partner = &other;
                const double stated =
                    2 * mode.residual + mode.rounding + partner->residual + partner->rounding;
                EXPECT_LE(std::abs(partner->eigenvalue - mode.eigenvalue),
                          stated * std::abs(mode.eigenvalue))
                    << mode.eigenvalue << " at " << speeds[k];
            }
        }
    }
}

TEST(FollowedModes, ErrorOfARayleighQuotientIsStated) {
    tests::Random random(13);
    int worse = 0;
    int seen = 0;
    double largest = 0;
    for (int draw = 0; draw < 50; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic);
        const Form form = isotropic ? Form::planar_damped : Form::general;
        const SpectrumSolver solver(rotor, form, 4);
        const auto problem = SymmetricProblem::of(solver.discretization(), form);
        ASSERT_NE(problem, nullptr);
        const double speed = random(50, 1000);
        EigenpairRefinement refinement(*problem);
        std::vector<SymmetricPair> pairs;
        for (const WhirlMode &mode : solver.at(speed, 8).modes) {
            SymmetricPair pair;
            pair.value = isotropic ? mode.rotating_value : mode.eigenvalue;
            pair.vector = problem->from_form(mode.shape);
            refinement.refine({{&pair, speed, 1, enough_error}});
            ASSERT_TRUE(pair.refined) << "not settled";
            pairs.push_back(pair);
        }
        for (std::size_t i = 0; i < pairs.size(); ++i)
            for (const double size : {1e-2, 1e-3, 1e-4}) {
                SymmetricPair off = pairs[i];
                const SymmetricPair &other = pairs[(i + 1) % pairs.size()];
                const double length = off.vector.norm();
                off.vector += size * length / other.vector.norm() * other.vector;
                for (Complex &entry : off.vector)
                    entry += size * length * Complex(random(-0.1, 0.1), random(-0.1, 0.1));
                refinement.take_good({{&off, speed, distance_from_others(pairs, i), HUGE_VAL}});
                const double error = std::abs(off.value - pairs[i].value) / std::abs(off.value);
                worse += error > 2 * off.error + pairs[i].rounding ? 1 : 0;
                largest = std::max(largest, error / (off.error + pairs[i].rounding));
                ++seen;
            }
    }
    EXPECT_GT(seen, 1000);
    EXPECT_EQ(worse, 0) << "of " << seen << ", at worst " << largest << " times the stated error";
}

} // namespace whirl::modes
