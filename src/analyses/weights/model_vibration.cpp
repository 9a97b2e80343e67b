#include "analyses/weights/model_vibration.h"

#include "balancing/weights.h"
#include "forced/response_error.h"
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
#include <map>
#include <numbers>
#include <utility>

namespace whirl::analyses {

model::Case without_balancers(const model::Case &scene) {
    model::Case bare = scene;
    bare.rotor = model::with_balancer_imbalances(bare.rotor);
    bare.rotor.balancers.clear();
    return bare;
}

namespace {

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
    _rotor = bare.rotor;
    for (const model::CorrectionPlane &plane : _rotor.planes)
        for (const std::complex<double> &weight : plane.fixed)
            _rotor.imbalances.push_back({"", plane.z, std::abs(weight), std::arg(turned(weight))});
    std::vector<forced::ImbalanceMotions::Imbalances> sets{_rotor.imbalances};
    for (const model::CorrectionPlane &plane : _rotor.planes)
        sets.push_back({{"", plane.z, 1.0, 0.0}});
    for (const double z : _settings.stations)
        _rotor.stations.push_back({z});
    const bool circles = summary.formulation.form == results::Form::planar;
    const auto readable = [&](std::optional<Readable> &out, forced::FinerMesh mesh) {
        out.emplace(Readable{{_rotor, mesh.order, summary.formulation.form, sets, mesh.parts}, {}});
        out->reads = reads_of(out->motions.discretization(), circles);
    };
    readable(_model, {summary.order, 1});
    if (!_model->motions.discretization().rigid())
        readable(_finer, forced::finer_mesh(summary.order));
    summary.elements = static_cast<int>(_model->motions.discretization().shaft_mesh().spans.size());
    summary.unknowns = _model->motions.of(0).unknowns();
}

/// @param circles  all orbits are: y is x a quarter turn later
std::vector<ModelVibration::Read> ModelVibration::reads_of(const assembly::Discretization &d,
                                                           bool circles) const {
    std::vector<Read> reads;
    for (std::size_t i = 0; i < _rotor.probes.size(); ++i)
        reads.push_back({"probe", _rotor.probe_name(i), forced::quantity_of(d, _rotor.probes[i]),
                         _rotor.probes[i].angle});
    const auto add = [&](const char *of, const std::string &name, forced::Quantity quantity,
                         double z) {
        quantity.z = z;
        for (const double angle : {0.0, std::numbers::pi / 2})
            if (angle == 0 || !circles)
                reads.push_back({of, name, quantity, angle});
    };
    for (std::size_t i = 0; i < _rotor.supports().size(); ++i) {
        const model::Bearing &bearing = _rotor.bearings[i];
        const std::string name = model::name_or_number(bearing.name, "bearing", i);
        add("bearing", name, {d.deflection_at(bearing.z)}, bearing.z);
        forced::Quantity force;
        force.bearing = static_cast<int>(i);
        add("force", name, force, bearing.z);
    }
    for (const double z : _settings.stations)
        add("station", "", {d.deflection_at(z)}, z);
    return reads;
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

bool ModelVibration::solve(double speed) {
    if (!_model->motions.solve(speed))
        return false;
    _error_known = !_finer || _finer->motions.solve_unjudged(speed);
    return true;
}

std::complex<double> ModelVibration::value(Readable &model, std::size_t set,
                                           std::size_t read) const {
    const Read &of = model.reads[read];
    const forced::Phasor motion = model.motions.of(set).of(of.quantity);
    return turned(of.of == "probe" ? motion.x : forced::reading(motion, of.angle));
}

std::optional<double> ModelVibration::error(std::size_t set, std::size_t read,
                                            std::complex<double> own) {
    if (!_error_known || own == 0.0)
        return std::nullopt;
    const double by_elements = _finer ? forced::error_share(own, value(*_finer, set, read)) : 0;
    return by_elements + _model->motions.rounding();
}

ModelVibration::AtPlaces ModelVibration::at(const std::vector<model::ReadingPlace> &places) {
    const std::size_t planes = _rotor.planes.size();
    const auto rows = static_cast<Eigen::Index>(places.size());
    AtPlaces out{Eigen::VectorXcd::Zero(rows),
                 Eigen::MatrixXcd::Zero(rows, static_cast<Eigen::Index>(planes)),
                 Eigen::MatrixXd::Constant(rows, static_cast<Eigen::Index>(planes),
                                           std::numeric_limits<double>::quiet_NaN())};
    std::optional<double> speed;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!places[i].speed)
            refuse_places(_scene, "weights.speeds: missing, expected the speed of the readings, "
                                  "which their table does not say");
        if (speed != places[i].speed) {
            speed = places[i].speed;
            if (!solve(*speed))
                refuse_resonance(*speed);
        }
        const auto row = static_cast<Eigen::Index>(i);
        for (std::size_t k = 0; k < _rotor.probes.size(); ++k) {
            if (_model->reads[k].name != places[i].probe)
                continue;
            out.vibration(row) = value(*_model, 0, k);
            for (std::size_t p = 0; p < planes; ++p) {
                const auto column = static_cast<Eigen::Index>(p);
                const std::complex<double> own = value(*_model, 1 + p, k);
                out.influence(row, column) = own;
                if (const auto share = error(1 + p, k, own))
                    out.error(row, column) = *share;
            }
        }
    }
    return out;
}

