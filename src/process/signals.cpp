#include "process/signals.h"

#include "process/interruption.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

#include <unistd.h>

namespace whirl::process {

namespace {

/// What ends a program that does not catch it and comes from outside, with its name: the functions
/// of the library that know it are not for signal handlers.
struct Named {
    int signal;
    const char *name;
};
constexpr std::array<Named, 10> ending{{{SIGHUP, "SIGHUP, its terminal was closed"},
                                        {SIGINT, "SIGINT, Ctrl-C"},
                                        {SIGQUIT, "SIGQUIT"},
                                        {SIGTERM, "SIGTERM"},
                                        {SIGALRM, "SIGALRM"},
                                        {SIGVTALRM, "SIGVTALRM"},
                                        {SIGPROF, "SIGPROF"},
                                        {SIGUSR1, "SIGUSR1"},
                                        {SIGUSR2, "SIGUSR2"},
                                        {SIGXCPU, "SIGXCPU, the limit of processor time"}}};

// Handlers run in any thread, and between any two instructions: lock-free numbers alone.
std::atomic<bool> says = true;
std::atomic<bool> on_terminal = false;
std::atomic<bool> written = false;
std::atomic<int> holds = 0;   ///< SignalsHeld that live
std::atomic<int> waiting = 0; ///< the signal that came meanwhile
enum Interruptible { no, first, asked };
std::atomic<int> interruptible = no;
std::array<std::atomic<pid_t>, 256> groups{};

void put(const char *text) noexcept {
    const ssize_t ignored = write(STDERR_FILENO, text, std::strlen(text));
    (void)ignored; // nobody can be told
}

void end_in_order(int signal) noexcept {
    for (std::atomic<pid_t> &group : groups)
        if (const pid_t leader = group.exchange(0); leader > 0)
            kill(-leader, SIGKILL);
    if (says) {
        // One write for the line, so that it stays in one piece.
        std::array<char, 160> line{};
        const auto add = [&line](const char *text) {
            std::strncat(line.data(), text, line.size() - 1 - std::strlen(line.data()));
        };
        if (on_terminal)
            add("\r\033[K"); // the line of the progress
        add("whirl: ended by ");
        for (const Named &known : ending)
            if (known.signal == signal)
                add(known.name);
        add(written ? "\n" : "; no results were written\n");
        put(line.data());
    }
    end_by(signal);
}

void on_signal(int signal) {
    if (signal == SIGINT && interruptible == first) {
        interruptible = asked;
        request_interruption();
        return;
    }
    if (holds > 0) {
        waiting = signal;
        if (holds > 0 || waiting.exchange(0) == 0) // the last ended meanwhile, in another thread
            return;
    }
    end_in_order(signal);
}

} // namespace

void end_in_order_on_signals(bool speaks) noexcept {
    says = speaks;
    on_terminal = isatty(STDERR_FILENO) != 0;
    for (const Named &known : ending) {
        struct sigaction before {};
        sigaction(known.signal, nullptr, &before);
        if (known.signal == SIGHUP && before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action {};
        action.sa_handler = on_signal;
        action.sa_flags = SA_RESTART;
        sigaction(known.signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

void end_by(int signal) noexcept {
    struct sigaction plain {};
    plain.sa_handler = SIG_DFL;
    sigaction(signal, &plain, nullptr);
    sigset_t this_one;
    sigemptyset(&this_one);
    sigaddset(&this_one, signal);
    pthread_sigmask(SIG_UNBLOCK, &this_one, nullptr);
    raise(signal);
    _exit(128 + signal); // what it means elsewhere
}

SignalsHeld::SignalsHeld() noexcept { ++holds; }

SignalsHeld::~SignalsHeld() {
    if (--holds == 0)
        if (const int signal = waiting.exchange(0); signal != 0)
            end_in_order(signal);
}

void results_written() noexcept { written = true; }

InterruptionBySignal::InterruptionBySignal(bool &came) noexcept : _came(came) {
    interruptible = first;
}

InterruptionBySignal::~InterruptionBySignal() { _came = interruptible.exchange(no) == asked; }

int note_group(pid_t leader) noexcept {
    const auto free = std::find_if(groups.begin(), groups.end(), [leader](auto &group) {
        pid_t none = 0;
        return group.compare_exchange_strong(none, leader);
    });
    return free == groups.end() ? -1 : static_cast<int>(free - groups.begin());
}

void forget_group(int place) noexcept {
    if (place >= 0)
        groups[static_cast<std::size_t>(place)] = 0;
}

} // namespace whirl::process
