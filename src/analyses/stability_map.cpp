#include "analyses/stability_map.h"

#include "analyses/axes.h"
#include "analyses/placed_balls.h"
#include "ends/growth.h"
#include "model/case.h"
#include "model/errors.h"
#include "process/parallel.h"
#include "results/formulation.h"
#include "stability/band_finder.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

namespace whirl::analyses {

namespace {

using Shapes = std::shared_ptr<const Eigen::MatrixXd>;

/// Growth of one case at each of some speeds.
/// @param shapes_for  planar shapes that do for the rotor at these speeds, or none
std::vector<double> growth_at(
    const model::Case &scene, const std::vector<double> &speeds,
    const std::function<Shapes(const stability::StabilityModel &, const balancers::Arrangement &)>
        &shapes_for) {
    const stability::StabilityModel model = stability::stability_model(scene, speeds);
    std::vector<double> out;
    std::vector<model::Sentence> ignored;
    if (const auto placed = placed_by_all_imbalances(scene, model.order, speeds, ignored)) {
        for (const double speed : speeds) {
            const auto found = placed->at(speed);
            out.push_back(found ? found->state.growth : std::numeric_limits<double>::quiet_NaN());
        }
        return out;
    }
    const balancers::Arrangement arrangement = balancers::arrangement_at_balance(scene.rotor);
    Shapes shapes;
    if (model.form != results::Form::hill && !model.conservative)
        shapes = shapes_for(model, arrangement);
    const bool good =
        shapes &&
        shapes->rows() == assembly::Discretization(model.rotor, model.order).planar_size();
    std::optional<ends::Growth> growth;
    if (good)
        growth.emplace(model, arrangement, shapes,
                       results::Interval{speeds.front(), speeds.back()});
    else
        growth.emplace(model, arrangement, speeds);
    for (const double speed : speeds)
        out.push_back(growth->at(speed));
    return out;
}

/// What the rotors of a map have in common: the shapes of the one in the middle. Every process
/// finds them for itself, so that no number depends on who computes which piece.
class CommonShapes {
  public:
    /// For maps over the spin speed: each row makes sure that they do for its rotor, at a speed in
    /// full, or finds its own.
    static CommonShapes of_rows(const model::MapSettings &map, const RotorsOver &rotors) {
        return made([&] {
            const std::vector<double> &ys = map.y.values;
            const model::Case middle = rotors.at({ys[ys.size() / 2]}).scene;
            return CommonShapes(middle, speeds_over(map.x, middle));
        });
    }

    /// For maps of points: made to do for rotors all over the map, at its corners and the middles
    /// of its sides; none where they do not.
    static CommonShapes of_points(const model::MapSettings &map, const RotorsOver &rotors) {
        return made([&] {
            const auto at = [&](double x, double y) { return rotors.at({x, y}).scene; };
            const auto places = [](const model::SweepAxis &axis) {
                const double from = axis.values.front();
                const double to = axis.values.back();
                return std::array{(from + to) / 2, from, to};
            };
            const model::Case middle = at(places(map.x)[0], places(map.y)[0]);
            const std::vector<double> speeds = model::required_speeds(middle).values();
            CommonShapes out(middle, speeds);
            for (const double y : places(map.y))
                for (const double x : places(map.x))
                    out.make_do_for([&] { return at(x, y); }, speeds);
            return out;
        });
    }

    /// For one more rotor, as far as it is made sure that they do.
    [[nodiscard]] Shapes for_row(const stability::StabilityModel &model,
                                 const balancers::Arrangement &arrangement,
                                 const std::vector<double> &speeds) const {
        if (_finder)
            return stability::BandFinder(model, arrangement, *_finder).good_shapes(speeds);
        return stability::BandFinder(model, arrangement).good_shapes(speeds);
    }
    [[nodiscard]] Shapes for_point(const stability::StabilityModel &model) const {
        return _finder && model.form == _form ? _finder->shapes() : nullptr;
    }

  private:
    std::unique_ptr<stability::BandFinder> _finder; ///< of the rotor in the middle; may be missing
    results::Form _form = results::Form::general;

    CommonShapes() = default;
    CommonShapes(const model::Case &middle, const std::vector<double> &speeds) {
        const stability::StabilityModel model = stability::stability_model(middle, speeds);
        _form = model.form;
        if (model.conservative || model.form == results::Form::hill)
            return;
        _finder = std::make_unique<stability::BandFinder>(
            model, balancers::arrangement_at_balance(middle.rotor));
        if (!_finder->good_shapes(speeds))
            _finder.reset();
    }

    /// No shapes any more where they do not do. Where there is no such rotor there is no growth.
    void make_do_for(const std::function<model::Case()> &scene, const std::vector<double> &speeds) {
        if (!_finder)
            return;
        try {
            if (!do_for(scene(), speeds))
                _finder.reset();
        } catch (const model::BadInput &) {
        }
    }
    [[nodiscard]] bool do_for(const model::Case &scene, const std::vector<double> &speeds) {
        const stability::StabilityModel model = stability::stability_model(scene, speeds);
        return model.conservative ||
               (model.form == _form &&
                _finder->enrich_for(model, balancers::arrangement_at_balance(scene.rotor),
                                    {speeds.front(), speeds[speeds.size() / 2], speeds.back()}));
    }

