#pragma once

#include "model/case.h"
#include "results/model_summary.h"
#include "synchronous/reduced.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// A number that a rotor answers with.
struct Answer {
    std::string key; ///< which one: the same for all rotors
    /// "critical", "peaks", "ends", "residual", "damping", "margins" or "operating".
    std::string of;
    std::string name;           ///< in front of `at` and behind it
    std::optional<double> at{}; ///< between the two: z of a place that has no name, or a speed; SI
    std::string behind{};
    model::Quantity quantity = model::Quantity::number;
    double value = 0;
    bool asked_for = true; ///< false: beyond the number of modes that the case wants
    double error = std::numeric_limits<double>::quiet_NaN(); ///< relative; NaN: not known
    model::Quantity at_quantity = model::Quantity::length;
};

/// How critical speeds and modes of many rotors are named.
enum class Naming {
    by_whirl, ///< "forward 2": the second of those of its whirl
    /// "2": the second of all, so that a curve over an entry is one without jumps wherever all
    /// rotors have as many, also where two change places or the whirl becomes a mixed one
    by_order
};

/// The numbers that [samples] or [sweep] asks for, of a case as it is and of rotors that differ a
/// little from it. By this process alone.
class Answers {
  public:
    /// Those of the case as it is, with their errors.
    /// @throws model::BadInput, model::AnalysisFailure as the commands do that list them
    Answers(const model::Case &scene, model::WantedAnswers wanted, Naming naming);

    [[nodiscard]] const std::vector<Answer> &nominal() const { return _nominal; }
    /// Of the case as it is.
    [[nodiscard]] const results::ModelSummary &model() const { return _model; }

    /// Of another rotor, without errors; where the order of the elements is to be found, with that
    /// of the case as it is.
    /// @throws model::AnalysisFailure, linalg::SolverError
    [[nodiscard]] std::vector<Answer> of(const model::Case &scene) const;

  private:
    model::WantedAnswers _wanted;
    Naming _naming;
    std::vector<Answer> _nominal;
    results::ModelSummary _model;
    std::optional<synchronous::SharedShapes> _shapes; ///< of the case as it is, for its samples
    int _critical_order = 1, _peaks_order = 1, _ends_order = 1, _motion_order = 1;
    int _damping_order = 1, _operating_order = 1;
};

} // namespace whirl::analyses
