#include "rigid/model.h"

#include "assembly/constraints.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "balancers/arrangement.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "linalg/roots.h"
#include "linalg/sparse_factor.h"
#include "linalg/sparse_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::rigid {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using assembly::Combination;
using assembly::Discretization;

/// Undamped forward motion that stands still in rotating axes: (K - W^2 A) u = 0.
struct SynchronousProblem {
    Sparse K, A;
    int planes = 1; ///< real unknowns for each planar one
};

assembly::RotatingSystem rotating_system(const Discretization &d) {
    return assembly::assemble_rotating(
        d, 0, balancers::balancer_elements(d.rotor(), balancers::arrangement_at_balance(d.rotor())),
        true);
}

SynchronousProblem synchronous_problem(const Discretization &d) {
    if (d.rotor().rotating_anisotropy()) {
        const assembly::RotatingSystem system = rotating_system(d);
        return {system.K.view(), Sparse(-Sparse(system.Kss.view())), 2};
    }
    const assembly::PlanarSystem system = assembly::assemble_planar(d, 0);
    return {system.K.view(), Sparse(Sparse(system.M.view()) - Sparse(system.G.view())), 1};
}

/// With a deflection held at zero, in every plane.
SynchronousProblem pinned(const SynchronousProblem &free, const Combination &deflection) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(free.planes, free.K.rows());
    for (int plane = 0; plane < free.planes; ++plane)
        for (const auto &[unknown, value] : deflection)
            rows(plane, free.planes * unknown + plane) += value;
    const Sparse T = assembly::constrained_motions(rows, Eigen::VectorXd::Ones(free.K.rows()));
    const Sparse Tt = T.transpose();
    return {Sparse(Tt * free.K * T), Sparse(Tt * free.A * T), free.planes};
}

/// The lowest positive roots, ascending with multiplicity; none where K is not positive definite.
std::vector<ModelValue> roots(const SynchronousProblem &motion, int count) {
    std::vector<ModelValue> out;
    try {
        const auto K = linalg::Matrix::from_sparse(motion.K);
        const auto A = linalg::Matrix::from_sparse(motion.A);
        for (const linalg::RealPair &pair : linalg::DefinitePair(K, A).smallest(count))
            out.push_back({pair.value, pair.residual + pair.rounding});
    } catch (const linalg::SolverError &) {
        out.clear();
    }
    return out;
}

/// K(W) = K + W Ks + W^2 Kss of the damped rotor in rotating axes.
class ZeroRootStiffness {
  public:
    explicit ZeroRootStiffness(const Discretization &d) {
        const assembly::RotatingSystem system = rotating_system(d);
        _K = system.K.view();
        _Ks = system.Ks.view();
        _Kss = system.Kss.view();
    }

    /// An odd number of real roots is positive.
    [[nodiscard]] bool unstable(double speed) {
        return factorize(speed) && _factors.negative_determinant();
    }

    /// Modulus of the complex slope under a unit moment in the x plane, rad/(N m).
    [[nodiscard]] double receptance(double speed, const Combination &slope) {
        const bool regular = factorize(speed);
        Eigen::VectorXd moment = Eigen::VectorXd::Zero(_K.rows());
        for (const auto &[unknown, value] : slope)
            moment(2 * unknown) += value;
        if (!regular)
            return std::numeric_limits<double>::infinity(); // at a resonance
        const Eigen::VectorXd motion = _factors.solution(moment);
        double x = 0;
        double y = 0;
        for (const auto &[unknown, value] : slope) {
            x += value * motion(2 * unknown);
            y += value * motion(2 * unknown + 1);
        }
        return std::hypot(x, y);
    }

  private:
    Sparse _K, _Ks, _Kss;
    linalg::SparseFactor<double> _factors;

    [[nodiscard]] bool factorize(double speed) {
        Sparse K = linalg::sum(1, _K, speed, _Ks, speed * speed, _Kss);
        K.makeCompressed();
        return _factors.factorize(K);
    }
};

/// Where instability starts or ends, between a speed on either side.
double bisected(ZeroRootStiffness &stiffness, double stable, double unstable) {
    for (int step = 0; step < 60 && std::abs(unstable - stable) > 1e-15 * unstable; ++step) {
        const double middle = (stable + unstable) / 2;
        (stiffness.unstable(middle) ? unstable : stable) = middle;
    }
    return (stable + unstable) / 2;
}

/// One end of the unstable range between two speeds: the outermost one on the side asked for.
std::optional<double> unstable_end(ZeroRootStiffness &stiffness, double low, double high,
                                   bool lower) {
    // Of the range: an unstable range narrower than one is not found, and the target says none.
    constexpr int steps = 128;
    const double start = lower ? low : high;
    const double step = (lower ? 1 : -1) * (high - low) / steps;
    double before = start - 1e-3 * step;
    for (int i = 0; i <= steps; ++i) {
        // The ends themselves are roots without damping: just inside them.
        const double speed = start + std::clamp<double>(i, 1e-6, steps - 1e-6) * step;
        if (stiffness.unstable(speed))
            return bisected(stiffness, before, speed);
        before = speed;
    }
    return std::nullopt;
}

