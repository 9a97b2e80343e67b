#pragma once

#include "assembly/discretization.h"
#include "linalg/lanes/symmetric_factors.h"
#include "modes/whirl_mode.h"
#include "results/formulation.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <complex>
#include <map>
#include <memory>
#include <vector>

namespace whirl::modes {

/// Q(l) = l^2 M + l (D + speed D1) + K + speed K1 of a rotor, complex and symmetric, every matrix
/// kept as a real and an imaginary part with its own entries. So are the form planar_damped as it
/// stands, and the general form with y = i y' where its matrices are their transposes in the mirror
/// y -> -y: bearings with kxy = -kyx, or that do not couple the planes. There the unknowns are
/// (x + y') / sqrt(2) and (x - y') / sqrt(2), which only unequal supports couple. Unknowns are
/// scaled so that K has ones on its diagonal: all count alike, whatever their units.
class SymmetricProblem {
  public:
    using Complex = std::complex<double>;
    using Sparse = Eigen::SparseMatrix<double>;
    enum Part {
        mass,
        damping,
        damping_turned,
        gyroscopic,
        stiffness,
        stiffness_turned,
        circulatory
    };
    static constexpr int parts = 7;

    /// Of all speeds. None where the form is another one or not symmetric so, where bearings change
    /// with the speed, where the stiffness is not positive definite, or where something moves
    /// without mass.
    [[nodiscard]] static std::unique_ptr<SymmetricProblem>
    of(const assembly::Discretization &discretization, results::Form form);
    /// With the bearings as at one speed (rad/s); things may move without mass.
    [[nodiscard]] static std::unique_ptr<SymmetricProblem>
    with_bearings_at(double speed, const assembly::Discretization &discretization,
                     results::Form form);

    [[nodiscard]] int size() const { return _size; }
    [[nodiscard]] bool has(Part part) const { return !_parts[part].value.empty(); }
    [[nodiscard]] results::Form form() const { return _form; }
    [[nodiscard]] const Relaxation &relaxation() const { return _relaxation; }
    /// With an eigenvalue its conjugate is one: the general form.
    [[nodiscard]] bool conjugates() const { return _form == results::Form::general; }

    /// A vector of the form's unknowns as one of this problem, and back.
    [[nodiscard]] Eigen::VectorXcd from_form(const Eigen::VectorXcd &shape) const;
    [[nodiscard]] Eigen::VectorXcd to_form(const Eigen::VectorXcd &vector) const;
    /// The vector that goes with the conjugate eigenvalue.
    [[nodiscard]] Eigen::VectorXcd conjugate(const Eigen::VectorXcd &vector) const;
    /// A covector: its product with a vector stays what it is.
    [[nodiscard]] Eigen::VectorXcd covector_to_form(const Eigen::VectorXcd &vector) const;

    /// Vectors of four eigenpairs times the matrices; D1 and K1 are what a unit of speed changes.
    struct Products {
        linalg::Vector4 M, D, K, D1, K1;
    };
    void multiply(const linalg::Vector4 &x, const linalg::Real4 &speed, Products &out) const;
    /// Columns at one speed times the matrices.
    struct ColumnProducts {
        Eigen::MatrixXcd M, D, K;
    };
    [[nodiscard]] ColumnProducts products(double speed, const Eigen::MatrixXcd &X) const;

    /// At least |x|^T (|K| + |l| |D| + |l|^2 |M|) |x| of four vectors, what the entries add up to
    /// in x^T Q(l) x: with (|a|^2 + |b|^2) / 2 for each |a| |b|, of neighbours that move nearly
    /// alike.
    [[nodiscard]] std::array<double, linalg::lanes> absolute_forms(const linalg::Real4 &l,
                                                                   const linalg::Real4 &speed,
                                                                   const linalg::Vector4 &x) const;

    static constexpr linalg::Real4 ones{1, 1, 1, 1};
    /// L D L^T of four Q(l), each at a speed; the same object each time.
    /// @param damped  1, or 0 for a rotor without damping and what drives motions
    /// @throws linalg::SolverError where a pivot is zero, on an eigenvalue beside it too
    linalg::SymmetricFactors &factorize(linalg::Complex4 l, const linalg::Real4 &speed,
                                        const linalg::Real4 &damped = ones) const;
    /// b^H (K + s^2 M)^-1 b with the real part of K and s the power of two below a size (1/s).
    [[nodiscard]] std::array<double, linalg::lanes>
    energies(const linalg::Vector4 &b, const std::array<double, linalg::lanes> &sizes) const;

  private:
    /// Real symmetric matrix by its rows that are not empty.
    struct Rows {
        std::vector<int> row, start{0}, column;
        std::vector<double> value;
        std::vector<int> place; ///< of each entry on the common pattern
        /// One triangle for the factors: places among their entries, and values.
        std::vector<std::pair<int, double>> triangle;
    };
    /// What every element has, at an entry of the factors or of the rows.
    struct Everywhere {
        double M = 0, G = 0, K = 0;
    };
    /// M and K at rows, and G apart, which has fewer entries. Of pairs of unknowns (p, q) where
    /// both have the same M and K, and the opposite G: then each entry stands for both.
    struct Both {
        double M = 0, K = 0;
    };
    struct EverywhereRows {
        bool pairs = false;
        std::vector<int> start{0}, column;
        std::vector<Both> entry;
        std::vector<int> G_start{0}, G_column;
        std::vector<double> G;
    };
    int _size = 0;
    results::Form _form = results::Form::general;
    Relaxation _relaxation;
    std::vector<Rows> _parts;
    std::vector<std::array<double, parts>> _absolute_sums; ///< over the rows of |A|
    Eigen::VectorXd _scales; ///< unknowns of the form over those of this problem
    Eigen::VectorXd _inverse_scales;
    linalg::SymmetricFactors::Sparse _pattern;
    mutable std::unique_ptr<linalg::SymmetricFactors> _factors, _of_energies;
    std::vector<Everywhere> _everywhere;
    EverywhereRows _rows;
    Rows _M_across, _K_across;        ///< what of pairs is left
    mutable linalg::Vector4 _entries; ///< of four Q
    using Exponents = std::array<int, linalg::lanes>;
    mutable std::map<Exponents, linalg::RealEnergies> _energies; ///< by the exponents of two

    SymmetricProblem(const std::vector<Sparse> &matrices, results::Form form,
                     const Relaxation &relaxation);
    /// In the order of parts; none where the form is another one, or not symmetric so.
    [[nodiscard]] static std::vector<Sparse> parts_of(const assembly::Discretization &d,
                                                      results::Form form, double bearing_speed);
    [[nodiscard]] Eigen::VectorXcd scaled_to_form(const Eigen::VectorXcd &vector,
                                                  const Eigen::VectorXd &scales, double sign) const;
    void set_everywhere();
    template <class Work>
    void for_row(const std::vector<Everywhere> &common, int row, const Work &work) const;
    [[nodiscard]] bool in_pairs(const std::vector<Everywhere> &common, int pair) const;
    void set_rows(const std::vector<Everywhere> &common);
    void set_across(const std::vector<Everywhere> &common, double Everywhere::*of, Rows &across);
    template <int each> void multiply_everywhere(const linalg::Vector4 &x, Products &out) const;
    void add_part(Part part, const Sparse &A);
    [[nodiscard]] bool factorized(const linalg::Complex4 &l, const linalg::Real4 &speed,
                                  const linalg::Real4 &damped) const;
    [[nodiscard]] linalg::RealEnergies energies_of(const Exponents &exponents) const;
};

} // namespace whirl::modes
