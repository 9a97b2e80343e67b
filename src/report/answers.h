#pragma once

#include "report/common/csv.h"
#include "results/samples.h"

#include <string>
#include <vector>

namespace whirl::report {

/// An answer of many rotors in words: "critical forward 1".
[[nodiscard]] std::string answer_text(const results::SampledAnswer &answer, const Units &units);

/// Which answer it is, and the unit of its values.
[[nodiscard]] Columns<results::SampledAnswer> answer_names();
/// Why rotors have no answer. @param rotors  key of their numbers
[[nodiscard]] Columns<results::SampleFailure> failure_columns(const std::string &heading,
                                                              const std::string &rotors);
/// Of a file with a line a rotor: its answers, and why it has none.
void add_answers(std::vector<CsvList> &lists, const std::vector<results::SampledAnswer> &answers,
                 const std::vector<results::SampleFailure> &failures, int rotors,
                 const Units &units);

} // namespace whirl::report
