#include "ends/permissible.h"

#include "assembly/rotating_system.h"
#include "ends/all_motions.h"
#include "ends/band_ends.h"
#include "linalg/check.h"
#include "linalg/sparse_factor.h"
#include "model/case.h"
#include "model/errors.h"
#include "results/formulation.h"
#include "rigid/anisotropy.h"
#include "stability/anisotropy_limit.h"
#include "stability/band_finder.h"
#include "stability/hill/closing_bands.h"
#include "stability/hill/periodic_motions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::ends {

namespace {

using stability::StabilityModel;

StabilityModel model_with(StabilityModel model, std::size_t index, double dI) {
    model.rotor.anisotropies[index].dI = dI;
    return model;
}

/// The dI at which the mass matrix becomes singular: along the axis of smaller inertia the node
/// has 1/(e^T M^-1 e) to lose.
double singular_anisotropy(const StabilityModel &model, std::size_t index,
                           const balancers::Arrangement &arrangement) {
    const model::Rotor without = model_with(model, index, 0).rotor;
    const assembly::Discretization d(without, model.order);
    const assembly::RotatingSystem system =
        assembly::assemble_rotating(d, 0, balancers::balancer_elements(without, arrangement));
    const Eigen::SparseMatrix<double> M = system.M.view();
    linalg::SparseFactor<double> factors;
    if (!factors.factorize(M))
        throw linalg::SolverError("the mass matrix is singular");
    const model::Anisotropy &anisotropy = model.rotor.anisotropies[index];
    double least = std::numeric_limits<double>::infinity();
    for (const double turn : {0.0, std::acos(0.0)}) {
        Eigen::VectorXd e = Eigen::VectorXd::Zero(M.rows());
        for (const auto &[unknown, value] : d.slope_at(anisotropy.z)) {
            e(2 * unknown) += value * std::cos(anisotropy.angle + turn);
            e(2 * unknown + 1) += value * std::sin(anisotropy.angle + turn);
        }
        const Eigen::VectorXd response = factors.solution(e);
        least = std::min(least, 1 / std::max(e.dot(response), 1e-300));
    }
    return least;
}

/// One element of a rotor with its dI varied.
class Varied {
  public:
    /// @param shapes  good for the rotor as it is, or none
    Varied(const StabilityModel &model, const balancers::Arrangement &arrangement,
           std::size_t index, std::shared_ptr<const Eigen::MatrixXd> shapes)
        : _model(model), _arrangement(arrangement), _index(index), _shapes(std::move(shapes)) {}

    [[nodiscard]] bool periodic() const { return _model.form == results::Form::hill; }
    [[nodiscard]] bool by_monodromy() const { return periodic() && _model.harmonics == 0; }

    /// Largest real part over the speed, 1/s.
    using GrowthAt = std::function<double(double speed)>;

    /// With the basis and the steps in time of another dI, where there are some: the final search
    /// verifies with its own.
    /// @param range  of the speeds that it will be asked for
    [[nodiscard]] GrowthAt growth(double dI, const results::Interval &range) const {
        return [rotor = rotor_with(dI, range)](double speed) { return rotor->at(speed); };
    }
    [[nodiscard]] double growth_at(double speed, double dI) const {
        return rotor_with(dI, {speed, speed})->at(speed);
    }

    /// Without damping the smallest anisotropy opens a band at every critical speed that it splits.
    [[nodiscard]] bool splits_critical_speeds(double dI, double top) const {
        if (_model.form != results::Form::rotating)
            return false;
        const auto count = [&](double value) {
            const assembly::Discretization d(model_with(value).rotor, _model.order);
            return stability::zero_root_speeds(d, _arrangement, true, top).size();
        };
        try {
            return count(dI) > count(0);
        } catch (const linalg::SolverError &) { // not decided: the search below decides
            return false;
        }
    }

    /// The dI between a stable and an unstable one at which this speed is just stable.
    [[nodiscard]] double just_stable(double speed, double stable, double unstable) const {
        return stability::border_of_growth(
            [this, speed](double dI) { return growth_at(speed, dI); }, stable, unstable,
            1e-12 * unstable);
    }

