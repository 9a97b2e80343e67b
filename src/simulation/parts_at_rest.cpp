#include "simulation/parts_at_rest.h"

#include "balancers/held.h"
#include "balancers/kind.h"
#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/least_squares.h"
#include "model/errors.h"
#include "rigid/inertia.h"
#include "simulation/outcome.h"
#include "simulation/steady_motion.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <variant>

namespace whirl::simulation {

namespace {

using Angles = std::vector<std::vector<double>>; ///< of each balancer, rad

/// Angles of all coordinates at an output time. Where rings have turned to is of no account.
Angles angles_at(const model::Rotor &rotor, const results::MotionSeries &series,
                 std::size_t index) {
    Angles out;
    auto next = series.angles.begin();
    for (const model::Balancer &b : rotor.balancers) {
        const auto kind = balancers::kind_of(b);
        out.emplace_back();
        for (std::size_t j = 0; j < kind->coordinates().size(); ++j)
            out.back().push_back((*next++)[index]);
        out.back().resize(kind->start_angles());
    }
    return out;
}

/// The rotor with the parts of its balancers fixed; on bearings that differ between x and y their
/// mean inertia has to do.
model::Rotor with_parts_fixed(const model::Rotor &rotor, const Angles &angles) {
    model::Rotor fixed = balancers::with_parts_held(rotor, angles);
    if (!rotor.bearings_isotropic())
        fixed.anisotropies = rotor.anisotropies;
    return fixed;
}

/// What is left in a rotor about its centre of mass.
void add_what_is_left(const model::Rotor &fixed, results::PartsAtRest &out) {
    out.center_of_mass = rigid::inertia_of(fixed).center();
    std::complex<double> imbalance = 0;
    std::complex<double> couple = 0;
    for (const model::Imbalance &one : fixed.imbalances) {
        const std::complex<double> mr = one.mr * std::polar(1.0, one.phase);
        imbalance += mr;
        couple += mr * (one.z - out.center_of_mass);
    }
    out.imbalance = std::abs(imbalance);
    out.couple = std::abs(couple);
}

/// Nothing but the whirl moves the parts of any balancer along their circles.
bool moved_by_whirl_alone(const model::Case &scene) {
    return scene.simulate.forces.empty() && !scene.simulate.base &&
           !balancers::has_obstructed_race(scene.rotor.balancers) &&
           std::ranges::all_of(scene.rotor.balancers, [](const model::Balancer &b) {
               const auto *balls = std::get_if<model::Balls>(&b.parts);
               return !balancers::kind_of(b)->circled().empty() &&
                      !(balls && (balls->contact || balls->resists()));
           });
}

/// Masses on circles in a steady whirl, w the deflection of their centre as seen from the rotor:
/// what pushes the mass at the angle a on along its circle is Omega^2 m Im(w exp(-i a)), which
/// turns it slowly, held back by its drag (docs/theory.md, "Outcome with balancers"). It rests
/// where that is zero.
class Pushes {
  public:
    Pushes(const model::Rotor &rotor, const Angles &angles, const model::Case &fixed,
           const assembly::Discretization &d, const results::SimulateResult &result)
        : _result(result) {
        for (std::size_t i = 0; i < angles.size(); ++i) {
            const auto circled = balancers::kind_of(rotor.balancers[i])->circled();
            for (std::size_t j = 0; j < circled.size(); ++j)
                _masses.push_back(
                    {i, angles[i][j], circled[j].moment, circled[j].inertia / circled[j].moment});
        }
        const results::Form form = forced::response_formulation(fixed).form;
        const SteadyMotion motion(d, form, result.speed);
        for (const model::Balancer &b : rotor.balancers)
            _w.push_back(motion.in_rotor(b.z) + balancers::kind_of(b)->race_centre());
        find_responses(rotor, fixed, form, d.order());
    }

    /// Angle of the mass farthest from rest, rad: by Newton's step towards where all rest, and of a
    /// mass by itself from the line of the deflection. Planes that are balanced push nothing.
    [[nodiscard]] double away() const {
        const Eigen::Index n = std::ssize(_masses);
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, n);
        A.topRows(n) = slopes();
        // Directions in which balance does not change, or hardly, lead nowhere.
        constexpr double hardly = 1e-6;
        A.bottomRows(n).diagonal().setConstant(hardly * A.topRows(n).cwiseAbs().maxCoeff());
        Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * n);
        double alone = 0;
        for (Eigen::Index j = 0; j < n; ++j) {
            const Mass &mass = _masses[static_cast<std::size_t>(j)];
            const std::complex<double> w = turned(mass);
            b(j) = -w.imag();
            if (std::abs(w) > balanced * reference(mass))
                alone = std::max(alone, std::asin(std::min(1.0, std::abs(w.imag()) / std::abs(w))));
        }
        return std::max(alone, linalg::least_squares(A, b).cwiseAbs().maxCoeff());
    }

