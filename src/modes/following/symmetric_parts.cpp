#include "modes/following/symmetric_parts.h"

#include "assembly/system.h"

#include <array>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

using RealSparse = Eigen::SparseMatrix<double>;

/// The part of a real matrix on pairs (x, y) that stays within a plane, or that couples them, in
/// p = (x + y') / sqrt(2) and q = (x - y') / sqrt(2): with y = i y' and the rows of y times -i the
/// second becomes i times a symmetric matrix. What is the same in both planes, and gyroscopic
/// terms, then leave p and q (motions backward and forward) apart, which only unequal supports
/// couple.
struct Planes {
    RealSparse within, across;
};

using Triplets = std::vector<Eigen::Triplet<double>>;

/// A block of two pairs in p and q: its even part where x and y are exchanged in both, and the odd.
void add_turned(int i, int j, double even, double odd, bool across, Triplets &out) {
    if (even != 0) {
        out.emplace_back(2 * i, 2 * j, even);
        out.emplace_back(2 * i + 1, 2 * j + 1, across ? -even : even);
    }
    if (odd != 0) {
        out.emplace_back(2 * i, 2 * j + 1, across ? -odd : odd);
        out.emplace_back(2 * i + 1, 2 * j, odd);
    }
}

std::optional<Planes> planes_of(const linalg::Matrix &matrix) {
    const RealSparse A = matrix.view();
    Planes out{RealSparse(A.rows(), A.cols()), RealSparse(A.rows(), A.cols())};
    Triplets within;
    Triplets across;
    // Of a column of pairs: xx, xy, yx, yy.
    std::vector<std::array<double, 4>> blocks(static_cast<std::size_t>(A.rows() / 2));
    std::vector<int> filled;
    for (int j = 0; j < A.cols() / 2; ++j) {
        for (int plane = 0; plane < 2; ++plane)
            for (RealSparse::InnerIterator entry(A, 2 * j + plane); entry; ++entry) {
                const auto row = static_cast<int>(entry.row());
                blocks[static_cast<std::size_t>(row / 2)]
                      [static_cast<std::size_t>(row % 2 * 2 + plane)] = entry.value();
                if (filled.empty() || filled.back() != row / 2)
                    filled.push_back(row / 2);
            }
        for (const int i : filled) { // what the second plane named again is zero by then
            auto &block = blocks[static_cast<std::size_t>(i)];
            const auto [xx, xy, yx, yy] = std::exchange(block, {});
            add_turned(i, j, (xx + yy) / 2, (xx - yy) / 2, false, within);
            add_turned(i, j, (xy - yx) / 2, (xy + yx) / 2, true, across);
        }
        filled.clear();
    }
    out.within.setFromTriplets(within.begin(), within.end());
    out.across.setFromTriplets(across.begin(), across.end());
    for (const RealSparse *part : {&out.within, &out.across})
        if ((*part - RealSparse(part->transpose())).norm() > 1e-14 * part->norm())
            return std::nullopt;
    return out;
}

} // namespace

std::vector<RealSparse> planar_parts(const assembly::Discretization &d, double bearing_speed) {
    const assembly::DampedPlanarSystem s = assembly::assemble_damped_planar(d, bearing_speed);
    return {s.M.view(), s.C.view(),  s.Cx.view(), -s.G.view(),
            s.K.view(), s.Kx.view(), -s.Kc.view()};
}

std::vector<RealSparse> general_parts(const assembly::Discretization &d, double bearing_speed) {
    const assembly::FixedSystem s = assembly::assemble_fixed(d, bearing_speed);
    std::vector<Planes> planes;
    for (const linalg::Matrix *A : {&s.M, &s.C, &s.G, &s.K, &s.Kc}) {
        std::optional<Planes> part = planes_of(*A);
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

} // namespace whirl::modes
