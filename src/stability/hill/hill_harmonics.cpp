#include "stability/hill/hill_harmonics.h"

#include "results/formulation.h"
#include "stability/hill/hill_motions.h"
#include "stability/motions.h"

#include <algorithm>
#include <cmath>

namespace whirl::stability {

HillSeries settled_series(const model::Rotor &rotor, int order,
                          const balancers::Arrangement &arrangement,
                          const std::vector<double> &speeds) {
    std::vector<double> moduli;
    for (const double speed : speeds)
        if (speed != 0)
            moduli.push_back(std::abs(speed));
    std::ranges::sort(moduli);
    if (moduli.empty())
        return {1, 0}; // at rest the terms of the series do not see each other
    const MotionSolver solver(rotor, results::Form::hill, order, arrangement, 1);
    for (std::size_t first = 0;;) {
        try {
            (void)solver.at(moduli[first]);
            return {solver.harmonics(), first == 0 ? 0 : moduli[first]};
        } catch (const model::AnalysisFailure &) {
            // A series that cannot even be solved at this speed is not enough either.
            if (moduli[first] == moduli.back())
                throw;
        }
        // The next rung: twice as fast.
        const double faster = 2 * moduli[first];
        while (first + 1 < moduli.size() && moduli[first] < faster)
            ++first;
    }
}

} // namespace whirl::stability
