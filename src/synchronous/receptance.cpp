#include "synchronous/receptance.h"

#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/sparse_factor.h"
#include "linalg/unit_scales.h"
#include "modes/support_damping.h"
#include "results/formulation.h"
#include "synchronous/parts.h"

#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace whirl::synchronous {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;

/// Z(s) = sum of factor times term; all terms have the pattern of their sum, so that Z is a
/// combination of the lists of their values.
enum Factor { one, speed_once, minus_speed_squared, i_speed, i_speed_squared, factor_count };

struct Terms {
    std::array<Sparse, factor_count> of;

    /// Gives all the same pattern; missing terms become zeros.
    void align() {
        Sparse pattern;
        for (const Sparse &term : of)
            if (term.rows() > 0)
                pattern = pattern.rows() == 0 ? Sparse(term.cwiseAbs())
                                              : Sparse(pattern + term.cwiseAbs());
        pattern.coeffs().setZero();
        for (Sparse &term : of)
            term = term.rows() == 0 ? pattern : Sparse(pattern + term);
    }
    /// Scales of the unknowns that make the diagonal of K + w^2 M, w a frequency of the order of
    /// those of the single unknowns, about 1.
    [[nodiscard]] Eigen::VectorXd scales() const {
        const Eigen::VectorXd K = of[one].diagonal().cwiseAbs();
        const Eigen::VectorXd M = of[minus_speed_squared].diagonal().cwiseAbs();
        double sum = 0;
        int count = 0;
        for (Eigen::Index i = 0; i < K.size(); ++i)
            if (M(i) > 0 && K(i) > 0) {
                sum += std::log2(K(i) / M(i));
                ++count;
            }
        const double square = count > 0 ? std::exp2(sum / count) : 1;
        return unit_diagonal(K + square * M);
    }
    void scale(const Eigen::VectorXd &d) {
        for (Sparse &term : of)
            term = linalg::scaled(term, d);
    }
    [[nodiscard]] bool absent(Factor factor) const {
        return of[factor].nonZeros() == 0 || of[factor].coeffs().isZero(0);
    }
};

Terms planar_terms(const assembly::Discretization &d, double speed) {
    const assembly::PlanarSystem system = assembly::assemble_planar(d, speed);
    const auto C =
        linalg::Matrix::from_entries(d.planar_size(), modes::planar_support_damping(d, speed));
    Terms terms;
    terms.of[one] = system.K.view();
    terms.of[minus_speed_squared] = linalg::Matrix::sum(1, system.M, -1, system.G).view();
    terms.of[i_speed] = C.view();
    terms.align();
    return terms;
}

Terms general_terms(const assembly::Discretization &d, double speed) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, speed);
    Terms terms;
    terms.of[one] = system.K.view();
    terms.of[speed_once] = system.Kc.view();
    terms.of[minus_speed_squared] = system.M.view();
    terms.of[i_speed] = system.C.view();
    terms.of[i_speed_squared] = system.G.view();
    terms.align();
    return terms;
}

/// Sparse LU with one symbolic analysis for all speeds (COLAMD, partial pivoting).
template <class Scalar> class Solver {
  public:
    using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

    void assemble(const Terms &terms, double speed) {
        const std::array<Complex, factor_count> factors{
            1.0, speed, -speed * speed, Complex(0, speed), Complex(0, speed * speed)};
        if (_Z.nonZeros() != terms.of[one].nonZeros())
            _Z = terms.of[one].template cast<Scalar>();
        _Z.coeffs().setZero();
        for (std::size_t i = 0; i < factor_count; ++i) {
            if constexpr (std::is_same_v<Scalar, double>)
                _Z.coeffs() += factors[i].real() * terms.of[i].coeffs();
            else
                _Z.coeffs() += factors[i] * terms.of[i].coeffs().template cast<Complex>();
        }
    }

    /// Z^-1 F. @throws linalg::SolverError where Z is singular.
    [[nodiscard]] Dense solve(const Dense &F) {
        if (!_lu.factorize(_Z))
            throw linalg::SolverError("the dynamic stiffness matrix is singular");
        Dense U = F;
        _lu.solve(U);
        if (!U.allFinite())
            throw linalg::SolverError("the dynamic stiffness matrix is singular");
        // A backward stable solution leaves some 1e-15; far more means that elimination went wrong.
        const Dense rest = _Z * U - F;
        const double size = (_Z.cwiseAbs() * U.cwiseAbs()).maxCoeff() + F.cwiseAbs().maxCoeff();
        if (!(rest.cwiseAbs().maxCoeff() <= 1e-8 * size))
            throw linalg::SolverError(
                "the linear system of the forced motion left a large residual");
        return U;
    }

  private:
    Eigen::SparseMatrix<Scalar> _Z;
    linalg::SparseFactor<Scalar> _lu;
};

} // namespace

