#include "states/state_search.h"

#include "balancers/balance_family.h"
#include "balancers/balanced_position.h"
#include "balancers/kind.h"
#include "linalg/check.h"
#include "linalg/dense/products.h"
#include "model/errors.h"
#include "process/progress.h"
#include "results/sentence.h"
#include "states/branches.h"
#include "states/trig_roots.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace whirl::states {

namespace {

using Eigen::Index;
using results::SteadyState;
using std::numbers::pi;

/// Moments of mass that differ by less than this, over all of them, are equal: rounding of inputs.
constexpr double equal_moments = 1e-9;
/// The same state from two ways to stand, where a fold makes angles out of square roots of
/// rounding.
constexpr double same_at_fold = 3e-5;
/// Members of a family that are looked at: more than the kinds of arrangements that six balls have.
constexpr int members = 9;
/// Of a family between walls so many are tried until that many of them fit.
constexpr int most_tried = 200;
/// More ways to stand than any rotor has that somebody would wait for.
constexpr std::size_t most_ways = 20000;
/// More masses that stand each by itself are as many unknowns: hours.
constexpr std::size_t most_alone = 4;
/// A root found by Newton's method: some digits more than are shown.
constexpr double refined = 1e-9;
/// Rad, and of the size of a push: what rounding leaves of them.
constexpr double beside = 1e-11;
/// What second order terms in the slopes may leave of the equations of a family, which they break.
constexpr double second_order = 1e-3;

/// One more member of a family that stands for all of them.
void add_member(const StateSearch::Found &found, StateSearch::Found &whole) {
    const SteadyState &member = found.state;
    SteadyState &family = whole.state;
    if (family.stable != member.stable)
        family.stable.reset();
    if (family.why.empty())
        family.why = member.why;
    // A comparison with what is not known is false: fmax and fmin take the other one.
    family.growth = std::fmax(family.growth, member.growth);
    family.growth_error = std::fmax(family.growth_error, member.growth_error);
    family.least_growth = std::fmin(family.least_growth, member.growth);
    // Borders are those of the member of which most motions grow.
    if (member.growing > family.growing ||
        (member.growing == family.growing &&
         found.least_growing.real() < whole.least_growing.real()))
        whole.least_growing = found.least_growing;
    family.growing = std::max(family.growing, member.growing);
}

/// The masses of a plane stand each by itself: their tracks are no circles seen along the shaft.
bool each_alone(const auto &plane) { return plane.out_of_round != 0.0 || !plane.slope.isZero(0); }

/// What balance takes of the masses of a plane.
std::vector<balancers::CircledMass> circled(const auto &plane) {
    std::vector<balancers::CircledMass> out;
    for (const auto &mass : plane.masses)
        out.push_back({mass.moment, 0, 0});
    return out;
}

struct Counted {
    modes::Root root;
    int count = 1; ///< 2: it stands for its conjugate too
};

/// All roots of small motions but those that are zero, with their rounding errors where that could
/// be the sign of their growth, and of the one of the largest real part. Rounding makes a pair of a
/// double real root, which is real again once it is found better: it is two all the same.
std::vector<Counted> judged_roots(const modes::DenseQuadratic<double> &motions, double speed,
                                  int zeros) {
    constexpr double fast = 1e4;       // of the shift: from there their digits are lost
    constexpr double clear = 1e-6;     // of the root or the shift: far above the rounding of both
    constexpr double of_shift = 1e-12; // what is small beside it is found no better
    const double shift = modes::usual_shift(speed, 0);
    const std::vector<std::complex<double>> values = modes::all_values(motions, shift, zeros);
    const auto size = [](std::complex<double> value) { return std::abs(value); };
    std::vector<Counted> roots;
    if (size(*std::ranges::max_element(values, {}, size)) > fast * shift) {
        for (modes::Root &root :
             modes::sharp_roots(motions, shift, zeros, static_cast<int>(values.size())))
            roots.push_back({std::move(root)});
        return roots;
    }
    const auto growth = [](std::complex<double> value) { return value.real(); };
    const double largest = growth(*std::ranges::max_element(values, {}, growth));
    for (const std::complex<double> &value : values) {
        if (value.imag() < 0)
            continue;
        auto &[root, count] = roots.emplace_back();
        count = value.imag() > 0 ? 2 : 1;
        if (growth(value) == largest ||
            std::abs(growth(value)) <= clear * std::max(size(value), shift)) {
            root = modes::with_vectors(motions, value);
            if (!root.sharp)
                root.noise = std::max(root.noise, of_shift * shift);
        } else {
            root.value = value;
        }
    }
    return roots;
}

} // namespace

/// The directions of the lines of one way to stand at one speed: y, deflections and slopes of the
/// planes, is linear in the loads, of which those of balanced planes are eliminated.
class StateSearch::Lines {
  public:
    Lines(const StateSearch &search, const Way &way, double speed) {
        const SteadyEquations &equations = search._equations;
        const double squared = speed * speed;
        const Eigen::MatrixXd &rows = equations.plane_rows();
        Eigen::MatrixXd K = equations.stiffness(speed);
        Eigen::VectorXd fixed = equations.load(speed);
        add_free_parts(search, speed, K);
        for (std::size_t i = 0; i < way.sides.size(); ++i) {
            const Plane &plane = search._planes[i];
            add_at_stops(plane, way.stops[i], speed, rows, K, fixed);
            Line line{plane.index, 0, 0, i, 0, plane.centre, {}, plane.slope, 0}; // of free masses
            double tilt = 0;
            bool free = false;
            for (std::size_t k = 0; k < plane.masses.size(); ++k) {
                const Mass &mass = plane.masses[k];
                if (way.stops[i][k] >= 0)
                    continue;
                free = true;
                tilt += mass.tilt;
                if (each_alone(plane))
                    _lines.push_back({plane.index,
                                      mass.moment,
                                      0,
                                      i,
                                      k,
                                      plane.centre,
                                      {mass.radius, plane.out_of_round},
                                      plane.slope,
                                      plane.slope.isZero(0) ? 0 : mass.tilt});
                else if (!way.sides[i].empty())
                    line.moment += way.sides[i][k] * mass.moment;
            }
            if (way.sides[i].empty()) {
                _balanced.push_back({plane.index, plane.centre});
            } else if (!each_alone(plane)) {
                line.tilt = tilt;
                if (free)
                    _lines.push_back(line);
                continue;
            }
            // Of these masses the mean over all arrangements.
            const Eigen::MatrixXd slopes = rows.middleRows<2>(4 * plane.index + 2);
            K += squared * tilt / 2 * slopes.transpose() * slopes;
        }
        _swung = search._swung;
        const Index y_size = rows.rows();
        const auto factors = K.partialPivLu();
        Eigen::MatrixXd right(K.rows(), y_size + 1);
        right << squared * rows.transpose(), fixed;
        const Eigen::MatrixXd all = rows * linalg::solved(factors, right);
        _per_load = all.leftCols(y_size);
        _alone = all.col(y_size);
        eliminate_balanced();
        for (const Line &line : _lines)
            _tilts = _tilts || line.tilt > 0;
    }

