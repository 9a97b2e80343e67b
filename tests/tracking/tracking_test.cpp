#include "analyses/campbell.h"
#include "analyses/modes.h"
#include "input/case_file.h"
#include "results/campbell.h"
#include "results/model_summary.h"
#include "results/whirl.h"
#include "support/test_rotors.h"
#include "tracking/tracking.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

namespace {

using namespace whirl;
using results::Whirl;
using tracking::Matching;

/// A snapshot of two modes of a 2 x 2 Hermitian problem A(speed) x = w x, turned into the states
/// that a basis has: left and right vectors of norm one.
tracking::Snapshot two_modes(double speed, double slope, double coupling) {
    // w = +-sqrt((slope speed)^2 + coupling^2): lines that veer at rest, cross without coupling.
    const double w = std::hypot(slope * speed, coupling);
    const double angle = std::atan2(coupling, slope * speed) / 2;
    tracking::Snapshot out;
    out.spectrum.speed = speed;
    out.spectrum.modes.resize(2);
    out.spectrum.modes[0].eigenvalue = {0, 100 - w};
    out.spectrum.modes[1].eigenvalue = {0, 100 + w};
    out.spectrum.complete_radius = 200;
    Eigen::MatrixXd X(2, 2);
    X << -std::sin(angle), std::cos(angle), std::cos(angle), std::sin(angle);
    out.basis.left = X;
    out.basis.right = X;
    const double rate = w > 0 ? slope * slope * speed / w : 0;
    out.basis.rate_below.resize(2);
    out.basis.rate_below << std::complex<double>(0, -rate), std::complex<double>(0, rate);
    out.basis.rate_above = out.basis.rate_below;
    return out;
}

TEST(ModeMatching, LinesThatCrossExchangeTheirPlaces) {
    const Matching matching =
        tracking::match_by_vectors(two_modes(-1, 1, 1e-9), two_modes(1, 1, 1e-9), 2);
    EXPECT_FALSE(matching.ambiguous);
    EXPECT_EQ(matching.to, (std::vector<int>{1, 0}));
}

TEST(ModeMatching, LinesThatVeerKeepTheirPlacesStepByStep) {
    // Sixteen steps through a veering as wide as eight of them.
    for (int k = -8; k < 8; ++k) {
        const Matching matching =
            tracking::match_by_vectors(two_modes(k, 1, 4), two_modes(k + 1, 1, 4), 2);
        EXPECT_FALSE(matching.ambiguous) << k;
        EXPECT_EQ(matching.to, (std::vector<int>{0, 1})) << k;
    }
}

TEST(ModeMatching, MixedVectorsAreAmbiguousAndSettledBySlopes) {
    // From the middle of a narrow veering outwards: both vectors are halves of each other.
    const tracking::Snapshot middle = two_modes(0, 1, 1e-3);
    const tracking::Snapshot outside = two_modes(1, 1, 1e-3);
    EXPECT_TRUE(tracking::match_by_vectors(middle, outside, 2).ambiguous);
    EXPECT_EQ(tracking::match_by_groups(middle, outside).to, (std::vector<int>{0, 1}));
}

/// Modes of one speed and of another that are the combinations P of them: left vectors L with
/// L^T R = 1, so that the overlaps are P_ij (P^-1)_ji.
tracking::Snapshot combined(const Eigen::MatrixXd &P, const Eigen::VectorXd &frequencies) {
    tracking::Snapshot out;
    out.spectrum.modes.resize(static_cast<std::size_t>(P.cols()));
    for (Eigen::Index i = 0; i < P.cols(); ++i)
        out.spectrum.modes[static_cast<std::size_t>(i)].eigenvalue = {0, frequencies(i)};
    out.spectrum.complete_radius = 1000;
    out.basis.right = P;
    out.basis.left = P.inverse().transpose();
    out.basis.rate_below = out.basis.rate_above = Eigen::VectorXcd::Zero(P.cols());
    return out;
}

/// A mode with half of itself in one mode and a quarter in each of two others could as well have
/// become these: of orthogonal vectors, overlaps of one mode sum to 1.
TEST(ModeMatching, HalfOfAModeIsNotItsContinuation) {
    const Eigen::Vector3d frequencies(100, 101, 102);
    const tracking::Snapshot a = combined(Eigen::Matrix3d::Identity(), frequencies);
    for (const double own : {0.5, 0.65, 0.75, 0.95}) {
        // Reflection across the plane normal to v: 1 - 2 v v^T.
        const double c = std::sqrt(own);
        Eigen::Vector3d v(std::sqrt((1 - c) / 2), 0.5 * std::sqrt(1 + c), 0.5 * std::sqrt(1 + c));
        const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - 2 * v * v.transpose();
        ASSERT_NEAR(P(0, 0) * P(0, 0), own, 1e-12);
        // The one lowest mode: the others are mixed in any case.
        EXPECT_EQ(tracking::match_by_vectors(a, combined(P, frequencies), 1).ambiguous, own < 0.7)
            << own;
    }
}

/// Of damped modes, whose vectors are not orthogonal, overlaps may exceed 1 and cancel: a mode that
/// is in two of the other speed is unsure seen from either.
TEST(ModeMatching, IsAsUnsureBackwardsAsForwards) {
    const Eigen::Vector3d frequencies(100, 101, 102);
    const tracking::Snapshot a = combined(Eigen::Matrix3d::Identity(), frequencies);
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> part(-0.9, 0.9);
    int unsure = 0;
    for (int draw = 0; draw < 300; ++draw) {
        Eigen::Matrix3d P = Eigen::Matrix3d::Identity();
        for (const auto &[i, j] : {std::pair(0, 1), {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}})
            P(i, j) = part(generator);
        const tracking::Snapshot b = combined(P, frequencies);
        const Matching forwards = tracking::match_by_vectors(a, b, 3);
        const Matching backwards = tracking::match_by_vectors(b, a, 3);
        EXPECT_EQ(forwards.to, backwards.from) << P;
        // Sure is what is so from both sides: no mode of either speed has a rival.
        const Eigen::MatrixXd overlap = (P.array() * P.inverse().transpose().array()).abs();
        bool sure = forwards.to == std::vector<int>{0, 1, 2};
        for (int i = 0; i < 3; ++i) {
            const double own = overlap(i, i);
            sure = sure && own >= 0.7;
            for (int k = 0; k < 3; ++k)
                sure = sure && (k == i || std::max(overlap(i, k), overlap(k, i)) <= 0.6 * own);
        }
        if (forwards.to == std::vector<int>{0, 1, 2}) {
            EXPECT_EQ(forwards.ambiguous, !sure) << P;
            unsure += sure ? 0 : 1;
        }
    }
    EXPECT_GT(unsure, 30);
}

/// Lines that cross within the step, at whose ends the vectors are halves of each other: values and
/// slopes tell which goes where, values alone would take the nearer.
TEST(ModeMatching, MixedModesGoOnWithTheirSlopes) {
    tracking::Snapshot a = combined(Eigen::Matrix2d::Identity(), Eigen::Vector2d(100, 104));
    Eigen::Matrix2d half;
    half << 1, -1, 1, 1;
    tracking::Snapshot b = combined(half / std::sqrt(2.0), Eigen::Vector2d(94, 110));
    b.spectrum.speed = 1;
    a.basis.rate_below << std::complex<double>(0, 10), std::complex<double>(0, -10);
    b.basis.rate_below << std::complex<double>(0, -10), std::complex<double>(0, 10);
    a.basis.rate_above = a.basis.rate_below;
    b.basis.rate_above = b.basis.rate_below;
    EXPECT_EQ(tracking::match_by_groups(a, b).to, (std::vector<int>{1, 0}));
    EXPECT_EQ(tracking::match_by_groups(b, a).to, (std::vector<int>{1, 0}));
}

TEST(ModeMatching, AModeOutsideTheOthersSpaceIsNotMatched) {
    tracking::Snapshot a = two_modes(-1, 1, 0);
    tracking::Snapshot b = two_modes(1, 1, 0);
    b.basis.left.col(0).setZero(); // one of them is not among the modes there
    b.basis.right.col(0).setZero();
    const Matching matching = tracking::match_by_groups(a, b);
    EXPECT_EQ(std::count(matching.to.begin(), matching.to.end(), Matching::none), 1);
    EXPECT_EQ(matching.from[0], Matching::none);
}

TEST(ModeMatching, FateTellsARealEigenvalueFromALossAndFromTheEndOfTheList) {
    modes::Spectrum here = two_modes(0, 1, 1).spectrum;
    modes::Spectrum there = here;
    here.modes[0].eigenvalue = {-30, 5};
    EXPECT_EQ(tracking::fate(here, 0, there), tracking::Absence::lost);
    there.overdamped = {-33, -27};
    EXPECT_EQ(tracking::fate(here, 0, there), tracking::Absence::overdamped);
    here.modes[0].eigenvalue = {3, 1};
    there.overdamped = {2, 4};
    there.growing = {2, 4};
    EXPECT_EQ(tracking::fate(here, 0, there), tracking::Absence::divergent);
    here.modes[0].eigenvalue = {0, 199};
    EXPECT_EQ(tracking::fate(here, 0, there), tracking::Absence::beyond);
}

/// A seal at midspan whose stiffness is negative near rest, beyond what shaft and bearings hold.
model::Case sealed_rotor(bool with_rest) {
    model::Case scene;
    scene.rotor = tests::uniform_shaft(1.5, 0.05, 2);
    scene.rotor.shaft.order = 6;
    const double pi = 3.14159265358979323846;
    const double mass = 7810 * pi / 4 * (0.3 * 0.3 - 0.05 * 0.05) * 0.07;
    const double squares = (0.3 * 0.3 + 0.05 * 0.05) / 4;
    scene.rotor.discs = {
        tests::disc(0.75, mass, mass * (squares / 4 + 0.07 * 0.07 / 12), mass * squares / 2)};
    model::Bearing seal;
    seal.z = 0.75;
    const double k[4] = {-4e6, -2e6, 1e6, 4e6};
    const double cross[4] = {0, 1e5, 3e5, 5e5};
    const double speeds[4] = {0, 100, 200, 600};
    for (int i = with_rest ? 0 : 2; i < 4; ++i) {
        model::BearingCoefficients row;
        row.k << k[i], cross[i], -cross[i], k[i];
        row.c = 2e3 * Eigen::Matrix2d::Identity();
        seal.speeds.push_back(speeds[i]);
        seal.rows.push_back(row);
    }
    scene.rotor.bearings = {tests::bearing(0, 2e6, 2e6, 0, 500),
                            tests::bearing(1.5, 2e6, 2e6, 0, 500), seal};
    scene.speeds = model::SpeedRange{200, 600, 41};
    return scene;
}

TEST(Tracking, RowsOfATableBelowTheSweepChangeNothing) {
    const results::CampbellResult with = analyses::campbell(sealed_rotor(true));
    const results::CampbellResult without = analyses::campbell(sealed_rotor(false));
    ASSERT_EQ(without.modes.size(), 8U);
    ASSERT_EQ(with.modes.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(with.modes[i].label, without.modes[i].label);
        for (std::size_t k = 0; k < with.speeds.size(); ++k) {
            ASSERT_TRUE(with.modes[i].frequency[k]) << i << " " << k;
            // The eigensolver resolves 1e-12, the frequencies are of one size.
            EXPECT_NEAR(*with.modes[i].frequency[k] / *without.modes[i].frequency[k], 1, 1e-9);
        }
    }
}

/// Bearings whose coupling has no symmetry: left vectors are no mirror image of the right ones.
TEST(Tracking, FollowsModesOfBearingsWithAnyCoupling) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e6, 0.7e6, 0, 200);
    scene.rotor.shaft.order = 6;
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows[0].k(0, 1) = 3e5;
        bearing.rows[0].k(1, 0) = -1e5;
    }
    scene.speeds = model::SpeedRange{0, 1200, 25};
    scene.campbell.modes = 8;
    const results::CampbellResult result = analyses::campbell(scene);
    for (const results::CampbellMode &mode : result.modes)
        for (std::size_t k = 2; k < result.speeds.size(); ++k) {
            if (!mode.frequency[k] || !mode.frequency[k - 1] || !mode.frequency[k - 2])
                continue;
            // Smooth lines: second differences stay below the gyroscopic change over a step.
            const double second =
                *mode.frequency[k] - 2 * *mode.frequency[k - 1] + *mode.frequency[k - 2];
            EXPECT_LT(std::abs(second), 12) << mode.label << " " << result.speeds[k];
        }
    EXPECT_EQ(std::count_if(result.modes.begin(), result.modes.end(),
                            [](const auto &mode) { return mode.frequency[12].has_value(); }),
              static_cast<std::ptrdiff_t>(result.modes.size()));
}

