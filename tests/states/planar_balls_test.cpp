// Planar rotors with three and four balls: all steady states, their small motions and the borders
// between, against the published equations of motion.
//
// The equations: J. Chung, D. S. Ro, Dynamic analysis of an automatic dynamic balancer for rotating
// mechanisms, J. Sound Vib. 228 (1999) 1035; K. Green, A. R. Champneys, N. J. Lieven, Bifurcation
// analysis of an automatic dynamic balancing mechanism for eccentric rotors, J. Sound Vib. 291
// (2006) 861; of four balls D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson,
// Automatic two-plane balancing for rigid rotors, Int. J. Non-Linear Mech. 43 (2008) 527, equations
// (9) to (13), without tilt. Lengths in radii of the race, masses in rotor masses, time in
// 1/Omega_1.
//
// Of that paper the curves H_cyl are read too (figures 5a, 6a, b, c and 7): its static imbalance
// sits between two equal races, so that cylindrical motions about balance are those of a planar
// rotor whose four balls stand in two pairs. "In a planar analysis only the H_cyl curves are
// present, and as such, they are always accompanied by a change in stability."

#include "states/state_search.h"
#include "support/balancer_scenes.h"
#include "support/dense_eigenvalues.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace whirl::states::planar {
namespace {

using results::SteadyBorder;
using results::SteadyState;
using results::SteadyStates;
using Complex = std::complex<double>;
using Kind = SteadyState::Kind;
using std::numbers::pi;

struct Position {
    Complex w; ///< deflection, in the rotor
    std::vector<double> angles;
};

struct PlanarBalls {
    int n = 4;
    double m = 0.01;   ///< of a ball
    double eps = 0.01; ///< eccentricity
    double c = 0.01;   ///< damping ratio of the supports
    double c_b = 0.01; ///< drag of a ball over its mass
    double speed = 1;

    [[nodiscard]] model::Case scene() const {
        model::Case scene = tests::jeffcott_two_balls(m);
        scene.rotor.bearings = {tests::isotropic_bearing(0, 0.5, c),
                                tests::isotropic_bearing(2, 0.5, c)};
        scene.rotor.balancers = {tests::ball_balancer(1, n, m, 1, c_b * m, eps)};
        scene.rotor.balancers[0].tilt_inertia = false;
        return scene;
    }

    /// Where w is not zero every ball stands on its line, on one side or on the other: on the line
    /// e = exp(i t) with w = r e, r of any sign, D r e = speed^2 (eps + b e) with b = m (n - 2
    /// opposite), of which the modulus of eps gives r by a quadratic equation. These are all.
    /// @param opposite  so many balls stand at -e
    /// @param sign  of the root
    [[nodiscard]] std::optional<Position> on_line(int opposite, int sign) const {
        const Complex D(1 - (1 + n * m) * speed * speed, 2 * c * speed);
        const double b = m * (n - 2 * opposite);
        const double square = std::norm(D) * eps * eps - std::pow(D.imag() * b, 2);
        if (square < 0)
            return std::nullopt;
        const double r = speed * speed * (D.real() * b + sign * std::sqrt(square)) / std::norm(D);
        const Complex e = speed * speed * eps / (D * r - speed * speed * b);
        std::vector<double> angles(static_cast<std::size_t>(n), std::arg(e));
        for (int k = 0; k < opposite; ++k)
            angles[static_cast<std::size_t>(k)] += pi;
        return Position{r * e, angles};
    }

    /// Balance: sum exp(i a) = -eps/m; the first n - 2 angles are free.
    [[nodiscard]] std::optional<Position> balanced(std::vector<double> free) const {
        Complex rest = -eps / m;
        for (const double angle : free)
            rest -= std::polar(1.0, angle);
        if (std::abs(rest) > 2)
            return std::nullopt;
        for (const int side : {-1, 1})
            free.push_back(std::arg(rest) + side * std::acos(std::abs(rest) / 2));
        return Position{0, free};
    }
    /// Of balance with the largest |sum exp(2 i a)|, by which alone small motions about its
    /// positions differ: four balls in two pairs, of three (eps < m) one beside the imbalance.
    [[nodiscard]] Position farthest_from_round() const {
        const double angle = std::acos(n == 4 ? -eps / (4 * m) : -(1 + eps / m) / 2);
        return {0, n == 4 ? std::vector<double>{angle, -angle, angle, -angle}
                          : std::vector<double>{0, angle, -angle}};
    }

