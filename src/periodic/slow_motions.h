#pragma once

#include "periodic/modal_series.h"
#include "periodic/monodromy.h"

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace whirl::periodic {

/// Motions at speeds far below their frequencies. Half a turn takes so long there that the
/// monodromy matrix needs many steps, or forgets damped motions, and Hill's series as one large
/// eigenproblem has aliases of every motion at distances of twice the speed. Each motion is
/// followed down from a speed at which the matrix resolves all, as a root of Hill's series with as
/// many terms as it needs (modal_series.h). None is lost and none is met twice, or there is no
/// answer.
class SlowMotions {
  public:
    using SystemAt = std::function<const System &(double speed)>;

    /// @param from     rad/s, where the motions are known
    /// @param motions  there
    SlowMotions(SystemAt system, double from, const std::vector<FloquetSeries> &motions);

    /// @param speed  of the sign of `from` and not larger, rad/s
    /// @returns the same motions in the same order, each as the alias with the largest term in the
    ///          middle; nothing where one of them is lost on the way, or takes too many terms
    [[nodiscard]] std::optional<std::vector<FloquetSeries>> at(double speed);

  private:
    using Motions = std::vector<SeriesMotion>;
    SystemAt _system;
    double _from;
    std::map<double, Motions> _known; ///< by the size of the speed
    double _lost = 0;                 ///< from here down there is no answer

    [[nodiscard]] std::optional<Motions> stepped(const Motions &from, double speed) const;
    [[nodiscard]] const Motions *reached(double size);
};

} // namespace whirl::periodic
