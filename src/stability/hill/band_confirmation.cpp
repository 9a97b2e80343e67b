#include "stability/hill/band_confirmation.h"

#include "stability/hill/periodic_motions.h"

#include <algorithm>
#include <cmath>

namespace whirl::stability {

namespace {

double growth(const MotionsAt &at, double speed) { return growth_of(at(speed)); }

/// The end that lies near `end` for the whole rotor, `inward` (sign) the way into the band.
std::optional<double> end_near(const MotionsAt &at, double end, double inward, double width,
                               double beyond) {
    for (const double share : {1e-7, 1e-5, 1e-3}) {
        const double step = share * std::abs(end);
        const double inside = end + inward * std::min(step, width / 4);
        const double outside = end - inward * std::min(step, beyond / 4);
        if (growth(at, inside) > 0 && growth(at, outside) <= 0)
            return band_end(at, outside, inside, 1e-12 * std::abs(end));
    }
    return std::nullopt;
}

/// Verifies bands of the reduced rotor on the whole one; nothing where they differ.
class Confirmation {
  public:
    Confirmation(const MotionsAt &at, const std::vector<results::Interval> &bands,
                 const results::Interval &range, const PeriodicMotions *periodic)
        : _at(at), _bands(bands), _front(range.from), _back(range.to), _periodic(periodic) {}

    [[nodiscard]] std::optional<std::vector<results::Interval>> bands() const {
        std::vector<results::Interval> out;
        double last = _front; // the end of the band before
        for (std::size_t i = 0; i < _bands.size(); ++i) {
            const double next = i + 1 < _bands.size() ? _bands[i + 1].from : _back;
            const std::optional<std::vector<results::Interval>> found = of(_bands[i], last, next);
            if (!found)
                return std::nullopt;
            if (found->empty())
                continue;
            if (grows_between(last, found->front().from))
                return std::nullopt;
            out.insert(out.end(), found->begin(), found->end());
            last = out.back().to;
        }
        if (grows_between(last, _back))
            return std::nullopt;
        return without_slits(joined(out));
    }

  private:
    const MotionsAt &_at;
    const std::vector<results::Interval> &_bands;
    double _front, _back;
    const PeriodicMotions *_periodic;

    /// Bands with a minute gap in which nothing decays are one: at its ends the growth of an
    /// undamped rotor comes and goes with the rounding.
    [[nodiscard]] std::vector<results::Interval>
    without_slits(const std::vector<results::Interval> &bands) const {
        constexpr double slit = 1e-7; // of the speed: what rounding of an undamped end can open
        std::vector<results::Interval> out;
        for (const results::Interval &band : bands) {
            const bool close =
                !out.empty() && band.from - out.back().to <= slit * std::abs(band.from);
            if (close && growth(_at, (band.from + out.back().to) / 2) >= 0)
                out.back().to = band.to;
            else
                out.push_back(band);
        }
        return out;
    }

    [[nodiscard]] bool grows_between(double from, double to) const {
        return to > from && growth(_at, (from + to) / 2) > 0;
    }

    /// An end where the growth passes zero with a slope, by Newton's method from inside the band,
    /// where its own motion grows most.
    [[nodiscard]] std::optional<double> root_near(double end, double inward, double width,
                                                  double beyond) const {
        if (_periodic == nullptr)
            return std::nullopt;
        constexpr double inside = 2e-3; // ends of the reduced rotor are half as far off at most
        const auto found =
            _periodic->neutral_next_to(end + inside * inward * width, std::min(width, beyond) / 4);
        return found && inward * found->slope > 0 ? std::optional(found->speed) : std::nullopt;
    }

    /// The band between the ends that lie near its own as `near` finds them.
    /// @param last, next  where other bands end and begin
    template <class Near>
    [[nodiscard]] std::optional<results::Interval>
    between(const results::Interval &band, double last, double next, const Near &near) const {
        const auto [from, to] = band;
        std::optional<double> low = from;
        std::optional<double> high = to;
        if (from > _front)
            low = near(from, 1, to - from, from - last);
        if (low && to < _back)
            high = near(to, -1, to - from, next - to);
        return low && high && growth(_at, (*low + *high) / 2) > 0
                   ? std::optional(results::Interval{*low, *high})
                   : std::nullopt;
    }

    /// @returns nothing where the whole rotor does not agree; it can have none of a narrow one
    [[nodiscard]] std::optional<std::vector<results::Interval>> of(const results::Interval &band,
                                                                   double last, double next) const {
        const auto root = [this](auto... end) { return root_near(end...); };
        if (const auto found = between(band, last, next, root))
            return {{*found}};
        constexpr double narrow = 1e-3; // of the speed: a narrower one may close on the whole rotor
        const auto [from, to] = band;
        if (to - from < narrow * std::max(std::abs(from), std::abs(to)))
            return of_narrow(band, last, next);
        const auto by_probes = [this](auto... end) { return end_near(_at, end...); };
        if (const auto found = between(band, last, next, by_probes))
            return {{*found}};
        return std::nullopt;
    }

    /// By a search of its own around it.
    [[nodiscard]] std::vector<results::Interval> of_narrow(const results::Interval &band,
                                                           double last, double next) const {
        const double middle = (band.from + band.to) / 2;
        constexpr double close_by = 1e-6; // ten times what eigenvalues agree to
        const double around = std::max(4 * (band.to - band.from), close_by * std::abs(middle));
        const double low = std::max({_front, middle - around, (band.from + last) / 2});
        const double high = std::min({_back, middle + around, (band.to + next) / 2});
        if (growth(_at, middle) > 0)
            return {band_around(_at, middle, (band.to - band.from) / 2, {low, high})};
        std::vector<double> speeds{low, band.from, middle, band.to, high};
        speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end()); // at a border
        return unstable_bands(_at, speeds);
    }
};

} // namespace

std::optional<std::vector<results::Interval>>
confirmed_bands(const MotionsAt &at, const std::vector<results::Interval> &bands,
                const results::Interval &range, const PeriodicMotions *periodic) {
    return Confirmation(at, bands, range, periodic).bands();
}

} // namespace whirl::stability
