#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::model {

/// Entries of [operation]: the speeds at which the machine runs.
struct Operation {
    double from = 0;                ///< minimum operating speed, rad/s
    double to = 0;                  ///< maximum continuous speed, rad/s
    std::optional<double> trip{};   ///< at which an independent device shuts down, rad/s
    std::optional<double> normal{}; ///< at which it runs as a rule, rad/s
};

/// A limit of vibration as it is read: the sine that just reaches it has an amplitude of its own.
enum class Reading { peak, peak_to_peak, rms };
/// "peak", "peak to peak" or "rms".
[[nodiscard]] std::string reading_name(Reading reading);

/// Boundaries between the zones of ISO 20816-3, and what they depend on for housings.
enum class Zone { a_b, b_c, c_d };
/// "A/B", "B/C" or "C/D".
[[nodiscard]] std::string zone_name(Zone zone);
struct HousingClass {
    int group = 1;         ///< 1: large machines, above 300 kW; 2: medium ones, 15 to 300 kW
    bool flexible = false; ///< the support is; else rigid
};

enum class ShaftStandard { api617, iso20816 };

/// Entries of [limits]; what is missing is not asked for.
struct Limits {
    std::optional<double> shaft; ///< what a shaft probe may read, m
    Reading shaft_reading = Reading::peak_to_peak;
    std::optional<ShaftStandard> shaft_standard;
    std::optional<double> velocity; ///< of pedestals, m/s
    Reading velocity_reading = Reading::rms;
    std::optional<HousingClass> pedestals; ///< by ISO 20816-3
    std::optional<Zone> zone;              ///< of both
    std::optional<double> clearance;       ///< of radial clearances that orbits may take
    bool scaled = true; ///< with the imbalance that brings the probes to their limit (API 617)
    std::optional<double> scale_most; ///< of the factor of the imbalance
};

/// An impeller or a row of blades whose gas drives the rotor ([[level1.stage]]).
struct Stage {
    std::string name;
    bool axial = false;          ///< a row of blades; else a centrifugal impeller
    double power = 0;            ///< W
    std::optional<double> speed; ///< at which it has that power, rad/s; none: maximum continuous
    double diameter = 0;         ///< of the impeller, or mean diameter of the blades, m
    double width = 0;            ///< least of impeller and diffuser, or height of the blades, m
    double density_ratio = 1;    ///< of the gas behind the impeller over that in front of it
};

/// Entries of [level1]: cross coupling added at one place (docs/theory.md, "Level-I stability").
struct Level1Settings {
    double z = 0;                      ///< m
    std::optional<double> to;          ///< largest cross coupling of the curve, N/m
    int count = 41;                    ///< points of the curve
    std::optional<double> anticipated; ///< of the machine's stages and seals together, N/m
    std::vector<Stage> stages;         ///< from which it is calculated instead
    std::optional<double> gas_density; ///< mean of inlet and outlet, kg/m3
};

/// Which of the tables of its bearings a machine has.
enum class BearingFit { given, least, most };
/// "as given", "min" or "max": minimum or maximum clearance.
[[nodiscard]] std::string fit_name(BearingFit fit);

/// Entries of [standard]: the response is repeated with imbalances that a standard places, and with
/// the least and the largest clearance of the bearings.
struct StandardSettings {
    bool api617 = false;          ///< imbalances as API 617 places them; else those of the case
    std::vector<BearingFit> fits; ///< never empty
};

} // namespace whirl::model