    [[nodiscard]] Index unknowns() const { return std::ssize(_lines) + std::ssize(_swung); }
    /// Moments of mass that the masses of a balanced plane must make, kg m.
    [[nodiscard]] std::complex<double> needed(std::size_t which, const Eigen::VectorXd &x) const {
        const Solution at = solve(x);
        const auto row = static_cast<Index>(2 * which);
        const Eigen::Vector2d s =
            -_needed_alone.segment<2>(row) - _needed_per_load.middleRows<2>(row) * at.load;
        return {s(0), s(1)};
    }
    /// Of the line of a plane, or on tracks out of round of each mass.
    [[nodiscard]] double direction(std::size_t plane, std::size_t mass,
                                   const Eigen::VectorXd &x) const {
        const auto line = std::ranges::find_if(_lines, [&](const Line &one) {
            return one.which == plane && (one.track.radius == 0 || one.mass == mass);
        });
        return x(line - _lines.begin());
    }

    [[nodiscard]] TrigRoots roots() const {
        Eigen::VectorXi degrees(unknowns());
        // The own line: its load, its force, and twice in the determinant.
        degrees.setConstant(2);
        if (_tilts)
            degrees.head(std::ssize(_lines)).setConstant(4);
        for (std::size_t i = 0; i < _lines.size(); ++i)
            if (_lines[i].track.radius > 0) // a load and a force of the third degree
                degrees(static_cast<Index>(i)) = 6;
        return all_roots(
            interpolated(degrees, sizes(), [this](const Eigen::VectorXd &x) { return forces(x); }));
    }

  private:
    struct Line {
        Index plane;
        double moment; ///< kg m
        double tilt;   ///< kg m2
        std::size_t which;
        std::size_t mass;       ///< that one of the plane, out of round
        Eigen::Vector2d centre; ///< of the circles, from the axis, m
        balancers::Track track; ///< of one mass out of round; radius 0: of several on a line
        Eigen::Vector2d slope;  ///< of the circles, rad
        double swash;           ///< kg m2: of one mass by itself its pull on them
    };
    struct Balanced {
        Index plane;
        Eigen::Vector2d centre;
    };
    std::vector<Line> _lines;
    std::vector<Swung> _swung;
    std::vector<Balanced> _balanced;
    Eigen::VectorXd _alone;    ///< y without loads of free parts, m
    Eigen::MatrixXd _per_load; ///< y per moment of mass at each plane; of slopes per kg m2
    Eigen::VectorXd _needed_alone;
    Eigen::MatrixXd _needed_per_load;
    bool _tilts = false;

    /// What free parts do to the slopes wherever they stand: all but mu e e^T of each mass.
    static void add_free_parts(const StateSearch &search, double speed, Eigen::MatrixXd &K) {
        const SteadyEquations &equations = search._equations;
        for (const simulation::FreeParts &free : equations.parts().free) {
            const Eigen::VectorXd zero = Eigen::VectorXd::Zero(free.motion->size());
            const balancers::AtRest rest =
                free.motion->at_rest(balancers::PlaneVector::Zero(), speed, zero.data());
            const Eigen::MatrixXd rows = equations.plane_rows().middleRows<4>(4 * free.plane);
            K += rows.transpose() * rest.stiffness.topLeftCorner<4, 4>() * rows;
        }
        for (const Plane &plane : search._planes) {
            const Eigen::VectorXd row = equations.plane_rows().row(4 * plane.index + 2);
            K -= speed * speed * plane.tilt * row * row.transpose();
        }
    }

    /// Masses that rest against walls are those of the rotor.
    static void add_at_stops(const Plane &plane, const Stops &stops, double speed,
                             const Eigen::MatrixXd &rows, Eigen::MatrixXd &K,
                             Eigen::VectorXd &load) {
        for (std::size_t k = 0; k < stops.size(); ++k) {
            if (stops[k] < 0)
                continue;
            const Mass &mass = plane.masses[k];
            const double angle = mass.stops[static_cast<std::size_t>(stops[k])].angle;
            const Eigen::Vector2d e(std::cos(angle), std::sin(angle));
            const balancers::Track track{1, plane.out_of_round};
            load += speed * speed * mass.moment * track.at(angle).value *
                    rows.middleRows<2>(4 * plane.index).transpose() * e;
            const Eigen::VectorXd along = rows.middleRows<2>(4 * plane.index + 2).transpose() * e;
            K += speed * speed * mass.tilt * along * along.transpose();
            load -= speed * speed * mass.tilt * e.dot(plane.slope) * along;
        }
    }

    void eliminate_balanced() {
        const auto n = 2 * std::ssize(_balanced);
        if (n == 0)
            return;
        Eigen::MatrixXd to(_per_load.rows(), n);
        Eigen::MatrixXd from(n, _per_load.cols());
        Eigen::VectorXd alone(n);
        for (std::size_t i = 0; i < _balanced.size(); ++i) {
            const auto at = static_cast<Index>(2 * i);
            const Index row = 4 * _balanced[i].plane;
            to.middleCols<2>(at) = _per_load.middleCols<2>(row);
            from.middleRows<2>(at) = _per_load.middleRows<2>(row);
            alone.segment<2>(at) = _alone.segment<2>(row) + _balanced[i].centre;
        }
        Eigen::MatrixXd own(n, n);
        for (std::size_t i = 0; i < _balanced.size(); ++i)
            own.middleCols<2>(static_cast<Index>(2 * i)) =
                from.middleCols<2>(4 * _balanced[i].plane);
        const Eigen::FullPivLU<Eigen::MatrixXd> factors(own);
        if (!factors.isInvertible())
            throw linalg::SolverError("balanced planes that deflect together");
        _needed_alone = factors.solve(alone);
        _needed_per_load = factors.solve(from);
        _alone -= to * _needed_alone;
        _per_load -= to * _needed_per_load;
    }

