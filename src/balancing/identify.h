#pragma once

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <vector>

namespace whirl::balancing {

/// One reading of a place: in which run.
struct Reading {
    std::size_t run = 0;
    std::complex<double> value;
};

/// A reading that lies far from what the others of its place say.
struct Outlier {
    std::size_t reading = 0;    ///< among those of the place
    std::complex<double> apart; ///< from what the others say
    double probability = 0;     ///< that scatter alone puts it so far off
};

/// Vibration and coefficients of one place by least squares over its readings,
/// value = a + H w of the run.
struct Identified {
    Eigen::VectorXcd x; ///< a, then H (without trial weights: a alone)
    Eigen::MatrixXcd M; ///< x = M values
    double squares = 0; ///< sum of |value - fit|^2
    double freedom = 0; ///< readings beyond those that are needed
    std::vector<Outlier> outliers;
};

/// The weights of all runs tell the planes apart: their matrix with a column of ones has the rank
/// of its columns.
[[nodiscard]] bool tells_apart(const Eigen::MatrixXcd &weights);

/// Readings of many places with the same weights.
class Identification {
  public:
    /// @param weights  those on the rotor, a row a run, a column a plane (without columns: the
    ///                 readings are all of one state)
    explicit Identification(Eigen::MatrixXcd weights) : _weights(std::move(weights)) {}

    /// @param looks  at how many readings in all an outlier is looked for
    [[nodiscard]] Identified of(const std::vector<Reading> &readings, std::size_t looks) const;

  private:
    Eigen::MatrixXcd _weights;
};

/// Square of what complex numbers scatter by: mean of |deviation|^2, known from so many of them
/// (complex degrees of freedom; infinite: given).
struct Scatter {
    double square = 0;
    double freedom = 0;
};

/// The sum of independent ones, each times a factor (Welch and Satterthwaite).
[[nodiscard]] Scatter sum_of(const std::vector<Scatter> &parts);

/// Radius of the circle about a value in which the true one lies with a probability: of a complex
/// normal number, by the F distribution with 2 and 2 n degrees of freedom, whose tail is
/// (1 + x / n)^-n.
[[nodiscard]] double radius_of(const Scatter &scatter, double probability);

} // namespace whirl::balancing