    /// At one speed: the largest dI below which no motion grows; none: stable up to `largest`.
    /// Growth that ceases again within a step is passed over.
    [[nodiscard]] std::optional<double> least_growing(double speed, double largest) const {
        // Of the range of dI: growth that ceases within one is passed over.
        constexpr int steps = 40;
        if (growth_at(speed, 0) > 0)
            return 0;
        for (int k = 1; k <= steps; ++k)
            if (growth_at(speed, largest * k / steps) > 0)
                return just_stable(speed, largest * (k - 1) / steps, largest * k / steps);
        return std::nullopt;
    }

    [[nodiscard]] std::vector<results::Interval> bands(double dI,
                                                       const std::vector<double> &speeds) const {
        stability::BandFinder finder(model_with(dI), _arrangement, _shapes);
        if (!periodic()) {
            _shapes = finder.good_shapes(speeds);
            return swept_bands(dI, {speeds.front(), speeds.back()});
        }
        std::vector<results::Interval> found = finder.find(speeds).bands;
        _shapes = finder.shapes();
        return found;
    }

    /// The same, on the way to an answer that is verified.
    [[nodiscard]] std::vector<results::Interval>
    likely_bands(double dI, const std::vector<double> &speeds) const {
        if (!periodic())
            return swept_bands(dI, {speeds.front(), speeds.back()});
        if (!by_monodromy() || !_shapes)
            return bands(dI, speeds);
        // Of a band's width: on the way only whether there are bands matters.
        constexpr double roughly = 0.03;
        const auto rotor = rotor_with(dI, {speeds.front(), speeds.back()});
        return stability::find_bands([&rotor](double speed) { return rotor->hill().at(speed); },
                                     speeds, roughly)
            .bands;
    }

    [[nodiscard]] bool stable(double dI, const std::vector<double> &speeds) const {
        return bands(dI, speeds).empty();
    }

    /// The dI at which the last band of an unstable one closes, where bands can be followed.
    [[nodiscard]] std::optional<double> closing(double unstable,
                                                const std::vector<double> &speeds) const {
        if (!periodic())
            return std::nullopt;
        stability::BandFinder finder(model_with(unstable), _arrangement);
        if (!stability::bands_can_be_followed(finder))
            return std::nullopt;
        std::vector<results::Interval> open = finder.find(speeds).bands;
        return stability::closing_anisotropy([this](double dI) { return model_with(dI); }, unstable,
                                             finder, std::move(open), speeds);
    }

  private:
    const StabilityModel &_model;
    const balancers::Arrangement &_arrangement;
    std::size_t _index;
    mutable std::shared_ptr<const Eigen::MatrixXd> _shapes; ///< good for one dI, a start for others
    std::shared_ptr<stability::StepExperience> _experience =
        std::make_shared<stability::StepExperience>();

    /// Bands of the reduced rotor in which the whole one grows too: one that has just closed can
    /// still be open on the shapes.
    [[nodiscard]] std::vector<results::Interval> swept_bands(double dI,
                                                             const results::Interval &range) const {
        const auto rotor = rotor_with(dI, range);
        std::vector<results::Interval> found = bands_of(find_ends(rotor->motions()), range);
        std::erase_if(found, [&rotor](const results::Interval &band) {
            constexpr double inside = 1e-6; // of the speed
            const auto [from, to] = band;
            const double off = std::min((to - from) / 4, inside * std::abs(from));
            return std::ranges::none_of(std::array{(from + to) / 2, from + off, to - off},
                                        [&](double speed) { return rotor->at(speed) > 0; });
        });
        return found;
    }

    [[nodiscard]] std::shared_ptr<const Growth> rotor_with(double dI,
                                                           const results::Interval &range) const {
        StabilityModel model = model_with(dI);
        model.experience = _experience;
        return std::make_shared<const Growth>(model, _arrangement, _shapes, range);
    }

    [[nodiscard]] StabilityModel model_with(double dI) const {
        return ends::model_with(_model, _index, dI);
    }
};

/// The search by descent and its outcome.
struct Descent {
    std::optional<double> dI; ///< none: stable up to the largest
    double unstable = 0;      ///< least dI that was found to be unstable
    double speed = 0;         ///< rad/s, at which dI is just stable
};

class DescentSearch {
  public:
    DescentSearch(const Varied &varied, double largest, const std::vector<double> &speeds)
        : _varied(varied), _largest(largest), _speeds(speeds), _dI(largest) {}

