#include "operation/standard_unbalance.h"

#include "model/mass.h"
#include "model/rpm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace whirl::operation {

namespace {

/// A loop of a shape: where it deflects most.
struct Loop {
    double z = 0;
    double w = 0;
};

/// The largest |w| about a station, by the parabola through it and its neighbours.
Loop top_about(const PlaneShape &shape, std::size_t i, double from, double to) {
    const Loop here{shape.z[i], shape.w[i]};
    if (i == 0 || i + 1 == shape.z.size() || shape.z[i] <= from || shape.z[i] >= to)
        return here;
    const double left = shape.z[i - 1] - here.z;
    const double right = shape.z[i + 1] - here.z;
    if (left >= 0 || right <= 0)
        return here;
    const double slope_left = (shape.w[i - 1] - here.w) / left;
    const double slope_right = (shape.w[i + 1] - here.w) / right;
    const double curvature = (slope_right - slope_left) / (right - left);
    const double slope = slope_left - curvature * left;
    if (curvature == 0)
        return here;
    const double off = std::clamp(-slope / (2 * curvature), left, right);
    return {here.z + off, here.w + off * (slope + off * curvature)};
}

/// The station between two places that deflects most.
Loop largest_between(const PlaneShape &shape, double from, double to) {
    Loop largest{from, 0};
    for (std::size_t i = 0; i < shape.z.size(); ++i)
        if (shape.z[i] >= from && shape.z[i] <= to && std::abs(shape.w[i]) > std::abs(largest.w))
            largest = {shape.z[i], shape.w[i]};
    return largest;
}

/// Loops between two places, of alternating sides.
std::vector<Loop> loops_between(const PlaneShape &shape, double from, double to) {
    constexpr double next_to_nothing = 0.1; // of the largest one: a node beside a bearing
    const double least = next_to_nothing * std::abs(largest_between(shape, from, to).w);
    std::vector<std::size_t> largest; // station of each loop
    for (std::size_t i = 0; i < shape.z.size(); ++i) {
        if (shape.z[i] < from || shape.z[i] > to || !(std::abs(shape.w[i]) >= least) ||
            shape.w[i] == 0)
            continue;
        if (largest.empty() || (shape.w[largest.back()] > 0) != (shape.w[i] > 0))
            largest.push_back(i);
        else if (std::abs(shape.w[i]) > std::abs(shape.w[largest.back()]))
            largest.back() = i;
    }
    std::vector<Loop> loops;
    for (const std::size_t i : largest)
        loops.push_back(top_about(shape, i, from, to));
    return loops;
}

/// The rotor on its two bearings.
class Span {
  public:
    explicit Span(const model::Rotor &rotor) : _rotor(rotor) {
        const auto supports = rotor.supports();
        std::tie(_left, _right) = std::minmax(supports[0].z, supports[1].z);
        _end = rotor.shaft.length();
        const model::MassBetween whole = model::mass_between(_rotor, -infinite, infinite);
        _mass = whole.mass;
        _on_right = (whole.moment - whole.mass * _left) / (_right - _left);
        _places = {0, _end};
        double z = 0;
        for (const model::Segment &segment : rotor.shaft.segments)
            _places.push_back(z += segment.length);
        for (const model::Disc &disc : rotor.discs)
            _places.push_back(disc.z);
        for (const model::Bearing &bearing : rotor.bearings)
            _places.push_back(bearing.z);
        for (const model::Probe &probe : rotor.probes)
            _places.push_back(probe.z);
    }

    [[nodiscard]] double left() const { return _left; }
    [[nodiscard]] double right() const { return _right; }
    [[nodiscard]] double end() const { return _end; }
    [[nodiscard]] double length() const { return _right - _left; }

    // Masses whose weight a journal carries, kg: moments about the other one.
    [[nodiscard]] double on_both() const { return _mass; }
    [[nodiscard]] double on_left() const { return std::abs(_mass - _on_right); }
    [[nodiscard]] double on_right() const { return std::abs(_on_right); }
    [[nodiscard]] double overhung(bool left) const {
        return left ? model::mass_between(_rotor, -infinite, _left).mass
                    : model::mass_between(_rotor, _right, infinite).mass;
    }

    /// As good as in one of the two, where nobody sets a weight.
    [[nodiscard]] bool in_journal(double z) const {
        constexpr double next = 0.05; // of the span
        return std::min(std::abs(z - _left), std::abs(z - _right)) <= next * length();
    }

