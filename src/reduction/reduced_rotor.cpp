#include "reduction/reduced_rotor.h"

#include "assembly/assemble.h"
#include "assembly/planar_part.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "linalg/dense/products.h"
#include "linalg/sparse_factor.h"
#include "linalg/symmetric_eigen.h"
#include "model/errors.h"
#include "reduction/damped_motions.h"
#include "reduction/orthonormal.h"
#include "reduction/reduction_error.h"

#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <set>

namespace whirl::reduction {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using assembly::Term;

/// Up to this many planar unknowns nothing is gained by a reduction.
constexpr int small_enough = 8;
/// More modes than that are as good as none left out.
constexpr int most_modes = 60;

/// Planar matrices of the whole rotor, shifted so that a free rotor is held: K + shift M is
/// positive definite.
struct HeldPair : assembly::PlanarPair {
    double shift = 0; ///< 1/s2
};

HeldPair held_pair(const assembly::Discretization &d, const ReductionGoal &goal) {
    HeldPair pair{assembly::planar_pair(d, goal.speed), 0};
    // At the least as much as holds a free rotor against the rounding of its stiffness.
    constexpr double rounding = 1e-13;
    pair.shift = 0.01 * goal.fastest * goal.fastest;
    for (Eigen::Index i = 0; i < pair.M.rows(); ++i)
        if (pair.M.coeff(i, i) > 0)
            pair.shift = std::max(pair.shift, rounding * pair.K.coeff(i, i) / pair.M.coeff(i, i));
    return pair;
}

/// Mass-orthonormal combinations of the columns that make the stiffness diagonal, ascending.
Eigen::MatrixXd ritz_shapes(const HeldPair &pair, const Eigen::MatrixXd &columns) {
    Eigen::MatrixXd V(columns.rows(), 0);
    take_in(V, pair.M, columns, 1e-7);
    const Eigen::MatrixXd K = linalg::transposed_times(V, pair.K * V);
    return V * linalg::symmetric_eigenpairs(K).eigenvectors();
}

/// Deflections K - w^2 M + speed w G gives under unit loads on these combinations: forward whirl at
/// the frequency w, or backward where it is below 0; static where that matrix is singular.
Eigen::MatrixXd whirl_shapes(const HeldPair &pair, double speed, double w,
                             const std::vector<assembly::Combination> &loaded) {
    const Eigen::MatrixXd forces = assembly::unit_loads(loaded, pair.M.rows());
    Sparse A = pair.K - w * w * pair.M + speed * w * pair.G;
    A.makeCompressed();
    linalg::SparseFactor<double> factors;
    if (factors.factorize(A)) {
        Eigen::MatrixXd shapes = forces;
        factors.solve(shapes);
        if (shapes.allFinite())
            return shapes;
    }
    return Eigen::SimplicialLDLT<Sparse>(pair.K + pair.shift * pair.M).solve(forces);
}

/// Shapes to choose from: the lowest modes at rest; the deflections under synchronous forces at
/// the places (and moments) and under those from outside, with which the undamped response there is
/// exact; and those under forces at the bearings, which carry the effect of damping and of
/// differences between x and y.
class ShapeSource {
  public:
    ShapeSource(const assembly::Discretization &d, const ReductionGoal &goal)
        : _pair(held_pair(d, goal)), _small(d.rigid() || d.planar_size() <= small_enough) {
        if (_small)
            return;
        std::vector<assembly::Combination> loaded;
        for (const double z : goal.places)
            loaded.push_back(d.deflection_at(z));
        for (const double z : goal.tilted)
            loaded.push_back(d.slope_at(z));
        _at_places = whirl_shapes(_pair, goal.speed, goal.speed, loaded);
        for (const ReductionGoal::Outside &load : goal.outside)
            if (load.z)
                for (const double way : {load.frequency, -load.frequency})
                    append(whirl_shapes(_pair, goal.speed, way, {d.deflection_at(*load.z)}));
        std::vector<assembly::Combination> bearings;
        for (const model::Bearing &bearing : d.rotor().bearings)
            bearings.push_back(d.deflection_at(bearing.z));
        const Eigen::MatrixXd forward = whirl_shapes(_pair, goal.speed, goal.speed, bearings);
        const Eigen::MatrixXd backward = whirl_shapes(_pair, goal.speed, -goal.speed, bearings);
        const bool both = !d.rotor().bearings_isotropic();
        _at_bearings.resize(forward.rows(), (both ? 2 : 1) * forward.cols());
        _at_bearings.leftCols(forward.cols()) = forward;
        if (both)
            _at_bearings.rightCols(backward.cols()) = backward;
        const Sparse held = _pair.K + _pair.shift * _pair.M;
        const int wanted = std::min(std::max(goal.modes, most_modes), d.planar_size());
        _modes = linalg::DefinitePair(linalg::Matrix::from_sparse(held),
                                      linalg::Matrix::from_sparse(_pair.M))
                     .smallest(wanted);
    }