    struct Solution {
        Eigen::VectorXd load; ///< moments of mass
        Eigen::VectorXd y;
        double determinant = 1; ///< of what tilting masses change
    };
    [[nodiscard]] Solution solve(const Eigen::VectorXd &x) const {
        Solution out;
        out.load = Eigen::VectorXd::Zero(_per_load.cols());
        const Index lines = std::ssize(_lines);
        for (Index i = 0; i < lines; ++i) {
            const Line &line = _lines[static_cast<std::size_t>(i)];
            Eigen::Vector2d moment = line.moment * Eigen::Vector2d(std::cos(x(i)), std::sin(x(i)));
            if (line.track.radius > 0)
                moment *= line.track.at(x(i)).value / line.track.radius;
            out.load.segment<2>(4 * line.plane) += moment;
            if (line.swash > 0) { // the couple of a mass that the race takes along the shaft
                const Eigen::Vector2d e(std::cos(x(i)), std::sin(x(i)));
                out.load.segment<2>(4 * line.plane + 2) -= line.swash * e.dot(line.slope) * e;
            }
        }
        for (std::size_t i = 0; i < _swung.size(); ++i) {
            const Swung &one = _swung[i];
            const double across = one.moment * std::sin(x(lines + static_cast<Index>(i)));
            out.load.segment<2>(4 * one.plane) +=
                across * Eigen::Vector2d(-std::sin(one.line), std::cos(one.line));
        }
        out.y = _alone + _per_load * out.load;
        if (!_tilts)
            return out;
        // Each line is pulled by -mu e t, t = e.Phi: (1 + E^T H E mu) t = E^T y.
        Eigen::MatrixXd pulls = Eigen::MatrixXd::Zero(_per_load.cols(), lines);
        for (Index i = 0; i < lines; ++i) {
            const Line &line = _lines[static_cast<std::size_t>(i)];
            pulls.col(i).segment<2>(4 * line.plane + 2) << std::cos(x(i)), std::sin(x(i));
        }
        const Eigen::MatrixXd answers = _per_load * pulls;
        Eigen::MatrixXd A = pulls.transpose() * answers;
        for (Index i = 0; i < lines; ++i)
            A.col(i) *= _lines[static_cast<std::size_t>(i)].tilt;
        A.diagonal().array() += 1;
        const auto factors = A.partialPivLu();
        Eigen::VectorXd t = factors.solve(pulls.transpose() * out.y);
        for (Index i = 0; i < lines; ++i)
            t(i) *= _lines[static_cast<std::size_t>(i)].tilt;
        out.y -= answers * t;
        out.load -= pulls * t;
        out.determinant = factors.determinant();
        return out;
    }

    /// Force along the circle of each line and balance of what swings, over Omega^2 and the masses,
    /// times the determinant: trigonometric polynomials.
    [[nodiscard]] Eigen::VectorXd forces(const Eigen::VectorXd &x) const {
        const Solution at = solve(x);
        Eigen::VectorXd out(x.size());
        const Index lines = std::ssize(_lines);
        for (Index i = 0; i < lines; ++i) {
            const Line &line = _lines[static_cast<std::size_t>(i)];
            const Eigen::Vector2d w = at.y.segment<2>(4 * line.plane) + line.centre;
            out(i) = w(1) * std::cos(x(i)) - w(0) * std::sin(x(i));
            if (line.track.radius > 0) { // (w + rho e) . d(rho e)/da, over R
                const balancers::Track::Radius r = line.track.at(x(i));
                out(i) = (r.value * out(i) +
                          r.slope * (w(0) * std::cos(x(i)) + w(1) * std::sin(x(i)) + r.value)) /
                         line.track.radius;
                if (line.swash > 0) { // - mu (C S - c s) over m R, C + i S of both slopes
                    const Eigen::Vector2d e(std::cos(x(i)), std::sin(x(i)));
                    const Eigen::Vector2d n(-e(1), e(0));
                    const Eigen::Vector2d shaft = at.y.segment<2>(4 * line.plane + 2);
                    out(i) -= line.track.radius * (e.dot(line.slope) * n.dot(shaft + line.slope) +
                                                   e.dot(shaft) * n.dot(line.slope));
                }
            }
        }
        for (std::size_t k = 0; k < _swung.size(); ++k) {
            const Index i = lines + static_cast<Index>(k);
            const Swung &one = _swung[k];
            const Eigen::Vector2d w = at.y.segment<2>(4 * one.plane);
            const double across = w(1) * std::cos(one.line) - w(0) * std::sin(one.line);
            out(i) = std::cos(x(i)) * across - one.pivot * std::sin(x(i));
        }
        return at.determinant * out;
    }

    /// Of the terms of forces().
    [[nodiscard]] Eigen::VectorXd sizes() const {
        Eigen::VectorXd load = Eigen::VectorXd::Zero(_per_load.cols());
        double determinant = 1;
        for (const Line &line : _lines) {
            load.segment<2>(4 * line.plane).array() += std::abs(line.moment);
            load.segment<2>(4 * line.plane + 2).array() += line.swash * line.slope.norm();
            const Index slope = 4 * line.plane + 2;
            determinant *= 1 + line.tilt * _per_load.block<2, 2>(slope, slope).norm();
        }
        for (const Swung &one : _swung)
            load.segment<2>(4 * one.plane).array() += one.moment;
        Eigen::VectorXd y = _alone.cwiseAbs() + _per_load.cwiseAbs() * load;
        if (_tilts) {
            Eigen::VectorXd tilting = Eigen::VectorXd::Zero(y.size());
            for (const Line &line : _lines)
                tilting.segment<2>(4 * line.plane + 2) +=
                    line.tilt * y.segment<2>(4 * line.plane + 2);
            y += _per_load.cwiseAbs() * tilting;
        }
        Eigen::VectorXd out(unknowns());
        Index i = 0;
        for (const Line &line : _lines)
            out(i++) =
                determinant * ((y.segment<2>(4 * line.plane) + line.centre.cwiseAbs()).sum() +
                               2 * std::abs(line.track.out_of_round) * line.track.radius +
                               line.track.radius * line.slope.norm() *
                                   (y.segment<2>(4 * line.plane + 2).sum() + line.slope.norm()));
        for (const Swung &one : _swung)
            out(i++) = determinant * (y.segment<2>(4 * one.plane).sum() + one.pivot);
        return out;
    }
};

StateSearch::StateSearch(const model::Case &scene, double slowest, double fastest)
    : _equations(scene, slowest, fastest) {
    collect(scene);
    const int most = scene.states ? scene.states->max_balls : model::StatesSettings{}.max_balls;
    for (const Plane &plane : _planes)
        if (std::ssize(plane.masses) > most)
            throw model::AnalysisFailure(results::Sentence(
                "steady states are searched for up to {} balls in a plane (states.max_balls); one "
                "here has {}",
                most, static_cast<int>(plane.masses.size())));
    std::size_t single = 0;   // in races out of round or tilted
    std::size_t together = 0; // most of a plane with round ones
    for (const Plane &plane : _planes)
        if (each_alone(plane))
            single += plane.masses.size();
        else
            together = std::max(together, plane.masses.size());
    if (single > most_alone || (single > 0 && together > 2))
        throw model::AnalysisFailure(results::Sentence(
            "steady states are searched for up to {} balls in races out of round (ellipticity) or "
            "tilted, and up to 2 in each plane with round ones beside them; here are {} and {}",
            static_cast<int>(most_alone), static_cast<int>(single), static_cast<int>(together)));
    if (!_equations.driven() && _equations.round() && !_equations.damped() && !_planes.empty())
        throw model::AnalysisFailure("steady states are not isolated: nothing in this rotor marks "
                                     "a direction, and no damping keeps balls from deflecting it "
                                     "in any");
    _ways = all_ways();
}

