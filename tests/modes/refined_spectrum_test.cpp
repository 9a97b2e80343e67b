// Modes of damped rotors from few shapes, refined on the whole rotor: against the dense state
// matrix, which shares the matrices but no solver, and against SLEPc on all unknowns.

#include "assembly/discretization.h"
#include "assembly/system.h"
#include "modes/form_matrices.h"
#include "modes/roots/whole_pencil.h"
#include "modes/spectrum.h"
#include "results/formulation.h"
#include "support/dense_eigenvalues.h"
#include "support/random.h"
#include "support/random_discs.h"
#include "support/scenes.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>
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
    const double last = found.modes.back().eigenvalue.imag() * (1 + of_dense);
    const auto counts = [&](const Complex &value) {
        return value.imag() > real_axis * std::abs(value) && value.imag() <= last &&
               std::abs(value) < (1 - of_dense) * found.complete_radius;
    };
    const auto listed =
        std::count_if(found.modes.begin(), found.modes.end(),
                      [&](const WhirlMode &mode) { return counts(mode.eigenvalue); });
    EXPECT_EQ(listed, std::count_if(all.begin(), all.end(), counts)) << found.speed;
    EXPECT_GE(listed, std::ssize(found.modes) / 2);
}

} // namespace

TEST(RefinedModes, AreAllOfTheStateMatrix) {
    tests::Random random(11);
    for (int draw = 0; draw < 40; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic);
        const SpectrumSolver solver(rotor, isotropic ? Form::planar_damped : Form::general, 4);
        const std::vector<double> speeds = sweep(1500, 31);
        solver.expect(speeds, 8);
        for (std::size_t k = 0; k < speeds.size(); k += 6) {
            // On the speeds of the sweep and between them.
            const double speed = speeds[k] + (k % 4 == 0 ? 0 : 13.7);
            const Spectrum found = solver.at(std::min(speed, speeds.back()), 8);
            expect_complete(found, dense(solver.discretization(), found.speed));
        }
    }
}

TEST(RefinedModes, OfManyUnknownsAreAllOfTheStateMatrix) {
    tests::Random random(14);
    for (int draw = 0; draw < 8; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic, isotropic ? 10 : 7);
        const SpectrumSolver solver(rotor, isotropic ? Form::planar_damped : Form::general, 4);
        const std::vector<double> speeds = sweep(2500, 41);
        solver.expect(speeds, 10);
        for (std::size_t k = 1; k < speeds.size(); k += 13) {
            const Spectrum found = solver.at(speeds[k] + (k % 2 == 0 ? 0 : 13.7), 10);
            expect_complete(found, dense(solver.discretization(), found.speed));
            for (const WhirlMode &mode : found.modes) // above it the whole rotor is iterated
                EXPECT_LE(mode.residual, 1e-9) << mode.eigenvalue << " at " << found.speed;
        }
    }
}

/// Supports that hardly differ: from rest on, motions in the planes turn into whirls within a few
/// rad/s. Which is which need not be known of those that are only counted, until they are asked
/// for.
TEST(RefinedModes, OfSupportsThatHardlyDifferAreAllWhenMoreAreAskedFor) {
    tests::Random random(15);
    for (int draw = 0; draw < 12; ++draw) {
        SCOPED_TRACE(draw);
        model::Rotor rotor = sample_rotor(random, true);
        for (model::Bearing &bearing : rotor.bearings)
            bearing.rows[0].k(1, 1) *= 1 + std::pow(10, random(-5, -2));
        const SpectrumSolver solver(rotor, Form::general, 4);
        const std::vector<double> speeds = sweep(1500, 31);
        for (const int wanted : {4, 6, 10}) {
            SCOPED_TRACE(wanted);
            solver.expect(speeds, wanted);
            for (std::size_t k = 0; k < speeds.size(); k += 5) {
                const double speed = speeds[k] + (k % 2 == 0 ? 0 : 7.3);
                const Spectrum found = solver.at(std::min(speed, speeds.back()), wanted);
                expect_complete(found, dense(solver.discretization(), found.speed));
            }
        }
    }
}