    /// All there are.
    [[nodiscard]] int modes() const {
        return _small ? static_cast<int>(_pair.M.rows()) : static_cast<int>(_modes.size());
    }

    [[nodiscard]] Eigen::MatrixXd shapes(int modes, bool with_bearings) const {
        if (_small)
            return ritz_shapes(_pair, Eigen::MatrixXd::Identity(_pair.M.rows(), _pair.M.rows()));
        const Eigen::Index at_bearings = with_bearings ? _at_bearings.cols() : 0;
        Eigen::MatrixXd columns(_pair.M.rows(), modes + _at_places.cols() + at_bearings);
        for (int i = 0; i < modes; ++i)
            columns.col(i) = _modes[static_cast<std::size_t>(i)].vector;
        columns.middleCols(modes, _at_places.cols()) = _at_places;
        columns.rightCols(at_bearings) = _at_bearings.leftCols(at_bearings);
        return ritz_shapes(_pair, columns);
    }

    [[nodiscard]] bool complete() const { return _small; }
    [[nodiscard]] const HeldPair &pair() const { return _pair; }

  private:
    void append(const Eigen::MatrixXd &shapes) {
        const Eigen::Index before = _at_places.cols();
        _at_places.conservativeResize(Eigen::NoChange, before + shapes.cols());
        _at_places.rightCols(shapes.cols()) = shapes;
    }

    HeldPair _pair;
    bool _small;
    Eigen::MatrixXd _at_places;
    Eigen::MatrixXd _at_bearings;
    std::vector<linalg::RealPair> _modes;
};

/// Adds what a block on (x, y) between two planar unknowns is on the real form.
void add_projected(const Eigen::MatrixXd &shapes, int i, int j, const Eigen::Matrix2d &block,
                   Eigen::MatrixXd &target) {
    const Eigen::Index r = shapes.cols();
    const Eigen::MatrixXd product = shapes.row(i).transpose() * shapes.row(j);
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b)
            target.block(a * r, b * r, r, r) += block(a, b) * product;
}

ReducedRotor::Supports project_supports(const assembly::Discretization &d,
                                        const Eigen::MatrixXd &shapes, double speed) {
    const Eigen::Index r = shapes.cols();
    ReducedRotor::Supports supports{speed, Eigen::MatrixXd::Zero(2 * r, 2 * r),
                                    Eigen::MatrixXd::Zero(2 * r, 2 * r)};
    assembly::assemble_supports(
        d, speed, [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
            if (term == Term::stiffness || term == Term::damping)
                add_projected(shapes, i, j, block,
                              term == Term::stiffness ? supports.stiffness : supports.damping);
        });
    return supports;
}

/// Matrices of the shaft and its discs; their mass on the side.
void project_rotor(const assembly::Discretization &d, ReducedRotor &reduced) {
    const auto projected = [&](Term term) -> Eigen::MatrixXd {
        return linalg::transposed_times(reduced.shapes,
                                        assembly::planar_part(d, term) * reduced.shapes);
    };
    reduced.elastic = projected(Term::stiffness);
    reduced.internal = projected(Term::damping);
    reduced.gyroscopic = projected(Term::gyroscopic);
    const Eigen::VectorXd translation = d.rigid_motion(false);
    reduced.mass = translation.dot(assembly::planar_part(d, Term::mass) * translation);
}

/// Masses of pedestals and of the fluid in bearings less their mean over x and y, which the planar
/// mass matrix has.
void project_mass_deviation(const assembly::Discretization &d, ReducedRotor &reduced) {
    const Eigen::Index r = reduced.shapes.cols();
    reduced.mass_deviation = Eigen::MatrixXd::Zero(2 * r, 2 * r);
    assembly::assemble_supports(d, 0, [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
        if (term != Term::mass)
            return;
        const Eigen::Matrix2d deviation = block - block.trace() / 2 * Eigen::Matrix2d::Identity();
        add_projected(reduced.shapes, i, j, deviation, reduced.mass_deviation);
    });
    // Fluid moves with the foundation, or between shaft and pedestal: the load is the pedestals'.
    reduced.load_deviation = Row::Zero(r);
    for (std::size_t i = 0; i < d.rotor().bearings.size(); ++i)
        if (const auto &pedestal = d.rotor().bearings[i].pedestal) {
            const int unknown = d.pedestal_unknown(static_cast<int>(i));
            reduced.load_deviation += (pedestal->mass(0) - pedestal->mass(1)) / 2 *
                                      reduced.shapes.row(unknown).transpose();
        }
}

