#include "analyses/samples/samples.h"

#include "analyses/samples/answers.h"
#include "analyses/samples/many_rotors.h"
#include "analyses/samples/statistics.h"
#include "model/errors.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/enum_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace whirl::analyses {

namespace {

std::string distribution_name(model::Distribution distribution) {
    return results::enum_name(distribution, {"normal", "uniform", "values"});
}

void add_notes(results::SamplesResult &result) {
    auto &notes = result.model.notes;
    if (result.failed > 0)
        notes.emplace_back(model::Weight::warning,
                           "{} of {} samples failed: quantiles are those of the others",
                           result.failed, result.count);
    if (result.answers.empty())
        notes.emplace_back("neither the case as it is nor any sample has an answer of the kinds "
                           "asked for in the range of speeds");
    const int sound = result.count - result.failed;
    if (std::ranges::any_of(result.answers,
                            [sound](const auto &answer) { return answer.present < sound; }))
        notes.emplace_back("not every sample has every answer: the same number need not be the "
                           "same motion there, and quantiles are of the samples that have it");
}

} // namespace

results::SamplesResult samples(const model::Case &scene, const CaseWith &with) {
    if (!scene.samples)
        throw model::BadInput(
            fmt::format("{}: samples: missing, expected a section [samples] with the entries that "
                        "vary, as count = 200, vary = [{{path = \"bearing[0].k\", distribution = "
                        "\"uniform\", from = 1e6, to = 2e6}}]",
                        scene.file.generic_string()));
    const model::SamplesSettings &settings = *scene.samples;
    std::optional<process::Stage> stage(std::in_place, "the case as it is", 0.0, 0.02);
    const Answers answers(scene, settings.of, Naming::by_whirl);
    results::SamplesResult result;
    result.model = answers.model();
    result.count = settings.count;
    result.seed = settings.seed;
    for (const model::UncertainInput &input : settings.vary)
        result.inputs.push_back(
            {input.path, input.quantity, distribution_name(input.distribution), {}});
    std::vector<std::vector<std::string>> overrides;
    for (int i = 0; i < settings.count; ++i) {
        const std::vector<double> drawn = draw(settings, i);
        overrides.emplace_back();
        for (std::size_t k = 0; k < result.inputs.size(); ++k) {
            result.inputs[k].values.push_back(drawn[k]);
            overrides.back().push_back(fmt::format("{}={}", settings.vary[k].path, drawn[k]));
        }
    }
    stage.emplace("samples", 0.02, 1.0);
    ManyRotors rotors = answers_of_many(
        answers, overrides.size(),
        [&](std::size_t i, std::vector<double> & /*beside*/) { return with(overrides[i]); },
        "samples");
    result.answers = std::move(rotors.answers);
    result.failures = std::move(rotors.failures);
    result.failed = rotors.failed;
    if (result.answers.empty() && process::process_rank() != 0)
        return result;
    for (results::SampledAnswer &answer : result.answers)
        describe_values(settings.quantiles, answer);
    add_notes(result);
    return result;
}

} // namespace whirl::analyses
