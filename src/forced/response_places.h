#pragma once

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "forced/response_peaks.h"
#include "model/case.h"
#include "model/sentence.h"
#include "results/formulation.h"
#include "results/response.h"

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace whirl::forced {

/// From this relative error by rounding on, an amplitude is one at an undamped resonance: without
/// limit, or not determined where nothing drives that mode.
inline constexpr double resonance_rounding = 1e-3;
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
inline constexpr double unlimited = std::numeric_limits<double>::infinity();

/// In which motion under the weight is solved: a shaft of two stiffnesses in rotating axes. Unequal
/// inertias alone do not move: what turns about an axis that stands still, u ~ exp(-i Omega t), has
/// u'' + Omega^2 u = 0.
[[nodiscard]] results::Form form_under_weight(const model::Rotor &rotor);

/// Those at which an amplitude is infinite.
[[nodiscard]] std::vector<double> speeds_without_limit(const std::vector<double> &speeds,
                                                       const std::vector<double> &amplitudes);

/// Nodes of the mesh with the names of what is attached there; the ends are always among them.
[[nodiscard]] std::map<int, std::string> attached_nodes(const assembly::Discretization &d);

/// Adds these nodes, the bearings and the probes with their places and names, without values.
void add_places(results::HarmonicMotion &motion, const assembly::Discretization &d,
                const std::map<int, std::string> &nodes);
void add_places(results::GravityResponse &response, const assembly::Discretization &d,
                const std::map<int, std::string> &nodes);

/// Direction of the major axis, from x towards y, (-pi/2, pi/2]; none for a circle: where its
/// direction is decided by rounding.
/// @param rounding  relative
[[nodiscard]] double inclination_of(const Phasor &motion, double rounding);

/// What a probe reads.
[[nodiscard]] Quantity quantity_of(const assembly::Discretization &d, const model::Probe &probe);

/// What peaks are looked for of, and where it is.
struct Watched {
    std::vector<Quantity> quantities;
    std::vector<results::ResponsePeak> places;

    void add(Quantity quantity, const char *of, double place, const std::string &name);
};
/// Nodes, then bearings.
[[nodiscard]] Watched watched(const assembly::Discretization &d,
                              const std::map<int, std::string> &nodes);

/// Adds samples to the curves, one for each quantity.
void add_curve(const std::vector<CurvePeaks::Sample> &samples, results::ResponseCurves &curves);

/// Says between which speeds (rad/s) peaks may be missing.
void note_missing(const std::vector<std::pair<double, double>> &ranges,
                  std::vector<model::Sentence> &notes);

/// Adds every peak strictly inside the range, and the curves: one for each quantity.
void add_peaks(std::vector<results::ResponsePeak> &peaks, results::ResponseCurves &curves,
               const assembly::Discretization &d, results::Form form, const Watched &all,
               const model::SpeedRange &range, const PeakOptions &options,
               std::vector<model::Sentence> &notes);

} // namespace whirl::forced
