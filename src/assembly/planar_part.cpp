#include "assembly/planar_part.h"

#include <span>
#include <vector>

namespace whirl::assembly {

Eigen::SparseMatrix<double> planar_part(const Discretization &discretization, Term wanted) {
    std::vector<Eigen::Triplet<double>> entries;
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
    Eigen::SparseMatrix<double> out(discretization.planar_size(), discretization.planar_size());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

} // namespace whirl::assembly
