// What every beam element must have, whatever its order and shape.

#include "elements/quadrature.h"
#include "elements/test_beams.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace whirl;
using tests::Cone;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Integrals of powers of the radius r(z) = a + (b - a) z/L of a cone, by expanding the power.
struct ConeIntegrals {
    double r2 = 0;    ///< int r^2 dz
    double z_r2 = 0;  ///< int z r^2 dz
    double z2_r2 = 0; ///< int z^2 r^2 dz
    double r4 = 0;    ///< int r^4 dz
};

ConeIntegrals cone_integrals(double a, double b, double L) {
    return {L / 3 * (a * a + a * b + b * b), L * L / 12 * (a * a + 2 * a * b + 3 * b * b),
            L * L * L / 30 * (a * a + 3 * a * b + 6 * b * b),
            L / 5 *
                (std::pow(a, 4) + a * a * a * b + a * a * b * b + a * b * b * b + std::pow(b, 4))};
}

/// Mass, first moment and inertias about the first node of the solid body.
struct Body {
    double mass = 0, moment = 0, Id = 0, Ip = 0;
};

Body body_of(const Cone &c) {
    const ConeIntegrals o = cone_integrals(c.outer_start, c.outer_end, c.length);
    const ConeIntegrals i = cone_integrals(c.inner_start, c.inner_end, c.length);
    const double rho_pi = tests::density * std::numbers::pi;
    const double Ip = rho_pi / 2 * (o.r4 - i.r4);
    return {rho_pi * (o.r2 - i.r2), rho_pi * (o.z_r2 - i.z_r2),
            rho_pi * (o.z2_r2 - i.z2_r2) + Ip / 2, Ip};
}

struct Kind {
    int order = 1;
    Cone cone;
};

void PrintTo(const Kind &kind, std::ostream *out) {
    *out << "order " << kind.order << ", " << kind.cone.name;
}

std::vector<Kind> kinds() {
    std::vector<Kind> all;
    for (const int order : {1, 2, 4, 7, 10})
        for (const Cone &cone : {tests::solid_cylinder(), tests::hollow_cylinder(),
                                 tests::solid_cone(), tests::hollow_cone()})
            all.push_back({order, cone});
    return all;
}

class BeamProperties : public testing::TestWithParam<Kind> {
  protected:
    elements::Beam beam = [] {
        elements::Beam b = tests::beam_of(GetParam().cone);
        b.axial_force = 1e5;
        return b;
    }();
    elements::PlanarMatrices m = elements::beam_matrices(beam, GetParam().order);
    Eigen::Index n = m.M.rows();

    [[nodiscard]] Eigen::VectorXd translation() const {
        Eigen::VectorXd t = Eigen::VectorXd::Zero(n);
        t(0) = t(2) = 1;
        return t;
    }
    /// Unit slope about the first node.
    [[nodiscard]] Eigen::VectorXd tilt() const {
        Eigen::VectorXd r = Eigen::VectorXd::Zero(n);
        r(1) = r(3) = 1;
        r(2) = beam.span.length;
        return r;
    }
};

/// Eigenvalues of a symmetric matrix after its rows and columns are scaled to a unit diagonal,
/// which changes no sign.
Eigen::VectorXd scaled_eigenvalues(const Eigen::MatrixXd &A) {
    const Eigen::VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
               Eigen::MatrixXd(scale.asDiagonal() * A * scale.asDiagonal()))
        .eigenvalues();
}

TEST_P(BeamProperties, MatricesAreSymmetric) {
    for (const Eigen::MatrixXd *A : {&m.M, &m.G, &m.K, &m.K_axial}) {
        ASSERT_GT(A->norm(), 0);
        EXPECT_LE((*A - A->transpose()).cwiseAbs().maxCoeff(), 4 * eps * A->cwiseAbs().maxCoeff());
    }
}

TEST_P(BeamProperties, MassIsPositiveDefinite) {
    EXPECT_GT(scaled_eigenvalues(m.M).minCoeff(), 1e-9);
}

