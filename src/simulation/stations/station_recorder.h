#pragma once

#include "model/restart.h"
#include "simulation/motion.h"
#include "simulation/stations/waterfall.h"

#include <array>
#include <utility>
#include <vector>

namespace whirl::simulation {

/// A local maximum of |w| inside of a step, as far as the step's polynomial knows it.
struct PeakCandidate {
    double value = 0;        ///< m
    double time = 0;         ///< s
    double from = 0, to = 0; ///< s: d|w|/dt passes zero between
    double start = 0;        ///< of the step, s
    Eigen::VectorXd state;   ///< there
};

/// Share of the time at the end over which amplitudes count as final.
inline constexpr double final_share = 0.025;

/// Deflections of balancers' planes and of stations between the ends of the steps of an
/// integration: polynomials of degree five through deflections, velocities and accelerations at
/// both ends, in the axes in which the motion is integrated. They miss h^6 / 46080 of a motion that
/// goes through h radians in a step as seen from these axes: 2e-5 at one radian, and nothing where
/// it goes round with them.
class StationRecorder {
  public:
    /// @param rows     of the deflections: of so many `planes`, then of the stations
    /// @param end      of the motion, s
    /// @param fastest  rad/s: spectra reach beyond a few times this
    /// @param axes     rad/s: speed at which the axes of the integration turn
    StationRecorder(const RotorMotion &motion, std::vector<reduction::Row> rows, std::size_t planes,
                    double end, double fastest, double axes);

    /// At the start, and wherever the rates have jumped.
    void begin(double t, const double *state);
    /// After every step.
    void step(double t, const double *state);

    /// The largest maxima of a station, the largest first; none where |w| was largest at an end.
    [[nodiscard]] const std::vector<PeakCandidate> &peaks(std::size_t station) const {
        return _peaks[station];
    }
    /// |w| at the time reached, m.
    [[nodiscard]] double last(std::size_t station) const;
    /// Largest |w| of each row since this was asked for last, both ends included, m.
    [[nodiscard]] std::vector<double> take_largest();
    /// Largest |w| of a row over the last 2.5 % of the time, m.
    [[nodiscard]] double final_amplitude(std::size_t row) const { return _final[row]; }
    [[nodiscard]] const WindowSamples &samples() const { return _samples; }

    /// What the restart of a run needs, and back. Spectra begin anew.
    void save(model::Restart &restart) const;
    void resume(const model::Restart &restart);
    /// Largest |w| of a station before the restart, m, and when that was, s.
    [[nodiscard]] std::pair<double, double> before(std::size_t station) const {
        return _before.empty() ? std::pair(0.0, 0.0) : _before[station];
    }

  private:
    /// Of one row at an end of a step.
    struct End {
        Eigen::Vector2d w, v, a;
    };
    /// w, in axes that turn from the step's beginning on, over the share of the step done:
    /// coefficients of the powers.
    using Polynomial = std::array<Eigen::Vector2d, 6>;

    const RotorMotion &_motion;
    std::vector<reduction::Row> _rows;
    std::size_t _planes;
    double _axes;       ///< rad/s
    double _part;       ///< s: within it |w| has one maximum at most
    double _final_from; ///< s
    double _time = 0;
    Eigen::VectorXd _state;
    std::vector<double> _rates;
    std::vector<End> _ends;
    std::vector<std::vector<PeakCandidate>> _peaks;
    std::vector<double> _largest, _final;           ///< of each row
    std::vector<std::pair<double, double>> _before; ///< empty: from the start
    WindowSamples _samples;

    [[nodiscard]] std::vector<End> ends_at(double t, const double *state);
    [[nodiscard]] End turned(const End &end, double angle) const;
    [[nodiscard]] static Polynomial polynomial(const End &from, const End &to, double length);
    void look_for_maxima(std::size_t row, const Polynomial &w, double to);
    void maximum(std::size_t row, double value, double time);
    void offer(std::size_t station, PeakCandidate candidate);
};

} // namespace whirl::simulation
