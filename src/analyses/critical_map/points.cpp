#include "analyses/critical_map/points.h"

#include "model/variants.h"
#include "synchronous/critical_error.h"

#include <cmath>
#include <limits>
#include <string>

namespace whirl::analyses {

using synchronous::SynchronousModes;

model::Rotor MapScene::with_stiffness(double k) const {
    return model::with_support_stiffness(rotor, varied, {k});
}

std::size_t MapScene::kept() const {
    return static_cast<std::size_t>(form == results::Form::rotating ? 2 * wanted : wanted);
}

std::vector<std::size_t> of_sense(const SynchronousModes &list, results::Whirl whirl) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < list.modes.size(); ++i)
        if (list.modes[i].whirl == whirl)
            places.push_back(i);
    return places;
}

SynchronousModes lowest_of_each(const MapScene &map, const assembly::Discretization &d) {
    const std::size_t keep = map.kept();
    // The planar form looks for each sense by itself; of others more are asked for until there
    // are enough of each.
    int ask = map.form == results::Form::planar ? map.wanted : 2 * static_cast<int>(keep);
    SynchronousModes found;
    const auto enough = [&](results::Whirl whirl) { return of_sense(found, whirl).size() >= keep; };
    for (int attempts = 0; attempts < 4; ++attempts, ask *= 2) {
        found = synchronous::all_synchronous_modes(d, map.form, ask, 0,
                                                   map.shapes ? &*map.shapes : nullptr);
        if (std::isinf(found.complete_to) ||
            (enough(results::Whirl::forward) &&
             (map.form == results::Form::rotating || enough(results::Whirl::backward))))
            break;
    }
    SynchronousModes out;
    std::map<results::Whirl, std::size_t> count;
    for (std::size_t i = 0; i < found.modes.size(); ++i) {
        const results::Whirl whirl = found.modes[i].whirl;
        if (whirl == results::Whirl::mixed || ++count[whirl] > keep)
            continue;
        out.modes.push_back(found.modes[i]);
        if (!found.branches.empty())
            out.branches.push_back(found.branches[i]);
    }
    return out;
}

std::vector<double> point_at(const MapScene &map, double k) {
    const assembly::Discretization d(map.with_stiffness(k), map.order);
    const SynchronousModes list = lowest_of_each(map, d);
    std::vector<results::Sentence> ignored; // one for each point: too many to read
    const auto errors = synchronous::errors_by_finer_model(d, map.form, list, ignored);
    std::vector<double> numbers(4 * map.kept(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t s = 0; s < map_senses.size(); ++s) {
        const auto places = of_sense(list, map_senses[s]);
        for (std::size_t i = 0; i < places.size(); ++i) {
            numbers[s * map.kept() + i] = list.modes[places[i]].eigenvalue.imag();
            numbers[(2 + s) * map.kept() + i] = errors[places[i]].sum();
        }
    }
    return numbers;
}

} // namespace whirl::analyses
