#pragma once

#include "modes/following/eigenpair_refinement.h"
#include "modes/following/symmetric_problem.h"

#include <map>
#include <optional>
#include <vector>

namespace whirl::modes {

/// Eigenpairs of one speed that are followed from others.
struct FollowedSpeed {
    double speed = 0;                 ///< rad/s
    std::vector<SymmetricPair> pairs; ///< in the same order at all speeds of one continuation
    double radius = 0;                ///< all eigenvalues of less modulus are among them, 1/s
    bool counted = false;             ///< they were counted, or found by a route that does

    [[nodiscard]] int within(double radius) const;
};

struct Guess {
    SymmetricPair pair;           ///< value and vector
    const SymmetricPair *nearest; ///< the pair at the speed nearest to it among those it is made of
};

/// One of the pairs at a speed by a polynomial through those of the speeds nearest to it.
/// @param known  by speed, at least one
[[nodiscard]] Guess guess(const std::map<double, FollowedSpeed> &known, double speed,
                          std::size_t i);

/// Of pairs solved at a speed the one that a guess there means, which is taken from them; else the
/// guess.
[[nodiscard]] SymmetricPair taken_for(SymmetricPair &guess, std::vector<SymmetricPair> &solved);

/// A pair whose vector has the sign of a guess of it.
void carry_sign(const SymmetricPair &guess, SymmetricPair &pair);

/// Guesses of the pairs at a speed, and what becomes of them.
struct GuessedSpeed {
    double speed;
    std::vector<SymmetricPair> pairs;
    std::vector<const SymmetricPair *> nearest{}; ///< each at the nearest speed known
    std::vector<bool> grouped{};                  ///< may turn away from its guess
    bool settled = true;
};

/// Pairs from guesses at one speed, those refined before as they are; none where one does not
/// settle, turns far away from its guess, or becomes another one. Real eigenvalues of a real
/// problem stay real, of two conjugates the upper one is meant.
/// @param slowest  so many of those that whirl are asked for; others are only counted
[[nodiscard]] std::optional<std::vector<SymmetricPair>>
pairs_near(const SymmetricProblem &problem, double speed, std::vector<SymmetricPair> guesses,
           int slowest);

/// The same of guesses at some speeds, which may be mixed where eigenvalues nearly meet. `mixed`
/// are those that have turned far from the pair at the nearest speed known.
void settle_guesses(const SymmetricProblem &problem, std::vector<GuessedSpeed> &speeds,
                    int slowest);

/// Two pairs have become one.
[[nodiscard]] bool coincide(const std::vector<SymmetricPair> &pairs);

/// A single pair at a speed, told from others by that it is the same motion as its guess.
struct SinglePair {
    double speed;
    SymmetricPair pair;           ///< a guess
    const SymmetricPair *nearest; ///< at the nearest speed known
    double distance;              ///< from the others (distance_from_others)
    bool settled = false;
};
void settle_single(const SymmetricProblem &problem, std::vector<SinglePair> &pairs);

/// The eigenpair nearest a real number, of two conjugates the upper one.
[[nodiscard]] SymmetricPair nearest_upper(const SymmetricProblem &problem, double speed,
                                          double value);

} // namespace whirl::modes
