#pragma once

#include "model/case.h"
#include "results/interval.h"
#include "results/level1.h"
#include "results/model_summary.h"
#include "results/steady_states.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// Largest rotating inertial anisotropy of one element that leaves every speed of the range stable.
struct PermissibleAnisotropy {
    double z = 0; ///< m
    std::string name;
    std::optional<double> dI;          ///< kg m2; none: stable up to `most`
    std::optional<double> closed_form; ///< of the rigid rotor, where one applies, kg m2
    double most = 0;     ///< that a body can have: half its polar inertia, its diametral one, kg m2
    bool of_disc = true; ///< the body is a disc at this place; else the whole rotor
};

/// What becomes of a small motion at one speed.
enum class Verdict {
    stable,   ///< every motion dies out
    neutral,  ///< some motion neither grows nor dies out (no damping), none grows
    unstable, ///< a whirl grows
    diverges, ///< what grows most does not swing in the axes of the form: a real root
    unknown   ///< no answer at this speed
};

/// "stable", "neutral", "unstable" or "diverges"; empty: no answer.
[[nodiscard]] std::string verdict_name(Verdict verdict);

/// What follows from the choice that n >= 3 balls have among their balanced positions.
struct ArrangementFamily {
    int arrangements = 0;           ///< sampled, the extreme ones among them
    bool incomplete = false;        ///< some critical or additional speeds could not be resolved
    std::vector<Interval> unstable; ///< with some arrangement, rad/s
    std::vector<Interval> always_unstable;   ///< with every one
    std::vector<Interval> critical_speeds;   ///< least and largest, rad/s
    std::vector<Interval> additional_speeds; ///< least and largest, rad/s
    /// Least and largest inertial anisotropy that each balancer adds, kg m2; NaN: not searched.
    std::vector<Interval> anisotropy;
};

/// Growth over two entries of the case.
struct StabilityMap {
    model::SweepAxis x, y;
    std::vector<std::vector<double>> growth; ///< [y][x], 1/s; NaN: no such rotor
    /// [y][x]: value, factor or shift of the entries of x and y, or the spin speed, rad/s; what was
    /// found for them where an axis is over a dimensionless number. NaN: nothing was.
    std::vector<std::vector<double>> x_changes, y_changes;
    std::string why; ///< of one point that is empty, what was wrong with it
};

/// How a motion begins or ceases to grow.
enum class EndKind {
    zero,      ///< a real root passes zero
    pair,      ///< a complex pair crosses the imaginary axis
    collision, ///< two undamped pairs meet on the axis and part
    multiplier ///< a Floquet multiplier passes the unit circle (form hill)
};

/// "zero", "pair", "collision" or "multiplier".
[[nodiscard]] std::string end_kind_name(EndKind kind);

/// A speed at which the number of growing motions changes. Eigenvalues with a positive real part
/// are counted, conjugates both.
struct StabilityEnd {
    double speed = 0;                         ///< rad/s
    std::optional<double> frequency_rotating; ///< |Im l| in rotating axes, rad/s; none: the motion
                                              ///< has no single one there
    std::optional<double> frequency; ///< |Im l| in the fixed axes, where the former is none
    std::string mode; ///< name of the mode that begins or ceases to grow; empty: not known
    EndKind kind = EndKind::pair;
    int growing_below = 0; ///< motions that grow just below this speed
    int growing_above = 0;
    /// Of what the elements resolve, where the result says up to which frequency that is.
    struct Resolved {
        bool motion = true;          ///< that which begins or ceases to grow
        int below = -1, above = -1;  ///< growing motions that are resolved; -1: not told apart
        std::optional<double> error; ///< of the speed, by finer elements, rad/s
    } resolved;
};

struct StabilityResult {
    ModelSummary model;
    std::vector<double> speeds; ///< rad/s
    /// Largest real part at each, 1/s; NaN: no answer, or none was found that grows, but not of
    /// all motions it is known whether they do.
    std::vector<double> growth;
    std::vector<Verdict> verdict; ///< at each speed
    /// The smallest logarithmic decrement of the motions that swing, of |l| up to the bound of
    /// `growth`, at each speed; NaN: not known. Empty where they are not looked at in fixed axes.
    std::vector<double> log_dec;
    std::vector<Interval> unstable; ///< rad/s, open intervals
    /// Error of both ends of each, rad/s (band_errors.h).
    std::vector<EndErrors> unstable_error;
    /// All speeds in the range at which the number of growing motions changes, ascending: ends of
    /// the unstable bands and changes inside of them.
    std::vector<StabilityEnd> ends;
    /// |l| up to which motions are counted at all speeds, 1/s (ends/resolved_reach.h), where
    /// something drives motions of every frequency; those that begin or cease to grow above it are
    /// `unresolved_ends`. None: all are counted.
    std::optional<double> resolved_up_to;
    std::vector<StabilityEnd> unresolved_ends; ///< counted with all motions of this mesh
    std::vector<double> resolved_growth;       ///< as growth, of the motions up to there; or empty
    std::vector<Verdict> resolved_verdict;     ///< as verdict, of these; or empty
    std::vector<Interval> resolved_unstable;   ///< as unstable, of these
    std::vector<EndErrors> resolved_unstable_error;
    /// As growth, of the motions above `resolved_up_to`, or empty. NaN: it is not known of all of
    /// them whether they grow, and none was found that does.
    std::vector<double> unresolved_growth;
    /// Forward critical speeds in the range, balls held in place and without damping, rad/s
    /// (rotating form): what critical lists.
    std::vector<double> critical_speeds;
    /// Speeds in the range at which an eigenvalue of the rotor as it is, in rotating axes, is zero:
    /// a motion stands still in the rotor and neither grows nor dies out, rad/s (rotating form).
    std::vector<double> zero_root_speeds;
    /// Speeds in the range at which a root is zero with the balls free and without damping: the
    /// rotor's critical speeds when it is pinned at the balancers, rad/s.
    std::vector<double> additional_speeds;
    /// The same with the damping of the case: real parts of complex roots; empty without damping.
    std::vector<double> additional_speeds_damped;
    std::vector<PermissibleAnisotropy> permissible;
    int neutral_pairs = 0; ///< pairs 0, -h of balls that move without changing the balance
    int harmonics = 0;     ///< of the Hill series
    /// Of a rotor with free balancers: the balanced position is that of all imbalances, elsewhere
    /// at every speed, not that of each balancer against its own.
    std::optional<bool> all_imbalances;
    std::vector<Interval> no_position; ///< rad/s, where they ask for one that there is not
    std::optional<ArrangementFamily> family;
    std::optional<StabilityMap> map;
    std::optional<Level1> level1;                     ///< where the case asks for it
    std::optional<SteadyStates> states;               ///< likewise
    model::BearingFit fit = model::BearingFit::given; ///< whose bearing tables these are of
    /// With [standard] clearances: the same, but for map and states, with the tables of each.
    std::vector<StabilityResult> clearances;
};

/// Largest growth at any speed, 1/s, of the motions that the elements resolve; NaN: not known.
[[nodiscard]] double largest_growth(const StabilityResult &result);
/// Unstable spin speeds of these motions, rad/s.
[[nodiscard]] const std::vector<Interval> &unstable_speeds(const StabilityResult &result);

/// Of a result and those with other clearances the one that is nearest to growing: unstable at
/// some speed, else of the smallest critical cross coupling where one is asked for, else of the
/// largest growth.
[[nodiscard]] const StabilityResult &least_stable(const StabilityResult &result);

} // namespace whirl::results
