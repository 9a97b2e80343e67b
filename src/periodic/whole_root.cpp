#include "periodic/whole_root.h"

#include "assembly/rotating_system.h"
#include "linalg/unit_scales.h"

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;
using ComplexSparse = Eigen::SparseMatrix<Complex>;
using LU = Eigen::SparseLU<ComplexSparse>;
using Entries = std::vector<Eigen::Triplet<Complex>>;

/// l^2 A2 + l A1 + A0.
struct Quadratic {
    ComplexSparse A2, A1, A0;

    [[nodiscard]] ComplexSparse at(Complex l) const { return l * l * A2 + l * A1 + A0; }
};

/// Blocks of the series while they are filled.
class SeriesBlocks {
  public:
    SeriesBlocks(Eigen::Index size, int harmonics) : _size(size), _harmonics(harmonics) {}

    void add(Entries &to, int row, int column, Complex factor, const Sparse &block) const {
        if (std::abs(row) > _harmonics || factor == 0.0)
            return;
        const auto n = static_cast<int>(_size);
        for (Eigen::Index j = 0; j < block.outerSize(); ++j)
            for (Sparse::InnerIterator entry(block, j); entry; ++entry)
                to.emplace_back((row + _harmonics) * n + static_cast<int>(entry.row()),
                                (column + _harmonics) * n + static_cast<int>(entry.col()),
                                factor * entry.value());
    }
    [[nodiscard]] ComplexSparse matrix(const Entries &entries) const {
        const Eigen::Index all = _size * (2 * _harmonics + 1);
        ComplexSparse out(all, all);
        out.setFromTriplets(entries.begin(), entries.end());
        return out;
    }

  private:
    Eigen::Index _size;
    int _harmonics;
};

/// The rotor at one speed.
struct AtSpeed {
    double speed = 0;
    Sparse M, D, K;
    Sparse C_cosine, C_sine, K_cosine, K_sine;

    [[nodiscard]] Quadratic series(int harmonics) const {
        const Complex i(0, 1);
        const SeriesBlocks blocks(M.rows(), harmonics);
        Entries into2, into1, into0;
        for (int k = -harmonics; k <= harmonics; ++k) {
            const Complex w = 2.0 * i * static_cast<double>(k) * speed;
            blocks.add(into2, k, k, 1, M);
            blocks.add(into1, k, k, 2.0 * w, M);
            blocks.add(into1, k, k, 1, D);
            blocks.add(into0, k, k, w * w, M);
            blocks.add(into0, k, k, w, D);
            blocks.add(into0, k, k, 1, K);
            for (const int up : {-1, 1}) { // cos = (e+ + e-)/2, sin = (e+ - e-)/2i
                const Complex half_sine = -0.5 * static_cast<double>(up) * i;
                blocks.add(into1, k + up, k, 0.5, C_cosine);
                blocks.add(into1, k + up, k, half_sine, C_sine);
                blocks.add(into0, k + up, k, 0.5 * w, C_cosine);
                blocks.add(into0, k + up, k, half_sine * w, C_sine);
                blocks.add(into0, k + up, k, 0.5, K_cosine);
                blocks.add(into0, k + up, k, half_sine, K_sine);
            }
        }
        return {blocks.matrix(into2), blocks.matrix(into1), blocks.matrix(into0)};
    }

    void scale(const Eigen::VectorXd &d) {
        for (Sparse *A : {&M, &D, &K, &C_cosine, &C_sine, &K_cosine, &K_sine})
            *A = Sparse(d.asDiagonal() * *A * d.asDiagonal());
    }
};

/// Numbers without a pattern, to begin with.
Eigen::VectorXcd start_vector(Eigen::Index size) {
    Eigen::VectorXcd out(size);
    for (Eigen::Index i = 0; i < size; ++i)
        out(i) = Complex(1 + 0.5 * std::sin(1.7 * static_cast<double>(i)),
                         0.5 * std::cos(2.3 * static_cast<double>(i)));
    return out.normalized();
}

/// One root of a series and its vectors, improved.
class Iteration {
  public:
    /// @param lu  knows the pattern, or nothing yet
    Iteration(const Quadratic &problem, Complex guess, double scale, LU &lu)
        : _problem(problem), _lu(lu), _value(guess), _scale(scale),
          _right(start_vector(problem.A2.rows())), _left(_right) {}

    /// @returns whether it settled
    bool settle() {
        constexpr int factorisations = 5;
        for (int k = 0; k < factorisations; ++k)
            if (settle_with_one())
                return true;
        return false;
    }
    [[nodiscard]] Complex value() const { return _value; }
    [[nodiscard]] const Eigen::VectorXcd &right() const { return _right; }
    [[nodiscard]] double noise() const { return _noise; }

  private:
    const Quadratic &_problem;
    LU &_lu;
    Complex _value;
    double _scale;
    Eigen::VectorXcd _right, _left;
    double _noise = 0;

