#include "modes/hill/floquet_shapes.h"

#include "assembly/hill_system.h"
#include "modes/hill/floquet_spectrum.h"
#include "modes/hill/series_modes_near.h"
#include "modes/rotating_spectrum.h"
#include "reduction/planar_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

/// With so few planar unknowns nothing is gained by a reduction, nor with so large a part of them.
constexpr int few_unknowns = 16;
constexpr double hardly_fewer = 0.7;
/// Of the largest speed.
constexpr std::array shares{1.0, 0.04, 0.5, 0.25, 0.75, 0.12};
/// Of the speed or the eigenvalue. Narrow bands need the first; where some motions die out far
/// within half a turn a spectrum costs more, the more the more shapes there are.
constexpr double agreement = 1e-6;
constexpr double agreement_if_lost = 1e-5;
/// For the number of harmonics of the series that modes are written in: vectors are not asked for.
constexpr int few_harmonics = 1;

/// A motion of the whole rotor that the shapes must have.
struct Wanted {
    double speed = 0; ///< rad/s
    std::complex<double> value;
    double noise = 0;
    Eigen::MatrixXd parts; ///< its planar shapes, N x any number

    [[nodiscard]] bool is(std::complex<double> other, double near) const {
        return std::abs(other - value) <=
               near * std::max(std::abs(speed), std::abs(value)) + 10 * noise;
    }
};

class Search {
  public:
    Search(const assembly::Discretization &d,
           const std::vector<balancers::BalancerElement> &balancers,
           const periodic::WholeRotor &whole, double top, int wanted)
        : _d(d), _balancers(balancers), _whole(whole), _top(top), _wanted(wanted),
          _planar(d, 2 * std::abs(top), wanted) {}

    std::shared_ptr<const Eigen::MatrixXd> run() {
        // Rounds in which motions that the shapes lack at a speed are added.
        constexpr int tries = 8;
        choose_speeds();
        for (const double speed : _speeds)
            for (int attempt = 0; attempt < tries && !meets_at(speed); ++attempt)
                if (static_cast<double>(_planar.matrix().cols()) >
                    static_cast<double>(_d.planar_size() - 1))
                    return nullptr;
        keep_principal();
        if (static_cast<double>(_planar.matrix().cols()) >
            hardly_fewer * static_cast<double>(_d.planar_size()))
            return nullptr;
        return std::make_shared<const Eigen::MatrixXd>(_planar.matrix());
    }

  private:
    const assembly::Discretization &_d;
    const std::vector<balancers::BalancerElement> &_balancers;
    const periodic::WholeRotor &_whole;
    double _top;
    int _wanted;
    reduction::PlanarShapes _planar;
    std::vector<double> _speeds;
    std::vector<Wanted> _met;
    double _near = agreement;

    /// Of slow speeds those at which the matrix resolves all motions: nearer to rest these add to
    /// the same shapes, and it takes long to follow them there.
    void choose_speeds() {
        constexpr double slowest = 1.01; // of slow(), from which motions are followed down
        const auto shapes = std::make_shared<const Eigen::MatrixXd>(_planar.matrix());
        const RotatingSpectrum rotor(_d, 0, _balancers, few_harmonics, shapes.get());
        const FloquetSpectrum spectrum(_d, rotor, _balancers, shapes);
        const double slow = std::min(slowest * spectrum.slow(), std::abs(_top));
        for (const double share : shares) {
            const double speed = std::copysign(std::max(share * std::abs(_top), slow), _top);
            if (std::find(_speeds.begin(), _speeds.end(), speed) == _speeds.end())
                _speeds.push_back(speed);
            if (spectrum.loses_to_rounding(speed, _wanted))
                _near = agreement_if_lost;
        }
    }