ReducedRotor project(const assembly::Discretization &d, const HeldPair &pair,
                     const Eigen::MatrixXd &shapes) {
    ReducedRotor reduced;
    reduced.shapes = shapes;
    reduced.mass_times = pair.M * shapes;
    reduced.mass_load = reduced.mass_times.transpose() * d.rigid_motion(false);
    for (const model::Bearing &bearing : d.rotor().bearings) // fluid that moves with the foundation
        if (!bearing.pedestal)
            reduced.mass_load -=
                bearing.rows.front().m.trace() / 2 * reduced.row(d.deflection_at(bearing.z));
    project_rotor(d, reduced);
    if (!d.rotor().support_masses_isotropic())
        project_mass_deviation(d, reduced);
    std::set<double> speeds;
    for (const model::Bearing &bearing : d.rotor().bearings)
        speeds.insert(bearing.speeds.begin(), bearing.speeds.end());
    if (speeds.empty())
        speeds.insert(0.0);
    for (const double speed : speeds)
        reduced.supports.push_back(project_supports(d, shapes, speed));
    const Eigen::MatrixXd K = linalg::transposed_times(shapes, pair.K * shapes);
    reduced.frequencies = K.diagonal().cwiseMax(0).cwiseSqrt();
    return reduced;
}

void refuse_massless(const assembly::Discretization &d) {
    const auto &bearings = d.rotor().bearings;
    for (std::size_t i = 0; i < bearings.size(); ++i)
        if (bearings[i].pedestal && bearings[i].pedestal->mass.minCoeff() == 0)
            throw model::AnalysisFailure(
                fmt::format("motion in time needs mass at every moving point: give the "
                            "pedestal of bearing[{}] a pedestal_mass",
                            i));
}

/// How shapes are made slower.
struct Slowing {
    double fastest = 0; ///< rad/s: none is faster after it
    double speed = 0;   ///< rad/s, of the spin, less than that
    double damping = 0; ///< of the inertia added, over the critical damping
};

/// The rotor with so much more inertia on its fast shapes that none is faster than asked: they
/// carry deflections under forces, and their own motion is none of the shaft's. That inertia turns
/// with the rotor on springs that carry it at the spin speed, and on dampers: where all goes round
/// with the rotor the response is as before, whatever is slowed.
ReducedRotor slowed(const ReducedRotor &rotor, const Slowing &how) {
    const double fastest = how.fastest;
    const Eigen::ArrayXd squares = rotor.frequencies.array().square();
    const double spin = how.speed * how.speed;
    const double most = fastest * fastest;
    const Eigen::VectorXd s =
        (squares > most).select((most - spin) / (squares - spin).max(most - spin), 1.0).sqrt();
    Eigen::VectorXd both(2 * s.size());
    both << s, s;
    ReducedRotor out = rotor;
    out.shapes = rotor.shapes * s.asDiagonal();
    out.mass_times = rotor.mass_times * s.cwiseInverse().asDiagonal();
    out.mass_load = s.asDiagonal() * rotor.mass_load;
    if (rotor.mass_deviation.size() > 0) {
        out.mass_deviation = both.asDiagonal() * rotor.mass_deviation * both.asDiagonal();
        out.load_deviation = s.asDiagonal() * rotor.load_deviation;
    }
    out.frequencies = rotor.frequencies.cwiseMin(fastest);
    for (Eigen::MatrixXd *A : {&out.elastic, &out.internal, &out.gyroscopic})
        *A = (s.asDiagonal() * *A * s.asDiagonal()).eval();
    const Eigen::ArrayXd added = 1 - s.array().square(); // inertia
    out.elastic.diagonal().array() += spin * added;
    out.internal.diagonal().array() += 2 * how.damping * fastest * added;
    for (ReducedRotor::Supports &at : out.supports)
        for (Eigen::MatrixXd *A : {&at.stiffness, &at.damping})
            *A = (both.asDiagonal() * *A * both.asDiagonal()).eval();
    return out;
}

