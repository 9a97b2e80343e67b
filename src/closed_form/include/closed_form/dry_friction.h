#pragma once

#include <complex>
#include <optional>
#include <utility>

namespace whirl::closed_form {

/// Equal balls in one race that resist rolling, on a rotor that turns at a constant speed with its
/// deflection w as one body: K w = U + m R (e^(i a_1) + ... + e^(i a_n)).
///
/// With the race's normal force m W^2 (R + Re w e^(-i a)) and friction up to f of it, a ball
/// stands where |Im w e^(-i a)| <= f (R + Re w e^(-i a)): N. van de Wouw, M. N. van den Heuvel,
/// H. Nijmeijer, J. A. van Rooij, Performance of an automatic ball balancer with dry friction,
/// International Journal of Bifurcation and Chaos 15 (2005) 65-82.
struct DryBalls {
    std::complex<double> K; ///< imbalance over the deflection that it makes, balls on board, kg;
                            ///< of the planar rotor k/W^2 - M + i c/W with the balls in M
    double mass = 0;        ///< m, of one ball, kg
    double radius = 0;      ///< R, of the path of the balls' centres, m
    double friction = 0;    ///< f, force along the race over normal force
    double imbalance = 0;   ///< U, kg m
    int n = 2;              ///< balls
};

/// Rest positions of two balls that hang together with balance: intervals in place of the points
/// without friction.
struct DryRest {
    /// Largest |w| over all of them, m: no more is left once the balls rest in one of them.
    double residual = 0;
    /// Angles of a ball from the direction of the imbalance, 0 to pi, between which it rests while
    /// the other one mirrors it, rad; about the balanced angle.
    double from = 0, to = 0;
};

/// None: the balls cannot balance (U > 2 m R), or friction holds them wherever the deflection is up
/// to the radius of the race.
[[nodiscard]] std::optional<DryRest> dry_rest(const DryBalls &balls);

/// Of two balls or more, a bound on |w| over all rest positions that hang together with balance, m,
/// whatever the direction of w: to first order in the friction f R/(s - f) with
///
///     s^2 = min over k > l >= 0 and k = l, k + l = n, and u = U/(m R), of
///           (u^2 - (k - l)^2)/(4 k l)                 u >= k - l, l > 0
///           1 - ((u + l)/k)^2                         u < k - l, k even
///           1 - ((u + l)^2 - 1)/(k^2 - 1)             u < k - l, k odd
///
/// None: the balls cannot balance (U > n m R), or balls on the line of the imbalance balance it, in
/// a position that holds with any friction, so that there is no bound of that kind up to R.
[[nodiscard]] std::optional<double> dry_bound(const DryBalls &balls);

/// Least and largest |p - e^(i b_1) - e^(i b_2)| with b_j within `half` of `centre` on the unit
/// circle.
struct Arc {
    double centre = 0, half = 0; ///< rad
};
[[nodiscard]] std::pair<double, double> distances(std::complex<double> p, Arc first, Arc second);

} // namespace whirl::closed_form
