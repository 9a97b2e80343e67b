#pragma once

#include <string>

namespace whirl::model {

/// A rigid axisymmetric disc, its centre of mass on the axis at z.
struct Disc {
    std::string name;
    double z = 0;     ///< m
    double mass = 0;  ///< kg
    double Id = 0;    ///< diametral moment of inertia about the centre, kg m2
    double Ip = 0;    ///< polar moment of inertia, kg m2
    double outer = 0; ///< outer diameter, m; only for drawings, 0 where not given
    double width = 0; ///< m; only for drawings, 0 where not given
};

/// Disc from its geometry: hollow cylinder of the given diameters, width and density.
///
/// @param z,outer,inner,width  m
/// @param rho                  kg/m3
[[nodiscard]] inline Disc disc_from_geometry(double z, double outer, double inner, double width,
                                             double rho) {
    const double pi = 3.14159265358979323846;
    const double ro2 = outer * outer / 4;
    const double ri2 = inner * inner / 4;
    Disc disc;
    disc.z = z;
    disc.mass = rho * pi * (ro2 - ri2) * width;
    disc.Ip = disc.mass * (ro2 + ri2) / 2;
    disc.Id = disc.mass * (3 * (ro2 + ri2) + width * width) / 12;
    disc.outer = outer;
    disc.width = width;
    return disc;
}

} // namespace whirl::model
