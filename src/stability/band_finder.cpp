#include "stability/band_finder.h"

#include "linalg/check.h"
#include "model/errors.h"
#include "process/progress.h"
#include "stability/band_confirmation.h"
#include "stability/hill/hill_motions.h"
#include "stability/periodic_motions.h"
#include "stability/range_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace whirl::stability {

namespace {

/// With so few planar unknowns nothing is gained.
constexpr int small_plane = 16;

/// With the reduced rotor; nothing where the whole one does not agree.
/// @param part  as in find_bands
std::optional<BandsFound> confirmed(const MotionsAt &reduced, const MotionsAt &at,
                                    const std::vector<double> &speeds,
                                    const PeriodicMotions *periodic = nullptr, double part = 0) {
    BandsFound found = find_bands(reduced, speeds, part);
    if (auto bands = confirmed_bands(at, found.bands, {speeds.front(), speeds.back()}, periodic))
        return BandsFound{std::move(*bands), std::move(found.doubtful)};
    return std::nullopt;
}

} // namespace

BandFinder::BandFinder(const StabilityModel &model, const balancers::Arrangement &arrangement,
                       std::shared_ptr<const Eigen::MatrixXd> shapes)
    : _model(model), _arrangement(arrangement), _whole(model, arrangement),
      _shapes(std::move(shapes)) {}

BandFinder::BandFinder(const StabilityModel &model, const balancers::Arrangement &arrangement,
                       const BandFinder &like)
    : BandFinder(model, arrangement, like._shapes) {
    if (_shapes && _shapes->rows() != _whole.discretization().planar_size())
        _shapes = nullptr; // on another mesh
}

void BandFinder::keep(const std::vector<double> &speeds) {
    for (const double speed : speeds)
        _kept.try_emplace(speed);
}

std::vector<Motion> BandFinder::at(double speed) const {
    const auto kept = _kept.find(speed);
    if (kept == _kept.end())
        return _whole.at(speed);
    if (kept->second.empty()) {
        kept->second = _whole.at(speed);
        process::report_progress(
            std::min(0.9, static_cast<double>(++_asked) / static_cast<double>(_kept.size())));
    }
    return kept->second;
}

/// None where they do not do, or are hardly fewer.
std::shared_ptr<const Eigen::MatrixXd>
BandFinder::found_shapes(const std::vector<double> &speeds) const {
    const assembly::Discretization &d = _whole.discretization();
    if (!_model.reduction || d.rigid() || d.planar_size() <= small_plane)
        return nullptr;
    try {
        if (_shapes)
            if (auto found = range_shapes(d, _model.form, _arrangement, speeds, _shapes.get()))
                return found;
        return range_shapes(d, _model.form, _arrangement, speeds);
    } catch (const linalg::SolverError &) { // bearings push away
        return nullptr;
    }
}

std::shared_ptr<const Eigen::MatrixXd> BandFinder::good_shapes(const std::vector<double> &speeds) {
    if (const PeriodicMotions *periodic = _whole.by_monodromy())
        return periodic->good_shapes(speeds);
    if (!_good)
        _shapes = found_shapes(speeds);
    _good = true;
    return _shapes;
}

bool BandFinder::enrich_for(const StabilityModel &other, const balancers::Arrangement &arrangement,
                            const std::vector<double> &speeds) {
    const assembly::Discretization d(other.rotor, other.order);
    if (!_shapes || _shapes->rows() != d.planar_size() || _whole.by_monodromy() != nullptr)
        return false;
    auto found = range_shapes(d, other.form, arrangement, speeds, _shapes.get());
    if (!found)
        return false;
    _shapes = std::move(found);
    return true;
}

BandsFound BandFinder::find(const std::vector<double> &speeds) {
    const MotionsAt whole = [this](double speed) { return at(speed); };
    if (const PeriodicMotions *periodic = _whole.by_monodromy()) {
        _shapes = periodic->good_shapes(speeds);
        if (!_shapes)
            return find_bands(whole, speeds);
        const MotionsAt reduced = [periodic](double speed) { return periodic->reduced_at(speed); };
        // Where something dies out the ends are roots, which the whole rotor's own are near.
        constexpr double roughly = 1e-3;
        if (_model.rotor.damped())
            if (const auto found = confirmed(reduced, whole, speeds, periodic, roughly))
                return *found;
        const auto found = confirmed(reduced, whole, speeds);
        return found ? *found : find_bands(whole, speeds);
    }
    _shapes = found_shapes(speeds);
    if (_shapes)
        try {
            const MotionSolver reduced_rotor(_model, _arrangement, _shapes);
            const MotionsAt reduced = [&reduced_rotor](double speed) {
                return reduced_rotor.at(speed);
            };
            if (auto found = confirmed(reduced, whole, speeds))
                return std::move(*found);
        } catch (const linalg::SolverError &) {
        } catch (const model::AnalysisFailure &) { // a speed at which the reduced one fails
        }
    return find_bands(whole, speeds);
}

} // namespace whirl::stability
