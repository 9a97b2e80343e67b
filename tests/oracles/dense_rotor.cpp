#include "oracles/dense_rotor.h"

#include "oracles/wide_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

struct Section {
    double area, I, EI, shear; ///< m2, m4, N m2, N
};

/// Shear coefficient by Cowper, J. Appl. Mech. 33 (1966) 335, where none is given.
Section section_of(const Cylinder &c) {
    const double ro = c.outer / 2;
    const double ri = c.inner / 2;
    const double m2 = ri * ri / (ro * ro);
    const double s = (1 + m2) * (1 + m2);
    const double nu = c.E / (2 * c.G) - 1;
    const double cowper = 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m2);
    const double area = std::numbers::pi * (ro * ro - ri * ri);
    const double I = area * (ro * ro + ri * ri) / 4;
    return {area, I, c.E * I, (c.kappa > 0 ? c.kappa : cowper) * c.G * area};
}

/// Coefficients of 1, x, x^2, x^3 (x = z/h) of the deflection for a unit of each nodal unknown.
Eigen::Matrix4d cubic(double h, double strain) {
    // phi = w' - gamma with gamma = -strain h^2 d3w/dz3 = -6 strain/h a3, at both ends
    const double third = 6 * strain / h;
    Eigen::Matrix4d values;
    values << 1, 0, 0, 0,   //
        0, 1 / h, 0, third, //
        1, 1, 1, 1,         //
        0, 1 / h, 2 / h, 3 / h + third;
    return values.inverse();
}

/// Functions at x of the four unknowns: w, w', phi, phi', each a row.
struct Shapes {
    Eigen::RowVector4d w, slope, phi, curvature, strain;
};

Shapes shapes_at(double x, double h, const Eigen::Matrix4d &a, double strain) {
    Shapes s;
    const auto row = [](double c0, double c1, double c2, double c3) {
        return Eigen::RowVector4d(c0, c1, c2, c3);
    };
    s.w = row(1, x, x * x, x * x * x) * a;
    s.slope = row(0, 1, 2 * x, 3 * x * x) / h * a;
    s.strain = row(0, 0, 0, -6 * strain / h) * a;
    s.phi = s.slope - s.strain;
    s.curvature = row(0, 0, 2, 6 * x) / (h * h) * a;
    return s;
}

/// Stations of the classical mesh: ends of elements and everything attached.
std::vector<double> nodes_of(const CaseRotor &rotor, int parts) {
    std::vector<double> nodes{0};
    double left = 0;
    for (const Segment &segment : rotor.shaft) {
        const int count = segment.elements * parts;
        for (int i = 1; i <= count; ++i)
            nodes.push_back(left + segment.left.length * i / count);
        left += segment.left.length;
    }
    for (const RigidDisc &disc : rotor.discs)
        nodes.push_back(disc.z);
    for (const Support &support : rotor.supports)
        nodes.push_back(support.z);
    for (const Imbalance &imbalance : rotor.imbalances)
        nodes.push_back(imbalance.z);
    for (const double plane : rotor.planes)
        nodes.push_back(plane);
    for (const Probe &probe : rotor.probes)
        nodes.push_back(probe.z);
    std::sort(nodes.begin(), nodes.end());
    const double near = 1e-9 * left;
    nodes.erase(std::unique(nodes.begin(), nodes.end(),
                            [near](double a, double b) { return b - a < near; }),
                nodes.end());
    return nodes;
}

void add_shaft(const CaseRotor &rotor, DenseRotor &out, Eigen::MatrixXd &shaft) {
    const Eigen::Index n = out.planar();
    double start = 0;
    std::size_t node = 0;
    for (const Segment &segment : rotor.shaft) {
        const double end = start + segment.left.length;
        for (; node + 1 < out.z.size() && out.z[node] < end - 1e-9 * rotor.length(); ++node) {
            const BeamMatrices beam = beam_matrices(
                element_between(segment, out.z[node] - start, out.z[node + 1] - start),
                rotor.axial_force);
            const auto first = static_cast<Eigen::Index>(2 * node);
            shaft.block<4, 4>(first, first) += beam.stiffness;
            for (const Eigen::Index at : {first, n + first}) {
                out.K.block<4, 4>(at, at) += beam.stiffness;
                out.M.block<4, 4>(at, at) += beam.mass;
            }
            out.G.block<4, 4>(first, n + first) += beam.gyroscopic;
            out.G.block<4, 4>(n + first, first) -= beam.gyroscopic;
        }
        start = end;
    }
}

