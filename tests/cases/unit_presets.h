#pragma once

#include "model/output_units.h"
#include "model/quantity.h"

#include <map>
#include <string>
#include <vector>

namespace whirl::tests {

/// One of a unit in SI, by a table of this test; a unit that it does not know is an error.
[[nodiscard]] double size_of(const std::string &unit);

/// Units as they are asked for, and by quantity.
struct Preset {
    std::string name;
    std::vector<std::string> asked;
    std::map<std::string, std::string> units; ///< others are in SI
    bool peak_to_peak = false;

    /// What a number of a quantity in SI is multiplied by.
    [[nodiscard]] double factor(const std::string &quantity) const;
    [[nodiscard]] std::string unit(model::Quantity quantity) const;
};
/// si, mm-rpm, us, mixed, pk-pk.
[[nodiscard]] const std::vector<Preset> &presets();

/// Units each of which says by its name what its numbers are: "3000 §spe". Amplitudes are from peak
/// to peak, which tells them from deflections.
[[nodiscard]] model::OutputUnits marked_units();
[[nodiscard]] std::string mark_of(model::Quantity quantity);
/// One of it in SI: of such a size that numbers have the usual lengths, for gnuplot leaves out the
/// name of an axis that has no room beside its numbers.
[[nodiscard]] double mark_size(model::Quantity quantity);

} // namespace whirl::tests
