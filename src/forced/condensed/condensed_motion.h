#pragma once

#include "elements/planar_matrices.h"
#include "forced/forced_motion.h"
#include "linalg/dense/band_matrix.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <map>
#include <vector>

namespace whirl::forced {

/// Synchronous steady motion like ForcedMotion, of an elastic shaft, with the internal unknowns of
/// each element eliminated at each speed: exact, and the cost of a high order stays in the
/// elements. What is left is a chain of nodes. Of these the ones that nothing is attached to are
/// eliminated too: n equal elements in a row are joined two by two, log2 n times, so that a fine
/// mesh costs hardly more than a coarse one.
///
/// The shaft is the same from every direction, so that two parts of the motion do not meet in it:
/// fixed frame, w = a exp(i Omega t) + conj(d) exp(-i Omega t), with
/// K - Omega^2 (M - G) on a and K + 2 i Omega C_i - Omega^2 (M + G) on d; rotating frame, where a
/// shaft of two stiffnesses stands still with the motion along and across its stiff axis.
class CondensedMotion {
  public:
    /// @param discretization  of a shaft that can be described so; must outlive this
    CondensedMotion(const assembly::Discretization &discretization, results::Form form);

    /// Nothing acts across its elements, and they bend.
    [[nodiscard]] static bool describes(const assembly::Discretization &discretization);

    /// Solves under the forward synchronous imbalances of the rotor.
    /// @throws linalg::SolverError where the rotor is at an undamped resonance.
    void solve(double speed);

    /// Deflection of a node that stays, in the last solution, m.
    [[nodiscard]] Phasor at_node(int node) const;
    /// What a bearing is stretched by in the last solution, shaft against pedestal, m.
    [[nodiscard]] Phasor stretch(int bearing) const;
    /// Force of a bearing in the last solution, N.
    [[nodiscard]] Phasor bearing_force(int bearing) const;
    /// Relative error of the last solution by rounding of the entries of the elements, and of what
    /// is eliminated.
    [[nodiscard]] double rounding() const;

  private:
    /// Equal elements in a row between two nodes that stay, the first of a group of stretches with
    /// elements all alike.
    struct Stretch {
        int first = 0; ///< span
        int count = 1;
        bool like_last = false;
    };
    /// Dynamic stiffness, and what its entries add up to before they cancel.
    struct Block {
        Eigen::MatrixXcd values;
        Eigen::MatrixXd sizes;
    };
    const assembly::Discretization &_discretization;
    bool _rotating;
    int _parts;                 ///< 1: a alone; 2: a and d, or u and conj(u) in the rotating frame
    std::map<int, int> _places; ///< of the nodes that stay, among themselves
    std::vector<Stretch> _stretches;
    std::map<int, elements::PlanarMatrices> _beams; ///< by span, of elements unlike the last
    linalg::BandMatrix _matrix;
    Eigen::MatrixXd _sizes; ///< of the matrix, by row and distance from the diagonal
    double _speed = 0;
    Eigen::VectorXcd _forces;
    Eigen::VectorXcd _motion; ///< a node: w and L phi of the first part, of the second part

    void find_stretches();
    [[nodiscard]] int unknown(int node, int part, bool slope) const;
    void add(int row, int column, std::complex<double> value, double size);
    [[nodiscard]] Block in_a_row(const Block &element, int count) const;
    [[nodiscard]] Block element(int span) const;
    [[nodiscard]] Eigen::MatrixXcd values_of(int span) const;
    [[nodiscard]] Eigen::MatrixXcd rotating_values(int span, const Eigen::MatrixXd &forward,
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
