#pragma once

#include "linalg/matrix.h"

#include <Eigen/Core>

#include <memory>

namespace whirl::linalg {

/// Matrices of one harmonic problem, all of one size; nullptr stands for zero. Only read by the
/// constructor of HarmonicSolver.
struct HarmonicTerms {
    const Matrix *M = nullptr;
    const Matrix *C = nullptr;
    const Matrix *G = nullptr;
    const Matrix *K = nullptr;
    const Matrix *Kc = nullptr;
};

/// Complex displacements, one column for each column of forces, and how good they are.
struct HarmonicSolution {
    Eigen::MatrixXcd displacements;
    double residual = 0; ///< largest |f - A q| over the largest |A| |q| + |f|, of all columns
    double rounding = 0; ///< estimated relative error of q by rounding of the entries of A, in
                         ///< comparable unknowns (unit_scales.h); large where A is singular (an
                         ///< undamped resonance)
};

/// Solves A(s) q = f, A(s) = K + s Kc - s^2 M + i s (C + s G), for many speeds s: the steady
/// motion Re(q exp(i s t)) of M q'' + (C + s G) q' + (K + s Kc) q = Re(f exp(i s t)).
///
/// Real arithmetic: unknowns (Re q_j, Im q_j), blocks [Re a, -Im a; Im a, Re a]. The pattern of
/// nonzeros is that of all speeds together, so that KLU (SuiteSparse, under PETSc) orders and
/// analyses it once.
class HarmonicSolver {
  public:
    explicit HarmonicSolver(const HarmonicTerms &terms);
    ~HarmonicSolver();
    HarmonicSolver(const HarmonicSolver &) = delete;
    HarmonicSolver &operator=(const HarmonicSolver &) = delete;
    HarmonicSolver(HarmonicSolver &&) = delete;
    HarmonicSolver &operator=(HarmonicSolver &&) = delete;

    /// @param forces  one load case a column
    /// @throws SolverError where A(speed) is singular or the residual exceeds 1e-8.
    [[nodiscard]] HarmonicSolution solve(double speed, const Eigen::MatrixXcd &forces);

    /// Complex unknowns.
    [[nodiscard]] int size() const;

  private:
    struct Data;
    std::unique_ptr<Data> _data;

    void factorise(double speed);
};

} // namespace whirl::linalg