void add_attached(const CaseRotor &rotor, DenseRotor &out) {
    const Eigen::Index n = out.planar();
    for (const RigidDisc &disc : rotor.discs) {
        const Eigen::Index w = out.deflection(disc.z);
        for (const Eigen::Index at : {w, n + w}) {
            out.M(at, at) += disc.mass;
            out.M(at + 1, at + 1) += disc.Id;
        }
        out.G(w + 1, n + w + 1) += disc.Ip;
        out.G(n + w + 1, w + 1) -= disc.Ip;
    }
    for (std::size_t place = 0; place < rotor.supports.size(); ++place) {
        const Support &s = rotor.supports[place];
        const Eigen::Index w = out.deflection(s.z);
        const Eigen::Index p = out.pedestals[place];
        for (Eigen::Index i = 0; i < 2; ++i)
            for (Eigen::Index j = 0; j < 2; ++j) {
                const auto row = static_cast<std::size_t>(i);
                const auto column = static_cast<std::size_t>(j);
                const auto add = [&](Eigen::MatrixXd &A, double value) {
                    A(i * n + w, j * n + w) += value;
                    if (p < 0)
                        return;
                    A(i * n + p, j * n + p) += value;
                    A(i * n + w, j * n + p) -= value;
                    A(i * n + p, j * n + w) -= value;
                };
                add(out.K, s.k[row][column]);
                add(out.C, s.c[row][column]);
                out.K(i * n + w + 1, j * n + w + 1) += s.kt[row][column];
                out.C(i * n + w + 1, j * n + w + 1) += s.ct[row][column];
            }
        if (p >= 0)
            for (const Eigen::Index axis : {0, 1}) {
                const Mount &mount = rotor.mounts[place];
                const auto of = static_cast<std::size_t>(axis);
                out.M(axis * n + p, axis * n + p) += mount.pedestal_mass[of];
                out.C(axis * n + p, axis * n + p) += mount.pedestal_c[of];
                out.K(axis * n + p, axis * n + p) += mount.pedestal_k[of];
            }
    }
}

/// A += factor v^T v
void add_square(Eigen::Matrix4d &A, double factor, const Eigen::RowVector4d &v) {
    for (Eigen::Index i = 0; i < 4; ++i)
        for (Eigen::Index j = 0; j < 4; ++j)
            A(i, j) += factor * v(i) * v(j);
}

} // namespace

Cylinder element_between(const Segment &segment, double left, double right) {
    const double share = (left + right) / 2 / segment.left.length;
    Cylinder out = segment.left;
    out.length = right - left;
    out.outer += share * (segment.outer_end - segment.left.outer);
    out.inner += share * (segment.inner_end - segment.left.inner);
    return out;
}

BeamMatrices beam_matrices(const Cylinder &cylinder, double axial_force) {
    const Section s = section_of(cylinder);
    const double h = cylinder.length;
    const double strain = s.EI / (s.shear * h * h);
    const Eigen::Matrix4d a = cubic(h, strain);
    BeamMatrices out;
    for (Eigen::Matrix4d *matrix : {&out.stiffness, &out.bending, &out.mass, &out.gyroscopic})
        matrix->setZero();
    // Gauss's four points: exact to degree 7, w^2 has degree 6
    const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
    const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
    const double heavy = (18 + std::sqrt(30.0)) / 36;
    const double light = (18 - std::sqrt(30.0)) / 36;
    const std::array<std::array<double, 2>, 4> rule{
        {{-outer, light}, {-inner, heavy}, {inner, heavy}, {outer, light}}};
    for (const auto &[point, share] : rule) {
        const Shapes f = shapes_at((1 + point) / 2, h, a, strain);
        const double dz = share * h / 2;
        add_square(out.stiffness, dz * s.EI, f.curvature);
        add_square(out.bending, dz * s.EI, f.curvature);
        add_square(out.stiffness, dz * s.shear, f.strain);
        add_square(out.stiffness, dz * axial_force, f.slope);
        add_square(out.mass, dz * cylinder.rho * s.area, f.w);
        add_square(out.mass, dz * cylinder.rho * s.I, f.phi);
        add_square(out.gyroscopic, 2 * dz * cylinder.rho * s.I, f.phi);
    }
    return out;
}

Eigen::Index DenseRotor::deflection(double place) const {
    for (std::size_t i = 0; i < z.size(); ++i)
        if (std::abs(z[i] - place) < 1e-9 * z.back())
            return static_cast<Eigen::Index>(2 * i);
    throw std::runtime_error("no node there");
}

