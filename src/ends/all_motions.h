#pragma once

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "ends/refinement.h"
#include "ends/rotor_pieces.h"
#include "ends/spectrum.h"
#include "modes/form_matrices.h"
#include "results/formulation.h"
#include "stability/band_finder.h"

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::ends {

/// The motion that grows most of those of some |l|.
struct FastestGrowing {
    std::complex<double> value; ///< Im >= 0, 1/s; 0 where rounding hides the real part
    bool counted = true;        ///< of each of them it is known whether it grows
    /// Of those with |l| up to reach() that swing the one with the smallest logarithmic decrement,
    /// as the reduced rotor has it; 0: there is none.
    std::complex<double> least_damped = 0;
    double noise = 0; ///< of the value by rounding, where it is known, 1/s
};

/// All free motions of a rotor over a range of speeds, forms general and rotating: of the reduced
/// rotor, or of the whole rotor where it is small; single ones are refined on the whole rotor.
class AllMotions {
  public:
    /// @param shapes  good for the range (stability::BandFinder), or none: the whole rotor
    /// @param from,to  of the range, rad/s
    AllMotions(const assembly::Discretization &discretization, results::Form form,
               const balancers::Arrangement &arrangement,
               std::shared_ptr<const Eigen::MatrixXd> shapes, double from, double to);
    /// Of matrices that a parameter changes as the speed does those of the form general, over a
    /// range of it: of the order of the spin speed, and not below zero.
    /// @param discretization  bearings without tables
    AllMotions(const assembly::Discretization &discretization, modes::FormMatrices whole,
               std::shared_ptr<const Eigen::MatrixXd> shapes, double from, double to);
    /// Of the rotor of a finder, on shapes that it has or finds.
    /// @param finder  must outlive this
    /// @param speeds  ascending, over the range
    AllMotions(stability::BandFinder &finder, const std::vector<double> &speeds);
    AllMotions(const AllMotions &) = delete;
    AllMotions &operator=(const AllMotions &) = delete;

    [[nodiscard]] const RotorPieces &rotor() const { return _rotor; }
    /// Whether the motions are those of a reduced rotor, not of all unknowns.
    [[nodiscard]] bool reduced() const { return _shapes != nullptr; }
    /// Without those that rounding does not distinguish from infinitely fast ones. Of fast motions
    /// that can grow (above reach(), up to stability::growth_reach) rounding of the decomposition
    /// can hide the sign of the growth: without a reduction it is then found by inverse iteration.
    /// @param piece  of the range between table rows, which decides what the rates are at a row
    [[nodiscard]] Spectrum at(double speed, int piece) const;
    [[nodiscard]] Spectrum at(double speed) const { return at(speed, _rotor.piece_of(speed)); }

    /// A root as a motion of the whole rotor to begin with.
    [[nodiscard]] WholeMotion lifted(const Root &root, double speed) const;
    /// The motion of the whole rotor next to that; nothing where none is found.
    [[nodiscard]] std::optional<WholeMotion> of_whole(const WholeMotion &guess) const;
    /// The same at all speeds of the range, 1/s: twice its largest speed, so that all whirls up to
    /// that speed are among them in rotating axes too, and as much more as leaves at least eight
    /// and brings it between two motions that are far apart all over the range.
    [[nodiscard]] double reach() const;
    /// |l| up to reach(), which is found only where this does not go without it.
    [[nodiscard]] bool within_reach(double size) const {
        return size <= least_reach() || size <= reach();
    }
    /// Whether this root is fast, can grow, and is neutral within rounding.
    [[nodiscard]] bool hides_growth(const Root &root) const {
        const double size = std::abs(root.value);
        return root.sign() == 0 && size <= _growth_reach && !within_reach(size);
    }
    [[nodiscard]] const modes::FormMatrices &whole() const { return _whole; }

    /// Whether nothing damps or drives the rotor at a speed, but for rounding: with l every -l* is
    /// an eigenvalue, and what begins to grow other than at zero does so where two motions meet.
    [[nodiscard]] bool conserves(double speed) const;

    /// |l| up to which the motions that grow are counted as resolved, 1/s: infinite unless set.
    [[nodiscard]] double resolved_up_to() const { return _resolved; }
    /// Sets it from the mesh (resolved_reach.h) and the shapes. From then on fastest_growing()
    /// decides of every motion whether it grows, however fast it is.
    void count_resolved();
    /// The same without that: motions above this |l| (1/s) are not counted as resolved.
    void count_up_to(double size) { _resolved = size; }

    /// The eigenvalue of largest real part at a speed, as the whole rotor has it, of the motions
    /// with |l| up to reach() and of those that grow, however fast they are. The fastest motions of
    /// a mesh are no motions of the rotor: how little they are damped says nothing, but for rotors
    /// in which something drives all of them (count_resolved), up to what the elements resolve.
    /// @param above,up_to  |l| of the motions asked for, 1/s
    [[nodiscard]] FastestGrowing
    fastest_growing(double speed, double above = 0,
                    double up_to = std::numeric_limits<double>::infinity()) const;

    [[nodiscard]] const assembly::Discretization &discretization() const { return _discretization; }
    [[nodiscard]] results::Form form() const { return _form; }

    /// The smallest logarithmic decrement at that speed, -2 pi Re l / Im l of the whole rotor;
    /// none: no motion swings, or the one that does was not found. Form general alone: in axes that
    /// turn the same motion has another one.
    [[nodiscard]] std::optional<double> least_log_dec(double speed,
                                                      const FastestGrowing &found) const;

  private:
    const assembly::Discretization &_discretization;
    results::Form _form;
    std::shared_ptr<const Eigen::MatrixXd> _shapes;
    modes::FormMatrices _whole;
    RotorPieces _rotor;
    double _resolved = std::numeric_limits<double>::infinity();
    bool _drives_all = false; ///< something drives motions of every frequency
    double _growth_reach = 0; ///< stability::growth_reach where it is finite, rad/s
    double _slow = 0;         ///< of the order of the motions on the supports, 1/s
    double _from, _to;
    mutable std::optional<double> _reach; ///< once it was asked for
    int _zeros = 0;
    mutable modes::WholePencil<double> _pencil;
    struct WholeAt {
        double speed;
        modes::QuadraticAt problem;
    };
    mutable std::optional<WholeAt> _whole_at; ///< the last speed: several roots are asked for there
    mutable std::optional<Spectrum> _with_signs; ///< the last one

    [[nodiscard]] double least_reach() const;
    [[nodiscard]] double shift_at(double speed) const;
    /// As at(), as the decomposition has them.
    [[nodiscard]] Spectrum decomposed_at(double speed, int piece) const;
    /// As at(); of fast motions that rounding of the decomposition hides it is decided by the whole
    /// rotor, which knows each of them as sharply as the slow ones, whether they grow.
    [[nodiscard]] const Spectrum &with_signs_at(double speed) const;
    /// @param up_to  |l|, 1/s
    void find_signs(Spectrum &spectrum, double up_to) const;
    [[nodiscard]] bool is_rough() const;
    [[nodiscard]] bool decides_decay(double size) const;
    [[nodiscard]] std::optional<WholeMotion> of_whole(const Root &root, double speed) const;
    [[nodiscard]] std::optional<FastestGrowing> by_values(double speed, double above,
                                                          double up_to) const;
};

} // namespace whirl::ends
