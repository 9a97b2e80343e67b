#include "elements/beam.h"

#include "elements/quadrature.h"

#include <vector>

namespace whirl::elements {

namespace {

/// Values at one point along the element. Slope, curvature and shear strain are kept apart, not
/// formed as w' - phi: for a slender beam that difference of two nearly equal numbers, times the
/// large shear stiffness, would cost as many digits as (length/diameter)^2 has.
struct Shapes {
    Eigen::VectorXd w;         ///< deflection
    Eigen::VectorXd phi;       ///< slope of the section
    Eigen::VectorXd curvature; ///< phi'
    Eigen::VectorXd shear;     ///< w' - phi
};

/// Two-node element, Przemieniecki (1968) eq. (11.13) ff., xi = z/h.
Shapes classical_shapes(double xi, double h, double Phi) {
    const double d = 1 + Phi;
    const double x2 = xi * xi;
    const double x3 = x2 * xi;
    Shapes s{Eigen::VectorXd(4), Eigen::VectorXd(4), Eigen::VectorXd(4), Eigen::VectorXd(4)};
    s.w << (d - Phi * xi - 3 * x2 + 2 * x3) / d,
        h * ((2 + Phi) / 2 * xi - (4 + Phi) / 2 * x2 + x3) / d, (Phi * xi + 3 * x2 - 2 * x3) / d,
        h * (-Phi / 2 * xi + (Phi - 2) / 2 * x2 + x3) / d;
    s.phi << 6 * (x2 - xi) / (h * d), (d - (4 + Phi) * xi + 3 * x2) / d, -6 * (x2 - xi) / (h * d),
        ((Phi - 2) * xi + 3 * x2) / d;
    s.curvature << 6 * (2 * xi - 1) / (h * h * d), (-(4 + Phi) + 6 * xi) / (h * d),
        -6 * (2 * xi - 1) / (h * h * d), (Phi - 2 + 6 * xi) / (h * d);
    s.shear << -Phi / (h * d), -Phi / (2 * d), Phi / (h * d), -Phi / (2 * d);
    return s;
}

/// Legendre polynomials L_k on [0, 1] up to a degree, or some more, and their first and second
/// integrals from 0.
struct Legendre {
    std::vector<double> L, I1, I2;
};

Legendre legendre(int degree, double xi) {
    const double x = 2 * xi - 1;
    std::vector<double> P(static_cast<std::size_t>(degree) + 3);
    P[0] = 1;
    P[1] = x;
    for (std::size_t k = 2; k < P.size(); ++k) {
        const auto n = static_cast<double>(k);
        P[k] = ((2 * n - 1) * x * P[k - 1] - (n - 1) * P[k - 2]) / n;
    }
    // int L_k = (L_{k+1} - L_{k-1}) / (2 (2k + 1)) on [0, 1], zero at both ends for k >= 1.
    const auto integrate = [](const std::vector<double> &of, std::size_t first, std::size_t size) {
        std::vector<double> out(size);
        for (std::size_t k = first; k < size; ++k)
            out[k] = (of[k + 1] - of[k - 1]) / (2 * (2 * static_cast<double>(k) + 1));
        return out;
    };
    const std::vector<double> I1 = integrate(P, 1, P.size() - 1);
    return {P, I1, integrate(I1, 2, I1.size() - 1)};
}

/// Order-p element: slope of degree p, deflection of degree p + 1. The first four functions are
/// those of the classical element with the true shear parameter: the same space as with any other
/// Phi, but a short thick element is then as soft as shear makes it, where functions without shear
/// strain would have entries larger by Phi and lose as many digits to them. The rest vanishes at
/// both nodes, for k = 1..p-1:
///  - slope functions w = 0, phi = h I L_k (shear strain -phi),
/// and of two sets that span the same space the one that is nearly orthogonal in energy. Where
/// bending is softer than shear (Phi < 1):
///  - bending functions w = h^2 II L_k, phi = w', k = 2..p-1 (no shear strain, orthogonal
///    curvature; only products of unequal k stay off the diagonal for a cone),
///  - two functions with shear strain 1 and 2 xi - 1 and no slope at the nodes;
/// else, where the two sets above would be nearly the same motion:
///  - deflection functions w = h I L_k, phi = 0, k = 1..p (shear strain L_k).
Shapes order_p_shapes(double xi, double h, double Phi, int p) {
    const int n = 4 + internal_unknowns(p);
    const Shapes nodal = classical_shapes(xi, h, Phi);
    Shapes s{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n),
             Eigen::VectorXd::Zero(n)};
    s.w.head(4) = nodal.w;
    s.phi.head(4) = nodal.phi;
    s.curvature.head(4) = nodal.curvature;
    s.shear.head(4) = nodal.shear;
    const Legendre l = legendre(p, xi);
    int i = 4;
    for (std::size_t k = 1; k < static_cast<std::size_t>(p); ++k, ++i) {
        s.phi(i) = l.I1[k];
        s.curvature(i) = l.L[k] / h;
        s.shear(i) = -l.I1[k];
    }
    if (Phi >= 1) {
        for (std::size_t k = 1; k <= static_cast<std::size_t>(p); ++k, ++i) {
            s.w(i) = h * l.I1[k];
            s.shear(i) = l.L[k];
        }
        return s;
    }
    for (std::size_t k = 2; k < static_cast<std::size_t>(p); ++k, ++i) {
        s.w(i) = h * l.I2[k];
        s.phi(i) = l.I1[k];
        s.curvature(i) = l.L[k] / h;
    }
    // shear 1: phi = 6 (xi^2 - xi), w' = 1 + phi; shear 2 xi - 1: phi = 0, w' = 2 xi - 1.
    s.w(i) = h * (xi - 3 * xi * xi + 2 * xi * xi * xi);
    s.phi(i) = 6 * (xi * xi - xi);
    s.curvature(i) = 6 * (2 * xi - 1) / h;
    s.shear(i) = 1;
    ++i;
    s.w(i) = h * (xi * xi - xi);
    s.shear(i) = 2 * xi - 1;
    return s;
}

/// Shear parameter of the nodal functions from the mean stiffnesses along the span.
double shear_parameter(const Beam &beam) {
    const Quadrature &rule = gauss_legendre(8);
    double EI = 0;
    double kappaGA = 0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const Section section = beam.at(rule.points[q]);
        EI += rule.weights[q] * section.EI;
        kappaGA += rule.weights[q] * section.kappaGA;
    }
    return 12 * EI / (kappaGA * beam.span.length * beam.span.length);
}

