#include "periodic/whole_root.h"

#include "assembly/hill_system.h"
#include "linalg/unit_scales.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

/// l^2 a2 + l a1 + a0 and its derivative.
struct Quadratic {
    Complex a2, a1, a0;

    [[nodiscard]] Complex at(Complex l) const { return a0 + l * (a1 + l * a2); }
    [[nodiscard]] Complex slope(Complex l) const { return 2.0 * l * a2 + a1; }
};

/// A starting vector without symmetry.
Eigen::VectorXcd start_vector(Eigen::Index size) {
    Eigen::VectorXcd out(size);
    for (Eigen::Index i = 0; i < size; ++i)
        out(i) = Complex(1 + 0.5 * std::sin(1.7 * static_cast<double>(i)),
                         0.5 * std::cos(2.3 * static_cast<double>(i)));
    return out.normalized();
}

/// Terms of a motion as those from -N to N, over unknowns divided by d; without any, numbers
/// without a pattern.
Eigen::VectorXcd start_vector(const Eigen::MatrixXcd &terms, const Eigen::VectorXd &d, int N) {
    const Eigen::Index n = d.size();
    const Eigen::Index columns = 2 * N + 1;
    if (terms.size() == 0)
        return start_vector(n * columns);
    const Eigen::MatrixXcd out =
        d.cwiseInverse().asDiagonal() * assembly::middle_terms(terms, columns);
    return out.reshaped().normalized();
}

/// Harmonics that are tried at most, without terms of the motion to go by.
constexpr int usual = 80;

/// The next number of harmonics to try, less this one.
int more_of(int harmonics) { return harmonics < usual ? 2 : harmonics / 12; }

/// The larger of its first and last n entries.
double end_of(const Eigen::VectorXcd &x, Eigen::Index n) {
    return std::max(x.head(n).norm(), x.tail(n).norm());
}

/// |x|^2 of so many terms in the middle.
double with_terms(const Eigen::VectorXcd &x, Eigen::Index n, Eigen::Index terms) {
    const Eigen::Index kept = std::min(x.size(), n * terms);
    return x.segment((x.size() - kept) / 2, kept).squaredNorm();
}

} // namespace

/// The rotor at one speed.
struct WholeRotor::AtSpeed {
    double speed = 0;
    Sparse M, D, K;
    Sparse C_cosine, C_sine, K_cosine, K_sine;

    void scale(const Eigen::VectorXd &d) {
        for (Sparse *A : {&M, &D, &K, &C_cosine, &C_sine, &K_cosine, &K_sine}) {
            *A = linalg::scaled(*A, d);
            A->prune(0.0); // stored zeros would couple each unknown with itself in other terms
        }
    }
};

/// The equations of the terms q_-N, ..., q_N. In the column of term k stand, with its exponent
/// w = l + 2 i k speed, w^2 M + w D + K and, one row above and below, w C + K of the supports.
class WholeRotor::Series {
  public:
    Series(const AtSpeed &rotor, int harmonics)
        : _rotor(rotor), _harmonics(harmonics), _n(rotor.M.rows()) {
        const Complex i(0, 1);
        for (std::size_t side = 0; side < 2; ++side) { // cos = (e+ + e-)/2, sin = (e+ - e-)/2i
            const Complex half_sine = (side == 0 ? 0.5 : -0.5) * i;
            _C[side] = 0.5 * rotor.C_cosine.cast<Complex>() + half_sine * rotor.C_sine;
            _K[side] = 0.5 * rotor.K_cosine.cast<Complex>() + half_sine * rotor.K_sine;
        }
    }

    [[nodiscard]] Eigen::Index size() const { return _n * (2 * _harmonics + 1); }

    [[nodiscard]] ComplexSparse at(Complex l) const {
        return assembled(
            l,
            [this](Complex w) -> ComplexSparse {
                return w * w * _rotor.M + w * _rotor.D + _rotor.K.cast<Complex>();
            },
            [this](Complex w, std::size_t side) -> ComplexSparse {
                return w * _C[side] + _K[side];
            });
    }
    /// The derivative by l.
    [[nodiscard]] ComplexSparse slope(Complex l) const {
        return assembled(
            l,
            [this](Complex w) -> ComplexSparse {
                return 2.0 * w * _rotor.M + _rotor.D.cast<Complex>();
            },
            [this](Complex, std::size_t side) { return _C[side]; });
    }

