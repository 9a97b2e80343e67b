#pragma once

#include "process/child.h"
#include "report/common/gnuplot.h"

#include <map>
#include <string>
#include <vector>

namespace whirl::report {

/// Runs gnuplot processes side by side with the caller.
///
/// start() returns at once; finish() waits. The script goes in as standard input and the picture
/// comes out of standard output into memory, so no name and no title ever passes through a shell,
/// and no file exists before its picture is known to be whole.
class PlotJobs {
  public:
    /// @param patience  s that gnuplot may take from one finished picture to the next
    explicit PlotJobs(double patience = patience_asked_for());

    /// Starts drawing the picture of this name, a file's.
    /// @returns false where gnuplot is not installed.
    /// @throws model::AnalysisFailure where it cannot be started for another reason.
    bool start(const Figure &figure, PictureFormat format, const std::string &name);
    /// Waits for all pictures that were started. @returns them by name
    /// @throws model::AnalysisFailure where one is not drawn, in gnuplot's own words, not whole, or
    ///         not in time
    [[nodiscard]] std::map<std::string, std::string> finish();

    /// Of the environment variable WHIRL_GNUPLOT_SECONDS, or 30.
    [[nodiscard]] static double patience_asked_for();

  private:
    struct Job {
        process::Child gnuplot;
        std::string name;
        PictureFormat format;
        int width, height;
    };
    double _patience;
    std::vector<Job> _jobs;
};

/// What keeps this from being the whole picture, in words; nothing where it is: an SVG that is
/// well formed from its root to its end, a PNG of this size whose parts are all there.
[[nodiscard]] std::string picture_fault(const std::string &content, PictureFormat format, int width,
                                        int height);

} // namespace whirl::report
