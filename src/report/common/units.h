#pragma once

#include "model/output_units.h"
#include "model/quantity.h"
#include "model/rpm.h"
#include "model/sentence.h"

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

using model::Quantity;
using model::Unit;

/// The units of all quantities for one kind of reader. Handed to whoever writes.
class Units {
  public:
    /// SI and radians: JSON where nothing else is asked for.
    Units() = default;
    /// Of files: those that were asked for, all others SI.
    [[nodiscard]] static Units of_files(const model::OutputUnits &asked);
    /// Of texts, pages and pictures: those that were asked for, else the usual ones: rpm, Hz, µm
    /// and degrees.
    [[nodiscard]] static Units of_readers(const model::OutputUnits &asked);
    /// Of JSON: as files where that is asked for, else SI.
    [[nodiscard]] static Units of_json(const model::OutputUnits &asked);

    [[nodiscard]] const Unit &unit(Quantity quantity) const {
        return _units.at(static_cast<std::size_t>(quantity));
    }
    /// Whether the user has chosen the unit of this quantity.
    [[nodiscard]] bool asked(Quantity quantity) const {
        return _asked.at(static_cast<std::size_t>(quantity));
    }
    /// A number in SI as it is written: units(Quantity::speed, omega).
    [[nodiscard]] double operator()(Quantity quantity, double si) const {
        return si * unit(quantity).factor;
    }
    /// What a number of this quantity is multiplied by.
    [[nodiscard]] double factor(Quantity quantity) const { return unit(quantity).factor; }
    /// "rpm"; "mil pk-pk"; nothing for a plain number.
    [[nodiscard]] std::string name(Quantity quantity) const;
    /// Of an axis or a table for readers: "Spin speed (rpm)", "Amplitude pk-pk (mil)".
    [[nodiscard]] std::string label(const std::string &what, Quantity quantity) const;
    /// Of a column of a file: "speed [rad/s]", "amplitude pk-pk [mil]".
    [[nodiscard]] std::string heading(const std::string &what, Quantity quantity) const;
    /// A number in SI with its unit: "3000 rpm". @param digits  significant ones
    [[nodiscard]] std::string text(Quantity quantity, double si, int digits = 6) const;
    [[nodiscard]] std::string text(const model::Sentence &sentence) const;

  private:
    static constexpr std::size_t quantities =
        static_cast<std::size_t>(Quantity::inverse_mass) + 1; // the last of them
    void ask(const model::OutputUnits &asked);

    std::array<Unit, quantities> _units = si_units();
    std::array<bool, quantities> _asked{};
    bool _for_readers = false;

    [[nodiscard]] static std::array<Unit, quantities> si_units();
};

// The one place where numbers and their units are turned into those that were asked for. Results
// are in SI; tables are converted by the units in their headings, pictures by the factors below.

/// The units of everything that is written from now on. (Set once in a run, by whoever delivers
/// the report; tests set others.)
void write_in(const model::OutputUnits &units);
[[nodiscard]] const model::OutputUnits &written_units();

/// From SI to readers: a number times this is in the unit that was asked for, or in the usual one.
class Reading {
  public:
    constexpr Reading(const char *quantity, double usual) : _quantity(quantity), _usual(usual) {}
    [[nodiscard]] operator double() const; // NOLINT: it is a factor

  private:
    const char *_quantity;
    double _usual;
};

inline constexpr double pi = std::numbers::pi;
// Texts beside them say "rpm", "Hz", "(µm)" and so on: in_written_units puts the other names there.
inline constexpr Reading rpm{"speed", model::rpm};             ///< of one rad/s of spin
inline constexpr Reading hertz{"frequency", 0.5 / pi};         ///< of one rad/s of whirl
inline constexpr Reading metres{"length", 1};                  ///< places and sizes
inline constexpr Reading micrometres{"amplitude", 1e6};        ///< vibration
inline constexpr Reading still_micrometres{"deflection", 1e6}; ///< what does not vibrate
inline constexpr Reading newtons{"force", 1};
inline constexpr Reading kilograms{"mass", 1};
inline constexpr Reading inertia_si{"inertia", 1}; ///< kg m2
inline constexpr Reading newtons_per_metre{"stiffness", 1};

/// A heading of a table in the units that were asked for.
struct UnitHeading {
    std::string text;
    double factor = 1;  ///< for the numbers below it
    bool given = false; ///< it has a unit that was asked for
};
/// @param heading  with its unit: "speed [rad/s]", "Amplitude (µm)", "largest force N", "rpm"
/// @param context  further words that tell what the numbers are, such as the other headings
[[nodiscard]] UnitHeading heading_in_written_units(const std::string &heading,
                                                   const std::string &context);

/// What is in an SI unit as results name it: "speed" of "rad/s"; empty: none that has other units.
[[nodiscard]] std::string quantity_in(const std::string &unit);

/// From SI to the unit of a quantity that was asked for; none: it is written as always.
[[nodiscard]] std::optional<double> written_factor(const std::string &quantity);

/// The name of a unit of a quantity, or of the one that was asked for: ("force", "N").
[[nodiscard]] std::string unit_name(const std::string &quantity, const std::string &usual);

/// The unit in which numbers of a quantity are written, and what it makes of those in SI.
struct WrittenUnit {
    std::string name;
    double factor = 1;
};
/// @param usual  its name in SI
[[nodiscard]] inline WrittenUnit written_unit(const std::string &quantity,
                                              const std::string &usual) {
    return {unit_name(quantity, usual), written_factor(quantity).value_or(1)};
}

/// Text of the report with its units by their other names: numbers before "rpm", "Hz" and "µm" are
/// there already by the factors above, those before "m", "N", "N/m", "rad/s" are converted.
[[nodiscard]] std::string in_written_units(const std::string &text);

/// The same for text of an analysis, whose numbers are all as they say: in SI. Where no units were
/// asked for, speeds and frequencies are in those of the text around it, rpm and Hz.
[[nodiscard]] std::string note_in_written_units(const std::string &note);

/// Text that is converted already or the user's own, such as a title: marked so that
/// in_written_units and script_in_written_units leave it alone.
[[nodiscard]] std::string kept_as_written(const std::string &text);

/// A cell of a table for the terminal, converted once and for all: what in_written_units leaves
/// alone.
[[nodiscard]] std::string cell_in_written_units(const std::string &cell);
/// Its letters, without the marks that say so.
[[nodiscard]] std::size_t shown_size(const std::string &cell);

/// Commands of a picture: as text, with the units of its axes, whose numbers are there already.
[[nodiscard]] std::string script_in_written_units(const std::string &script);

/// What the page's scripts need: factors and names.
[[nodiscard]] std::string script_units();
/// A script of the page: its labels by their other names.
[[nodiscard]] std::string page_script_in_written_units(const std::string &script);

} // namespace whirl::report