Shapes shapes_at(const Beam &beam, int order, double Phi, double xi) {
    return order == 1 ? classical_shapes(xi, beam.span.length, Phi)
                      : order_p_shapes(xi, beam.span.length, Phi, order);
}

/// Points for exact integration: w^2 has degree 2p + 2, a cone adds 2 (area) or 4 (inertia); the
/// shear coefficient of a hollow cone whose bore ratio varies is rational, so it gets a reserve.
int quadrature_points(const Beam &beam, int order) {
    const int degree = order == 1 ? 3 : order + 1;
    if (beam.uniform())
        return degree + 1;
    return degree + (beam.span.inner_start == 0 && beam.span.inner_end == 0 ? 3 : 12);
}

} // namespace

int internal_unknowns(int order) { return order == 1 ? 0 : 2 * order - 1; }

std::vector<int> internal_places(const Beam &beam, int order, int higher) {
    std::vector<int> places;
    if (order == 1)
        return places;
    for (int k = 1; k < order; ++k) // slope functions
        places.push_back(k - 1);
    const bool short_and_thick = shear_parameter(beam) >= 1;
    const int rest = short_and_thick ? order : order - 2; // deflection or bending functions
    for (int k = 0; k < rest; ++k)
        places.push_back(higher - 1 + k);
    for (int last = 2; last > 0 && !short_and_thick; --last) // of constant and linear shear
        places.push_back(internal_unknowns(higher) - last);
    return places;
}

PlanarMatrices beam_matrices(const Beam &beam, int order) {
    const int n = 4 + internal_unknowns(order);
    const double h = beam.span.length;
    const double Phi = shear_parameter(beam);
    const Quadrature &rule = gauss_legendre(quadrature_points(beam, order));
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n, n);
    PlanarMatrices out{zero, zero, zero, zero, zero};
    if (beam.axial_torque != 0)
        out.torque = zero;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const Section a = beam.at(rule.points[q]);
        const Shapes s = shapes_at(beam, order, Phi, rule.points[q]);
        const double dz = rule.weights[q] * h;
        const Eigen::VectorXd slope = s.phi + s.shear; // w'
        out.M += dz * (a.rhoA * s.w * s.w.transpose() + a.rhoI * s.phi * s.phi.transpose());
        out.G += dz * 2 * a.rhoI * s.phi * s.phi.transpose();
        out.K_bending += dz * a.EI * s.curvature * s.curvature.transpose();
        out.K += dz * (a.EI * s.curvature * s.curvature.transpose() +
                       a.kappaGA * s.shear * s.shear.transpose());
        out.K_axial += dz * beam.axial_force * slope * slope.transpose();
        if (beam.axial_torque != 0)
            out.torque -= dz * beam.axial_torque / 2 *
                          (s.curvature * s.phi.transpose() - s.phi * s.curvature.transpose());
    }
    return out;
}

ShapeValues beam_shapes(const Beam &beam, int order, double xi) {
    const double Phi = shear_parameter(beam);
    const Shapes s = shapes_at(beam, order, Phi, xi);
    return {s.w, s.phi};
}

} // namespace whirl::elements
