#include "unit_presets.h"

#include <stdexcept>

namespace whirl::tests {

double size_of(const std::string &unit) {
    constexpr double pi = 3.14159265358979323846;
    constexpr double pound = 0.45359237;
    constexpr double lbf = pound * 9.80665;
    constexpr double inch = 0.0254;
    // NIST SP 811: inch and pound are exact, a pound-force is a pound times 9.80665 m/s2. Hz counts
    // turns.
    static const std::map<std::string, double> sizes{
        {"", 1},          {"m", 1},
        {"mm", 1e-3},     {"cm", 1e-2},
        {"um", 1e-6},     {"µm", 1e-6},
        {"in", inch},     {"mil", inch / 1000},
        {"rad/s", 1},     {"rpm", pi / 30},
        {"Hz", 2 * pi},   {"N", 1},
        {"kN", 1e3},      {"lbf", lbf},
        {"N/m", 1},       {"N/mm", 1e3},
        {"kN/mm", 1e6},   {"lbf/in", lbf / inch},
        {"N s/m", 1},     {"N s/mm", 1e3},
        {"kN s/m", 1e3},  {"lbf s/in", lbf / inch},
        {"kg", 1},        {"g", 1e-3},
        {"lb", pound},    {"kg m2", 1},
        {"kg m²", 1},     {"kg mm2", 1e-6},
        {"kg cm2", 1e-4}, {"lb in2", pound * inch * inch},
        {"kg m", 1},      {"g mm", 1e-6},
        {"kg mm", 1e-3},  {"oz in", pound / 16 * inch},
        {"rad", 1},       {"deg", pi / 180},
        {"1/s", 1},       {"s", 1},
        {"J", 1},         {"W", 1},
        {"Pa", 1},        {"1/kg", 1},
        {"kg/m3", 1},     {"kg/m³", 1},
        {"kg m2/s", 1},   {"kg m²/s", 1},
        {"m/s2", 1},      {"m/s²", 1},
        {"m/s", 1},       {"mm/s", 1e-3},
        {"in/s", inch},   {"cm/s", 1e-2},
        {"N m/rad", 1},   {"N m s/rad", 1},
        {"N m", 1},       {"m/N", 1},
        {"m/(kg m)", 1},  {"um/(g mm)", 1},
        {"µm/(g mm)", 1}, {"mil/(oz in)", inch / 1000 / (pound / 16 * inch)},
        {"um/N", 1e-6},   {"µm/N", 1e-6},
        {"mm/kN", 1e-6},  {"mil/lbf", inch / 1000 / lbf}};
    const auto found = sizes.find(unit);
    if (found == sizes.end())
        throw std::runtime_error("no unit that this test knows: " + unit);
    return found->second;
}

double Preset::factor(const std::string &quantity) const {
    const auto found = units.find(quantity);
    const double twice = peak_to_peak && quantity == "amplitude" ? 2 : 1;
    return twice / (found == units.end() ? 1 : size_of(found->second));
}

std::string Preset::unit(model::Quantity quantity) const {
    const model::QuantityNames names = names_of(quantity);
    const auto found = units.find(names.name);
    return found == units.end() ? names.si : found->second;
}

const std::vector<Preset> &presets() {
    static const std::map<std::string, std::string> metric{
        {"length", "mm"},      {"amplitude", "um"},   {"deflection", "um"},   {"speed", "rpm"},
        {"frequency", "Hz"},   {"stiffness", "N/mm"}, {"receptance", "um/N"}, {"damping", "N s/mm"},
        {"inertia", "kg mm2"}, {"imbalance", "g mm"}, {"velocity", "mm/s"}};
    static const std::vector<Preset> all{
        {"si", {"units.preset=si"}, {}},
        {"mm-rpm", {"units.preset=mm-rpm"}, metric},
        {"us",
         {"units.preset=us"},
         {{"length", "in"},
          {"amplitude", "mil"},
          {"deflection", "mil"},
          {"speed", "rpm"},
          {"frequency", "Hz"},
          {"force", "lbf"},
          {"stiffness", "lbf/in"},
          {"receptance", "mil/lbf"},
          {"damping", "lbf s/in"},
          {"mass", "lb"},
          {"inertia", "lb in2"},
          {"imbalance", "oz in"},
          {"velocity", "in/s"}}},
        {"mixed",
         {"units.speed=Hz", "units.frequency=rpm", "units.length=cm", "units.amplitude=mm",
          "units.force=kN", "units.stiffness=kN/mm", "units.receptance=mm/kN",
          "units.damping=kN s/m", "units.mass=g", "units.inertia=kg cm2", "units.imbalance=kg mm",
          "units.velocity=cm/s", "units.peak_to_peak=true"},
         {{"speed", "Hz"},
          {"frequency", "rpm"},
          {"length", "cm"},
          {"amplitude", "mm"},
          {"deflection", "mm"},
          {"force", "kN"},
          {"stiffness", "kN/mm"},
          {"receptance", "mm/kN"},
          {"damping", "kN s/m"},
          {"mass", "g"},
          {"inertia", "kg cm2"},
          {"imbalance", "kg mm"},
          {"velocity", "cm/s"}},
         true},
        {"pk-pk", {"units.preset=mm-rpm", "units.peak_to_peak=true"}, metric, true}};
    return all;
}

// Short, as names of units are: there must be room for it in the same places.
std::string mark_of(model::Quantity quantity) {
    return "§" + std::string(names_of(quantity).key).substr(0, 3);
}

double mark_size(model::Quantity quantity) {
    using enum model::Quantity;
    return quantity == amplitude || quantity == deflection || quantity == receptance ? 1e-6 : 1;
}

model::OutputUnits marked_units() {
    model::OutputUnits units;
    for (std::size_t i = 0; i < model::quantities; ++i) {
        const auto of = static_cast<model::Quantity>(i);
        const std::string key = names_of(of).key;
        if (!key.empty())
            units.of[key] = {mark_of(of), mark_size(of)};
    }
    units.peak_to_peak = true;
    return units;
}

} // namespace whirl::tests
