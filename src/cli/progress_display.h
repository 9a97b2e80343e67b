#pragma once

#include "model/sentence.h"
#include "report/common/units.h"

#include <condition_variable>
#include <cstdio>
#include <mutex>

#include <thread>

namespace whirl::cli {

/// Says how far a long analysis is and what it is doing: on a terminal on one line that is written
/// again and again, else on a new line now and then. A thread of its own writes, so that it says so
/// too while nothing is reported.
class ProgressDisplay {
  public:
    struct Style {
        bool terminal = true;
        double first = 1;   ///< s, nothing is said before
        double every = 0.2; ///< s, between two times
        std::FILE *to = stderr;
    };
    /// A second, then five times a second on a terminal; every ten seconds elsewhere.
    [[nodiscard]] static Style style_for(bool terminal);

    /// Listens to process::on_progress while it lives.
    explicit ProgressDisplay(const Style &style, report::Units units = {});
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay &) = delete;
    ProgressDisplay &operator=(const ProgressDisplay &) = delete;
    ProgressDisplay(ProgressDisplay &&) = delete;
    ProgressDisplay &operator=(ProgressDisplay &&) = delete;

  private:
    Style _style;
    report::Units _units;

    std::mutex _lock;
    std::condition_variable _ended;
    bool _end = false;
    double _share = 0; ///< the largest so far
    model::Sentence _doing;

    bool _written = false;
    std::thread _writer;

    void write(double seconds);
    void write_until_the_end();
};

} // namespace whirl::cli
