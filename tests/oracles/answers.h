#pragma once

#include "oracles/case_rotor.h"

#include <functional>
#include <string>
#include <vector>

namespace whirl::oracles {

/// A number of a case's expected.json to be found anew.
struct Request {
    CaseRotor rotor; ///< with the settings of the check
    std::string command;
    std::string path;
    std::size_t wanted = 0; ///< how many values
    double multiple = 1;    ///< of the spin speed, for crossings
    double node = 0;        ///< z of a response, m
};

/// What an oracle has found.
struct Answer {
    std::string oracle;             ///< which one
    std::vector<Real> values;       ///< SI and radians
    std::string text;               ///< where the answer is a word
    std::vector<std::string> whirl; ///< of critical speeds, where known
};

/// By the oracle for the command and what it asks for. Throws std::runtime_error with the reason
/// where none can answer.
[[nodiscard]] Answer answer(const Request &request);

// One for each command.
[[nodiscard]] Answer answer_campbell(const Request &request);
[[nodiscard]] Answer answer_critical(const Request &request);
[[nodiscard]] Answer answer_response(const Request &request);
[[nodiscard]] Answer answer_stability(const Request &request);
[[nodiscard]] Answer answer_show(const Request &request);
[[nodiscard]] Answer answer_balance(const Request &request);
[[nodiscard]] Answer answer_states(const Request &request); ///< of stability and balance
[[nodiscard]] Answer answer_pendulums(const Request &request);
[[nodiscard]] Answer answer_rigid_limit(const Request &request);
[[nodiscard]] Answer answer_simulate(const Request &request);
/// `simulate` of one disc in the middle of a rigid shaft without mass, no balancers.
[[nodiscard]] Answer answer_transient(const Request &request);
[[nodiscard]] Answer answer_samples(const Request &request);
[[nodiscard]] Answer answer_sweep(const Request &request);
// One for each kind of rotor that the others do not know.
[[nodiscard]] Answer answer_carried(const Request &request); ///< rings and rows of balls
[[nodiscard]] Answer answer_mounted(const Request &request); ///< fluid mass and pedestals
[[nodiscard]] Answer answer_twisted(const Request &request); ///< axial torque
/// Separation margins and level-I stability, of `response` and `stability`.
[[nodiscard]] Answer answer_operation(const Request &request);

/// Place of the largest value of a curve with one maximum between two places.
[[nodiscard]] double top_between(const std::function<double(double)> &f, double low, double high);

/// The reason of an oracle that cannot answer.
[[noreturn]] void no_answer(const std::string &reason);

} // namespace whirl::oracles
