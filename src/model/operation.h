#pragma once

#include <optional>
#include <string>

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

/// Entries of [level1]: cross coupling added at one place (docs/theory.md, "Level-I stability").
struct Level1Settings {
    double z = 0;                      ///< m
    std::optional<double> to;          ///< largest cross coupling of the curve, N/m
    int count = 41;                    ///< points of the curve
    std::optional<double> anticipated; ///< of the machine's stages and seals together, N/m
};

} // namespace whirl::model
