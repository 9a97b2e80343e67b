// The table of a program that has one command alone, WHIRL_COMMAND: built in a part of the time.

#include "cli/commands.h"

namespace whirl::cli {

const std::vector<Command> &commands() {
    static const std::vector<Command> table{WHIRL_COMMAND()};
    return table;
}

Compare comparison() { return nullptr; }

} // namespace whirl::cli
