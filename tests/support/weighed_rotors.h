#pragma once

#include "model/case.h"
#include "results/response.h"
#include "support/peaks.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace whirl::tests {

inline constexpr double g = 9.81; ///< m/s2

/// Disc in the middle of a massless shaft with two stiffnesses, on two equal bearings.
struct Keyway {
    double length = 0.8, diameter = 0.025, mass = 9, k = 2e6, c = 0, asymmetry = 0.06, angle = 0.5;

    [[nodiscard]] model::Case scene(double from, double to, int count) const {
        model::Case out;
        out.rotor.shaft = uniform_shaft(length, diameter, weightless_steel());
        out.rotor.shaft.segments[0].asymmetry = asymmetry;
        out.rotor.shaft.segments[0].asymmetry_angle = angle;
        out.rotor.shaft.shear = model::ShearFormula::given;
        out.rotor.shaft.shear_coefficient = 0.9;
        out.rotor.discs = {disc_at(length / 2, mass, 0.02, 0.03)};
        out.rotor.bearings = {isotropic_bearing(0, k, c), isotropic_bearing(length, k, c)};
        out.speeds = model::SpeedRange{from, to, count};
        out.response.gravity = g;
        return out;
    }

    /// Deflections of the disc (from the ground) for a unit force along and across the stiff axis,
    /// without those of the bearings: mean, and half the difference.
    [[nodiscard]] double compliance(double sign) const {
        const double area = std::numbers::pi * diameter * diameter / 4;
        const double I = area * diameter * diameter / 16;
        const model::Material material = steel();
        return std::pow(length, 3) / (48 * material.E * I * (1 + sign * asymmetry)) +
               length / (4 * 0.9 * material.G * area);
    }
    [[nodiscard]] double mean() const { return (compliance(1) + compliance(-1)) / 2; }
    [[nodiscard]] std::complex<double> turning() const {
        return (compliance(1) - compliance(-1)) / 2 * std::polar(1.0, 2 * angle);
    }

    // In rotating axes u = A exp(i W t) + B exp(-i W t), forces 4 m W^2 A and -i g m on the shaft;
    // u = s_m f + s_d conj(f) and the bearings' compliances at 2 W and at rest.
    [[nodiscard]] std::complex<double> circle(double W) const {
        const std::complex<double> i(0, 1);
        const std::complex<double> s = mean() + 0.5 / (k + 2.0 * i * W * c);
        return turning() * (i * g * mass) / (1.0 - 4 * mass * W * W * s);
    }
    [[nodiscard]] std::complex<double> still(double W) const {
        const std::complex<double> i(0, 1);
        return (mean() + 0.5 / k) * (-i * g * mass) +
               turning() * std::conj(4 * mass * W * W * circle(W));
    }
};

inline const results::GravityStation &station(const results::ResponseResult &result, double z) {
    for (const results::GravityStation &of : result.gravity->stations)
        if (std::abs(of.z - z) < 1e-9)
            return of;
    throw std::runtime_error("no such station");
}

inline std::vector<results::ResponsePeak> peaks_at(const results::ResponseResult &result,
                                                   double z) {
    std::vector<results::ResponsePeak> out;
    for (const results::ResponsePeak &peak : result.gravity->peaks)
        if (peak.of == "station" && std::abs(peak.z - z) < 1e-9)
            out.push_back(peak);
    return out;
}

/// Some asymmetric flexible rotor with damping on bearings that are alike in all directions.
/// @param shaft  of two stiffnesses; else unequal inertias alone
inline model::Case weighed_rotor(Random &random, bool shaft = true) {
    model::Case scene;
    model::Rotor &rotor = scene.rotor;
    rotor.shaft = uniform_shaft(1.0, random(0.03, 0.08), steel());
    rotor.shaft.order = 2;
    rotor.shaft.segments[0].elements = 4;
    rotor.shaft.internal_damping = random.coin() ? 0 : random(1e-6, 1e-5);
    for (int i = 0; i < 2; ++i)
        rotor.discs.push_back(
            disc_at(random(0.1, 0.95), random(5, 30), random(0.1, 0.2), random(0.05, 0.19)));
    if (shaft) {
        rotor.shaft.segments[0].asymmetry = random(0.01, 0.3);
        rotor.shaft.segments[0].asymmetry_angle = random(0, 3);
    }
    if (!shaft || random.coin())
        rotor.anisotropies = {
            {"", rotor.discs[0].z, random(0.1, 0.5) * rotor.discs[0].Ip, random(0, 3)}};
    for (const double z : {random(0, 0.2), random(0.8, 1)}) {
        model::Bearing bearing =
            isotropic_bearing(z, std::pow(10, random(6, 7.5)), std::pow(10, random(2.5, 3.7)));
        model::BearingCoefficients &row = bearing.rows[0];
        if (random.coin()) {
            row.k(0, 1) = random(-0.02, 0.02) * row.k(0, 0);
            row.k(1, 0) = -row.k(0, 1);
        }
        attach_at_random(bearing, random, 0.3, 3);
        rotor.bearings.push_back(bearing);
    }
    scene.speeds = model::SpeedRange{0, random(500, 1200), 11};
    scene.response.gravity = g;
    return scene;
}

} // namespace whirl::tests