void StateSearch::collect(const model::Case &scene) {
    const auto plane_at = [this](Index index) -> Plane & {
        for (Plane &plane : _planes)
            if (plane.index == index)
                return plane;
        _planes.push_back({index, {}, 0, Eigen::Vector2d::Zero(), 0, Eigen::Vector2d::Zero(), {}});
        return _planes.back();
    };
    _balancers = scene.rotor.balancers;
    Index first = 0;
    int alike = 0;
    for (std::size_t i = 0; i < scene.rotor.balancers.size(); ++i) {
        const model::Balancer &b = scene.rotor.balancers[i];
        const auto kind = balancers::kind_of(b);
        const simulation::FreeParts &free = _equations.parts().free[i];
        _first_of.push_back(first);
        _angles_of.push_back(kind->start_angles());
        int kinds = 0;
        if (!kind->circled().empty()) {
            Plane &plane = plane_at(free.plane);
            const std::complex<double> centre = kind->race_centre();
            const Eigen::Vector2d own(centre.real(), centre.imag());
            const std::complex<double> inclination = kind->inclination();
            const Eigen::Vector2d slope(inclination.real(), inclination.imag());
            if (!plane.balancers.empty() &&
                (plane.centre != own || plane.out_of_round != kind->out_of_round() ||
                 plane.slope != slope))
                throw model::AnalysisFailure(
                    "steady states are found for races in one plane with one centre, form and "
                    "tilt: those of the balancers here differ in eccentricity, ellipticity or "
                    "tilt");
            plane.slope = slope;
            plane.centre = own;
            plane.out_of_round = kind->out_of_round();
            plane.balancers.push_back(i);
        }
        for (Index at = first; const balancers::CircledMass &mass : kind->circled()) {
            Plane &plane = plane_at(free.plane);
            const double tilt = b.tilt_inertia ? mass.inertia : 0;
            plane.masses.push_back({at, mass.moment, mass.radius(), tilt, alike + mass.alike, {}});
            for (const balancers::TouchingRow &row : free.motion->touching())
                if (at - first >= row.first && at - first < row.first + row.count)
                    for (const balancers::Wall &wall : row.walls) {
                        plane.masses.back().stops.push_back({wall.before, 1, wall.arm_before});
                        plane.masses.back().stops.push_back({wall.behind, -1, wall.arm_behind});
                        _walls = true;
                    }
            ++at;
            plane.tilt += tilt;
            kinds = std::max(kinds, mass.alike + 1);
        }
        alike += kinds;
        for (Index at = first; const balancers::SwungMass &mass : kind->swung())
            _swung.push_back({free.plane, at++, mass.line, mass.moment, mass.pivot});
        first += free.motion->size();
    }
}

std::vector<StateSearch::PlaneWay> StateSearch::ways_of(const Plane &plane) {
    std::vector<PlaneWay> out;
    const std::size_t n = plane.masses.size();
    // A mass that rests against a wall is pushed there: its plane is not balanced.
    if (n > 1 && !each_alone(plane)) // one mass alone is so on its line
        out.push_back({{}, Stops(n, -1)});
    // Who rests where: of masses that could be exchanged the later one never at an earlier stop.
    Stops stops(n, -1);
    const std::function<void(std::size_t)> choose = [&](std::size_t k) {
        if (k == n) {
            add_sides(plane, stops, out);
            return;
        }
        int least = -1;
        for (std::size_t l = 0; l < k; ++l)
            if (plane.masses[l].alike == plane.masses[k].alike)
                least = std::max(least, stops[l]);
        for (int stop = least; stop < std::ssize(plane.masses[k].stops); ++stop) {
            stops[k] = stop;
            choose(k + 1);
        }
    };
    choose(0);
    return out;
}

void StateSearch::add_sides(const Plane &plane, const Stops &stops, std::vector<PlaneWay> &out) {
    const std::size_t n = plane.masses.size();
    std::vector<std::size_t> free;
    Sides sides(n, at_stop);
    double all = 0;
    for (std::size_t k = 0; k < n; ++k)
        if (stops[k] < 0) {
            free.push_back(k);
            sides[k] = 0;
            all += plane.masses[k].moment;
        }
    if (free.empty() || each_alone(plane)) {
        out.push_back({sides, stops});
        return;
    }
    for (std::size_t pattern = 0; pattern < (std::size_t{1} << free.size()); ++pattern) {
        double sum = 0;
        for (std::size_t f = 0; f < free.size(); ++f) {
            sides[free[f]] = (pattern >> f & 1) != 0 ? -1 : 1;
            sum += sides[free[f]] * plane.masses[free[f]].moment;
        }
        // Turned by half a turn the others are the same.
        if (sum < -equal_moments * all || (sum <= equal_moments * all && sides[free[0]] < 0))
            continue;
        // Of masses that could be exchanged those that stand opposite come last.
        bool ordered = true;
        for (const std::size_t k : free)
            for (const std::size_t l : free)
                ordered = ordered && !(l < k && sides[l] < sides[k] &&
                                       plane.masses[l].alike == plane.masses[k].alike);
        if (ordered)
            out.push_back({sides, stops});
    }
}

std::vector<StateSearch::Way> StateSearch::all_ways() const {
    std::vector<Way> out{{}};
    const bool only_balanced = !_equations.driven() && _equations.round();
    for (const Plane &plane : _planes) {
        std::vector<Way> longer;
        for (const Way &way : out)
            for (const PlaneWay &own : ways_of(plane)) {
                if (only_balanced && !_walls && !own.sides.empty())
                    continue;
                longer.push_back(way);
                Way &next = longer.back();
                next.sides.push_back(own.sides);
                next.stops.push_back(own.stops);
                for (std::size_t k = 0; k < own.stops.size(); ++k)
                    if (own.stops[k] >= 0)
                        next.held.push_back(plane.masses[k].coordinate);
            }
        out = std::move(longer);
        if (out.size() > most_ways)
            throw model::AnalysisFailure("there are too many ways in which the balls of this rotor "
                                         "can stand to search all of them for steady states");
    }
    // Without an imbalance balls that deflect a damped rotor lag behind: nothing but their own pull
    // along the circle, or a wall, would make up for the loss.
    std::erase_if(out, [only_balanced](const Way &way) {
        return only_balanced && way.held.empty() &&
               std::ranges::any_of(way.sides, [](const Sides &sides) { return !sides.empty(); });
    });
    for (Way &way : out)
        std::ranges::sort(way.held);
    return out;
}

std::vector<double> StateSearch::balanced_angles(const Plane &plane, double imbalance,
                                                 int member) const {
    if (plane.balancers.size() == 1 && plane.masses.size() > 2 && member == 0) {
        model::Balancer alone = _balancers[plane.balancers.front()];
        alone.imbalance = imbalance;
        alone.position.clear();
        return balancers::angles_at_balance(alone, "balancer");
    }
    const std::vector<balancers::CircledMass> masses = circled(plane);
    const bool pair = masses.size() == 2;
    // Members of a planar rotor differ by their mean of exp(2i a) alone: the last two have the
    // largest and the least.
    if (!_walls && masses.size() > 2 && member >= members - 2)
        return extreme_angles(plane, imbalance, member == members - 1 ? -1 : 1);
    std::vector<double> out = balancers::position_of_family(masses, imbalance, pair ? 0 : member);
    if (pair && (member & 1) != 0) // the other way round
        for (double &angle : out)
            angle = -angle;
    return out;
}

