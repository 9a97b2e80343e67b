#include "assembly/planar_part.h"

#include "assembly/system.h"

#include <span>
#include <vector>

namespace whirl::assembly {

Eigen::SparseMatrix<double> planar_part(const Discretization &discretization, Term term) {
    std::vector<Eigen::Triplet<double>> entries;
    assemble_rotating_parts(discretization, [&](Term other, std::span<const int> unknowns,
                                                const Eigen::MatrixXd &block) {
        if (other == term)
            for_each_entry(unknowns, block,
                           [&](int i, int j, double v) { entries.emplace_back(i, j, v); });
    });
    Eigen::SparseMatrix<double> out(discretization.planar_size(), discretization.planar_size());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

PlanarPair planar_pair(const Discretization &discretization, double speed) {
    const PlanarSystem system = assemble_planar(discretization, speed);
    return {system.M.view(), system.G.view(), system.K.view()};
}

double polar_inertia(const Discretization &discretization) {
    const Eigen::VectorXd tilt = discretization.rigid_motion(true);
    return tilt.dot(planar_part(discretization, Term::gyroscopic) * tilt);
}

} // namespace whirl::assembly
