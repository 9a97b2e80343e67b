#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace whirl::report {

/// A picture as gnuplot commands, without terminal and output.
struct Figure {
    std::string script; ///< with its data as named data blocks
    int width = 1200;   ///< of the PNG, pixels; the SVG is drawn in the same units
    int height = 800;
    bool in_units = false; ///< its numbers and labels are already in the units of its readers
};

enum class PictureFormat { svg, png };

/// Runs gnuplot processes side by side with the caller.
///
/// start() returns at once; finish() waits. The script goes in as standard input and the picture
/// comes out of standard output, so no name and no title ever passes through a shell.
class PlotJobs {
  public:
    PlotJobs() = default;
    ~PlotJobs(); ///< stops what still runs
    PlotJobs(const PlotJobs &) = delete;
    PlotJobs &operator=(const PlotJobs &) = delete;

    /// Starts drawing into `file`, which the caller renames when finish() has returned.
    /// @returns false where gnuplot is not installed.
    /// @throws model::AnalysisFailure where it cannot be started for another reason.
    bool start(const Figure &figure, PictureFormat format, const std::filesystem::path &file);
    /// Waits for all pictures. @throws model::AnalysisFailure with gnuplot's own words.
    void finish();

  private:
    struct Job {
        pid_t process = 0;
        int errors = -1; ///< descriptor of the file that holds gnuplot's messages
        std::filesystem::path file;
    };
    std::vector<Job> _jobs;
};

/// Text as a gnuplot string that is shown letter by letter: quotes doubled, control characters
/// blanked, markup off.
[[nodiscard]] std::string plot_text(const std::string &text);

} // namespace whirl::report
