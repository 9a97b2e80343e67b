#pragma once

#include "forced/forced_motion.h"
#include "forced/imbalance_motions.h"
#include "model/case.h"
#include "model/weights.h"
#include "results/weights.h"

#include <Eigen/Core>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// z of the centre of mass of what turns, m.
[[nodiscard]] double centre_of_mass(const model::Rotor &rotor);

/// The case as its response is computed: without balancers, with the imbalances they are for.
[[nodiscard]] model::Case without_balancers(const model::Case &scene);

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

    struct AtPlaces {
        /// Under the imbalances of the case, those its balancers are for and the weights that are
        /// set, m.
        Eigen::VectorXcd vibration;
        Eigen::MatrixXcd influence; ///< under a unit imbalance in each plane, m/(kg m)
        Eigen::MatrixXd error;      ///< of that, relative; NaN: not known
    };
    [[nodiscard]] AtPlaces at(const std::vector<model::ReadingPlace> &places);

    /// Adds over the speeds of the case what each place does for a unit weight in each plane, and,
    /// without readings, amplitudes of the probes without and with weights in the planes.
    void add_curves(const Eigen::VectorXcd &weights, results::WeightsResult &result);

  private:
    /// What is read of a motion, in one direction.
    struct Read {
        std::string of, name;
        forced::Quantity quantity;
        double angle = 0; ///< rad; a probe's quantity has its direction in it
    };

    const model::Case &_scene;
    const model::WeightsSettings &_settings;
    model::Rotor _rotor; ///< with the imbalances that are already there
    /// A rotor under those, then under a unit in each plane, and what is read of it, probes first.
    struct Readable {
        forced::ImbalanceMotions motions;
        std::vector<Read> reads;
    };
    std::optional<Readable> _model;
    /// Of more unknowns, to tell errors by; none of a rigid shaft, which has no elements.
    std::optional<Readable> _finer;
    bool _error_known = true;

    [[nodiscard]] std::vector<Read> reads_of(const assembly::Discretization &d, bool circles) const;
    /// False at a resonance without damping.
    [[nodiscard]] bool solve(double speed);
    /// Under a set of imbalances, at the speed solved last.
    [[nodiscard]] std::complex<double> value(Readable &model, std::size_t set,
                                             std::size_t read) const;
    /// Relative error of a value of the model; none: not known, or it is zero.
    [[nodiscard]] std::optional<double> error(std::size_t set, std::size_t read,
                                              std::complex<double> value);
    /// A number with the phase of [weights] as one that leads, and back.
    [[nodiscard]] std::complex<double> turned(std::complex<double> value) const {
        return _settings.lag ? std::conj(value) : value;
    }
};

} // namespace whirl::analyses
