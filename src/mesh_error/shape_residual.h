#pragma once

#include "assembly/discretization.h"
#include "modes/whirl_mode.h"
#include "results/formulation.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <vector>

namespace whirl::mesh_error {

/// How far a mode is from solving the equation of the shaft between the nodes: the energy of its
/// residual in the internal functions of the next two orders, each element on its own, over the
/// kinetic energy of the mode. It follows the discretisation error from speed to speed up to a
/// slowly varying factor (it is the first term of that error where the further functions are
/// orthogonal to the others), at a small part of the cost of a finer model.
class ShapeResidual {
  public:
    /// @param discretization  kept by reference
    ShapeResidual(const assembly::Discretization &discretization, results::Form form);

    /// A mode at a spin speed (rad/s).
    struct At {
        const modes::WhirlMode *mode;
        double speed;
    };
    /// Of each; 0 for a rigid shaft.
    [[nodiscard]] std::vector<double> of(const std::vector<At> &modes) const;

  private:
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    /// The further functions of one element among themselves.
    struct Element {
        Eigen::MatrixXd M2, G2, K2;
        bool like_last = false; ///< the same matrices as the element before
    };
    const assembly::Discretization &_discretization;
    results::Form _form;
    int _further = 0; ///< functions of an element
    std::vector<Element> _elements;
    Rows _M, _G, _K; ///< further functions of all elements over the unknowns of a plane
    Rows _mass;

    /// A plane of a mode, w(t) = w exp(rate t), at a spin speed.
    struct Plane {
        Eigen::VectorXcd w;
        std::complex<double> rate;
        double speed = 0;
    };
    [[nodiscard]] std::vector<assembly::Combination> own_motion(int span) const;
    /// One in the planar forms, of the others those of x + i y and of x - i y.
    [[nodiscard]] std::vector<Plane> planes_of(const At &mode) const;
    /// Adds both energies of the plane.
    void add_energies(const Plane &plane, double &residual, double &kinetic) const;
};

} // namespace whirl::mesh_error
