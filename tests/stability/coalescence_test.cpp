// Where two motions meet and what that does: systems of two coordinates whose bands are known in
// closed form, given to the search as they are, without a rotor.

#include "stability/hill/coalescence.h"
#include "stability/hill/pair_search.h"
#include "stability/two_motion_systems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace whirl::stability {

namespace {

using Complex = std::complex<double>;
using tests::motions_of;
using tests::state_matrix;

std::vector<double> grid(double from, double to, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i)
        out.push_back(from + (to - from) * i / (count - 1));
    return out;
}

/// A mass on a shaft with the natural frequencies a and b in its two planes, on rigid isotropic
/// bearings, in axes that turn with it; d = (external damping)/(mass).
tests::SystemAt asymmetric_shaft(double a, double b, double d = 0) {
    return [=](double speed) {
        Eigen::Matrix2d D;
        D << d, -2 * speed, 2 * speed, d;
        Eigen::Matrix2d K;
        K << a * a - speed * speed, -d * speed, d * speed, b * b - speed * speed;
        return state_matrix(Eigen::Matrix2d::Identity(), D, K, a);
    };
}

/// x'' + a^2 x + p y = 0, y'' + b^2 y - p x = 0, circulatory: l^2 = -(a^2 + b^2)/2 +-
/// sqrt((a^2 - b^2)^2/4 - p^2).
Eigen::MatrixXd circulatory(double a, double b, double p) {
    Eigen::Matrix2d K;
    K << a * a, p, -p, b * b;
    return state_matrix(Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero(), K, a);
}

/// Amplitudes u, v of two waves: -i u' = first u + e v, -i v' = second v + sign e u.
/// sign 1: energies alike, frequencies veer; -1: opposite, they lock where |first - second| < 2 e.
Eigen::MatrixXd waves(double first, double second, double e, double sign) {
    Eigen::Matrix2d W;
    W << first, e, sign * e, second;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4); // i W over real and imaginary parts
    A.topRightCorner(2, 2) = -W;
    A.bottomLeftCorner(2, 2) = W;
    return A;
}

Motion motion(Complex value, const Eigen::Vector3cd &state) {
    Motion out;
    out.value = value;
    out.state = state.normalized();
    return out;
}

const Eigen::Vector3cd e1(1, 0, 0);
const Eigen::Vector3cd e2(0, 1, 0);
const Eigen::Vector3cd e3(0, 0, 1);

void expect_band(const BandsFound &found, double from, double to, double tolerance) {
    ASSERT_EQ(found.bands.size(), 1U);
    EXPECT_NEAR(found.bands[0].from, from, tolerance);
    EXPECT_NEAR(found.bands[0].to, to, tolerance);
    EXPECT_TRUE(found.doubtful.empty());
}

} // namespace

TEST(Continued, MotionsAreKnownByTheirStatesNotByTheirPlaces) {
    const Complex i(0, 1);
    const std::vector<Motion> from{motion(10. * i, e1), motion(20. * i, e2), motion(35. * i, e3)};
    // Each is still itself by 0.99, in another order and out of phase.
    const std::vector<Motion> to{motion(21. * i, i * (e2 + 0.1 * e1)),
                                 motion(36. * i, e3 - 0.1 * e2),
                                 motion(11. * i, e1 + 0.1 * i * e3)};
    const Continuation found = continued(0, from, 1, to);
    EXPECT_EQ(found.to, (std::vector<int>{2, 0, 1}));
    EXPECT_TRUE(found.coalescences.empty()); // no two of them change sides
    EXPECT_FALSE(found.doubtful);
}

TEST(Continued, APairThatCrossesIsAMeetingWithBothOrdersKnown) {
    const Complex i(0, 1);
    const std::vector<Motion> from{motion(10. * i, e1), motion(20. * i, e2)};
    const std::vector<Motion> to{motion(20. * i, e1), motion(10. * i, e2)};
    const Continuation found = continued(3, from, 4, to);
    EXPECT_EQ(found.to, (std::vector<int>{0, 1}));
    ASSERT_EQ(found.coalescences.size(), 1U);
    const Coalescence &meeting = found.coalescences[0];
    EXPECT_TRUE(meeting.ordered);
    EXPECT_EQ(meeting.aliases, 0);
    EXPECT_EQ(meeting.from, 3);
    EXPECT_EQ(meeting.to, 4);
    EXPECT_EQ(meeting.first_from, 10. * i);
    EXPECT_EQ(meeting.first_to, 20. * i);
    EXPECT_EQ(meeting.second_from, 20. * i);
    EXPECT_EQ(meeting.second_to, 10. * i);
}

