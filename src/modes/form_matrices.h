#pragma once

#include "assembly/discretization.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "balancers/linear_element.h"
#include "modes/biorthogonal.h"
#include "results/formulation.h"

#include <Eigen/SparseCore>

#include <optional>
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

    using Sparse = Eigen::SparseMatrix<double>;
    /// Entries of a block on (x, y) as the matrix has them.
    enum class Part { real, imaginary };
    /// Of l^2 M + l (D + s Ds) + K + s Ks at a speed s, forms of the fixed frame; bearing tables as
    /// at rest.
    struct Terms {
        const Sparse *D, *Ds, *K, *Ks;
    };
    [[nodiscard]] Terms terms(Part part) const {
        return part == Part::real ? Terms{&_D, &_Ds, &_K, &_Ks} : Terms{&_iD, &_iDs, &_iK, &_iKs};
    }
    /// What the bearings are at another speed less what they are at one.
    struct Supports {
        Sparse D, K, Ks;
    };
    [[nodiscard]] Supports support_change(double from, double to, Part part) const;
    /// Change of the supports with speed, towards lower and higher ones; none beyond the tables,
    /// where they are constant.
    struct SupportRates {
        std::optional<Supports> below, above;
    };
    [[nodiscard]] SupportRates support_rates(double speed, Part part) const;
    [[nodiscard]] const assembly::Discretization &discretization() const { return _discretization; }
    [[nodiscard]] results::Form form() const { return _form; }

    /// The mirror image in y -> -y of each matrix is its transpose, at every speed: so for bearings
    /// without coupling of the planes, or with kxy = -kyx.
    [[nodiscard]] bool mirrored() const { return _mirrored; }

    [[nodiscard]] const Eigen::SparseMatrix<double> &mass() const { return _M; }
    [[nodiscard]] int size() const { return static_cast<int>(_M.rows()); }

  private:
    const assembly::Discretization &_discretization;
    results::Form _form;
    bool _mirrored = true;
    Sparse _M, _D, _Ds, _K, _Ks, _Kss; ///< v^2 M + v (D + s Ds) + K + s Ks + s^2 Kss

    /// Form planar_damped: the imaginary parts of D, Ds, K, Ks; at() is then about the real ones.
    Sparse _iD, _iDs, _iK, _iKs;

    void set_general(const assembly::FixedSystem &system);
    void set_rotating(const assembly::RotatingSystem &system);
    void set_damped_planar();
    void add_tables(QuadraticAt &problem, double speed, Part part) const;
};

} // namespace whirl::modes
