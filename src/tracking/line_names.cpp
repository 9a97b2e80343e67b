#include "tracking/line_names.h"

#include "tracking/followed_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

namespace whirl::tracking {

namespace {

using Places = std::vector<std::size_t>;

bool there(const Line &line, std::size_t speed) { return line.place[speed] != Line::absent; }

/// The sense that a line has at most of these speeds; no clear one is mixed.
results::Whirl usual_whirl(const Line &line, const std::vector<modes::Spectrum> &spectra,
                           const Places &speeds) {
    std::array<int, 3> votes{};
    for (const std::size_t k : speeds)
        if (there(line, k))
            ++votes[static_cast<std::size_t>(
                spectra[k].modes[static_cast<std::size_t>(line.place[k])].whirl)];
    const auto of = [&votes](results::Whirl whirl) {
        return votes[static_cast<std::size_t>(whirl)];
    };
    const int forward = of(results::Whirl::forward);
    const int backward = of(results::Whirl::backward);
    const int mixed = of(results::Whirl::mixed);
    if (mixed >= forward && mixed >= backward)
        return results::Whirl::mixed;
    return forward >= backward ? results::Whirl::forward : results::Whirl::backward;
}

char letter(results::Whirl whirl) {
    return whirl == results::Whirl::forward ? 'F' : whirl == results::Whirl::backward ? 'B' : 'M';
}

/// The first of these speeds at which the line is there, and its place there.
std::optional<std::pair<std::size_t, int>> beginning(const Line &line, const Places &speeds) {
    const auto first = std::find_if(speeds.begin(), speeds.end(),
                                    [&line](std::size_t k) { return there(line, k); });
    if (first == speeds.end())
        return std::nullopt;
    return std::pair(*first, line.place[*first]);
}

/// The line is there from the first speed on, or begins where a motion begins to whirl; not in the
/// middle of one that could not be followed.
bool whole(const Line &line) {
    const auto first = std::find_if(line.place.begin(), line.place.end(),
                                    [](int place) { return place != Line::absent; });
    if (first == line.place.begin())
        return true;
    const Absence before = line.absence[static_cast<std::size_t>(first - line.place.begin()) - 1];
    return before != Absence::beyond && before != Absence::lost;
}

/// Gives out names in the order of the lines.
class Naming {
  public:
    Naming(const std::vector<Line> &lines, const std::vector<modes::Spectrum> &spectra)
        : _lines(lines), _spectra(spectra), names(lines.size()) {}

    /// Those of these lines that have none yet, by their beginning at the speeds.
    void name(Places which, const Places &speeds) {
        const auto begins = [&](std::size_t i) { return beginning(_lines[i], speeds); };
        which.erase(
            std::remove_if(which.begin(), which.end(),
                           [&](std::size_t i) { return !names[i].label.empty() || !begins(i); }),
            which.end());
        std::stable_sort(which.begin(), which.end(),
                         [&](std::size_t a, std::size_t b) { return *begins(a) < *begins(b); });
        for (const std::size_t i : which) {
            const results::Whirl whirl = usual_whirl(_lines[i], _spectra, speeds);
            const auto sense = static_cast<std::size_t>(whirl);
            // Numbers after that of a piece of a line are as unsure as its own.
            _sure[sense] = _sure[sense] && (there(_lines[i], speeds.front()) || whole(_lines[i]));
            names[i] = {fmt::format("{}{}", ++_counts[sense], letter(whirl)), _sure[sense]};
        }
    }

  private:
    const std::vector<Line> &_lines;
    const std::vector<modes::Spectrum> &_spectra;
    std::array<int, 3> _counts{};
    std::array<bool, 3> _sure{true, true, true};

  public:
    std::vector<LineName> names;
};

} // namespace

std::vector<std::size_t> naming_places(std::size_t count) {
    constexpr std::size_t most = 11;
    Places out;
    for (std::size_t i = 0; i < std::min(count, most); ++i)
        out.push_back(count <= most ? i : (2 * i * (count - 1) + most - 1) / (2 * (most - 1)));
    return out;
}

std::vector<LineName> line_names(const std::vector<Line> &lines,
                                 const std::vector<modes::Spectrum> &spectra,
                                 const std::vector<std::size_t> &naming, int modes, bool all) {
    Places named;
    Places others;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto low = [&, i](std::size_t k) {
            return there(lines[i], k) && lines[i].place[k] < modes;
        };
        if (std::any_of(naming.begin(), naming.end(), low))
            named.push_back(i);
        else if (all && among_lowest(lines[i], modes))
            others.push_back(i);
    }
    Naming out(lines, spectra);
    out.name(named, naming);
    if (!others.empty()) {
        Places speeds(spectra.size());
        std::iota(speeds.begin(), speeds.end(), std::size_t{0});
        out.name(others, speeds);
        for (const std::size_t i : others)
            out.names[i].sure = false;
    }
    return std::move(out.names);
}

} // namespace whirl::tracking
