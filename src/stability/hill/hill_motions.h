#pragma once

#include "model/errors.h"
#include "modes/rotating_spectrum.h"

#include <complex>
#include <map>
#include <memory>
#include <vector>

namespace whirl::stability {

/// The Hill series does not settle at a speed.
class NotSettled : public model::AnalysisFailure {
  public:
    using AnalysisFailure::AnalysisFailure;
};

/// Distance of two eigenvalues, each of which stands for its conjugate too and, in Hill's series,
/// for all its aliases i times `repeats` apart (0: there are none), 1/s.
[[nodiscard]] double apart(std::complex<double> a, std::complex<double> b, double repeats);

/// Free motions by Hill's series with as many harmonics as each speed needs.
///
/// Every motion has aliases 2 i speed apart; the series is cut where the motions that count, at the
/// alias next to zero, do not change any more: with one harmonic more each of the old ones has its
/// partner and each of the new ones too, to 1e-8 of the spin speed. A motion whose largest term has
/// the number k is seen next to zero with more than k harmonics only, so that the fast ones that
/// bearings drive set a least number.
class HillMotions {
  public:
    /// @param fewest  motions looked at, however fast they are
    /// @param least   harmonics to begin with
    HillMotions(const assembly::Discretization &discretization,
                std::vector<balancers::BalancerElement> balancers, int fewest, int least);

    struct Found {
        std::vector<linalg::ComplexPair> pairs; ///< Im >= 0, vectors over all terms of the series
        int harmonics = 0;
    };
    /// @throws NotSettled, linalg::SolverError
    [[nodiscard]] Found at(double speed) const;

    /// The most that any speed so far needed.
    [[nodiscard]] int harmonics() const { return _most; }
    [[nodiscard]] const modes::RotatingSpectrum &spectrum(double speed, int harmonics) const;

  private:
    const assembly::Discretization &_discretization;
    std::vector<balancers::BalancerElement> _balancers;
    int _fewest;
    bool _tables;
    int _limit; ///< harmonics that are tried at most
    mutable int _most;
    mutable int _last; ///< enough at the speed before
    mutable std::map<int, std::unique_ptr<modes::RotatingSpectrum>> _spectra;
    mutable double _spectra_speed = 0; ///< with tables: whose bearings they have

    struct Reach {
        double radius = 0; ///< modulus up to which aliases are looked for, 1/s
        int terms = 1;     ///< largest number of the largest term of a motion that counts
    };
    [[nodiscard]] Reach reach(double signed_speed) const;
};

} // namespace whirl::stability
