#pragma once

#include "assembly/discretization.h"
#include "assembly/system.h"
#include "balancers/linear_element.h"
#include "linalg/matrix.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace whirl::periodic {

/// A rotor in axes that turn with it, on supports that differ between their directions and so turn
/// backwards there, twice a revolution:
///
///     M q'' + D q' + K q + P [Kt(t) P^T q + Ct(t) P^T q'] = 0,   period pi / |speed|,
///
/// n real unknowns, scaled to be of one size; the supports act on few places, the m columns of P.
class System {
  public:
    /// @param bearing_speed  rad/s, of the bearings' coefficients
    /// @param balancers      at their balanced positions
    /// @param shapes         N x r planar shapes to reduce the rotor to, or none
    System(const assembly::Discretization &discretization, double bearing_speed,
           const std::vector<balancers::BalancerElement> &balancers, const Eigen::MatrixXd *shapes);

    /// Of the bearings what is the same from every direction.
    struct Steady {
        Eigen::MatrixXd M, D, K; ///< n x n
    };
    [[nodiscard]] Steady steady(double speed) const;

    /// Of the bearings the rest, [Kt Ct], m x 2m; Kt alone, m x m, where their damping is the same
    /// from every direction.
    /// @param angle  2 * speed * t, rad
    [[nodiscard]] Eigen::MatrixXd turning(double speed, double angle) const;

    /// Nothing damps or drives: D skew, all stiffness symmetric, no damping that turns.
    [[nodiscard]] bool conserves(double speed) const;

    [[nodiscard]] int size() const { return static_cast<int>(_M.rows()); }
    [[nodiscard]] const Eigen::MatrixXd &places() const { return _places; } ///< P, n x m
    /// Unknowns (or amplitudes of the shapes) over those here.
    [[nodiscard]] const Eigen::VectorXd &scales() const { return _scales; }

    /// What (q, q') are as displacements and rates of all unknowns, entries made comparable.
    [[nodiscard]] Eigen::VectorXcd whole(const Eigen::VectorXcd &shape, double speed) const;

  private:
    Eigen::MatrixXd _unknowns; ///< all unknowns, N x n
    Eigen::VectorXd _root_K_whole, _root_M_whole;
    Eigen::VectorXd _scales;
    Eigen::MatrixXd _M, _C, _Cs, _K, _Ks, _Kss;
    Eigen::MatrixXd _places;
    struct Pair {
        Eigen::MatrixXd cosine, sine;
    };
    Pair _periodic_C, _periodic_K, _periodic_Ks;

    void scale(const Eigen::VectorXd &unknowns);
};

/// The System of one rotor, kept while the speed does not change its bearings.
class KeptSystem {
  public:
    /// With the bearings of this speed, rad/s, where they depend on it; the rest as for System, and
    /// the same until forget().
    [[nodiscard]] const System &at(const assembly::Discretization &discretization, double speed,
                                   const std::vector<balancers::BalancerElement> &balancers,
                                   const Eigen::MatrixXd *shapes);
    void forget() { _system.reset(); }

  private:
    std::unique_ptr<System> _system;
    double _speed = 0; ///< whose bearings it has, where they depend on it
};

} // namespace whirl::periodic
