#include "analyses/balance.h"

#include "balancers/kind.h"
#include "balancing/free_balancers.h"
#include "balancing/weights.h"
#include "closed_form/dry_friction.h"
#include "forced/imbalance_motions.h"
#include "forced/response_places.h"
#include "linalg/dense/singular_values.h"
#include "model/variants.h"
#include "process/parallel.h"
#include "results/formulation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

namespace whirl::analyses {

namespace {

using results::LeftMotion;
using results::PlaneSupply;
using results::Sentence;
using results::Supply;
namespace as = results::as;

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double no_bound = std::numeric_limits<double>::infinity();

/// Planes whose motions differ by less, over the motions themselves, are one: some digits above the
/// rounding of the motions.
constexpr double one_plane = 1e-9;
/// What the best supply may leave of the motion of the planes and still count as nothing.
constexpr double nothing_left = 1e-6;

/// What the free balancers in one plane can make.
struct Capacity {
    bool any = false;
    bool pendulums = false;
    double largest = 0;   ///< kg m, all together
    double longest = 0;   ///< kg m, one mass alone
    Complex centre;       ///< of their races, from the axis, m
    bool centres = false; ///< there are several
    bool open = true;     ///< no race is out of round or has walls

    /// A polygon of these sides closes unless one is longer than all others together.
    [[nodiscard]] double least() const { return std::max(0.0, 2 * longest - largest); }
    void add(const Capacity &other) {
        centres = centres || other.centres || (any && other.any && centre != other.centre);
        if (!any)
            centre = other.centre;
        any = any || other.any;
        pendulums = pendulums || other.pendulums;
        open = open && other.open;
        largest += other.largest;
        longest = std::max(longest, other.longest);
    }
};

/// @returns of each plane; of several planes at one place each balancer there has its own
std::vector<Capacity> capacities_of(const model::Rotor &rotor,
                                    const std::vector<model::CorrectionPlane> &planes) {
    std::vector<Capacity> out(planes.size());
    for (const model::Balancer &balancer : rotor.balancers) {
        std::optional<std::size_t> own;
        for (std::size_t p = 0; p < planes.size(); ++p)
            if (planes[p].z == balancer.z && (!own || (out[*own].any && !out[p].any)))
                own = p; // the first at its place that no balancer has yet
        if (!own)
            continue;
        const auto kind = balancers::kind_of(balancer);
        Capacity &capacity = out[*own];
        Capacity more{
            true,  !kind->swung().empty(), kind->reach().imbalance, 0, kind->race_centre(),
            false, !kind->obstructed()};
        for (const balancers::CircledMass &mass : kind->circled())
            more.longest = std::max(more.longest, mass.moment);
        capacity.add(more);
    }
    return out;
}

/// The equal balls that resist rolling where they are all that is free on an axisymmetric rotor:
/// their number, mass, radius and friction; the rest of it depends on the speed. None of all
/// others.
std::optional<closed_form::DryBalls> dry_balls(const model::Rotor &rotor) {
    if (rotor.balancers.size() != 1)
        return std::nullopt;
    const auto *balls = std::get_if<model::Balls>(&rotor.balancers.front().parts);
    if (!balls || balls->rows.size() != 1)
        return std::nullopt;
    const model::BallRow &row = balls->rows.front();
    if (row.n < 2 || row.rolling <= 0)
        return std::nullopt;
    closed_form::DryBalls out;
    out.n = row.n;
    out.mass = row.mass;
    out.radius = row.radius;
    out.friction = 2 * row.rolling / row.diameter;
    return out;
}

/// Planes at one place, whose balancers see the same motion and do their work together.
struct Place {
    std::vector<Index> planes;
    Capacity capacity; ///< of all their balancers
};

/// The places of planes that count: those with balancers; without any balancer all.
std::vector<Place> places_of(const std::vector<model::CorrectionPlane> &planes,
                             const std::vector<Capacity> &capacities) {
    const bool any = std::ranges::any_of(capacities, &Capacity::any);
    std::vector<Place> out;
    for (std::size_t p = 0; p < planes.size(); ++p) {
        if (any && !capacities[p].any)
            continue;
        auto at = std::ranges::find_if(out, [&](const Place &place) {
            return planes[static_cast<std::size_t>(place.planes.front())].z == planes[p].z;
        });
        if (at == out.end())
            at = out.insert(out.end(), Place{});
        at->planes.push_back(static_cast<Index>(p));
        at->capacity.add(capacities[p]);
    }
    return out;
}

/// The phases of [weights] count against the spin, and all others with them.
bool phases_lag(const model::Case &scene) { return scene.weights && scene.weights->lag; }

/// The rotor whose motion it is: without free balancers, with what is to be balanced.
model::Rotor unbalanced_rotor(const model::Case &scene, const criterion::BalanceScene &s) {
    model::Rotor rotor = s.rotor;
    rotor.imbalances = model::with_balancer_imbalances(scene.rotor).imbalances;
    const bool lag = phases_lag(scene);
    for (const model::CorrectionPlane &plane : rotor.planes)
        for (const Complex &weight : plane.fixed)
            rotor.imbalances.push_back(
                {"", plane.z, std::abs(weight), lag ? -std::arg(weight) : std::arg(weight)});
    std::erase_if(rotor.imbalances, [](const auto &imbalance) { return imbalance.mr == 0; });
    return rotor;
}

/// Motions of all that is looked at, a row each, under the imbalances that are there (first column)
/// and under unit imbalances in the planes: one a plane at angle 0, of a rotor that is not
/// axisymmetric another at a right angle to it.
struct Motions {
    bool known = false;
    Eigen::MatrixXcd x, y;
};

/// What is looked at: planes, probes, bearings, then the bearings' forces.
class Places {
  public:
    Places(const criterion::BalanceScene &s, const assembly::Discretization &d) {
        const model::Rotor &rotor = s.rotor;
        for (std::size_t i = 0; i < s.planes.size(); ++i)
            add(forced::Quantity{d.deflection_at(s.planes[i].z)}, "plane", rotor.plane_name(i),
                s.planes[i].z);
        for (std::size_t i = 0; i < rotor.probes.size(); ++i)
            add(forced::quantity_of(d, rotor.probes[i]), "probe", rotor.probe_name(i),
                rotor.probes[i].z);
        for (std::size_t i = 0; i < rotor.supports().size(); ++i)
            add(forced::Quantity{d.deflection_at(rotor.bearings[i].z)}, "bearing",
                model::name_or_number(rotor.bearings[i].name, "bearing", i), rotor.bearings[i].z);
        for (std::size_t i = 0; i < rotor.supports().size(); ++i)
            _quantities.emplace_back().bearing = static_cast<int>(i);
        _probes = !rotor.probes.empty();
        _planes = s.planes.size();
    }

