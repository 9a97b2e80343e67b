#include "assembly/planar_mass.h"

#include "assembly/assemble.h"

#include <vector>

namespace whirl::assembly {

Eigen::SparseMatrix<double> planar_mass(const Discretization &discretization) {
    std::vector<Eigen::Triplet<double>> entries;
    assemble_rotating_parts(discretization, [&](Term term, std::span<const int> unknowns,
                                                const Eigen::MatrixXd &block) {
        if (term != Term::mass)
            return;
        for (std::size_t i = 0; i < unknowns.size(); ++i)
            for (std::size_t j = 0; j < unknowns.size(); ++j)
                entries.emplace_back(
                    unknowns[i], unknowns[j],
                    block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    });
    Eigen::SparseMatrix<double> M(discretization.planar_size(), discretization.planar_size());
    M.setFromTriplets(entries.begin(), entries.end());
    return M;
}

} // namespace whirl::assembly