    /// Without shapes where one of these rotors cannot be, or cannot be solved: the piece says so.
    static CommonShapes made(const std::function<CommonShapes()> &make) {
        try {
            return make();
        } catch (const model::Failure &) {
            return {};
        }
    }
};

/// Growth over a row of a map over the spin speed, or at one point of another map: the largest over
/// the speeds of the case. NaN where there is no such rotor, an inertia out of bounds, a capacity
/// below 1; with the reason. Behind the growth what became of the axes: the speeds of a row or the
/// change of x, and the change of y.
/// @param values  of y in a row, of x and y at a point
/// @param row     spin speeds, null at a point
process::Outcome piece_of(const RotorsOver &rotors, const std::vector<double> &values,
                          const model::SweepAxis *row, const CommonShapes &common) {
    const auto with_axes = [](std::vector<double> growth, const std::vector<double> &x, double y) {
        growth.insert(growth.end(), x.begin(), x.end());
        growth.push_back(y);
        return growth;
    };
    try {
        const auto [scene, changes] = rotors.at(values);
        const std::vector<double> speeds =
            row ? speeds_over(*row, scene) : model::required_speeds(scene).values();
        const std::vector<double> growth =
            growth_at(scene, speeds, [&](const auto &model, const auto &arrangement) {
                return row ? common.for_row(model, arrangement, speeds) : common.for_point(model);
            });
        std::string why;
        for (std::size_t i = 0; i < speeds.size(); ++i)
            if (std::isnan(growth[i]) && speeds[i] != 0)
                why = no_balanced_position;
        if (row)
            return {with_axes(growth, speeds, changes.back()), why};
        double most = std::numeric_limits<double>::quiet_NaN();
        for (const double value : growth)
            most = std::fmax(most, value); // of the speeds at which it is known
        return {with_axes({most}, {changes.front()}, changes.back()), std::isnan(most) ? why : ""};
    } catch (const model::BadInput &problem) {
        const std::size_t count = row ? row->values.size() : 1;
        return {std::vector<double>(2 * count + 1, std::numeric_limits<double>::quiet_NaN()),
                problem.what()};
    }
}

std::vector<std::vector<double>> transposed(const std::vector<std::vector<double>> &rows) {
    std::vector<std::vector<double>> out(rows.empty() ? 0 : rows.front().size());
    for (const std::vector<double> &row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            out[i].push_back(row[i]);
    return out;
}

} // namespace

results::StabilityMap stability_map(const model::MapSettings &settings, const CaseWith &with,
                                    const std::function<void()> &first) {
    results::StabilityMap map{settings.x, settings.y, {}, {}, {}, {}};
    if (!settings.x.is_speed() && settings.y.is_speed()) {
        // A case is read once for each column: turn the map, and turn it back.
        const results::StabilityMap turned = stability_map({settings.y, settings.x}, with, first);
        map.why = turned.why;
        map.growth = transposed(turned.growth);
        map.x_changes = transposed(turned.y_changes);
        map.y_changes = transposed(turned.x_changes);
        return map;
    }
    const bool rows = settings.x.is_speed();
    const std::size_t columns = map.x.values.size();
    const std::size_t pieces = map.y.values.size() * (rows ? 1 : columns);
    const RotorsOver rotors(rows ? std::vector{map.y} : std::vector{map.x, map.y}, with);
    const CommonShapes common =
        rows ? CommonShapes::of_rows(settings, rotors) : CommonShapes::of_points(settings, rotors);
    const auto piece = [&](std::size_t i) {
        if (rows)
            return piece_of(rotors, {map.y.values[i]}, &map.x, common);
        return piece_of(rotors, {map.x.values[i % columns], map.y.values[i / columns]}, nullptr,
                        common);
    };
    const auto outcomes = process::deal(pieces, "map", piece, first);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (rows || i % columns == 0)
            for (auto *table : {&map.growth, &map.x_changes, &map.y_changes})
                table->emplace_back();
        const std::vector<double> &numbers = outcomes[i].numbers;
        const std::size_t count = numbers.size() / 2;
        for (std::size_t k = 0; k < count; ++k) {
            map.growth.back().push_back(numbers[k]);
            map.x_changes.back().push_back(numbers[count + k]);
            map.y_changes.back().push_back(numbers.back());
        }
        if (map.why.empty())
            map.why = outcomes[i].text;
    }
    const auto known = [](double growth) { return !std::isnan(growth); };
    if (!outcomes.empty() && std::ranges::none_of(map.growth, [&known](const auto &row) {
            return std::ranges::any_of(row, known);
        }))
        throw model::AnalysisFailure(fmt::format("each of the {} points of the map is empty: {}",
                                                 map.y.values.size() * columns, map.why));
    return map;
}

} // namespace whirl::analyses
