#pragma once

#include "linalg/eigenpair.h"

#include <Eigen/SparseCore>

#include <vector>

namespace whirl::stability {

/// Rayleigh's functional of Q(l) = l^2 M + l D + K: the root l of x^H Q(l) x = 0 for a vector x
/// that nearly solves Q(l) x = 0.
///
/// Each matrix is split into its symmetric and its skew part. At l = i w what conserves energy
/// (symmetric M and K, skew D) enters x^H Q x with real numbers, what feeds or drains it (symmetric
/// D, skew K) with imaginary ones. So Re l follows from the latter alone: the rounding of stiff
/// entries, which grows with the mesh, stays out of it, and an error e of x enters with
/// 2 |e^H A x|, A the part of Q(l) that is not Hermitian, and in the second order.
class RayleighFunctional {
  public:
    using Sparse = Eigen::SparseMatrix<double>;

    /// Where M and K are symmetric but for rounding: unknowns come in blocks of one size, the first
    /// `paired` of each in pairs (x, y), whose inertia is symmetric within a block, and whose
    /// stiffness where it joins x with x or y with y.
    struct Structure {
        int block = 0;
        int paired = 0;
    };
    RayleighFunctional(const Sparse &M, const Sparse &D, const Sparse &K, Structure structure);

    struct Root {
        std::complex<double> value; ///< l, 1/s
        double noise = 0;           ///< how far Re l can be off, 1/s; infinite: no such root
    };
    /// What the vector of a pair may have of another one's.
    struct Admixture {
        double share = 0;
        Eigen::VectorXcd vector; ///< largest modulus 1
    };
    /// The root next to the pair's value.
    /// @param vector_error  relative error of each entry of the vector, besides
    /// @param admixtures    of pairs so near that the vector may have more of them than that
    [[nodiscard]] Root root(const linalg::ComplexPair &pair, double vector_error,
                            const std::vector<Admixture> &admixtures) const;

  private:
    /// Entries (i, j) and (j, i), i <= j: symmetric + skew, symmetric - skew.
    struct Entry {
        int i = 0;
        int j = 0;
        double symmetric = 0;
        double skew = 0;
    };
    using Entries = std::vector<Entry>;
    Entries _M, _D, _K;

    [[nodiscard]] static Entries split(const Sparse &A);
    struct Form;
    [[nodiscard]] static Form form(const Entries &A, const Eigen::VectorXcd &x);
    [[nodiscard]] Eigen::VectorXcd lossy_part(std::complex<double> l,
                                              const Eigen::VectorXcd &x) const;
};

} // namespace whirl::stability