    bool settle_with_one() {
        if (!factorised(_value) && !factorised(_value + 1e-9 * _scale)) // at the root itself
            return false;
        const ComplexSparse slope = 2.0 * _value * _problem.A2 + _problem.A1;
        constexpr int solves = 6;
        for (int step = 0; step < solves; ++step) {
            _right = _lu.solve(Eigen::VectorXcd(slope * _right)).normalized();
            _left = _lu.adjoint().solve(Eigen::VectorXcd(slope.adjoint() * _left)).normalized();
            const Complex before = _value;
            if (!_right.allFinite() || !_left.allFinite() || !improve())
                return false;
            // Where two roots meet, rounding leaves no more than its noise.
            if (std::abs(_value - before) <= std::max(1e-13 * _scale, _noise))
                return true;
        }
        return false;
    }

    bool factorised(Complex l) {
        ComplexSparse Q = _problem.at(l);
        Q.makeCompressed();
        if (_lu.rows() == 0)
            _lu.analyzePattern(Q);
        _lu.factorize(Q);
        return _lu.info() == Eigen::Success;
    }

    /// The root next to the last one of y^H (l^2 A2 + l A1 + A0) x = 0.
    bool improve() {
        const Complex a2 = _left.dot(_problem.A2 * _right);
        const Complex a1 = _left.dot(_problem.A1 * _right);
        const Complex a0 = _left.dot(_problem.A0 * _right);
        for (int step = 0; step < 20; ++step) {
            const Complex change = -(a0 + _value * (a1 + _value * a2)) / (2.0 * _value * a2 + a1);
            if (!std::isfinite(std::abs(change)))
                return false;
            _value += change;
            if (std::abs(change) <= 1e-14 * _scale)
                break;
        }
        // Rounding of every entry, as the root feels it; scaled, the stiffness is of the size 1.
        constexpr double rounding = 10 * std::numeric_limits<double>::epsilon();
        _noise = rounding / std::abs(2.0 * _value * a2 + a1);
        return true;
    }
};

} // namespace

struct WholeRotor::Factors {
    std::map<int, LU> with_harmonics;
};

WholeRotor::WholeRotor(const assembly::Discretization &discretization,
                       std::vector<balancers::BalancerElement> balancers)
    : _discretization(discretization), _balancers(std::move(balancers)),
      _tables(discretization.rotor().bearings_depend_on_speed()),
      _factors(std::make_unique<Factors>()) {
    if (!_tables)
        _matrices = assembled(0);
}

WholeRotor::~WholeRotor() = default;

WholeRotor::Matrices WholeRotor::assembled(double bearing_speed) const {
    const assembly::RotatingSystem s =
        assembly::assemble_rotating(_discretization, bearing_speed, _balancers);
    const assembly::TurningSupports t =
        assembly::turning_supports(_discretization, bearing_speed, s.M.size());
    return {s.M.view(),
            s.C.view(),
            s.Cs.view(),
            s.K.view(),
            s.Ks.view(),
            s.Kss.view(),
            {t.C.cosine.view(), t.C.sine.view()},
            {t.K.cosine.view(), t.K.sine.view()},
            {t.Ks.cosine.view(), t.Ks.sine.view()}};
}

std::optional<WholeRotor::Root> WholeRotor::next_to(double speed, Complex guess,
                                                    double frequency) const {
    const Matrices now = _tables ? assembled(speed) : Matrices{};
    const Matrices &m = _tables ? now : _matrices;
    AtSpeed problem{speed,
                    m.M,
                    m.C + speed * m.Cs,
                    m.K + speed * (m.Ks + speed * m.Kss),
                    m.turning_C.cosine,
                    m.turning_C.sine,
                    m.turning_K.cosine + speed * m.turning_Ks.cosine,
                    m.turning_K.sine + speed * m.turning_Ks.sine};
    const double scale = std::abs(speed) + std::abs(guess);
    const Eigen::VectorXd d =
        linalg::scales_at(std::max(scale, frequency), problem.M.diagonal(), problem.K.diagonal());
    problem.scale(d);
    const Eigen::Index n = d.size();
    constexpr int most = 80;
    constexpr int margin = 4;
    constexpr double nothing = 1e-8; // its square is what the value is off by
    const double turns = (frequency + std::abs(speed)) / (2 * std::abs(speed));
    for (int N = margin + static_cast<int>(std::min<double>(most, turns)); N <= most; N += margin) {
        const Quadratic series = problem.series(N);
        Iteration iteration(series, guess, scale, _factors->with_harmonics[N]);
        if (!iteration.settle())
            return std::nullopt;
        const Eigen::VectorXcd &x = iteration.right();
        if (std::max(x.head(n).norm(), x.tail(n).norm()) > nothing)
            continue;
        Root root{iteration.value(), x, iteration.noise()};
        for (int k = 0; k <= 2 * N; ++k)
            root.terms.segment(k * n, n) = d.cwiseProduct(x.segment(k * n, n));
        return root;
    }
    return std::nullopt;
}

} // namespace whirl::periodic
