// Functions with common poles, written down: interpolated through values at places of its own
// choice they agree in between, however narrow their resonances.

#include "linalg/rational_curve.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace rational_curve_test {

using namespace whirl;
using Complex = std::complex<double>;

constexpr double enough = 1e-9;

linalg::RationalCurve::Values values(Eigen::MatrixXcd numbers) {
    const Eigen::Index rows = numbers.rows();
    return {std::move(numbers), Eigen::VectorXd::Zero(rows)};
}

/// Resonances in a range from 1 to 10, with damping ratios from 1e-7 to 1.
struct Resonances {
    std::vector<Complex> poles;
    Eigen::MatrixXcd residues; ///< a row a quantity

    explicit Resonances(tests::Random &random, int count, double least, double most)
        : residues(4, count) {
        for (int k = 0; k < count; ++k) {
            const double frequency = random(0.5, 14);
            poles.emplace_back(frequency,
                               frequency * std::exp(random(std::log(least), std::log(most))));
        }
        for (Complex &residue : residues.reshaped())
            residue = std::polar(random(0.1, 1), random(0, 2 * std::numbers::pi));
    }

    [[nodiscard]] Eigen::MatrixXcd at(double s) const {
        Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(2, 2); // of quantity 1, 2: two numbers
        for (std::size_t k = 0; k < poles.size(); ++k) {
            const Complex pole = poles[k];
            const Complex one = s * s * pole.real() / (pole * pole - s * s);
            for (int i = 0; i < 4; ++i)
                out(i / 2, i % 2) += residues(i, static_cast<Eigen::Index>(k)) * one;
        }
        return out;
    }
};

TEST(RationalCurve, AgreesBetweenItsPlaces) {
    tests::Random random(5);
    for (int trial = 0; trial < 20; ++trial) {
        const Resonances of(random, 2 + trial % 9, 1e-5, 0.3);
        int solved = 0;
        const linalg::RationalCurve curve(
            1, 10,
            [&](double s) {
                ++solved;
                return std::optional(values(of.at(s)));
            },
            enough);
        EXPECT_LE(curve.misfit(), enough);
        EXPECT_LT(solved, 250) << trial; // of places that someone has to solve for
        for (int i = 0; i < 500; ++i) {
            const double s = random(1, 10);
            const Eigen::MatrixXcd exact = of.at(s);
            for (int q = 0; q < 2; ++q) // what was accepted at some places is no more than ten
                                        // times that at others
                EXPECT_LT((curve.at(s).row(q) - exact.row(q)).norm(),
                          10 * enough * exact.row(q).norm() + 1e-9)
                    << trial << " " << s;
        }
        for (int i = 0; i < 50; ++i) { // slopes against differences over a part of the least width
            const double s = random(1.01, 9.9);
            double width = 1e-2;
            for (const Complex pole : of.poles)
                width = std::min(width, 1e-3 * std::abs(pole - s));
            const Eigen::MatrixXcd exact = (of.at(s + width) - of.at(s - width)) / (2 * width);
            EXPECT_LT((curve.slope(s) - exact).norm(), 1e-5 * exact.norm()) << trial << " " << s;
        }
        for (const Complex pole : of.poles) // those in the range, both signs of the damping
            if (pole.real() > 1 && pole.real() < 10 && pole.imag() < 0.02 * pole.real()) {
                const auto off = [pole](Complex found) { return std::abs(found - pole); };
                EXPECT_LT(off(*std::ranges::min_element(curve.poles(), {}, off)),
                          1e-3 * pole.imag())
                    << trial << " " << pole;
            }
    }
}

TEST(RationalCurve, UndampedResonancesWithoutASolution) {
    const auto solve = [](double s) -> std::optional<linalg::RationalCurve::Values> {
        if (s == 0 || s == 2)
            return std::nullopt;
        return values(
            Eigen::MatrixXcd::Constant(1, 1, std::tan(s) + 1e-6 / (s - 2))); // one is faint
    };
    const linalg::RationalCurve curve(-1, 5, solve, enough);
    for (const double place : {std::numbers::pi / 2, 2.0, 3 * std::numbers::pi / 2}) {
        const auto off = [place](Complex found) { return std::abs(found - place); };
        EXPECT_LT(off(*std::ranges::min_element(curve.poles(), {}, off)), 1e-8) << place;
    }
    EXPECT_NEAR(curve.at(0)(0, 0).real(), 1e-6 / -2, 1e-9);
}

} // namespace rational_curve_test
