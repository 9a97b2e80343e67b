#include "stability/band_finder.h"

#include "linalg/check.h"
#include "linalg/dense/products.h"
#include "linalg/symmetric_eigen.h"
#include "model/errors.h"
#include "process/progress.h"
#include "reduction/planar_shapes.h"
#include "stability/band_confirmation.h"
#include "stability/hill/hill_motions.h"
#include "stability/periodic_motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace whirl::stability {

namespace {

using Pairs = std::vector<linalg::ComplexPair>;

/// With so few planar unknowns nothing is gained, nor with so large a part of them.
constexpr int small = 16;
constexpr double large_part = 0.7;
/// Part of a shape that the others must lack for it to be taken in: at first, and where more is
/// needed. The errors of eigenvalues are the squares of it.
constexpr std::array newness{1e-3, 1e-5};

/// Eigenvalues of the reduced rotor as far as the search needs them, over the spin speed.
constexpr double agreeing_eigenvalues = 1e-7;
/// Motions are taken at so many speeds of the range.
constexpr std::size_t samples_of_motions = 12;
/// Least part of a motion that a shape must describe: the errors of eigenvalues are the squares.
constexpr std::array least_parts{3e-4, 1e-4, 3e-5, 1e-5};
/// Part of the shapes above which nothing is gained.
constexpr double hardly_fewer = 0.85;

struct MotionsAtSpeed {
    double speed = 0;
    Pairs pairs;
};

std::vector<MotionsAtSpeed> sampled_motions(const MotionSolver &solver,
                                            const std::vector<double> &speeds) {
    std::vector<MotionsAtSpeed> out;
    const std::size_t last = speeds.size() - 1;
    for (std::size_t k = 0; k <= samples_of_motions; ++k) {
        const double speed = speeds[last * k / samples_of_motions];
        if (speed != 0 && (out.empty() || out.back().speed != speed))
            out.push_back({speed, solver.pairs(speed)});
    }
    return out;
}

/// Sum of x x^T over the planar shapes x of all motions, over the amplitudes of r shapes.
Eigen::MatrixXd energies(const std::vector<MotionsAtSpeed> &motions, Eigen::Index r) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(r, r);
    for (const MotionsAtSpeed &at : motions)
        for (const linalg::ComplexPair &pair : at.pairs) {
            Eigen::MatrixXd parts = reduction::planar_parts(pair.vector, r, pair.vector.size());
            const double length = parts.colwise().norm().maxCoeff();
            if (!(length > 0))
                continue;
            parts /= length;
            out += linalg::times(parts, Eigen::MatrixXd(parts.transpose()));
        }
    return out;
}

/// Those of some eigenpairs that none of the others is, as far as a search for bands needs them.
std::vector<const linalg::ComplexPair *> missing(const Pairs &some, const Pairs &others,
                                                 double speed) {
    std::vector<const linalg::ComplexPair *> out;
    for (const linalg::ComplexPair &pair : some) {
        const double allowed =
            agreeing_eigenvalues * std::max(std::abs(pair.value), std::abs(speed)) +
            100 * (pair.rounding + pair.residual) * std::abs(pair.value);
        if (std::ranges::none_of(others, [&](const auto &other) {
                return apart(pair.value, other.value, 0) <= allowed;
            }))
            out.push_back(&pair);
    }
    return out;
}

/// Takes in what the motions of a rotor at some speeds lack of the shapes.
/// @param reduced  its eigenpairs at a speed, on the shapes as they are by then, which it takes
/// over
/// @returns whether these do for all of them, and are few
bool enriched(reduction::PlanarShapes &planar, const MotionSolver &whole,
              const std::vector<double> &speeds, const std::function<Pairs(double)> &reduced) {
    const Eigen::Index N = whole.discretization().planar_size();
    for (const double speed : speeds) {
        if (speed == 0)
            continue;
        const Pairs pairs = whole.pairs(speed);
        auto lacking = missing(pairs, reduced(speed), speed);
        for (const double part : newness) {
            const Eigen::Index before = planar.matrix().cols();
            for (const auto *pair : lacking)
                planar.add(reduction::planar_parts(pair->vector, N, pair->vector.size()), part);
            if (planar.matrix().cols() != before) // else nothing lacks, or nothing is new enough
                lacking = missing(pairs, reduced(speed), speed);
        }
        if (!lacking.empty() ||
            static_cast<double>(planar.matrix().cols()) > large_part * static_cast<double>(N))
            return false;
    }
    return true;
}

/// Frequency up to which shapes are to describe motions at these speeds, rad/s.
double top_of(const std::vector<double> &speeds) {
    return 2 * std::max(std::abs(speeds.front()), std::abs(speeds.back()));
}

bool same_motions(const MotionSolver &solver, const std::vector<MotionsAtSpeed> &motions) {
    return std::ranges::all_of(motions, [&solver](const MotionsAtSpeed &at) {
        return missing(at.pairs, solver.pairs(at.speed), at.speed).empty();
    });
}