std::vector<double> StateSearch::extreme_angles(const Plane &plane, double imbalance,
                                                double sign) const {
    std::vector<double> factors;
    for (const Mass &mass : plane.masses)
        factors.push_back(mass.moment);
    std::vector<double> from;
    double lowest = HUGE_VAL;
    for (int member = 0; member < members - 2; ++member) {
        std::vector<double> angles = balanced_angles(plane, imbalance, member);
        std::complex<double> sum;
        for (std::size_t k = 0; k < angles.size(); ++k)
            sum += std::polar(factors[k], 2 * angles[k]);
        if (sign * std::abs(sum) < lowest) {
            lowest = sign * std::abs(sum);
            from = std::move(angles);
        }
    }
    return balancers::extreme_beside(circled(plane), imbalance, factors, sign, std::move(from));
}

bool StateSearch::place(const Way &way, const Lines &lines, const Eigen::VectorXd &root, int member,
                        Eigen::VectorXd &angles) const {
    angles = Eigen::VectorXd::Zero(_equations.parts().free_angles());
    const auto line_count = lines.unknowns() - std::ssize(_swung);
    for (std::size_t i = 0; i < _swung.size(); ++i)
        angles(_swung[i].coordinate) = root(line_count + static_cast<Index>(i));
    for (std::size_t i = 0, balanced = 0; i < _planes.size(); ++i) {
        const Plane &plane = _planes[i];
        if (!way.sides[i].empty()) {
            for (std::size_t k = 0; k < plane.masses.size(); ++k) {
                const int stop = way.stops[i][k];
                angles(plane.masses[k].coordinate) =
                    stop >= 0 ? plane.masses[k].stops[static_cast<std::size_t>(stop)].angle
                              : lines.direction(i, k, root) + (way.sides[i][k] < 0 ? pi : 0);
            }
            continue;
        }
        const std::complex<double> needed = lines.needed(balanced++, root);
        const std::vector<balancers::CircledMass> masses = circled(plane);
        if (!balancers::balance_exists(masses, std::abs(needed)))
            return false;
        const std::vector<double> from_opposite = balanced_angles(plane, std::abs(needed), member);
        for (std::size_t k = 0; k < masses.size(); ++k)
            angles(plane.masses[k].coordinate) = std::arg(needed) + pi + from_opposite[k];
        if (!turns_as_pair(plane, needed))
            continue;
        const std::optional<double> turn = turn_of_pair(plane, angles, member);
        if (!turn)
            return false;
        for (const Mass &mass : plane.masses)
            angles(mass.coordinate) += *turn;
    }
    return true;
}

bool StateSearch::turns_as_pair(const Plane &plane, std::complex<double> needed) {
    if (plane.masses.size() != 2)
        return false;
    const double all = plane.masses[0].moment + plane.masses[1].moment;
    return std::abs(needed) <= equal_moments * all;
}

bool StateSearch::pair_turns(const Way &way, const Lines &lines,
                             const Eigen::VectorXd &root) const {
    bool any = false;
    for (std::size_t i = 0, balanced = 0; i < _planes.size(); ++i)
        if (way.sides[i].empty())
            any = turns_as_pair(_planes[i], lines.needed(balanced++, root)) || any;
    return any;
}

std::optional<double> StateSearch::turn_of_pair(const Plane &plane, const Eigen::VectorXd &angles,
                                                int member) {
    // Turns that bring a mass into a wall, [0, 2 pi] and those that reach beyond it.
    std::vector<std::pair<double, double>> barred;
    for (const Mass &mass : plane.masses)
        for (std::size_t s = 0; s < mass.stops.size(); s += 2) {
            const double from = mass.stops[s].angle - angles(mass.coordinate);
            const double turned = from - 2 * pi * std::floor(from / (2 * pi));
            const double width = mass.stops[s + 1].angle - mass.stops[s].angle;
            barred.emplace_back(turned, turned + width);
            barred.emplace_back(turned - 2 * pi, turned - 2 * pi + width);
        }
    // Members divide what is left evenly; a pair of equal balls is the same after half a turn,
    // which an odd number of them is not.
    const double share = (member % members + (barred.empty() ? 0.0 : 0.5)) / members;
    std::ranges::sort(barred);
    barred.emplace_back(2 * pi, 2 * pi);
    std::vector<std::pair<double, double>> gaps;
    double left = 0;
    double end = 0;
    for (const auto &[from, to] : barred) {
        const double next = std::min(from, 2 * pi);
        if (next - end > 2 * beside) { // it stands beside both walls
            gaps.emplace_back(end, next);
            left += next - end;
        }
        end = std::max(end, to);
    }
    double along = share * left;
    for (const auto &[from, to] : gaps) {
        if (along < to - from)
            return from + along;
        along -= to - from;
    }
    return std::nullopt;
}

int StateSearch::along_family(const Way &way, const Eigen::VectorXd &angles) const {
    int along = 0;
    for (std::size_t i = 0; i < _planes.size(); ++i) {
        if (!way.sides[i].empty())
            continue;
        Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
        for (const Mass &mass : _planes[i].masses) {
            const double a = angles(mass.coordinate);
            const Eigen::Vector2d across(-std::sin(a), std::cos(a));
            squares += mass.moment * mass.moment * across * across.transpose();
        }
        // On one diameter they move across it alone.
        const double trace = squares.trace();
        const bool diameter = squares.determinant() < equal_moments * trace * trace;
        along += static_cast<int>(_planes[i].masses.size()) - (diameter ? 1 : 2);
    }
    return along;
}

bool StateSearch::same(const Eigen::VectorXd &a, const Eigen::VectorXd &b) const {
    const auto close = [](double one, double other) {
        return std::abs(std::remainder(one - other, 2 * pi)) < same_at_fold;
    };
    for (const Swung &one : _swung)
        if (!close(a(one.coordinate), b(one.coordinate)))
            return false;
    for (const Plane &plane : _planes) {
        std::vector<bool> taken(plane.masses.size(), false);
        for (const Mass &mass : plane.masses) {
            bool found = false;
            for (std::size_t k = 0; k < taken.size() && !found; ++k)
                if (!taken[k] && plane.masses[k].alike == mass.alike &&
                    close(a(mass.coordinate), b(plane.masses[k].coordinate)))
                    taken[k] = found = true;
            if (!found)
                return false;
        }
    }
    return true;
}

