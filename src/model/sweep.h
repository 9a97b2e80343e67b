#pragma once

#include "model/quantity.h"
#include "model/samples.h"

#include <string>
#include <vector>

namespace whirl::model {

/// What the values of an axis do to its entries, in the order of the words of a case file.
enum class SweepChange {
    value,  ///< they take the place of what the case gives
    factor, ///< of what the case gives
    shift   ///< added to what the case gives
};

/// An entry that an axis changes.
struct SweptEntry {
    std::string path; ///< as --set takes it
    double given = 0; ///< in the case, SI; of factors and shifts alone
};

/// Entries that change together over some values.
struct SweepAxis {
    std::string label; ///< `path` as it is written, of several the first
    std::vector<SweptEntry> entries;
    SweepChange change = SweepChange::value;
    Quantity quantity = Quantity::number; ///< of the values: of factors a plain number
    std::vector<double> values;           ///< SI, in the order in which they are given
    bool logarithmic = false;             ///< evenly spaced in their logarithm

    /// The spin speed itself, where that is not an entry: of maps alone.
    [[nodiscard]] bool is_speed() const { return entries.empty(); }
    /// What an entry is at a value.
    [[nodiscard]] double at(const SweptEntry &entry, double value) const {
        switch (change) {
        case SweepChange::factor:
            return entry.given * value;
        case SweepChange::shift:
            return entry.given + value;
        case SweepChange::value:
            break;
        }
        return value;
    }
};

/// Entries of [sweep].
struct SweepSettings {
    WantedAnswers of;
    std::vector<SweepAxis> axes; ///< one or two
};

} // namespace whirl::model
