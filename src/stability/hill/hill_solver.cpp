#include "stability/hill/hill_solver.h"

#include "assembly/hill_system.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "periodic/whole_root.h"
#include "results/formulation.h"
#include "stability/hill/hill_motions.h"
#include "stability/hill/periodic_motions.h"
#include "stability/motion_reach.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::stability {

namespace {

using linalg::ComplexPair;
using linalg::Matrix;
using Complex = std::complex<double>;

/// How far a real part as the eigensolver gives it can be from the truth: rounding of the matrix
/// entries as the eigenvalue feels it (much where two eigenvalues meet, known to the root of the
/// rounding) with an allowance for what the solver adds, and a share of speed and modulus that is
/// always there. A bound that grows with the mesh: what lies within it is looked at again.
constexpr double allowance = 100;
constexpr double always = 1e-11;

Eigen::VectorXd root_of_diagonal(const Matrix &matrix) {
    return Eigen::SparseMatrix<double>(matrix.view()).diagonal().cwiseAbs().cwiseSqrt();
}

/// Of aliases next to +-i speed, which are one motion, one is kept.
void drop_sidebands(std::vector<Motion> &motions, double speed) {
    const double width = 2 * std::abs(speed);
    const auto same = [width](const Motion &a, const Motion &b) {
        return alias_distance(a.value, b.value, width) < 1e-6 * width &&
               std::abs(a.state.dot(b.state)) > 1 - 1e-6;
    };
    std::vector<Motion> kept;
    for (Motion &motion : motions) {
        const bool border = std::abs(motion.value.imag()) > 0.45 * width;
        if (!border ||
            std::ranges::none_of(kept, [&](const Motion &other) { return same(motion, other); }))
            kept.push_back(std::move(motion));
    }
    motions = std::move(kept);
}

} // namespace

struct HillSolver::Data {
    assembly::Discretization d;
    std::vector<balancers::BalancerElement> balancers;
    int fewest; ///< motions of the series looked at, however fast they are
    // One of the two.
    std::unique_ptr<HillMotions> series;
    std::unique_ptr<periodic::WholeRotor> whole; ///< with the series: single motions of it
    std::unique_ptr<PeriodicMotions> monodromy;
    Eigen::VectorXd root_K, root_M; ///< weights of displacements and velocities

    Data(const StabilityModel &model, const balancers::Arrangement &arrangement,
         std::shared_ptr<const Eigen::MatrixXd> shapes)
        : d(model.rotor, model.order),
          balancers(balancers::balancer_elements(model.rotor, arrangement)),
          fewest(fewest_motions(model.rotor)) {
        if (model.harmonics == 0) {
            monodromy =
                std::make_unique<PeriodicMotions>(d, balancers, bearings_drive(model.rotor),
                                                  model.top, std::move(shapes), model.experience);
            return;
        }
        series = std::make_unique<HillMotions>(d, balancers, fewest, model.harmonics);
        whole = std::make_unique<periodic::WholeRotor>(d, balancers);
        const assembly::RotatingSystem &system = series->spectrum(0, 0).system();
        root_K = root_of_diagonal(system.K);
        root_M = root_of_diagonal(system.M);
    }

    /// Displacements and velocities at the time zero, the same for every alias in Hill's series.
    [[nodiscard]] Eigen::VectorXcd state_of(const ComplexPair &pair, double speed) const {
        const Eigen::Index n = root_K.size();
        Eigen::VectorXcd place = pair.vector.head(n);
        Eigen::VectorXcd rate = pair.value * place;
        for (Eigen::Index k = 1; (2 * k + 1) * n <= pair.vector.size(); ++k) {
            const auto cosine = pair.vector.segment((2 * k - 1) * n, n);
            const auto sine = pair.vector.segment(2 * k * n, n);
            place += cosine;
            rate += pair.value * cosine + 2 * static_cast<double>(k) * speed * sine;
        }
        // Balls have no stiffness but that of the spin.
        const Eigen::VectorXd weight = root_K.cwiseMax(std::abs(speed) * root_M);
        Eigen::VectorXcd state(2 * n);
        state << weight.cwiseProduct(place), root_M.cwiseProduct(rate);
        return state.normalized();
    }

    [[nodiscard]] Motion motion_of(const ComplexPair &pair, double speed) const {
        Motion motion;
        motion.value = pair.value;
        const double size = std::abs(pair.value);
        motion.noise = (allowance * pair.rounding + 10 * pair.residual) * size +
                       always * std::max(size, std::abs(speed));
        motion.state = state_of(pair, speed);
        motion.repeats = 2 * std::abs(speed);
        return motion;
    }

    /// Real parts that the eigensolver cannot distinguish from zero, by both vectors.
    void solve_again(const ComplexPair &pair, double speed, Motion &motion) const {
        if (std::abs(pair.value.real()) > 3 * motion.noise || pair.value == 0.0 || speed == 0)
            return;
        const auto root =
            whole->next_to(speed, pair.value, 0, assembly::hill_terms(pair.vector, root_M.size()));
        if (!root || root->noise >= motion.noise ||
            std::abs(root->value - pair.value) > 10 * motion.noise)
            return;
        motion.value = {root->value.real(), pair.value.imag() == 0 ? 0 : root->value.imag()};
        motion.noise = root->noise;
    }

    /// The slowest, those that die out no faster than a combination resonance up to this speed can
    /// drive, and all that grow.
    [[nodiscard]] std::vector<ComplexPair> those_that_matter(double speed) const {
        std::vector<ComplexPair> pairs = series->at(speed).pairs;
        std::ranges::stable_sort(pairs, {}, [](const auto &a) { return std::abs(a.value); });
        constexpr double slow = 1.26; // of the speed
        int rank = 0;
        std::erase_if(pairs, [&](const ComplexPair &pair) {
            return rank++ >= fewest && std::abs(pair.value) > slow * std::abs(speed) &&
                   !motion_of(pair, speed).grows();
        });
        return pairs;
    }

    [[nodiscard]] std::vector<Motion> of_series(double speed) const {
        std::vector<Motion> motions;
        for (const ComplexPair &pair : those_that_matter(speed)) {
            Motion motion = motion_of(pair, speed);
            solve_again(pair, speed, motion);
            motions.push_back(motion);
            if (motion.value.imag() == 0)
                continue;
            motion.value = std::conj(motion.value);
            motion.state = motion.state.conjugate().eval();
            motions.push_back(std::move(motion));
        }
        if (speed != 0)
            drop_sidebands(motions, speed);
        return motions;
    }
};

HillSolver::HillSolver(const StabilityModel &model, const balancers::Arrangement &arrangement,
                       std::shared_ptr<const Eigen::MatrixXd> shapes)
    : _data(std::make_unique<Data>(model, arrangement, std::move(shapes))) {}

HillSolver::~HillSolver() = default;

std::vector<Motion> HillSolver::at(double speed) const {
    try {
        return _data->series ? _data->of_series(speed) : _data->monodromy->at(speed);
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(model::Sentence(
            "the eigenvalues at {} could not be found: the eigensolver did "
            "not converge ({} unknowns, {} form)",
            model::as::speed(speed), unknowns(), results::form_name(results::Form::hill)));
    }
}

const PeriodicMotions *HillSolver::by_monodromy() const { return _data->monodromy.get(); }

int HillSolver::unknowns() const {
    return 2 * (_data->d.planar_size() + balancers::unknowns_of(_data->balancers)) *
           (2 * harmonics() + 1);
}

int HillSolver::harmonics() const { return _data->series ? _data->series->harmonics() : 0; }

} // namespace whirl::stability
