#include "synchronous/critical_speeds.h"

#include "assembly/planes.h"
#include "modes/orbits.h"
#include "modes/solver/degenerate.h"
#include "results/formulation.h"
#include "results/whirl.h"
#include "synchronous/followed.h"
#include "synchronous/general.h"
#include "synchronous/parts.h"
#include "synchronous/symmetric.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace whirl::synchronous {

namespace {

using assembly::Discretization;

modes::WhirlMode mode_of(const linalg::RealPair &pair, results::Form form) {
    modes::WhirlMode mode;
    mode.eigenvalue = {0, pair.value};
    const Eigen::VectorXd &x = pair.vector;
    mode.shape = x.cast<std::complex<double>>();
    if (form == results::Form::general) // (Re, Im)
        mode.shape = x.head(x.size() / 2) + std::complex<double>(0, 1) * x.tail(x.size() / 2);
    mode.residual = pair.residual;
    mode.rounding = pair.rounding;
    return mode;
}

void set_sense(const Discretization &d, bool hyperbolic, std::vector<modes::WhirlMode> &modes) {
    const modes::Stations stations = modes::Stations::for_orbits(d);
    const std::complex<double> factor = hyperbolic ? std::complex<double>(0, 1) : 1;
    const auto deflections = [&](const modes::WhirlMode &mode) {
        const assembly::Planes planes(mode.shape);
        return std::pair(stations.deflections(planes.x),
                         Eigen::VectorXcd(factor * stations.deflections(planes.y)));
    };
    modes::separate_degenerate(deflections, stations, hyperbolic, modes);
    for (modes::WhirlMode &mode : modes) {
        const auto [x, y] = deflections(mode);
        const modes::OrbitSense sense = modes::orbit_sense(x, y, stations, 1);
        mode.whirl = sense.whirl;
        mode.forward_fraction = sense.forward_fraction;
    }
}

void set_forward(std::vector<modes::WhirlMode> &modes, bool forward) {
    for (modes::WhirlMode &mode : modes) {
        mode.whirl = forward ? results::Whirl::forward : results::Whirl::backward;
        mode.forward_fraction = forward ? 1 : 0;
    }
}

void name_whirl(const Discretization &d, results::Form form, std::vector<modes::WhirlMode> &modes) {
    if (form == results::Form::rotating)
        set_forward(modes, true);
    else
        set_sense(d, form == results::Form::hyperbolic, modes);
}

/// @param list  with a branch each
void sort_ascending(SynchronousModes &list) {
    std::vector<std::size_t> order(list.modes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {},
                             [&](std::size_t i) { return list.modes[i].eigenvalue.imag(); });
    SynchronousModes sorted;
    for (const std::size_t i : order) {
        sorted.modes.push_back(list.modes[i]);
        sorted.branches.push_back(list.branches[i]);
    }
    list.modes = std::move(sorted.modes);
    list.branches = std::move(sorted.branches);
}

/// Roots of the symmetric problems of a form: forward and backward ones, or one for both.
template <class Roots>
SynchronousModes of_symmetric(const Discretization &d, results::Form form, Roots &&roots) {
    SynchronousModes out;
    out.complete_to = std::numeric_limits<double>::infinity();
    for (const int sign : {1, -1}) {
        if (sign < 0 && form != results::Form::planar)
            break;
        const SynchronousRoots found = roots(SymmetricSynchronous(d, form, sign));
        std::vector<modes::WhirlMode> modes;
        for (const SynchronousRoot &root : found.roots) {
            modes.push_back(mode_of(root.pair, form));
            out.branches.push_back(root.branch);
        }
        if (form == results::Form::planar)
            set_forward(modes, sign > 0);
        else
            name_whirl(d, form, modes);
        out.modes.insert(out.modes.end(), modes.begin(), modes.end());
        out.complete_to = std::min(out.complete_to, found.complete_to);
        if (!found.counted)
            out.doubtful.emplace_back(0.0, found.complete_to);
    }
    sort_ascending(out);
    return out;
}

} // namespace

std::vector<modes::WhirlMode> synchronous_modes(const Discretization &d, results::Form form,
                                                double bearing_speed, int wanted) {
    if (SymmetricSynchronous::exists(d, form))
        return of_symmetric(d, form,
                            [&](const SymmetricSynchronous &problem) {
                                return problem.at_bearing_speed(bearing_speed, wanted);
                            })
            .modes;
    std::vector<modes::WhirlMode> modes =
        GeneralSynchronous(d, form).lowest(bearing_speed, wanted, 0).modes;
    name_whirl(d, form, modes);
    return modes;
}

SynchronousModes all_synchronous_modes(const Discretization &d, results::Form form, int wanted,
                                       double top, bool symmetric) {
    const bool real_form = form == results::Form::planar || form == results::Form::hyperbolic;
    if (real_form || (symmetric && SymmetricSynchronous::exists(d, form)))
        return of_symmetric(d, form, [&](const SymmetricSynchronous &problem) {
            return problem.lowest(wanted, top);
        });
    SynchronousModes out = table_speeds(d.rotor()).empty()
                               ? GeneralSynchronous(d, form).lowest(0, wanted, top)
                               : followed_modes(d, form, wanted, top);
    name_whirl(d, form, out.modes);
    return out;
}

} // namespace whirl::synchronous