bool any_note(const results::ModelSummary &model, const std::string &word) {
    return std::any_of(model.notes.begin(), model.notes.end(), [&](const std::string &note) {
        return note.find(word) != std::string::npos;
    });
}

TEST(Tracking, AnUndampedRotorHasNoOverdampedMode) {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/anisotropic_disc_flexible");
    scene.speeds = model::SpeedRange{500, 700, 21};
    const results::CampbellResult result = analyses::campbell(scene);
    EXPECT_FALSE(any_note(result.model, "overdamped"));
    EXPECT_FALSE(any_note(result.model, "could not be followed"));
}

/// A bearing of negative stiffness in one plane: a real eigenvalue of +120 1/s.
TEST(Words, AGrowingRealEigenvalueIsDivergence) {
    model::Case scene;
    scene.rotor = tests::uniform_shaft(1.5, 0.05);
    scene.rotor.shaft.order = 8;
    scene.rotor.bearings = {tests::bearing(0, -1e5, 1e6, 0, 10),
                            tests::bearing(1.5, 1e6, 1e6, 0, 10)};
    scene.speeds = model::SpeedRange{10, 10, 1};
    const results::CampbellResult sweep = analyses::campbell(scene);
    EXPECT_TRUE(any_note(sweep.model, "divergence"));
    EXPECT_TRUE(any_note(sweep.model, "+120"));
    EXPECT_TRUE(any_note(analyses::mode_shapes(scene).model, "divergence"));
    scene.rotor.bearings[0].rows[0].k(0, 0) = 1e6;
    EXPECT_FALSE(any_note(analyses::campbell(scene).model, "divergence"));
}

