#include "modes/free_motions.h"

#include "assembly/assemble.h"
#include "linalg/dense/products.h"
#include "results/formulation.h"

#include <Eigen/Dense>

#include <cmath>
#include <vector>

namespace whirl::modes {

namespace {

/// Constraints are rows of numbers of the order of 1. Two bearings may stand 1e-9 of the length
/// apart (nearer ones are one station): a singular value of a third of that still constrains.
constexpr double unconstrained = 1e-12;

/// Motions of a rotor whose shaft is rigid, in one plane: translation, tilt about z = 0 by 1 over
/// the shaft length (all deflections of the order of 1), and each pedestal alone.
class RigidCoordinates {
  public:
    explicit RigidCoordinates(const assembly::Discretization &d) : _d(d) {
        std::vector<int> pedestals;
        for (std::size_t b = 0; b < d.rotor().bearings.size(); ++b) {
            const bool has = d.rotor().bearings[b].pedestal.has_value();
            _pedestals.push_back(has ? 2 + static_cast<int>(pedestals.size()) : -1);
            if (has)
                pedestals.push_back(d.pedestal_unknown(static_cast<int>(b)));
        }
        _columns = Eigen::MatrixXd::Zero(d.planar_size(), 2 + std::ssize(pedestals));
        for (int tilt = 0; tilt < 2; ++tilt)
            _columns.col(tilt) = d.rigid_motion(tilt == 1);
        _columns.col(1) /= length();
        for (std::size_t p = 0; p < pedestals.size(); ++p) {
            _columns.row(pedestals[p]).setZero();
            _columns(pedestals[p], 2 + static_cast<int>(p)) = 1;
        }
    }

    [[nodiscard]] double length() const { return _d.rotor().shaft.length(); }
    [[nodiscard]] int count() const { return static_cast<int>(_columns.cols()); }
    /// Rows: planar unknowns.
    [[nodiscard]] const Eigen::MatrixXd &columns() const { return _columns; }

    /// How much the film of a bearing is stretched.
    [[nodiscard]] Eigen::RowVectorXd stretch(std::size_t bearing) const {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(count());
        row(0) = 1;
        row(1) = _d.rotor().bearings[bearing].z / length();
        if (_pedestals[bearing] >= 0)
            row(_pedestals[bearing]) = -1;
        return row;
    }
    [[nodiscard]] Eigen::RowVectorXd tilt() const { return Eigen::RowVectorXd::Unit(count(), 1); }
    /// Of the pedestal of a bearing that has one.
    [[nodiscard]] Eigen::RowVectorXd pedestal(std::size_t bearing) const {
        return Eigen::RowVectorXd::Unit(count(), _pedestals[bearing]);
    }

  private:
    const assembly::Discretization &_d;
    std::vector<int> _pedestals; ///< coordinate of each bearing's pedestal, -1 for none
    Eigen::MatrixXd _columns;
};

/// Rows of what resists, over the coordinates in x, then those in y.
class Constraints {
  public:
    Constraints(const assembly::Discretization &d, const RigidCoordinates &coordinates,
                double bearing_speed)
        : _count(coordinates.count()) {
        for (std::size_t b = 0; b < d.rotor().bearings.size(); ++b) {
            const model::Bearing &bearing = d.rotor().bearings[b];
            const model::BearingCoefficients at = bearing.at(bearing_speed);
            add(at.k, coordinates.stretch(b));
            add(at.kt, coordinates.tilt());
            if (bearing.pedestal)
                add(bearing.pedestal->k.asDiagonal(), coordinates.pedestal(b));
        }
        const bool torque = d.rotor().shaft.axial_torque != 0 && !d.rigid();
        if (d.rotor().shaft.axial_force != 0 || torque)
            add(Eigen::Matrix2d::Identity(), coordinates.tilt());
    }

    /// Null space over the coordinates from `first` on.
    [[nodiscard]] Eigen::MatrixXd null_space(int first, int count) const {
        if (_rows.empty())
            return Eigen::MatrixXd::Identity(count, count);
        Eigen::MatrixXd A(std::ssize(_rows), count);
        for (Eigen::Index i = 0; i < A.rows(); ++i)
            A.row(i) = _rows[static_cast<std::size_t>(i)].segment(first, count);
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
        const Eigen::Index rank = (svd.singularValues().array() > unconstrained).count();
        return svd.matrixV().rightCols(count - rank);
    }

  private:
    int _count;
    std::vector<Eigen::RowVectorXd> _rows;

    /// The two forces k (x, y) of a spring, each a row whatever its size.
    void add(const Eigen::Matrix2d &k, const Eigen::RowVectorXd &stretch) {
        for (int force = 0; force < 2; ++force) {
            const double size = k.row(force).cwiseAbs().maxCoeff();
            if (size == 0)
                continue;
            Eigen::RowVectorXd row(2 * _count);
            row << k(force, 0) / size * stretch, k(force, 1) / size * stretch;
            _rows.push_back(row);
        }
    }
};

/// Mass, gyroscopic coupling (one plane) and damping (pairs of planes) between rigid coordinates.
struct RigidMatrices {
    Eigen::MatrixXd M, G;     ///< count x count
    Eigen::MatrixXd C;        ///< 2 count x 2 count: x, then y
    Eigen::Vector2d centre{}; ///< of mass: translation and tilt of a tilt about it

