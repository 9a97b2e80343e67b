#pragma once

#include "linalg/eigenpair.h"
#include "modes/rotating_spectrum.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::modes {

/// A motion exp(l t) sum_k q_k exp(2 i k speed t), |k| <= K, as the eigenpair of Hill's series
/// whose constant term is q_place: over the real unknowns of as many harmonics as it has, and no
/// fewer than the rotor's series, with Im >= 0. Of a motion that is its own conjugate the vector is
/// real.
/// @param terms  q_-K, ..., q_K, a column each
[[nodiscard]] linalg::ComplexPair series_pair(const RotatingSpectrum &rotor, double speed,
                                              std::complex<double> value,
                                              const Eigen::MatrixXcd &terms, Eigen::Index place);

/// The places of the term that the motion is shown by: the largest as seen along the shaft, or
/// several as large with other frequencies in the fixed frame; of a motion on straight lines the
/// one of two that turns against the spin, of one that stands still in the rotor (l real) its own
/// conjugate.
[[nodiscard]] std::vector<Eigen::Index> shown_places(const RotatingSpectrum &rotor,
                                                     std::complex<double> value,
                                                     const Eigen::MatrixXcd &terms, double speed);

} // namespace whirl::modes
