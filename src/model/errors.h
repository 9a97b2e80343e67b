#pragma once

#include <stdexcept>

namespace whirl::model {

/// The analysis cannot be done for this scene, or failed; what() is for the user. Exit status 1.
class AnalysisFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The case or the arguments are wrong; what() has one line for each problem. Exit status 2.
class BadInput : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace whirl::model
