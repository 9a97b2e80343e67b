#pragma once

#include "forced/forced_motion.h"
#include "linalg/complex_factors.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::forced {

/// Synchronous steady motion like ForcedMotion, of an elastic shaft, with the internal unknowns of
/// each element eliminated at each speed: exact, and the cost of a high order stays in the
/// elements. What is left is a chain of nodes.
///
/// The shaft is the same from every direction, so that two parts of the motion do not meet in it:
/// fixed frame, w = a exp(i Omega t) + conj(d) exp(-i Omega t), with
/// K - Omega^2 (M - G) on a and K + 2 i Omega C_i - Omega^2 (M + G) on d; rotating frame, where a
/// shaft of two stiffnesses stands still with the motion along and across its stiff axis.
class CondensedMotion {
  public:
    /// @param discretization  of an elastic shaft; must outlive this
    CondensedMotion(const assembly::Discretization &discretization, results::Form form);

    /// Solves under the forward synchronous imbalances of the rotor.
    /// @throws linalg::SolverError where the rotor is at an undamped resonance.
    void solve(double speed);

    /// Deflection of a node in the last solution, m.
    [[nodiscard]] Phasor at_node(int node) const;
    /// What a bearing is stretched by in the last solution, shaft against pedestal, m.
    [[nodiscard]] Phasor stretch(int bearing) const;
    /// Force of a bearing in the last solution, N.
    [[nodiscard]] Phasor bearing_force(int bearing) const;

  private:
    /// Elements that are equal but for their place: the spans [first, last].
    struct Group {
        int first = 0;
        int last = 0;
    };
    const assembly::Discretization &_discretization;
    bool _rotating;
    int _parts; ///< 1: a alone; 2: a and d, or u and conj(u) in the rotating frame
    std::vector<Group> _groups;
    linalg::BandMatrix _matrix;
    double _speed = 0;
    Eigen::VectorXcd _motion; ///< a node: w and L phi of the first part, of the second part

    [[nodiscard]] int unknown(int node, int part, bool slope) const;
    [[nodiscard]] Eigen::MatrixXcd element(int span) const;
    [[nodiscard]] Eigen::MatrixXcd rotating_element(int span, const Eigen::MatrixXd &forward,
                                                    const Eigen::MatrixXd &outside) const;
    void add_shaft();
    void add_discs();
    void add_anisotropies();
    void add_bearings();
    /// Coefficients of a bearing's film at the speed of the last solution, on (x, y).
    [[nodiscard]] Eigen::Matrix2cd film(const model::Bearing &bearing) const;
    /// Coefficients from (x, y) to the parts.
    [[nodiscard]] Eigen::Matrix2cd on_parts(const Eigen::Matrix2d &k,
                                            const Eigen::Matrix2d &c) const;
    void add_block(int node, bool slope, const Eigen::Matrix2cd &block);
    [[nodiscard]] Eigen::VectorXcd forces() const;
};

} // namespace whirl::forced