SteadyState::Kind StateSearch::kind_of(const Way &way) const {
    if (_planes.empty())
        return SteadyState::Kind::swung;
    if (!way.held.empty())
        return SteadyState::Kind::at_wall;
    std::size_t balanced = 0;
    bool split = false;
    for (const Sides &sides : way.sides) {
        if (std::ranges::find(sides, 0) != sides.end())
            return SteadyState::Kind::out_of_round;
        balanced += sides.empty() ? 1 : 0;
        split = split || std::ranges::find(sides, -1) != sides.end();
    }
    return balanced == way.sides.size() ? SteadyState::Kind::balanced
           : balanced > 0               ? SteadyState::Kind::partly_balanced
           : split                      ? SteadyState::Kind::split
                                        : SteadyState::Kind::coincident;
}

Eigen::VectorXd StateSearch::lined_up(Eigen::VectorXd x, const Eigen::VectorXd &with) const {
    // From the ends: rotors that differ in an entry may have other numbers of shapes.
    const Index angles = _equations.parts().free_angles();
    const Index first = x.size() - angles;
    const Index first_with = with.size() - angles;
    const auto apart = [](double one, double other) {
        return std::abs(std::remainder(one - other, 2 * pi));
    };
    for (const Plane &plane : _planes) {
        bool nearer = true;
        while (nearer) { // each exchange brings two, taken together, nearer
            nearer = false;
            for (const Mass &a : plane.masses)
                for (const Mass &b : plane.masses) {
                    const Index i = first + a.coordinate;
                    const Index k = first + b.coordinate;
                    const double to_a = with(first_with + a.coordinate);
                    const double to_b = with(first_with + b.coordinate);
                    const double gain = apart(x(i), to_a) + apart(x(k), to_b) - apart(x(k), to_a) -
                                        apart(x(i), to_b);
                    if (a.alike != b.alike || gain <= same_at_fold)
                        continue;
                    std::swap(x(i), x(k));
                    nearer = true;
                }
        }
    }
    return x;
}

void StateSearch::line_up(Found &found, const Found &with) const {
    found.x = lined_up(std::move(found.x), with.x);
    write_angles(found);
}

void StateSearch::write_angles(Found &found) const {
    const auto angles = found.x.tail(_equations.parts().free_angles());
    found.state.angles.clear();
    for (std::size_t i = 0; i < _first_of.size(); ++i) {
        found.state.angles.emplace_back();
        for (std::size_t k = 0; k < _angles_of[i]; ++k)
            found.state.angles.back().push_back(
                std::remainder(angles(_first_of[i] + static_cast<Index>(k)), 2 * pi));
    }
}

void StateSearch::describe(Found &found, double speed) const {
    SteadyState &state = found.state;
    state.speed = found.place = speed;
    write_angles(found);
    write_wall_forces(found);
    state.amplitudes.clear();
    state.residual = 0;
    const std::vector<std::complex<double>> w = _equations.deflections(found.x);
    int turning = 0; // rings about themselves
    for (std::size_t i = 0; i < _first_of.size(); ++i) {
        const simulation::FreeParts &free = _equations.parts().free[i];
        turning += free.motion->size() - static_cast<int>(_angles_of[i]);
        state.amplitudes.push_back(std::abs(w[static_cast<std::size_t>(free.plane)]));
        state.residual = std::max(state.residual, state.amplitudes.back());
    }
    state.stable.reset();
    state.why.clear();
    state.growth = state.growth_error = state.least_growth =
        std::numeric_limits<double>::quiet_NaN();
    state.growing = results::not_counted;
    try {
        judge(found, found.along + turning);
    } catch (const linalg::SolverError &error) {
        state.why = error.sentence().text();
    }
}

void StateSearch::judge(Found &found, int zeros) const {
    SteadyState &state = found.state;
    const std::vector<Counted> roots = judged_roots(
        _equations.about(found.x, state.speed, _ways[static_cast<std::size_t>(found.way)].held),
        state.speed, zeros);
    const auto grows_most = [](const Counted &one) {
        return std::pair(one.root.sign() > 0, one.root.value.real());
    };
    const modes::Root &fastest = std::ranges::max_element(roots, {}, grows_most)->root;
    found.fastest = {fastest.value.real(), std::abs(fastest.value.imag())};
    found.least_growing = 0;
    int growing = 0;
    for (const auto &[root, count] : roots) {
        if (root.sign() <= 0)
            continue;
        if (growing == 0 || root.value.real() < found.least_growing.real())
            found.least_growing = root.value;
        growing += count;
    }
    const auto has = [&roots](int sign) {
        return std::ranges::any_of(roots,
                                   [sign](const Counted &one) { return one.root.sign() == sign; });
    };
    found.damped = has(-1);
    const bool decided = !has(0);
    state.growth = state.least_growth = fastest.value.real();
    state.growth_error = fastest.noise;
    state.growing = growing;
    if (growing > 0 || decided)
        state.stable = growing == 0;
}

void StateSearch::add_states(int index, double speed, double deflection, Wanted wanted,
                             std::vector<Found> &out, bool &undecided) const {
    const Way &way = _ways[static_cast<std::size_t>(index)];
    const Lines lines(*this, way, speed);
    TrigRoots roots;
    if (lines.unknowns() > 0)
        roots = lines.roots();
    else
        roots.roots.emplace_back(Eigen::VectorXd(0));
    undecided = undecided || !roots.undecided.empty();
    int mirrored = 1;
    bool mechanism = false; // of three masses or more
    for (std::size_t i = 0; i < _planes.size(); ++i) {
        const std::vector<Mass> &masses = _planes[i].masses;
        if (!way.sides[i].empty())
            continue;
        if (masses.size() == 2 && masses[0].alike != masses[1].alike)
            mirrored = 2;
        mechanism = mechanism || masses.size() > 2;
    }
    for (const Eigen::VectorXd &root : roots.roots) {
        std::optional<Found> whole;
        int fitting = 0;
        bool between = false; // a member of a family would stand in a wall
        const bool family = mechanism || pair_turns(way, lines, root);
        const int tried = !family ? mirrored : _walls ? most_tried : members;
        for (int member = 0; member < tried && fitting < members; ++member) {
            Eigen::VectorXd angles;
            if (!place(way, lines, root, member, angles))
                break;
            Found found;
            found.way = index;
            found.x = _equations.with_angles(angles, speed);
            found.state.defect = _equations.refine(found.x, speed, deflection, way.held);
            found.along = along_family(way, found.x.tail(angles.size()));
            found.state.family = found.along > 0;
            found.state.kind = kind_of(way);
            if (found.state.defect > (found.state.family ? second_order : refined)) {
                // Terms of second order in large slopes moved it away, or undid it.
                undecided = true;
                continue;
            }
            const Fit fit = at_walls(way, found.x, speed, deflection, beside);
            if (family && fit != Fit::yes) {
                between = true;
                continue;
            }
            undecided = undecided || fit == Fit::undecided;
            if (fit == Fit::no)
                continue;
            ++fitting;
            if (wanted == Wanted::all)
                describe(found, speed);
            if (!family) {
                if (std::ranges::none_of(out, [&](const Found &other) {
                        return same(other.x.tail(angles.size()), found.x.tail(angles.size()));
                    }))
                    out.push_back(std::move(found));
                continue;
            }
            if (whole)
                add_member(found, *whole);
            else
                whole = std::move(found);
            if (wanted == Wanted::places)
                break;
        }
        if (whole)
            out.push_back(std::move(*whole));
        else if (between) // others may stand beside them
            undecided = true;
    }
}