/// Of the motions of a centrifuge with a heavy balancer one has deflections 1.9 times larger at
/// 212.19 rad/s than at 307.81.
TEST(DominantWhirl, IsThatOfTheLargerDeflections) {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/centrifuge_two_balls");
    scene.speeds = model::SpeedRange{260, 260, 1};
    const results::CampbellResult result = analyses::campbell(scene);
    const auto has = [&](double frequency) {
        return std::any_of(result.modes.begin(), result.modes.end(), [&](const auto &mode) {
            return std::abs(*mode.frequency[0] - frequency) < 0.005;
        });
    };
    EXPECT_TRUE(has(212.19));
    EXPECT_FALSE(has(307.81));
}

TEST(WhirlSense, IsTheSameOnEveryMesh) {
    // 158 rad/s, the mode of 277.12 rad/s of Friswell et al. 5.9.2; nodes move with the mesh.
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e6, 0.8e6);
    scene.speeds = model::SpeedRange{158, 158, 1};
    scene.campbell.modes = 8;
    std::vector<Whirl> first;
    std::vector<double> shares;
    for (const int elements : {2, 4, 6, 8, 16, 30}) {
        for (model::Segment &segment : scene.rotor.shaft.segments)
            segment.elements = elements;
        scene.rotor.shaft.order = 4;
        const results::CampbellResult result = analyses::campbell(scene);
        std::vector<Whirl> senses;
        for (std::size_t i = 0; i < 8; ++i) {
            senses.push_back(result.modes[i].whirl[0]);
            // Order 4 has the shapes to 1e-4 on the coarsest mesh.
            if (shares.size() == 8) {
                EXPECT_NEAR(result.modes[i].forward_fraction[0], shares[i], 1e-3) << elements;
            }
        }
        if (first.empty()) {
            first = senses;
            for (std::size_t i = 0; i < 8; ++i)
                shares.push_back(result.modes[i].forward_fraction[0]);
            EXPECT_NEAR(*result.modes[3].frequency[0], 277.12, 0.01);
        }
        EXPECT_EQ(senses, first) << elements;
    }
}