TEST(Continued, MixturesAreKnownAsAPair) {
    const Complex i(0, 1);
    const std::vector<Motion> from{motion(10. * i, e1), motion(12. * i, e2), motion(30. * i, e3)};
    const std::vector<Motion> to{motion(10. * i, e1 + e2), motion(12. * i, e1 - e2),
                                 motion(30. * i, e3)};
    const Continuation found = continued(0, from, 1, to);
    EXPECT_EQ(found.to[0], Continuation::nowhere);
    EXPECT_EQ(found.to[1], Continuation::nowhere);
    EXPECT_EQ(found.to[2], 2);
    ASSERT_EQ(found.coalescences.size(), 1U);
    EXPECT_FALSE(found.coalescences[0].ordered);
    EXPECT_FALSE(found.doubtful);
}

TEST(Continued, PairsThatDieOutFasterThanTheyAreApartDoNotMatter) {
    const Complex i(0, 1);
    for (const double decay : {0.0, 5.0, 40.0}) {
        const std::vector<Motion> from{motion(10. * i - decay, e1), motion(20. * i - decay, e2)};
        const std::vector<Motion> to{motion(20. * i - decay, e1), motion(10. * i - decay, e2)};
        // Apart by 10 1/s at both ends: meeting could drive them by no more than the sum.
        EXPECT_EQ(continued(0, from, 1, to).coalescences.size(), decay < 20 ? 1U : 0U) << decay;
    }
}

TEST(Continued, FastMotionsThatCannotMeetAreLeftOut) {
    const Complex i(0, 1);
    std::vector<Motion> from{motion(10. * i, e1), motion(20. * i, e2)};
    std::vector<Motion> to{motion(20. * i, e1), motion(10. * i, e2)};
    for (Motion *one : {&from[0], &to[0]})
        one->may_meet = false;
    EXPECT_TRUE(continued(0, from, 1, to).coalescences.empty());
}

TEST(Continued, AMotionWithoutAPartnerIsDoubtfulUnlessItDiesOut) {
    const Complex i(0, 1);
    for (const double decay : {0.0, 50.0}) {
        const std::vector<Motion> from{motion(10. * i, e1), motion(20. * i - decay, e2),
                                       motion(300. * i, e3)};
        const std::vector<Motion> to{motion(10. * i, e1), motion(300. * i, e3)};
        const Continuation found = continued(0, from, 1, to);
        EXPECT_EQ(found.to, (std::vector<int>{0, Continuation::nowhere, 1}));
        EXPECT_EQ(found.doubtful, decay == 0) << decay;
    }
}

/// Two motions mix with a third one that is too fast to meet another. Next to the fastest that was
/// computed such a one comes and goes, and the two are a pair; well below it, three are no pair.
TEST(Continued, AFastMotionCountsInAMixtureUnlessItIsNextToTheFastest) {
    const Complex i(0, 1);
    const double third = std::sqrt(1.0 / 3);
    const Complex turn = std::exp(2.0 * std::numbers::pi / 3 * i);
    for (const double share : {0.4, 0.8, 0.97}) {
        std::vector<Motion> from{motion(10. * i, e1), motion(12. * i, e2),
                                 motion(share * 100. * i, e3)};
        std::vector<Motion> to;
        for (int k = 0; k < 3; ++k) // of all three in equal parts
            to.push_back(
                motion(from[static_cast<std::size_t>(k)].value,
                       third * (e1 + std::pow(turn, k) * e2 + std::pow(turn, 2 * k) * e3)));
        for (std::vector<Motion> *motions : {&from, &to}) {
            for (Motion &one : *motions)
                one.state = Eigen::Vector4cd(one.state(0), one.state(1), one.state(2), 0);
            (*motions)[2].may_meet = false;
            motions->push_back(motion(100. * i, e3));
            motions->back().state = Eigen::Vector4cd(0, 0, 0, 1);
            motions->back().may_meet = false;
        }
        const Continuation found = continued(0, from, 1, to);
        EXPECT_EQ(found.to[3], 3) << share;
        EXPECT_EQ(found.doubtful, share < 0.9) << share;
        EXPECT_EQ(found.coalescences.size(), share < 0.9 ? 0U : 1U) << share;
    }
}

