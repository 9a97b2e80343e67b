#pragma once

#include "stability/hill/hill_solver.h"
#include "stability/rotor_at_speeds.h"
#include "stability/unstable_bands.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::stability {

/// One rotor over a range of speeds, and few planar shapes that do for it there (range_shapes.h,
/// PeriodicMotions).
///
/// Of form hill its unstable bands too. The search (band_search.h) asks for the motions at hundreds
/// of speeds: it is made with the reduced rotor. Every end that it finds is then found again, as a
/// root, with the whole rotor, and so is that the rotor grows inside each band and nowhere between
/// them. Where the whole rotor does not agree, or is as small itself, the search is made with the
/// whole rotor. (The other forms: ends/stability_ends.h.)
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
    [[nodiscard]] const assembly::Discretization &discretization() const { return _discretization; }
    [[nodiscard]] const std::shared_ptr<const Eigen::MatrixXd> &shapes() const { return _shapes; }
    /// Real unknowns of the eigenproblem, the largest so far.
    [[nodiscard]] int unknowns() const;

    /// Motions of the whole rotor of form hill; none: another form.
    [[nodiscard]] const HillSolver *hill() const { return _hill ? &*_hill : nullptr; }
    /// From here on the motions at these speeds are kept: several parts of an analysis ask for
    /// them.
    void keep(const std::vector<double> &speeds);
    /// Those of hill().
    [[nodiscard]] std::vector<Motion> at(double speed) const;
    /// Of form hill.
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
    assembly::Discretization _discretization;
    std::optional<HillSolver> _hill;
    std::shared_ptr<const Eigen::MatrixXd> _shapes;
    bool _good = false; ///< they were found for the speeds asked for
    mutable std::map<double, std::vector<Motion>> _kept; ///< at their speeds, once asked for
    mutable int _asked = 0;                              ///< of these

    [[nodiscard]] std::shared_ptr<const Eigen::MatrixXd>
    found_shapes(const std::vector<double> &speeds) const;
};

} // namespace whirl::stability
