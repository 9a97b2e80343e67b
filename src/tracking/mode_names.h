#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "tracking/line_names.h"

#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::tracking {

/// Modes that are to be named.
struct ModesToName {
    std::vector<double> speeds; ///< rad/s
    bool beyond_range;          ///< also at speeds beyond those of the case
    /// Which of a spectrum at one of these speeds; of the others a name may be missing.
    std::function<bool(const modes::Spectrum &, std::size_t place)> which;
    /// Spectra that may be solved beside the first one at each speed; where that does not suffice,
    /// there are no names. None: as many as it takes.
    std::optional<int> most_more = std::nullopt;
};

/// Names of the modes of a case at any speeds: those that the lines of its Campbell diagram have,
/// followed to these speeds. Each process computes them for itself.
class ModeNames {
  public:
    /// @param range   the speeds of the case
    /// @param modes   of its Campbell diagram
    /// @param solver  must outlive this
    /// @param follow  as in spectra_at
    /// @throws model::AnalysisFailure where modes are not found, or not with the spectra allowed.
    ModeNames(const modes::SpectrumSolver &solver, const model::SpeedRange &range, int modes,
              bool follow, const ModesToName &wanted);

    /// The spectrum at one of the speeds asked for; null where it is out of reach: beyond speeds
    /// of both signs, or of the other sign.
    [[nodiscard]] const modes::Spectrum *at(double speed) const;

    /// Name of a mode of that spectrum; empty where its line has none or is not sure.
    [[nodiscard]] std::string of(double speed, std::size_t place) const;

    /// What to look for among the modes at a speed.
    struct Sought {
        double speed;               ///< rad/s; of the speeds asked for one may be near instead
        std::complex<double> value; ///< the eigenvalue is next to this one at that speed
        double within;              ///< farthest distance, 1/s
        double clear;               ///< modes of other names are farther away by this factor
        std::function<bool(const modes::WhirlMode &)> qualifies;
    };
    /// Its name; empty where there is none, or where it is not clear.
    /// @param solved  of the speeds asked for: from there eigenvalues go on by their slopes
    [[nodiscard]] std::string nearest(double solved, const Sought &sought) const;

  private:
    const modes::SpectrumSolver *_solver;
    std::vector<double> _speeds;
    std::vector<modes::Spectrum> _spectra;
    std::vector<Rates> _rates;
    std::vector<std::vector<std::string>> _names; ///< of each mode at each speed

    /// A mode that may be the one sought.
    struct Candidate {
        double away; ///< from the value sought, 1/s
        std::string name;
        std::size_t place;
    };

    [[nodiscard]] std::optional<std::size_t> place_of(double speed) const;
    /// @param mode  that at this place of the k-th spectrum, or refined from it
    [[nodiscard]] double away(std::size_t k, std::size_t place, const modes::WhirlMode &mode,
                              const Sought &sought) const;
};

/// The names, or none where modes are not found.
[[nodiscard]] std::optional<ModeNames> mode_names(const modes::SpectrumSolver &solver,
                                                  const model::SpeedRange &range, int modes,
                                                  bool follow, const ModesToName &wanted);

/// Lines this near to i speed, in parts of it, are at resonance there: farther away none has an
/// amplification factor of 2.
inline constexpr double resonant = 0.25;

/// A mode this near.
[[nodiscard]] bool near_spin(const modes::Spectrum &spectrum, std::size_t place);

/// Names of the modes that are critical: at each speed the next one of its whirl to the synchronous
/// eigenvalue. Empty where two are as near.
[[nodiscard]] std::vector<std::string>
names_of_critical(const ModeNames &names,
                  const std::vector<results::CriticalSpeed> &critical_speeds);

} // namespace whirl::tracking
