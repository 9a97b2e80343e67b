#include "periodic/collocation.h"

#include "linalg/dense/general_eigen.h"

#include <array>

namespace whirl::periodic {

namespace {

using Real = long double; // rates to the last digit of double

/// The beginning of a step, and the zeros of P_8 - P_7, Legendre's polynomials, moved to [0, 1].
constexpr std::array<Real, stages + 1> collocation_places{0,
                                                          0.0224793864387124981L,
                                                          0.114679053160904232L,
                                                          0.265789822784589468L,
                                                          0.452846373669444617L,
                                                          0.647375282886830363L,
                                                          0.819759308263107635L,
                                                          0.943737439463077854L,
                                                          1};

/// Rate at one of the places of the polynomial that is 1 at another, or the same one, and 0 at the
/// rest.
Real rate(std::size_t at, std::size_t of) {
    Real out = at == of ? 0 : 1 / (collocation_places[of] - collocation_places[at]);
    for (std::size_t k = 0; k < collocation_places.size(); ++k) {
        if (k == at || k == of)
            continue;
        if (at == of)
            out += 1 / (collocation_places[at] - collocation_places[k]);
        else
            out *= (collocation_places[at] - collocation_places[k]) /
                   (collocation_places[of] - collocation_places[k]);
    }
    return out;
}

Collocation made() {
    Collocation out{Eigen::VectorXd(stages), Eigen::MatrixXd(stages, stages),
                    Eigen::VectorXcd(stages / 2), Eigen::MatrixXcd(stages, stages / 2),
                    Eigen::MatrixXcd(stages / 2, stages)};
    for (int i = 0; i < stages; ++i) {
        const auto at = static_cast<std::size_t>(i) + 1;
        out.nodes(i) = static_cast<double>(collocation_places[at]);
        for (int j = 0; j < stages; ++j)
            out.inverse(i, j) = static_cast<double>(rate(at, static_cast<std::size_t>(j) + 1));
    }
    const linalg::GeneralEigen found = linalg::general_eigen(out.inverse, linalg::Vectors::both);
    for (int pair = 0; pair < stages / 2; ++pair) { // of an even number of stages none is real
        out.roots(pair) = found.values(2 * pair);
        out.T.col(pair) = linalg::unpacked(found.right, 2 * pair, true);
        out.left.row(pair) =
            linalg::unpacked(found.left, 2 * pair, true).adjoint() / found.products(2 * pair);
    }
    return out;
}

} // namespace

const Collocation &collocation() {
    static const Collocation once = made();
    return once;
}

} // namespace whirl::periodic