    [[nodiscard]] const std::vector<results::LeftAt> &names() const { return _names; }
    [[nodiscard]] std::size_t planes() const { return _planes; }
    [[nodiscard]] std::size_t size() const { return _quantities.size(); }
    /// Row of a bearing's force; of the place with this number.
    [[nodiscard]] std::optional<Index> force_of(std::size_t place) const {
        if (_names[place].of != "bearing")
            return std::nullopt;
        const std::size_t bearings = _quantities.size() - _names.size();
        return static_cast<Index>(place + bearings);
    }
    /// The weights are to make it small: the probes, without any all places.
    [[nodiscard]] bool counts(std::size_t place) const {
        return !_probes || _names[place].of == "probe";
    }

    [[nodiscard]] std::vector<double> read(forced::ImbalanceMotions &motions,
                                           std::size_t sets) const {
        std::vector<double> row;
        for (std::size_t set = 0; set < sets; ++set)
            for (const forced::Quantity &quantity : _quantities) {
                const forced::Phasor seen = motions.of(set).of(quantity);
                row.insert(row.end(), {seen.x.real(), seen.x.imag(), seen.y.real(), seen.y.imag()});
            }
        return row;
    }
    /// @param row  of read(), or empty where there is no motion
    [[nodiscard]] Motions motions(const std::vector<double> &row, std::size_t sets) const {
        Motions out;
        out.known = !row.empty();
        const auto rows = static_cast<Index>(size());
        const auto columns = static_cast<Index>(sets);
        out.x = out.y = Eigen::MatrixXcd::Zero(rows, columns);
        if (!out.known)
            return out;
        const double *next = row.data();
        for (Index set = 0; set < columns; ++set)
            for (Index i = 0; i < rows; ++i, next += 4) {
                out.x(i, set) = {next[0], next[1]};
                out.y(i, set) = {next[2], next[3]};
            }
        return out;
    }
    /// Largest over a turn: what a probe reads, the semi-major axis of an orbit or a force.
    [[nodiscard]] double amplitude(Index row, Complex x, Complex y) const {
        const auto place = static_cast<std::size_t>(row);
        if (place < _names.size() && _names[place].of == "probe")
            return std::abs(x);
        const forced::WhirlParts parts(forced::Phasor{x, y});
        return std::abs(parts.a) + std::abs(parts.d);
    }

