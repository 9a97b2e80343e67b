#include "assembly/assemble.h"

#include "linalg/dense/products.h"

#include <vector>

namespace whirl::assembly {

namespace {

/// Rows: the unknowns of a beam element; columns: the two unknowns of a rigid shaft.
Eigen::MatrixXd rigid_element_motion(const Discretization &d, int span) {
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(d.beam(span).M.rows(), 2);
    for (int end = 0; end < 2; ++end) {
        for (const auto &[unknown, value] : d.deflection_at_node(span + end))
            T(2 * end, unknown) = value;
        T(2 * end + 1, 1) = 1;
    }
    return T;
}

/// Coefficients on (x, y) with the symmetry that they have but for rounding, as after a turn of the
/// axes (model/bearing.h): what couples the axes against it feeds or drains energy, however small.
Eigen::Matrix2d without_rounding(const Eigen::Matrix2d &a) {
    const double mean = a.trace() / 2;
    if (model::isotropic(a))
        return mean * Eigen::Matrix2d::Identity();
    Eigen::Matrix2d out = a;
    if (model::diagonal(a)) {
        out(0, 1) = out(1, 0) = 0;
    } else if (model::symmetric(a)) {
        out(0, 1) = out(1, 0) = (a(0, 1) + a(1, 0)) / 2;
    } else if (model::rotation_invariant(a)) {
        const double across = (a(0, 1) - a(1, 0)) / 2;
        out << mean, across, -across, mean;
    }
    return out;
}

void assemble_shaft(const Discretization &d, const AddPlanar &add) {
    const double eta = d.rotor().shaft.internal_damping;
    for (int span = 0; span < static_cast<int>(d.shaft_mesh().spans.size()); ++span) {
        const elements::PlanarMatrices &beam = d.beam(span);
        if (d.rigid()) {
            const std::vector<int> both{0, 1};
            const Eigen::MatrixXd T = rigid_element_motion(d, span);
            add(Term::mass, both, linalg::congruent(beam.M, T));
            add(Term::gyroscopic, both, linalg::congruent(beam.G, T));
            add(Term::stiffness, both, linalg::congruent(beam.K_axial, T));
            continue;
        }
        const std::vector<int> unknowns = d.beam_unknowns(span);
        add(Term::mass, unknowns, beam.M);
        add(Term::gyroscopic, unknowns, beam.G);
        add(Term::stiffness, unknowns, beam.K + beam.K_axial);
        if (eta != 0) {
            add(Term::damping, unknowns, eta * beam.K);
            add(Term::circulatory, unknowns, eta * beam.K);
        }
    }
}

/// coefficient * c c^T for a combination c of unknowns.
void add_square(Term term, const Combination &c, double coefficient, const AddPlanar &add) {
    std::vector<int> unknowns;
    Eigen::VectorXd values(static_cast<Eigen::Index>(c.size()));
    for (const auto &[unknown, value] : c) {
        values(static_cast<Eigen::Index>(unknowns.size())) = value;
        unknowns.push_back(unknown);
    }
    add(term, unknowns, coefficient * values * values.transpose());
}

/// Bending stiffness and rotary inertia of a segment share its asymmetry: both are proportional to
/// the second moments of its section.
void assemble_shaft_asymmetry(const Discretization &d, const AddConjugate &add) {
    const model::Shaft &shaft = d.rotor().shaft;
    for (int span = 0; span < static_cast<int>(d.shaft_mesh().spans.size()); ++span) {
        const auto index = static_cast<std::size_t>(span);
        const model::Segment &segment =
            shaft.segments[static_cast<std::size_t>(d.shaft_mesh().spans[index].segment)];
        if (segment.asymmetry == 0)
            continue;
        const elements::PlanarMatrices &beam = d.beam(span);
        const std::complex<double> factor =
            std::polar(1.0, 2 * segment.asymmetry_angle) * segment.asymmetry;
        if (d.rigid()) {
            const Eigen::MatrixXd T = rigid_element_motion(d, span);
            add(Term::mass, std::vector<int>{0, 1}, linalg::congruent(beam.G, T) / 2, factor);
            continue;
        }
        const std::vector<int> unknowns = d.beam_unknowns(span);
        add(Term::mass, unknowns, beam.G / 2, factor);
        add(Term::stiffness, unknowns, beam.K_bending, factor);
        if (shaft.internal_damping != 0)
            add(Term::damping, unknowns, shaft.internal_damping * beam.K_bending, factor);
    }
}

/// Entries of a planar matrix times a block on (x, y).
void add_element(Term term, const std::vector<int> &unknowns, const Eigen::MatrixXd &matrix,
                 const Eigen::Matrix2d &block, const AddCoupling &add) {
    for (std::size_t i = 0; i < unknowns.size(); ++i)
        for (std::size_t j = 0; j < unknowns.size(); ++j) {
            const double a = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
            if (a != 0)
                add(term, unknowns[i], unknowns[j], a * block);
        }
}

/// alpha M + beta K of the shaft's elements, on velocities in the fixed frame.
void assemble_proportional_damping(const Discretization &d, const AddCoupling &add) {
    const model::Shaft &shaft = d.rotor().shaft;
    if (shaft.alpha == 0 && shaft.beta == 0)
        return;
    for (int span = 0; span < static_cast<int>(d.shaft_mesh().spans.size()); ++span) {
        const elements::PlanarMatrices &beam = d.beam(span);
        const std::vector<int> unknowns =
            d.rigid() ? std::vector<int>{0, 1} : d.beam_unknowns(span);
        const Eigen::MatrixXd T = d.rigid() ? rigid_element_motion(d, span) : Eigen::MatrixXd();
        const Eigen::MatrixXd block =
            d.rigid() ? Eigen::MatrixXd(shaft.alpha * linalg::congruent(beam.M, T))
                      : Eigen::MatrixXd(shaft.alpha * beam.M + shaft.beta * beam.K);
        add_element(Term::damping, unknowns, block, Eigen::Matrix2d::Identity(), add);
    }
}

void add_product(Term term, const Combination &row, const Combination &column,
                 const Eigen::Matrix2d &block, const AddCoupling &add) {
    if (block.isZero(0))
        return;
    for (const auto &[i, a] : row)
        for (const auto &[j, b] : column)
            add(term, i, j, a * b * block);
}

/// i b on x + i y as a block on (x, y).
Eigen::Matrix2d turned(double b) {
    Eigen::Matrix2d block;
    block << 0, -b, b, 0;
    return block;
}

void assemble_disc(const Discretization &d, const model::Disc &disc, const AddPlanar &add) {
    add_square(Term::mass, d.deflection_at(disc.z), disc.mass, add);
    add_square(Term::mass, d.slope_at(disc.z), disc.Id, add);
    add_square(Term::gyroscopic, d.slope_at(disc.z), disc.Ip, add);
}

} // namespace

void assemble_rotating_parts(const Discretization &discretization, const AddPlanar &add) {
    assemble_shaft(discretization, add);
    for (const model::Disc &disc : discretization.rotor().discs)
        assemble_disc(discretization, disc, add);
}

void assemble_asymmetry(const Discretization &discretization, const AddConjugate &add) {
    assemble_shaft_asymmetry(discretization, add);
    for (const model::Anisotropy &anisotropy : discretization.rotor().anisotropies) {
        const std::complex<double> factor = std::polar(1.0, 2 * anisotropy.angle);
        add_square(Term::mass, discretization.slope_at(anisotropy.z), anisotropy.dI,
                   [&](Term term, std::span<const int> unknowns, const Eigen::MatrixXd &block) {
                       add(term, unknowns, block, factor);
                   });
    }
}

void assemble_outside_damping(const Discretization &discretization, const AddCoupling &add) {
    assemble_proportional_damping(discretization, add);
    if (discretization.rotor().shaft.modal_damping.empty())
        return;
    const auto &[x, y] = discretization.modal_damping();
    const bool round = discretization.rotor().bearings_isotropic();
    for (int i = 0; i < discretization.planar_size(); ++i)
        for (int j = 0; j < discretization.planar_size(); ++j)
            if (x(i, j) != 0 || y(i, j) != 0)
                add(Term::damping, i, j,
                    Eigen::Vector2d(x(i, j), (round ? x : y)(i, j)).asDiagonal());
}

void assemble_film(const Discretization &discretization, int index, double speed,
                   const AddCoupling &add) {
    const model::Bearing &bearing =
        discretization.rotor().bearings[static_cast<std::size_t>(index)];
    model::BearingCoefficients at = bearing.at(speed);
    for (Eigen::Matrix2d *block : {&at.k, &at.c, &at.m, &at.kt, &at.ct})
        *block = without_rounding(*block);
    const Combination phi = discretization.slope_at(bearing.z);
    add_product(Term::stiffness, phi, phi, at.kt, add);
    add_product(Term::damping, phi, phi, at.ct, add);
    Combination stretch = discretization.deflection_at(bearing.z); // shaft minus pedestal
    if (bearing.pedestal)
        stretch.emplace_back(discretization.pedestal_unknown(index), -1.0);
    add_product(Term::stiffness, stretch, stretch, at.k, add);
    add_product(Term::damping, stretch, stretch, at.c, add);
    add_product(Term::mass, stretch, stretch, at.m, add);
}

void assemble_pedestal(const Discretization &discretization, int index, const AddCoupling &add) {
    const model::Bearing &bearing =
        discretization.rotor().bearings[static_cast<std::size_t>(index)];
    if (!bearing.pedestal)
        return;
    const Combination below{{discretization.pedestal_unknown(index), 1.0}};
    const model::Pedestal &pedestal = *bearing.pedestal;
    add_product(Term::mass, below, below, pedestal.mass.asDiagonal(), add);
    add_product(Term::damping, below, below, pedestal.c.asDiagonal(), add);
    add_product(Term::stiffness, below, below, pedestal.k.asDiagonal(), add);
}

void assemble_bearings(const Discretization &discretization, double speed, const AddCoupling &add) {
    const auto count = static_cast<int>(discretization.rotor().bearings.size());
    for (int i = 0; i < count; ++i) {
        assemble_pedestal(discretization, i, add);
        assemble_film(discretization, i, speed, add);
    }
}

/// What the ends add to the part of the torque that has a potential; a rigid shaft is not bent.
void assemble_torque(const Discretization &d, const AddCoupling &add) {
    const model::Shaft &shaft = d.rotor().shaft;
    if (shaft.axial_torque == 0 || d.rigid())
        return;
    const auto last = static_cast<int>(d.shaft_mesh().spans.size());
    for (int span = 0; span < last; ++span)
        add_element(Term::stiffness, d.beam_unknowns(span), d.beam(span).torque, turned(1), add);
    const double follows = shaft.torque_kind == model::TorqueKind::axial        ? -1
                           : shaft.torque_kind == model::TorqueKind::tangential ? 1
                                                                                : 0;
    for (const auto &[node, side] : {std::pair(0, -1.0), std::pair(last, 1.0)}) {
        const Combination phi = d.slope_at_node(node);
        add_product(Term::stiffness, phi, phi, turned(side * follows * shaft.axial_torque / 2),
                    add);
    }
}

void assemble_supports(const Discretization &discretization, double speed, const AddCoupling &add) {
    assemble_bearings(discretization, speed, add);
    assemble_torque(discretization, add);
    assemble_outside_damping(discretization, add);
}

} // namespace whirl::assembly
