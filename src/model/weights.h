#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::model {

/// What correction weights make small: the sum of squares of the vibration, or its largest.
enum class WeightsMethod { least_squares, minimax };

/// What a flexible rotor is made of, as ISO 21940-12 tells rotors apart.
enum class RotorBody {
    discs,    ///< rigid discs on an elastic shaft without imbalance of its own
    sections, ///< rigid sections on such a shaft
    roll,     ///< mass, elasticity and imbalance all along, one body
    integral  ///< the same in several parts that do not come off
};

/// A probe at one speed: one row of the influence matrix.
struct ReadingPlace {
    std::string probe;
    std::optional<double> speed; ///< rad/s; none: the readings do not say
    double factor = 1;           ///< of its vibration in what is made small
};

/// One reading of a run. Complex numbers have the phases of the case: lead, or lag.
struct RunReading {
    std::size_t place = 0;      ///< among the places
    std::size_t run = 0;        ///< 0: the initial run; then those of the trials, from 1
    std::complex<double> value; ///< m, without runout
    int line = 0;               ///< of the table
};

/// A trial weight in one run.
struct TrialWeight {
    std::size_t run = 0;         ///< from 1, in the order of the case file
    std::size_t plane = 0;       ///< among the planes of the rotor
    std::complex<double> weight; ///< kg m
    bool kept = false;           ///< stays on for the runs after it
};

/// A coefficient from a table: vibration of a probe for a unit weight.
struct GivenCoefficient {
    std::size_t place = 0;
    std::size_t plane = 0;
    std::complex<double> value; ///< m/(kg m)
};

/// Entries of [weights], with the tables that it names and the trial weights.
struct WeightsSettings {
    WeightsMethod method = WeightsMethod::least_squares;
    bool lag = false;                 ///< phases of readings and weights count against the spin
    std::vector<ReadingPlace> places; ///< of the readings; empty: none are given
    std::vector<std::string> runs;    ///< names of those with trial weights
    std::vector<RunReading> readings; ///< in the order of the table
    std::vector<TrialWeight> trials;  ///< in the order of the case file
    std::vector<GivenCoefficient> influence; ///< empty: from trial runs or the model
    std::vector<double> speeds;              ///< rad/s, of the model where nothing is measured
    std::vector<std::pair<std::string, double>> factors; ///< of probes by their names
    std::vector<double> stations;                        ///< whose influence is asked for too, z, m
    std::optional<RotorBody> body;                       ///< none: by the masses of discs and shaft
    bool removable = false;            ///< its parts are balanced before they go on the shaft
    std::optional<double> scatter;     ///< of a reading, a share of it (standard deviation)
    std::vector<double> stock;         ///< masses of weights at hand, kg
    std::optional<double> grade;       ///< ISO 21940-11, mm/s
    std::optional<double> mass;        ///< of the rotor for the grade, kg; none: of the model
    std::optional<double> grade_speed; ///< at which the grade holds, rad/s; none: the highest
};

} // namespace whirl::model
