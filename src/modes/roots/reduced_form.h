#pragma once

#include "modes/biorthogonal.h"
#include "modes/form_matrices.h"
#include "modes/roots/roots.h"

#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

namespace whirl::modes {

/// A rotor in a form of the fixed frame on shapes of each plane, at any speed: every term is
/// projected once, of bearing tables their few entries at each speed. Unknowns: amplitudes of the
/// shapes of x, then those of y.
class ReducedForm {
  public:
    /// @param whole   must outlive this
    /// @param shapes  N x r, planar, of each plane of the form; none: all unknowns
    ReducedForm(const FormMatrices &whole, std::vector<Eigen::MatrixXd> shapes);

    /// Form planar_damped: complex; form general: real. Without rates.
    template <class Scalar> [[nodiscard]] DenseQuadratic<Scalar> at(double speed) const;

    /// The root next to a guess of value and vectors, by inverse iteration from both sides: what is
    /// left is of second order in a few hundredths. Nothing where it does not settle.
    /// @param problem  of one speed
    template <class Scalar>
    [[nodiscard]] std::optional<Root> iterated(const DenseQuadratic<Scalar> &problem,
                                               Root guess) const;

    /// States and rates of modes at a speed.
    /// @param right,left  y^T Q = 0, over the amplitudes
    [[nodiscard]] ModeBasis basis(double speed, const Eigen::VectorXcd &values,
                                  const Eigen::MatrixXcd &right,
                                  const Eigen::MatrixXcd &left) const;

    [[nodiscard]] const std::vector<Eigen::MatrixXd> &shapes() const { return _shapes; }
    [[nodiscard]] bool is_whole() const { return _shapes.empty(); }
    /// Amplitudes of the shapes as unknowns of the whole rotor.
    [[nodiscard]] Eigen::VectorXcd lifted(const Eigen::VectorXcd &reduced) const;

  private:
    struct Terms {
        Eigen::MatrixXd D, Ds, K, Ks;
    };
    const FormMatrices &_whole;
    std::vector<Eigen::MatrixXd> _shapes;
    int _planes;
    Eigen::MatrixXd _M;
    Terms _real, _imaginary;

    /// Left vector for a right one, in the mirror.
    [[nodiscard]] Eigen::VectorXcd mirrored(const Eigen::VectorXcd &right) const;
    [[nodiscard]] Terms projected(FormMatrices::Part part) const;
    [[nodiscard]] Eigen::MatrixXd projected(const FormMatrices::Sparse &A) const;
    /// Entries between the amplitudes of two planes.
    [[nodiscard]] Eigen::Block<Eigen::MatrixXd> between(Eigen::MatrixXd &A, Eigen::Index row,
                                                        Eigen::Index column) const;
    void add_few(const FormMatrices::Sparse &A, double factor, Eigen::MatrixXd &out) const;
    [[nodiscard]] DenseQuadratic<double> at(double speed, FormMatrices::Part part) const;
};

} // namespace whirl::modes
