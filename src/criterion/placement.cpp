#include "criterion/placement.h"

#include "process/parallel.h"
#include "process/progress.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::criterion {

namespace {

constexpr int stations = 81;      ///< along the shaft, for a figure
constexpr int fewest_speeds = 81; ///< of the range, for a figure

/// Deflection anywhere on the shaft.
assembly::Combination deflection_anywhere(const assembly::Discretization &d, double z) {
    const auto &spans = d.shaft_mesh().spans;
    std::size_t span = 0;
    while (span + 1 < spans.size() && z > spans[span].z + spans[span].length)
        ++span;
    const double xi = (z - spans[span].z) / spans[span].length;
    return d.deflection_inside(static_cast<int>(span), std::clamp(xi, 0.0, 1.0));
}

/// Upper triangle of the form, column by column.
std::vector<double> packed(const Eigen::MatrixXcd &form, double factor) {
    std::vector<double> values;
    for (Eigen::Index j = 0; j < form.cols(); ++j)
        for (Eigen::Index i = 0; i <= j; ++i) {
            values.push_back(factor * form(i, j).real());
            values.push_back(factor * form(i, j).imag());
        }
    return values;
}

std::size_t place_of(std::size_t i, std::size_t j) { return 2 * (j * (j + 1) / 2 + i); }

/// A form, packed, and how many of its rows belong to a place.
struct FormOfPlaces {
    const std::vector<double> &packed;
    std::size_t a_place;

    /// Largest eigenvalue for one plane.
    [[nodiscard]] double single(std::size_t place) const {
        const std::size_t row = a_place * place;
        return a_place == 1 ? packed[place_of(row, row)] : of_two(row, row + 1);
    }
    /// For two; one place twice: never below zero.
    [[nodiscard]] double pair(std::size_t i, std::size_t j) const {
        if (i == j)
            return std::max(0.0, 2 * single(i));
        return a_place == 1 ? of_two(i, j) : of_two_pairs(2 * i, 2 * j);
    }

  private:
    /// Of the rows i < j.
    [[nodiscard]] double of_two(std::size_t i, std::size_t j) const {
        const double a = packed[place_of(i, i)];
        const double b = packed[place_of(j, j)];
        const double c = std::hypot(packed[place_of(i, j)], packed[place_of(i, j) + 1]);
        return (a + b) / 2 + std::hypot((a - b) / 2, c);
    }
    /// Of the rows i, i + 1 < j, j + 1, real.
    [[nodiscard]] double of_two_pairs(std::size_t i, std::size_t j) const {
        const std::array<std::size_t, 4> rows{i, i + 1, j, j + 1};
        Eigen::Matrix4d form;
        for (Eigen::Index column = 0; column < 4; ++column)
            for (Eigen::Index row = 0; row <= column; ++row)
                form(column, row) = packed[place_of(rows[static_cast<std::size_t>(row)],
                                                    rows[static_cast<std::size_t>(column)])];
        return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(form, Eigen::EigenvaluesOnly)
            .eigenvalues()
            .maxCoeff();
    }
};

/// Share of an interval of speeds in which the criterion is negative, from its values at the ends:
/// it jumps at a critical speed and passes zero on a straight line elsewhere.
class NegativeShare {
  public:
    NegativeShare(const std::vector<double> &speeds, const std::vector<double> &critical) {
        for (std::size_t k = 0; k + 1 < speeds.size(); ++k) {
            // Of several the last one: those of two bending stiffnesses stand close together, and
            // the criterion is negative above both.
            const auto beyond = std::upper_bound(critical.begin(), critical.end(), speeds[k + 1]);
            const bool inside = beyond != critical.begin() && *(beyond - 1) > speeds[k];
            _jump.push_back(inside ? (*(beyond - 1) - speeds[k]) / (speeds[k + 1] - speeds[k])
                                   : -1);
        }
    }
    /// Of interval k.
    [[nodiscard]] double operator()(std::size_t k, double before, double after) const {
        if ((before < 0) == (after < 0))
            return before < 0 ? 1 : 0;
        if (after < 0)
            return 1 - (_jump[k] >= 0 ? _jump[k] : before / (before - after));
        return before / (before - after);
    }