StateSearch::Fit StateSearch::at_walls(const Way &way, const Eigen::VectorXd &x, double speed,
                                       double deflection, double nothing) const {
    if (!_walls)
        return Fit::yes;
    Fit fit = Fit::yes;
    const std::vector<SteadyEquations::Push> pushes = _equations.pushes(x, speed, deflection);
    const auto turned = [](double angle) { return angle - 2 * pi * std::floor(angle / (2 * pi)); };
    for (std::size_t i = 0; i < _planes.size(); ++i)
        for (std::size_t k = 0; k < _planes[i].masses.size(); ++k) {
            const Mass &mass = _planes[i].masses[k];
            const int stop = way.stops[i][k];
            const double angle = x(_equations.rotor_unknowns() + mass.coordinate);
            // How far it stands in a wall, or beside.
            for (std::size_t s = 0; s < mass.stops.size(); s += 2) {
                if (stop >= 0 && static_cast<std::size_t>(stop) / 2 == s / 2)
                    continue;
                const double width = mass.stops[s + 1].angle - mass.stops[s].angle;
                const double into = turned(angle - mass.stops[s].angle);
                const double inside = std::min(into, width - into);
                if (inside > nothing)
                    return Fit::no;
                if (inside > -nothing || 2 * pi - into < nothing)
                    fit = Fit::undecided;
            }
            if (stop < 0)
                continue;
            const SteadyEquations::Push &push = pushes[static_cast<std::size_t>(mass.coordinate)];
            const double towards = push.torque * mass.stops[static_cast<std::size_t>(stop)].sense;
            if (towards < nothing * push.size) // nor one that nothing pushes: it is free
                return Fit::no;
        }
    return fit;
}

bool StateSearch::ends_at_wall(const Found &found) const {
    constexpr double near = 1e-6; // far more than an angle changes over what an end is known to
    return at_walls(_ways[static_cast<std::size_t>(found.way)], found.x, found.state.speed,
                    size_of_deflections(found.state.speed), near) != Fit::yes;
}

bool StateSearch::stand_alike(const Found &a, const Found &b) const {
    const Index angles = _equations.parts().free_angles();
    return same(a.x.tail(angles), b.x.tail(angles));
}

bool StateSearch::between_same_walls(const Eigen::VectorXd &a, const Eigen::VectorXd &b) const {
    const Index first = _equations.rotor_unknowns();
    for (const Plane &plane : _planes)
        for (const Mass &mass : plane.masses) {
            double nearest[2] = {2 * pi, 2 * pi};
            std::size_t before[2] = {0, 0}; // the wall before it
            for (std::size_t s = 0; s < mass.stops.size(); s += 2)
                for (const int which : {0, 1}) {
                    const double middle = (mass.stops[s].angle + mass.stops[s + 1].angle) / 2;
                    const double to = middle - (which == 0 ? a : b)(first + mass.coordinate);
                    const double gap = to - 2 * pi * std::floor(to / (2 * pi));
                    if (gap < nearest[which]) {
                        nearest[which] = gap;
                        before[which] = s;
                    }
                }
            if (before[0] != before[1])
                return false;
            // Between the same one wall: on the way from one to the other it is not passed.
            if (mass.stops.size() == 2 && std::abs(nearest[0] - nearest[1]) > pi)
                return false;
        }
    return true;
}

void StateSearch::write_wall_forces(Found &found) const {
    SteadyState &state = found.state;
    state.wall_forces.assign(_first_of.size(), {});
    if (!_walls)
        return;
    const std::vector<SteadyEquations::Push> pushes = _equations.pushes(found.x, state.speed, 0);
    const Way &way = _ways[static_cast<std::size_t>(found.way)];
    for (std::size_t i = 0; i < _planes.size(); ++i)
        for (std::size_t k = 0; k < _planes[i].masses.size(); ++k) {
            const Mass &mass = _planes[i].masses[k];
            if (mass.stops.empty())
                continue;
            const auto balancer = static_cast<std::size_t>(
                std::ranges::upper_bound(_first_of, mass.coordinate) - _first_of.begin() - 1);
            std::vector<double> &forces = state.wall_forces[balancer];
            forces.resize(_angles_of[balancer], 0.0);
            if (const int stop = way.stops[i][k]; stop >= 0)
                forces[static_cast<std::size_t>(mass.coordinate - _first_of[balancer])] =
                    std::abs(pushes[static_cast<std::size_t>(mass.coordinate)].torque) /
                    mass.stops[static_cast<std::size_t>(stop)].arm;
        }
}

double StateSearch::size_of_deflections(double speed) const {
    // Without the balls; of a rotor without imbalance that under all of them at one angle.
    Eigen::VectorXd load = _equations.load(speed);
    if (!_equations.driven())
        for (const Plane &plane : _planes)
            for (const Mass &mass : plane.masses)
                load += mass.moment * speed * speed *
                        _equations.plane_rows().row(4 * plane.index).transpose();
    const Eigen::VectorXd u = linalg::solved(_equations.stiffness(speed).partialPivLu(), load);
    const Eigen::VectorXd y = _equations.plane_rows() * u;
    double deflection = 0;
    for (Index i = 0; i < _equations.planes(); ++i)
        deflection = std::max(deflection, y.segment<2>(4 * i).norm());
    // Tracks out of round and tilted ones push as much as a deflection of that size does.
    for (const Plane &plane : _planes)
        for (const Mass &mass : plane.masses)
            deflection = std::max(
                deflection,
                (2 * std::abs(plane.out_of_round) + plane.slope.squaredNorm() / 2) * mass.radius);
    return deflection;
}

std::vector<StateSearch::Found> StateSearch::at(double speed, bool &undecided) const {
    std::vector<Found> out;
    const double deflection = size_of_deflections(speed);
    for (int way = 0; way < std::ssize(_ways); ++way)
        add_states(way, speed, deflection, Wanted::all, out, undecided);
    return out;
}

std::vector<StateSearch::Found> StateSearch::of_way(int way, double speed, bool &undecided,
                                                    Wanted wanted) const {
    std::vector<Found> out;
    add_states(way, speed, size_of_deflections(speed), wanted, out, undecided);
    return out;
}

bool StateSearch::same_ways(const StateSearch &other) const {
    const auto sides = [](const Way &way) { return way.sides; };
    return _equations.parts().free_angles() == other._equations.parts().free_angles() &&
           std::ranges::equal(_ways, other._ways, {}, sides, sides);
}

