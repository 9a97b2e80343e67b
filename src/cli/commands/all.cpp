#include "cli/commands.h"

namespace whirl::cli {

const std::vector<Command> &commands() {
    static const std::vector<Command> table{
        report_command(),   studio_command(),      show_command(),     campbell_command(),
        critical_command(), stability_command(),   response_command(), balance_command(),
        weights_command(),  rigid_limit_command(), simulate_command(), accuracy_command(),
        samples_command(),  sweep_command(),       modes_command()};
    return table;
}

Compare comparison() { return compare_results; }

} // namespace whirl::cli