struct ForwardReceptance::Data {
    Data(const assembly::Discretization &of, bool is_planar)
        : rotor(of), planar(is_planar), tables(of.rotor().bearings_depend_on_speed()),
          terms(unscaled_terms(0)), scales(terms.scales()) {
        terms.scale(scales);
    }

    const assembly::Discretization &rotor;
    bool planar;
    bool tables;
    Terms terms;                             ///< of scaled unknowns
    Eigen::VectorXd scales;                  ///< of the unknowns
    Eigen::SparseMatrix<double> real_places; ///< scaled; planar: one column a place
    Eigen::SparseMatrix<Complex> places;     ///< scaled; general: (1, -i)/sqrt 2 a place
    bool real = false;                       ///< Z is: undamped and planar
    Solver<double> real_solver;
    Solver<Complex> solver;

    [[nodiscard]] Terms unscaled_terms(double speed) const {
        return planar ? planar_terms(rotor, speed) : general_terms(rotor, speed);
    }
    [[nodiscard]] Terms terms_at(double speed) const {
        Terms out = unscaled_terms(speed);
        out.scale(scales);
        return out;
    }
};

ForwardReceptance::ForwardReceptance(const assembly::Discretization &rotor, results::Form form,
                                     const std::vector<assembly::Combination> &places)
    : _data(std::make_unique<Data>(rotor, form == results::Form::planar)) {
    Data &d = *_data;
    d.real = d.planar && !d.tables && d.terms.absent(i_speed);
    const auto count = static_cast<Eigen::Index>(places.size());
    std::vector<Eigen::Triplet<double>> real_entries;
    std::vector<Eigen::Triplet<Complex>> entries;
    const double half = std::sqrt(0.5);
    for (std::size_t k = 0; k < places.size(); ++k)
        for (const auto &[unknown, value] : places[k]) {
            const int column = static_cast<int>(k);
            if (d.planar) {
                real_entries.emplace_back(unknown, column, d.scales(unknown) * value);
                entries.emplace_back(unknown, column, d.scales(unknown) * value);
            } else { // f = Re[(1, -i) exp(i s t)]: a vector that turns with the rotor
                const double x = half * value * d.scales(2 * unknown);
                const double y = half * value * d.scales(2 * unknown + 1);
                entries.emplace_back(2 * unknown, column, x);
                entries.emplace_back(2 * unknown + 1, column, Complex(0, -y));
            }
        }
    const Eigen::Index size = d.terms.of[one].rows();
    d.real_places.resize(rotor.planar_size(), count);
    d.real_places.setFromTriplets(real_entries.begin(), real_entries.end());
    d.places.resize(size, count);
    d.places.setFromTriplets(entries.begin(), entries.end());
}

ForwardReceptance::~ForwardReceptance() = default;

Eigen::MatrixXcd ForwardReceptance::at(double speed) {
    Data &d = *_data;
    if (d.tables)
        d.terms = d.terms_at(speed);
    const double square = speed * speed;
    if (d.real) {
        d.real_solver.assemble(d.terms, speed);
        const Eigen::MatrixXd U = d.real_solver.solve(Eigen::MatrixXd(d.real_places));
        return (square * (d.real_places.transpose() * U)).cast<Complex>();
    }
    d.solver.assemble(d.terms, speed);
    const Eigen::MatrixXcd U = d.solver.solve(Eigen::MatrixXcd(d.places));
    return square * (d.places.adjoint() * U);
}

double ForwardReceptance::rounding(double speed, const Eigen::VectorXcd &s) {
    Data &d = *_data;
    if (d.tables)
        d.terms = d.terms_at(speed);
    d.solver.assemble(d.terms, speed);
    const Eigen::VectorXd u = d.solver.solve(Eigen::MatrixXcd(d.places * s)).cwiseAbs();
    const double square = speed * speed;
    double sum = 0;
    const std::array<double, factor_count> sizes{1, std::abs(speed), square, std::abs(speed),
                                                 square};
    for (std::size_t i = 0; i < factor_count; ++i)
        sum += sizes[i] * u.dot(Sparse(d.terms.of[i].cwiseAbs()) * u);
    return square * std::numeric_limits<double>::epsilon() * sum;
}

int ForwardReceptance::unknowns() const { return static_cast<int>(2 * _data->places.rows()); }

bool ForwardReceptance::undamped() const {
    const Terms &terms = _data->terms;
    return terms.absent(i_speed) && terms.absent(speed_once);
}

Eigen::MatrixXcd hermitian_part(const Eigen::MatrixXcd &R) { return (R + R.adjoint()) / 2; }

} // namespace whirl::synchronous
