#pragma once

#include "model/case.h"
#include "properties/random_rotors.h"

#include <string>
#include <vector>

namespace whirl::properties {

/// A printed number beside the true one.
struct ErrorPoint {
    std::string what; ///< "first speed", "middle speed", "interpolated speed", "critical"
    int rotor = 0;    ///< number of the drawn rotor
    Kind kind = Kind::isotropic;
    int order = 0;
    int mode = 0;        ///< from 1, in its class: forward, backward, or both together
    std::string sense;   ///< "forward", "backward" or "both"
    double speed = 0;    ///< rad/s
    double printed = 0;  ///< frequency or critical speed, rad/s
    double truth = 0;    ///< rad/s; NaN: the continuum has no such mode in the range searched
    double estimate = 0; ///< printed error, relative; NaN: none printed
    /// |printed - truth| / |printed| (damped: of the eigenvalue): what printed +- error means.
    double error = 0;
};

/// What became of one rotor: points, or why there are none.
struct ErrorPoints {
    std::vector<ErrorPoint> points;
    std::vector<std::string> refusals; ///< analyses that gave no answer, in their words
};

/// A rotor with its mesh and speeds, drawn from the seed `number`.
[[nodiscard]] model::Case random_case(int number);
[[nodiscard]] Kind kind_of(int number);

/// Whirl speeds of the `campbell.modes` lowest modes at the first and the middle speed and at one
/// in between, where the program interpolates its error, and critical speeds. True modes are
/// identified by their index: forward and backward apart where the bearings are isotropic.
[[nodiscard]] ErrorPoints undamped_points(const model::Case &scene, int number);

/// With order = "auto" and the tolerance of the case: whirl speeds at every speed.
[[nodiscard]] ErrorPoints automatic_points(const model::Case &scene, int number);

/// Damped eigenvalues at the first speed, followed from the undamped ones by their index, program
/// and continuum side by side.
[[nodiscard]] ErrorPoints damped_points(const model::Case &scene, int number);

} // namespace whirl::properties
