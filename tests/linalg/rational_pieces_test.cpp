// Functions with more poles than one rational function takes, and with bends: written down, by
// rational functions between cuts and between halves of these.

#include "linalg/rational_pieces.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

namespace rational_pieces_test {

using namespace whirl;
using Complex = std::complex<double>;
using linalg::RationalCurve;

constexpr double enough = 1e-9;

std::optional<RationalCurve::Values> value(Complex number) {
    return RationalCurve::Values{Eigen::MatrixXcd::Constant(1, 1, number),
                                 Eigen::VectorXd::Zero(1)};
}

/// 150 resonances from 1 to 151 with damping ratios of 1e-4.
Complex of_many_poles(double s) {
    Complex sum = 0;
    for (int k = 1; k <= 150; ++k)
        sum += 1.0 / (Complex(k + 0.3, 1e-4 * k) - s);
    return sum;
}

TEST(RationalPieces, RangesWithManyPolesAreHalved) {
    const linalg::RationalPieces curve(
        {0.5, 152}, [](double s) { return value(of_many_poles(s)); }, enough, 4000);
    EXPECT_GT(curve.pieces().size(), 1U);
    std::vector<Complex> poles;
    double end = 0.5;
    for (const RationalCurve &piece : curve.pieces()) {
        EXPECT_TRUE(piece.settled());
        EXPECT_EQ(piece.from(), end);
        end = piece.to();
        for (const Complex pole : piece.poles())
            if (pole.real() >= piece.from() && pole.real() <= piece.to() &&
                std::abs(pole.imag()) < 0.1)
                poles.push_back(pole);
    }
    EXPECT_EQ(end, 152);
    ASSERT_EQ(poles.size(), 150U);
    std::ranges::sort(poles, {}, [](Complex pole) { return pole.real(); });
    for (int k = 1; k <= 150; ++k) // a residue is met to 1e-9 at half a width
        EXPECT_LE(std::abs(poles[static_cast<std::size_t>(k - 1)] - Complex(k + 0.3, 1e-4 * k)),
                  1e-6 * 1e-4 * k)
            << k;
    tests::Random random(3);
    for (int i = 0; i < 500; ++i) {
        const double s = random(0.5, 152);
        const Complex exact = of_many_poles(s);
        EXPECT_LE(std::abs(curve.with_slope(s).first(0, 0) - exact),
                  10 * enough * std::abs(exact) + 1e-9)
            << s;
    }
}

TEST(RationalPieces, BendAtTheirCuts) {
    const auto bent = [](double s) { return (1 + std::abs(s - 2)) / (s + Complex(1, 0.1)); };
    const linalg::RationalPieces curve(
        {0, 2, 5}, [&](double s) { return value(bent(s)); }, enough, 200);
    ASSERT_EQ(curve.pieces().size(), 2U);
    for (const double s : {0.1, 1.999, 2.0, 2.001, 4.7})
        EXPECT_LE(std::abs(curve.with_slope(s).first(0, 0) - bent(s)), enough) << s;
    const double beside = 1e-6;
    for (const int side : {-1, 1}) {
        const double s = 2 + side * 0.01;
        const Complex slope = (bent(s + beside) - bent(s - beside)) / (2 * beside);
        EXPECT_LE(std::abs(curve.with_slope(s).second(0, 0) - slope), 1e-7) << side;
    }
}

TEST(RationalPieces, WhatIsOnlyRoundingIsTold) {
    tests::Random random(4);
    const RationalCurve curve(
        0, 1,
        [&](double s) {
            RationalCurve::Values out{Eigen::MatrixXcd(2, 1), Eigen::VectorXd::Constant(2, 1e-14)};
            out.numbers << 1 / (s + 0.5), random(-1e-14, 1e-14);
            return std::optional(out);
        },
        enough);
    EXPECT_TRUE(curve.settled());
    EXPECT_FALSE(curve.only_rounding(0));
    EXPECT_TRUE(curve.only_rounding(1));
    EXPECT_NEAR(curve.at(0.37)(0, 0).real(), 1 / 0.87, 1e-9);
}

} // namespace rational_pieces_test
