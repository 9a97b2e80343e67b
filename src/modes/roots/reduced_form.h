#pragma once

#include "modes/form_matrices.h"
#include "modes/roots/roots.h"

#include <Eigen/Core>

#include <complex>

namespace whirl::modes {

/// A rotor in a form of the fixed frame on planar shapes, the same for both planes, at any speed:
/// every term is projected once, of bearing tables their few entries at each speed.
class ReducedForm {
  public:
    /// @param whole   must outlive this
    /// @param shapes  N x r planar shapes; empty: all unknowns
    ReducedForm(const FormMatrices &whole, Eigen::MatrixXd shapes);

    /// Form planar_damped: complex; form general: real. Without rates.
    template <class Scalar> [[nodiscard]] DenseQuadratic<Scalar> at(double speed) const;

    [[nodiscard]] bool is_whole() const { return _shapes.size() == 0; }
    /// Amplitudes of the shapes as unknowns of the whole rotor.
    [[nodiscard]] Eigen::VectorXcd lifted(const Eigen::VectorXcd &reduced) const;

  private:
    struct Terms {
        Eigen::MatrixXd D, Ds, K, Ks;
    };
    const FormMatrices &_whole;
    Eigen::MatrixXd _shapes;
    int _planes;
    Eigen::MatrixXd _M;
    Terms _real, _imaginary;

    [[nodiscard]] Terms projected(FormMatrices::Part part) const;
    [[nodiscard]] Eigen::MatrixXd projected(const FormMatrices::Sparse &A) const;
    void add_few(const FormMatrices::Sparse &A, double factor, Eigen::MatrixXd &out) const;
    [[nodiscard]] DenseQuadratic<double> at(double speed, FormMatrices::Part part) const;
};

} // namespace whirl::modes
