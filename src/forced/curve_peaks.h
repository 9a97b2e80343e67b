#pragma once

#include "linalg/rational_pieces.h"

#include <Eigen/Core>

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::forced {

/// A local maximum of a quantity over the spin speed.
struct Peak {
    std::size_t quantity = 0;
    double speed = 0;            ///< rad/s
    double value = 0;            ///< infinite: a resonance without damping
    double phase = 0;            ///< of the first number, rad; NaN where the value is infinite
    std::optional<double> lower; ///< where it is 1/sqrt(2) of that below, rad/s; none: not reached
    std::optional<double> upper; ///< and above
    double width = 0;            ///< distance of the nearest pole from the real speeds, rad/s
    /// Part of it that the curve falls by, on the side where less; at a bend not asked for.
    double fall = 1;
    double rounding = 0; ///< relative error of the value by rounding
    bool bend = false;   ///< at the row of a bearing table, where the slope jumps
};

/// Amplitudes of quantities over a range of speeds, and all their local maxima strictly inside.
///
/// The motion is interpolated by rational functions between the speeds at which it was solved for,
/// those of the maxima among them. It changes on the scale of the distance to its nearest pole: it
/// is looked at in steps of a part of that, with its derivative, and where that changes from growth
/// to decline a maximum is found as the root of the derivative. Half-power points are looked for
/// in all that is interpolated.
class CurvePeaks {
  public:
    /// Amplitude of a quantity from its numbers, and what it changes with these.
    struct Size {
        std::function<double(const Eigen::RowVectorXcd &numbers)> of;
        std::function<double(const Eigen::RowVectorXcd &numbers,
                             const Eigen::RowVectorXcd &changes)>
            change;
    };
    /// What is looked for, rad/s.
    struct Range {
        /// Ascending, at least two: what the motion follows is analytic between.
        std::vector<double> cuts;
        double from, to;        ///< where maxima count
        double enough;          ///< misfit of the motion at new speeds, relative
        std::size_t most = 150; ///< speeds solved for between two cuts
        int power = 0;          ///< of the speed, by which the motion has a limit at rest
        /// Part of a top: a dip as small is rounding or a flat curve, not a valley between peaks.
        double shallow = 1e-6;
    };

    /// @param solve  a row of numbers a quantity; nothing where it has no limit
    /// @throws linalg::SolverError where nothing is solved between two cuts
    CurvePeaks(Range range, const linalg::RationalCurve::Solve &solve, Size size);

    struct Sample {
        double speed = 0;
        Eigen::MatrixXcd numbers; ///< a row a quantity
        std::vector<double> values;
        std::vector<double> slopes; ///< per rad/s
    };
    /// Ascending by quantity, then by speed.
    [[nodiscard]] const std::vector<Peak> &peaks() const { return _peaks; }
    /// Those of the speeds looked at that a picture needs.
    [[nodiscard]] std::vector<Sample> drawn() const;
    /// Speeds at which peaks are compared with what is solved for, ascending: of every finite peak
    /// one within a tenth of its width, those of several quantities at one resonance together.
    [[nodiscard]] static std::vector<double> compared_speeds(std::vector<Peak> peaks);
    /// Speeds between which the motion is not interpolated to what is accepted, rad/s: maxima can
    /// be missing.
    [[nodiscard]] std::vector<std::pair<double, double>> unsettled() const {
        return _motion.unsettled();
    }
    /// The interpolated numbers.
    [[nodiscard]] Eigen::MatrixXcd at(double speed) const { return with_slope(speed).first; }

  private:
    Range _range;
    linalg::RationalCurve::Solve _solve;
    Size _size;
    linalg::RationalPieces _motion;
    /// A pole next to the real speeds.
    struct NextToReal {
        double speed = 0;                ///< rad/s
        std::vector<bool> without_limit; ///< of each quantity: it has none there
    };
    std::map<double, NextToReal> _next_to_real; ///< by the interpolated place, rad/s
    std::vector<Sample> _samples;               ///< at the cuts twice
    std::vector<Peak> _peaks;

    using WithSlope = std::pair<Eigen::MatrixXcd, Eigen::MatrixXcd>;
    [[nodiscard]] WithSlope with_slope(const linalg::RationalCurve &piece, double speed) const;
    [[nodiscard]] WithSlope with_slope(double speed) const {
        return with_slope(_motion.piece_at(speed), speed);
    }
    [[nodiscard]] Sample sample(const linalg::RationalCurve &piece, double speed) const;
    [[nodiscard]] std::pair<double, double> value_and_slope(std::size_t quantity,
                                                            double speed) const;
    void sample_piece(const linalg::RationalCurve &piece);
    void find(std::size_t quantity);
    [[nodiscard]] bool stands_out(std::size_t quantity, std::size_t left) const;
    [[nodiscard]] std::optional<Peak> peak_between(std::size_t quantity, std::size_t left);
    [[nodiscard]] double fall(std::size_t quantity, std::size_t left, double top) const;
    [[nodiscard]] Eigen::VectorXd solved_values(double speed) const;
    [[nodiscard]] const NextToReal &next_to_real(double pole);
    [[nodiscard]] std::optional<double> half_power(const Peak &peak, std::size_t start,
                                                   int direction) const;
};

} // namespace whirl::forced
