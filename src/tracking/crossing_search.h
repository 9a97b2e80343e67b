#pragma once

#include "tracking/bands/locked_whirl.h"
#include "tracking/crossing_nodes.h"
#include "tracking/crossing_step.h"
#include "tracking/crossings.h"

#include <optional>
#include <utility>
#include <vector>

namespace whirl::tracking {

/// -1, 0 or 1: a mode's frequency is below a multiple of the spin speed, on it, or above.
[[nodiscard]] int side_of(const modes::WhirlMode &mode, double speed, double multiple);

/// The mode stands still in the rotor, and so on this multiple, the spin speed itself.
[[nodiscard]] bool locked_to_rotor(results::Form form, const modes::WhirlMode &mode, double speed,
                                   double multiple);

/// Distance of a mode of a spectrum from a multiple of the spin speed.
/// @param rates  of its modes, towards lower or higher speeds
[[nodiscard]] StepEnd end_of(const modes::Spectrum &spectrum, const Eigen::VectorXcd &rates,
                             std::size_t place, double multiple);

/// Crossings of all lines with one multiple.
class CrossingSearch {
  public:
    CrossingSearch(const modes::SpectrumSolver &solver, double multiple, Crossings &out)
        : _solver(solver), _multiple(multiple), _out(out) {}

    /// A node given by the sweep: roots that lie on it.
    void visit(const Node &node);

    void search(const Node &a, const Node &b, const std::vector<Link> &links, int depth = 0);

    /// A root, unless it is known.
    /// @param margin  how far off it may be found, rad/s
    void take(int line, double speed, double real, double margin = 0);

    /// For the line of the motion that leaves the band there, between two nodes.
    void take_lock_end(const LockEnd &end, const Node &a, const Node &b);
    void take_lock_end(const LockEnd &end, int line);

    /// A line that is there at one node and real at the other.
    void follow_to_zero(Node there, Node gone, int line);

    /// Ends of bands of locked motion met so far, in any order.
    [[nodiscard]] const std::vector<BandEnd> &band_ends() const { return _ends; }

  private:
    const modes::SpectrumSolver &_solver;
    double _multiple;
    Crossings &_out;
    std::vector<BandEnd> _ends;
    std::vector<std::pair<double, double>> _tried; ///< parts searched for ends, rad/s

    [[nodiscard]] int leaving_line(const Node &a, const Node &b) const;
    [[nodiscard]] int slowest_line(const Node &node, bool or_stands) const;
    void find_lock_ends(const Node &a, const Node &b, int line);
    [[nodiscard]] StepEnd end(const Node &node, std::size_t place, bool towards_higher) const;
    [[nodiscard]] bool held(const Node &node, std::size_t place) const;
    [[nodiscard]] bool upper_whirl(const Node &node, std::size_t place) const;
    void take_if_root(const Node &node, std::size_t place);
    [[nodiscard]] std::optional<double> next_speed(const Node &a, const Node &b, const Link &link,
                                                   int depth);
    void settle_short(const Node &a, const Node &b, const Link &link, const StepEnd &from,
                      const StepEnd &to);
    void split(const Node &a, const Node &b, const std::vector<Link> &links, double speed,
               int depth);
};

} // namespace whirl::tracking