bool StateSearch::can_balance() const {
    return _swung.empty() && !_planes.empty() &&
           std::ranges::all_of(_planes, [](const Plane &plane) {
               return plane.masses.size() > 1 && !each_alone(plane);
           });
}

int StateSearch::free_motions() const {
    int motions = 0;
    for (const Plane &plane : _planes) {
        const auto masses = static_cast<int>(plane.masses.size());
        int coordinates = 0;
        for (const std::size_t balancer : plane.balancers)
            coordinates += _equations.parts().free[balancer].motion->size();
        if (masses > 2)
            motions += (masses - 2) * coordinates / masses;
    }
    return motions;
}

std::optional<StateSearch::Found> StateSearch::balanced(double speed, int member) const {
    const auto way = std::ranges::find_if(_ways, [](const Way &one) {
        return std::ranges::all_of(one.sides, [](const Sides &sides) { return sides.empty(); });
    });
    const Lines lines(*this, *way, speed);
    for (int k = 0; k < members; ++k) {
        Found out;
        Eigen::VectorXd angles;
        if (!place(*way, lines, Eigen::VectorXd(0), (member + k) % members, angles))
            return std::nullopt;
        out.way = static_cast<int>(way - _ways.begin());
        out.x = _equations.with_angles(angles, speed);
        out.state.defect = _equations.refine(out.x, speed, size_of_deflections(speed));
        out.along = along_family(*way, out.x.tail(angles.size()));
        out.state.family = out.along > 0;
        out.state.kind = SteadyState::Kind::balanced;
        if (out.state.defect <= (out.state.family ? second_order : refined)) {
            describe(out, speed);
            return out;
        }
    }
    throw linalg::SolverError(
        "terms of second order in the large slopes of the shaft move it away");
}

std::optional<StateSearch::Found>
StateSearch::followed(const Found &from, const Eigen::VectorXd &guess, double speed) const {
    Found out = from;
    out.x = _equations.with_angles(guess.tail(_equations.parts().free_angles()), speed);
    const double deflection = size_of_deflections(speed);
    const Way &way = _ways[static_cast<std::size_t>(from.way)];
    out.state.defect = _equations.refine(out.x, speed, deflection, way.held);
    if (out.state.defect > refined || at_walls(way, out.x, speed, deflection, beside) == Fit::no)
        return std::nullopt;
    describe(out, speed);
    return out;
}

SpeedExtremes extremes_of(const std::vector<double> &speeds) {
    std::vector<double> moving;
    for (const double speed : speeds)
        if (speed != 0)
            moving.push_back(std::abs(speed));
    if (moving.empty())
        return {};
    const auto [slowest, fastest] = std::ranges::minmax(moving);
    return {slowest, fastest};
}

namespace {

/// One rotor at many speeds.
class OverSpeeds : public Followed {
  public:
    OverSpeeds(const model::Case &scene, double slowest, double fastest)
        : _search(scene, slowest, fastest) {}
    [[nodiscard]] const StateSearch &search(double /*place*/) override { return _search; }
    [[nodiscard]] double speed(double place) const override { return place; }

  private:
    StateSearch _search;
};

/// A rotor for each value of an entry, at one speed.
class OverEntry : public Followed {
  public:
    OverEntry(double speed, std::function<model::Case(double)> with)
        : _speed(speed), _with(std::move(with)) {}

    [[nodiscard]] const StateSearch &search(double place) override {
        constexpr std::size_t most = 64; // two branches that meet ask for the same values
        const auto known = _searches.find(place);
        if (known != _searches.end())
            return *known->second;
        if (_searches.size() >= most)
            _searches.clear();
        auto made = std::make_shared<const StateSearch>(_with(place), _speed, _speed);
        if (!_first)
            _first = made;
        if (!made->same_ways(*_first))
            throw model::AnalysisFailure(
                "steady states are followed over entries that leave it as it is how many balls "
                "there are, which of them are alike and in one plane, and whether an imbalance "
                "drives the rotor; over this one it changes");
        return *_searches.emplace(place, std::move(made)).first->second;
    }
    [[nodiscard]] double speed(double /*place*/) const override { return _speed; }

  private:
    double _speed;
    std::function<model::Case(double)> _with;
    std::shared_ptr<const StateSearch> _first;
    std::map<double, std::shared_ptr<const StateSearch>> _searches;
};

/// All states at the places, joined. @param out  with the places; gets states and borders, whose
/// places are told as speeds
/// @throws model::BadInput where there is no rotor at any place
void follow(Followed &over, results::SteadyStates &out) {
    const std::vector<double> &places = out.places();
    std::vector<AtPlace> all;
    for (std::size_t i = 0; i < places.size(); ++i) {
        bool undecided = false;
        try {
            all.push_back({places[i], over.at(places[i], undecided),
                           !out.refused.empty() && out.refused.back() == places[i - 1]});
        } catch (const model::BadInput &why) {
            out.refused.push_back(places[i]);
            out.why_refused = why.what(); // of the last
            if (out.refused.size() == places.size())
                throw;
        }
        if (undecided)
            out.undecided.push_back(places[i]);
        process::report_progress(0.8 * static_cast<double>(i + 1) /
                                 static_cast<double>(places.size()));
    }
    join_branches(over, all, out);
    for (AtPlace &at : all)
        for (StateSearch::Found &found : at.states) {
            found.state.speed = found.place;
            out.states.push_back(std::move(found.state));
        }
}

model::AnalysisFailure not_found(const linalg::SolverError &error) {
    return model::AnalysisFailure(
        results::Sentence("steady states were not found: {}", error.sentence()));
}

} // namespace

results::SteadyStates steady_states(const model::Case &scene, const std::vector<double> &speeds) {
    results::SteadyStates out;
    for (const double speed : speeds)
        if (speed != 0)
            out.speeds.push_back(speed);
    if (scene.rotor.balancers.empty())
        throw model::AnalysisFailure("steady states are those of balancers; there are none");
    if (out.speeds.size() < speeds.size())
        out.notes.emplace_back(
            "at rest every position of the balls is steady: speed 0 is left out");
    if (out.speeds.empty())
        return out;
    const auto [slowest, fastest] = extremes_of(out.speeds);
    try {
        OverSpeeds over(scene, slowest, fastest);
        follow(over, out);
    } catch (const linalg::SolverError &error) {
        throw not_found(error);
    }
    return out;
}

results::SteadyStates steady_states_over(const model::SweepAxis &over, double speed,
                                         const std::function<model::Case(double)> &with) {
    results::SteadyStates out;
    out.speeds = {speed};
    out.over = over;
    try {
        OverEntry entry(speed, with);
        follow(entry, out);
    } catch (const linalg::SolverError &error) {
        throw not_found(error);
    }
    for (SteadyState &state : out.states)
        state.value = std::exchange(state.speed, speed);
    for (results::SteadyBorder &border : out.borders)
        border.value = std::exchange(border.speed, speed);
    return out;
}

} // namespace whirl::states
