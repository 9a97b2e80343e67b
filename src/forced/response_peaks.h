#pragma once

#include "forced/curve_peaks.h"
#include "forced/forced_motion.h"
#include "forced/peak_error.h"

#include <utility>
#include <vector>

namespace whirl::forced {

/// How peaks are looked for.
struct PeakOptions {
    Drive drive;
    bool with_errors = true; ///< those by the elements
};

/// Peaks as of the whole rotor.
struct CertifiedPeaks {
    std::vector<Peak> peaks;        ///< ascending by quantity, then by speed
    std::vector<PeakErrors> errors; ///< by the elements, of each; empty: not asked for
    /// Largest relative difference of a quantity at the peaks, as it is interpolated, from that of
    /// the whole rotor.
    double interpolation_error = 0;
    /// Between these speeds peaks may be missing, rad/s (CurvePeaks::unsettled).
    std::vector<std::pair<double, double>> unsettled;
    /// The curves between: enough speeds to draw every peak.
    std::vector<CurvePeaks::Sample> curve;
};

/// Peaks between two speeds of one sign (rad/s) under the imbalances of the rotor, or of its motion
/// at twice the spin speed under its weight (rotating form): of the motion of the whole rotor,
/// solved for at few speeds and interpolated in between (SweptMotion, CurvePeaks) until the two
/// agree to 1e-9 at the peaks.
///
/// @param quantities  what is looked at
/// @throws linalg::SolverError where no motion is solved for
[[nodiscard]] CertifiedPeaks response_peaks(const assembly::Discretization &discretization,
                                            results::Form form,
                                            const std::vector<Quantity> &quantities, double from,
                                            double to, const PeakOptions &options = {});

} // namespace whirl::forced