    /// Of small motions about it, in turning axes: x, y and the angles of the balls.
    [[nodiscard]] std::vector<Complex> roots(const Position &position) const {
        const Eigen::Index size = 2 + n;
        const double total = 1 + n * m;
        Eigen::MatrixXd M = Eigen::MatrixXd::Identity(size, size);
        Eigen::MatrixXd C = c_b * M;
        Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
        M(0, 0) = M(1, 1) = total;
        C.topLeftCorner<2, 2>() << 2 * c, -2 * speed * total, 2 * speed * total, 2 * c;
        K.topLeftCorner<2, 2>() << 1 - total * speed * speed, -2 * c * speed, 2 * c * speed,
            1 - total * speed * speed;
        for (int k = 0; k < n; ++k) {
            const double angle = position.angles[static_cast<std::size_t>(k)];
            const Eigen::Vector2d outwards(std::cos(angle), std::sin(angle));
            const Eigen::Vector2d along(-std::sin(angle), std::cos(angle));
            const Eigen::Index own = 2 + k;
            M.block<2, 1>(0, own) = m * along;
            C.block<2, 1>(0, own) = -2 * speed * m * outwards;
            K.block<2, 1>(0, own) = -speed * speed * m * along;
            M.block<1, 2>(own, 0) = along.transpose();
            C.block<1, 2>(own, 0) = 2 * speed * outwards.transpose();
            K.block<1, 2>(own, 0) = -speed * speed * along.transpose();
            K(own, own) = speed * speed * std::real(std::polar(1.0, -angle) * position.w);
        }
        return tests::dense_eigenvalues(M, C, K);
    }