    [[nodiscard]] std::vector<WhirlMode> modes(double speed) const {
        const auto shapes = std::make_shared<const Eigen::MatrixXd>(_planar.matrix());
        const RotatingSpectrum rotor(_d, 0, _balancers, few_harmonics, shapes.get());
        std::vector<WhirlMode> out =
            FloquetSpectrum(_d, rotor, _balancers, shapes).modes(speed, _wanted).modes;
        std::stable_sort(out.begin(), out.end(), [](const auto &a, const auto &b) {
            return std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
        });
        if (static_cast<int>(out.size()) > _wanted)
            out.resize(static_cast<std::size_t>(_wanted));
        return out;
    }

    /// Planar shapes of a motion without those that are as small beside the largest: roots are off
    /// by the squares.
    [[nodiscard]] Eigen::MatrixXd above(double part, Eigen::MatrixXd parts) const {
        const Eigen::RowVectorXd squares =
            parts.cwiseProduct(_planar.metric() * parts).colwise().sum();
        for (Eigen::Index j = 0; j < parts.cols(); ++j)
            if (!(squares(j) > part * part * squares.maxCoeff()))
                parts.col(j).setZero();
        return parts;
    }

    void take(const Eigen::MatrixXd &parts) {
        const Eigen::Index before = _planar.matrix().cols();
        for (const double part : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6}) {
            _planar.add_newest_first(above(part, parts), part);
            if (_planar.matrix().cols() > before)
                return;
        }
    }

    /// Each mode leads to one of the whole rotor nearby; where not, its shapes are taken in.
    bool meets_at(double speed) {
        const Eigen::Index before = _planar.matrix().cols();
        const Eigen::Index N = _d.planar_size();
        std::vector<Wanted> met;
        for (const WhirlMode &mode : modes(speed)) {
            const Eigen::MatrixXd few = _planar.matrix();
            const auto attached = 2 * balancers::unknowns_of(_balancers);
            const WhirlMode start =
                over_all_unknowns(mode, &few, static_cast<int>(2 * few.cols()) + attached);
            const auto root =
                _whole.next_to(speed, mode.rotating_value, 0,
                               assembly::hill_terms(start.rotating_vector, 2 * N + attached));
            if (!root)
                continue;
            met.push_back({speed, root->value, root->noise,
                           reduction::planar_parts(root->terms, N,
                                                   2 * (N + balancers::unknowns_of(_balancers)))});
            if (!met.back().is(mode.rotating_value, _near))
                take(met.back().parts);
        }
        if (_planar.matrix().cols() > before)
            return false;
        _met.insert(_met.end(), met.begin(), met.end());
        return true;
    }

    [[nodiscard]] bool has_all() const {
        for (const double speed : _speeds) {
            const std::vector<WhirlMode> found = modes(speed);
            for (const Wanted &one : _met)
                if (one.speed == speed &&
                    std::none_of(found.begin(), found.end(), [&](const WhirlMode &mode) {
                        return one.is(mode.rotating_value, _near);
                    }))
                    return false;
        }
        return true;
    }

    /// Of what the shapes span, as few as have all motions that were met.
    void keep_principal() {
        std::vector<const Eigen::MatrixXd *> parts;
        for (const Wanted &one : _met)
            parts.push_back(&one.parts);
        const auto principal = _planar.principal(parts);
        const Eigen::VectorXd &values = principal.eigenvalues();
        Eigen::Index tried = 0;
        for (const double part : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5}) {
            const Eigen::Index few = (values.array() > part * part * values.maxCoeff()).count();
            if (few == tried || few == values.size())
                continue;
            tried = few;
            reduction::PlanarShapes fewer = _planar;
            fewer.keep(principal.eigenvectors().rightCols(few));
            std::swap(_planar, fewer);
            if (has_all())
                return;
            std::swap(_planar, fewer);
        }
    }
};

} // namespace

std::shared_ptr<const Eigen::MatrixXd>
floquet_shapes(const assembly::Discretization &discretization,
               const std::vector<balancers::BalancerElement> &balancers,
               const periodic::WholeRotor &whole, double from, double to, int wanted) {
    if (discretization.rigid() || discretization.planar_size() <= few_unknowns)
        return nullptr;
    return Search(discretization, balancers, whole, std::abs(to) >= std::abs(from) ? to : from,
                  wanted)
        .run();
}

} // namespace whirl::modes