    /// y^H (l^2 A2 + l A1 + A0) x
    [[nodiscard]] Quadratic form(const Eigen::VectorXcd &y, const Eigen::VectorXcd &x) const {
        Quadratic out;
        for (Eigen::Index block = 0; block <= 2 * _harmonics; ++block) {
            const Complex w = exponent(0, block);
            const Eigen::VectorXcd here = x.segment(block * _n, _n);
            const auto own = y.segment(block * _n, _n);
            const Complex m = own.dot(_rotor.M * here);
            const Complex d = own.dot(_rotor.D * here);
            out.a2 += m;
            out.a1 += 2.0 * w * m + d;
            out.a0 += w * (w * m + d) + own.dot(_rotor.K * here);
            for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
                const Eigen::Index row = side == 0 ? block - 1 : block + 1;
                if (row < 0 || row > 2 * _harmonics)
                    continue;
                const auto other = y.segment(row * _n, _n);
                const Complex c = other.dot(_C[side] * here);
                out.a1 += c;
                out.a0 += w * c + other.dot(_K[side] * here);
            }
        }
        return out;
    }

  private:
    const AtSpeed &_rotor;
    int _harmonics;
    Eigen::Index _n;
    std::array<ComplexSparse, 2> _C, _K; ///< to the row above, and below

    [[nodiscard]] Complex exponent(Complex l, Eigen::Index block) const {
        return l + Complex(0, 2 * static_cast<double>(block - _harmonics) * _rotor.speed);
    }
    /// Columns from the first to the last, each from the top.
    /// @param own     on the diagonal, of the exponent of a term
    /// @param beside  to the row above and below, besides of the side
    template <class Own, class Beside>
    [[nodiscard]] ComplexSparse assembled(Complex l, const Own &own, const Beside &beside) const {
        ComplexSparse out(size(), size());
        out.reserve((2 * _harmonics + 1) *
                    (_rotor.M.nonZeros() + _rotor.D.nonZeros() + _rotor.K.nonZeros() +
                     2 * (_C[0].nonZeros() + _K[0].nonZeros())));
        for (Eigen::Index block = 0; block <= 2 * _harmonics; ++block) {
            const Complex w = exponent(l, block);
            const std::array<ComplexSparse, 3> rows{beside(w, 0), own(w), beside(w, 1)};
            for (Eigen::Index j = 0; j < _n; ++j) {
                out.startVec(block * _n + j);
                for (Eigen::Index row = std::max<Eigen::Index>(block - 1, 0);
                     row <= std::min<Eigen::Index>(block + 1, 2 * _harmonics); ++row)
                    insert(out, rows[static_cast<std::size_t>(row - block + 1)], j, row, block);
            }
        }
        out.finalize();
        return out;
    }
    void insert(ComplexSparse &to, const ComplexSparse &block, Eigen::Index j, Eigen::Index row,
                Eigen::Index column) const {
        for (ComplexSparse::InnerIterator entry(block, j); entry; ++entry)
            to.insertBack(row * _n + entry.row(), column * _n + j) = entry.value();
    }
};

/// One root of a series and its vectors, improved.
class WholeRotor::Iteration {
  public:
    /// @param near    of the guess: a root so near is no other one
    /// @param factor  knows the pattern, or nothing yet
    Iteration(const Series &series, Complex guess, double scale, double near,
              const Eigen::VectorXcd &start, Factor &factor)
        : _series(series), _factor(factor), _root{guess, start, start}, _scale(scale), _near(near) {
    }

    /// The root, or nothing where it does not settle.
    std::optional<Root> settled() {
        constexpr int factorisations = 5; // new shifts, each nearer to the root
        for (int k = 0; k < factorisations; ++k) {
            _jumped = false;
            if (settle_with_one())
                return std::move(_root);
            if (!_jumped)
                _factor.forget_pivots();
        }
        return std::nullopt;
    }

  private:
    const Series &_series;
    Factor &_factor;
    Root _root;
    double _scale, _near;
    bool _jumped = false; ///< farther than that: to go on from there

