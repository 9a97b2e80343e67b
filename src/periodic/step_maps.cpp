#include "periodic/step_maps.h"

#include "linalg/check.h"
#include "periodic/collocation.h"

#include <Eigen/LU>

#include <vector>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using linalg::Rows;

/// Matrices n x c of all stages, a row each: their rows one after another.
class Blocks {
  public:
    Blocks(Eigen::Index rows, Eigen::Index columns)
        : _rows(rows), _columns(columns), _all(Rows::Zero(stages, rows * columns)) {}

    [[nodiscard]] Eigen::Index rows() const { return _rows; }
    [[nodiscard]] Eigen::Index columns() const { return _columns; }
    [[nodiscard]] const Rows &all() const { return _all; }
    [[nodiscard]] Rows &all() { return _all; }
    [[nodiscard]] Eigen::Map<Rows> at(Eigen::Index stage) {
        return {_all.row(stage).data(), _rows, _columns};
    }
    [[nodiscard]] Eigen::Map<const Rows> at(Eigen::Index stage) const {
        return {_all.row(stage).data(), _rows, _columns};
    }

  private:
    Eigen::Index _rows, _columns;
    Rows _all;
};

/// The collocation equations of the steady part over one step, U_i the change of q from its
/// beginning to point i, B the inverse of the method's matrix over the length of the step:
///
///     sum_k (B^2)_ik M U_k + B_ik D U_k + K U_i = f_i
class StageSystem {
  public:
    StageSystem(const System::Steady &steady, double length)
        : _M(-steady.M), _D(-steady.D), _K(-steady.K), _B(collocation().inverse / length),
          _left(stages, stages), _T(stages, stages) {
        const Collocation &points = collocation();
        for (Eigen::Index pair = 0; pair < stages / 2; ++pair) {
            const Complex root = points.roots(pair) / length;
            _factors.emplace_back(root * root * steady.M + root * steady.D +
                                  steady.K.cast<Complex>());
            _left.row(2 * pair) = points.left.row(pair).real();
            _left.row(2 * pair + 1) = points.left.row(pair).imag();
            _T.col(2 * pair) = 2 * points.T.col(pair).real();
            _T.col(2 * pair + 1) = -2 * points.T.col(pair).imag();
        }
    }

    /// sum_k B_ik of each i
    [[nodiscard]] Eigen::VectorXd start() const { return _B.rowwise().sum(); }

    [[nodiscard]] Blocks solve(const Blocks &right) const {
        Blocks out = transformed(right);
        // The transformation costs four digits: they come back.
        out.all() += transformed(rest(right, out)).all();
        return out;
    }

    /// sum_k B_ik X_k
    [[nodiscard]] Blocks rates(const Blocks &X) const {
        Blocks out(X.rows(), X.columns());
        out.all().noalias() = _B * X.all();
        return out;
    }

  private:
    Rows _M, _D, _K; ///< all with a minus
    Rows _B;
    Rows _left, _T; ///< of the pairs, real and imaginary parts
    std::vector<Eigen::PartialPivLU<Eigen::MatrixXcd>> _factors; ///< of one root of each pair

    /// The transformation makes one system of each root.
    [[nodiscard]] Blocks transformed(const Blocks &right) const {
        Blocks sums(right.rows(), right.columns()); // two parts of each pair
        sums.all().noalias() = _left * right.all();
        for (Eigen::Index pair = 0; pair < stages / 2; ++pair) {
            Eigen::MatrixXcd X = sums.at(2 * pair) + Complex(0, 1) * sums.at(2 * pair + 1);
            X = linalg::solved(_factors[static_cast<std::size_t>(pair)], X);
            sums.at(2 * pair) = X.real();
            sums.at(2 * pair + 1) = X.imag();
        }
        Blocks out(right.rows(), right.columns());
        out.all().noalias() = _T * sums.all();
        return out;
    }