/// The scene in other units of length, mass and time.
model::Case scaled(model::Case scene, double L, double m, double t) {
    model::Rotor &rotor = scene.rotor;
    for (model::Segment &segment : rotor.shaft.segments) {
        for (double *length : {&segment.length, &segment.outer_start, &segment.outer_end,
                               &segment.inner_start, &segment.inner_end})
            *length *= L;
        segment.material.E *= m / (L * t * t);
        segment.material.G *= m / (L * t * t);
        segment.material.rho *= m / (L * L * L);
    }
    for (model::Disc &disc : rotor.discs) {
        disc.z *= L;
        disc.mass *= m;
        disc.Id *= m * L * L;
        disc.Ip *= m * L * L;
    }
    for (model::Bearing &bearing : rotor.bearings) {
        bearing.z *= L;
        for (double &speed : bearing.speeds)
            speed /= t;
        for (model::BearingCoefficients &row : bearing.rows) {
            row.k *= m / (t * t);
            row.c *= m / t;
        }
    }
    for (model::Anisotropy &part : rotor.anisotropies) {
        part.z *= L;
        part.dI *= m * L * L;
    }
    scene.speeds->from /= t;
    scene.speeds->to /= t;
    return scene;
}

TEST(Units, ChangeNoDigitAndNoWord) {
    model::Case planar;
    planar.rotor = tests::two_disc_rotor(1e6, 1e6);
    planar.rotor.shaft.order = 6;
    planar.speeds = model::SpeedRange{0, 1000, 11};
    planar.campbell.modes = 6;
    model::Case hyperbolic = planar;
    hyperbolic.rotor = tests::two_disc_rotor(1e6, 0.6e6);
    hyperbolic.rotor.shaft.order = 6;
    model::Case general = planar;
    general.rotor = tests::two_disc_rotor(1e6, 0.6e6, 1e5, 3e3);
    general.rotor.shaft.order = 6;
    model::Case rotating = planar;
    rotating.speeds = model::SpeedRange{10, 1000, 11};
    rotating.rotor.anisotropies.push_back({});
    rotating.rotor.anisotropies[0].z = 0.5;
    rotating.rotor.anisotropies[0].dI = 0.03;
    for (const model::Case &scene : {planar, hyperbolic, general, rotating}) {
        const results::CampbellResult plain = analyses::campbell(scene);
        for (const auto &[L, m, t] : {std::tuple(0x1p20, 1.0, 1.0), std::tuple(0x1p-20, 1.0, 1.0),
                                      std::tuple(1.0, 0x1p30, 1.0), std::tuple(1.0, 1.0, 0x1p-20),
                                      std::tuple(0x1p-30, 0x1p20, 0x1p20)}) {
            const results::CampbellResult other = analyses::campbell(scaled(scene, L, m, t));
            ASSERT_EQ(other.modes.size(), plain.modes.size());
            ASSERT_EQ(other.crossings.size(), plain.crossings.size());
            for (std::size_t i = 0; i < plain.crossings.size(); ++i)
                EXPECT_NEAR(other.crossings[i].speed * t / plain.crossings[i].speed, 1, 1e-9);
            for (std::size_t i = 0; i < plain.modes.size(); ++i) {
                EXPECT_EQ(other.modes[i].label, plain.modes[i].label);
                EXPECT_EQ(other.modes[i].whirl, plain.modes[i].whirl);
                for (std::size_t k = 0; k < plain.speeds.size(); ++k) {
                    ASSERT_EQ(other.modes[i].frequency[k].has_value(),
                              plain.modes[i].frequency[k].has_value());
                    if (plain.modes[i].frequency[k].value_or(0) > 0) {
                        EXPECT_NEAR(*other.modes[i].frequency[k] * t / *plain.modes[i].frequency[k],
                                    1, 1e-9);
                    }
                }
            }
        }
    }
}

} // namespace
