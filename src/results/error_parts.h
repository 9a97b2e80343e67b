#pragma once

namespace whirl::results {

/// What a relative error is the sum of.
struct ErrorParts {
    double mesh = 0;      ///< by the shaft elements, and the steps of the model that judges them
    double reduction = 0; ///< of few shapes or of following, which the whole model leaves; zero
                          ///< where the whole model itself was solved
    double rounding = 0;  ///< of the entries and of the solver

    [[nodiscard]] double sum() const { return mesh + reduction + rounding; }
};

} // namespace whirl::results