    [[nodiscard]] Blocks rest(const Blocks &right, const Blocks &U) const {
        const Blocks V = rates(U);
        const Blocks W = rates(V);
        Blocks out = right;
        for (Eigen::Index i = 0; i < stages; ++i) {
            out.at(i).noalias() += _M * W.at(i);
            out.at(i).noalias() += _D * V.at(i);
            out.at(i).noalias() += _K * U.at(i);
        }
        return out;
    }
};

/// How displacements and rates at the places act back at each point of one step: S_i (y, y').
std::vector<Rows> forces(const System &system, double speed, double from, double length) {
    std::vector<Rows> out;
    for (int i = 0; i < stages; ++i) {
        const double time = from + collocation().nodes(i) * length;
        out.emplace_back(system.turning(speed, 2 * speed * time));
    }
    return out;
}

/// S A, S with these blocks on its diagonal.
Rows product(const std::vector<Rows> &S, const Rows &A) {
    const Eigen::Index m = S.front().rows();
    const Eigen::Index observed = S.front().cols();
    Rows out(stages * m, A.cols());
    for (Eigen::Index i = 0; i < stages; ++i)
        out.middleRows(i * m, m).noalias() =
            S[static_cast<std::size_t>(i)] * A.middleRows(i * observed, observed);
    return out;
}

} // namespace

StepMaps::StepMaps(const System &system, double speed, double length)
    : _system(system), _speed(speed), _length(length) {
    const System::Steady steady = system.steady(speed);
    const StageSystem equations(steady, length);
    const Eigen::Index n = system.size();
    const MatrixXd &P = system.places();
    const Eigen::Index m = P.cols();
    const Eigen::Index columns = 2 * n + stages * m;
    const Eigen::VectorXd start = equations.start();
    Blocks right(n, columns);
    for (Eigen::Index i = 0; i < stages; ++i) {
        auto here = right.at(i);
        here.leftCols(n) = -steady.K;
        here.middleCols(n, n) = start(i) * steady.M;
        here.middleCols(2 * n + i * m, m) = -P;
    }
    Blocks q = equations.solve(right);
    const Blocks v = equations.rates(q);
    for (Eigen::Index i = 0; i < stages; ++i)
        q.at(i).leftCols(n).diagonal().array() += 1;
    Rows last(2 * n, columns);
    last << q.at(stages - 1), v.at(stages - 1);
    if (!last.allFinite())
        throw linalg::SolverError("a step in time meets a singular matrix");
    _R = last.leftCols(2 * n);
    _L = last.rightCols(stages * m);
    if (m == 0) { // nothing acts back
        _Y.resize(0, 2 * n);
        _away.resize(0, 0);
        return;
    }
    const Eigen::Index rows = system.turning(speed, 0).cols(); // at each point
    const Rows at_places = P.transpose();
    Rows observed(stages * rows, columns);
    for (Eigen::Index i = 0; i < stages; ++i) {
        observed.middleRows(i * rows, m).noalias() = at_places * q.at(i);
        if (rows > m)
            observed.middleRows(i * rows + m, m).noalias() = at_places * v.at(i);
    }
    _Y = observed.leftCols(2 * n);
    _away = -observed.rightCols(stages * m);
}

/// Forces at places and points by what is observed there without them.
Rows StepMaps::forces_onto(double from, const Rows &observed) const {
    const std::vector<Rows> S = forces(_system, _speed, from, _length);
    MatrixXd reaction = product(S, _away); // what they make of themselves
    reaction.diagonal().array() += 1;
    return linalg::solved(reaction.partialPivLu(), MatrixXd(product(S, observed)));
}

void StepMaps::set_map(double from, Eigen::Ref<Rows> out) const {
    out = _R;
    if (_away.cols() > 0) // the supports are not the same from every direction
        out.noalias() += _L * forces_onto(from, _Y);
}

void StepMaps::set_end(double from, const Rows &states, Rows &out) const {
    out.noalias() = _R * states;
    if (_away.cols() > 0)
        out.noalias() += _L * forces_onto(from, _Y * states);
}

} // namespace whirl::periodic