  private:
    std::vector<forced::Quantity> _quantities;
    std::vector<results::LeftAt> _names;
    std::size_t _planes = 0;
    bool _probes = false;

    void add(forced::Quantity quantity, const char *of, const std::string &name, double z) {
        quantity.z = z;
        _quantities.push_back(std::move(quantity));
        _names.push_back({of, name, z, {}, {}});
    }
};

/// At one speed what the planes need and what is left.
class AtSpeed {
  public:
    AtSpeed(const Motions &motions, std::size_t planes, bool any_direction)
        : _motions(motions), _planes(static_cast<Index>(planes)), _any_direction(any_direction) {}

    /// Factors of the columns of the motions under these weights in the planes, kg m.
    [[nodiscard]] Eigen::VectorXcd factors(const Eigen::VectorXcd &weights) const {
        Eigen::VectorXcd out(_motions.x.cols());
        out(0) = 1;
        for (Index p = 0; p < _planes; ++p)
            if (_any_direction) {
                out(1 + p) = weights(p);
            } else {
                out(1 + 2 * p) = weights(p).real();
                out(2 + 2 * p) = weights(p).imag();
            }
        return out;
    }

    /// The mean over a turn of the motion of a plane in the rotor: its forward part.
    [[nodiscard]] Complex forward(Index plane, Index column) const {
        return forced::WhirlParts({_motions.x(plane, column), _motions.y(plane, column)}).a;
    }
    [[nodiscard]] Eigen::VectorXcd forward(const Eigen::VectorXcd &weights) const {
        Eigen::VectorXcd out(_planes);
        const Eigen::VectorXcd by = factors(weights);
        for (Index p = 0; p < _planes; ++p)
            out(p) = forced::WhirlParts(
                         {(_motions.x.row(p) * by).value(), (_motions.y.row(p) * by).value()})
                         .a;
        return out;
    }

    /// The forward motions of some planes under moments in them, on (Re; Im).
    [[nodiscard]] Eigen::MatrixXd real_matrix(const std::vector<Index> &of) const {
        const auto n = static_cast<Index>(of.size());
        Eigen::MatrixXd B(2 * n, 2 * n);
        for (Index i = 0; i < n; ++i)
            for (Index k = 0; k < n; ++k) {
                const Index row = of[static_cast<std::size_t>(i)];
                const Index plane = of[static_cast<std::size_t>(k)];
                const Complex along = forward(row, _any_direction ? 1 + plane : 1 + 2 * plane);
                const Complex across =
                    _any_direction ? Complex(0, 1) * along : forward(row, 2 + 2 * plane);
                B(i, k) = along.real();
                B(n + i, k) = along.imag();
                B(i, n + k) = across.real();
                B(n + i, n + k) = across.imag();
            }
        return B;
    }

    [[nodiscard]] Eigen::MatrixXcd complex_matrix(const std::vector<Index> &of) const {
        const auto n = static_cast<Index>(of.size());
        Eigen::MatrixXcd A(n, n);
        for (Index i = 0; i < n; ++i)
            for (Index k = 0; k < n; ++k)
                A(i, k) =
                    forward(of[static_cast<std::size_t>(i)], 1 + of[static_cast<std::size_t>(k)]);
        return A;
    }

