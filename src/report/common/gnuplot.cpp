#include "report/common/gnuplot.h"

#include "model/errors.h"
#include "report/common/text_width.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

extern char **environ;

namespace whirl::report {

namespace {

[[noreturn]] void fail(const std::string &what) {
    throw model::AnalysisFailure("picture: " + what);
}

/// A file without a name that lives as long as its descriptor.
int nameless_file() {
    const int descriptor = memfd_create("whirl-plot", MFD_CLOEXEC);
    if (descriptor < 0)
        fail(fmt::format("no temporary file: {}", std::strerror(errno)));
    return descriptor;
}

void write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written < 0 && errno != EINTR)
            fail(fmt::format("cannot hand over the plot data: {}", std::strerror(errno)));
        text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
    }
    lseek(descriptor, 0, SEEK_SET);
}

std::string read_all(int descriptor) {
    std::string text(4096, '\0');
    const ssize_t count = pread(descriptor, text.data(), text.size(), 0);
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
}

std::string terminal(const Figure &figure, PictureFormat format) {
    // pngcairo's time grows with the pixels: 1200 x 840 cost 0.07 s, the SVG 0.02 s.
    // Sizes of letters are pixels in the SVG but points, of 4/3 pixels, in the PNG: scaled there,
    // so that those that a figure gives itself are the same in both.
    const bool svg = format == PictureFormat::svg;
    return fmt::format("set encoding utf8\nset terminal {} size {},{} background '#ffffff' "
                       "font '{},14' {} enhanced dashlength 1\n",
                       svg ? "svg" : "pngcairo", figure.width, figure.height,
                       svg ? "DejaVu Sans, Arial, sans-serif" : "DejaVu Sans",
                       svg ? "" : "fontscale 0.75");
}

/// Commands, without texts, whose points have about the sizes they have in a PNG: gnuplot draws a
/// point of size 2 in an SVG 24 pixels wide, in a PNG 13, and the figures keep their labels off the
/// latter. A little larger, for the lines of hollow ones are thinner there.
std::string with_points_as_in_png(const std::string &commands) {
    constexpr double png_over_svg = 1.25 * 13.0 / 24.0;
    constexpr std::string_view word = " ps ";
    std::string out;
    std::size_t from = 0;
    for (std::size_t at = commands.find(word); at != std::string::npos;
         at = commands.find(word, from)) {
        const char *number = commands.c_str() + at + word.size();
        char *end = nullptr;
        const double size = std::strtod(number, &end);
        out.append(commands, from, at + word.size() - from);
        from = at + word.size();
        if (end == number)
            continue;
        out += fmt::format("{:.4g}", png_over_svg * size);
        from += static_cast<std::size_t>(end - number);
    }
    return out.append(commands, from);
}

/// A text of plot_text so that gnuplot makes valid SVG of it that says the same: it leaves entities
/// such as "&#x41;" and "]]>" as they are.
std::string for_svg(std::string text) {
    for (const auto &[from, to] :
         {std::pair("\\0046\\0043x", "\\0046\\0043x26;\\0043x"),            // &#x
          std::pair("\\0135\\0135\\0076", "\\0135\\0135\\0046\\0043x3e;")}) // ]]>
        for (std::size_t at = text.find(from); at != std::string::npos;
             at = text.find(from, at + std::strlen(to)))
            text.replace(at, std::strlen(from), to);
    return text;
}

/// The script as it is handed over.
std::string handed_over(const std::string &script, PictureFormat format) {
    if (format == PictureFormat::png)
        return script;
    std::string out;
    bool text = false;
    for (std::size_t from = 0; from <= script.size(); text = !text) {
        const std::size_t to = std::min(script.find('"', from), script.size());
        const std::string piece = script.substr(from, to - from);
        out += text ? for_svg(piece) : with_points_as_in_png(piece);
        out += to < script.size() ? "\"" : "";
        from = to + 1;
    }
    return out;
}

/// posix_spawn of gnuplot with the three standard streams given; 0 or errno.
int spawn(pid_t &process, int input, const std::string &output, int errors) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    std::string program = "gnuplot";
    std::string plain = "--default-settings"; // the user's own gnuplotrc must not change a report
    char *arguments[] = {program.data(), plain.data(), nullptr};
    const int status =
        posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return status;
}

} // namespace

PlotJobs::~PlotJobs() {
    for (const Job &job : _jobs) {
        kill(job.process, SIGKILL);
        waitpid(job.process, nullptr, 0);
        close(job.errors);
    }
}

bool PlotJobs::start(const Figure &figure, PictureFormat format,
                     const std::filesystem::path &file) {
    const int input = nameless_file();
    const int errors = nameless_file();
    Job job{0, errors, file};
    write_all(input, terminal(figure, format) + handed_over(figure.script, format));
    const int status = spawn(job.process, input, file.string(), errors);
    close(input);
    if (status == 0) {
        _jobs.push_back(job);
        return true;
    }
    close(errors);
    if (status != ENOENT)
        fail(fmt::format("gnuplot did not start: {}", std::strerror(status)));
    return false;
}

void PlotJobs::finish() {
    while (!_jobs.empty()) {
        const Job job = _jobs.back();
        _jobs.pop_back();
        int status = 0;
        while (waitpid(job.process, &status, 0) < 0 && errno == EINTR) {
        }
        const std::string words = read_all(job.errors);
        close(job.errors);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
            fail(fmt::format("gnuplot could not draw {}:\n{}", job.file.string(), words));
    }
}

std::string plot_text(const std::string &text) {
    std::string quoted = "\"";
    for (const char letter : printable(text)) {
        const auto byte = static_cast<unsigned char>(letter);
        const bool plain =
            byte >= 0x80 || std::isalnum(byte) != 0 || std::strchr(" .,:;()+-=/", byte) != nullptr;
        quoted += plain ? std::string(1, letter) : fmt::format("\\0{:03o}", byte);
    }
    return quoted + "\" noenhanced";
}

} // namespace whirl::report
