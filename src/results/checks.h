#pragma once

#include "model/quantity.h"
#include "results/sentence.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// A value of a machine against its limit.
struct Check {
    std::string name;            ///< "separation margin", "vibration of the shaft", ...
    std::optional<double> value; ///< in SI; none: not known; may be infinite
    std::optional<double> limit; ///< in SI; none: no limit could be named
    model::Quantity quantity = model::Quantity::number; ///< of both
    bool percent = false;  ///< both are shares of one, which readers want in percent
    bool at_least = false; ///< the value must be at least the limit; else at most
    std::string reading;   ///< "peak", "peak to peak" or "rms" of what vibrates; else empty.
                         ///< Amplitudes (Quantity::amplitude) are from zero to peak whatever it is
                         ///< that the limit was given in: Units write them
    /// None: not judged, `why` says why. A value that is no number never passes.
    std::optional<bool> pass;
    Sentence where;     ///< place and speed: "at the probe DE x, 1180 rpm"
    std::string source; ///< of the limit: "ISO 20816-3, group 1, rigid, B/C", "case", ...
    Sentence why;       ///< it is not judged; empty: it is

    /// What is left up to the limit, as a share of it; negative where it is broken. None: one of
    /// them is not known, not finite, or the limit is 0.
    [[nodiscard]] std::optional<double> margin() const;
};

enum class Judgement {
    passes,    ///< every check passes, and there is at least one
    fails,     ///< some check fails
    incomplete ///< none fails, but some could not be judged, or there is none
};
/// "passes", "fails" or "incomplete".
[[nodiscard]] std::string judgement_name(Judgement judgement);

/// All checks of a machine, with what follows from them.
struct Assessment {
    Judgement verdict = Judgement::incomplete;
    Sentence sentence;         ///< the verdict in one sentence, for readers
    std::vector<Check> checks; ///< those that fail first, then not judged, then those that pass
};

} // namespace whirl::results