TEST(Continued, CopiesOfAPeriodicSystemMeetToo) {
    // Copies 8 rad/s apart: 3 + 8 = 11 is below 12, 5 + 8 = 13 above; no others change sides.
    const Complex i(0, 1);
    std::vector<Motion> from{motion(12. * i, e1), motion(3. * i, e2)};
    std::vector<Motion> to{motion(12. * i, e1), motion(5. * i, e2)};
    for (std::vector<Motion> *motions : {&from, &to})
        for (Motion &one : *motions)
            one.repeats = 8;
    const Continuation found = continued(0, from, 1, to);
    ASSERT_EQ(found.coalescences.size(), 1U);
    EXPECT_EQ(found.coalescences[0].aliases, 1);
    EXPECT_EQ(found.coalescences[0].second_from, 11. * i);
    EXPECT_EQ(found.coalescences[0].second_to, 13. * i);
}

TEST(Continued, NothingContinuesNothing) {
    const std::vector<Motion> one{motion({0, 1}, e1)};
    EXPECT_TRUE(continued(0, {}, 1, one).to.empty());
    EXPECT_EQ(continued(0, one, 1, {}).to, std::vector<int>{Continuation::nowhere});
}

/// Unstable between the two natural frequencies, where one eigenvalue is real: from speeds that
/// step over the band.
TEST(Coalescence, AsymmetricShaftOnIsotropicBearings) {
    for (const double width : {20.0, 1.0, 1e-2}) {
        const double a = 103;
        const BandsFound found =
            find_bands(motions_of(asymmetric_shaft(a, a + width)), grid(1, 251, 11));
        expect_band(found, a, a + width, 1e-9 * a); // documented: relative 1e-10 of each end
    }
}

TEST(Coalescence, EqualStiffnessesHaveNoBand) {
    const BandsFound found = find_bands(motions_of(asymmetric_shaft(103, 103)), grid(1, 251, 11));
    EXPECT_TRUE(found.bands.empty());
}

/// With external damping an eigenvalue is zero where (a^2 - s^2)(b^2 - s^2) + d^2 s^2 = 0, and
/// nothing grows where that has no roots: d > b - a.
TEST(Coalescence, DampingNarrowsTheBandOfAnAsymmetricShaftToNothing) {
    const double a = 103;
    const double b = 113;
    for (const double share : {0.1, 0.9, 0.999, 1.001, 3.0}) {
        const double d = share * (b - a);
        const BandsFound found =
            find_bands(motions_of(asymmetric_shaft(a, b, d)), grid(1, 251, 11));
        if (share > 1) {
            EXPECT_TRUE(found.bands.empty()) << share;
            continue;
        }
        const double mean = (a * a + b * b - d * d) / 2;
        const double half = std::sqrt(mean * mean - a * a * b * b);
        // The narrowest is 0.9 rad/s wide: the root's condition costs a digit.
        expect_band(found, std::sqrt(mean - half), std::sqrt(mean + half), 1e-8 * a);
    }
}

/// Two oscillators under a circulatory force p = speed: flutter from p = |a^2 - b^2|/2 on.
TEST(Coalescence, FlutterOfACirculatorySystem) {
    const double a = 20;
    const double b = 21;
    const auto at = motions_of([=](double p) { return circulatory(a, b, p); });
    for (const int count : {3, 8, 50})
        expect_band(find_bands(at, grid(0, 100, count)), (b * b - a * a) / 2, 100, 1e-8 * 20.5);
}

/// Ziegler's column, masses 2 m and m, follower load P in units of c/l:
/// 2 l^4 + (7 - 2 P) l^2 + 1 = 0, flutter from 7/2 - sqrt 2 on, divergence above 7/2 + sqrt 2.
TEST(Coalescence, ZieglersColumn) {
    Eigen::Matrix2d M;
    M << 3, 1, 1, 1;
    const auto at = motions_of([&](double P) {
        Eigen::Matrix2d K;
        K << 2 - P, P - 1, -1, 1;
        return state_matrix(M, Eigen::Matrix2d::Zero(), K, 1);
    });
    for (const int count : {2, 5, 40})
        expect_band(find_bands(at, grid(0, 8, count)), 3.5 - std::sqrt(2.0), 8, 1e-9);
}