    Descent descent() {
        if (_varied.periodic())
            for (const double speed : _speeds) // what grows at the speeds themselves is no search's
                lower_at(speed);
        for (int step = 0; step < most_steps; ++step) {
            std::vector<results::Interval> bands = _varied.likely_bands(_dI, _speeds);
            if (bands.empty() && step == 0) // which is an answer
                bands = _varied.bands(_dI, _speeds);
            if (bands.empty() || !close(bands) || !follow())
                break;
        }
        if (_dI < 1e-7 * _largest)
            _out.dI = 0; // the smallest anisotropy is too much
        return _out;
    }

  private:
    static constexpr int most_steps = 40; ///< a guard: each closes the widest band that is left
    const Varied &_varied;
    double _largest;
    const std::vector<double> &_speeds;
    double _dI;
    Descent _out;
    results::Interval _last; ///< the band that was closed last

    /// Lowers dI until this speed is just stable.
    /// @returns whether it was not
    bool lower_at(double speed) {
        if (!(_varied.growth_at(speed, _dI) > 0))
            return false;
        const double stable = _varied.just_stable(speed, 0, _dI);
        _out.unstable = _dI;
        _out.speed = speed;
        const bool lower = stable < _dI;
        _dI = stable;
        _out.dI = _dI;
        return lower;
    }

    /// Lowers dI until the strongest speed of each band is just stable.
    /// @returns whether it is worthwhile to go on
    bool close(const std::vector<results::Interval> &bands) {
        const Varied::GrowthAt growth = _varied.growth(_dI, {bands.front().from, bands.back().to});
        const double before = _dI;
        for (const results::Interval &band : bands) {
            const double speed = stability::strongest_speed(growth, band);
            if (lower_at(speed))
                _last = band;
        }
        const bool unchanged = before - _dI < 1e-11 * before;
        return !unchanged && _dI >= 1e-9 * _largest;
    }

