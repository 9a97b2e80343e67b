#include "studio/studio.h"

#include "analyses/machine_report.h"
#include "cli/commands.h"
#include "cli/messages.h"
#include "model/errors.h"
#include "process/processes.h"
#include "report/common/units.h"

#include <fmt/format.h>

namespace whirl::cli {

namespace {

void studio_of_case(const Run &run) {
    if (process::process_count() > 1)
        throw model::BadInput("whirl: studio runs on one process; expected no mpirun before it");
    const report::Units units = report::Units::of_readers(run.scene.units);
    const analyses::NotCalledFor why = analyses::not_called_for(run.scene);
    studio::Setup setup;
    setup.scene = run.arguments.scene;
    setup.overrides = run.arguments.overrides;
    setup.offers = {{"campbell", "Campbell diagram", units.text(why.campbell)},
                    {"critical", "Critical speeds", ""},
                    {"response", "Response", units.text(why.response)},
                    {"balance", "Balance", units.text(why.balance)}};
    setup.reports =
        run.arguments.out.value_or(std::filesystem::path("out") / run.scene.name / "report");
    setup.port = run.arguments.port;
    studio::run(setup, [](const std::string &address) {
        say(fmt::format("{}\nopen it in a browser of this machine; Ctrl-C ends it\n", address));
    });
}

} // namespace

Command studio_command() {
    return {"studio",
            "a page on which the numbers of the case are sliders and its pictures follow",
            {},
            {"--port"},
            {"cases/nelson_mcvaugh", "cases/id_fan --port 8080"},
            studio_of_case,
            true};
}

} // namespace whirl::cli
