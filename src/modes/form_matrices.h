#pragma once

#include "assembly/discretization.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "balancers/linear_element.h"
#include "modes/biorthogonal.h"
#include "results/formulation.h"

#include <Eigen/SparseCore>

#include <vector>

namespace whirl::modes {

/// The matrices of the eigenproblem of a form, at any speed, from one assembly: bearing tables add
/// the change of the bearings alone.
class FormMatrices {
  public:
    /// @param balancers  at their balanced positions; rotating forms alone have them
    FormMatrices(const assembly::Discretization &discretization, results::Form form,
                 const std::vector<balancers::BalancerElement> &balancers);

    /// Form general, of matrices made from those of a rotor whose bearings do not change with
    /// speed.
    FormMatrices(const assembly::Discretization &discretization,
                 const assembly::FixedSystem &system);
    /// The same, form rotating.
    FormMatrices(const assembly::Discretization &discretization,
                 const assembly::RotatingSystem &system);

    /// Form hill: without the part of the bearings that turns.
    [[nodiscard]] QuadraticAt at(double speed) const;

    /// Form planar_damped.
    [[nodiscard]] ComplexQuadraticAt complex_at(double speed) const;

    /// The mirror image in y -> -y of each matrix is its transpose, at every speed: so for bearings
    /// without coupling of the planes, or with kxy = -kyx.
    [[nodiscard]] bool mirrored() const { return _mirrored; }

    [[nodiscard]] const Eigen::SparseMatrix<double> &mass() const { return _M; }
    [[nodiscard]] int size() const { return static_cast<int>(_M.rows()); }

  private:
    using Sparse = Eigen::SparseMatrix<double>;
    const assembly::Discretization &_discretization;
    results::Form _form;
    bool _mirrored = true;
    Sparse _M, _D, _Ds, _K, _Ks, _Kss; ///< v^2 M + v (D + s Ds) + K + s Ks + s^2 Kss

    /// Form planar_damped: the imaginary parts of D, Ds, K, Ks; at() is then about the real ones.
    Sparse _iD, _iDs, _iK, _iKs;

    struct Supports {
        Sparse D, K, Ks;
    };
    /// Entries of a block on (x, y) as the matrix has them.
    enum class Part { real, imaginary };
    void set_general(const assembly::FixedSystem &system);
    void set_rotating(const assembly::RotatingSystem &system);
    void set_damped_planar();
    void add_tables(QuadraticAt &problem, double speed, Part part) const;
    [[nodiscard]] Supports support_change(double from, double to, Part part) const;
};

} // namespace whirl::modes
