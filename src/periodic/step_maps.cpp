#include "periodic/step_maps.h"

#include "linalg/check.h"
#include "linalg/lanes/small_products.h"
#include "periodic/collocation.h"

#include <utility>
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

    /// @param right  of as many columns as fill whole vectors of the machine
    [[nodiscard]] Blocks solve(const Blocks &right) const {
        Blocks out = transformed(right);
        // The transformation costs four digits: they come back.
        out.all() += transformed(rest(right, out)).all();
        return out;
    }

    /// sum_k B_ik X_k
    [[nodiscard]] Blocks rates(const Blocks &X) const {
        Blocks out(X.rows(), X.columns());
        linalg::set_product(_B, X.all(), out.all());
        return out;
    }

  private:
    Rows _M, _D, _K; ///< all with a minus
    Rows _B;
    Rows _left, _T;                          ///< of the pairs, real and imaginary parts
    std::vector<linalg::RowSolver> _factors; ///< of one root of each pair

    /// The transformation makes one system of each root.
    [[nodiscard]] Blocks transformed(const Blocks &right) const {
        Blocks sums(right.rows(), right.columns()); // two parts of each pair
        linalg::set_product(_left, right.all(), sums.all());
        for (Eigen::Index pair = 0; pair < stages / 2; ++pair)
            _factors[static_cast<std::size_t>(pair)].solve(sums.at(2 * pair),
                                                           sums.at(2 * pair + 1));
        Blocks out(right.rows(), right.columns());
        linalg::set_product(_T, sums.all(), out.all());
        return out;
    }

    [[nodiscard]] Blocks rest(const Blocks &right, const Blocks &U) const {
        const Blocks V = rates(U);
        const Blocks W = rates(V);
        Blocks out = right;
        for (Eigen::Index i = 0; i < stages; ++i) {
            linalg::add_product(_M, W.at(i), out.at(i));
            linalg::add_product(_D, V.at(i), out.at(i));
            linalg::add_product(_K, U.at(i), out.at(i));
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
void set_product(const std::vector<Rows> &S, const Rows &A, linalg::RowsOut out) {
    const Eigen::Index m = S.front().rows();
    const Eigen::Index observed = S.front().cols();
    for (Eigen::Index i = 0; i < stages; ++i)
        linalg::set_product(S[static_cast<std::size_t>(i)], A.middleRows(i * observed, observed),
                            out.middleRows(i * m, m));
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
    Blocks right(n, linalg::whole_vectors(columns));
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
    last << q.at(stages - 1).leftCols(columns), v.at(stages - 1).leftCols(columns);
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
        linalg::set_product(at_places, q.at(i).leftCols(columns), observed.middleRows(i * rows, m));
        if (rows > m)
            linalg::set_product(at_places, v.at(i).leftCols(columns),
                                observed.middleRows(i * rows + m, m));
    }
    _Y = observed.leftCols(2 * n);
    _away = -observed.rightCols(stages * m);
}

/// Equations of the support forces: the matrix of their own reaction, then the right sides.
Rows StepMaps::forces_onto(double from, const linalg::RowsIn &observed) const {
    const Eigen::Index at_once = _away.cols();
    Rows acting(at_once, at_once + observed.cols());
    const std::vector<Rows> S = forces(_system, _speed, from, _length);
    set_product(S, _away, acting.leftCols(at_once));
    acting.leftCols(at_once).diagonal().array() += 1;
    set_product(S, observed, acting.rightCols(observed.cols()));
    linalg::solve_beside(acting);
    return acting;
}

void StepMaps::set_map(double from, linalg::RowsOut out) const {
    out = _R;
    if (_away.cols() > 0) // the supports are not the same from every direction
        linalg::add_product(_L, forces_onto(from, _Y).rightCols(_Y.cols()), out);
}

void StepMaps::set_end(double from, const Rows &states, Rows &out) const {
    linalg::set_product(_R, states, out);
    if (_away.cols() == 0)
        return;
    Rows observed(_Y.rows(), states.cols());
    linalg::set_product(_Y, states, observed);
    linalg::add_product(_L, forces_onto(from, observed).rightCols(states.cols()), out);
}

} // namespace whirl::periodic
