#pragma once

#include "model/case.h"

namespace whirl::tests {

inline model::Material steel() { return {"steel", 2e11, 7.7e10, 7800}; }

/// A material without noticeable mass: its share of the rotor's is below 1e-15.
inline model::Material weightless_steel() { return {"weightless", 2e11, 7.7e10, 1e-12}; }

/// One uniform solid segment, order 4.
inline model::Shaft uniform_shaft(double length, double diameter, const model::Material &material) {
    model::Shaft shaft;
    shaft.segments.push_back({length, diameter, diameter, 0, 0, material, 1});
    return shaft;
}

inline model::Bearing isotropic_bearing(double z, double k, double c = 0) {
    model::Bearing bearing;
    bearing.z = z;
    model::BearingCoefficients row;
    row.k = k * Eigen::Matrix2d::Identity();
    row.c = c * Eigen::Matrix2d::Identity();
    bearing.rows.push_back(row);
    return bearing;
}

inline model::Disc disc_at(double z, double mass, double Id, double Ip) {
    model::Disc disc;
    disc.z = z;
    disc.mass = mass;
    disc.Id = Id;
    disc.Ip = Ip;
    return disc;
}

inline model::Imbalance imbalance_at(double z, double mr, double phase = 0) {
    return {"", z, mr, phase};
}

} // namespace whirl::tests
