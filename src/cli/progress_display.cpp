#include "cli/progress_display.h"

#include "process/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

namespace whirl::cli {

ProgressDisplay::ProgressDisplay(std::FILE *to, const Pace &pace, report::Units units)
    : _to(to), _pace(pace), _units(std::move(units)) {
    process::on_progress([this](double share, const model::Sentence &doing) {
        const std::lock_guard<std::mutex> guard(_lock);
        _share = std::max(_share, share);
        _doing = doing;
    });
    try {
        _writer = std::thread([this] { write_until_the_end(); });
    } catch (const std::system_error &) { // too little memory, too many threads: it goes without
    }
}

ProgressDisplay::~ProgressDisplay() {
    process::on_progress(nullptr);
    {
        const std::lock_guard<std::mutex> guard(_lock);
        _end = true;
    }
    _ended.notify_all();
    if (_writer.joinable())
        _writer.join();
    if (_written)
        fmt::print(_to, "\r\033[K");
}

void ProgressDisplay::write(double seconds) {
    const std::string text = fmt::format("{:.0f} %{}{}, {:.0f} s", 100 * _share,
                                         _doing.empty() ? "" : ", ", _units.text(_doing), seconds);
    fmt::print(_to, "\r\033[K{}", text);
    std::fflush(_to);
    _written = true;
}

void ProgressDisplay::write_until_the_end() {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    std::unique_lock<std::mutex> lock(_lock);
    double wait = _pace.first;
    while (!_ended.wait_for(lock, std::chrono::duration<double>(wait), [this] { return _end; })) {
        write(std::chrono::duration<double>(Clock::now() - start).count());
        wait = _pace.every;
    }
}

} // namespace whirl::cli