    // Roots along the family are zero: of rounding 1e-9 is left, for they are 0 and -c_b apart.
    static constexpr double nothing = 1e-9;
    [[nodiscard]] int growing(const Position &position) const {
        const std::vector<Complex> all = roots(position);
        return static_cast<int>(
            std::ranges::count_if(all, [](Complex root) { return root.real() > nothing; }));
    }
    /// Largest real part of those that are not along the family.
    [[nodiscard]] double growth(const Position &position) const {
        double largest = -std::numeric_limits<double>::infinity();
        for (const Complex root : roots(position))
            if (position.w != 0.0 || std::abs(root) > 10 * nothing)
                largest = std::max(largest, root.real());
        return largest;
    }
};

// Read from the vector graphics of the authors' preprint, whose lines go by steps of 0.1 point,
// 0.0015 in Omega: at each point a pair crosses the axis within that.
TEST(PlanarBalls, PublishedHopfCurvesOfFourBalls) {
    struct Point {
        double speed, value;
    };
    struct Curve {
        const char *figure;
        std::function<void(PlanarBalls &, double)> set;
        std::vector<Point> points;
    };
    const auto with_mass = [](PlanarBalls &rotor, double m) { rotor.m = m; };
    const auto heavy = [](double PlanarBalls::*entry) {
        return [entry](PlanarBalls &rotor, double value) {
            rotor.m = 0.025;
            rotor.*entry = value;
        };
    };
    const auto both = [](PlanarBalls &rotor, double m) { rotor.m = rotor.eps = m; };
    const std::vector<Curve> curves{{"5a, above Omega_1",
                                     with_mass,
                                     {{1.0020, 0.033812},
                                      {1.0201, 0.027702},
                                      {1.0382, 0.022485},
                                      {1.0563, 0.018214},
                                      {1.0751, 0.019327},
                                      {1.0932, 0.025009},
                                      {1.1512, 0.039353}}},
                                    {"5a",
                                     with_mass,
                                     {{1.3374, 0.0025246},
                                      {1.3519, 0.0034305},
                                      {1.3620, 0.0041166},
                                      {1.4127, 0.0052555},
                                      {1.4562, 0.0063298},
                                      {1.4975, 0.0074821},
                                      {1.5163, 0.0080513},
                                      {1.5989, 0.010964},
                                      {1.7162, 0.01609},
                                      {1.8908, 0.025539}}},
                                    {"6a",
                                     heavy(&PlanarBalls::eps),
                                     {{0.9727, 0.0026219},
                                      {0.9920, 0.0051463},
                                      {1.0278, 0.0098377},
                                      {1.0492, 0.012621},
                                      {1.0850, 0.017215},
                                      {1.1021, 0.014788},
                                      {1.8631, 0.020226},
                                      {1.7773, 0.042265},
                                      {1.6622, 0.059935},
                                      {1.5492, 0.067927},
                                      {1.7902, 0.068997},
                                      {1.5313, 0.07508},
                                      {1.6135, 0.075405},
                                      {1.7544, 0.088576},
                                      {1.8853, 0.099772}}},
                                    {"6b",
                                     heavy(&PlanarBalls::c),
                                     {{1.0353, 0.0069596},
                                      {1.0375, 0.027993},
                                      {1.0608, 0.057443},
                                      {1.1045, 0.11699},
                                      {1.2034, 0.26553},
                                      {1.0989, 0.012139},
                                      {1.1292, 0.071198},
                                      {1.2514, 0.22508},
                                      {1.4513, 0.3013},
                                      {1.6964, 0.31326},
                                      {1.9160, 0.27767},
                                      {2.0869, 0.20987}}},
                                    {"6c",
                                     heavy(&PlanarBalls::c_b),
                                     {{1.0360, 0.0040466},
                                      {1.0297, 0.0063103},
                                      {1.0395, 0.016829},
                                      {1.0650, 0.017636},
                                      {1.1003, 0.0077675},
                                      {1.8757, 0.010841},
                                      {1.8496, 0.019415},
                                      {1.8807, 0.052101},
                                      {1.9901, 0.12945},
                                      {2.1088, 0.25161},
                                      {2.2090, 0.42556}}},
                                    {"7",
                                     both,
                                     {{1.0131, 1.3765e-6},
                                      {1.0417, 1.0469e-5},
                                      {1.0845, 6.4853e-5},
                                      {1.1210, 1.7134e-4},
                                      {1.2066, 7.3026e-4},
                                      {1.2701, 1.4805e-3},
                                      {1.6435, 0.013207},
                                      {1.1916, 0.036676},
                                      {1.5400, 0.086825},
                                      {1.1752, 0.088425},
                                      {0.8967, 0.59198}}}};
    constexpr double step = 0.0015;
    for (const Curve &curve : curves)
        for (const Point &point : curve.points) {
            PlanarBalls rotor;
            curve.set(rotor, point.value);
            const StateSearch search(rotor.scene(), point.speed - step, point.speed + step);
            const auto growing = [&](double speed) { // of two pairs, the usual position
                const auto found = search.balanced(speed, 0);
                return found ? found->state.growing : -1;
            };
            EXPECT_EQ(std::abs(growing(point.speed + step) - growing(point.speed - step)), 2)
                << curve.figure << " at Omega = " << point.speed << ", " << point.value;
        }
}

bool same_angles(std::vector<double> some, const std::vector<double> &others) {
    for (const double angle : others) {
        const auto own = std::ranges::find_if(some, [angle](double other) {
            return std::abs(std::remainder(other - angle, 2 * pi)) < 1e-8;
        });
        if (own == some.end())
            return false;
        some.erase(own);
    }
    return some.empty();
}

std::vector<Position> all_on_lines(const PlanarBalls &rotor) {
    std::vector<Position> out;
    for (int opposite = 0; 2 * opposite <= rotor.n; ++opposite)
        for (const int sign : {1, -1}) {
            // Of as many on either side the other root is the same seen from the other side.
            if (2 * opposite == rotor.n && sign < 0)
                continue;
            if (auto position = rotor.on_line(opposite, sign))
                out.push_back(*position);
        }
    return out;
}

/// Positions over the whole family, among them those with balls in pairs.
std::vector<Position> family_of(const PlanarBalls &rotor) {
    std::vector<Position> out;
    constexpr int count = 24;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < (rotor.n == 4 ? count : 1); ++k) {
            std::vector<double> free{2 * pi * i / count};
            if (rotor.n == 4)
                free.push_back(2 * pi * (k + 0.5) / count);
            if (auto position = rotor.balanced(free))
                out.push_back(*position);
        }
    if (rotor.n == 4 || rotor.eps < rotor.m)
        out.push_back(rotor.farthest_from_round());
    return out;
}