  private:
    const Motions &_motions;
    Index _planes;
    bool _any_direction; ///< the rotor is axisymmetric
};

/// The criterion for some planes.
bool works(const Eigen::MatrixXd &B) { return balancing::works_everywhere(B.cast<Complex>()); }

/// Moments in some planes that take their motion away.
struct TakingAway {
    Eigen::VectorXcd u;
    bool only = true; ///< no others do
};

/// Of several that do those of least sum |u_j|^2 / c_j: each balancer then has as large a part of
/// the work as of what there is, where all can do the same. None where nothing does.
/// @param capacity  c, kg m; infinite without balancers, where all planes count alike
std::optional<TakingAway> taking_away(const Eigen::MatrixXd &B, const Eigen::VectorXcd &w,
                                      const Eigen::VectorXd &capacity) {
    const Index n = w.size();
    // Far from the rounding of planes that are one, or small balancers would be left out.
    constexpr double smallest = 1e-6;
    const double most = capacity.size() > 0 ? capacity.maxCoeff() : 0;
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(2 * n);
    if (std::isfinite(most) && most > 0)
        for (Index j = 0; j < n; ++j)
            scale(j) = scale(n + j) = std::sqrt(std::max(capacity(j) / most, smallest));
    Eigen::VectorXd right(2 * n);
    right << w.real(), w.imag();
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(B * scale.asDiagonal(),
                                          Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(one_plane);
    const Eigen::VectorXd x = scale.cwiseProduct(svd.solve(-right));
    const Eigen::VectorXd left = right + B * x;
    if (!x.allFinite() || left.norm() > nothing_left * right.norm())
        return std::nullopt;
    TakingAway out{Eigen::VectorXcd(n), svd.rank() == 2 * n};
    out.u.real() = x.head(n);
    out.u.imag() = x.tail(n);
    return out;
}

/// Of all moments that do the same as u those whose largest |u_j|/c_j is least.
Eigen::VectorXcd evenly(const Eigen::MatrixXcd &A, const Eigen::VectorXcd &u,
                        const Eigen::VectorXd &capacity) {
    const linalg::SingularValues svd = linalg::singular_values(A);
    Index rank = 0;
    while (rank < svd.s.size() && svd.s(rank) > one_plane * svd.s(0))
        ++rank;
    const Eigen::MatrixXcd idle = svd.V.rightCols(u.size() - rank);
    const balancing::Solution best = balancing::minimax(
        {idle, u, capacity.cwiseInverse(), Eigen::VectorXd::Constant(idle.cols(), no_bound)});
    return u + idle * best.w;
}

class SupplyFinder {
  public:
    SupplyFinder(const model::Case &scene, const criterion::BalanceScene &s,
                 results::BalanceResult &result)
        : _scene(scene), _s(s), _result(result), _rotor(unbalanced_rotor(scene, s)),
          _any_direction(!results::in_rotating_axes(s.formulation.form)),
          _motions(_rotor, s.order, s.formulation.form, sets()),
          _places(s, _motions.discretization()), _capacities(capacities_of(scene.rotor, s.planes)),
          _active(places_of(s.planes, _capacities)),
          _dry(_any_direction && any_balancer() ? dry_balls(scene.rotor) : std::nullopt) {}

    void add() {
        std::vector<double> speeds = _s.speeds;
        const std::vector<std::size_t> of_weights = add_weight_speeds(speeds);
        std::vector<Motions> all = motions_at(speeds);
        if (all.empty()) // of another process
            return;
        begin();
        find_weights(speeds, of_weights, all);
        for (std::size_t k = 0; k < _s.speeds.size(); ++k)
            add_speed(_s.speeds[k], all[k]);
        add_notes();
        if (phases_lag(_scene))
            turn_phases();
        _result.supply = std::move(_out);
    }

  private:
    const model::Case &_scene;
    const criterion::BalanceScene &_s;
    results::BalanceResult &_result;
    model::Rotor _rotor;
    bool _any_direction;
    forced::ImbalanceMotions _motions;
    Places _places;
    std::vector<Capacity> _capacities;
    std::vector<Place> _active;
    std::optional<closed_form::DryBalls> _dry; ///< in the only active plane
    Eigen::VectorXcd _weights;                 ///< empty: none are known
    std::vector<double> _idle_weight_speeds;   ///< asked for, but a resonance, rad/s
    results::BalanceSupply _out;

    [[nodiscard]] std::size_t set_count() const {
        return 1 + (_any_direction ? 1 : 2) * _s.planes.size();
    }
    [[nodiscard]] std::vector<forced::ImbalanceMotions::Imbalances> sets() const {
        std::vector<forced::ImbalanceMotions::Imbalances> out{_rotor.imbalances};
        constexpr double right_angle = std::numbers::pi / 2;
        for (const model::CorrectionPlane &plane : _s.planes) {
            out.push_back({{"", plane.z, 1.0, 0.0}});
            if (!_any_direction)
                out.push_back({{"", plane.z, 1.0, right_angle}});
        }
        return out;
    }

    [[nodiscard]] bool any_balancer() const {
        return std::ranges::any_of(_capacities, &Capacity::any);
    }
    [[nodiscard]] bool any_pendulum() const {
        return std::ranges::any_of(_capacities, &Capacity::pendulums);
    }
    /// In some plane no motion lets the balls of all races rest apart.
    [[nodiscard]] bool several_centres() const {
        return std::ranges::any_of(_active,
                                   [](const Place &place) { return place.capacity.centres; });
    }
    [[nodiscard]] bool all_open() const {
        return std::ranges::all_of(_capacities, &Capacity::open);
    }
    /// One plane of each place.
    [[nodiscard]] std::vector<Index> first_planes() const {
        std::vector<Index> out;
        for (const Place &place : _active)
            out.push_back(place.planes.front());
        return out;
    }

    /// What [weights] asks for, else the operating speeds of the grid, else all.
    std::vector<std::size_t> add_weight_speeds(std::vector<double> &speeds) const {
        std::vector<std::size_t> out;
        const auto add = [&](double speed) {
            out.push_back(speeds.size());
            speeds.push_back(speed);
        };
        if (_scene.weights && !_scene.weights->speeds.empty()) {
            for (const double speed : _scene.weights->speeds)
                add(speed);
            return out;
        }
        for (std::size_t k = 0; k < _s.speeds.size(); ++k)
            if (_s.speeds[k] > 0 && (!_scene.operation || (_s.speeds[k] >= _scene.operation->from &&
                                                           _s.speeds[k] <= _scene.operation->to)))
                out.push_back(k);
        if (out.empty() && _scene.operation)
            for (const double speed : {_scene.operation->from, _scene.operation->to})
                if (speed > 0)
                    add(speed);
        return out;
    }

    std::vector<Motions> motions_at(const std::vector<double> &speeds) {
        const auto row = [&](double speed) {
            return speed != 0 && _motions.solve(speed) ? _places.read(_motions, set_count())
                                                       : std::vector<double>();
        };
        std::vector<Motions> out;
        for (const std::vector<double> &numbers : process::rows_at(speeds, row))
            out.push_back(_places.motions(numbers, set_count()));
        return out;
    }

    void begin() {
        for (std::size_t p = 0; p < _s.planes.size(); ++p) {
            PlaneSupply plane;
            if (_capacities[p].any) {
                plane.capacity = _capacities[p].largest;
                plane.least = _capacities[p].least();
            }
            _out.planes.push_back(std::move(plane));
        }
        _out.left = _places.names();
        for (std::size_t i = 0; i < _out.left.size(); ++i)
            if (_places.force_of(i))
                _out.left[i].force.emplace();
    }

    /// The best weights in the planes for these speeds, as the command weights finds them.
    void find_weights(const std::vector<double> &speeds, const std::vector<std::size_t> &chosen,
                      const std::vector<Motions> &all) {
        if (!_any_direction)
            return;
        std::vector<Index> places;
        for (std::size_t i = 0; i < _places.names().size(); ++i)
            if (_places.counts(i))
                places.push_back(static_cast<Index>(i));
        std::vector<std::size_t> known;
        for (const std::size_t k : chosen)
            if (all[k].known) {
                known.push_back(k);
                _out.weight_speeds.push_back(speeds[k]);
            } else {
                _idle_weight_speeds.push_back(speeds[k]);
            }
        if (known.empty())
            return;
        const auto planes = static_cast<Index>(_s.planes.size());
        const auto rows = 2 * static_cast<Index>(known.size() * places.size());
        balancing::Balance balance{Eigen::MatrixXcd::Zero(rows, planes),
                                   Eigen::VectorXcd::Zero(rows), Eigen::VectorXd(rows),
                                   Eigen::VectorXd(planes)};
        Index row = 0;
        for (const std::size_t k : known)
            for (const Index place : places)
                for (const Eigen::MatrixXcd *of : {&all[k].x, &all[k].y}) {
                    balance.a(row) = (*of)(place, 0);
                    balance.H.row(row) = of->row(place).tail(planes);
                    balance.factors(row++) = factor_of(static_cast<std::size_t>(place));
                }
        for (Index p = 0; p < planes; ++p)
            balance.largest(p) = _s.planes[static_cast<std::size_t>(p)].max.value_or(no_bound);
        const bool minimax =
            _scene.weights && _scene.weights->method == model::WeightsMethod::minimax;
        _weights = (minimax ? balancing::minimax(balance) : balancing::least_squares(balance)).w;
        for (Index p = 0; p < planes; ++p) {
            _weights(p) = balancing::without_rounding(_weights(p), imbalance_there());
            _out.planes[static_cast<std::size_t>(p)].weight = _weights(p);
        }
    }

    [[nodiscard]] double factor_of(std::size_t place) const {
        if (_scene.weights && _places.names()[place].of == "probe")
            for (const auto &[name, factor] : _scene.weights->factors)
                if (name == _places.names()[place].name)
                    return factor;
        return 1;
    }

    /// What the balancers supply, in all planes, with what stands in the planes already.
    struct Found {
        Supply supply = Supply::unknown;
        std::optional<Eigen::VectorXcd> needed, supplied;
    };

    /// Planes at one place have each as large a part as of what there is.
    [[nodiscard]] Eigen::VectorXcd in_all_planes(const Eigen::VectorXcd &of_places) const {
        Eigen::VectorXcd out = Eigen::VectorXcd::Zero(static_cast<Index>(_s.planes.size()));
        for (std::size_t i = 0; i < _active.size(); ++i) {
            const Place &place = _active[i];
            const double all = place.capacity.largest;
            for (const Index plane : place.planes)
                out(plane) = of_places(static_cast<Index>(i)) *
                             (all > 0 ? _capacities[static_cast<std::size_t>(plane)].largest / all
                                      : 1 / static_cast<double>(place.planes.size()));
        }
        return out;
    }

    [[nodiscard]] Found found(const AtSpeed &at, const Eigen::VectorXcd &weights) const {
        Found out;
        const auto n = static_cast<Index>(_active.size());
        const std::vector<Index> planes = first_planes();
        const Eigen::VectorXcd everywhere = at.forward(weights);
        Eigen::VectorXcd w(n);
        Eigen::VectorXd capacity(n), least(n);
        for (Index i = 0; i < n; ++i) {
            const Place &place = _active[static_cast<std::size_t>(i)];
            // Balls still the centre of their race, not the axis.
            w(i) = everywhere(place.planes.front()) + place.capacity.centre;
            capacity(i) = any_balancer() ? place.capacity.largest : no_bound;
            least(i) = any_balancer() ? place.capacity.least() : 0;
        }
        // An input may ask for just the capacity: more than its rounding is beyond.
        constexpr double just = 1e-12;
        const auto enough = [&](const Eigen::VectorXcd &u) {
            return (u.cwiseAbs().array() <= capacity.array() * (1 + just)).all();
        };
        const auto fine = [&](const Eigen::VectorXcd &u) {
            return (u.cwiseAbs().array() >= least.array() * (1 - just)).all();
        };
        if (several_centres() || !all_open())
            return out;
        const Eigen::MatrixXd B = at.real_matrix(planes);
        const std::optional<TakingAway> away = taking_away(B, w, capacity);
        std::optional<Eigen::VectorXcd> needed;
        if (away)
            needed = away->u;
        const bool shared = away && !away->only && (capacity.array() > 0).all();
        if (shared && !enough(*needed) && _any_direction)
            needed = evenly(at.complex_matrix(planes), *needed, capacity);
        if (needed) {
            const double size = imbalance_there() + weights.cwiseAbs().sum();
            for (Complex &own : *needed)
                own = balancing::without_rounding(own, size);
            out.needed = in_all_planes(*needed);
        }
        if (any_pendulum())
            return out;
        if (shared && !enough(*needed) && !_any_direction)
            return out; // other shares may do
        if (!works(B)) {
            out.supply = !needed           ? Supply::out_of_reach
                         : enough(*needed) ? Supply::unkept
                                           : Supply::beyond;
            if (out.supply == Supply::unkept && fine(*needed))
                out.supplied = out.needed; // damping may keep it all the same
            return out;
        }
        if (needed && enough(*needed)) {
            out.supply = fine(*needed) ? Supply::balanced : Supply::coarse;
            if (out.supply == Supply::balanced)
                out.supplied = out.needed;
            return out;
        }
        out.supply = needed ? Supply::beyond : Supply::out_of_reach;
        if (!_any_direction || (capacity.array() <= 0).any())
            return out;
        const auto best = balancing::best_supply({at.complex_matrix(planes), w, capacity});
        if (!best) { // there is one, but it was not found
            out.supply = Supply::unknown;
            return out;
        }
        out.supply = fine(*best) ? Supply::saturated : Supply::coarse;
        if (out.supply != Supply::coarse)
            out.supplied = in_all_planes(*best);
        return out;
    }

    /// The moments of all imbalances that are there, kg m.
    [[nodiscard]] double imbalance_there() const {
        double sum = 0;
        for (const model::Imbalance &own : _rotor.imbalances)
            sum += std::abs(own.mr);
        return sum;
    }

    /// Where balls that resist rolling rest.
    /// @param at  the motions at a speed; none: there are none
    void add_friction(const AtSpeed *at, const std::optional<Eigen::VectorXcd> &needed) {
        if (!_dry)
            return;
        const Index plane = _active.front().planes.front();
        std::optional<results::RestWithFriction> &out =
            _out.planes[static_cast<std::size_t>(plane)].friction.emplace_back();
        if (!at || !needed)
            return;
        closed_form::DryBalls balls = *_dry;
        balls.K = 1.0 / at->forward(plane, 1 + plane) - balls.n * balls.mass;
        balls.imbalance = std::abs((*needed)(plane));
        if (balls.n > 2) {
            if (const auto bound = closed_form::dry_bound(balls))
                out = {*bound, {}, {}};
        } else if (const auto rest = closed_form::dry_rest(balls)) {
            out = {rest->residual, rest->from, rest->to};
        }
    }

    void add_left(const Motions &motions, const std::optional<Eigen::VectorXcd> &factors,
                  LeftMotion::Values LeftMotion::*of) {
        const auto value = [&](Index row) -> std::optional<double> {
            if (!factors)
                return std::nullopt;
            return _places.amplitude(row, (motions.x.row(row) * *factors).value(),
                                     (motions.y.row(row) * *factors).value());
        };
        for (std::size_t i = 0; i < _out.left.size(); ++i) {
            results::LeftAt &left = _out.left[i];
            (left.amplitude.*of).push_back(value(static_cast<Index>(i)));
            if (left.force)
                ((*left.force).*of).push_back(value(*_places.force_of(i)));
        }
    }

    void add_needed(const Found &found, PlaneSupply::Moments PlaneSupply::*of) {
        for (std::size_t p = 0; p < _out.planes.size(); ++p) {
            const auto plane = static_cast<Index>(p);
            const bool counts = std::ranges::any_of(_active, [plane](const Place &place) {
                return std::ranges::find(place.planes, plane) != place.planes.end();
            });
            (_out.planes[p].*of)
                .push_back(counts && found.needed ? std::optional((*found.needed)(plane))
                                                  : std::nullopt);
        }
    }

    /// At rest nothing moves; at a resonance without damping there is no motion to speak of.
    void add_without_motion(Supply supply) {
        const Found none{supply, {}, {}};
        add_needed(none, &PlaneSupply::needed);
        add_needed(none, &PlaneSupply::beside_weights);
        add_friction(nullptr, std::nullopt);
        _out.with_balancers.push_back(supply);
        _out.with_both.push_back(supply);
        _out.works.push_back(false);
        const std::optional<double> value =
            supply == Supply::at_rest ? std::optional(0.0) : std::nullopt;
        for (results::LeftAt &left : _out.left)
            for (LeftMotion *motion : {&left.amplitude, left.force ? &*left.force : nullptr})
                if (motion)
                    for (const auto of : {&LeftMotion::nothing, &LeftMotion::weights,
                                          &LeftMotion::balancers, &LeftMotion::both})
                        (motion->*of).push_back(value);
    }

    void add_speed(double speed, const Motions &motions) {
        if (!motions.known) {
            add_without_motion(speed == 0 ? Supply::at_rest : Supply::resonance);
            return;
        }
        const AtSpeed at(motions, _s.planes.size(), _any_direction);
        const Eigen::VectorXcd none = Eigen::VectorXcd::Zero(static_cast<Index>(_s.planes.size()));
        const auto factors = [&](const std::optional<Eigen::VectorXcd> &supplied,
                                 const Eigen::VectorXcd &weights) {
            return supplied ? std::optional<Eigen::VectorXcd>(at.factors(*supplied + weights))
                            : std::nullopt;
        };
        _out.works.push_back(works(at.real_matrix(first_planes())));
        const Found alone = found(at, none);
        add_needed(alone, &PlaneSupply::needed);
        add_friction(&at, alone.needed);
        _out.with_balancers.push_back(alone.supply);
        add_left(motions, at.factors(none), &LeftMotion::nothing);
        add_left(motions, factors(alone.supplied, none), &LeftMotion::balancers);
        if (_weights.size() == 0) {
            add_needed({}, &PlaneSupply::beside_weights);
            _out.with_both.push_back(Supply::unknown);
            add_left(motions, std::nullopt, &LeftMotion::weights);
            add_left(motions, std::nullopt, &LeftMotion::both);
            return;
        }
        const Found beside = found(at, _weights);
        add_needed(beside, &PlaneSupply::beside_weights);
        _out.with_both.push_back(beside.supply);
        add_left(motions, at.factors(_weights), &LeftMotion::weights);
        add_left(motions, factors(beside.supplied, _weights), &LeftMotion::both);
    }

    void add_notes() {
        std::vector<Sentence> &notes = _result.model.notes;
        for (std::size_t i = 0; i < _scene.rotor.balancers.size(); ++i) {
            const model::Balancer &balancer = _scene.rotor.balancers[i];
            if (std::ranges::none_of(_s.planes, [&](const model::CorrectionPlane &plane) {
                    return plane.z == balancer.z;
                }))
                notes.emplace_back("{} stands in none of the planes: what it can supply is not "
                                   "counted",
                                   model::name_or_number(balancer.name, "balancer", i));
        }
        const auto with_balancer =
            static_cast<std::size_t>(std::ranges::count_if(_capacities, &Capacity::any));
        if (with_balancer > 0 && with_balancer < _s.planes.size())
            notes.emplace_back("what is needed is that of the planes with a balancer, {} of {}",
                               with_balancer, _s.planes.size());
        if (with_balancer > 0 && std::ranges::any_of(_active, [](const Place &place) {
                return place.planes.size() > 1;
            }))
            notes.emplace_back(
                "balancers in one plane share what is needed there as their capacities are: where "
                "none has more to do than it can while another could do more");
        if (any_pendulum())
            notes.emplace_back("pendulums do not take away the motion of their plane: what they "
                               "leave is not among the residuals (see pendulum)");
        if (!_any_direction)
            notes.emplace_back(
                "weights move a rotor that is not axisymmetric by more or less as "
                "they stand to its axes: none are chosen, and where balancers beyond "
                "their capacity end is not known");
        const auto holds = [this](Supply of) {
            return std::ranges::find(_out.with_balancers, of) != _out.with_balancers.end();
        };
        if (_any_direction && !_rotor.bearings_isotropic())
            notes.emplace_back(
                "bearings differ between x and y: balancers take away the mean over "
                "a turn, the forward part of the motion of their planes; the "
                "backward part stays, and moves their parts to and fro twice a turn");
        if (holds(Supply::beyond) && _any_direction)
            notes.emplace_back("where balancers need more than their capacity and the criterion "
                               "does not hold, where they end is not known: null among the "
                               "residuals");
        if (several_centres())
            notes.emplace_back("races in one plane are off the axis by different eccentricities: "
                               "no motion of the plane lets the balls of all of them rest apart, "
                               "and what they supply is not answered");
        if (!all_open())
            notes.emplace_back(
                "balls in races that are out of round (ellipticity), tilted or have walls stand "
                "where these hold them: what they supply and leave is not answered; "
                "`simulate` and [states] find where they stand");
        if (holds(Supply::unknown) && !any_pendulum() && !several_centres() && all_open())
            notes.emplace_back(
                "at some speeds where balancers need more than their capacity, where "
                "they end was not found: null among the residuals");
        if (holds(Supply::coarse))
            notes.emplace_back("where less is needed than the parts of a balancer always make, "
                               "what they leave is not known: null among the residuals");
        if (holds(Supply::out_of_reach))
            notes.emplace_back("at some speeds no imbalances in the planes take away their motion: "
                               "out of reach");
        std::vector<double> resonances;
        for (std::size_t k = 0; k < _s.speeds.size(); ++k)
            if (_out.with_balancers[k] == Supply::resonance)
                resonances.push_back(_s.speeds[k]);
        if (!resonances.empty())
            notes.emplace_back("at {} the rotor is at a resonance without damping: null there",
                               as::speed.list(resonances));
        if (!_idle_weight_speeds.empty())
            notes.emplace_back(
                model::Weight::warning,
                "at {} the rotor is at a resonance without damping: the weights are {}",
                as::speed.list(_idle_weight_speeds),
                _out.weight_speeds.empty() ? "not known" : "those for the other speeds alone");
    }

    /// As the case has its phases: against the spin.
    void turn_phases() {
        _out.lag = true;
        const auto turned = [](Complex own) { // of a real number no imaginary part of -0
            return balancing::without_rounding(std::conj(own), 0);
        };
        for (PlaneSupply &plane : _out.planes) {
            for (PlaneSupply::Moments *moments : {&plane.needed, &plane.beside_weights})
                for (std::optional<Complex> &own : *moments)
                    if (own)
                        own = turned(*own);
            if (plane.weight)
                plane.weight = turned(*plane.weight);
        }
    }
};

} // namespace

void add_supply(const model::Case &scene, const criterion::BalanceScene &s,
                results::BalanceResult &result) {
    if (!balancers::has_eccentric_race(scene.rotor.balancers) &&
        unbalanced_rotor(scene, s).imbalances.empty())
        return;
    if (s.formulation.form == results::Form::hill) {
        result.model.notes.emplace_back(
            "what balancers must supply is not answered where neither the rotor nor its bearings "
            "are the same from every direction: they would have to take away motions of several "
            "frequencies");
        return;
    }
    SupplyFinder(scene, s, result).add();
}

} // namespace whirl::analyses
