#pragma once

#include "forced/curve_peaks.h"
#include "forced/response_error.h"

#include <array>
#include <vector>

namespace whirl::forced {

/// Of a peak, relative.
struct PeakErrors {
    double value = 0;
    double speed = 0;
};

/// How far peaks are from those of the finer rotor of ResponseError. Not the difference at one
/// speed, which is large beside a sharp resonance that moved a little: on both rotors the motion is
/// continued from three speeds at the resonance, and peak is compared with peak.
class PeakError {
  public:
    PeakError(const assembly::Discretization &coarse, results::Form form,
              const std::vector<Quantity> &quantities, const Drive &drive = {});

    /// Errors of peaks of the coarse rotor's curves; NaN where the finer rotor's peak was not
    /// found.
    [[nodiscard]] std::vector<PeakErrors> of(const std::vector<Peak> &peaks,
                                             const CurvePeaks &curves);

  private:
    const std::vector<Quantity> &_quantities;
    ResponseError _finer;

    /// Of all quantities of the finer rotor, one width apart.
    std::array<std::vector<Phasor>, 3> _motions;
    double _middle = 0, _width = 0;

    void solve_about(double middle, double width);
    [[nodiscard]] PeakErrors of(const Peak &peak, double middle, double width,
                                const CurvePeaks &curves);
};

} // namespace whirl::forced
