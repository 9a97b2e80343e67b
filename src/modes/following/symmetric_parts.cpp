// Matrices of a SymmetricProblem, real and symmetric.

#include "assembly/system.h"
#include "modes/following/symmetric_problem.h"

#include <array>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

using RealSparse = SymmetricProblem::Sparse;

/// The part of a real matrix on pairs (x, y) that stays within a plane, or that couples them, in
/// p = (x + y') / sqrt(2) and q = (x - y') / sqrt(2): with y = i y' and the rows of y times -i the
/// second becomes i times a symmetric matrix. What is the same in both planes, and gyroscopic
/// terms, then leave p and q (motions backward and forward) apart, which only unequal supports
/// couple.
struct PlanePair {
    RealSparse within, across;
};

std::optional<PlanePair> planes_of(const linalg::Matrix &matrix) {
    const RealSparse A = matrix.view();
    std::array<std::vector<Eigen::Triplet<double>>, 2> entries; // within, across
    for (int column = 0; column < A.cols(); ++column)
        for (RealSparse::InnerIterator entry(A, column); entry; ++entry) {
            const auto p = static_cast<int>(entry.row() / 2 * 2);
            const int q = column / 2 * 2;
            const bool of_y = entry.row() % 2 != 0;
            const bool across = of_y != (column % 2 != 0);
            // Even and odd where x and y are exchanged in both.
            const double even = (across && of_y ? -0.5 : 0.5) * entry.value();
            const double odd = (!across && of_y ? -0.5 : 0.5) * entry.value();
            auto &out = entries[across ? 1 : 0];
            out.emplace_back(p, q, even);
            out.emplace_back(p + 1, q + 1, across ? -even : even);
            out.emplace_back(p, q + 1, across ? -odd : odd);
            out.emplace_back(p + 1, q, odd);
        }
    PlanePair out{RealSparse(A.rows(), A.cols()), RealSparse(A.rows(), A.cols())};
    for (const auto &[part, of] :
         {std::pair(&out.within, &entries[0]), std::pair(&out.across, &entries[1])}) {
        part->setFromTriplets(of->begin(), of->end());
        part->prune(0.0);
        if ((*part - RealSparse(part->transpose())).norm() > 1e-14 * part->norm())
            return std::nullopt;
    }
    return out;
}

std::vector<RealSparse> planar_parts(const assembly::DampedPlanarSystem &s) {
    return {s.M.view(), s.C.view(),  s.Cx.view(), -s.G.view(),
            s.K.view(), s.Kx.view(), -s.Kc.view()};
}

/// In p = (x + y') / sqrt(2) and q = (x - y') / sqrt(2) with y = i y'; none where the system is not
/// symmetric so.
std::vector<RealSparse> general_parts(const assembly::FixedSystem &s) {
    std::vector<PlanePair> planes;
    for (const linalg::Matrix *A : {&s.M, &s.C, &s.G, &s.K, &s.Kc}) {
        std::optional<PlanePair> part = planes_of(*A);
        if (!part)
            return {};
        planes.push_back(std::move(*part));
    }
    const bool as_expected = planes[0].across.norm() == 0 && planes[2].within.norm() == 0 &&
                             planes[4].within.norm() == 0;
    if (!as_expected)
        return {};
    std::vector<RealSparse> out;
    for (RealSparse *part :
         {&planes[0].within, &planes[1].within, &planes[1].across, &planes[2].across,
          &planes[3].within, &planes[3].across, &planes[4].across})
        out.push_back(std::move(*part));
    return out;
}

} // namespace

std::vector<RealSparse> SymmetricProblem::parts_of(const assembly::Discretization &d,
                                                   results::Form form, double bearing_speed) {
    if (form == results::Form::planar_damped)
        return planar_parts(assembly::assemble_damped_planar(d, bearing_speed));
    if (form == results::Form::general)
        return general_parts(assembly::assemble_fixed(d, bearing_speed));
    return {};
}

} // namespace whirl::modes