/// No shape becomes slower than that, rad/s. What goes round twice as fast as the rotor, or faster,
/// makes no pair with a motion of the rotor whose frequencies add up to twice the spin speed, which
/// balls and anisotropies could drive. Under forces of a frequency w other than the spin speed, and
/// while motions begin and end, slowed shapes have wrong by up to (w / slowest)^2 of their
/// deflection: so it goes with the tolerance, and with the fastest of what acts.
double slowest_of(const ReductionGoal &goal) {
    constexpr double twice_at = 1e-3; // tolerance
    return 2 * goal.fastest * std::sqrt(std::max(1.0, twice_at / goal.tolerance));
}

double fastest_of(const ReducedRotor &rotor) { return rotor.frequencies(rotor.size() - 1); }

/// The highest frequency sets how many steps the integration takes, the shapes what each of them
/// does.
double effort_of(const ReducedRotor &rotor) { return fastest_of(rotor) * rotor.size(); }

/// The decay of a rotor's motions, to compare with. What turns with the rotor loses energy by
/// motions that go round faster than it, and feeds those that go round slower (as internal damping
/// does, docs/theory.md): rotors with little damping of their own would become unstable by it.
class Decay {
  public:
    Decay(const ReducedRotor &rotor, const ReductionGoal &goal)
        : _fastest(goal.fastest), _at_rest(1e-6 * fastest_of(rotor)) {
        constexpr int between = 8; // speeds of a run-up
        for (int i = goal.varies ? between : 1; i >= 1; --i) {
            const double speed = std::abs(goal.speed) * (goal.varies ? i / double{between} : 1);
            _before.push_back({speed, damped_eigenvalues(rotor, speed)});
        }
    }

    /// Of all motions up to the fastest that acts a tenth of the decay at the most is changed, and
    /// no more motions grow.
    [[nodiscard]] bool kept_by(const ReducedRotor &slowed) const {
        return std::ranges::all_of(_before, [&](const AtSpeed &before) {
            return kept(before.values, damped_eigenvalues(slowed, before.speed));
        });
    }

  private:
    struct AtSpeed {
        double speed; ///< rad/s
        Eigen::VectorXcd values;
    };
    std::vector<AtSpeed> _before;
    double _fastest; ///< rad/s
    double _at_rest; ///< rad/s: double root 0 of a free rotor, known to the root of rounding

    [[nodiscard]] bool kept(const Eigen::VectorXcd &before, const Eigen::VectorXcd &after) const {
        // Of its real part: slowing fast shapes may not change the decay of a slow motion
        // by more.
        constexpr double share = 0.1;
        const double largest = before.cwiseAbs().maxCoeff();
        const double rounding = 1e-13 * largest; // of eigenvalues of matrices of that size
        const auto growing = [&](const Eigen::VectorXcd &values) {
            return std::ranges::count_if(values, [&](const std::complex<double> &value) {
                return value.real() > rounding && std::abs(value) > _at_rest;
            });
        };
        if (growing(after) > growing(before))
            return false;
        return std::ranges::all_of(before, [&](const std::complex<double> &value) {
            if (std::abs(value) > _fastest || std::abs(value) <= _at_rest)
                return true;
            Eigen::Index nearest = 0;
            (after.array() - value).abs().minCoeff(&nearest);
            return std::abs(after(nearest).real() - value.real()) <=
                   share * std::abs(value.real()) + rounding;
        });
    }
};

