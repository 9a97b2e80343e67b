#include "linalg/check.h"
#include "linalg/dense/products.h"
#include "periodic/half_turn.h"
#include "periodic/step_maps.h"
#include "periodic/triangular_turn.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::periodic {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using linalg::Rows;

/// Places to begin with.
constexpr Index first_places = 25;

/// Values at even places of a period, an odd number of them, as those at the same places moved on:
/// a column for each of these.
/// @param shift  over the distance of two, 0 to 1; each entry is right to its last digits, as small
///               ones stand beside 1 for as many windows as there are
MatrixXd moved_on(Index places, double shift) {
    const auto m = static_cast<double>(places);
    const double common = std::sin(std::numbers::pi * shift) / m;
    MatrixXd out(places, places);
    for (Index to = 0; to < places; ++to)
        for (Index from = 0; from < places; ++from) {
            const auto apart = static_cast<double>(to - from);
            const double angle = std::numbers::pi * (apart + shift) / m;
            out(from, to) = ((to - from) % 2 == 0 ? common : -common) / std::sin(angle);
        }
    return out;
}

/// The same at another number of places.
MatrixXd at_places(Index known, Index wanted) {
    const auto m = static_cast<double>(known);
    MatrixXd out(known, wanted);
    for (Index to = 0; to < wanted; ++to)
        for (Index from = 0; from < known; ++from) {
            const double angle =
                std::numbers::pi * (static_cast<double>(to) / static_cast<double>(wanted) -
                                    static_cast<double>(from) / m);
            const double below = m * std::sin(angle);
            out(from, to) = std::abs(below) < 1e-12 ? 1 : std::sin(m * angle) / below;
        }
    return out;
}

/// Cosines and sines of the two highest terms that so many places resolve, a column each.
MatrixXd highest(Index places) {
    MatrixXd out(places, 4);
    for (Index j = 0; j < places; ++j)
        for (Index k = 0; k < 2; ++k) {
            const double angle = 2 * std::numbers::pi *
                                 static_cast<double>((places / 2 - k) * j % places) /
                                 static_cast<double>(places);
            out(j, 2 * k) = 2 * std::cos(angle) / static_cast<double>(places);
            out(j, 2 * k + 1) = 2 * std::sin(angle) / static_cast<double>(places);
        }
    return out;
}

/// Maps of windows of equally many steps, of states with entries of one size: a column each for
/// those that begin at even places, by rows.
class Windows {
  public:
    /// Of one step.
    Windows(const System &system, double speed, int steps)
        : _size(2 * system.size()), _left(steps), _weights(weights_of(system.steady(speed), speed)),
          _maps(_size * _size, first_places) {
        const StepMaps step(system, speed, period(speed) / steps);
        for (Index i = 0; i < first_places; ++i) {
            step.set_map(period(speed) * static_cast<double>(i) / first_places, at(_maps, i));
            at(_maps, i) =
                _weights.asDiagonal() * at(_maps, i) * _weights.cwiseInverse().asDiagonal();
        }
    }

    /// Whether so many places resolve the maps.
    [[nodiscard]] bool resolved() const {
        // Of the largest column: some ten units of rounding of the maps.
        constexpr double nothing = 3e-15;
        return _maps.allFinite() && linalg::times(_maps, highest(_maps.cols())).norm() <=
                                        nothing * _maps.colwise().norm().maxCoeff();
    }

    /// Windows twice as wide, as long as that takes fewer products than it saves; by more places
    /// where these do not resolve them any more.
    void widen() {
        constexpr Index price = 3; // of a place, in products
        while (_left % 2 == 0 && price * _maps.cols() < _left / 2) {
            const MatrixXd before = _maps;
            double_them();
            if (!resolved()) {
                _maps = linalg::times(before, at_places(before.cols(), 2 * before.cols() + 1));
                continue;
            }
            _left /= 2;
        }
    }

