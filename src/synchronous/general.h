#pragma once

#include "assembly/discretization.h"
#include "linalg/sparse_sum.h"
#include "results/formulation.h"
#include "synchronous/parts.h"

#include <Eigen/SparseCore>

namespace whirl::synchronous {

/// Q(l) = l^2 M + l D + K with complex matrices.
struct ComplexQuadratic {
    using Sparse = Eigen::SparseMatrix<std::complex<double>>;
    Sparse M, D, K;

    [[nodiscard]] Sparse at(std::complex<double> l) const {
        return linalg::sum(l * l, M, l, D, 1, K);
    }
    [[nodiscard]] Sparse slope(std::complex<double> l) const { return (2.0 * l) * M + D; }
};

/// Synchronous modes of any rotor with constant coefficients, l = i W: in the fixed frame
/// l^2 (M - iG) + l (C - i Kc) + K, solved in real arithmetic at twice the size; in rotating axes
/// K + W Ks + W^2 Kss, balls held, of the rotor without damping.
class GeneralSynchronous {
  public:
    /// @param form  general or rotating
    GeneralSynchronous(const assembly::Discretization &rotor, results::Form form)
        : _d(rotor), _form(form) {}

    /// Modes with Im l > `steepness` |Re l|: at least `wanted` and all up to Im l = `top`, where
    /// the model has so many; without the sense of whirl, bearings as they are at a speed (rad/s).
    /// @throws linalg::SolverError
    [[nodiscard]] SynchronousModes lowest(double bearing_speed, int wanted, double top,
                                          double steepness = 1) const;

    /// The problem itself.
    [[nodiscard]] ComplexQuadratic problem(double bearing_speed) const;

  private:
    const assembly::Discretization &_d;
    results::Form _form;
    mutable int _ask = 0; ///< eigenvalues that were enough at the last speed

    [[nodiscard]] SynchronousModes fixed(double bearing_speed, int wanted, double top,
                                         double steepness) const;
    [[nodiscard]] SynchronousModes rotating(double bearing_speed, int wanted, double top,
                                            double steepness) const;
};

} // namespace whirl::synchronous
