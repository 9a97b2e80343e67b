#pragma once

#include "model/quantity.h"
#include "model/samples.h"

#include <array>
#include <cstddef>
#include <optional>
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
    double given = 0; ///< in the case, SI; 0 where the case leaves it at its default
};

/// Dimensionless numbers that an axis may be over, as `show` names them (docs/theory.md, "Composite
/// rotor"): of the whole rotor or of a balancer, of a balancer alone, and the spin speed over
/// omega_0 = sqrt(c_x/M_s).
inline constexpr std::array rotor_numbers{"C", "A", "p2", "c_y", "h_x", "h_beta", "h_y"};
inline constexpr std::array balancer_numbers{"A_m", "A_m0", "m", "z_A", "h_s"};
inline constexpr const char *speed_number = "Omega";

/// The dimensionless number of the rotor that the values of an axis are of.
struct DimensionlessNumber {
    std::string name;                      ///< one of those above
    std::optional<std::size_t> balancer{}; ///< whose, where the case says so, by its place there
    std::string place;                     ///< where the case asks for it, for messages
};

/// Entries that change together over some values.
struct SweepAxis {
    std::string label; ///< `path` as it is written, of several the first
    std::vector<SweptEntry> entries;
    SweepChange change = SweepChange::value;
    Quantity quantity = Quantity::number; ///< of the values: of factors a plain number
    std::vector<double> values;           ///< SI, in the order in which they are given
    bool logarithmic = false;             ///< evenly spaced in their logarithm
    /// None: the values are those of the entries, or of the spin speed.
    std::optional<DimensionlessNumber> dimensionless{};

    /// The spin speed itself, where that is not an entry: of maps alone.
    [[nodiscard]] bool is_speed() const { return entries.empty(); }
    /// What an entry is at a value; of a dimensionless number at what was found for it.
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
