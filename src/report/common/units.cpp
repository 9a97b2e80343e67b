#include "report/common/units.h"

#include <algorithm>

namespace whirl::report {

std::array<Unit, model::quantities> Units::si_units() {
    std::array<Unit, model::quantities> units;
    for (std::size_t i = 0; i < model::quantities; ++i)
        units[i].name = names_of(static_cast<Quantity>(i)).si;
    return units;
}

void Units::ask(const model::OutputUnits &asked) {
    for (std::size_t i = 0; i < model::quantities; ++i) {
        const auto found = asked.of.find(names_of(static_cast<Quantity>(i)).key);
        if (found == asked.of.end())
            continue;
        _units[i] = {found->second.name, 1 / found->second.size, false};
        _asked[i] = true;
    }
    if (!asked.peak_to_peak)
        return;
    const auto amplitude = static_cast<std::size_t>(Quantity::amplitude);
    _units[amplitude].factor *= 2;
    _units[amplitude].peak_to_peak = true;
    _asked[amplitude] = true;
}

Units Units::of_files(const model::OutputUnits &asked) {
    Units units;
    units.ask(asked);
    return units;
}

Units Units::of_readers(const model::OutputUnits &asked) {
    Units units;
    const auto set = [&units](Quantity quantity, const char *name, double factor) {
        units._units.at(static_cast<std::size_t>(quantity)) = {name, factor, false};
    };
    set(Quantity::speed, "rpm", model::rpm);
    set(Quantity::frequency, "Hz", 0.5 / pi);
    set(Quantity::amplitude, "µm", 1e6);
    set(Quantity::deflection, "µm", 1e6);
    set(Quantity::velocity, "mm/s", 1e3);
    set(Quantity::receptance, "µm/N", 1e6);
    set(Quantity::imbalance, "g mm", 1e6); // as balancing machines say it
    set(Quantity::inertia, "kg m²", 1);
    set(Quantity::angular_momentum, "kg m²/s", 1);
    set(Quantity::acceleration, "m/s²", 1);
    set(Quantity::density, "kg/m³", 1);
    set(Quantity::angle, "deg", 180 / pi);
    units.ask(asked);
    return units;
}

Units Units::of_json(const model::OutputUnits &asked) {
    return asked.json ? of_files(asked) : Units();
}

bool Units::asked() const {
    return std::ranges::any_of(_asked, [](bool one) { return one; });
}

std::string Units::name(Quantity quantity) const {
    const Unit &used = unit(quantity);
    return used.peak_to_peak ? used.name + " pk-pk" : used.name;
}

std::string Units::label(const std::string &what, Quantity quantity) const {
    const Unit &used = unit(quantity);
    return what + (used.peak_to_peak ? " pk-pk" : "") +
           (used.name.empty() ? "" : " (" + used.name + ")");
}

std::string Units::heading(const std::string &what, Quantity quantity) const {
    const Unit &used = unit(quantity);
    return what + (used.peak_to_peak ? " pk-pk" : "") +
           (used.name.empty() ? "" : " [" + used.name + "]");
}

std::string Units::text(Quantity quantity, double si, int digits) const {
    return text(model::Sentence("{}", model::ValueOf{quantity}(si, digits)));
}

std::string Units::text(const model::Sentence &sentence) const {
    return sentence.text([this](Quantity quantity) { return unit(quantity); });
}

} // namespace whirl::report