DenseRotor dense_rotor(const CaseRotor &rotor, int parts) {
    DenseRotor out;
    out.z = nodes_of(rotor, parts);
    auto n = static_cast<Eigen::Index>(2 * out.z.size());
    for (std::size_t i = 0; i < rotor.supports.size(); ++i)
        out.pedestals.push_back(i < rotor.mounts.size() && rotor.mounts[i].pedestal_k[0] > 0 ? n++
                                                                                             : -1);
    for (Eigen::MatrixXd *matrix : {&out.M, &out.C, &out.G, &out.K, &out.Kc})
        *matrix = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    Eigen::MatrixXd shaft = Eigen::MatrixXd::Zero(n, n);
    add_shaft(rotor, out, shaft);
    add_attached(rotor, out);
    const Eigen::MatrixXd inner = rotor.internal_damping * shaft;
    out.C.topLeftCorner(n, n) += inner;
    out.C.bottomRightCorner(n, n) += inner;
    out.Kc.topRightCorner(n, n) += inner;
    out.Kc.bottomLeftCorner(n, n) -= inner;
    return out;
}

std::vector<std::complex<double>> whirl_eigenvalues(const DenseRotor &rotor, double speed) {
    // 1/lambda of (q, lambda q/scale): the lowest motions become the largest eigenvalues
    const Eigen::Index n = rotor.M.rows();
    const Eigen::PartialPivLU<Eigen::MatrixXd> stiffness(rotor.K + speed * rotor.Kc);
    const Eigen::MatrixXd flexibility = stiffness.solve(rotor.M);
    const double scale = 1 / std::sqrt(flexibility.norm());
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    const Eigen::MatrixXd damping = rotor.C + speed * rotor.G;
    const Eigen::MatrixXd rates = stiffness.solve(damping);
    state.topLeftCorner(n, n) = -scale * rates;
    state.topRightCorner(n, n) = -scale * scale * flexibility;
    state.bottomLeftCorner(n, n).setIdentity();
    const Eigen::VectorXcd all = Eigen::EigenSolver<Eigen::MatrixXd>(state, false).eigenvalues();
    std::vector<std::complex<double>> out;
    for (const std::complex<double> &mu : all)
        if (mu.imag() < -1e-7 * std::abs(mu))
            out.push_back(scale / mu);
    std::sort(out.begin(), out.end(),
              [](const auto &a, const auto &b) { return a.imag() < b.imag(); });
    return out;
}

std::vector<std::complex<double>> synchronous_eigenvalues(const DenseRotor &rotor) {
    // As above; the spin speed -i l goes with G and Kc.
    const std::complex<double> i(0, 1);
    const Eigen::Index n = rotor.M.rows();
    const Eigen::PartialPivLU<Eigen::MatrixXd> stiffness(rotor.K);
    const Eigen::MatrixXd still = stiffness.solve(rotor.M);
    const Eigen::MatrixXd turning = stiffness.solve(rotor.G);
    const Eigen::MatrixXd damping = stiffness.solve(rotor.C);
    const Eigen::MatrixXd inner = stiffness.solve(rotor.Kc);
    const double scale = 1 / std::sqrt(still.norm());
    Eigen::MatrixXcd state = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
    for (Eigen::Index column = 0; column < n; ++column) {
        for (Eigen::Index row = 0; row < n; ++row) {
            state(row, column) = -scale * (damping(row, column) - i * inner(row, column));
            state(row, n + column) =
                -scale * scale * (still(row, column) - i * turning(row, column));
        }
        state(n + column, column) = 1;
    }
    std::vector<std::complex<double>> out;
    const Eigen::VectorXcd all =
        Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(state, false).eigenvalues();
    for (const std::complex<double> &mu : all)
        if (-mu.imag() > std::abs(mu.real()))
            out.push_back(scale / mu);
    std::sort(out.begin(), out.end(),
              [](const auto &a, const auto &b) { return a.imag() < b.imag(); });
    return out;
}

std::vector<Crossing> crossings(const DenseRotor &rotor, double multiple) {
    const std::complex<double> i(0, 1);
    const Eigen::MatrixXcd inertia = rotor.M.cast<std::complex<double>>() -
                                     (i / multiple) * rotor.G.cast<std::complex<double>>();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd> pairs(
        inertia, rotor.K.cast<std::complex<double>>());
    const Eigen::Index n = rotor.planar();
    std::vector<Crossing> out;
    for (Eigen::Index k = pairs.eigenvalues().size() - 1; k >= 0; --k) {
        const double mu = pairs.eigenvalues()[k];
        if (mu <= 0)
            break;
        const auto x = pairs.eigenvectors().col(k).head(n);
        const auto y = pairs.eigenvectors().col(k).tail(n);
        out.push_back({1 / (std::sqrt(mu) * multiple), (x + i * y).norm() > (x - i * y).norm()});
    }
    return out;
}

