#pragma once

#include "criterion/form.h"
#include "criterion/rotor.h"
#include "results/balance.h"

#include <functional>
#include <string>
#include <vector>

namespace whirl::criterion {

/// A scalar criterion over spin speed (rad/s); negative: balanced.
using SpeedFunction = std::function<double(double)>;

/// Bands of a criterion of an undamped rotor, whose sign changes nowhere but at the critical speeds
/// (a pole) and at those of the rotor pinned at the planes (a zero): signs are looked at between
/// them, so that no band is missed. A band begins at a critical speed, with two bending stiffnesses
/// at the highest of those near each other. Lower ends are critical speeds; upper ends are refined
/// as zeros of the criterion itself, beside the pinned critical speed. Bands narrower than 1e-8 of
/// the speed are left out.
///
/// @param critical,pinned  in (from, to), ascending
[[nodiscard]] std::vector<results::Interval> sharp_bands(const SpeedFunction &criterion,
                                                         const std::vector<double> &critical,
                                                         const std::vector<double> &pinned,
                                                         double from, double to);

/// Bands of any criterion whose sign changes nowhere but near these speeds (ascending): signs are
/// looked at between them, and ends found by bracketing. Bands narrower than 1e-8 of the speed are
/// left out.
[[nodiscard]] std::vector<results::Interval>
bands_between_changes(const SpeedFunction &criterion, const std::vector<double> &changes,
                      double from, double to);

/// A criterion, and how far rounding can make it off.
struct Judged {
    SpeedFunction value, rounding;
};

/// Errors of the ends of bands of a criterion, of each both, rad/s. Ends without a counterpart get
/// a note.
/// @param which  bands, in words
/// @param range  an end of which has no error
/// @param finer  the criterion of a finer model; none: the given one is exact
[[nodiscard]] std::vector<results::KnownErrors>
end_errors(const std::string &which, const std::vector<results::Interval> &bands,
           const results::Interval &range, const Judged &criterion, const SpeedFunction *finer,
           std::vector<results::Sentence> &notes);

/// Errors of the ends of all bands: each end is found once more on a finer model of the rotor
/// (finer_order, same mesh, twice the terms of a series), from the end on the given one; the error
/// is estimate_safety times the difference, and what finding it again on the given model changes
/// (rounding). Zero for an end of the range of speeds, none where the finer model has no such end.
/// Bands that only one of the two models has get a note.
/// @throws linalg::SolverError, model::AnalysisFailure
void judge_band_ends(const BalanceScene &scene, BalanceForm &form, results::BalanceResult &result);

} // namespace whirl::criterion
