#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/messages.h"
#include "model/errors.h"
#include "process/signals.h"

#include <fmt/format.h>

#include <exception>
#include <new>

int main(int argc, char **argv) {
    using namespace whirl;
    process::end_in_order_on_signals(cli::first_process());
    try {
        const cli::Parsed parsed = cli::parse_arguments(argc, argv);
        if (parsed.arguments)
            cli::run(*parsed.arguments);
        return cli::status_here(parsed.status);
    } catch (const model::BadInput &error) {
        cli::complain(error.what());
        return cli::status_here(cli::exit_bad_input);
    } catch (const model::AnalysisFailure &error) {
        cli::complain(fmt::format("whirl: {}", error.what()));
        return cli::status_here(cli::exit_failed);
    } catch (const std::bad_alloc &) {
        // Of several processes the others do not know of this (process::together would have told
        // them): this one speaks for itself, and its status ends them.
        cli::complain_here("whirl: not enough memory");
    } catch (const std::exception &error) {
        cli::complain_here(fmt::format("whirl: {}", error.what()));
    }
    return cli::exit_failed;
}