namespace {

// Wide: near resonances the solution loses as many digits as the matrix is stiffer than they.
using Wide = std::complex<long double>;

/// All unknowns, times exp(i speed t).
ComplexMatrix forced_unknowns(const CaseRotor &rotor, double speed, const DenseRotor &dense) {
    const Eigen::Index n = dense.planar();
    const Wide i(0, 1);
    ComplexMatrix force = ComplexMatrix::Zero(2 * n, 1);
    for (const Imbalance &imbalance : rotor.imbalances) {
        const Wide f = static_cast<long double>(imbalance.mr) * speed * speed *
                       std::polar(1.0L, static_cast<long double>(imbalance.phase));
        const Eigen::Index w = dense.deflection(imbalance.z);
        force(w, 0) += f;
        force(n + w, 0) -= i * f;
    }
    const long double W = speed;
    ComplexMatrix dynamic(2 * n, 2 * n);
    for (Eigen::Index l = 0; l < 2 * n; ++l)
        for (Eigen::Index k = 0; k < 2 * n; ++k)
            dynamic(k, l) = Wide(dense.K(k, l) + W * dense.Kc(k, l) - W * W * dense.M(k, l),
                                 W * (dense.C(k, l) + W * dense.G(k, l)));
    return solve(dynamic, force);
}

/// x and y at z.
std::array<Wide, 2> forced_motion(const CaseRotor &rotor, double speed, double z, int parts) {
    const DenseRotor dense = dense_rotor(rotor.at_speed(speed), parts);
    const ComplexMatrix q = forced_unknowns(rotor, speed, dense);
    const Eigen::Index w = dense.deflection(z);
    return {q(w, 0), q(dense.planar() + w, 0)};
}

} // namespace

ForcedPlaces forced_places(const CaseRotor &rotor, double speed) {
    const CaseRotor there = rotor.at_speed(speed);
    const DenseRotor dense = dense_rotor(there);
    const ComplexMatrix q = forced_unknowns(rotor, speed, dense);
    const std::complex<double> turning(0, speed);
    ForcedPlaces out;
    for (std::size_t place = 0; place < there.supports.size(); ++place) {
        const Support &support = there.supports[place];
        const Eigen::Index w = dense.deflection(support.z);
        const Eigen::Index p = dense.pedestals[place];
        ForcedPlaces::Pair film, force, pedestal;
        for (const Eigen::Index axis : {0, 1}) {
            const Eigen::Index from = axis * dense.planar();
            const auto at = static_cast<std::size_t>(axis);
            const Wide below = p < 0 ? Wide(0) : Wide(q(from + p, 0));
            pedestal[at] = std::complex<double>(below);
            film[at] = std::complex<double>(Wide(q(from + w, 0)) - below);
        }
        for (const std::size_t i : {0U, 1U})
            for (const std::size_t j : {0U, 1U})
                force[i] += (support.k[i][j] + turning * support.c[i][j]) * film[j];
        out.films.push_back(film);
        out.forces.push_back(force);
        out.pedestals.push_back(pedestal);
    }
    return out;
}

double major_of(const ForcedPlaces::Pair &motion) {
    const std::complex<double> i(0, 1);
    const auto [x, y] = motion;
    return (std::abs(x + i * y) + std::abs(std::conj(x) + i * std::conj(y))) / 2;
}

double semi_major(const CaseRotor &rotor, double speed, double z, int parts) {
    const Wide i(0, 1);
    const auto [x, y] = forced_motion(rotor, speed, z, parts);
    return static_cast<double>((std::abs(x + i * y) + std::abs(std::conj(x) + i * std::conj(y))) /
                               2.0L);
}

double probe_reading(const CaseRotor &rotor, double speed, const Probe &probe) {
    const DenseRotor dense = dense_rotor(rotor.at_speed(speed));
    const ComplexMatrix q = forced_unknowns(rotor, speed, dense);
    const long double angle = probe.angle;
    Wide reading = 0;
    for (const Eigen::Index axis : {0, 1}) {
        const Eigen::Index from = axis * dense.planar();
        Wide seen = 0;
        if (!probe.on_pedestal)
            seen += q(from + dense.deflection(probe.z), 0);
        const Eigen::Index p =
            probe.support < dense.pedestals.size() ? dense.pedestals[probe.support] : -1;
        if (p >= 0 && (probe.on_pedestal || probe.relative))
            seen += (probe.on_pedestal ? 1.0L : -1.0L) * q(from + p, 0);
        reading += seen * (axis == 0 ? std::cos(angle) : std::sin(angle));
    }
    return static_cast<double>(std::abs(reading));
}

} // namespace whirl::oracles
