#pragma once

#include <sys/types.h>

namespace whirl::process {

/// From now on a signal that asks the program to end (Ctrl-C, kill, a closed terminal, a time limit
/// of the system) ends what it has started, says so in one line, and then ends it as it would have:
/// the shell sees 128 + the signal. Nothing else needs to be cleared away: results have no names
/// before they are whole. A SIGHUP that is ignored (nohup) stays ignored.
/// Files larger than a limit of the system are an error of the write, no signal.
/// @param speaks  whether this process says so, of several one
void end_in_order_on_signals(bool speaks) noexcept;

/// Ends the program by this signal without a word.
[[noreturn]] void end_by(int signal) noexcept;

/// While one lives a signal that ends the program waits: files get their names together, or what
/// was started is noted.
class SignalsHeld {
  public:
    SignalsHeld() noexcept;
    ~SignalsHeld();
    SignalsHeld(const SignalsHeld &) = delete;
    SignalsHeld &operator=(const SignalsHeld &) = delete;
    SignalsHeld(SignalsHeld &&) = delete;
    SignalsHeld &operator=(SignalsHeld &&) = delete;
};

/// The results are there: who ends the program now is not told that they are missing.
void results_written() noexcept;

/// While it lives the first SIGINT asks the analysis to stop at its next step
/// (process/interruption.h); the next one ends the program.
class InterruptionBySignal {
  public:
    /// @param came  told at the end whether there has been one
    explicit InterruptionBySignal(bool &came) noexcept;
    ~InterruptionBySignal();
    InterruptionBySignal(const InterruptionBySignal &) = delete;
    InterruptionBySignal &operator=(const InterruptionBySignal &) = delete;
    InterruptionBySignal(InterruptionBySignal &&) = delete;
    InterruptionBySignal &operator=(InterruptionBySignal &&) = delete;

  private:
    bool &_came;
};

/// A process that leads its group, ended with all of the group when a signal ends the program.
/// @returns its place, for forget_group; or -1 where there are too many already
int note_group(pid_t leader) noexcept;
void forget_group(int place) noexcept;

} // namespace whirl::process
