#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/messages.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <exception>
#include <new>

int main(int argc, char **argv) {
    using namespace whirl;
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
        cli::complain("whirl: not enough memory");
    } catch (const std::exception &error) {
        cli::complain(fmt::format("whirl: {}", error.what()));
    }
    return cli::exit_failed;
}
