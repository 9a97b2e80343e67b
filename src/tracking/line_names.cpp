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
    const auto first =
        std::ranges::find_if(speeds, [&line](std::size_t k) { return there(line, k); });
    if (first == speeds.end())
        return std::nullopt;
    return std::pair(*first, line.place[*first]);
}

/// The line is there from the first speed on, or begins where a motion begins to whirl; not in the
/// middle of one that could not be followed.
bool whole(const Line &line) {
    const auto first =
        std::ranges::find_if(line.place, [](int place) { return place != Line::absent; });
    if (first == line.place.begin())
        return true;
    const Absence before = line.absence[static_cast<std::size_t>(first - line.place.begin()) - 1];
    return before != Absence::beyond && before != Absence::lost;
}

/// Gives out the names of one series, in the order of the lines.
class Series {
  public:
    /// @param prefix  of its names
    Series(const std::vector<Line> &lines, const std::vector<modes::Spectrum> &spectra,
           const char *prefix)
        : _lines(lines), _spectra(spectra), _prefix(prefix) {}

    /// Those of these lines, by their beginning at the speeds.
    void name(Places which, const Places &speeds, std::vector<LineName> &names) {
        const auto begins = [&](std::size_t i) { return *beginning(_lines[i], speeds); };
        std::ranges::stable_sort(which, {}, begins);
        for (const std::size_t i : which) {
            const results::Whirl whirl = usual_whirl(_lines[i], _spectra, speeds);
            const auto sense = static_cast<std::size_t>(whirl);
            // Numbers after that of a piece of a line are as unsure as its own.
            _sure[sense] = _sure[sense] && (there(_lines[i], speeds.front()) || whole(_lines[i]));
            names[i] = {fmt::format("{}{}{}", _prefix, ++_counts[sense], letter(whirl)),
                        _sure[sense]};
        }
    }

  private:
    const std::vector<Line> &_lines;
    const std::vector<modes::Spectrum> &_spectra;
    const char *_prefix;
    std::array<int, 3> _counts{};
    std::array<bool, 3> _sure{true, true, true};
};

} // namespace

std::vector<double> naming_speeds(const model::SpeedRange &range) {
    if (range.count == 1)
        return {range.from};
    constexpr std::size_t steps = 10; // names must not depend on the number of speeds asked for
    const std::vector<double> own = range.values();
    const double last = static_cast<double>(steps);
    std::vector<double> out;
    for (std::size_t i = 0; i <= steps; ++i) {
        const std::size_t place = i * (own.size() - 1);
        // The same numbers where they are among those asked for, not their neighbours by rounding.
        out.push_back(place % steps == 0
                          ? own[place / steps]
                          : range.from + (range.to - range.from) * static_cast<double>(i) / last);
    }
    return out;
}

std::vector<double> followed_speeds(const model::Rotor &rotor, const model::SpeedRange &range) {
    // Rows that are followed, each a spectrum; longer tables are thinned evenly.
    constexpr std::size_t most_rows = 40;
    std::vector<double> rows = rotor.table_bends();
    std::erase_if(rows, [&range](double row) {
        return range.count == 1 || row <= std::min(range.from, range.to) ||
               row >= std::max(range.from, range.to);
    });
    const std::size_t every = rows.size() / most_rows + 1;
    std::vector<double> out = naming_speeds(range);
    for (std::size_t i = 0; i < rows.size(); i += every)
        out.push_back(rows[i]);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

std::vector<LineName> line_names(const std::vector<Line> &lines,
                                 const std::vector<modes::Spectrum> &spectra,
                                 const std::vector<std::size_t> &naming, int modes) {
    const std::vector<char> anywhere = among_lowest(lines, spectra, modes);
    std::vector<modes::Spectrum> at_naming;
    std::vector<Line> naming_lines(lines.size());
    for (const std::size_t k : naming) {
        at_naming.push_back(spectra[k]);
        for (std::size_t i = 0; i < lines.size(); ++i)
            naming_lines[i].place.push_back(lines[i].place[k]);
    }
    const std::vector<char> at_some = among_lowest(naming_lines, at_naming, modes);
    Places first; // all that are there, so that more modes change no number
    Places late;  // only those of the lowest: how many more are computed is not the same everywhere
    Places higher; // of the lowest between the naming speeds alone
    Places others; // that are there between them alone
    Places more;   // followed beside these
    Places unsure;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool low = at_some[i] != 0;
        if (there(lines[i], naming.front()))
            first.push_back(i);
        else if (low)
            late.push_back(i);
        else if (anywhere[i] != 0)
            (beginning(lines[i], naming) ? higher : others).push_back(i);
        else
            more.push_back(i);
        if (!low)
            unsure.push_back(i);
    }
    std::vector<LineName> names(lines.size());
    Series(lines, spectra, "").name(first, naming, names);
    Series later(lines, spectra, "e");
    later.name(late, naming, names);
    later.name(higher, naming, names);
    Places all(spectra.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    later.name(others, all, names);
    later.name(more, all, names);
    for (const std::size_t i : unsure)
        names[i].sure = false;
    return names;
}

} // namespace whirl::tracking
