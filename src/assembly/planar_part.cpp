#include "assembly/planar_part.h"

#include <span>
#include <vector>

namespace whirl::assembly {

namespace {

using PlanarEntries = std::vector<Eigen::Triplet<double>>;

PlanarEntries rotating_entries(const Discretization &discretization, Term wanted) {
    PlanarEntries entries;
    assemble_rotating_parts(discretization, [&](Term term, std::span<const int> unknowns,
                                                const Eigen::MatrixXd &block) {
        if (term != wanted)
            return;
        for_each_entry(unknowns, block,
                       [&](int i, int j, double v) { entries.emplace_back(i, j, v); });
    });
    return entries;
}

Eigen::SparseMatrix<double> sum_of(const PlanarEntries &entries, int size) {
    Eigen::SparseMatrix<double> out(size, size);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

} // namespace

Eigen::SparseMatrix<double> planar_part(const Discretization &discretization, Term term) {
    return sum_of(rotating_entries(discretization, term), discretization.planar_size());
}

PlanarPair planar_pair(const Discretization &discretization, double speed) {
    const auto matrix = [&](Term wanted) {
        PlanarEntries entries = rotating_entries(discretization, wanted);
        assemble_supports(discretization, speed,
                          [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                              if (term == wanted)
                                  entries.emplace_back(i, j, block.trace() / 2);
                          });
        return sum_of(entries, discretization.planar_size());
    };
    return {matrix(Term::mass), matrix(Term::gyroscopic), matrix(Term::stiffness)};
}

double polar_inertia(const Discretization &discretization) {
    const std::vector<double> tilt = discretization.rigid_motion(true);
    const Eigen::Map<const Eigen::VectorXd> r(tilt.data(), discretization.planar_size());
    return r.dot(planar_part(discretization, Term::gyroscopic) * r);
}

} // namespace whirl::assembly
