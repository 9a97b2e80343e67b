#pragma once

#include "modes/following/pair_guess.h"
#include "modes/following/symmetric_problem.h"

#include <complex>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::modes {

/// Eigenpairs found independently, to begin with.
struct StartingPairs {
    std::vector<std::pair<std::complex<double>, Eigen::VectorXcd>> whirls;
    std::vector<double> real; ///< eigenvalues without whirl
    double radius = 0;        ///< all of less modulus are given
    double speed = 0;         ///< at which they are, rad/s
};

/// Follows the slowest eigenpairs of a symmetric problem over the speeds of a sweep.
///
/// Where pairs are known at some speeds, polynomials through them (in the speed, entry by entry)
/// guess the pairs at others; each guess is refined with the full matrices until the residual
/// leaves nothing. That none is missing: eigenvalues are counted at the ends and at some speeds
/// between by the argument of the determinant (none_missing). From a speed where all within a
/// radius are known none can come in from beyond faster than eigenvalues move with speed: without
/// damping by less than twice the change of the speed, as Ip <= 2 Id (theory.md). So much smaller
/// is the radius at speeds that are not counted; where fewer modes than wanted are left in it,
/// there is a count.
class Continuation {
  public:
    using Start = std::function<StartingPairs(double speed, int wanted)>;

    /// @param problem         kept by reference
    /// @param discretization  for the largest Ip / Id
    /// @param undamped        of the same rotor without damping and what drives motions, to begin
    ///                        with those where they lead to all; may be empty
    Continuation(const SymmetricProblem &problem, const assembly::Discretization &discretization,
                 Start start, Start undamped = {});

    /// Solves at speeds that rise or fall. Speeds at which pairs could not be followed are left
    /// out: modes are then to be found otherwise.
    /// @param wanted  whirl modes at each
    void follow(const std::vector<double> &speeds, int wanted);

    /// Pairs at one of the speeds, or between two of them; none where they are not followed, or
    /// may be fewer than wanted.
    [[nodiscard]] const FollowedSpeed *at(double speed, int wanted);
    /// At a speed that was asked for before.
    [[nodiscard]] const FollowedSpeed *known(double speed) const;

    /// One of the pairs at a speed; not all that are needed to tell that none is missing.
    struct Single {
        double speed;
        std::size_t pair; ///< place among the pairs of the speeds beside it
    };
    /// None where it is not followed there, or is shared with another one.
    [[nodiscard]] std::vector<std::optional<SymmetricPair>>
    single(const std::vector<Single> &asked) const;

    [[nodiscard]] const SymmetricProblem &problem() const { return _problem; }

  private:
    struct Run {
        std::map<double, FollowedSpeed> at; ///< pairs in one order
        /// The same with fewer pairs, followed before, and the places of pairs there.
        std::map<double, FollowedSpeed> before;
        std::vector<std::optional<std::size_t>> places;
        std::map<double, FollowedSpeed> tried; ///< where the order was not clear from afar
    };
    const SymmetricProblem &_problem;
    Start _start, _undamped;
    double _fastest; ///< change of an eigenvalue in units of that of the speed
    double _creep;   ///< s, of internal damping: the same for each 1/s of the eigenvalue
    std::vector<Run> _runs, _before;
    int _wanted = 0;

    [[nodiscard]] std::optional<FollowedSpeed> begin(double speed, int wanted) const;
    [[nodiscard]] std::optional<FollowedSpeed> from_undamped(double speed, int wanted) const;
    [[nodiscard]] std::optional<FollowedSpeed> refined(const StartingPairs &found, double speed,
                                                       int wanted) const;
    [[nodiscard]] static GuessedSpeed guessed(Run &run, double speed);
    [[nodiscard]] std::vector<std::optional<FollowedSpeed>>
    steps(Run &run, const std::vector<double> &speeds) const;
    [[nodiscard]] std::optional<FollowedSpeed> step(Run &run, double speed) const;
    [[nodiscard]] Run joining(const FollowedSpeed &start);
    std::size_t run_from(const std::vector<double> &speeds, std::size_t first, int wanted);
    [[nodiscard]] bool bridged(Run &run, double from, double to, int depth) const;
    void fill(Run &run, const std::vector<double> &speeds,
              const std::vector<std::size_t> &solved) const;
    [[nodiscard]] std::size_t complete(Run &run, const std::vector<double> &speeds,
                                       std::size_t first, std::size_t last, int wanted) const;
    [[nodiscard]] const FollowedSpeed *between(Run &run, double speed);
    [[nodiscard]] bool covered(const FollowedSpeed &counted, FollowedSpeed &at, int wanted) const;
    [[nodiscard]] bool count(const FollowedSpeed &counted, FollowedSpeed &at, int wanted) const;
};

/// Whether none of the eigenvalues within `radius_b` is missing at the second speed, where none
/// within `radius_a` is at the first: the argument of the ratio of both determinants around two
/// circles, with all eigenvalues known of both divided out, which turns slowly. (That of the first
/// speed may be smaller: circle_of_known.)
/// @param damped_a  false: the first are pairs of the rotor without damping
[[nodiscard]] bool none_missing(const SymmetricProblem &problem, const FollowedSpeed &a,
                                double radius_a, const FollowedSpeed &b, double radius_b,
                                bool damped_a = true);

/// A circle with at least `wanted` whirl modes in it, in the widest gap between moduli of pairs; 0
/// where there is none.
/// @param whirling  false: any pairs count
[[nodiscard]] double widest_gap(const FollowedSpeed &at, int wanted, bool whirling = true);

} // namespace whirl::modes
