#pragma once

#include "linalg/matrix.h"
#include "linalg/sparse_factor.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <complex>
#include <utility>
#include <vector>

namespace whirl::linalg {

/// M q'' + (C + W G) q' + (K + W Kc + W^2 Kss) q = f at the spin speed W, real, all matrices of one
/// size.
struct HarmonicTerms {
    Matrix M, C, G, K, Kc;
    Matrix Kss{}; ///< none: zero
};

/// Solves A q = f, A = K + W Kc + W^2 Kss - w^2 M + i w (C + W G), for many spin speeds W and
/// frequencies w: the steady motion Re(q exp(i w t)) of HarmonicTerms under Re(f exp(i w t)).
///
/// The pattern of nonzeros is that of all speeds together, so that KLU (SuiteSparse) orders and
/// analyses it once. Unknowns in pairs (x, y) are solved for as (x + i y)/2 and (x - i y)/2, the
/// parts that turn with and against the rotation: what is the same from every direction, as most of
/// a rotor, does not couple these, and half of the entries are left.
class HarmonicSolver {
  public:
    using Entries = std::vector<Eigen::Triplet<std::complex<double>>>;

    /// @param pairs    the unknowns are pairs (x, y)
    /// @param changes  where solve() may be given what A is beside the terms
    /// @param smooth   solutions are refined with long digits until they change no more: those at
    ///                 neighbouring speeds are on a smooth curve, for twice the time
    explicit HarmonicSolver(const HarmonicTerms &terms, bool pairs = false,
                            const Entries &changes = {}, bool smooth = false);

    /// Complex displacements, one column for each column of forces.
    /// @param spin, frequency  W and w, rad/s
    /// @param forces           one load case a column
    /// @param changes          to be added to A
    /// @throws SolverError where A is singular or the residual exceeds 1e-8: the largest |f - A q|
    ///         over the largest |A| |q| + |f|.
    [[nodiscard]] Eigen::MatrixXcd solve(double spin, double frequency,
                                         const Eigen::MatrixXcd &forces,
                                         const Entries &changes = {});
    /// What turns with the rotor: w = W.
    [[nodiscard]] Eigen::MatrixXcd solve(double speed, const Eigen::MatrixXcd &forces) {
        return solve(speed, speed, forces);
    }

    /// Estimated relative error of a solution with the A of the last one by rounding of the
    /// entries of A, in comparable unknowns (unit_scales.h); large where A is singular (an undamped
    /// resonance).
    [[nodiscard]] double rounding(const Eigen::VectorXcd &forces,
                                  const Eigen::VectorXcd &displacements) const;

    /// Relative distance of the last smooth solution from the exact one of the matrices as they are
    /// stored: it changes irregularly from speed to speed. (rounding() estimates what the rounding
    /// of the stored entries does; that changes smoothly with the speed.)
    [[nodiscard]] double noise() const { return _noise; }

    /// |q|^T |A| |q| with the A of the last solution, |A| the sum of the moduli of the terms.
    [[nodiscard]] double absolute_form(const Eigen::VectorXcd &displacements) const;

    /// Nothing takes energy out or feeds it in.
    [[nodiscard]] bool conserves() const;

    /// Complex unknowns.
    [[nodiscard]] int size() const { return static_cast<int>(_scales.size()); }

  private:
    using Sparse = Eigen::SparseMatrix<std::complex<double>>;
    enum Factor {
        one,
        spin_once,
        spin_squared,
        minus_frequency_squared,
        i_frequency,
        i_frequency_spin,
        factor_count
    };

    bool _pairs, _smooth;
    Eigen::VectorXd _scales; ///< of the unknowns, powers of two, alike in a pair
    /// Entries of a term that are not zero, scaled, by their places among those of A.
    struct Term {
        std::vector<std::pair<Eigen::Index, double>> real, imaginary;
        [[nodiscard]] bool zero() const { return real.empty() && imaginary.empty(); }
    };
    std::array<Term, factor_count> _terms;
    Sparse _A;
    /// Real and imaginary parts of its entries with the digits that their sums lose: short elements
    /// and stiff discs are stiffer than the rotor by many powers of ten, and motions of it as a
    /// whole would be off by that times 1e-16, by something else at every speed.
    Eigen::ArrayX<long double> _real, _imaginary;
    std::array<long double, factor_count> _factors{}; ///< of the terms in A
    Entries _added;                                   ///< what else is in A, as given
    Sparse _changes;                                  ///< the same, of the unknowns solved for
    bool _factorized = false;                         ///< this A is
    double _noise = 0;                                ///< of the last solution
    mutable Sparse _sizes; ///< the moduli of all summands of A; without entries: not asked for
    SparseFactor<std::complex<double>> _lu{true};

    /// Of a matrix over the given unknowns: over those solved for, scaled.
    [[nodiscard]] Sparse solved_for(const Entries &entries) const;
    /// Of scaled displacements or forces in pairs the parts with and against the rotation.
    [[nodiscard]] Eigen::MatrixXcd parts_of(Eigen::MatrixXcd scaled) const;
    [[nodiscard]] Eigen::MatrixXcd pairs_of(Eigen::MatrixXcd parts) const;
    /// A as it is, with its factors, where it is asked for again.
    void set(double spin, double frequency, const Entries &changes);
    [[nodiscard]] const Sparse &sizes() const;
    /// Largest |f - A q| over the largest |A| |q| + |f| of the columns; infinite where A is
    /// singular.
    [[nodiscard]] double solved(const Eigen::MatrixXcd &f, Eigen::MatrixXcd &q);
    /// Steps of refinement, until they do not get less.
    /// @param rest  f - A q
    /// @returns     what is left, relative
    [[nodiscard]] double refine(const Eigen::Ref<const Eigen::VectorXcd> &f, Eigen::MatrixXcd &q,
                                Eigen::Index column, const Eigen::VectorXcd &rest);
    /// f - A q, summed up with these digits.
    [[nodiscard]] Eigen::VectorXcd rest(const Eigen::Ref<const Eigen::VectorXcd> &f,
                                        const Eigen::Ref<const Eigen::VectorXcd> &q) const;
    [[nodiscard]] Eigen::VectorXcd sizes_of(const Eigen::VectorXcd &f,
                                            const Eigen::VectorXcd &q) const;
};

} // namespace whirl::linalg
