#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace whirl::model {

/// A linear elastic material.
struct Material {
    std::string name;
    double E = 0;   ///< Young's modulus, Pa
    double G = 0;   ///< shear modulus, Pa
    double rho = 0; ///< density, kg/m3

    /// Poisson's ratio of an isotropic material with these moduli.
    [[nodiscard]] double poisson_ratio() const { return E / (2 * G) - 1; }
};

/// Which shear coefficient a circular section gets.
enum class ShearFormula {
    cowper,     ///< Cowper, J. Appl. Mech. 33 (1966) 335
    hutchinson, ///< Hutchinson, J. Appl. Mech. 68 (2001) 87
    given       ///< the number in Shaft::shear_coefficient
};

/// A tube around or inside of a segment that bends with it: a sleeve, a coating, a weld.
struct Layer {
    double outer = 0; ///< diameter, m
    double inner = 0; ///< diameter, m
    Material material;
};

/// A length of shaft whose diameters vary linearly from its start to its end.
struct Segment {
    double length = 0;      ///< m
    double outer_start = 0; ///< outer diameter at the start, m
    double outer_end = 0;   ///< outer diameter at the end, m
    double inner_start = 0; ///< bore diameter at the start, m
    double inner_end = 0;   ///< bore diameter at the end, m
    Material material;
    int elements = 1; ///< elements of equal length before nodes of attached components are added
    /// Share by which the second moment of area differs between two perpendicular axes that turn
    /// with the shaft (a keyway): I (1 + asymmetry) and I (1 - asymmetry), I that of the circle.
    double asymmetry = 0;
    double asymmetry_angle = 0;   ///< direction of deflection in the rotor that is stiffer, rad
    double shear_coefficient = 0; ///< kappa; 0: that of the shaft's formula
    /// Diameters of what has mass, where they are not those of what carries load, m; 0: the same.
    double mass_outer = 0;
    double mass_inner = 0;
    std::vector<Layer> layers{}; ///< beside the segment's own section
};

/// Direction of the torque where it enters and leaves the shaft (Ziegler 1968, ch. 3 and 5).
enum class TorqueKind {
    axial,          ///< along z, however the end is inclined
    semitangential, ///< half way between z and the tangent: it has a potential
    tangential      ///< along the tangent, which it follows
};

/// The flexible shaft, from z = 0 to the sum of the lengths of its segments.
struct Shaft {
    std::vector<Segment> segments;
    int order = 4;           ///< 1: classical two-node element; p >= 2: order-p element
    bool order_auto = false; ///< raise the order until `tolerance` holds
    double tolerance = 1e-8; ///< relative error wanted in the frequencies asked for (order_auto)
    ShearFormula shear = ShearFormula::cowper;
    double shear_coefficient = 0; ///< kappa, where shear == given
    bool rigid = false;           ///< no elastic unknowns: the rigid-body limit
    double internal_damping = 0;  ///< s; stress = E (strain + internal_damping * strain rate)
    /// Damping that does not turn with the shaft: C = alpha M + beta K of its elements (without
    /// discs and axial force), on velocities in the fixed frame.
    double alpha = 0;       ///< 1/s
    double beta = 0;        ///< s
    double axial_force = 0; ///< N, tension positive
    /// Torque that the shaft carries from z = 0 to its end: about +z on the end z = length(),
    /// against it on the other, N m.
    double axial_torque = 0;
    TorqueKind torque_kind = TorqueKind::axial;
    /// A torque without a potential does work on a shaft whose ends tilt.
    [[nodiscard]] bool torque_has_potential() const {
        return axial_torque == 0 || rigid || torque_kind == TorqueKind::semitangential;
    }
    /// Damping that does not turn, by ratios of the lowest modes at rest of the rotor on its
    /// bearings, in each plane (assembly/modal_damping.h).
    std::vector<double> modal_damping;
    /// Without it the shaft's sections have mass and no moment of inertia, so no gyroscopic effect.
    bool rotary_inertia = true;

    /// Some segment has two different bending stiffnesses.
    [[nodiscard]] bool asymmetric() const {
        return std::ranges::any_of(segments,
                                   [](const Segment &segment) { return segment.asymmetry != 0; });
    }
    /// Damping of any kind.
    [[nodiscard]] bool damped() const { return internal_damping != 0 || damped_outside(); }
    /// Damping that does not turn with the shaft.
    [[nodiscard]] bool damped_outside() const {
        return alpha != 0 || beta != 0 || !modal_damping.empty();
    }
    /// Length of the shaft, m.
    [[nodiscard]] double length() const {
        double sum = 0;
        for (const Segment &segment : segments)
            sum += segment.length;
        return sum;
    }
};

} // namespace whirl::model
