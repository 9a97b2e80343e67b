#pragma once

#include "model/case.h"

#include <string>
#include <vector>

namespace whirl::properties {

/// A number of the reduced or followed rotor against the whole one, solved densely.
struct Certified {
    std::string what;
    int scene = 0;
    double speed = 0;    ///< rad/s
    double error = 0;    ///< true one, relative
    double stated = 0;   ///< by reduction, relative
    double rounding = 0; ///< of both, relative

    [[nodiscard]] bool holds() const { return error <= 2 * stated + rounding; }
};

/// A count of eigenvalues against the one of the whole rotor's dense ones.
struct Counted {
    std::string what;
    int scene = 0;
    double speed = 0; ///< rad/s
    int counted = 0, dense = 0;
};

struct Findings {
    std::vector<Certified> numbers;
    std::vector<Counted> counts;
};

/// random_scene() with damping in every bearing and few elements.
[[nodiscard]] model::Case damped_scene(int number);

/// Whirl speeds of `campbell` and how many there are up to the last of them; the number of growing
/// motions of `stability` and the fastest of them.
void check_eigenvalues(const model::Case &scene, int number, Findings &out);

/// The argument of the determinant: told apart or not, sets of pairs of which some are left out.
void check_winding(const model::Case &scene, int number, Findings &out);

/// Values at the peaks of the response.
void check_peaks(const model::Case &scene, int number, Findings &out);

} // namespace whirl::properties
