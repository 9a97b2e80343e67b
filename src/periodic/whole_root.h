#pragma once

#include "assembly/discretization.h"
#include "assembly/rotating_system.h"
#include "balancers/linear_element.h"
#include "linalg/sparse_factor.h"

#include <Eigen/Core>

#include <complex>
#include <map>
#include <optional>
#include <vector>

namespace whirl::periodic {

/// Single motions of a rotor with all its unknowns, by Hill's series in complex form:
///
///     q = exp(l t) sum_k q_k exp(2 i k speed t),  |k| <= N,
///
/// a sparse problem l^2 A2 + l A1 + A0 of size n (2N + 1), with as many harmonics as leave nothing
/// at its ends. It shares nothing with steps in time, which it confirms.
class WholeRotor {
  public:
    WholeRotor(const assembly::Discretization &discretization,
               std::vector<balancers::BalancerElement> balancers);

    struct Root {
        std::complex<double> value; ///< l, 1/s, on the strip that the guess is in
        Eigen::VectorXcd terms;     ///< q_-N, ..., q_N
        Eigen::VectorXcd left;      ///< the same of the transposed problem, conjugate
        double noise = 0;           ///< how far rounding can move l, 1/s
    };
    /// The root next to a guess: inverse iteration with both vectors, and the quotient of them. At
    /// slow speeds aliases of all motions are next to it: terms of the motion identify the one that
    /// is meant.
    /// @param speed      not zero, rad/s
    /// @param frequency  that the motion is fastest at, rad/s: for the first N
    /// @param terms      q_-K, ..., q_K of the guess, a column each, any number of them, or none
    /// @returns nothing where it does not converge, or not to a motion with these terms; without
    ///          them nothing either where the largest term of such a motion lies beyond N = 80
    [[nodiscard]] std::optional<Root> next_to(double speed, std::complex<double> guess,
                                              double frequency,
                                              const Eigen::MatrixXcd &terms = {}) const;

    /// First-order change of a root of this rotor at one speed where it becomes another one of the
    /// same mesh, or turns at another speed, 1/s.
    [[nodiscard]] std::complex<double> change(const Root &root, double speed,
                                              const WholeRotor &other, double other_speed) const;
    /// Its derivative by the speed.
    [[nodiscard]] std::complex<double> slope(const Root &root, double speed) const;

    /// The steady motion under a load f exp(l t).
    struct Driven {
        Eigen::MatrixXcd terms; ///< q_-N, ..., q_N, a column each
        double rounding = 0;    ///< relative error that rounding of the entries can cause
    };
    /// The series of the motion under a load: with as many harmonics as leave nothing at its ends.
    /// @param exponent  l of the load, 1/s: 0 of what turns with the rotor, i speed of the weight
    /// @param load      f, over the unknowns in rotating axes, N
    /// @returns nothing at a resonance without damping, or where N = 80 is not enough
    [[nodiscard]] std::optional<Driven> driven(double speed, std::complex<double> exponent,
                                               const Eigen::VectorXcd &load) const;

  private:
    using Factor = linalg::SparseFactor<std::complex<double>>;
    const assembly::Discretization &_discretization;
    std::vector<balancers::BalancerElement> _balancers;
    bool _tables;

    /// Bearings as at one speed.
    struct Matrices {
        assembly::RotatingSystem rotating;
        assembly::PeriodicSupports turning;
    };
    Matrices _matrices; ///< with tables: not used
    /// Their pattern and order of elimination, by the number of harmonics.
    mutable std::map<int, Factor> _factors;
    mutable int _beyond = 4; ///< harmonics that the roots before needed beyond their frequency
    mutable int _driven_harmonics = 0; ///< that the motion under a load before needed
    [[nodiscard]] Matrices assembled(double bearing_speed) const;
    struct AtSpeed;
    class Series;
    class Iteration;
    [[nodiscard]] AtSpeed at(double speed) const;
};

} // namespace whirl::periodic
