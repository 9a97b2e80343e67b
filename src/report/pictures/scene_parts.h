#pragma once

// Parts of the side view of a rotor.

#include "model/case.h"
#include "report/common/drawing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace whirl::report {

inline constexpr double sheet_width = 1080; ///< pixels
inline constexpr double sheet_side = 70;    ///< free space left and right, pixels

/// Places of the sheet for z and radii.
class Sheet {
  public:
    Sheet(const model::Case &scene, double largest_radius) {
        const double length = std::max(scene.rotor.shaft.length(), 1e-12);
        _z_scale = (sheet_width - 2 * sheet_side) / length;
        const double wanted = 130; // pixels for the largest radius, at most
        _r_scale = std::min(_z_scale, wanted / std::max(largest_radius, 1e-12));
        if (_r_scale < _z_scale) { // a thick rotor: shrink both
            _z_scale = _r_scale;
        } else if (largest_radius * _r_scale < 18) { // a slender one: enlarge the radii
            _enlarged = std::ceil(24 / std::max(largest_radius * _r_scale, 1e-9));
            _r_scale *= _enlarged;
        }
        _left = (sheet_width - length * _z_scale) / 2;
        radius = largest_radius * _r_scale;
    }
    [[nodiscard]] double across(double z) const { return _left + z * _z_scale; }
    [[nodiscard]] double pixels(double r) const { return r * _r_scale; }
    [[nodiscard]] double enlarged() const { return _enlarged; }

    double axis = 0;   ///< of the rotor, pixels from the top
    double radius = 0; ///< largest, pixels

  private:
    double _left = 0, _z_scale = 1, _r_scale = 1, _enlarged = 1;
};

/// As drawn: that of a disc by its mass and inertia is that of a thin homogeneous one, m.
[[nodiscard]] double disc_radius(const model::Disc &disc);

[[nodiscard]] DrawShape area(std::vector<DrawPoint> points, std::string fill, std::string stroke);
[[nodiscard]] DrawShape stroke(std::vector<DrawPoint> points, std::string colour, double width,
                               bool dashed = false);
[[nodiscard]] DrawShape circle(double x, double y, double radius, std::string fill,
                               std::string colour);

void draw_shaft(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft);
void draw_disc(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
               const model::Disc &disc);
/// Triangle below the shaft on a spring, on its pedestal where there is one, on hatched ground.
void draw_bearing(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                  const model::Bearing &bearing, double ground);
/// Teeth that face the shaft from above and below.
void draw_seal(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
               const model::Bearing &seal);
/// A box around all its parts, and these above and below the axis.
void draw_balancer(Drawing &drawing, const Sheet &sheet, const model::Balancer &balancer);
/// A lens across the shaft: the section's inertias differ between its two axes.
void draw_anisotropy(Drawing &drawing, const Sheet &sheet, const model::Anisotropy &anisotropy);
/// An arrow from above that ends at the surface of the shaft, whatever its direction.
void draw_probe(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                const model::Probe &probe);
/// The same of a harmonic force.
void draw_force(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                const model::HarmonicForce &force);

/// A dot at the surface of the shaft: above where it points to x, below where it points away.
void draw_imbalance(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                    const model::Imbalance &imbalance);
/// Where that dot is.
[[nodiscard]] DrawPoint imbalance_place(const Sheet &sheet, const model::Shaft &shaft,
                                        const model::Imbalance &imbalance);

} // namespace whirl::report
