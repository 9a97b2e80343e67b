#pragma once

#include <map>
#include <string>

namespace whirl::model {

/// A unit in which results are written.
struct OutputUnit {
    std::string name; ///< "rpm", "um"
    double size = 1;  ///< one of it in the SI unit of the quantity
};

/// Units of what is printed, plotted and written as tables; see [units] in docs/case_format.md.
struct OutputUnits {
    /// By quantity, as the keys of [units]: "length", "amplitude", "speed", ... Those that are
    /// missing are written as always.
    std::map<std::string, OutputUnit> of;
    bool peak_to_peak = false; ///< amplitudes of vibration from peak to peak, not from 0 to peak
    bool json = false;         ///< JSON too; otherwise it stays in SI

    [[nodiscard]] bool given() const { return !of.empty() || peak_to_peak; }
};

} // namespace whirl::model
