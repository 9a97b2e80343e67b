#pragma once

#include "stability/motions.h"
#include "stability/rotor_at_speeds.h"
#include "stability/unstable_bands.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::stability {

/// Unstable bands of one rotor. The search (band_search.h) asks for the motions at hundreds of
/// speeds: it is made with a rotor reduced to few planar shapes (range_shapes.h, PeriodicMotions).
/// Every end that it finds is then found again, as a root, with the whole rotor, and so is that the
/// rotor grows inside each band and nowhere between them. Where the whole rotor does not agree, or
/// is as small itself, the search is made with the whole rotor.
class BandFinder {
  public:
    /// @param shapes  planar shapes of a rotor that differs from this one in its balls or in an
    ///                anisotropy alone, to begin with; none: they are found when they are needed
    BandFinder(const StabilityModel &model, const balancers::Arrangement &arrangement,
               std::shared_ptr<const Eigen::MatrixXd> shapes = nullptr);
    /// @param like  of a rotor that differs in the arrangement of its balls or in some other
    ///              numbers: with its shapes to begin with
    BandFinder(const StabilityModel &model, const balancers::Arrangement &arrangement,
               const BandFinder &like);

    /// As it was given: a range that was cut since (model.from) is not in it.
    [[nodiscard]] const StabilityModel &model() const { return _model; }
    [[nodiscard]] const balancers::Arrangement &arrangement() const { return _arrangement; }
    /// The whole rotor.
    [[nodiscard]] const MotionSolver &solver() const { return _whole; }
    [[nodiscard]] const std::shared_ptr<const Eigen::MatrixXd> &shapes() const { return _shapes; }

    /// From here on the motions at these speeds are kept: several parts of an analysis ask for
    /// them.
    void keep(const std::vector<double> &speeds);
    /// Motions of the whole rotor.
    [[nodiscard]] std::vector<Motion> at(double speed) const;

    /// @param speeds  ascending, at least two
    [[nodiscard]] BandsFound find(const std::vector<double> &speeds);

    /// Planar shapes with which the eigenvalues at these speeds are those of the whole rotor; none
    /// where the whole rotor is as small.
    /// @param speeds  ascending
    [[nodiscard]] std::shared_ptr<const Eigen::MatrixXd>
    good_shapes(const std::vector<double> &speeds);

    /// More shapes, until the motions of another rotor of this mesh at these speeds are among those
    /// they describe, too. After good_shapes().
    /// @returns whether they do for it
    [[nodiscard]] bool enrich_for(const StabilityModel &other,
                                  const balancers::Arrangement &arrangement,
                                  const std::vector<double> &speeds);

  private:
    StabilityModel _model;
    balancers::Arrangement _arrangement;
    MotionSolver _whole;
    std::shared_ptr<const Eigen::MatrixXd> _shapes;
    bool _good = false; ///< they were found for the speeds asked for
    mutable std::map<double, std::vector<Motion>> _kept; ///< at their speeds, once asked for
    mutable int _asked = 0;                              ///< of these

    [[nodiscard]] std::shared_ptr<const Eigen::MatrixXd>
    found_shapes(const std::vector<double> &speeds) const;
};

} // namespace whirl::stability
