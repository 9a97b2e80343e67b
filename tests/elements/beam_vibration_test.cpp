// Frequencies of single-span beams between pins against closed forms.

#include "elements/test_beams.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace whirl;

/// First frequency (rad/s) of a uniform solid beam between pins, of equal elements.
double first_pinned_frequency(elements::Beam beam, int order, int elements) {
    const double length = beam.span.length;
    beam.span.length = length / elements;
    const elements::PlanarMatrices m = elements::beam_matrices(beam, order);
    const int inner = elements::internal_unknowns(order);
    const int size = elements * (2 + inner) + 2;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd M = K;
    for (int e = 0; e < elements; ++e) {
        const int a = e * (2 + inner);
        std::vector<int> unknowns{a, a + 1, a + 2 + inner, a + 3 + inner};
        for (int i = 0; i < inner; ++i)
            unknowns.push_back(a + 2 + i);
        K(unknowns, unknowns) += m.K + m.K_axial;
        M(unknowns, unknowns) += m.M;
    }
    std::vector<int> free; // all but the deflections of the two ends
    for (int i = 1; i < size; ++i)
        if (i != size - 2)
            free.push_back(i);
    // The largest of 1/w^2 is accurate to rounding; the smallest w^2 of the pencil is not, beside
    // shear frequencies that are slenderness^2 times larger.
    const Eigen::MatrixXcd free_M = M(free, free).cast<std::complex<double>>();
    const Eigen::MatrixXcd free_K = K(free, free).cast<std::complex<double>>();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd> solver(free_M, free_K,
                                                                            Eigen::EigenvaluesOnly);
    return 1 / std::sqrt(solver.eigenvalues()(solver.eigenvalues().size() - 1));
}

elements::Beam solid_beam(double length, double radius) {
    return tests::beam_of({"uniform", length, radius, radius, 0, 0});
}

/// Lowest root of (kGA k^2 + N k^2 - rho A w^2)(EI k^2 + kGA - rho I w^2) = (kGA k)^2: Timoshenko
/// beam between pins under tension N, w = W sin kz, phi = P cos kz. The root by the product of
/// both, which loses no digits.
double timoshenko_pinned(const elements::Section &s, double L, double N) {
    const double k = std::numbers::pi / L;
    const double k2 = k * k;
    const double a = s.rhoA * s.rhoI;
    const double b = s.rhoA * (s.EI * k2 + s.kappaGA) + s.rhoI * (s.kappaGA + N) * k2;
    const double c = s.kappaGA * s.EI * k2 * k2 + N * k2 * (s.EI * k2 + s.kappaGA);
    return std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c)));
}

struct Accuracy {
    int order = 1;
    int elements = 1;
    double error = 0; ///< relative, largest allowed
};

void PrintTo(const Accuracy &accuracy, std::ostream *out) {
    *out << accuracy.elements << " elements of order " << accuracy.order;
}

class PinnedBeam : public testing::TestWithParam<Accuracy> {};

TEST_P(PinnedBeam, DoesNotLockAtAnySlenderness) {
    const auto [order, elements, error] = GetParam();
    for (const double slenderness : {1e1, 1e2, 1e4, 1e6}) {
        const elements::Beam beam = solid_beam(1, 0.5 / slenderness);
        const double exact = timoshenko_pinned(beam.at(0), 1, 0);
        const double found = first_pinned_frequency(beam, order, elements);
        EXPECT_NEAR(found / exact, 1, error) << "slenderness " << slenderness;
    }
}

// Two cubic elements miss the wire by 0.4 % (9.909 for pi^2) and the stub, slenderness 10, by a bit
// more; the higher orders reach the level at which rounding of K leaves them.
INSTANTIATE_TEST_SUITE_P(Orders, PinnedBeam,
                         testing::Values(Accuracy{1, 2, 6e-3}, Accuracy{1, 20, 2e-5},
                                         Accuracy{4, 2, 1e-6}, Accuracy{7, 2, 1e-11},
                                         Accuracy{10, 2, 1e-11}, Accuracy{10, 1, 1e-10}));

TEST(PinnedBeam, AtGreatSlendernessIsTheEulerBeam) {
    const elements::Beam beam = solid_beam(1, 0.5e-6);
    const elements::Section s = beam.at(0);
    const double euler = std::pow(std::numbers::pi, 2) * std::sqrt(s.EI / s.rhoA);
    EXPECT_NEAR(first_pinned_frequency(beam, 10, 2) / euler, 1, 1e-10);
}

TEST(PinnedBeam, TensionRaisesTheFrequencyOfARigidInShearBeam) {
    for (const double N : {-2e4, 0.0, 1e5, 1e6}) {
        elements::Beam beam = solid_beam(1.2, 0.012);
        beam.shear = model::ShearFormula::given;
        beam.given_shear_coefficient = 1e9;
        beam.axial_force = N;
        const elements::Section s = beam.at(0);
        const double k = std::numbers::pi / 1.2;
        // Rayleigh beam: EI k^4 + N k^2 = w^2 (rho A + rho I k^2). Compression below buckling,
        // EI k^2 = 2.3e4 N.
        const double exact =
            k * k * std::sqrt(s.EI / (s.rhoA + s.rhoI * k * k)) * std::sqrt(1 + N / (s.EI * k * k));
        EXPECT_NEAR(first_pinned_frequency(beam, 10, 2) / exact, 1, 1e-10) << N;
        EXPECT_NEAR(first_pinned_frequency(beam, 1, 40) / exact, 1, 1e-6) << N;
    }
}

TEST(PinnedBeam, TensionOnAShortBeamActsOnTheDeflectionNotOnTheSlopeOfTheSection) {
    for (const double N : {0.0, 1e7}) {
        elements::Beam beam = solid_beam(0.3, 0.03);
        beam.axial_force = N;
        const double exact = timoshenko_pinned(beam.at(0), 0.3, N);
        EXPECT_NEAR(first_pinned_frequency(beam, 8, 2) / exact, 1, 1e-11) << N;
    }
}

} // namespace
