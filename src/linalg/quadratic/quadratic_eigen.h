#pragma once

#include "linalg/eigenpair.h"
#include "linalg/matrix.h"

#include <limits>
#include <memory>
#include <vector>

namespace whirl::linalg {

/// Which way a quadratic eigenproblem was solved.
enum class QuadraticMethod {
    automatic, ///< toar, and dense where the wanted pairs are a large part or toar fails
    toar,      ///< SLEPc's two-level orthogonal Arnoldi, shift and invert
    dense      ///< all eigenvalues of the scaled companion matrix of the inverted problem
};

/// What to compute.
struct QuadraticOptions {
    int wanted = 8;        ///< eigenvalues nearest the shift, conjugates counted as one
    int fewest = 0;        ///< accept so many where double precision resolves no more; 0: `wanted`
    double shift = 0;      ///< real; Q(shift) must be regular, 1/s
    int zeros = 0;         ///< eigenvalues known to be zero: they need not be resolved
    double negligible = 0; ///< nor those of less modulus than this
    QuadraticMethod method = QuadraticMethod::automatic;
    /// Of the dense way: the distance from the shift up to which all are wanted. Complete that far,
    /// no other decomposition is tried for more.
    double enough = std::numeric_limits<double>::infinity();
    /// Left vectors are found, for a factorisation a pair; residual and rounding follow from them.
    /// Else the first is an estimate, and in the second the right vector stands for the left one.
    bool condition = false;
};

/// Eigenpairs with Im >= 0 found, ascending by distance from the shift.
struct QuadraticResult {
    std::vector<ComplexPair> pairs;
    QuadraticMethod method = QuadraticMethod::toar;
    double complete_radius = 0; ///< every eigenvalue nearer to the shift than this is in `pairs`
};

/// Eigenpairs of Q(l) x = (l^2 M + l D + K) x = 0 with real matrices.
///
/// Each pair carries its residual as a relative change of l: |P Q(l) x| / |P l Q'(l) x| with
/// P = Q(shift)^-1, which is independent of how stiff the stiffest spring is; with its left vector
/// y also |y^T Q(l) x| / |y^T l Q'(l) x|, the larger of both.
/// @throws SolverError where neither way resolves as many pairs as wanted, or Q(shift) is singular.
[[nodiscard]] QuadraticResult solve_quadratic(const Matrix &M, const Matrix &D, const Matrix &K,
                                              const QuadraticOptions &options);

/// The same for matrices that were combined anew for one speed: PETSc gets them only where the
/// problem is large enough for its solver.
[[nodiscard]] QuadraticResult solve_quadratic(const Eigen::SparseMatrix<double> &M,
                                              const Eigen::SparseMatrix<double> &D,
                                              const Eigen::SparseMatrix<double> &K,
                                              const QuadraticOptions &options);

/// The same problem at one shift for several other options: what all eigenvalues are by each dense
/// decomposition is found once.
class QuadraticSolver {
  public:
    /// @throws SolverError where Q(shift) is singular
    QuadraticSolver(const Eigen::SparseMatrix<double> &M, const Eigen::SparseMatrix<double> &D,
                    const Eigen::SparseMatrix<double> &K, double shift);
    ~QuadraticSolver();
    QuadraticSolver(const QuadraticSolver &) = delete;
    QuadraticSolver &operator=(const QuadraticSolver &) = delete;
    QuadraticSolver(QuadraticSolver &&) = delete;
    QuadraticSolver &operator=(QuadraticSolver &&) = delete;

    /// @param options  with the shift given above
    /// @throws SolverError as solve_quadratic()
    [[nodiscard]] QuadraticResult solve(const QuadraticOptions &options);

  private:
    struct Data;
    std::unique_ptr<Data> _data;
};

/// Residual and rounding of some of the pairs, found from a shift without it, as with `condition`.
void assess_condition(const Eigen::SparseMatrix<double> &M, const Eigen::SparseMatrix<double> &D,
                      const Eigen::SparseMatrix<double> &K, double shift,
                      std::vector<ComplexPair> &pairs);

} // namespace whirl::linalg