  private:
    std::vector<double> _jump; ///< place of a critical speed in each interval, 0..1; -1: none
};

results::BestPlace best_of(const std::vector<results::BestPlace> &places) {
    const auto more = [](const results::BestPlace &a, const results::BestPlace &b) {
        return a.share < b.share;
    };
    const double largest = std::ranges::max_element(places, more)->share;
    results::BestPlace best;
    best.margin = -2;
    for (const results::BestPlace &place : places) // shares on the grid are equal to about 1e-3
        if (place.share >= largest - 1e-3 && place.margin > best.margin)
            best = place;
    return best;
}

/// Share and margin of places over all speeds; value(k) is their criterion at speed k.
template <class Value>
results::BestPlace judged(std::vector<double> z, const NegativeShare &share, std::size_t speeds,
                          Value &&value) {
    results::BestPlace place{std::move(z), 0, 0};
    double before = value(0);
    place.margin = std::clamp(-before, -1.0, 1.0);
    for (std::size_t k = 1; k < speeds; ++k) {
        const double here = value(k);
        place.share += share(k - 1, before, here);
        place.margin += std::clamp(-here, -1.0, 1.0);
        before = here;
    }
    place.share = speeds > 1 ? place.share / static_cast<double>(speeds - 1) : before < 0;
    place.margin /= static_cast<double>(speeds);
    return place;
}

/// @param packed  the form at every speed
void fill(results::Placement &out, const std::vector<std::vector<double>> &packed,
          std::size_t a_place, const std::vector<double> &critical) {
    std::vector<FormOfPlaces> forms;
    for (const std::vector<double> &form : packed)
        forms.push_back({form, a_place});
    const NegativeShare share(out.speeds, critical);
    std::vector<results::BestPlace> single;
    std::vector<results::BestPlace> pairs;
    for (std::size_t j = 0; j < out.z.size(); ++j) {
        single.push_back(judged({out.z[j]}, share, forms.size(),
                                [&](std::size_t k) { return forms[k].single(j); }));
        out.share.push_back(single.back().share);
        for (std::size_t i = 0; i < j; ++i)
            pairs.push_back(judged({out.z[i], out.z[j]}, share, forms.size(),
                                   [&](std::size_t k) { return forms[k].pair(i, j); }));
    }
    out.best = best_of(single);
    out.best_pair = best_of(pairs);
    for (const FormOfPlaces &form : forms) {
        out.criterion.emplace_back();
        for (std::size_t j = 0; j < out.z.size(); ++j)
            out.criterion.back().push_back(form.single(j));
    }
    for (std::size_t i = 0; i < out.z.size(); ++i) {
        out.pair_value.emplace_back();
        for (std::size_t j = 0; j < out.z.size(); ++j)
            out.pair_value.back().push_back(forms.back().pair(std::min(i, j), std::max(i, j)));
    }
}

} // namespace

results::Placement placement(const BalanceScene &scene, const assembly::Discretization &d,
                             const std::vector<double> &critical) {
    results::Placement out;
    std::vector<assembly::Combination> places;
    const double length = scene.rotor.shaft.length();
    for (int i = 0; i < stations; ++i) {
        out.z.push_back(i == stations - 1 ? length : length * i / (stations - 1));
        places.push_back(deflection_anywhere(d, out.z.back()));
    }
    out.pair_z = out.z;
    out.pair_speed = scene.to;
    out.speeds = scene.speeds;
    if (scene.has_range()) {
        const int count = std::max(fewest_speeds, static_cast<int>(scene.speeds.size()));
        out.speeds = model::SpeedRange{scene.from, scene.to, count}.values();
    }
    BalanceForm form(d, scene.formulation.form, places, out.z, scene.harmonics);
    const double mass = scene.body.mass;
    double done = 0;
    const auto forms = process::rows_at(out.speeds, [&](double speed) {
        process::report_progress(done++ / static_cast<double>(out.speeds.size()));
        return packed(form.at(speed), mass);
    });
    if (!forms.empty())
        fill(out, forms,
             static_cast<std::size_t>(synchronous::imbalances_a_place(scene.formulation.form)),
             critical);
    return out;
}

} // namespace whirl::criterion
