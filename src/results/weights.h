#pragma once

#include "results/model_summary.h"
#include "results/sentence.h"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// What the influence coefficients come from.
enum class InfluenceSource { trials, table, model };

/// A weight to be added in one plane. Complex numbers here have the phases of the case.
struct CorrectionWeight {
    std::string plane;
    double z = 0;                      ///< m; of a case without a shaft as it says
    std::complex<double> weight;       ///< to be added to what is on the rotor, kg m
    std::complex<double> on;           ///< trial weights that stay on, kg m
    std::complex<double> fixed;        ///< weights set before, kg m
    std::optional<double> scatter;     ///< radius in which the best weight is, 95 of 100, kg m
    std::optional<double> largest;     ///< bound of the weight, kg m
    double significance = 1;           ///< sine of its column's angle to those of the others
    std::optional<double> permissible; ///< ISO 21940-11: residual imbalance of the plane, kg m
};

/// What a probe reads at a speed.
struct WeightReading {
    std::string probe;
    std::optional<double> speed;   ///< rad/s
    std::complex<double> before;   ///< without any of the weights, m
    std::complex<double> after;    ///< m
    std::optional<double> scatter; ///< radius about the prediction, 95 of 100, m
    std::optional<double> split;   ///< amplitude after the weights as they are split, m
};

struct InfluenceCoefficient {
    std::string probe;
    std::optional<double> speed; ///< rad/s
    std::string plane;
    std::complex<double> value; ///< m/(kg m)
    /// Of the model: relative, by the shaft elements and rounding; none: not known.
    std::optional<double> error{};
};

/// What one place does for a unit weight in one plane, over the speeds of the case. Of a bearing
/// the deflection of the shaft there, and the force: over the centrifugal force of the weight.
struct InfluenceCurve {
    std::string of; ///< "probe", "bearing", "force" or "station"
    std::string name;
    double z = 0;     ///< m
    double angle = 0; ///< in which it is read, from x towards y, rad
    std::string plane;
    /// m/(kg m), of a force a number; none: a resonance without damping, of a force also at rest.
    std::vector<std::optional<std::complex<double>>> values;
    /// Relative, by the shaft elements and rounding; none: not known, or there is no motion.
    std::vector<std::optional<double>> errors{};
};

/// How a rotor with flexible behaviour is balanced, and in how many planes.
struct BalancingProcedure {
    bool flexible = true;    ///< else two planes at any low speed do, as of a rigid rotor
    std::string body;        ///< "discs", "sections", "roll" or "integral"
    bool body_given = false; ///< by the case; else by the masses of discs and shaft
    bool removable = false;  ///< its parts are balanced before they go on the shaft
    int discs = 0;
    double service_speed = 0; ///< highest, rad/s
    int criticals = 0;        ///< forward critical speeds below it
    int bending = 0;          ///< N: those of them that owe most of their flexibility to the shaft
    std::optional<double> next_bending;  ///< the first above it, rad/s
    std::vector<std::string> procedures; ///< "A" .. "I" of ISO 21940-12, the first that fits first
    Sentence why;
    Sentence planes; ///< how many are needed, and whether there are as many
};

/// Planes whose weights nearly do the same.
struct DependentPlanes {
    std::vector<std::string> planes;
    std::string leave_out;      ///< whose absence costs least
    double rms = 0, max = 0;    ///< of the vibration without that plane, m
    double largest_weight = 0;  ///< with all planes, kg m
    double largest_without = 0; ///< kg m
};

/// The best of all choices of so many planes.
struct PlaneChoice {
    std::vector<std::string> planes;
    double rms = 0, max = 0;   ///< m
    double largest_weight = 0; ///< kg m
};

/// A piece of a weight.
struct WeightPiece {
    std::string plane;
    std::optional<int> hole;    ///< from 1
    double angle = 0;           ///< rad
    std::optional<double> mass; ///< kg
    double mr = 0;              ///< kg m
};

struct SplitPlane {
    std::string plane;
    std::vector<WeightPiece> pieces;
    std::complex<double> sum;     ///< kg m
    std::complex<double> missing; ///< weight less sum, kg m
};

struct DoubtfulReading {
    std::string probe;
    std::optional<double> speed; ///< rad/s
    std::string run;
    int line = 0;           ///< of the table
    double apart = 0;       ///< from what the others say, m
    double probability = 0; ///< that scatter alone does that
};

/// Vibration of a probe over speed, without and with the weights; from the model.
struct VibrationCurve {
    std::string probe;
    std::vector<std::optional<double>> before, after; ///< m
};

struct WeightsResult {
    ModelSummary model;
    std::string method; ///< "least-squares" or "minimax"
    bool lag = false;
    InfluenceSource source = InfluenceSource::trials;
    bool measured = true; ///< the vibration; else of the model's imbalances
    std::vector<CorrectionWeight> weights;
    std::vector<WeightReading> residual;
    double rms = 0, max = 0;               ///< after, m
    double rms_before = 0, max_before = 0; ///< m
    double reached = 0, bound = 0; ///< what the method makes small, and what it cannot go below, m
    std::vector<InfluenceCoefficient> influence;
    std::vector<InfluenceCurve> influence_curves; ///< over curve_speeds; from the model
    std::optional<BalancingProcedure> procedure;  ///< of a model whose service speed is known
    std::vector<double> singular_values;          ///< m/(kg m)
    std::optional<double> condition;              ///< none: some plane is superfluous
    std::vector<DependentPlanes> dependent;
    std::vector<PlaneChoice> choices; ///< of one plane, of two, ...
    std::vector<SplitPlane> split;
    std::optional<double> rms_split, max_split; ///< m
    std::vector<DoubtfulReading> outliers;
    std::vector<double> curve_speeds;   ///< of [speeds], rad/s; from the model
    std::vector<VibrationCurve> curves; ///< of the imbalances of the case
};

} // namespace whirl::results
