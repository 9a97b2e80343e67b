#pragma once

#include "assembly/discretization.h"
#include "linalg/eigenpair.h"
#include "linalg/matrix.h"
#include "results/formulation.h"
#include "synchronous/linear_piece.h"

#include <vector>

namespace whirl::synchronous {

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
    bool counted = true;    ///< inertia counts agree
};

/// The symmetric synchronous problem: undamped rotors with symmetric stiffness. Its A is M -+ G
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

    /// The same with the bearings as they are at each root, and all roots up to `top` (rad/s).
    /// Between rows of bearing tables K is linear in W: a quadratic eigenproblem each.
    /// @throws linalg::SolverError
    [[nodiscard]] SynchronousRoots lowest(int wanted, double top) const;

  private:
    struct Passages {
        std::vector<CrossingPair> list; ///< ascending
        double complete_to = 0;         ///< rad/s
        bool counted = true;
    };
    const assembly::Discretization &_d;
    results::Form _form;
    bool _doubled = false; ///< every root twice
    linalg::Matrix _A;

    [[nodiscard]] linalg::Matrix stiffness(double bearing_speed) const;
    [[nodiscard]] int multiplicity() const { return _doubled ? 2 : 1; }
    [[nodiscard]] Passages constant(double bearing_speed, int wanted) const;
    [[nodiscard]] Passages about_a_shift(const linalg::Matrix &K, int wanted, int zeros) const;
    [[nodiscard]] Passages constant_up_to(double speed, int wanted) const;
    [[nodiscard]] Passages through_tables(const std::vector<double> &rows, int wanted,
                                          double top) const;
    [[nodiscard]] SynchronousRoots named(const Passages &found) const;
};

} // namespace whirl::synchronous
