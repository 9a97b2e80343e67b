#include "cli/progress_display.h"

#include "process/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace whirl::cli {

ProgressDisplay::Style ProgressDisplay::style_for(bool terminal) {
    return terminal ? Style{true, 1, 0.2, stderr} : Style{false, 10, 10, stderr};
}

ProgressDisplay::ProgressDisplay(const Style &style, report::Units units)
    : _style(style), _units(std::move(units)) {
    process::on_progress([this](double share, const model::Sentence &doing) {
        const std::lock_guard<std::mutex> guard(_lock);
        _share = std::max(_share, share);
        _doing = doing;
    });
    _writer = std::thread([this] { write_until_the_end(); });
}

ProgressDisplay::~ProgressDisplay() {
    process::on_progress(nullptr);
    {
        const std::lock_guard<std::mutex> guard(_lock);
        _end = true;
    }
    _ended.notify_all();
    _writer.join();
    if (_style.terminal && _written)
        fmt::print(_style.to, "\r\033[K");
}

void ProgressDisplay::write(double seconds) {
    const std::string text = fmt::format("{:.0f} %{}{}, {:.0f} s", 100 * _share,
                                         _doing.empty() ? "" : ", ", _units.text(_doing), seconds);
    if (_style.terminal)
        fmt::print(_style.to, "\r\033[K{}", text);
    else
        fmt::print(_style.to, "whirl: {}\n", text);
    std::fflush(_style.to);
    _written = true;
}

void ProgressDisplay::write_until_the_end() {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    std::unique_lock<std::mutex> lock(_lock);
    double wait = _style.first;
    while (!_ended.wait_for(lock, std::chrono::duration<double>(wait), [this] { return _end; })) {
        write(std::chrono::duration<double>(Clock::now() - start).count());
        wait = _style.every;
    }
}

} // namespace whirl::cli