    bool settle_with_one() {
        const Complex at = _root.value;
        if (!_factor.factorize(_series.at(at)) &&
            !_factor.factorize(_series.at(at + 1e-9 * _scale))) // at the root itself
            return false;
        const ComplexSparse slope = _series.slope(at);
        // With one factorisation: linear in the ratio of distances to the shift.
        constexpr int solves = 6;
        for (int step = 0; step < solves; ++step) {
            _root.terms = _factor.solution(slope * _root.terms).normalized();
            _root.left = _factor.adjoint_solution(slope.adjoint() * _root.left).normalized();
            const Complex before = _root.value;
            if (!_root.terms.allFinite() || !_root.left.allFinite() || !improve())
                return false;
            const double moved = std::abs(_root.value - before);
            _jumped = moved > _near;
            if (_jumped)
                return false;
            // Where two roots meet, rounding leaves no more than its noise.
            if (moved <= std::max(1e-13 * _scale, _root.noise))
                return true;
        }
        return false;
    }

    /// The root next to the last one of y^H (l^2 A2 + l A1 + A0) x = 0.
    bool improve() {
        const Quadratic form = _series.form(_root.left, _root.terms);
        for (int step = 0; step < 20; ++step) {
            const Complex change = -form.at(_root.value) / form.slope(_root.value);
            if (!std::isfinite(std::abs(change)))
                return false;
            _root.value += change;
            if (std::abs(change) <= 1e-14 * _scale)
                break;
        }
        // Error of the root by the rounding of every entry; scaled, the stiffness is of size 1.
        constexpr double rounding = 10 * std::numeric_limits<double>::epsilon();
        _root.noise = rounding / std::abs(form.slope(_root.value));
        return true;
    }
};

WholeRotor::WholeRotor(const assembly::Discretization &discretization,
                       std::vector<balancers::BalancerElement> balancers)
    : _discretization(discretization), _balancers(std::move(balancers)),
      _tables(discretization.rotor().bearings_depend_on_speed()) {
    if (!_tables)
        _matrices = assembled(0);
}

WholeRotor::Matrices WholeRotor::assembled(double bearing_speed) const {
    assembly::RotatingSystem rotating =
        assembly::assemble_rotating(_discretization, bearing_speed, _balancers);
    const int unknowns = rotating.M.size();
    return {std::move(rotating),
            assembly::periodic_supports(_discretization, bearing_speed, unknowns)};
}

WholeRotor::AtSpeed WholeRotor::at(double speed) const {
    const Matrices now = _tables ? assembled(speed) : Matrices{};
    const auto &[rotating, turning] = _tables ? now : _matrices;
    return {speed,
            rotating.M.view(),
            rotating.C.view() + speed * rotating.Cs.view(),
            rotating.K.view() + speed * (rotating.Ks.view() + speed * rotating.Kss.view()),
            turning.C.cosine.view(),
            turning.C.sine.view(),
            turning.K.cosine.view() + speed * turning.Ks.cosine.view(),
            turning.K.sine.view() + speed * turning.Ks.sine.view()};
}

Complex WholeRotor::change(const Root &root, double speed, const WholeRotor &other,
                           double other_speed) const {
    const AtSpeed here = at(speed);
    const AtSpeed there = other.at(other_speed);
    const auto harmonics = static_cast<int>((root.terms.size() / here.M.rows() - 1) / 2);
    const Quadratic before = Series(here, harmonics).form(root.left, root.terms);
    const Quadratic after = Series(there, harmonics).form(root.left, root.terms);
    return -(after.at(root.value) - before.at(root.value)) / before.slope(root.value);
}

Complex WholeRotor::slope(const Root &root, double speed) const {
    const double step = 1e-4 * speed; // without tables all are of second degree
    return (change(root, speed, *this, speed + step) - change(root, speed, *this, speed - step)) /
           (2 * step);
}

