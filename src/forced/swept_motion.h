#pragma once

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "linalg/rational_pieces.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::forced {

/// Quantities of the steady motion of the whole rotor, at any place of a sweep.
///
/// Where bearings have tables of coefficients over the spin speed, the motion bends at each row,
/// and of a smooth curve there may be hundreds. So it is solved for with the means of these
/// coefficients instead, together with the motions under unit forces where the bearings act;
/// these are rational functions over the whole range, from few solutions. What the bearings are
/// beside their means is added exactly (Sherman, Morrison, Woodbury): a system of a few unknowns.
class SweptMotion {
  public:
    /// A guard against curves that are not what rational functions are for.
    static constexpr std::size_t most_solutions = 8000;

    /// @param from, to  rad/s, of one sign
    SweptMotion(const assembly::Discretization &discretization, results::Form form,
                const std::vector<Quantity> &quantities, const Drive &drive, double from,
                double to);
    SweptMotion(const SweptMotion &) = delete; // what is interpolated asks this one
    SweptMotion &operator=(const SweptMotion &) = delete;

    /// x and y of each quantity; nothing at a resonance without damping.
    [[nodiscard]] std::optional<linalg::RationalCurve::Values> at(double s);
    /// The same by the equations of the whole rotor.
    [[nodiscard]] std::optional<linalg::RationalCurve::Values> solved(double s);
    /// Relative error of each quantity of the last motion of the whole rotor that rounding of its
    /// matrices may cause.
    [[nodiscard]] Eigen::VectorXd rounding() const;
    /// The ends of the range, and the rows of bearing tables between: at() is analytic between.
    [[nodiscard]] std::vector<double> cuts() const;
    /// Of the speed, by which the motion has a limit at rest.
    [[nodiscard]] int power() const { return _drive.imbalances() ? 2 : 0; }
    /// Speeds between which what at() is made of is not interpolated to what is accepted, rad/s.
    [[nodiscard]] std::vector<std::pair<double, double>> unsettled() const;
    /// Solves at these places with the mean coefficients too.
    /// @returns whether that changed at()
    bool take_in(const std::vector<double> &places);

  private:
    const assembly::Discretization &_discretization;
    std::vector<Quantity> _quantities;
    Drive _drive;
    double _from, _to;
    ForcedMotion _whole;

    /// The rotor with the means of the tables.
    struct Mean {
        assembly::Discretization discretization;
        ForcedMotion motion;
        std::vector<int> acted_on; ///< unknowns that bearings with tables act on
        Eigen::MatrixXcd units;    ///< forces of 1 N there, a column each
        std::optional<linalg::RationalPieces> motions;

        Mean(const model::Rotor &rotor, int order, results::Form form, const Drive &drive);
    };
    std::unique_ptr<Mean> _mean; ///< none: no bearing has a table, or the spin speed is constant

    [[nodiscard]] model::Rotor with_means(const model::Rotor &rotor) const;
    /// Of all quantities, as they are solved for.
    struct Stretches {
        Eigen::MatrixXcd numbers; ///< x and y, or x: a row each
        Eigen::VectorXd sizes;    ///< of the terms that they are the sums of
        [[nodiscard]] Phasor of(Eigen::Index quantity) const {
            return {numbers(quantity, 0), numbers.cols() > 1 ? numbers(quantity, 1) : 0};
        }
    };
    [[nodiscard]] Stretches
    stretches(const Eigen::Ref<const Eigen::VectorXcd> &displacements) const;
    /// @param rounding  relative to these sizes
    [[nodiscard]] linalg::RationalCurve::Values values(const Stretches &stretches, double s,
                                                       double rounding) const;
    [[nodiscard]] std::optional<linalg::RationalCurve::Values> solved_with_means(double s);
    [[nodiscard]] Eigen::MatrixXcd beside_means(double s) const;
};

} // namespace whirl::forced
