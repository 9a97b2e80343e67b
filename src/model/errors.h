#pragma once

#include "model/sentence.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace whirl::model {

/// What the program knows to go wrong: each of the following, and linalg::SolverError.
class Failure : public std::runtime_error {
  public:
    explicit Failure(Sentence sentence)
        : std::runtime_error(sentence.text()), _sentence(std::move(sentence)) {}

    explicit Failure(const std::string &words) : Failure(Sentence(words)) {}
    explicit Failure(const char *words) : Failure(Sentence(words)) {}

    /// What to say in the units of readers; what() is in SI.
    [[nodiscard]] const Sentence &sentence() const { return _sentence; }

  private:
    Sentence _sentence;
};

/// The analysis cannot be done for this scene, or failed; what() is for the user. Exit status 1.
class AnalysisFailure : public Failure {
  public:
    using Failure::Failure;
};

/// The case or the arguments are wrong; what() has one line for each problem. Exit status 2.
class BadInput : public Failure {
  public:
    using Failure::Failure;
};

} // namespace whirl::model
