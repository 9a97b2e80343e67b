#include "stability/band_finder.h"

#include "linalg/check.h"
#include "model/errors.h"
#include "process/progress.h"
#include "stability/hill/band_confirmation.h"
#include "stability/hill/hill_motions.h"
#include "stability/hill/periodic_motions.h"
#include "stability/range_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace whirl::stability {

namespace {

/// With so few planar unknowns nothing is gained.
constexpr int small = 16;

} // namespace

BandFinder::BandFinder(const StabilityModel &model, const balancers::Arrangement &arrangement,
                       std::shared_ptr<const Eigen::MatrixXd> shapes)
    : _model(model), _arrangement(arrangement), _discretization(model.rotor, model.order),
      _shapes(std::move(shapes)) {
    if (model.form == results::Form::hill)
        _hill.emplace(model, arrangement);
}

BandFinder::BandFinder(const StabilityModel &model, const balancers::Arrangement &arrangement,
                       const BandFinder &like)
    : BandFinder(model, arrangement, like._shapes) {
    if (_shapes && _shapes->rows() != _discretization.planar_size())
        _shapes = nullptr; // on another mesh
}

int BandFinder::unknowns() const {
    return _hill ? _hill->unknowns()
                 : 2 * (_discretization.planar_size() +
                        balancers::unknowns_of(
                            balancers::balancer_elements(_model.rotor, _arrangement)));
}

void BandFinder::keep(const std::vector<double> &speeds) {
    for (const double speed : speeds)
        _kept.try_emplace(speed);
}

std::vector<Motion> BandFinder::at(double speed) const {
    const auto kept = _kept.find(speed);
    if (kept == _kept.end())
        return _hill->at(speed);
    if (kept->second.empty()) {
        kept->second = _hill->at(speed);
        process::report_progress(
            std::min(0.9, static_cast<double>(++_asked) / static_cast<double>(_kept.size())));
    }
    return kept->second;
}

/// None where they do not do, or are hardly fewer.
std::shared_ptr<const Eigen::MatrixXd>
BandFinder::found_shapes(const std::vector<double> &speeds) const {
    const assembly::Discretization &d = _discretization;
    if (!_model.reduction || d.rigid() || d.planar_size() <= small)
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
    if (_hill)
        return _hill->by_monodromy() ? _hill->by_monodromy()->good_shapes(speeds) : nullptr;
    if (!_good)
        _shapes = found_shapes(speeds);
    _good = true;
    return _shapes;
}

bool BandFinder::enrich_for(const StabilityModel &other, const balancers::Arrangement &arrangement,
                            const std::vector<double> &speeds) {
    const assembly::Discretization d(other.rotor, other.order);
    if (!_shapes || _shapes->rows() != d.planar_size())
        return false;
    auto found = range_shapes(d, other.form, arrangement, speeds, _shapes.get());
    if (!found)
        return false;
    _shapes = std::move(found);
    return true;
}

BandsFound BandFinder::find(const std::vector<double> &speeds) {
    const MotionsAt whole = [this](double speed) { return at(speed); };
    const PeriodicMotions *const periodic = _hill->by_monodromy();
    if (periodic != nullptr)
        _shapes = periodic->good_shapes(speeds);
    if (periodic == nullptr || !_shapes)
        return find_bands(whole, speeds);
    // With the reduced rotor; nothing where the whole one does not agree.
    const auto confirmed = [&](const PeriodicMotions *ends, double part) {
        BandsFound found = find_bands(
            [periodic](double speed) { return periodic->reduced_at(speed); }, speeds, part);
        auto bands = confirmed_bands(whole, found.bands, {speeds.front(), speeds.back()}, ends);
        return bands ? std::optional(BandsFound{std::move(*bands), std::move(found.doubtful)})
                     : std::nullopt;
    };
    // Where something dies out the ends are roots, which the whole rotor's own are near.
    constexpr double roughly = 1e-3;
    if (_model.rotor.damped())
        if (auto found = confirmed(periodic, roughly))
            return std::move(*found);
    auto found = confirmed(nullptr, 0);
    return found ? std::move(*found) : find_bands(whole, speeds);
}

} // namespace whirl::stability
