#pragma once

#include "analyses/results.h"
#include "assembly/discretization.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::analyses {

/// Stations along a shaft at which orbits are looked at: the nodes and points between them.
class Stations {
  public:
    /// @param per_span  points inside each span beside its ends
    Stations(const assembly::Discretization &discretization, int per_span);

    /// Enough of them to judge the sense of whirl; fine meshes have enough nodes.
    [[nodiscard]] static Stations for_orbits(const assembly::Discretization &discretization);

    [[nodiscard]] const std::vector<double> &z() const { return _z; }

    /// Deflections at the stations from planar unknowns.
    [[nodiscard]] Eigen::VectorXcd deflections(const Eigen::VectorXcd &planar) const;

  private:
    std::vector<double> _z;
    std::vector<assembly::Combination> _rows;
};

/// Sense of whirl of orbits x, y at stations, x(t) = Re(x exp(i w t)), w > 0, against a spin of
/// this sign, and the share (weighted by squared radius) of the orbits that is forward.
struct OrbitSense {
    Whirl whirl = Whirl::mixed;
    double forward_fraction = 0.5;
};
[[nodiscard]] OrbitSense orbit_sense(const Eigen::VectorXcd &x, const Eigen::VectorXcd &y,
                                     double spin_speed);

/// Semi-axes of the ellipse x(t) = Re(x exp(i w t)), y likewise; the minor one is negative for an
/// orbit against the positive sense.
struct Ellipse {
    double major = 0;
    double minor = 0;
};
[[nodiscard]] Ellipse ellipse_of(std::complex<double> x, std::complex<double> y);

} // namespace whirl::analyses