double permissible(ZeroRootStiffness &stiffness, const Combination &slope, double from, double to) {
    const auto limit = [&](double speed) {
        return speed > 0 ? 1 / (speed * speed * stiffness.receptance(speed, slope))
                         : std::numeric_limits<double>::infinity();
    };
    constexpr int steps = 200; // of the range, to bracket the smallest value; then golden section
    std::vector<double> values;
    for (int i = 0; i <= steps; ++i)
        values.push_back(limit(from + (to - from) * i / steps));
    const auto best = static_cast<int>(std::ranges::min_element(values) - values.begin());
    const auto done = [](double low, double high, double) { return high - low <= 1e-8 * high; };
    const double least =
        linalg::least_between(limit, from + (to - from) * std::max(0, best - 1) / steps,
                              from + (to - from) * std::min(steps, best + 1) / steps, done)
            .second;
    return std::min(least, values[static_cast<std::size_t>(best)]);
}

/// The values of one rotor, what several targets need computed once.
class Model {
  public:
    Model(const model::Rotor &rotor, int order, const std::vector<RigidTarget> &targets)
        : _d(rotor, order), _synchronous(synchronous_problem(_d)) {
        int count = 1;
        for (const RigidTarget &target : targets)
            if (target.kind != RigidQuantity::additional)
                count = std::max({count, target.index + 1, target.upper.value_or(0) + 1});
        _critical = roots(_synchronous, count);
    }

    [[nodiscard]] std::optional<ModelValue> value(const RigidTarget &target) const {
        switch (target.kind) {
        case RigidQuantity::critical:
            return at(_critical, target.index);
        case RigidQuantity::additional:
            return at(roots(pinned(_synchronous, _d.deflection_at(target.z)), target.index + 1),
                      target.index);
        case RigidQuantity::permissible:
            return permissible_anisotropy(target);
        default:
            return end(target);
        }
    }

  private:
    Discretization _d;
    SynchronousProblem _synchronous;
    std::vector<ModelValue> _critical;

    static std::optional<ModelValue> at(const std::vector<ModelValue> &values, int index) {
        const auto i = static_cast<std::size_t>(index);
        return i < values.size() ? std::optional(values[i]) : std::nullopt;
    }

    [[nodiscard]] std::optional<ModelValue> end(const RigidTarget &target) const {
        const auto low = at(_critical, target.index);
        const auto high = target.upper ? at(_critical, *target.upper)
                                       : std::optional(ModelValue{1.5 * target.closed_form, 0});
        if (!low || !high || high->value <= low->value)
            return std::nullopt;
        ZeroRootStiffness stiffness(_d);
        const auto found = unstable_end(stiffness, low->value, high->value,
                                        target.kind == RigidQuantity::unstable_from);
        return found ? std::optional(ModelValue{*found, low->noise + high->noise}) : std::nullopt;
    }

    [[nodiscard]] std::optional<ModelValue>
    permissible_anisotropy(const RigidTarget &target) const {
        model::Rotor round = _d.rotor();
        const double z = round.anisotropies.front().z;
        for (model::Anisotropy &anisotropy : round.anisotropies)
            anisotropy.dI = 0;
        const Discretization d(round, _d.order());
        ZeroRootStiffness stiffness(d);
        const double noise = _critical.empty() ? 0 : _critical.front().noise;
        // The least value is found to the square of the place's tolerance; its terms cancel.
        return ModelValue{permissible(stiffness, d.slope_at(z), target.from, target.to),
                          1e-12 + 10 * noise};
    }
};

} // namespace

std::vector<std::optional<ModelValue>> model_values(const model::Rotor &rotor, int order,
                                                    const std::vector<RigidTarget> &targets) {
    const Model model(rotor, order, targets);
    std::vector<std::optional<ModelValue>> out;
    for (const RigidTarget &target : targets)
        out.push_back(model.value(target));
    return out;
}

Inertia model_inertia(const model::Rotor &rotor, int order) {
    const Discretization d(rotor, order);
    const auto motion = [&d](bool tilt, int plane, int planes) {
        Eigen::VectorXd out = Eigen::VectorXd::Zero(planes * d.planar_size());
        out(Eigen::seqN(plane, d.planar_size(), planes)) = d.rigid_motion(tilt);
        return out;
    };
    const auto assembled = [&](const Sparse &M, const Sparse &polar, int planes) {
        Inertia sum;
        Eigen::Matrix2d about_zero = Eigen::Matrix2d::Zero();
        for (int plane = 0; plane < planes; ++plane) {
            const Eigen::VectorXd w = motion(false, plane, planes);
            const Eigen::VectorXd phi = motion(true, plane, planes);
            sum.mass += w.dot(M * w) / planes;
            sum.first += w.dot(M * phi) / planes;
            sum.second += phi.dot(M * phi) / planes;
            sum.polar += phi.dot(polar * phi) / planes;
            for (int other = 0; other < planes; ++other)
                about_zero(plane, other) = phi.dot(M * motion(true, other, planes));
        }
        if (planes == 2)
            sum.a = {(about_zero(0, 0) - about_zero(1, 1)) / 2, about_zero(0, 1)};
        return sum;
    };
    if (!rotor.rotating_anisotropy()) {
        const assembly::PlanarSystem system = assembly::assemble_planar(d, 0);
        return assembled(system.M.view(), system.G.view(), 1);
    }
    // speed^2 times Kss is -(M - G) with the anisotropy, whose mean over the planes vanishes.
    const assembly::RotatingSystem system = rotating_system(d);
    const Sparse M = system.M.view();
    return assembled(M, Sparse(Sparse(system.Kss.view()) + M), 2);
}

} // namespace whirl::rigid
