#pragma once

#include "model/sentence.h"
#include "report/common/units.h"

#include <condition_variable>
#include <cstdio>
#include <mutex>

#include <thread>

namespace whirl::cli {

/// Says on a terminal how far a long analysis is and what it is doing, on one line that is written
/// again and again. A thread of its own writes, so that it says so too while nothing is reported.
class ProgressDisplay {
  public:
    struct Pace {
        double first = 1;   ///< s, nothing is said before
        double every = 0.2; ///< s, between two times
    };

    /// Listens to process::on_progress while it lives.
    /// @param to  a terminal
    ProgressDisplay(std::FILE *to, const Pace &pace, report::Units units = {});
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay &) = delete;
    ProgressDisplay &operator=(const ProgressDisplay &) = delete;
    ProgressDisplay(ProgressDisplay &&) = delete;
    ProgressDisplay &operator=(ProgressDisplay &&) = delete;

  private:
    std::FILE *_to;
    Pace _pace;
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
