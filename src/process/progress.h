#pragma once

#include "model/sentence.h"

#include <functional>

namespace whirl::process {

/// Called with the share of all the work done, 0..1, and what is being done, while a long analysis
/// is at work; nobody by default.
using ProgressListener = std::function<void(double share, const model::Sentence &doing)>;
void on_progress(ProgressListener listener);

/// A part of the work while it lives: what is reported meanwhile is a share of this part. Parts lie
/// within one another. Not for several threads.
class Stage {
  public:
    /// @param doing    what is done, as in "motions in time"
    /// @param from,to  shares of the part around it that it begins and ends at
    Stage(const model::Sentence &doing, double from, double to);
    ~Stage();
    Stage(const Stage &) = delete;
    Stage &operator=(const Stage &) = delete;
    Stage(Stage &&) = delete;
    Stage &operator=(Stage &&) = delete;

  private:
    double _from, _to;      ///< of the part around it
    model::Sentence _doing; ///< of the part around it
};

/// The share of the present part that is done, 0..1.
void report_progress(double share);

} // namespace whirl::process
