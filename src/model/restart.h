#pragma once

#include <string>
#include <vector>

namespace whirl::model {

/// Where an interrupted motion in time stands: everything needed to go on.
struct Restart {
    std::string case_name;
    std::vector<double> signature; ///< sizes of the rotor, to know it again
    double time = 0;               ///< s
    double step = 0;               ///< the integrator would try next, s
    /// Planar unknowns of the whole rotor and their velocities: real parts, imaginary parts.
    std::vector<double> displacements, velocities;
    std::vector<double> angles, rates;       ///< free angles, rad, and their velocities, rad/s
    std::vector<double> spin;                ///< with a motor: angle and speed of the rotor
    std::vector<double> books;               ///< work, loss, impulse so far
    double energy = 0;                       ///< at the very start, J
    double momentum = 0;                     ///< at the very start, kg m2/s
    std::vector<double> largest;             ///< amplitudes since the last output, m
    std::vector<double> last;                ///< amplitudes of the end so far, m
    std::vector<std::vector<double>> series; ///< columns of the time series so far
    /// Of each station: largest amplitude so far, and when it was.
    std::vector<double> peaks, peak_times; ///< m, s
};

} // namespace whirl::model