/// The argument of the determinant around a circle tells whether one inside of it is left out,
/// wherever it lies, and however near the circle.
TEST(RefinedModes, OneThatIsLeftOutIsMissed) {
    tests::Random random(16);
    int seen = 0;
    for (int draw = 0; draw < 40; ++draw) {
        SCOPED_TRACE(draw);
        const model::Rotor rotor = sample_rotor(random, false);
        const assembly::Discretization d(rotor, 4);
        const double speed = random(0, 1000);
        WholePencil<double> pencil;
        pencil.set(FormMatrices(d, Form::general, {}).at(speed), 100);
        std::vector<Complex> all = dense(d, speed);
        std::sort(all.begin(), all.end(),
                  [](const Complex &a, const Complex &b) { return std::abs(a) < std::abs(b); });
        for (std::size_t i = 6; i < 24; ++i) {
            const double inside = std::abs(all[i]);
            const double outside = std::abs(all[i + 1]);
            if (outside < 1.0002 * inside) // the dense values do not tell on which side they are
                continue;
            const Circle circle{0, random.coin() ? inside * 1.0001 : std::sqrt(inside * outside)};
            std::vector<Complex> known(all.begin(), all.begin() + 28);
            if (known.back().imag() != 0 && known[26] != std::conj(known.back()))
                known.pop_back(); // both conjugates or none
            EXPECT_EQ(complete_within(pencil, circle, known), true) << i;
            const std::size_t gone =
                random.coin() ? i : static_cast<std::size_t>(random(0, static_cast<double>(i)));
            const Complex value = known[gone];
            std::erase_if(known, [value](const Complex &other) { // both conjugates
                return std::abs(other.real() - value.real()) < 1e-12 * std::abs(value) &&
                       std::abs(std::abs(other.imag()) - std::abs(value.imag())) <
                           1e-12 * std::abs(value);
            });
            EXPECT_EQ(complete_within(pencil, circle, known), false) << i << " without " << gone;
            ++seen;
        }
    }
    EXPECT_GT(seen, 200);
}

/// Those of the shapes alone: as many as of the state matrix, each no farther from one of these
/// than is said to be left out, and refined the same.
TEST(RefinedModes, ReducedOnesAreOffByWhatIsLeftOut) {
    constexpr double rounding = 1e-6; // of dgeev, as above
    tests::Random random(17);
    double most = 0;
    for (int draw = 0; draw < 12; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic, isotropic ? 10 : 7);
        const SpectrumSolver solver(rotor, isotropic ? Form::planar_damped : Form::general, 4);
        solver.take_reduced_roots();
        solver.expect(sweep(1500, 11), 8);
        EXPECT_LT(solver.left_out(), 0.08); // else there would have been more shapes
        most = std::max(most, solver.left_out());
        for (const double speed : {210.0, 1130.0}) {
            const Spectrum found = solver.at(speed, 8);
            const std::vector<Complex> all = dense(solver.discretization(), speed);
            ASSERT_EQ(found.modes.size(), 8U);
            const auto nearest = [&all](Complex value) {
                return *std::ranges::min_element(
                    all, {}, [value](const Complex &other) { return std::abs(other - value); });
            };
            double last = 0;
            for (const WhirlMode &mode : found.modes) {
                const double off = std::abs(nearest(mode.eigenvalue) - mode.eigenvalue);
                EXPECT_LE(off, (solver.left_out() + rounding) * std::abs(mode.eigenvalue))
                    << mode.eigenvalue << " at " << speed;
                last = std::max(last, mode.eigenvalue.imag());
                for (const WhirlMode &refined : solver.near(speed, {mode}))
                    EXPECT_LE(std::abs(nearest(refined.eigenvalue) - refined.eigenvalue),
                              rounding * std::abs(refined.eigenvalue));
            }
            const auto slower = std::ranges::count_if(all, [&](const Complex &value) {
                return value.imag() > real_axis * std::abs(value) &&
                       value.imag() < (1 - 0.02) * last &&
                       std::abs(value) < (1 - 0.02) * found.complete_radius;
            });
            EXPECT_LE(slower, 8);
            EXPECT_GE(slower, 4);
        }
    }
    EXPECT_GT(most, 1e-9); // some rotor was reduced
}

