#pragma once

#include "linalg/rational_curve.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::forced {

/// A local maximum of a quantity over the spin speed.
struct Top {
    std::size_t quantity = 0;
    double speed = 0;            ///< rad/s
    double value = 0;            ///< interpolated; infinite: a pole next to the real speeds
    std::optional<double> lower; ///< where it is 1/sqrt(2) of that below, rad/s; none: not reached
    std::optional<double> upper; ///< and above
};

/// Amplitudes of quantities over a range of speeds, and all their local maxima strictly inside: the
/// motion of the whole rotor, interpolated between the speeds at which it was solved for, those of
/// the maxima among them. Steps are a part of the distance to the nearest pole of the motion, the
/// scale on which it changes.
class CurvePeaks {
  public:
    /// Amplitude of a quantity from its numbers, and what it changes with these.
    struct Size {
        std::function<double(const Eigen::RowVectorXcd &numbers)> of;
        std::function<double(const Eigen::RowVectorXcd &numbers,
                             const Eigen::RowVectorXcd &changes)>
            change;
    };

    /// @param cuts   rad/s, ascending, at least two: what the motion follows is analytic between
    /// @param solve  a row of numbers a quantity; nothing where it has no limit
    /// @throws linalg::SolverError where nothing is solved between two cuts
    CurvePeaks(const std::vector<double> &cuts, const linalg::RationalCurve::Solve &solve,
               Size size);

    struct Sample {
        double speed = 0;
        Eigen::MatrixXcd numbers; ///< a row a quantity
        std::vector<double> values;
    };
    /// Ascending by quantity, then by speed.
    [[nodiscard]] const std::vector<Top> &tops() const { return _tops; }
    /// The speeds looked at, ascending: between two of them no quantity has a maximum that neither
    /// of them shows.
    [[nodiscard]] const std::vector<Sample> &samples() const { return _samples; }
    /// Those that a picture needs.
    [[nodiscard]] std::vector<Sample> drawn() const;
    /// Speeds between which the motion is not interpolated to what is accepted, rad/s: maxima can
    /// be missing.
    [[nodiscard]] std::vector<std::pair<double, double>> unsettled() const;

  private:
    std::vector<linalg::RationalCurve> _pieces;
    Size _size;
    std::vector<Sample> _samples;
    std::vector<Top> _tops;

    [[nodiscard]] std::size_t place_of(double speed) const;
    [[nodiscard]] const linalg::RationalCurve &piece_of(double speed) const {
        return _pieces[place_of(speed)];
    }
    [[nodiscard]] Sample sample(double speed) const;
    [[nodiscard]] double value(std::size_t quantity, double speed) const;
    [[nodiscard]] double slope(std::size_t quantity, double speed) const;
    void sample_piece(const linalg::RationalCurve &piece);
    void find();
    [[nodiscard]] bool confirmed();
    [[nodiscard]] Top top_about(std::size_t quantity, std::size_t middle) const;
    [[nodiscard]] std::optional<double> half_power(const Top &top, std::size_t start,
                                                   int direction) const;
};

} // namespace whirl::forced