    /// Where something is, if that is next to z.
    [[nodiscard]] double place_at(double z) const {
        constexpr double next = 0.005; // of the shaft
        const double nearest = *std::ranges::min_element(
            _places, {}, [z](double place) { return std::abs(place - z); });
        return std::abs(nearest - z) <= next * _end ? nearest : z;
    }

  private:
    static constexpr double infinite = std::numeric_limits<double>::infinity();
    const model::Rotor &_rotor;
    double _left = 0, _right = 0, _end = 0;
    double _mass = 0, _on_right = 0;
    std::vector<double> _places;
};

std::string bending_name(std::size_t loops) {
    static constexpr std::array words{"first", "second", "third", "fourth", "fifth", "sixth"};
    return loops <= words.size() ? std::string(words.at(loops - 1)) + " bending"
                                 : "bending with " + std::to_string(loops) + " loops";
}

/// Twice the residual one (API 617, forced response).
model::Imbalance weight(const Span &span, double z, double mass, double fastest, bool opposite) {
    constexpr double times = 2;
    model::Imbalance one;
    one.z = span.place_at(z);
    one.mr = times * api617_residual(mass, fastest);
    one.phase = opposite ? std::numbers::pi : 0;
    return one;
}

/// Adds imbalances, or to those that are as good as the same.
void add_placed(std::vector<PlacedUnbalance> &all, const std::string &name,
                std::vector<model::Imbalance> imbalances, double speed, double near) {
    int number = 1;
    for (PlacedUnbalance &placed : all) {
        if (placed.name != name && !placed.name.starts_with(name + " "))
            continue;
        ++number;
        bool same = true;
        for (std::size_t i = 0; i < imbalances.size(); ++i)
            same = same && std::abs(placed.imbalances[i].z - imbalances[i].z) <= near;
        if (same) {
            placed.critical_speeds.push_back(speed);
            return;
        }
    }
    all.push_back(
        {number == 1 ? name : name + " " + std::to_string(number), std::move(imbalances), {speed}});
    for (model::Imbalance &imbalance : all.back().imbalances)
        imbalance.name = all.back().name;
}

} // namespace

double api617_residual(double mass, double fastest) {
    constexpr double quarter_inch = 6.35e-3; // m
    return quarter_inch * mass / (fastest * model::rpm);
}

std::vector<PlacedUnbalance> api617_unbalance(const model::Rotor &rotor, double fastest,
                                              const std::vector<PlaneShape> &shapes) {
    constexpr double hardly = 0.25; // of the largest deflection: the span takes no part
    constexpr double near = 0.02;   // of the span
    const Span span(rotor);
    std::vector<PlacedUnbalance> all;
    std::vector<PlaneShape> ascending = shapes;
    std::ranges::sort(ascending, {}, &PlaneShape::speed);
    for (const PlaneShape &shape : ascending) {
        const double between = std::abs(largest_between(shape, span.left(), span.right()).w);
        const double most = std::abs(largest_between(shape, 0, span.end()).w);
        if (!(most > 0))
            continue;
        const auto add = [&](const std::string &name, std::vector<model::Imbalance> imbalances) {
            add_placed(all, name, std::move(imbalances), shape.speed, near * span.length());
        };
        if (between >= hardly * most) {
            const std::vector<Loop> loops = loops_between(shape, span.left(), span.right());
            std::vector<model::Imbalance> imbalances;
            const auto count = static_cast<double>(loops.size());
            for (std::size_t i = 0; i < loops.size(); ++i) {
                const double middle = // of the i-th of equal parts: mid-span, quarter-span
                    span.left() + (static_cast<double>(i) + 0.5) / count * span.length();
                const double mass = loops.size() == 2 ? (i == 0 ? span.on_left() : span.on_right())
                                                      : span.on_both() / count;
                imbalances.push_back(weight(span, span.in_journal(loops[i].z) ? middle : loops[i].z,
                                            mass, fastest, i % 2 == 1));
            }
            add(bending_name(loops.size()), std::move(imbalances));
        }
        for (const bool left : {true, false}) {
            const Loop top = left ? largest_between(shape, 0, span.left())
                                  : largest_between(shape, span.right(), span.end());
            const double mass = span.overhung(left);
            if (std::abs(top.w) > between && mass > 0)
                add(left ? "overhung left" : "overhung right",
                    {weight(span, top.z, mass, fastest, false)});
        }
    }
    return all;
}

} // namespace whirl::operation