/// Nine members stand for the family: what they all do, others in between may not where motions
/// grow, but none grows where these do not.
void compare_family(const PlanarBalls &rotor, const SteadyState &state) {
    double largest = -std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity();
    for (const Position &position : family_of(rotor)) {
        const double growth = rotor.growth(position);
        largest = std::max(largest, growth);
        least = std::min(least, growth);
    }
    EXPECT_TRUE(state.family);
    EXPECT_EQ(state.stable == true, largest < 0);
    if (!state.stable) {
        EXPECT_LT(least, 0);
        EXPECT_GT(largest, 0);
    }
    if (rotor.n == 4 || rotor.eps < rotor.m) {
        EXPECT_GT(state.growth, rotor.growth(rotor.farthest_from_round()) - 1e-8);
    }
    Complex sum = rotor.eps / rotor.m;
    for (const double angle : state.angles[0])
        sum += std::polar(1.0, angle);
    EXPECT_LT(std::abs(sum), 1e-9);
}

TEST(PlanarBalls, AllStatesWithTheirRoots) {
    for (const int n : {3, 4})
        for (const double m : {0.001, 0.003, 0.006, 0.012, 0.03})
            for (const double speed : {0.6, 0.9, 0.97, 1.02, 1.1, 1.3, 1.5, 1.7, 2.5, 4.0}) {
                PlanarBalls rotor;
                rotor.n = n;
                rotor.m = m;
                rotor.speed = speed;
                SCOPED_TRACE(std::to_string(n) + " balls of " + std::to_string(m) + " at " +
                             std::to_string(speed));
                bool undecided = false;
                const auto found = StateSearch(rotor.scene(), speed, speed).at(speed, undecided);
                EXPECT_FALSE(undecided);
                const std::vector<Position> expected = all_on_lines(rotor);
                const bool can_balance = n * m > rotor.eps;
                ASSERT_EQ(found.size(), expected.size() + (can_balance ? 1 : 0));
                for (const Position &position : expected) {
                    const auto own = std::ranges::find_if(found, [&](const auto &one) {
                        return one.state.kind != Kind::balanced &&
                               same_angles(one.state.angles[0], position.angles);
                    });
                    ASSERT_NE(own, found.end());
                    const SteadyState &state = own->state;
                    EXPECT_NEAR(state.residual, std::abs(position.w), 1e-9);
                    // Of n - 1 equal roots rounding moves each by its root.
                    EXPECT_NEAR(state.growth, rotor.growth(position), 1e-7);
                    EXPECT_EQ(state.growing, rotor.growing(position));
                    EXPECT_EQ(state.stable, rotor.growth(position) < 0);
                    // "Inline states ... are found to be always unstable."
                    if (n == 4 && state.kind == Kind::split) {
                        EXPECT_EQ(state.stable, false);
                    }
                }
                for (const auto &one : found)
                    if (one.state.kind == Kind::balanced)
                        compare_family(rotor, one.state);
            }
}

struct Border {
    double at = 0;
    SteadyBorder::Kind kind = SteadyBorder::Kind::fold;
    int below = 0, above = 0; ///< growing; -1: no such state
    double frequency = 0;
};

using RotorAt = std::function<PlanarBalls(double place)>;

/// All borders of the states on a line, by halving between places closely spaced.
std::vector<Border> borders_on_lines(const RotorAt &at, double from, double to, int count) {
    std::vector<Border> out;
    const int n = at(from).n;
    for (int opposite = 0; 2 * opposite <= n; ++opposite)
        for (const int sign : {1, -1}) {
            if (2 * opposite == n && sign < 0)
                continue;
            const auto growing = [&](double place) {
                const PlanarBalls rotor = at(place);
                const auto position = rotor.on_line(opposite, sign);
                return position ? rotor.growing(*position) : -1;
            };
            double low = from;
            int before = growing(low);
            for (int k = 1; k < count; ++k) {
                const double high = from + (to - from) * k / (count - 1);
                const int after = growing(high);
                double a = low;
                double b = high;
                while (before != after && b - a > 1e-12 * b)
                    (growing((a + b) / 2) == before ? a : b) = (a + b) / 2;
                Border border;
                border.at = a;
                border.below = before;
                border.above = after;
                if (before >= 0 && after >= 0) {
                    const PlanarBalls rotor = at(a);
                    const std::vector<Complex> roots = rotor.roots(*rotor.on_line(opposite, sign));
                    const Complex critical = *std::ranges::min_element(
                        roots, {}, [](Complex root) { return std::abs(root.real()); });
                    border.frequency = std::abs(critical.imag());
                    border.kind = border.frequency > 1e-6 ? SteadyBorder::Kind::pair
                                                          : SteadyBorder::Kind::zero;
                }
                // Two states meet in a fold: it is one.
                if (before != after && (border.kind != SteadyBorder::Kind::fold || sign > 0))
                    out.push_back(border);
                before = after;
                low = high;
            }
        }
    return out;
}

