#pragma once

#include "modes/spectrum.h"

#include <vector>

namespace whirl::tracking {

/// A spectrum with the left and right vectors of its modes.
struct Snapshot {
    modes::Spectrum spectrum;
    modes::ModeBasis basis;
};

/// Why a mode of one speed has no continuation at another.
enum class Absence {
    none,
    overdamped, ///< its eigenvalue became real, negative
    divergent,  ///< real, positive
    beyond,     ///< it lies beyond the computed modes there
    lost        ///< it could not be followed
};

/// Modes of one speed paired with those of another.
struct Matching {
    static constexpr int none = -1; ///< no place in a list
    std::vector<int> to;            ///< place of the continuation, or `none`
    std::vector<int> from;          ///< the same seen from the other speed
    bool ambiguous = false;
    /// That is so for no more than modes which end or begin on the real axis in between.
    bool but_for_ends = false;
};

/// Pairs in descending order of overlap. It is ambiguous where one of the `important` lowest modes
/// of either speed has no sure partner.
[[nodiscard]] Matching match_by_vectors(const Snapshot &a, const Snapshot &b, int important);

/// Whether two of the `important` lowest modes change places in frequency between the speeds while
/// a part of each goes over into the other: they may veer instead of crossing, within a part of the
/// step that the overlaps step over. Not asked in rotating axes, where lines stay on each other.
/// @param planar  modes of opposite whirl are of opposite frequencies and never meet
[[nodiscard]] bool may_veer(const Snapshot &a, const Snapshot &b, const Matching &matching,
                            int important, bool planar);

/// Whether a heavily damped mode may turn real between the speeds and whirl again, or another one
/// in its place: (Im l)^2, which goes through zero there as a smooth function, comes down to it by
/// its values and slopes.
[[nodiscard]] bool may_turn_real(const Snapshot &a, const Snapshot &b, const Matching &matching);

/// What is left unsure is settled within groups of modes that span one space at both speeds (modes
/// that come close mix): by continuity of eigenvalues and their slopes.
[[nodiscard]] Matching match_by_groups(const Snapshot &a, const Snapshot &b);

/// In a Hill series motions that resonate exchange their larger parts: of the same two motions one
/// is seen from the fixed frame to whirl forward and one backward on both sides, but not the same
/// one. There the lines go on, and not the motions.
void keep_larger_parts(const Snapshot &a, const Snapshot &b, std::vector<int> &to);

/// What became of a mode that has no continuation in the other spectrum nearby.
[[nodiscard]] Absence fate(const modes::Spectrum &here, int place, const modes::Spectrum &there);

} // namespace whirl::tracking
