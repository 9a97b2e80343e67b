#include "input/bearings/coefficients.h"

#include <fmt/core.h>

#include <cmath>

namespace whirl::input {

namespace {

using model::BearingCoefficients;

/// Of the same matrix, in full and as one number.
struct Kind {
    const char *letter;
    CoefficientMatrix matrix;
};
constexpr std::array coefficients{Kind{"k", &BearingCoefficients::k},
                                  Kind{"c", &BearingCoefficients::c},
                                  Kind{"m", &BearingCoefficients::m}};

} // namespace

const std::array<Coefficient, 15> &bearing_coefficients() {
    constexpr auto k = &BearingCoefficients::k;
    constexpr auto c = &BearingCoefficients::c;
    constexpr auto m = &BearingCoefficients::m;
    static const std::array<Coefficient, 15> all{{{"k", Quantity::stiffness, k},
                                                  {"kxx", Quantity::stiffness, k, 0, 0},
                                                  {"kxy", Quantity::stiffness, k, 0, 1},
                                                  {"kyx", Quantity::stiffness, k, 1, 0},
                                                  {"kyy", Quantity::stiffness, k, 1, 1},
                                                  {"c", Quantity::damping, c},
                                                  {"cxx", Quantity::damping, c, 0, 0},
                                                  {"cxy", Quantity::damping, c, 0, 1},
                                                  {"cyx", Quantity::damping, c, 1, 0},
                                                  {"cyy", Quantity::damping, c, 1, 1},
                                                  {"m", Quantity::mass, m},
                                                  {"mxx", Quantity::mass, m, 0, 0},
                                                  {"mxy", Quantity::mass, m, 0, 1},
                                                  {"myx", Quantity::mass, m, 1, 0},
                                                  {"myy", Quantity::mass, m, 1, 1}}};
    return all;
}

BearingCoefficients read_coefficients(const NumberOf &number, bool seal) {
    BearingCoefficients row;
    for (const Coefficient &entry : bearing_coefficients()) {
        Eigen::Matrix2d &matrix = row.*entry.matrix;
        if (const auto value = number(entry)) {
            if (entry.on_diagonal())
                matrix.diagonal().setConstant(*value);
            else
                matrix(entry.row, entry.column) = *value;
        } else if (seal && entry.row > entry.column) { // read after its opposite
            matrix(1, 0) = 0 - matrix(0, 1);
        }
    }
    return row;
}

std::optional<WrongKey> mixed_keys(const std::function<bool(const char *)> &has, bool seal) {
    for (const Kind &kind : coefficients)
        for (const Coefficient &entry : bearing_coefficients()) {
            const bool coupling = seal && entry.row < entry.column;
            if (entry.matrix != kind.matrix || entry.on_diagonal() || coupling)
                continue;
            if (has(kind.letter) && has(entry.name))
                return WrongKey{kind.letter,
                                fmt::format("expected either {0}{1} or {0}xx, {0}xy, {0}yx, "
                                            "{0}yy, got both",
                                            kind.letter,
                                            seal ? fmt::format(" (and {}xy)", kind.letter) : "")};
        }
    return std::nullopt;
}

std::optional<WrongKey> against_mass(const Eigen::Matrix2d &m, bool isotropic) {
    const double coupling = (m(0, 1) + m(1, 0)) / 2;
    const double least = m.trace() / 2 - std::hypot((m(0, 0) - m(1, 1)) / 2, coupling);
    constexpr double rounding = 1e-12; // of products of numbers in the file's units
    if (!(least < -rounding * m.cwiseAbs().maxCoeff()))
        return std::nullopt;
    const char *key = isotropic ? "m" : m(0, 0) >= 0 && m(1, 1) < 0 ? "myy" : "mxx";
    return WrongKey{key, fmt::format("expected mass coefficients that resist acceleration in every "
                                     "direction (mxx, myy >= 0, ((mxy + myx)/2)^2 <= mxx myy), got "
                                     "{:.6g} kg in one",
                                     least)};
}

} // namespace whirl::input
