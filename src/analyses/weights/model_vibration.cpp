#include "analyses/weights/model_vibration.h"

#include "forced/response_places.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "model/variants.h"
#include "results/sentence.h"
#include "rigid/inertia.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::analyses {

namespace {

model::Case without_balancers(const model::Case &scene) {
    model::Case bare = scene; // the response leaves balancers out
    bare.rotor = model::with_balancer_imbalances(bare.rotor);
    bare.rotor.balancers.clear();
    return bare;
}

/// What the probe reads: the shaft, against its pedestal or not, or the pedestal.
std::complex<double> read(const forced::ForcedMotion &motion, const assembly::Discretization &d,
                          const model::Probe &probe) {
    return forced::reading(motion.motion(forced::stretch_of_probe(d, probe)), probe.angle);
}

[[noreturn]] void refuse_places(const model::Case &scene, const std::string &problem) {
    throw model::BadInput(fmt::format("{}: {}", scene.file.string(), problem));
}

/// A speed at which an undamped rotor has no steady motion.
[[noreturn]] void refuse_resonance(double speed) {
    throw model::AnalysisFailure(results::Sentence(
        "no steady motion at {}: the rotor is at a resonance without damping, where no weights "
        "can be found; choose another speed (weights.speeds)",
        results::as::speed(speed)));
}

} // namespace

double centre_of_mass(const model::Rotor &rotor) { return rigid::inertia_of(rotor).center(); }

ModelVibration::ModelVibration(const model::Case &scene, results::ModelSummary &summary)
    : _scene(scene), _settings(*scene.weights) {
    const model::Case bare = without_balancers(scene);
    if (scene.rotor.probes.empty())
        refuse_places(scene, "probe: missing, expected at least one [[probe]] whose vibration is "
                             "to be made small");
    if (bare.rotor.rotating_anisotropy())
        throw model::AnalysisFailure(
            "a weight moves a rotor that is not the same from every direction ([[anisotropy]], two "
            "bending stiffnesses, held balls) by more or less as it stands to the rotor's axes: it "
            "has no influence coefficients");
    summary.formulation = forced::response_formulation(bare);
    summary.order = mesh_error::resolve_order_in_best_form(bare);
    _form = summary.formulation.form;
    _order = summary.order;
    _rotor = bare.rotor;
    for (const model::CorrectionPlane &plane : _rotor.planes)
        for (const std::complex<double> &weight : plane.fixed)
            _rotor.imbalances.push_back({"", plane.z, std::abs(weight), std::arg(turned(weight))});
    for (const model::Imbalance &imbalance : _rotor.imbalances)
        _rotor.stations.push_back({imbalance.z});
    const assembly::Discretization d = discretized(_rotor.imbalances);
    summary.elements = static_cast<int>(d.shaft_mesh().spans.size());
    summary.unknowns = forced::ForcedMotion(d, _form).unknowns();
}

assembly::Discretization
ModelVibration::discretized(const std::vector<model::Imbalance> &imbalances) const {
    model::Rotor rotor = _rotor;
    rotor.imbalances = imbalances;
    return {rotor, _order};
}

std::vector<model::ReadingPlace> ModelVibration::places() const {
    if (_settings.speeds.empty())
        refuse_places(_scene, "weights.speeds: missing, expected the speeds at which the vibration "
                              "is to be made small");
    if (_rotor.imbalances.empty())
        refuse_places(_scene, "imbalance: expected at least one [[imbalance]], or readings "
                              "(weights.readings), got none: nothing is to be balanced");
    std::vector<model::ReadingPlace> places;
    for (const double speed : _settings.speeds)
        for (std::size_t i = 0; i < _rotor.probes.size(); ++i) {
            double factor = 1;
            for (const auto &[name, own] : _settings.factors)
                if (name == _rotor.probe_name(i))
                    factor = own;
            places.push_back({_rotor.probe_name(i), speed, factor});
        }
    return places;
}

Eigen::VectorXcd ModelVibration::readings(const assembly::Discretization &d,
                                          const std::vector<model::ReadingPlace> &places) const {
    Eigen::VectorXcd out(static_cast<Eigen::Index>(places.size()));
    forced::ForcedMotion motion(d, _form);
    std::optional<double> speed;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!places[i].speed)
            refuse_places(_scene, "weights.speeds: missing, expected the speed of the readings, "
                                  "which their table does not say");
        if (speed != places[i].speed) {
            speed = places[i].speed;
            if (!forced::solves(motion, *speed) ||
                !(motion.rounding() <= forced::resonance_rounding))
                refuse_resonance(*speed);
        }
        for (std::size_t k = 0; k < _rotor.probes.size(); ++k)
            if (_rotor.probe_name(k) == places[i].probe)
                out(static_cast<Eigen::Index>(i)) = turned(read(motion, d, _rotor.probes[k]));
    }
    return out;
}

Eigen::MatrixXcd ModelVibration::influence(const std::vector<model::ReadingPlace> &places) const {
    Eigen::MatrixXcd H(static_cast<Eigen::Index>(places.size()),
                       static_cast<Eigen::Index>(_rotor.planes.size()));
    for (Eigen::Index p = 0; p < H.cols(); ++p)
        H.col(p) = readings(
            discretized({{"", _rotor.planes[static_cast<std::size_t>(p)].z, 1.0, 0.0}}), places);
    return H;
}

Eigen::VectorXcd ModelVibration::vibration(const std::vector<model::ReadingPlace> &places) const {
    return readings(discretized(_rotor.imbalances), places);
}

std::vector<model::Imbalance> ModelVibration::with_weights(const Eigen::VectorXcd &weights) const {
    std::vector<model::Imbalance> all = _rotor.imbalances;
    for (std::size_t p = 0; p < _rotor.planes.size(); ++p) {
        const std::complex<double> own = turned(weights(static_cast<Eigen::Index>(p)));
        all.push_back({"", _rotor.planes[p].z, std::abs(own), std::arg(own)});
    }
    return all;
}

void ModelVibration::add_curves(const Eigen::VectorXcd &weights,
                                results::WeightsResult &result) const {
    result.curve_speeds = _scene.speeds->values();
    const assembly::Discretization before = discretized(_rotor.imbalances);
    const assembly::Discretization after = discretized(with_weights(weights));
    forced::ForcedMotion motion_before(before, _form), motion_after(after, _form);
    for (std::size_t k = 0; k < _rotor.probes.size(); ++k)
        result.curves.push_back({_rotor.probe_name(k), {}, {}});
    for (const double speed : result.curve_speeds) {
        const auto solve = [speed](forced::ForcedMotion &motion) {
            return forced::solves(motion, speed) && motion.rounding() <= forced::resonance_rounding;
        };
        const bool known_before = solve(motion_before), known_after = solve(motion_after);
        for (std::size_t k = 0; k < _rotor.probes.size(); ++k) {
            const model::Probe &probe = _rotor.probes[k];
            const auto amplitude = [&](const forced::ForcedMotion &motion,
                                       const assembly::Discretization &d, bool known) {
                return known ? std::optional(std::abs(read(motion, d, probe))) : std::nullopt;
            };
            result.curves[k].before.push_back(amplitude(motion_before, before, known_before));
            result.curves[k].after.push_back(amplitude(motion_after, after, known_after));
        }
    }
}

} // namespace whirl::analyses
