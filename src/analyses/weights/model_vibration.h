#pragma once

#include "forced/forced_motion.h"
#include "forced/imbalance_motions.h"
#include "model/case.h"
#include "model/weights.h"
#include "results/weights.h"

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <vector>

namespace whirl::analyses {

/// z of the centre of mass of what turns, m.
[[nodiscard]] double centre_of_mass(const model::Rotor &rotor);

/// What the probes of a case read by its model, as complex numbers with the phases of [weights].
class ModelVibration {
  public:
    /// Chooses form and order for the case. @param summary  gets them
    /// @throws model::BadInput without probes; model::AnalysisFailure for a rotor that is not the
    /// same from every direction
    ModelVibration(const model::Case &scene, results::ModelSummary &summary);

    /// Every probe at every speed of [weights].
    /// @throws model::BadInput where there is no speed
    [[nodiscard]] std::vector<model::ReadingPlace> places() const;

    /// Coefficients of the planes: vibration under a unit imbalance in each of them.
    [[nodiscard]] Eigen::MatrixXcd influence(const std::vector<model::ReadingPlace> &places) const;

    /// Under the imbalances of the case, those its balancers are for and the weights that are set.
    [[nodiscard]] Eigen::VectorXcd vibration(const std::vector<model::ReadingPlace> &places) const;

    /// Adds amplitudes over the speeds of the case, without and with weights in the planes.
    void add_curves(const Eigen::VectorXcd &weights, results::WeightsResult &result) const;

  private:
    const model::Case &_scene;
    const model::WeightsSettings &_settings;
    results::Form _form = results::Form::general;
    int _order = 1;
    model::Rotor _rotor;                   ///< with the imbalances that are already there
    std::vector<forced::Quantity> _probes; ///< what each reads

    /// A column for each set of imbalances.
    [[nodiscard]] Eigen::MatrixXcd
    readings(const std::vector<forced::ImbalanceMotions::Imbalances> &sets,
             const std::vector<model::ReadingPlace> &places) const;
    /// What a probe reads of a motion.
    [[nodiscard]] std::complex<double> read(const forced::ForcedMotion &motion,
                                            std::size_t probe) const;
    [[nodiscard]] std::vector<model::Imbalance> with_weights(const Eigen::VectorXcd &weights) const;
    /// A number with the phase of [weights] as one that leads, and back.
    [[nodiscard]] std::complex<double> turned(std::complex<double> value) const {
        return _settings.lag ? std::conj(value) : value;
    }
};

} // namespace whirl::analyses
