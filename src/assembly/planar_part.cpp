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
        for (std::size_t i = 0; i < unknowns.size(); ++i)
            for (std::size_t j = 0; j < unknowns.size(); ++j)
                entries.emplace_back(
                    unknowns[i], unknowns[j],
                    block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
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

Eigen::SparseMatrix<double> planar_matrix(const Discretization &discretization, Term wanted,
                                          double speed) {
    PlanarEntries entries = rotating_entries(discretization, wanted);
    assemble_supports(discretization, speed,
                      [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                          if (term == wanted)
                              entries.emplace_back(i, j, block.trace() / 2);
                      });
    return sum_of(entries, discretization.planar_size());
}

double polar_inertia(const Discretization &discretization) {
    const std::vector<double> tilt = discretization.rigid_motion(true);
    const Eigen::Map<const Eigen::VectorXd> r(tilt.data(), discretization.planar_size());
    return r.dot(planar_part(discretization, Term::gyroscopic) * r);
}

} // namespace whirl::assembly
