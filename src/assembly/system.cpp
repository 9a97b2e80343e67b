#include "assembly/system.h"

#include <map>

namespace whirl::assembly {

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;
using TermEntries = std::map<Term, Entries>;

/// Same block in both planes, or coupling them with the sign of `across` in the lower half.
void add_real(Entries &entries, int i, int j, double value, bool couples, double across) {
    if (!couples) {
        entries.emplace_back(2 * i, 2 * j, value);
        entries.emplace_back(2 * i + 1, 2 * j + 1, value);
    } else {
        entries.emplace_back(2 * i, 2 * j + 1, value);
        entries.emplace_back(2 * i + 1, 2 * j, across * value);
    }
}

/// Over the unknowns of one plane: [a b; -b a] of a bearing on (x, y) is a - i b on x + i y. Of
/// other blocks the mean over the directions.
struct PlanarTerms {
    TermEntries real, imaginary;
};

PlanarTerms planar_terms(const Discretization &discretization, double speed) {
    PlanarTerms out;
    assemble_rotating_parts(discretization, [&](Term term, std::span<const int> unknowns,
                                                const Eigen::MatrixXd &block) {
        for_each_entry(unknowns, block,
                       [&](int i, int j, double v) { out.real[term].emplace_back(i, j, v); });
    });
    assemble_supports(discretization, speed,
                      [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                          out.real[term].emplace_back(i, j, block.trace() / 2);
                          if (block(0, 1) != 0)
                              out.imaginary[term].emplace_back(i, j, -block(0, 1));
                      });
    return out;
}

} // namespace

PlanarSystem assemble_planar(const Discretization &discretization, double speed) {
    TermEntries terms = planar_terms(discretization, speed).real;
    const int n = discretization.planar_size();
    return {linalg::Matrix::from_entries(n, terms[Term::mass]),
            linalg::Matrix::from_entries(n, terms[Term::gyroscopic]),
            linalg::Matrix::from_entries(n, terms[Term::stiffness])};
}

DampedPlanarSystem assemble_damped_planar(const Discretization &discretization, double speed) {
    auto [terms, across] = planar_terms(discretization, speed);
    const int n = discretization.planar_size();
    const auto matrix = [n](TermEntries &from, Term term) {
        return linalg::Matrix::from_entries(n, from[term]);
    };
    return {matrix(terms, Term::mass),       matrix(terms, Term::damping),
            matrix(across, Term::damping),   matrix(terms, Term::gyroscopic),
            matrix(terms, Term::stiffness),  matrix(across, Term::stiffness),
            matrix(terms, Term::circulatory)};
}

FixedSystem assemble_fixed(const Discretization &discretization, double speed) {
    TermEntries terms;
    assemble_rotating_parts(discretization, [&](Term term, std::span<const int> unknowns,
                                                const Eigen::MatrixXd &block) {
        const bool couples = term == Term::gyroscopic || term == Term::circulatory;
        for_each_entry(unknowns, block, [&](int i, int j, double v) {
            add_real(terms[term], i, j, v, couples, -1);
        });
    });
    assemble_supports(discretization, speed,
                      [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                          for (int a = 0; a < 2; ++a)
                              for (int b = 0; b < 2; ++b)
                                  if (block(a, b) != 0)
                                      terms[term].emplace_back(2 * i + a, 2 * j + b, block(a, b));
                      });
    const int n = 2 * discretization.planar_size();
    const auto matrix = [&](Term term) { return linalg::Matrix::from_entries(n, terms[term]); };
    return {matrix(Term::mass), matrix(Term::damping), matrix(Term::gyroscopic),
            matrix(Term::stiffness), matrix(Term::circulatory)};
}

linalg::Matrix hyperbolic_coupling(const Discretization &discretization) {
    Entries entries;
    assemble_rotating_parts(discretization, [&](Term term, std::span<const int> unknowns,
                                                const Eigen::MatrixXd &block) {
        if (term == Term::gyroscopic)
            for_each_entry(unknowns, block,
                           [&](int i, int j, double v) { add_real(entries, i, j, v, true, 1); });
    });
    return linalg::Matrix::from_entries(2 * discretization.planar_size(), entries);
}

} // namespace whirl::assembly
