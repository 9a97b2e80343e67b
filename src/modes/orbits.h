#pragma once

#include "assembly/discretization.h"
#include "results/whirl.h"

#include <Eigen/Core>

#include <optional>
#include <utility>
#include <vector>

namespace whirl::modes {

/// Stations along a shaft at which orbits are looked at, each with the mass it stands for.
class Stations {
  public:
    /// The nodes and `per_span` points inside each span, without masses: to draw shapes.
    Stations(const assembly::Discretization &discretization, int per_span);

    /// Some 120 of those, and each span at least its ends.
    [[nodiscard]] static Stations for_drawing(const assembly::Discretization &discretization);

    /// Points of a quadrature over the length of the shaft with the mass per length, and the discs
    /// and balancers. They follow from the rotor alone, not from its mesh: sums over them are
    /// kinetic energies of deflection, the same on every mesh that resolves the mode.
    [[nodiscard]] static Stations for_orbits(const assembly::Discretization &discretization);

    [[nodiscard]] const std::vector<double> &z() const { return _z; }
    /// kg; empty for stations that only draw.
    [[nodiscard]] const Eigen::VectorXd &masses() const { return _masses; }

    /// Deflections at the stations from planar unknowns.
    [[nodiscard]] Eigen::VectorXcd deflections(const Eigen::VectorXcd &planar) const;

    /// Of unknowns of both planes in turn, x and y of each.
    [[nodiscard]] std::pair<Eigen::VectorXcd, Eigen::VectorXcd>
    deflections_of_both(const Eigen::VectorXcd &planes) const;

    /// The same for amplitudes of shapes in the place of planar unknowns, to weigh motions only.
    [[nodiscard]] Stations over(const Eigen::MatrixXd &shapes) const;

    /// Sum of mass times squared deflection; entries of `planar` beyond the unknowns do not count.
    [[nodiscard]] double deflection_energy(const Eigen::VectorXcd &planar) const;

  private:
    std::vector<double> _z;
    std::vector<std::size_t> _first{0}; ///< of each station in the next two
    std::vector<int> _unknowns;
    std::vector<double> _values;
    Eigen::VectorXd _masses;
    Eigen::MatrixXd _weights; ///< of products of two amplitudes of shapes; empty without shapes

    Stations() = default;
    void add(double z, const assembly::Combination &row);
    void add(double z, const assembly::Combination &row, double mass, std::vector<double> &masses);
    void add_shaft(const assembly::Discretization &d, std::vector<double> &masses);
};

/// Sense of whirl of orbits x, y at stations, x(t) = Re(x exp(i w t)), w > 0, against a spin of
/// this sign.
///
/// An orbit is a circle of radius |f| with the spin and one of radius |b| against it. Where
/// |f| > |b| it whirls forward; |f|^2 - |b|^2 is its swept area over pi. The share is that of the
/// areas swept forward in all areas, weighted with the mass there.
struct OrbitSense {
    results::Whirl whirl = results::Whirl::mixed;
    double forward_fraction =
        0.5;                     ///< 1: forward everywhere; 1/2 as well where all orbits are lines
    std::optional<double> plane; ///< orbit_plane()
};
/// The plane through the axis in which a mode moves, where all its orbits are nearly straight lines
/// in one: at most a tenth as wide across it as along it (root mean square over the masses), as on
/// supports that differ between their directions. Its angle from x towards y, rad, from -80 to
/// 100 degrees, so that rounding turns no usual direction into its opposite.
[[nodiscard]] std::optional<double>
orbit_plane(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y, const Stations &stations);
[[nodiscard]] OrbitSense orbit_sense(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y,
                                     const Stations &stations, double spin_speed);

/// Semi-axes of the ellipse x(t) = Re(x exp(i w t)), y likewise; the minor one is negative for an
/// orbit against the positive sense.
struct Ellipse {
    double major = 0;
    double minor = 0;
};
[[nodiscard]] Ellipse ellipse_of(std::complex<double> x, std::complex<double> y);

} // namespace whirl::modes