/// Two oscillators that do not know of each other: lines that cross, and nothing grows.
TEST(Coalescence, DecoupledMotionsCross) {
    const auto at = motions_of([](double s) { return waves(10 + s, 20 - s, 0, 1); });
    const std::vector<Motion> from = at(0);
    const std::vector<Motion> to = at(9);
    const Continuation found = continued(0, from, 9, to);
    int pairs = 0;
    for (const Coalescence &meeting : found.coalescences) {
        EXPECT_TRUE(meeting.ordered);
        pairs += meeting.first_from.imag() > 0 && meeting.second_from.imag() > 0 ? 1 : 0;
    }
    EXPECT_EQ(pairs, 1);
    for (std::size_t i = 0; i < from.size(); ++i) { // 10 -> 19 and 20 -> 11, both conjugates
        const double expected = std::abs(from[i].value.imag()) < 15 ? 19 : 11;
        ASSERT_NE(found.to[i], Continuation::nowhere);
        EXPECT_NEAR(std::abs(to[static_cast<std::size_t>(found.to[i])].value.imag()), expected,
                    1e-9);
    }
    const BandsFound bands = find_bands(at, grid(0, 9, 4));
    EXPECT_TRUE(bands.bands.empty());
    EXPECT_TRUE(bands.doubtful.empty());
}

// Of opposite actions, l = 3 i +- sqrt(k^2 - (W - W0)^2): a band of the width 2 k about W0, however
// narrow, from one step in few looks; without coupling none.
TEST(Coalescence, OppositeActionsPassEachOtherOrGrow) {
    constexpr double middle = 103.21;
    constexpr double noise = 1e-12; // rounding of speeds of this size, and more
    for (const double k : {0.1, 1e-3, 1e-6, 1e-9, 0.0}) {
        int looks = 0;
        const auto motions = [&](double speed) {
            ++looks;
            const double off = speed - middle;
            const Complex root = std::sqrt(Complex((k - off) * (k + off), 0));
            const bool parted = std::abs(off) > k;
            std::vector<stability::Motion> out(2);
            for (const int sign : {1, -1}) {
                stability::Motion &motion = out[sign > 0 ? 0 : 1];
                motion.value = Complex(0, 3) + static_cast<double>(sign) * root;
                motion.state = Eigen::Vector2cd(1, root * static_cast<double>(sign)).normalized();
                motion.noise = noise;
                motion.action = parted ? sign * (off > 0 ? 1 : -1) : 0;
            }
            return out;
        };
        const auto at_100 = motions(100);
        const auto at_105 = motions(105);
        const stability::Continuation next = stability::continued(100, at_100, 105, at_105);
        ASSERT_EQ(next.coalescences.size(), 1U) << k;
        looks = 0;
        const auto verdict = stability::examine(motions, next.coalescences[0]);
        EXPECT_LE(looks, 12) << k;
        using Kind = stability::CoalescenceVerdict::Kind;
        EXPECT_EQ(static_cast<int>(verdict.kind),
                  static_cast<int>(k > 0 ? Kind::grows : Kind::stable))
            << k;
        EXPECT_LE(std::abs(verdict.speed - middle), k > 0 ? k : 2 * noise) << k;
    }
}

/// Waves of like energies veer, of opposite ones lock over 2 e / (slope of the difference).
TEST(Coalescence, SignsOfEnergyDecideBetweenVeeringAndLocking) {
    for (const double e : {1.0, 1e-2, 1e-4})
        for (const int count : {2, 5, 12}) {
            const auto crossing = [e](double sign) {
                return motions_of([=](double s) { return waves(10 + s, 20 - s, e, sign); });
            };
            const BandsFound veering = find_bands(crossing(1), grid(0.1, 9, count));
            EXPECT_TRUE(veering.bands.empty()) << e << " " << count;
            // Growth sqrt(e^2 - (s - 5)^2); ends as roots to 1e-10 of the speed.
            expect_band(find_bands(crossing(-1), grid(0.1, 9, count)), 5 - e, 5 + e, 1e-9 * 5);
        }
}

} // namespace whirl::stability
