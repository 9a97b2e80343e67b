#pragma once

namespace whirl::closed_form {

/// D of two balls in balance, 2/E^2 - 1: real, negative beyond E = sqrt 2.
[[nodiscard]] inline double two_ball_second_harmonic(double capacity) {
    return 2.0 / (capacity * capacity) - 1.0;
}

} // namespace whirl::closed_form
