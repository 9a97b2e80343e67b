#pragma once

#include "modes/following/symmetric_problem.h"
#include "modes/whirl_mode.h"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <limits>
#include <vector>

namespace whirl::modes {

/// An eigenpair of a symmetric problem at one speed, with what the vector makes of the matrices.
struct SymmetricPair {
    std::complex<double> value; ///< l, 1/s
    /// x; of refined pairs with x^T Q'(l) x = l, which leaves the sign: an analytic function of the
    /// speed where eigenvalues do not meet.
    Eigen::VectorXcd vector;
    std::complex<double> rate;       ///< dl/dspeed
    std::complex<double> derivative; ///< x^T Q'(l) x
    double error = 0;                ///< of l, relative: what the residual leaves
    double rounding = 0;             ///< of l, relative: what rounding of the entries can cause
    bool solved = false;             ///< by inverse iteration, not by a good guess alone
    bool counted_only = false;       ///< its error is that of a count
    /// Its motion is shared with a pair near by, so that it is not said which of them it is.
    bool mixed = false;
    bool either = false;  ///< the same, of pairs that are only counted
    bool refined = false; ///< else a guess
    /// Of the value of a guess, relative: how far its polynomial moved it at last.
    double doubt = std::numeric_limits<double>::infinity();
    /// dx/dspeed, but for a multiple of x; empty: not known (only the next factors give it
    /// cheaply).
    Eigen::VectorXcd turn;

    [[nodiscard]] bool whirls() const {
        return std::abs(value.imag()) > real_axis * std::abs(value);
    }
};

/// x^T Q(l) x = 0 at the l nearest the one given.
[[nodiscard]] std::complex<double> nearest_root(std::complex<double> xMx, std::complex<double> xDx,
                                                std::complex<double> xKx,
                                                std::complex<double> near);

/// Errors of values that are asked for, and of those that are only counted.
constexpr double enough_error = 1e-13;
constexpr double counted_error = 1e-8;

/// Finds eigenpairs of the problem from guesses, at one speed or at several.
class EigenpairRefinement {
  public:
    explicit EigenpairRefinement(const SymmetricProblem &problem) : _problem(problem) {}

    /// A guess, its speed, its distance from the others there (distance_from_others), and the error
    /// to come down to.
    struct Task {
        SymmetricPair *pair;
        double speed, distance, enough;
    };
    /// Rayleigh quotient iteration until the errors are small, cubic with a symmetric matrix: none
    /// where the guess is good enough. Four pairs at a time. Pairs that do not settle are left
    /// as guesses.
    void refine(std::vector<Task> tasks);

    /// Takes those of the guesses that are good enough as they are; others stay guesses.
    void take_good(std::vector<Task> tasks);

    /// The eigenpair nearest a value, from no vector.
    [[nodiscard]] SymmetricPair nearest(double speed, std::complex<double> value);

  private:
    using Complex = std::complex<double>;
    const SymmetricProblem &_problem;
    /// Four pairs; where there are fewer the last one stands in the other lanes too.
    linalg::Vector4 _x, _residual;
    linalg::Complex4 _value;
    linalg::Real4 _speed;
    SymmetricProblem::Products _of;
    linalg::Complex4 _xMx, _xDx, _xKx, _xD1x, _xK1x;
    const linalg::SymmetricFactors *_factors = nullptr; ///< of the last step

    static void sort(std::vector<Task> &tasks);
    void load(const std::vector<Task> &tasks, std::size_t first);
    void multiply();
    /// The Rayleigh quotients of the vectors next to their values, and their errors. With the same
    /// left and right vector the error is of second order, r^T Q(l)^-1 r / (x^T Q'(l) x) with the
    /// residual r = Q(l) x; (K + |l|^2 M)^-1 over the distance to the other eigenvalues takes the
    /// place of Q^-1.
    void settle(const std::vector<Task> &tasks, std::size_t first);
    [[nodiscard]] static bool rough(const std::vector<Task> &tasks, std::size_t first);
    void take_good(const std::vector<Task> &tasks, std::size_t first, bool looked_at,
                   std::vector<Task> &open);
    void inverse_step();
    [[nodiscard]] linalg::Vector4 turns() const;
    void advance(const std::vector<Task> &tasks, std::size_t first, bool at_last,
                 std::vector<Task> &open);
    /// The pairs in the lanes, none where a lane is left out.
    using InLanes = std::array<SymmetricPair *, linalg::lanes>;
    [[nodiscard]] linalg::Complex4 fill(const InLanes &pairs) const;
    void fill_turns(const InLanes &pairs, const linalg::Complex4 &scales) const;
};

/// From an eigenvalue to the two next ones among these: product of the distances relative to it,
/// each at most 1. (Next to two eigenvalues that nearly meet Q^-1 grows with both.)
[[nodiscard]] double distance_from_others(const std::vector<SymmetricPair> &pairs, std::size_t i);

/// The error to come down to of each: enough of the slowest, and of all without whirl.
[[nodiscard]] std::vector<double> enough_errors(const std::vector<SymmetricPair> &pairs,
                                                int slowest);

} // namespace whirl::modes