TEST(RefinedModes, AreThoseOfAllUnknowns) {
    tests::Random random(12);
    for (int draw = 0; draw < 20; ++draw) {
        SCOPED_TRACE(draw);
        const bool isotropic = draw % 2 == 0;
        const model::Rotor rotor = sample_rotor(random, isotropic);
        const Form form = isotropic ? Form::planar_damped : Form::general;
        const SpectrumSolver solver(rotor, form, 4);
        const SpectrumSolver alone(rotor, form, 4);
        alone.take_all_unknowns();
        const std::vector<double> speeds = sweep(1200, 25);
        solver.expect(speeds, 8);
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

/// From guesses that are off by up to a hundredth, in the vectors too, to the same eigenvalue
/// within the error stated.
// A bearing that pushes away by far more than the others hold in one plane: the rotor diverges,
// many times faster than its slowest modes whirl, at every speed and not at those solved first
// alone.
TEST(RefinedModes, DivergenceIsThereAtEverySpeed) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1.6, 0.06, tests::steel());
    rotor.shaft.segments[0].elements = 12;
    for (const double z : {0.1, 1.6})
        rotor.bearings.push_back(tests::isotropic_bearing(z, 1e5, 100));
    rotor.bearings.push_back(tests::isotropic_bearing(1.3, 2e5, 100));
    rotor.bearings.back().rows[0].k(0, 0) = -1e8;
    const SpectrumSolver refined(rotor, Form::general, 2);
    const SpectrumSolver whole(rotor, Form::general, 2);
    whole.take_all_unknowns();
    const std::vector<double> speeds = sweep(1000, 21);
    refined.expect(speeds, 4);
    for (const double speed : speeds) {
        const std::vector<double> found = refined.at(speed, 4).growing;
        const std::vector<double> all = whole.at(speed, 12).growing;
        ASSERT_EQ(found.size(), 1U) << speed;
        ASSERT_EQ(all.size(), 1U) << speed;
        EXPECT_NEAR(found.front(), all.front(), 1e-8 * all.front()); // what a correction may leave
    }
}

TEST(RefinedModes, ErrorOfARefinedValueIsStated) {
    tests::Random random(13);
    int seen = 0;
    for (int draw = 0; draw < 30; ++draw) {
        SCOPED_TRACE(draw);
        const model::Rotor rotor = sample_rotor(random, false);
        const SpectrumSolver solver(rotor, Form::general, 4);
        const double speed = random(50, 1000);
        WholePencil<double> pencil;
        pencil.set(solver.problem_at(speed), 100);
        for (const WhirlMode &mode : solver.at(speed, 8).modes)
            for (const double size : {1e-3, 1e-4, 1e-5}) {
                WholeRoot guess{mode.eigenvalue *
                                    (1.0 + size * Complex(random(-1, 1), random(-1, 1))),
                                mode.shape, mode.left.conjugate()};
                for (Eigen::VectorXcd *vector : {&guess.right, &guess.left})
                    for (Complex &entry : *vector)
                        entry *= 1.0 + size * Complex(random(-1, 1), random(-1, 1));
                const auto found = pencil.refined(guess);
                ASSERT_TRUE(found) << mode.eigenvalue;
                EXPECT_LE(std::abs(found->value - mode.eigenvalue) / std::abs(mode.eigenvalue),
                          2 * (found->residual + found->rounding + mode.residual + mode.rounding))
                    << mode.eigenvalue << ", guess off by " << size;
                ++seen;
            }
    }
    EXPECT_GT(seen, 500);
}

namespace {

/// A disc on a shaft nearly without mass, its bearings at the ends unlike in both planes.
struct LightShaft {
    double rho; ///< kg/m3
    double damping = 200;
    double coupling = 0; ///< kxy = -kyx, N/m
    double E = 2e11, G = 7.7e10, kappa = 0.9;
    double diameter = 0.06;
    double before = 0.4, behind = 0.5; ///< lengths, m
    double mass = 60, Id = 3, Ip = 1;

    [[nodiscard]] model::Rotor rotor() const {
        model::Rotor out;
        out.shaft = tests::uniform_shaft(before + behind, diameter, {"light", E, G, rho});
        out.shaft.shear = model::ShearFormula::given;
        out.shaft.shear_coefficient = kappa;
        out.discs.push_back(tests::disc_at(before, mass, Id, Ip));
        out.bearings.push_back(tests::isotropic_bearing(0, 2e6, damping));
        model::BearingCoefficients &row = out.bearings.back().rows[0];
        row.k(1, 1) = 2.5e6;
        row.k(0, 1) = coupling;
        row.k(1, 0) = -coupling;
        out.bearings.push_back(tests::isotropic_bearing(before + behind, 3e6));
        return out;
    }

