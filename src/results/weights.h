#pragma once

#include "results/model_summary.h"

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
    std::vector<double> singular_values; ///< m/(kg m)
    std::optional<double> condition;     ///< none: some plane is superfluous
    std::vector<DependentPlanes> dependent;
    std::vector<PlaneChoice> choices; ///< of one plane, of two, ...
    std::vector<SplitPlane> split;
    std::optional<double> rms_split, max_split; ///< m
    std::vector<DoubtfulReading> outliers;
    std::vector<double> curve_speeds; ///< rad/s
    std::vector<VibrationCurve> curves;
};

} // namespace whirl::results
