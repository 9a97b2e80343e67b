#include "reduction/planar_pair.h"

#include "assembly/assemble.h"

#include <map>
#include <vector>

namespace whirl::reduction {

using assembly::Term;

PlanarPair planar_pair(const assembly::Discretization &d, double speed) {
    std::map<Term, std::vector<Eigen::Triplet<double>>> entries;
    assembly::assemble_rotating_parts(
        d, [&](Term term, std::span<const int> unknowns, const Eigen::MatrixXd &block) {
            for (Eigen::Index i = 0; i < block.rows(); ++i)
                for (Eigen::Index j = 0; j < block.cols(); ++j)
                    entries[term].emplace_back(unknowns[static_cast<std::size_t>(i)],
                                               unknowns[static_cast<std::size_t>(j)], block(i, j));
        });
    assembly::assemble_supports(d, speed,
                                [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                                    entries[term].emplace_back(i, j, block.trace() / 2);
                                });
    const auto matrix = [&](Term term) {
        Eigen::SparseMatrix<double> out(d.planar_size(), d.planar_size());
        out.setFromTriplets(entries[term].begin(), entries[term].end());
        return out;
    };
    return {matrix(Term::mass), matrix(Term::gyroscopic), matrix(Term::stiffness)};
}

} // namespace whirl::reduction
