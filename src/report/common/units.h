#pragma once

#include "model/output_units.h"
#include "model/quantity.h"
#include "model/rpm.h"
#include "model/sentence.h"

#include <array>
#include <cstddef>
#include <numbers>
#include <string>

namespace whirl::report {

using model::Quantity;
using model::Unit;

/// How much stands on the terminal.
struct TextStyle {
    int digits = 5;      ///< significant ones of a number; 0: as many as each column has
    bool errors = false; ///< columns of errors that are below those digits, too
    int lines = 0;       ///< at most; 0: all there is

    /// No more than is usual.
    [[nodiscard]] bool few_digits() const { return digits > 0 && digits <= 5; }
};

/// The units of all quantities for one kind of reader, handed to whoever writes: the one place
/// where numbers in SI are turned into those that are written.
class Units {
  public:
    /// SI and radians: JSON where nothing else is asked for.
    Units() = default;
    /// Of files: those that were asked for, all others SI.
    [[nodiscard]] static Units of_files(const model::OutputUnits &asked);
    /// Of texts, pages and pictures: those that were asked for, else the usual ones: rpm, Hz, µm,
    /// g mm and degrees.
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
    /// Whether any was chosen.
    [[nodiscard]] bool asked() const;
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

    /// Of texts for the terminal.
    [[nodiscard]] const TextStyle &style() const { return _style; }
    [[nodiscard]] Units styled(const TextStyle &style) const {
        Units out = *this;
        out._style = style;
        return out;
    }

  private:
    void ask(const model::OutputUnits &asked);

    std::array<Unit, model::quantities> _units = si_units();
    std::array<bool, model::quantities> _asked{};
    TextStyle _style;

    [[nodiscard]] static std::array<Unit, model::quantities> si_units();
};

inline constexpr double pi = std::numbers::pi;

} // namespace whirl::report