std::optional<WholeRotor::Driven> WholeRotor::driven(double speed, Complex exponent,
                                                     const Eigen::VectorXcd &load) const {
    AtSpeed problem = at(speed);
    const Eigen::VectorXd d =
        linalg::scales_at(std::abs(speed), problem.M.diagonal(), problem.K.diagonal());
    problem.scale(d);
    const Eigen::Index n = d.size();
    constexpr double nothing = 1e-13; // of the motion: what the series is cut by
    constexpr int fewest = 3;         // harmonics to begin with, of which the last must be nothing
    constexpr double far_less = 1e-4; // of that: then one harmonic fewer may do at the next speed
    for (int N = std::max(fewest, _driven_harmonics); N <= usual; N += std::max(1, N / 6)) {
        const ComplexSparse A = Series(problem, N).at(exponent);
        Eigen::VectorXcd f = Eigen::VectorXcd::Zero(A.rows());
        f.segment(N * n, n) = d.cwiseProduct(load);
        Factor &factor = _factors.try_emplace(N, true).first->second;
        const Eigen::VectorXd sizes = A.cwiseAbs() * Eigen::VectorXd::Ones(A.cols());
        Eigen::VectorXcd x;
        // The pivots of the matrix before may not be good for this one: then it gets its own.
        for (const bool again : {false, true}) {
            if (again)
                factor.forget_pivots();
            if (!factor.factorize(A))
                continue;
            x = factor.solution(f);
            constexpr double stable = 1e-14; // what a backward stable solution leaves
            if (x.allFinite() &&
                (f - A * x).norm() <= stable * (sizes.maxCoeff() * x.norm() + f.norm()))
                break;
        }
        if (x.size() == 0 || !x.allFinite())
            return std::nullopt;
        const double size = x.norm();
        const double end = end_of(x, n);
        if (end > nothing * size)
            continue;
        _driven_harmonics = end > far_less * nothing * size ? N : N - 1;
        Driven out;
        out.terms = d.asDiagonal() * x.reshaped(n, 2 * N + 1);
        // Rounding of the entries changes each row of A x by about epsilon times its size.
        const Eigen::VectorXcd change =
            std::numeric_limits<double>::epsilon() * (A.cwiseAbs() * x.cwiseAbs() + f.cwiseAbs());
        out.rounding = size > 0 ? factor.solution(change).norm() / size : 0;
        return out;
    }
    return std::nullopt;
}

std::optional<WholeRotor::Root> WholeRotor::next_to(double speed, Complex guess, double frequency,
                                                    const Eigen::MatrixXcd &terms) const {
    AtSpeed problem = at(speed);
    const double scale = std::abs(speed) + std::abs(guess);
    const Eigen::VectorXd d =
        linalg::scales_at(std::max(scale, frequency), problem.M.diagonal(), problem.K.diagonal());
    problem.scale(d);
    const Eigen::Index n = d.size();
    const bool guided = terms.size() > 0;
    const int most = guided ? 6 * usual : usual;
    constexpr int margin = 2;        // terms behind the largest one
    constexpr double nothing = 1e-8; // its square is what the value is off by
    // Of the motion: a thousandth of `nothing`, as in modal_series.cpp.
    constexpr double far_too_many = 1e-11;
    constexpr double mostly = 0.3; // overlap with the guess's terms: less is another motion
    const double near = guided ? 1e-2 * std::abs(speed) : std::numeric_limits<double>::infinity();
    const double turns = (frequency + std::abs(speed)) / (2 * std::abs(speed));
    auto known = static_cast<int>(terms.cols() / 2);
    if (known > 0 && end_of(start_vector(terms, d, known), n) > nothing)
        ++known; // one more than that is not nothing
    if (!(turns <= most - margin))
        return std::nullopt; // it would end before the largest term, and find something else
    for (int N =
             std::max(known, static_cast<int>(std::min<double>(most - _beyond, turns)) + _beyond);
         N <= most; N += more_of(N)) {
        const Series series(problem, N);
        const Eigen::VectorXcd start = start_vector(terms, d, N);
        Factor large(true); // too large to be kept
        Factor &factor = N <= usual ? _factors.try_emplace(N, true).first->second : large;
        std::optional<Root> root = Iteration(series, guess, scale, near, start, factor).settled();
        if (!root)
            return std::nullopt;
        const Eigen::VectorXcd &x = root->terms;
        const double end = end_of(x, n);
        if (end > nothing) {
            if (N > known && N <= usual)
                _beyond += more_of(N);
            continue;
        }
        if (end < far_too_many)
            _beyond = std::max(margin, _beyond - 1);
        if (guided && !(std::norm(start.dot(x)) > mostly * with_terms(x, n, terms.cols())))
            return std::nullopt;
        for (int k = 0; k <= 2 * N; ++k)
            for (Eigen::VectorXcd *vector : {&root->terms, &root->left})
                vector->segment(k * n, n) = d.cwiseProduct(vector->segment(k * n, n)).eval();
        return root;
    }
    _beyond = margin;
    return std::nullopt;
}

} // namespace whirl::periodic