void ModelVibration::add_curves(const Eigen::VectorXcd &weights, results::WeightsResult &result) {
    result.curve_speeds = _scene.speeds->values();
    const std::size_t planes = _rotor.planes.size();
    const std::vector<Read> &reads = _model->reads;
    for (std::size_t p = 0; p < planes; ++p)
        for (const Read &read : reads)
            result.influence_curves.push_back(
                {read.of,
                 read.name,
                 read.quantity.probe ? read.quantity.probe->z : read.quantity.z,
                 read.angle,
                 _rotor.plane_name(p),
                 {},
                 {}});
    if (!result.measured)
        for (std::size_t k = 0; k < _rotor.probes.size(); ++k)
            result.curves.push_back({_rotor.probe_name(k), {}, {}});
    for (const double speed : result.curve_speeds) {
        const bool known = solve(speed);
        std::vector<std::complex<double>> before(reads.size());
        for (std::size_t k = 0; known && k < result.curves.size(); ++k)
            before[k] = value(*_model, 0, k);
        std::vector<std::complex<double>> after = before;
        for (std::size_t p = 0; p < planes; ++p) {
            std::vector<std::complex<double>> values(reads.size());
            std::map<std::string, double> largest; // of a kind of place
            for (std::size_t k = 0; known && k < reads.size(); ++k) {
                values[k] = value(*_model, 1 + p, k);
                after[k] += weights(static_cast<Eigen::Index>(p)) * values[k];
                double &most = largest[reads[k].of];
                most = std::max(most, std::abs(values[k]));
            }
            for (std::size_t k = 0; k < reads.size(); ++k) {
                const bool force = reads[k].of == "force";
                results::InfluenceCurve &curve = result.influence_curves[p * reads.size() + k];
                curve.values.emplace_back();
                curve.errors.emplace_back();
                if (!known || (force && speed == 0))
                    continue;
                const std::complex<double> own =
                    balancing::without_rounding(values[k], largest[reads[k].of]);
                curve.values.back() = own / (force ? speed * speed : 1);
                curve.errors.back() = error(1 + p, k, own);
            }
        }
        for (std::size_t k = 0; k < result.curves.size(); ++k) {
            const auto amplitude = [known](std::complex<double> value) {
                return known ? std::optional(std::abs(value)) : std::nullopt;
            };
            result.curves[k].before.push_back(amplitude(before[k]));
            result.curves[k].after.push_back(amplitude(after[k]));
        }
    }
}

} // namespace whirl::analyses