/// Every border of the one is one of the other.
void expect_same(const std::vector<Border> &expected, const SteadyStates &found) {
    std::vector<SteadyBorder> of_lines; // without those of the family
    for (const SteadyBorder &border : found.borders) {
        const auto own = std::ranges::find(found.states, border.branch, &SteadyState::branch);
        ASSERT_NE(own, found.states.end());
        if (own->kind != Kind::balanced)
            of_lines.push_back(border);
    }
    EXPECT_EQ(of_lines.size(), expected.size());
    for (const Border &border : expected) {
        const auto own = std::ranges::find_if(of_lines, [&](const SteadyBorder &other) {
            return other.kind == border.kind &&
                   std::abs(found.place(other) - border.at) < 1e-7 * border.at &&
                   (border.kind == SteadyBorder::Kind::fold ||
                    (other.growing_below == border.below && other.growing_above == border.above));
        });
        if (own == of_lines.end()) {
            ADD_FAILURE() << "no " << results::steady_border_name(border.kind) << " at "
                          << border.at << ", " << border.below << " to " << border.above;
            continue;
        }
        if (border.kind == SteadyBorder::Kind::pair)
            EXPECT_NEAR(*own->frequency, border.frequency, 1e-6);
        of_lines.erase(own);
    }
    for (const SteadyBorder &border : of_lines)
        ADD_FAILURE() << "unexpected " << results::steady_border_name(border.kind) << " at "
                      << found.place(border);
}

TEST(PlanarBalls, AllBordersOverTheSpeed) {
    for (const int n : {3, 4}) {
        PlanarBalls rotor;
        rotor.n = n;
        rotor.m = 0.012;
        const RotorAt at = [&](double speed) {
            PlanarBalls out = rotor;
            out.speed = speed;
            return out;
        };
        const model::SpeedRange range{0.9, 1.7, 321};
        const SteadyStates found = steady_states(rotor.scene(), range.values());
        EXPECT_TRUE(found.undecided.empty());
        expect_same(borders_on_lines(at, range.from, range.to, 801), found);
        // Of the family that farthest from round grows up to the highest speed.
        const Position worst = rotor.farthest_from_round();
        double low = 1.5;
        double high = 1.7;
        while (high - low > 1e-12)
            (at((low + high) / 2).growing(worst) > 0 ? low : high) = (low + high) / 2;
        const auto last = std::ranges::find_if(found.borders, [](const SteadyBorder &border) {
            return border.growing_below > 0 && border.growing_above == 0;
        });
        ASSERT_NE(last, found.borders.end());
        EXPECT_NEAR(last->speed, low, 1e-7);
        EXPECT_EQ(last->kind, SteadyBorder::Kind::pair);
        for (const Position &position : family_of(rotor))
            EXPECT_EQ(at(low + 1e-6).growing(position), 0);
    }
}

TEST(PlanarBalls, AllBordersOverTheMassOfABall) {
    for (const int n : {3, 4})
        for (const double speed : {0.95, 1.3, 1.7}) {
            SCOPED_TRACE(std::to_string(n) + " balls at " + std::to_string(speed));
            const RotorAt at = [&](double m) {
                PlanarBalls out;
                out.n = n;
                out.m = m;
                out.speed = speed;
                return out;
            };
            model::SweepAxis axis;
            constexpr double from = 1.1e-4;
            constexpr double to = 0.03;
            for (int k = 0; k < 150; ++k)
                axis.values.push_back(from + (to - from) * k / 149);
            const SteadyStates found =
                steady_states_over(axis, speed, [&](double m) { return at(m).scene(); });
            expect_same(borders_on_lines(at, from, to, 600), found);
            // Balance begins where the balls together just reach, as in figure 5: eps/n.
            EXPECT_EQ(std::ranges::count_if(found.borders,
                                            [&](const SteadyBorder &border) {
                                                return border.kind == SteadyBorder::Kind::limit &&
                                                       std::abs(border.value - 0.01 / n) < 1e-9;
                                            }),
                      1);
        }
}

} // namespace
} // namespace whirl::states::planar
