#pragma once

#include "model/rotor.h"

#include <vector>

namespace whirl::tests {

/// The steel of Friswell et al. (2010), chapter 5.
inline model::Material friswell_steel() { return {"steel", 211e9, 81.2e9, 7810}; }

inline model::Segment cylinder(double length, double outer, int elements = 1, double inner = 0) {
    return {length, outer, outer, inner, inner, friswell_steel(), elements};
}

/// Uniform solid shaft without anything attached.
inline model::Rotor uniform_shaft(double length, double outer, int elements = 1) {
    model::Rotor rotor;
    rotor.shaft.segments = {cylinder(length, outer, elements)};
    return rotor;
}

/// Bearing with kxx, kyy, cross stiffness kxy = kyx and isotropic damping.
inline model::Bearing bearing(double z, double kxx, double kyy, double kxy = 0, double c = 0) {
    model::BearingCoefficients at;
    at.k << kxx, kxy, kxy, kyy;
    at.c << c, 0, 0, c;
    model::Bearing out;
    out.z = z;
    out.rows = {at};
    return out;
}

inline model::Disc disc(double z, double mass, double Id, double Ip) {
    model::Disc out;
    out.z = z;
    out.mass = mass;
    out.Id = Id;
    out.Ip = Ip;
    return out;
}

/// Shaft of Friswell et al. (2010), section 5.9: 1.5 m x 50 mm, one element a segment of 0.5 m.
inline model::Rotor friswell_shaft() {
    model::Rotor rotor;
    rotor.shaft.segments = {cylinder(0.5, 0.05), cylinder(0.5, 0.05), cylinder(0.5, 0.05)};
    return rotor;
}

/// Example 5.9.1 and its relatives: two discs, the same bearing at both ends.
inline model::Rotor two_disc_rotor(double kxx, double kyy, double kxy = 0, double c = 0) {
    model::Rotor rotor = friswell_shaft();
    rotor.discs = {disc(0.5, 32.58972765, 0.178089283, 0.329563621),
                   disc(1.0, 51.52526111, 0.423580584, 0.805082205)};
    rotor.bearings = {bearing(0, kxx, kyy, kxy, c), bearing(1.5, kxx, kyy, kxy, c)};
    return rotor;
}

/// The rotor with two discs out of balance, on pedestals and in films whose masses differ in x and
/// y.
inline model::Rotor rotor_on_unlike_masses() {
    model::Rotor rotor = two_disc_rotor(1e7, 2e7, 0, 500);
    rotor.imbalances = {{"", 0.5, 1e-4, 0}};
    for (model::Bearing &bearing : rotor.bearings) {
        bearing.rows[0].m << 3, 0.5, 0.5, 4;
        bearing.pedestal.emplace();
        bearing.pedestal->mass << 20, 30;
        bearing.pedestal->k << 5e7, 3e7;
        bearing.pedestal->c << 100, 200;
    }
    return rotor;
}

} // namespace whirl::tests
