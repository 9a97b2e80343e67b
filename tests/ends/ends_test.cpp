// Speeds at which the number of growing motions changes, against dense state matrices of the whole
// rotor, counted and bisected.

#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "ends/stability_ends.h"
#include "stability/band_finder.h"
#include "support/balancer_scenes.h"
#include "support/dense_eigenvalues.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <random>

namespace {

using namespace whirl;

/// Two or three discs on a damped shaft, with what the draw adds: anisotropies, balls, internal
/// damping, cross coupling.
struct Drawn {
    model::Rotor rotor;
    results::Form form = results::Form::general;
};

Drawn drawn(int seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto uniform = [&random](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    Drawn out;
    model::Rotor &rotor = out.rotor;
    rotor.shaft = tests::uniform_shaft(1, uniform(0.03, 0.06), tests::steel());
    rotor.shaft.order = seed % 6 == 0 ? 4 : 1;
    const int discs = 1 + static_cast<int>(uniform(0, 2.999));
    for (int i = 0; i < discs; ++i) {
        const double Id = uniform(0.1, 0.4);
        rotor.discs.push_back(tests::disc_at((i + uniform(0.15, 0.85)) / discs, uniform(5, 30), Id,
                                             uniform(0.5, 1.8) * Id));
    }
    rotor.bearings = {
        tests::isotropic_bearing(0, std::exp(uniform(13, 17)), std::exp(uniform(3, 8))),
        tests::isotropic_bearing(1, std::exp(uniform(13, 17)), std::exp(uniform(3, 8)))};
    const bool rotating = seed % 3 != 0;
    out.form = rotating ? results::Form::rotating : results::Form::general;
    if (rotating && uniform(0, 1) < 0.7)
        for (const model::Disc &disc : rotor.discs)
            rotor.anisotropies.push_back(
                {"", disc.z, uniform(0.02, 0.2) * disc.Id, uniform(0, 3.1)});
    const int balancers = rotating ? static_cast<int>(uniform(0, 2.999)) : 0;
    for (int i = 0; i < std::min(balancers, discs); ++i) {
        const double mass = std::exp(uniform(-4, -1));
        const double radius = uniform(0.05, 0.2);
        rotor.balancers.push_back(
            tests::ball_balancer(rotor.discs[static_cast<std::size_t>(i)].z, 2, mass,
                                 radius, std::exp(uniform(-2, 4)) * mass,
                                 uniform(0.2, 0.95) * 2 * mass * radius));
    }
    if (uniform(0, 1) < 0.6)
        rotor.shaft.internal_damping = std::exp(uniform(-14, -7));
    if (uniform(0, 1) < 0.4)
        for (model::Bearing &bearing : rotor.bearings) {
            const double cross = uniform(0.02, 0.5) * bearing.rows[0].k(0, 0);
            bearing.rows[0].k(0, 1) = cross;
            bearing.rows[0].k(1, 0) = -cross;
        }
    if (!rotating && uniform(0, 1) < 0.5)
        rotor.bearings[0].rows[0].k(1, 1) *= uniform(0.5, 0.95);
    return out;
}

/// Eigenvalues of the dense state matrix of the whole rotor.
class WholeRotor {
  public:
    explicit WholeRotor(const Drawn &drawn)
        : _form(drawn.form), _d(drawn.rotor, drawn.rotor.shaft.order) {
        if (_form == results::Form::rotating)
            _rotating = assembly::assemble_rotating(
                _d, 0,
                balancers::balancer_elements(drawn.rotor,
                                             balancers::arrangement_at_balance(drawn.rotor)));
        else
            _fixed = assembly::assemble_fixed(_d, 0);
    }
    [[nodiscard]] std::vector<std::complex<double>> eigenvalues(double speed) const {
        if (_form == results::Form::rotating)
            return tests::dense_eigenvalues(_rotating, speed);
        return tests::dense_eigenvalues(Eigen::MatrixXd(_fixed.M.view()),
                                        Eigen::MatrixXd(_fixed.C.view()) +
                                            speed * Eigen::MatrixXd(_fixed.G.view()),
                                        Eigen::MatrixXd(_fixed.K.view()) +
                                            speed * Eigen::MatrixXd(_fixed.Kc.view()));
    }
    [[nodiscard]] int growing(double speed) const {
        const auto values = eigenvalues(speed);
        return static_cast<int>(std::count_if(values.begin(), values.end(),
                                              [](auto value) { return value.real() > 0; }));
    }
    [[nodiscard]] const assembly::Discretization &discretization() const { return _d; }

  private:
    results::Form _form;
    assembly::Discretization _d;
    assembly::RotatingSystem _rotating;
    assembly::FixedSystem _fixed;
};

struct Bisected {
    double speed;
    int below, above;
};

void bisect(const WholeRotor &rotor, double a, int grow_a, double b, int grow_b,
            std::vector<Bisected> &out) {
    if (grow_a == grow_b)
        return;
    if (b - a < 1e-9 * b) {
        out.push_back({(a + b) / 2, grow_a, grow_b});
        return;
    }
    const double middle = (a + b) / 2;
    const int grow = rotor.growing(middle);
    bisect(rotor, a, grow_a, middle, grow, out);
    bisect(rotor, middle, grow, b, grow_b, out);
}

std::vector<Bisected> bisected(const WholeRotor &rotor, double from, double to, int steps) {
    std::vector<Bisected> out;
    double a = from;
    int grow_a = rotor.growing(a);
    for (int k = 1; k <= steps; ++k) {
        const double b = from + (to - from) * k / steps;
        const int grow_b = rotor.growing(b);
        bisect(rotor, a, grow_a, b, grow_b, out);
        a = b;
        grow_a = grow_b;
    }
    return out;
}

TEST(Ends, OfRandomRotorsAreThoseOfTheCountedStateMatrix) {
    for (int seed = 1; seed <= 24; ++seed) {
        const Drawn drawn = ::drawn(seed);
        const WholeRotor whole(drawn);
        const double from = 20;
        const double to = 1000;
        const auto t0 = std::chrono::steady_clock::now();
        const ends::AllMotions motions(whole.discretization(), drawn.form,
                                       balancers::arrangement_at_balance(drawn.rotor), nullptr,
                                       from, to);
        const ends::EndsFound found = ends::find_ends(motions, from, to, {});
        const auto t1 = std::chrono::steady_clock::now();
        const auto expected = bisected(whole, from, to, 300);
        const auto t2 = std::chrono::steady_clock::now();
        std::cout << seed << " planar " << whole.discretization().planar_size() << " ends "
                  << found.ends.size() << " expected " << expected.size() << " doubtful "
                  << found.doubtful.size() << " time "
                  << std::chrono::duration<double>(t1 - t0).count() << " "
                  << std::chrono::duration<double>(t2 - t1).count() << "\n";
        for (const auto &end : found.ends)
            std::cout << "   found " << end.speed << " " << results::end_kind_name(end.kind) << " "
                      << end.growing_below << " " << end.growing_above << " "
                      << end.frequency_rotating.value_or(-1) << "\n";
        if (found.ends.size() != expected.size())
            for (const auto &end : expected)
                std::cout << "   expected " << end.speed << " " << end.below << " " << end.above
                          << "\n";
        EXPECT_EQ(found.ends.size(), expected.size()) << seed;
        if (found.ends.size() == expected.size())
            for (std::size_t i = 0; i < expected.size(); ++i) {
                EXPECT_NEAR(found.ends[i].speed, expected[i].speed, 1e-7 * expected[i].speed)
                    << seed;
                EXPECT_EQ(found.ends[i].growing_below, expected[i].below) << seed;
                EXPECT_EQ(found.ends[i].growing_above, expected[i].above) << seed;
            }
    }
}

} // namespace