/// The rotor with its shapes as slow as they may be; nothing where it is not good enough as it is.
/// @param keeps_energy  it has no damping, and gets none
std::optional<ReducedRotor> slowest_good(ReducedRotor rotor, ReductionError &error,
                                         const ReductionGoal &goal, bool keeps_energy) {
    const double speed = std::abs(goal.speed);
    const auto good = [&](ReducedRotor &trial) {
        error.measure(trial);
        return std::max(trial.response_error, trial.frequency_error) <= goal.tolerance;
    };
    if (!good(rotor))
        return std::nullopt;
    double high = fastest_of(rotor);
    double low = std::min(high, slowest_of(goal));
    if (low == high)
        return rotor;
    // Of the critical one. With the most of them what a start leaves in slowed shapes is gone after
    // a few turns; rotors that are hardly damped get less, or none.
    const std::vector<double> dampings =
        keeps_energy ? std::vector{0.0} : std::vector{0.1, 1e-3, 0.0};
    std::optional<Decay> decay;
    if (!keeps_energy)
        decay.emplace(rotor, goal);
    const auto answers_alike = [&](const ReducedRotor &trial) {
        return std::ranges::all_of(goal.outside, [&](const ReductionGoal::Outside &load) {
            return error.difference(rotor, trial, load.frequency) <= goal.tolerance;
        });
    };
    const auto slowed_to = [&](double fastest) -> std::optional<ReducedRotor> {
        for (const double damping : dampings)
            if (ReducedRotor trial = slowed(rotor, {fastest, speed, damping});
                good(trial) && answers_alike(trial) && (!decay || decay->kept_by(trial)))
                return trial;
        return std::nullopt;
    };
    if (auto trial = slowed_to(low))
        return trial;
    ReducedRotor out = rotor;
    // Shapes slowed 10 % less cost 10 % more steps in time, less than further trials.
    constexpr double close = 1.1;
    while (high > close * low) {
        const double middle = std::sqrt(low * high);
        if (auto trial = slowed_to(middle)) {
            high = middle;
            out = std::move(*trial);
        } else {
            low = middle;
        }
    }
    return out;
}

/// Of the choices that are good enough the one that is integrated with the least effort.
template <class With>
std::optional<ReducedRotor> least_effort(const With &with, ReductionError &error, int most,
                                         const ReductionGoal &goal, bool keeps_energy) {
    constexpr int further = 3; // modes beyond those needed: what they describe the others need not
    std::optional<ReducedRotor> best;
    for (const bool bearings : {false, true})
        for (int modes = 0, last = most; modes <= last; ++modes)
            if (auto rotor = slowest_good(with(modes, bearings), error, goal, keeps_energy)) {
                const bool border = fastest_of(*rotor) <= slowest_of(goal);
                last = std::min(last, border ? modes : modes + further);
                if (!best || effort_of(*rotor) < effort_of(*best))
                    best = std::move(rotor);
            }
    return best;
}

} // namespace

Row ReducedRotor::row(const assembly::Combination &combination) const {
    Row row = Row::Zero(shapes.cols());
    for (const auto &[unknown, value] : combination)
        row += value * shapes.row(unknown).transpose();
    return row;
}

ReducedRotor::Supports ReducedRotor::supports_at(double speed) const {
    const auto above = std::find_if(supports.begin(), supports.end(),
                                    [speed](const Supports &entry) { return entry.speed > speed; });
    if (above == supports.begin())
        return supports.front();
    if (above == supports.end())
        return supports.back();
    const Supports &a = *std::prev(above);
    const double t = (speed - a.speed) / (above->speed - a.speed);
    return {speed, (1 - t) * a.stiffness + t * above->stiffness,
            (1 - t) * a.damping + t * above->damping};
}

ReducedRotor::Supports ReducedRotor::supports_slope(double speed) const {
    const auto above = std::find_if(supports.begin(), supports.end(),
                                    [speed](const Supports &entry) { return entry.speed > speed; });
    const Supports &a = above == supports.begin() ? supports.front() : *std::prev(above);
    if (above == supports.begin() || above == supports.end())
        return {speed, 0 * a.stiffness, 0 * a.damping};
    const double span = above->speed - a.speed;
    return {speed, (above->stiffness - a.stiffness) / span, (above->damping - a.damping) / span};
}

ReducedRotor reduce(const assembly::Discretization &discretization, const ReductionGoal &goal) {
    refuse_massless(discretization);
    try {
        const ShapeSource source(discretization, goal);
        const auto with = [&](int modes, bool bearings) {
            ReducedRotor reduced =
                project(discretization, source.pair(), source.shapes(modes, bearings));
            reduced.modes = modes;
            return reduced;
        };
        if (source.complete())
            return with(source.modes(), false);
        ReductionError error(discretization, goal);
        if (goal.modes > 0) {
            ReducedRotor reduced = with(std::min(goal.modes, source.modes()), false);
            error.measure(reduced);
            return reduced;
        }
        if (auto best =
                least_effort(with, error, source.modes(), goal, !discretization.rotor().damped()))
            return *best;
        throw model::AnalysisFailure(
            fmt::format("{} modes of the shaft do not describe its response to {:.1e}; "
                        "raise simulate.reduction_tolerance",
                        source.modes(), goal.tolerance));
    } catch (const linalg::SolverError &error) {
        throw model::AnalysisFailure(std::string("the modes of the shaft could not be found: ") +
                                     error.what());
    }
}

} // namespace whirl::reduction
