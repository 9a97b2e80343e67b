#pragma once

#include "assembly/discretization.h"
#include "forced/bent_supports.h"
#include "forced/forced_motion.h"
#include "forced/quadratic_resolvent.h"
#include "reduction/planar_shapes.h"
#include "results/formulation.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <complex>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::forced {

/// A quantity at one speed, and what it changes per rad/s.
struct Reading {
    Phasor value;
    Phasor slope;
    /// Under the weight the size of the terms that the value is what is left of; else 0.
    double cancelled = 0;

    /// Semi-major axis of the ellipse, and what it changes per rad/s.
    [[nodiscard]] double major() const;
    [[nodiscard]] double major_slope() const;
};

/// Synchronous steady motion like ForcedMotion, on few planar shapes: those of the slow motions
/// (reduction/planar_shapes.h), what the imbalances bend at rest, and the motions of the whole
/// rotor at speeds taken in. At a speed taken in it is the motion of the whole rotor.
///
/// Between two rows of bearing tables (a piece) the equations are P(s) u = s^2 b with
/// P = P0 + s P1 + s^2 P2: the poles of the response are the roots of a small quadratic
/// eigenproblem. Of many rows along a curve a piece has several (BentSupports). Under the weight
/// P(s) u = b, and the quantities are the parts at twice the spin speed (rotating form). Under
/// forces of one frequency s is the place along their sweep, P(s) u = b (general form).
class ReducedMotion {
  public:
    /// @param discretization  must outlive this
    /// @param top             rad/s, the highest s asked for
    /// @param reduction       false: all there are, from the beginning
    ReducedMotion(const assembly::Discretization &discretization, results::Form form, double top,
                  std::vector<Quantity> quantities, Drive drive = {}, bool reduction = true);

    [[nodiscard]] bool whole() const { return _whole; } ///< by all shapes there are
    /// Shapes, in one plane.
    [[nodiscard]] int size() const { return static_cast<int>(_shapes->matrix().cols()); }

    /// Takes motions of the whole rotor into the shapes.
    /// @param motions  planar unknowns a column
    /// @param newness  part of a motion that must be new
    void take_in(const Eigen::MatrixXcd &motions, double newness);
    /// Some of these motions would be new.
    [[nodiscard]] bool lacks(const Eigen::MatrixXcd &motions, double newness) const;

    /// Speeds from `from` to `to` cut at the rows of bearing tables, rad/s.
    [[nodiscard]] std::vector<double> cuts(double from, double to) const;

    /// Goes to the piece that a speed (rad/s) lies in; poles() and at() are of that one.
    void enter_piece(double inside);
    /// All poles of the piece, rad/s.
    [[nodiscard]] std::vector<std::complex<double>> poles(double from, double to);
    /// Relative error of the motion at a speed of the piece that rounding of P may cause; large at
    /// resonances, and at slow speeds of rotors that are free to move.
    [[nodiscard]] double rounding(double speed) const;
    /// Every quantity at a speed of the piece.
    [[nodiscard]] std::vector<Reading> at(double speed) const;
    /// The same from the poles, which must have been asked for: next to one less exact than at().
    [[nodiscard]] std::vector<Reading> quickly_at(double speed) const;
    [[nodiscard]] Reading quickly_at(double speed, std::size_t quantity) const;

  private:
    struct Factors {
        double speed;
        Eigen::PartialPivLU<Eigen::MatrixXcd> P;
        Eigen::MatrixXcd slope; ///< dP/ds
    };
    struct Piece {
        double from = 0, to = 0;            ///< rad/s; equal: the bearings are constant
        QuadraticTerms P;                   ///< with straight lines between its ends
        std::unique_ptr<BentSupports> bent; ///< what the bearings are beside these; none: nothing
        std::unique_ptr<Factors> factors;   ///< of the last speed
        std::unique_ptr<QuadraticResolvent> resolvent; ///< of P; none before poles()
        std::vector<std::complex<double>> poles;
        std::optional<std::pair<double, QuadraticResolvent::Solution>> stretch; ///< last, by speed
        std::pair<double, double> resolved;                                     ///< where it is for
        std::map<double, std::vector<Reading>> readings; ///< at() by speed, so far
        std::map<double, double> roundings;
    };
    const assembly::Discretization &_discretization;
    results::Form _form;
    Drive _drive;
    std::vector<Quantity> _quantities;
    std::unique_ptr<reduction::PlanarShapes> _shapes;
    bool _whole = false;
    std::unique_ptr<ShapeTerms> _terms;
    std::vector<double> _rows; ///< of bearing tables: ends of the pieces, rad/s
    mutable std::optional<QuadraticTerms> _at_first_row; ///< of the tables, once asked for
    Eigen::MatrixXd _stretches;                          ///< a row a quantity, over the shapes
    /// What readings are made of, over the unknowns: of each quantity w, or x and y; under the
    /// weight the unknowns themselves, to see what cancels.
    Eigen::MatrixXd _read;
    std::map<int, Piece> _pieces; ///< seen so far, by their numbers
    Piece *_piece = nullptr;
    Eigen::MatrixXcd _b; ///< a column a load

    [[nodiscard]] QuadraticTerms terms(double bearing_speed) const;
    [[nodiscard]] const QuadraticResolvent &resolvent(double from, double to);
    [[nodiscard]] const Factors &factors(double speed) const;
    [[nodiscard]] Factors factors_at(double speed) const;
    [[nodiscard]] QuadraticResolvent::Solution quick(double speed, Eigen::Index first,
                                                     Eigen::Index count) const;
    void set_read();
    /// Numbers of a quantity among those that are read: the first and how many.
    [[nodiscard]] std::pair<Eigen::Index, Eigen::Index> read_of(std::size_t quantity) const;
    /// @param unit  of P u = b (imbalances have the force speed^2 b): the numbers of a quantity
    [[nodiscard]] Reading reading(std::size_t quantity, const QuadraticResolvent::Solution &unit,
                                  double speed) const;
    [[nodiscard]] std::vector<Reading> readings(const QuadraticResolvent::Solution &unit,
                                                double speed) const;
    [[nodiscard]] Piece piece_between(double from, double to) const;
    void make_shapes(double top, bool reduction);
    [[nodiscard]] Eigen::VectorXcd imbalances() const;
    [[nodiscard]] Eigen::VectorXcd weight() const;
    [[nodiscard]] Eigen::VectorXcd forces() const;
    [[nodiscard]] Eigen::MatrixXcd loads() const;
    /// What each of the loads is multiplied by at s, and what that changes per rad/s.
    [[nodiscard]] std::pair<Eigen::VectorXcd, Eigen::VectorXcd> factors_of_loads(double s) const;
    /// Deflection of a quantity's stretch that its numbers mean.
    [[nodiscard]] Phasor stretched(std::size_t quantity, const Eigen::VectorXcd &numbers) const;
};

} // namespace whirl::forced