    RigidMatrices(const assembly::Discretization &d, const RigidCoordinates &coordinates,
                  double bearing_speed) {
        const Eigen::MatrixXd &R = coordinates.columns();
        const auto m = R.cols();
        M = Eigen::MatrixXd::Zero(m, m);
        G = M;
        C = Eigen::MatrixXd::Zero(2 * m, 2 * m);
        assembly::assemble_rotating_parts(d, [&](assembly::Term term, std::span<const int> unknowns,
                                                 const Eigen::MatrixXd &block) {
            if (term != assembly::Term::mass && term != assembly::Term::gyroscopic)
                return;
            Eigen::MatrixXd local(std::ssize(unknowns), m);
            for (Eigen::Index i = 0; i < local.rows(); ++i)
                local.row(i) = R.row(unknowns[static_cast<std::size_t>(i)]);
            (term == assembly::Term::mass ? M : G) +=
                linalg::transposed_times(local, linalg::times(block, local));
        });
        // Of what the shaft carries; its pedestals stay where they are.
        centre << -M(0, 1) / M(0, 0), 1;
        assembly::assemble_supports(
            d, bearing_speed, [&](assembly::Term term, int i, int j, const Eigen::Matrix2d &b) {
                const Eigen::MatrixXd product = R.row(i).transpose() * R.row(j);
                if (term == assembly::Term::mass) // a weight of motions: the mean does
                    M += b.trace() / 2 * product;
                if (term == assembly::Term::damping)
                    for (int p = 0; p < 2; ++p)
                        for (int q = 0; q < 2; ++q)
                            C.block(p * m, q * m, m, m) += b(p, q) * product;
            });
    }
};

/// The same null space by translation and tilt about the centre of mass, where it has these two.
Eigen::MatrixXd by_translation_and_tilt(const Eigen::MatrixXd &null,
                                        const Eigen::Vector2d &centre) {
    if (null.cols() != 2 || std::abs(null.topRows(2).determinant()) < 1e-3)
        return null;
    Eigen::Matrix2d wanted;
    wanted << 1, centre(0), 0, centre(1);
    const Eigen::Matrix2d top = null.topRows(2);
    return linalg::times(null, Eigen::MatrixXd(top.inverse() * wanted));
}

/// Columns in x and y in turn where both planes are free alike, else whatever is free.
Eigen::MatrixXd real_coordinates(const Constraints &constraints, int m,
                                 const Eigen::Vector2d &centre) {
    const Eigen::MatrixXd x = constraints.null_space(0, m);
    const Eigen::MatrixXd y = constraints.null_space(m, m);
    const Eigen::MatrixXd all = constraints.null_space(0, 2 * m);
    if (x.cols() != y.cols() || x.cols() + y.cols() != all.cols())
        return all;
    const Eigen::MatrixXd first = by_translation_and_tilt(x, centre);
    // The same motion in the other plane where that is free too (the basis may differ by a turn).
    const Eigen::MatrixXd within = linalg::times(y, linalg::transposed_times(y, first));
    const bool alike = (within - first).norm() <= 1e-9 * first.norm();
    const Eigen::MatrixXd second = alike ? first : by_translation_and_tilt(y, centre);
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(2 * m, all.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        out.block(0, 2 * i, m, 1) = first.col(i);
        out.block(m, 2 * i + 1, m, 1) = second.col(i);
    }
    return out;
}

/// Fills in damping and scale from D over the rigid coordinates and the free motions N among them.
void project_damping(const Eigen::MatrixXd &M, const Eigen::MatrixXd &D, const Eigen::MatrixXd &N,
                     FreeMotions &out) {
    const Eigen::MatrixXd masses = linalg::transposed_times(N, linalg::times(M, N));
    const Eigen::VectorXd weight = masses.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = N * weight.asDiagonal();
    out.damping = linalg::transposed_times(scaled, linalg::times(D, scaled));
    const Eigen::MatrixXd sizes = scaled.cwiseAbs();
    out.scale = linalg::transposed_times(sizes, linalg::times(D.cwiseAbs(), sizes)).maxCoeff();
}

} // namespace

FreeMotions free_motions(const assembly::Discretization &discretization, results::Form form,
                         double bearing_speed, double spin_speed) {
    const bool planar = form == results::Form::planar;
    const RigidCoordinates coordinates(discretization);
    const Constraints constraints(discretization, coordinates, bearing_speed);
    const int m = coordinates.count();
    const Eigen::MatrixXd &R = coordinates.columns();
    FreeMotions out;
    if (constraints.null_space(0, planar ? m : 2 * m).cols() == 0) {
        out.motions.resize(planar ? R.rows() : 2 * R.rows(), 0);
        return out;
    }
    const RigidMatrices rigid(discretization, coordinates, bearing_speed);
    if (planar) {
        const Eigen::MatrixXd N =
            by_translation_and_tilt(constraints.null_space(0, m), rigid.centre);
        out.motions = R * N;
        project_damping(rigid.M, spin_speed * rigid.G, N, out);
        return out;
    }
    const Eigen::MatrixXd N = real_coordinates(constraints, m, rigid.centre);
    out.motions = Eigen::MatrixXd::Zero(2 * R.rows(), N.cols());
    out.motions(Eigen::seqN(0, R.rows(), 2), Eigen::all) = R * N.topRows(m);
    out.motions(Eigen::seqN(1, R.rows(), 2), Eigen::all) = R * N.bottomRows(m);
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(2 * m, 2 * m);
    M.topLeftCorner(m, m) = M.bottomRightCorner(m, m) = rigid.M;
    Eigen::MatrixXd D = rigid.C;
    D.topRightCorner(m, m) += spin_speed * rigid.G;
    D.bottomLeftCorner(m, m) -= spin_speed * rigid.G;
    project_damping(M, D, N, out);
    return out;
}

} // namespace whirl::modes
