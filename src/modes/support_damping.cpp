#include "modes/support_damping.h"

#include "assembly/assemble.h"

namespace whirl::modes {

std::vector<Eigen::Triplet<double>>
planar_support_damping(const assembly::Discretization &discretization, double speed) {
    std::vector<Eigen::Triplet<double>> entries;
    assembly::assemble_supports(
        discretization, speed,
        [&entries](assembly::Term term, int i, int j, const Eigen::Matrix2d &block) {
            if (term == assembly::Term::damping)
                entries.emplace_back(i, j, block(0, 0));
        });
    return entries;
}

} // namespace whirl::modes
