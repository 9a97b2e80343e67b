#pragma once

#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

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
    const double ro2 = outer * outer / 4;
    const double ri2 = inner * inner / 4;
    Disc disc;
    disc.z = z;
    disc.mass = rho * std::numbers::pi * (ro2 - ri2) * width;
    disc.Ip = disc.mass * (ro2 + ri2) / 2;
    disc.Id = disc.mass * (3 * (ro2 + ri2) + width * width) / 12;
    disc.outer = outer;
    disc.width = width;
    return disc;
}

/// Rotating inertial anisotropy at z: diametral inertias Id + dI and Id - dI about two
/// perpendicular axes that turn with the rotor.
struct Anisotropy {
    std::string name;
    double z = 0;     ///< m
    double dI = 0;    ///< kg m2
    double angle = 0; ///< direction of the axis of smaller inertia in the rotor, rad
};

/// A place that a result is asked for of, with nothing there.
struct Station {
    double z = 0; ///< m
};

/// A correction plane: for the empirical criterion, and for correction weights, which alone ask
/// for more than its place.
struct CorrectionPlane {
    std::string name;
    double z = 0;                              ///< m
    std::optional<double> radius{};            ///< at which weights are set, m
    std::optional<double> max{};               ///< largest weight to be added, kg m
    int holes = 0;                             ///< evenly around it; 0: weights go anywhere
    double hole_angle = 0;                     ///< of the first, rad, in the phase of the weights
    std::vector<std::complex<double>> fixed{}; ///< weights that are set already and stay, kg m
};

/// A displacement sensor, which does not turn: it reads x cos(angle) + y sin(angle).
struct Probe {
    std::string name;
    double z = 0;     ///< m
    double angle = 0; ///< direction in which it looks, from x towards y, rad
    /// It sits on a pedestal and moves with it, or beside the shaft, which it then reads.
    bool on_pedestal = false;
    /// Of the shaft: against what holds the bearing, or in the fixed frame. None: not said; then it
    /// reads in the fixed frame, and limits count for both.
    std::optional<bool> relative{};
    std::optional<std::size_t> bearing{}; ///< among the supports; none: the nearest
};

/// A small static imbalance fixed in the rotor.
struct Imbalance {
    std::string name;
    double z = 0;     ///< m
    double mr = 0;    ///< mass times radius, kg m
    double phase = 0; ///< rad
};

} // namespace whirl::model
