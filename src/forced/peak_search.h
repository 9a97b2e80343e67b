#pragma once

#include "forced/reduced_motion.h"

#include <cmath>
#include <optional>
#include <vector>

namespace whirl::forced {

/// A local maximum of a quantity over the spin speed.
struct Peak {
    std::size_t quantity = 0;
    double speed = 0;            ///< rad/s
    double value = 0;            ///< semi-major axis; infinite: a resonance without damping
    double phase = 0;            ///< of x, rad; NaN where the value is infinite
    std::optional<double> lower; ///< where it is 1/sqrt(2) of that below, rad/s; none: not reached
    std::optional<double> upper; ///< and above
    double width = 0;            ///< distance of the nearest pole from the real speeds, rad/s
    /// Relative error of the value where it is what is left of larger terms (Reading::cancelled);
    /// of peaks that were compared with the whole rotor also what its rounding hides.
    double rounding = 0;
};

/// A pole of the response.
struct Resonance {
    double speed = 0; ///< its real part, rad/s
    double width = 0; ///< its distance from the real speeds, rad/s

    /// As without damping: the response has no limit there.
    [[nodiscard]] bool undamped() const { return width < 1e-10 * std::abs(speed); }
};
/// Those between two speeds, and a little beyond, ascending.
[[nodiscard]] std::vector<Resonance> resonances_about(ReducedMotion &motion, double from,
                                                      double to);

/// Every local maximum of all quantities strictly between two speeds, on the reduced rotor.
///
/// A quantity changes over a speed on the scale of the distance to the nearest pole. It is looked
/// at in steps of a part of that distance, with its derivative: where that changes from growth to
/// decline a maximum is found as the root of the derivative. Half-power points are looked for a
/// little beyond the speeds asked for too. Speeds from 0 or up to 0, not on both sides of it.
class PeakSearch {
  public:
    PeakSearch(ReducedMotion &motion, double from, double to);

    /// Ascending by quantity, then by speed.
    [[nodiscard]] const std::vector<Peak> &peaks() const { return _peaks; }
    [[nodiscard]] const std::vector<Resonance> &resonances() const { return _resonances; }

    /// All quantities at one speed.
    struct Sample {
        double speed = 0; ///< rad/s
        int piece = 0;
        std::vector<double> value;     ///< semi-major axis
        std::vector<double> slope;     ///< what it changes per rad/s
        std::vector<double> phase;     ///< of x, rad
        std::vector<double> cancelled; ///< as in Reading
    };
    /// The speeds looked at, ascending: dense where resonances are sharp.
    [[nodiscard]] const std::vector<Sample> &samples() const { return _samples; }

  private:
    ReducedMotion &_motion;
    double _from, _to;         ///< where peaks count
    double _low, _high;        ///< where half-power points do
    std::vector<double> _cuts; ///< ends of the pieces
    std::vector<Sample> _samples;
    std::vector<Resonance> _resonances;
    std::vector<Peak> _peaks;

    void sample_piece(int piece);
    void sample_stretch(int piece, double from, double to,
                        const std::vector<std::complex<double>> &poles);
    [[nodiscard]] Sample sample(int piece, double speed) const;
    void find(std::size_t quantity);
    /// More than rounding: a curve that changes on the scale of the steps falls by far more in two.
    [[nodiscard]] bool stands_out(std::size_t left, std::size_t quantity) const;
    void peak_between(std::size_t quantity, std::size_t left);
    void endless_peak(std::size_t quantity, std::size_t left);
    /// The place of a maximum that the quick readings have, as the exact ones have it.
    [[nodiscard]] double corrected(double speed, std::size_t quantity) const;
    [[nodiscard]] std::optional<double> half_power(const Peak &peak, std::size_t start,
                                                   int direction) const;
    /// Of a quantity at a speed of the piece entered.
    [[nodiscard]] double major(double speed, std::size_t quantity) const {
        return _motion.quickly_at(speed, quantity).major();
    }
    [[nodiscard]] double slope(double speed, std::size_t quantity) const {
        return _motion.quickly_at(speed, quantity).major_slope();
    }
    /// Lowest place of a valley between two samples of one piece.
    [[nodiscard]] double bottom_between(const Sample &a, const Sample &b,
                                        std::size_t quantity) const;
    [[nodiscard]] double width_at(double speed) const;
    /// Enters the piece of a sample.
    void enter(int piece) const;
};

} // namespace whirl::forced
