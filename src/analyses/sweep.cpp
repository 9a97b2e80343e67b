#include "analyses/sweep.h"

#include "analyses/axes.h"
#include "analyses/samples/answers.h"
#include "analyses/samples/many_rotors.h"
#include "model/case.h"
#include "model/errors.h"
#include "process/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace whirl::analyses {

namespace {

/// The values of the axes at a rotor: the first axis runs fastest.
std::vector<double> values_at(const std::vector<model::SweepAxis> &axes, std::size_t rotor) {
    std::vector<double> values;
    for (const model::SweepAxis &axis : axes) {
        values.push_back(axis.values[rotor % axis.values.size()]);
        rotor /= axis.values.size();
    }
    return values;
}

std::size_t count_of(const std::vector<model::SweepAxis> &axes) {
    std::size_t count = 1;
    for (const model::SweepAxis &axis : axes)
        count *= axis.values.size();
    return count;
}

void add_sweep_notes(results::SweepResult &result) {
    auto &notes = result.model.notes;
    if (result.failed > 0)
        notes.emplace_back("{} of {} rotors have no answer: the table of failures says why",
                           result.failed, result.count);
    if (result.answers.empty())
        notes.emplace_back("neither the case as it is nor any other rotor has an answer of the "
                           "kinds asked for in the range of speeds");
    const int sound = result.count - result.failed;
    if (std::ranges::any_of(result.answers,
                            [sound](const auto &answer) { return answer.present < sound; }))
        notes.emplace_back("not every rotor has every answer: answers are numbered in each rotor, "
                           "so that a curve need not be one and the same motion all along");
}

} // namespace

results::SweepResult sweep(const model::Case &scene, const CaseWith &with) {
    if (!scene.sweep)
        throw model::BadInput(fmt::format(
            "{}: sweep: missing, expected a section [sweep] with the entries that "
            "change, as x = {{path = \"bearing[0].k\", from = 1e6, to = 1e8, count = 21}}",
            scene.file.generic_string()));
    std::optional<process::Stage> stage(std::in_place, "the case as it is", 0.0, 0.02);
    const Answers answers(scene, scene.sweep->of, Naming::by_order);
    results::SweepResult result;
    result.model = answers.model();
    result.axes = scene.sweep->axes;
    const std::size_t count = count_of(result.axes);
    result.count = static_cast<int>(count);
    stage.emplace("rotors", 0.02, 1.0);
    const RotorsOver rotors(result.axes, with);
    ManyRotors found = answers_of_many(
        answers, count,
        [&](std::size_t i, std::vector<double> &changes) {
            RotorsOver::Rotor rotor = rotors.at(values_at(result.axes, i));
            changes = rotor.changes;
            return std::move(rotor.scene);
        },
        "rotors");
    result.changes = std::move(found.beside);
    result.answers = std::move(found.answers);
    result.failures = std::move(found.failures);
    result.failed = found.failed;
    add_sweep_notes(result);
    return result;
}

} // namespace whirl::analyses