    /// The last band alone until it closes: what remains lies in or next to it.
    /// @returns whether it is worthwhile to look at the others
    bool follow() {
        if (!_varied.periodic()) { // its strongest speed moves on as it narrows
            for (int step = 0; step < most_steps && close({_last}); ++step)
                ;
            return _dI >= 1e-9 * _largest;
        }
        if (!_varied.by_monodromy())
            return true;
        for (int step = 0; step < most_steps; ++step) {
            const auto [from, to] = _last;
            const double low = std::max(from - (to - from), _speeds.front());
            const double high = std::min(to + (to - from), _speeds.back());
            std::vector<double> near{low, from, (from + to) / 2, to, high};
            near.erase(std::unique(near.begin(), near.end()), near.end());
            const std::vector<results::Interval> bands = _varied.likely_bands(_dI, near);
            if (bands.empty())
                return true;
            if (!close(bands))
                return _dI >= 1e-9 * _largest && step > 0;
        }
        return true;
    }
};

/// Some speeds about one, within the range of others.
std::vector<double> around(double speed, const std::vector<double> &speeds) {
    constexpr double near = 0.01; // of the speed: the band that just opens is narrower
    const auto within = [&speeds](double at) {
        return std::clamp(at, speeds.front(), speeds.back());
    };
    std::vector<double> out{within(speed - near * std::abs(speed)), speed,
                            within(speed + near * std::abs(speed))};
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// Verified by the band search: no band at the dI found, one just above it. Where it does not
/// agree, bisection by the band search itself.
double verified(const Varied &varied, const Descent &found, const std::vector<double> &speeds) {
    constexpr double margin = 1e-9; // of dI: bands that are just closed are still seen by rounding
    constexpr double above = 1e-6;  // far enough that a band is seen
    // Between a dI without bands among these speeds and one with.
    const auto halved = [&varied](double stable, double unstable, const std::vector<double> &at) {
        while (unstable - stable > above * unstable) {
            const double middle = (stable + unstable) / 2;
            (varied.stable(middle, at) ? stable : unstable) = middle;
        }
        return stable;
    };
    double stable = *found.dI * (1 - margin);
    double unstable = found.unstable;
    if (!varied.stable(stable, speeds)) {
        unstable = stable;
        for (stable *= 1 - above; stable > 0 && !varied.stable(stable, speeds); stable *= 0.5)
            unstable = stable;
        return halved(stable, unstable, speeds);
    }
    stable = *found.dI * (1 + above);
    const std::vector<double> near = around(found.speed, speeds);
    if (stable >= unstable || varied.growth_at(found.speed, stable) > 0 ||
        !varied.stable(stable, near))
        return *found.dI;
    // Where the shaft hardly takes part, growth just above is hidden by rounding. It shows first
    // where it was found to begin, most likely; that it is nowhere else before is looked at once.
    const double nearby = halved(stable, unstable, near);
    if (varied.stable(nearby, speeds))
        return nearby;
    return varied.stable(stable, speeds) ? halved(stable, nearby, speeds) : *found.dI;
}

/// Fewer of many: the search for bands looks between them by itself.
std::vector<double> thinned(const std::vector<double> &speeds, std::size_t enough) {
    const std::size_t every = std::max<std::size_t>(1, (speeds.size() - 1) / (enough - 1));
    std::vector<double> out;
    for (std::size_t k = 0; k + 1 < speeds.size(); k += every)
        out.push_back(speeds[k]);
    out.push_back(speeds.back());
    return out;
}

std::optional<double> permissible(const Varied &varied, double largest, bool undamped,
                                  const std::vector<double> &speeds) {
    const double top = std::max(std::abs(speeds.front()), std::abs(speeds.back()));
    if (undamped && varied.splits_critical_speeds(1e-3 * largest, top))
        return 0;
    constexpr std::size_t few = 41; // on the way; what comes out is verified
    const std::vector<double> coarse = thinned(speeds, few);
    const Descent found = DescentSearch(varied, largest, coarse).descent();
    if (!found.dI || *found.dI == 0)
        return found.dI;
    const std::optional<double> closing = varied.closing(found.unstable, speeds);
    return closing ? *closing : verified(varied, found, speeds);
}

} // namespace

std::vector<results::PermissibleAnisotropy>
permissible_anisotropies(const stability::BandFinder &finder, const std::vector<double> &grid,
                         const std::vector<results::Interval> &bands) {
    const StabilityModel &model = finder.model();
    const balancers::Arrangement &arrangement = finder.arrangement();
    const model::Rotor &rotor = model.rotor;
    constexpr std::size_t enough = 101; // speeds: as many as search_speeds() takes at least
    const std::vector<double> speeds = grid.size() == 1 ? grid : thinned(grid, enough);
    std::vector<results::PermissibleAnisotropy> out;
    for (std::size_t i = 0; i < rotor.anisotropies.size(); ++i) {
        const model::Anisotropy &element = rotor.anisotropies[i];
        const double singular = singular_anisotropy(model, i, arrangement);
        const stability::AnisotropyLimit limit =
            stability::anisotropy_limit(assembly::Discretization(rotor, model.order), i);
        const double largest = std::min(0.999 * singular, limit.dI);
        Varied varied(model, arrangement, i,
                      model.form == results::Form::hill ? nullptr : finder.shapes());
        results::PermissibleAnisotropy entry{element.z, element.name, 0.0,
                                             {},        largest,      limit.of_disc};
        if (largest > 0 && speeds.size() == 1)
            entry.dI = varied.least_growing(speeds.front(), largest);
        else if (largest > 0)
            entry.dI =
                stability::closing_anisotropy([&](double dI) { return model_with(model, i, dI); },
                                              element.dI, finder, bands, speeds);
        if (largest > 0 && speeds.size() > 1 && !entry.dI)
            entry.dI = permissible(varied, largest, !rotor.damped(), speeds);
        entry.closed_form =
            rigid::rigid_permissible_anisotropy(rotor, speeds.front(), speeds.back());
        out.push_back(entry);
    }
    return out;
}

} // namespace whirl::ends