    /// No slow motion of the masses about this position grows.
    [[nodiscard]] bool holds() const {
        Eigen::MatrixXd rates = slopes();
        for (Eigen::Index j = 0; j < rates.rows(); ++j)
            rates.row(j) /= _masses[static_cast<std::size_t>(j)].radius;
        constexpr double rounding = 1e-6; // of the largest: families of positions have zeros
        const Eigen::VectorXcd values = linalg::general_eigen(rates, linalg::Vectors::right).values;
        return values.real().maxCoeff() <= rounding * values.cwiseAbs().maxCoeff();
    }

  private:
    struct Mass {
        std::size_t balancer;
        double angle;  ///< rad
        double moment; ///< kg m
        double radius; ///< m
    };
    static constexpr double balanced = 0.1; ///< of the deflection without balls

    const results::SimulateResult &_result;
    std::vector<Mass> _masses;
    std::vector<std::complex<double>> _w; ///< of the centre of the circles in each plane, m
    /// Of each plane under an imbalance in each: along 1 and i, m/(kg m).
    std::vector<std::vector<std::pair<std::complex<double>, std::complex<double>>>> _responses;

    void find_responses(const model::Rotor &rotor, model::Case fixed, results::Form form,
                        int order) {
        _responses.resize(rotor.balancers.size());
        for (const model::Balancer &loaded : rotor.balancers) {
            std::vector<std::vector<std::complex<double>>> columns;
            for (const double phase : {0.0, std::numbers::pi / 2}) {
                for (model::Imbalance &one : fixed.rotor.imbalances)
                    one.mr = 0;
                fixed.rotor.imbalances.push_back({"", loaded.z, 1, phase});
                const assembly::Discretization d(fixed.rotor, order);
                const SteadyMotion motion(d, form, _result.speed);
                columns.emplace_back();
                for (const model::Balancer &seen : rotor.balancers)
                    columns.back().push_back(motion.in_rotor(seen.z));
            }
            for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
                _responses[i].emplace_back(columns[0][i], columns[1][i]);
        }
    }

    [[nodiscard]] double reference(const Mass &mass) const {
        return _result.balancers[mass.balancer].reference;
    }
    /// Deflection of a mass's plane: along the radius, and i times across it.
    [[nodiscard]] std::complex<double> turned(const Mass &mass) const {
        return _w[mass.balancer] * std::polar(1.0, -mass.angle);
    }
    /// d Im(w exp(-i a))/d a of all masses by all.
    [[nodiscard]] Eigen::MatrixXd slopes() const {
        const Eigen::Index n = std::ssize(_masses);
        Eigen::MatrixXd out(n, n);
        for (Eigen::Index j = 0; j < n; ++j)
            for (Eigen::Index k = 0; k < n; ++k) {
                const Mass &mass = _masses[static_cast<std::size_t>(j)];
                const Mass &moved = _masses[static_cast<std::size_t>(k)];
                const std::complex<double> load =
                    std::polar(moved.moment, moved.angle + std::numbers::pi / 2);
                const auto &[x, y] = _responses[mass.balancer][moved.balancer];
                const std::complex<double> w = load.real() * x + load.imag() * y;
                out(j, k) = std::imag(w * std::polar(1.0, -mass.angle)) -
                            (j == k ? turned(mass).real() : 0);
            }
        return out;
    }
};

} // namespace

void add_parts_at_rest(const model::Case &scene, int order, results::SimulateResult &result) {
    if (scene.rotor.balancers.empty() || result.speed == 0 || !ends_at_constant_speed(result))
        return;
    try {
        const model::Rotor rotor = rotor_at_end(scene, result);
        results::PartsAtRest out;
        const std::size_t last = result.series.time.size() - 1;
        for (const std::size_t index : {last / 2, last}) {
            const Angles angles = angles_at(rotor, result.series, index);
            const model::Case fixed = driven(scene, with_parts_fixed(rotor, angles), result);
            const assembly::Discretization d(fixed.rotor, order);
            const SteadyMotion motion(d, forced::response_formulation(fixed).form, result.speed);
            if (index < last) {
                out.halfway = motion.largest(result);
                continue;
            }
            out.amplitude = motion.largest(result);
            for (results::StationMotion &station : result.stations)
                station.with_balls = motion.amplitude(station.z);
            add_what_is_left(fixed.rotor, out);
            if (!moved_by_whirl_alone(scene))
                continue;
            const Pushes pushes(rotor, angles, fixed, d, result);
            out.away = pushes.away();
            out.holds = pushes.holds();
        }
        result.at_rest = out;
    } catch (const linalg::SolverError &) { // at a resonance: nothing to compare with
    } catch (const model::AnalysisFailure &) {
    }
}

} // namespace whirl::simulation