    /// How far l is from an eigenvalue of the disc on two springs without mass, by Newton's step
    /// for the determinant: each half of the shaft is a cantilever from the disc to its bearing.
    /// Unknowns of each plane: deflection and slope of the disc, deflections of the bearings.
    [[nodiscard]] double off(Complex l, double speed) const {
        using Matrix = Eigen::Matrix<Complex, 8, 8>;
        const double area = std::numbers::pi / 4 * diameter * diameter;
        const double EI = E * area * diameter * diameter / 16;
        Matrix Q = Matrix::Zero();
        Matrix rate = Matrix::Zero();
        for (const int plane : {0, 4}) {
            for (const int end : {2, 3}) {
                const double length = end == 2 ? before : behind;
                const double s = 1 / (std::pow(length, 3) / (3 * EI) + length / (kappa * G * area));
                Eigen::Vector4d stretched = Eigen::Vector4d::Zero();
                stretched(end) = 1;
                stretched(0) = -1;
                stretched(1) = end == 2 ? length : -length;
                Q.block<4, 4>(plane, plane) += s * stretched * stretched.transpose();
            }
            for (const auto &[i, inertia] : {std::pair(0, mass), std::pair(1, Id)}) {
                Q(plane + i, plane + i) += l * l * inertia;
                rate(plane + i, plane + i) += 2.0 * l * inertia;
            }
        }
        const model::BearingCoefficients row = rotor().bearings[0].rows[0];
        const std::array first{2, 6};
        for (const int i : {0, 1})
            for (const int j : {0, 1}) {
                Q(first[i], first[j]) += row.k(i, j) + l * row.c(i, j);
                rate(first[i], first[j]) += row.c(i, j);
            }
        Q(3, 3) += 3e6;
        Q(7, 7) += 3e6;
        Q(1, 5) += l * Ip * speed;
        rate(1, 5) += Ip * speed;
        Q(5, 1) -= l * Ip * speed;
        rate(5, 1) -= Ip * speed;
        return 1 / std::abs(Q.fullPivLu().solve(rate).trace());
    }
};

} // namespace

/// The motions of the shaft are 1e3 to 1e6 times as fast as those of the disc: both kinds have all
/// their digits side by side.
TEST(RefinedModes, OfALightShaftAreThoseOfItsDiscOnSprings) {
    for (const double rho : {1.0, 1e-3, 1e-6})
        for (const double damping : {0.0, 200.0, 2e5})
            for (const double coupling : {0.0, 1e5}) {
                const LightShaft shaft{.rho = rho, .damping = damping, .coupling = coupling};
                const SpectrumSolver solver(shaft.rotor(), Form::general, 4);
                const std::vector<double> speeds = sweep(1000, 11);
                for (const int wanted : {4, 8, 12}) {
                    SCOPED_TRACE(testing::Message() << rho << " kg/m3, " << damping << " N s/m, "
                                                    << coupling << " N/m, " << wanted);
                    solver.expect(speeds, wanted);
                    for (const double speed : speeds) {
                        const Spectrum found = solver.at(speed, wanted);
                        ASSERT_EQ(std::ssize(found.modes), wanted) << speed;
                        for (std::size_t i = 0; i < 4; ++i) {
                            const Complex value = found.modes[i].eigenvalue;
                            const double of_shaft = 1e-4 * rho; // its mass, of that of the disc
                            EXPECT_LE(shaft.off(value, speed) / std::abs(value), of_shaft + 1e-9)
                                << value << " at " << speed;
                            if (i > 0)
                                EXPECT_GT(value.imag(),
                                          1.00001 * found.modes[i - 1].eigenvalue.imag());
                        }
                    }
                }
            }
}

/// A shaft of a hundredth of the density, with a tenth of the damping at ten times the speed, moves
/// ten times as fast against a disc that stands still.
TEST(RefinedModes, OfALightShaftGrowWithTheRootOfItsDensity) {
    constexpr int wanted = 12;
    const auto modes = [](double rho, double speed) {
        const SpectrumSolver solver(LightShaft{.rho = rho, .damping = 1e5 * std::sqrt(rho)}.rotor(),
                                    Form::general, 4);
        return solver.at(speed, wanted).modes;
    };
    const double rho = 1e-2;
    const double speed = 5;
    const std::vector<WhirlMode> slow = modes(rho, speed);
    for (const double faster : {10.0, 1e2, 1e3}) {
        SCOPED_TRACE(faster);
        const std::vector<WhirlMode> fast = modes(rho / faster / faster, faster * speed);
        ASSERT_EQ(std::ssize(fast), wanted);
        for (std::size_t i = 4; i < fast.size(); ++i)
            EXPECT_LE(std::abs(fast[i].eigenvalue / (faster * slow[i].eigenvalue) - 1.0), 1e-6)
                << fast[i].eigenvalue << " and " << slow[i].eigenvalue;
    }
}

} // namespace whirl::modes
