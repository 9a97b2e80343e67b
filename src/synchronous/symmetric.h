#pragma once

#include "assembly/discretization.h"
#include "linalg/eigenpair.h"
#include "linalg/matrix.h"
#include "results/formulation.h"

#include <vector>

namespace whirl::synchronous {

/// A real root w of a symmetric Q(w) x = 0. As w grows, an eigenvalue of Q passes zero there.
struct CrossingPair {
    linalg::RealPair pair;
    bool downwards = true; ///< x^T Q'(w) x < 0: one more negative eigenvalue above the root
};

/// A synchronous critical speed of a rotor without damping: W with (K(W) - W^2 A) x = 0.
struct SynchronousRoot {
    linalg::RealPair pair;
    /// Which eigenvalue of K(W) - W^2 A, in ascending order from 1, passes zero. With a subspace of
    /// the unknowns it is not smaller (Courant and Fischer), so that models of one rotor are
    /// compared root by root: the first passage of eigenvalue k with the first passage of k.
    int branch = 0;
};

struct SynchronousRoots {
    std::vector<SynchronousRoot> roots; ///< ascending
    double complete_to = 0; ///< every root below is among them, rad/s; infinity: there are no more
};

/// The symmetric synchronous problem of undamped rotors with symmetric stiffness on bearings that
/// do not change with speed. Its A is M -+ G
/// (planar, forward and backward), M + S (hyperbolic), [M G; -G M] (coupled bearings, real form of
/// the Hermitian M - i G: every root twice) or -Kss (rotating axes).
class SymmetricSynchronous {
  public:
    /// @param whirl_sign  planar: +1 forward, -1 backward
    SymmetricSynchronous(const assembly::Discretization &rotor, results::Form form,
                         int whirl_sign = 1);

    /// Such a form exists: no damping, no stiffness that is not symmetric, and, where bearings
    /// couple x and y, no free rigid motion.
    [[nodiscard]] static bool exists(const assembly::Discretization &rotor, results::Form form);

    /// At least `wanted` lowest, or all, with the bearings as at a speed (rad/s).
    /// @throws linalg::SolverError
    [[nodiscard]] SynchronousRoots at_bearing_speed(double speed, int wanted) const;

    /// The same, and all roots up to `top` (rad/s), of bearings without tables.
    /// @throws linalg::SolverError
    [[nodiscard]] SynchronousRoots lowest(int wanted, double top) const;

  private:
    struct Passages {
        std::vector<CrossingPair> list; ///< ascending
        double complete_to = 0;         ///< rad/s
    };
    const assembly::Discretization &_d;
    results::Form _form;
    bool _doubled = false; ///< every root twice
    linalg::Matrix _A;

    [[nodiscard]] linalg::Matrix stiffness(double bearing_speed) const;
    [[nodiscard]] int multiplicity() const { return _doubled ? 2 : 1; }
    [[nodiscard]] Passages constant(double bearing_speed, int wanted) const;
    [[nodiscard]] Passages about_a_shift(const linalg::Matrix &K, int wanted, int zeros) const;
    [[nodiscard]] SynchronousRoots named(const Passages &found) const;
};

} // namespace whirl::synchronous