    /// Windows as wide as a part; nothing where too many places are needed to resolve them.
    [[nodiscard]] std::optional<std::vector<Rows>> parts(Index count) {
        while (_left > count) {
            const MatrixXd before = _maps;
            double_them();
            if (resolved()) {
                _left /= 2;
                continue;
            }
            if (2 * before.cols() + 1 > _left / 2)
                return std::nullopt;
            _maps = linalg::times(before, at_places(before.cols(), 2 * before.cols() + 1));
        }
        _maps = linalg::times(_maps, at_places(_maps.cols(), _left));
        std::vector<Rows> out;
        for (Index i = 0; i < _left; ++i)
            out.emplace_back(at(_maps, i));
        return out;
    }

    [[nodiscard]] MatrixXd product() {
        _maps = linalg::times(_maps, at_places(_maps.cols(), _left));
        Rows out = at(_maps, 0);
        Rows next = out;
        for (Index i = 1; i < _left; ++i) {
            next.noalias() = at(_maps, i) * out;
            std::swap(out, next);
        }
        return _weights.cwiseInverse().asDiagonal() * out * _weights.asDiagonal();
    }

  private:
    Index _size;
    Index _left;              ///< windows in half a turn
    Eigen::VectorXd _weights; ///< of the entries of a state
    MatrixXd _maps;

    [[nodiscard]] Eigen::Map<Rows> at(MatrixXd &maps, Index i) const {
        return {maps.col(i).data(), _size, _size};
    }

    void double_them() {
        const Index places = _maps.cols();
        const double shift = static_cast<double>(places) / static_cast<double>(_left);
        MatrixXd behind = linalg::times(_maps, moved_on(places, shift));
        MatrixXd products(_maps.rows(), places);
        for (Index i = 0; i < places; ++i)
            at(products, i).noalias() = at(behind, i) * at(_maps, i);
        std::swap(_maps, products);
    }
};

} // namespace

std::vector<Rows> turn_in_parts(const System &system, double speed, int steps, int parts) {
    int each = (steps + parts - 1) / parts;
    constexpr int least_gain = 4; // times the places at first: fewer steps are cheaper one by one
    if (each * parts >= least_gain * first_places && each > 1) {
        each = 1 << static_cast<int>(std::ceil(std::log2(each)));
        Windows windows(system, speed, each * parts);
        if (windows.resolved())
            if (auto found = windows.parts(parts))
                return *std::move(found);
    }
    const Eigen::VectorXd weights = weights_of(system.steady(speed), speed);
    const double length = period(speed) / (each * parts);
    const StepMaps step(system, speed, length);
    const Index size = 2 * system.size();
    std::vector<Rows> out;
    Rows map(size, size);
    Rows next = map;
    for (int part = 0; part < parts; ++part) {
        Rows product = Rows::Identity(size, size);
        for (int k = 0; k < each; ++k) {
            step.set_map((part * each + k) * length, map);
            next.noalias() = map * product;
            std::swap(product, next);
        }
        out.emplace_back(weights.asDiagonal() * product * weights.cwiseInverse().asDiagonal());
        if (!out.back().allFinite())
            throw linalg::SolverError("the motion over half a turn cannot be found");
    }
    return out;
}

std::optional<MatrixXd> half_turn_by_windows(const System &system, double speed, int steps) {
    // Times the places at first: with fewer steps nothing is halved often enough to gain.
    constexpr int least_gain = 8;
    if (steps < least_gain * first_places)
        return std::nullopt;
    // A few more, to be halved many times.
    const auto halvings = static_cast<int>(std::log2(static_cast<double>(steps) / first_places));
    const int whole = 1 << halvings;
    Windows windows(system, speed, (steps + whole - 1) / whole * whole);
    if (!windows.resolved())
        return std::nullopt;
    windows.widen();
    MatrixXd out = windows.product();
    return out.allFinite() ? std::optional(std::move(out)) : std::nullopt;
}

} // namespace whirl::periodic