/// Shapes good for one speed are added to those for another, and static deflections to both, so
/// that together they are more than the motions need. Of what they span as few as describe all
/// motions over a range of speeds equally well: the principal parts of motions at many speeds,
/// looked at again at just these and compared with those of all shapes.
/// @param all     N x r planar shapes that are good for the range
/// @param solver  on these shapes
/// @param speeds  ascending
/// @returns `all` where hardly fewer do
std::shared_ptr<const Eigen::MatrixXd>
compact_shapes(const StabilityModel &model, const balancers::Arrangement &arrangement,
               const std::shared_ptr<const Eigen::MatrixXd> &all, const MotionSolver &solver,
               const std::vector<double> &speeds) {
    const Eigen::Index r = all->cols();
    const std::vector<MotionsAtSpeed> motions = sampled_motions(solver, speeds);
    const auto principal = linalg::symmetric_eigenpairs(energies(motions, r));
    const Eigen::VectorXd &energy = principal.eigenvalues(); // ascending
    Eigen::Index tried = 0;
    for (const double part : least_parts) {
        const Eigen::Index few = (energy.array() > part * part).count();
        if (few == tried || few == 0)
            continue;
        if (static_cast<double>(few) > hardly_fewer * static_cast<double>(r))
            break;
        tried = few;
        const Eigen::MatrixXd mixtures = principal.eigenvectors().rightCols(few);
        const auto shapes = std::make_shared<const Eigen::MatrixXd>(linalg::times(*all, mixtures));
        if (same_motions(MotionSolver(model, arrangement, shapes), motions))
            return shapes;
    }
    return all;
}

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
    else if (like._good && _whole.by_monodromy() == nullptr)
        _few = like._few;
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

/// With the fewer shapes of a rotor like this one, where they do for this one too: at the largest
/// speed, and at a low one, where balls take part in other motions, they give all motions of the
/// whole rotor.
std::unique_ptr<MotionSolver> BandFinder::reduced_alike(const std::vector<double> &speeds) const {
    if (!_few)
        return nullptr;
    auto few = std::make_unique<MotionSolver>(_model, _arrangement, _few);
    const bool backward = std::abs(speeds.front()) > std::abs(speeds.back());
    const std::size_t last = speeds.size() - 1;
    for (const std::size_t place : {last, last / 4}) {
        const double speed = speeds[backward ? last - place : place];
        if (speed != 0 && !missing(_whole.pairs(speed), few->pairs(speed), speed).empty())
            return nullptr;
    }
    return few;
}

/// With shapes enough, or none where there is no such rotor.
std::unique_ptr<MotionSolver> BandFinder::reduced_for(const std::vector<double> &speeds) {
    const assembly::Discretization &d = _whole.discretization();
    _good = false;
    if (auto few = reduced_alike(speeds)) {
        _good = true;
        return few;
    }
    if (!_model.reduction || d.rigid() || d.planar_size() <= small)
        return nullptr;
    reduction::PlanarShapes planar(d, top_of(speeds));
    if (_shapes)
        planar.add(*_shapes, newness.back());
    std::unique_ptr<MotionSolver> out;
    const auto take = [&] {
        _shapes = std::make_shared<Eigen::MatrixXd>(planar.matrix());
        out = std::make_unique<MotionSolver>(_model, _arrangement, _shapes);
    };
    take();
    const auto reduced = [&](double speed) {
        if (planar.matrix().cols() != _shapes->cols())
            take();
        return out->pairs(speed);
    };
    const std::size_t last = speeds.size() - 1;
    if (!enriched(
            planar, _whole,
            {speeds[last], speeds[0], speeds[last / 2], speeds[last / 4], speeds[3 * last / 4]},
            reduced))
        return nullptr;
    _good = true;
    _few = compact_shapes(_model, _arrangement, _shapes, *out, speeds);
    return _few == _shapes ? std::move(out)
                           : std::make_unique<MotionSolver>(_model, _arrangement, _few);
}

std::shared_ptr<const Eigen::MatrixXd> BandFinder::good_shapes(const std::vector<double> &speeds) {
    if (const PeriodicMotions *periodic = _whole.by_monodromy())
        return periodic->good_shapes(speeds);
    try {
        if (!_good)
            (void)reduced_for(speeds);
    } catch (const linalg::SolverError &) {
    } catch (const model::AnalysisFailure &) {
    }
    return _good ? _few : nullptr;
}

bool BandFinder::enrich_for(const StabilityModel &other, const balancers::Arrangement &arrangement,
                            const std::vector<double> &speeds) {
    const MotionSolver whole(other, arrangement);
    if (!_good || _few->rows() != whole.discretization().planar_size() ||
        whole.by_monodromy() != nullptr)
        return false;
    reduction::PlanarShapes planar(whole.discretization(), top_of(speeds), *_few);
    Eigen::Index taken = planar.matrix().cols();
    const auto reduced = [&](double speed) {
        if (planar.matrix().cols() != taken) {
            _few = std::make_shared<const Eigen::MatrixXd>(planar.matrix());
            taken = _few->cols();
        }
        return MotionSolver(other, arrangement, _few).pairs(speed);
    };
    if (!enriched(planar, whole, speeds, reduced))
        return false;
    _shapes = _few;
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
    try {
        if (const std::unique_ptr<MotionSolver> few = reduced_for(speeds)) {
            const MotionsAt reduced = [&few](double speed) { return few->at(speed); };
            if (auto found = confirmed(reduced, whole, speeds))
                return std::move(*found);
        }
    } catch (const linalg::SolverError &) {    // no such shapes
    } catch (const model::AnalysisFailure &) { // a speed at which the reduced one fails
    }
    return find_bands(whole, speeds);
}

} // namespace whirl::stability
