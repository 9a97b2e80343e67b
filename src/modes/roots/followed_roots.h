#pragma once

#include "modes/roots/reduced_form.h"
#include "modes/roots/roots.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::modes {

/// Guesses of the roots of a reduced rotor between speeds at which all of them are known: what lies
/// between those of both sides, where their vectors say which root becomes which.
template <class Scalar> class FollowedRoots {
  public:
    /// The roots of a speed, those wanted and some more; of a real problem with Im >= 0.
    struct All {
        std::vector<Root> roots;
        double reach = 0; ///< that of the motions wanted: all up to there must go on, 1/s
    };
    /// @param form  must outlive this
    /// @param all   at a speed
    FollowedRoots(const ReducedForm &form, std::function<All(double)> all);

    /// Of those that go on from the next speeds below and above at which all are known; more such
    /// speeds are taken where it is not clear which becomes which. Nothing where it stays unclear,
    /// and outside of these speeds.
    [[nodiscard]] std::optional<std::vector<Root>> at(double speed);

    /// All are solved for here.
    void add(double speed);

  private:
    struct Pair {
        std::size_t from, to;
        std::complex<double> scale; ///< of the right vector of the second, to be like the first
        std::complex<double> left_scale;
    };
    struct Step {
        bool clear = false;
        std::vector<Pair> pairs;
    };
    using Problem = DenseQuadratic<Scalar>;
    const ReducedForm &_form;
    std::function<All(double)> _all;
    std::map<double, All> _known;
    std::map<double, Step> _steps; ///< from these speeds to the next known
    double _range = 0;             ///< of the speeds added first

    [[nodiscard]] Step step(double from, double to) const;
};

extern template class FollowedRoots<double>;
extern template class FollowedRoots<std::complex<double>>;

} // namespace whirl::modes
