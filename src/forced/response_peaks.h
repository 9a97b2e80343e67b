#pragma once

#include "forced/peak_error.h"
#include "forced/peak_search.h"

#include <vector>

namespace whirl::forced {

/// How peaks are looked for.
struct PeakOptions {
    Drive drive;
    bool with_errors = true; ///< those by the elements
    bool reduction = true;   ///< false: on all unknowns from the beginning
};

/// Peaks as of the whole rotor.
struct CertifiedPeaks {
    std::vector<Peak> peaks;        ///< ascending by quantity, then by speed
    std::vector<PeakErrors> errors; ///< by the elements, of each; empty: not asked for
    /// Largest relative difference of a quantity of the reduced rotor from that of the whole rotor,
    /// at and beside every resonance and at the peaks; 0 where nothing was left out.
    double reduction_error = 0;
    int shapes = 0; ///< in one plane
    /// The curves between, on the reduced rotor: enough speeds to draw every peak.
    std::vector<PeakSearch::Sample> curve;
};

/// Speeds at which peaks are compared with the whole rotor, rad/s, ascending: of every finite peak
/// one within a tenth of its width, those of several quantities at one resonance together.
[[nodiscard]] std::vector<double> compared_speeds(std::vector<Peak> peaks);

/// Peaks between two speeds of one sign (rad/s) under the imbalances of the rotor, or of its motion
/// at twice the spin speed under its weight (rotating form), by the reduced rotor: it takes in the
/// motion of the whole rotor wherever the two differ, until they agree to 1e-9 at every resonance
/// and half the width of the peak beside it, and at the peaks themselves.
///
/// @param quantities  what is looked at
/// @throws linalg::SolverError where the poles of the response are not found
[[nodiscard]] CertifiedPeaks response_peaks(const assembly::Discretization &discretization,
                                            results::Form form,
                                            const std::vector<Quantity> &quantities, double from,
                                            double to, const PeakOptions &options = {});

} // namespace whirl::forced