TEST_P(BeamProperties, PolarInertiaIsPositiveSemidefinite) {
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m.G).eigenvalues();
    EXPECT_GT(values.minCoeff(), -10 * eps * values.maxCoeff());
}

TEST_P(BeamProperties, StiffnessHasExactlyTheTwoRigidMotionsInItsNullSpace) {
    const Eigen::VectorXd values = scaled_eigenvalues(m.K);
    EXPECT_LT(std::abs(values(0)), 1e-13);
    EXPECT_LT(std::abs(values(1)), 1e-13);
    EXPECT_GT(values(2), 1e-6);
}

TEST_P(BeamProperties, RigidMotionsMeetNoForce) {
    // Entries of a positive semidefinite K: |K_ij| <= sqrt(K_ii K_jj), so the rounding of row i is
    // some eps times that, summed.
    const Eigen::VectorXd root = m.K.diagonal().cwiseSqrt();
    for (const Eigen::VectorXd &r : {translation(), tilt()}) {
        const Eigen::VectorXd bound = 20 * eps * root.dot(r.cwiseAbs()) * root;
        const Eigen::VectorXd force = (m.K * r).cwiseAbs();
        for (Eigen::Index i = 0; i < n; ++i)
            EXPECT_LE(force(i), bound(i)) << i;
    }
}

TEST_P(BeamProperties, RigidAccelerationsMeetTheInertiaOfTheBody) {
    const Body body = body_of(GetParam().cone);
    const Eigen::VectorXd t = translation();
    const Eigen::VectorXd r = tilt();
    EXPECT_NEAR(t.dot(m.M * t), body.mass, 1e-13 * body.mass);
    EXPECT_NEAR(r.dot(m.M * t), body.moment, 1e-13 * body.moment);
    EXPECT_NEAR(r.dot(m.M * r), body.Id, 1e-13 * body.Id);
    EXPECT_NEAR(r.dot(m.G * r), body.Ip, 1e-13 * body.Ip);
    EXPECT_NEAR(t.dot(m.G * t), 0, 1e-13 * body.Ip / std::pow(beam.span.length, 2));
}

TEST_P(BeamProperties, AxialForceResistsTiltByForceTimesLength) {
    // Work of the ends approaching: 1/2 N int w'^2 = 1/2 N L for unit slope.
    const Eigen::VectorXd r = tilt();
    const double NL = beam.axial_force * beam.span.length;
    EXPECT_NEAR(r.dot(m.K_axial * r), NL, 1e-12 * NL);
    EXPECT_LT((m.K_axial * translation()).norm(), 1e-13 * m.K_axial.norm());
}

TEST_P(BeamProperties, ShapesInterpolateTheNodesAndGiveTheMassMatrix) {
    const int order = GetParam().order;
    for (const double end : {0.0, 1.0}) {
        const elements::ShapeValues s = elements::beam_shapes(beam, order, end);
        Eigen::VectorXd w = Eigen::VectorXd::Zero(n);
        Eigen::VectorXd phi = Eigen::VectorXd::Zero(n);
        w(end == 0 ? 0 : 2) = 1;
        phi(end == 0 ? 1 : 3) = 1;
        EXPECT_LT((s.w - w).norm(), 1e-14);
        EXPECT_LT((s.phi - phi).norm(), 1e-13);
    }
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
    const elements::Quadrature &rule = elements::gauss_legendre(25);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const elements::ShapeValues s = elements::beam_shapes(beam, order, rule.points[q]);
        const elements::Section a = beam.at(rule.points[q]);
        M += rule.weights[q] * beam.span.length *
             (a.rhoA * s.w * s.w.transpose() + a.rhoI * s.phi * s.phi.transpose());
    }
    EXPECT_LT((M - m.M).norm(), 1e-13 * M.norm());
}

INSTANTIATE_TEST_SUITE_P(OrdersAndShapes, BeamProperties, testing::ValuesIn(kinds()),
                         [](const auto &instance) {
                             return "order" + std::to_string(instance.param.order) + "_" +
                                    instance.param.cone.name;
                         });

} // namespace
