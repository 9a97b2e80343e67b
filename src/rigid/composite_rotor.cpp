#include "rigid/composite_rotor.h"

#include "balancers/balanced_position.h"
#include "balancers/held.h"
#include "balancers/kind.h"
#include "model/errors.h"
#include "rigid/projection.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

namespace whirl::rigid {

namespace {

using std::numbers::pi;

/// A difference of terms of that size that is their rounding alone is none.
double without_rounding(double difference, double terms) {
    return difference <= 4 * std::numeric_limits<double>::epsilon() * terms ? 0 : difference;
}

/// An anisotropy below that share of the mean inertia is rounding.
constexpr double nothing_of_inertia = 1e-14;

/// A balancer of the case, free or held.
struct Placed {
    const model::Balancer *balancer;
    const model::HeldBalancer *held; ///< null: free
    std::string label;               ///< "balancer[0]"

    [[nodiscard]] std::unique_ptr<balancers::Kind> kind() const {
        return balancers::kind_of(*balancer);
    }
    /// Of the parts where they are held; of free ones at rest, whose second moment depends on the
    /// balanced position.
    [[nodiscard]] balancers::HeldParts parts() const {
        if (held)
            return kind()->held(held->angles);
        const balancers::PartsInertia inertia = kind()->inertia();
        return {inertia.mass, inertia.on_circle, inertia.own, 0, 0};
    }
    /// A_m and A_m0, kg m2: 0 without tilt inertia.
    [[nodiscard]] std::pair<double, double> inertias() const {
        if (!balancer->tilt_inertia)
            return {0, 0};
        return {parts().on_circle, balancers::imbalance_inertia(*balancer)};
    }
    /// Parts and point-mass imbalance as a body of the rotor.
    [[nodiscard]] Inertia body() const {
        if (!held)
            return inertia_of(*balancer);
        const model::Disc disc = balancers::held_masses(*balancer, held->angles).disc;
        return {disc.mass, disc.mass * disc.z, disc.mass * disc.z * disc.z + disc.Id, disc.Ip, 0};
    }
};

/// In the order of the case file.
std::vector<Placed> all_balancers(const model::Rotor &rotor) {
    std::vector<Placed> all;
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
        all.push_back({&rotor.balancers[i], nullptr, rotor.balancer_path(i)});
    for (const model::HeldBalancer &one : rotor.held)
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(one.index),
                   {&one.balancer, &one, fmt::format("balancer[{}]", one.index)});
    return all;
}

/// One balancer, its point-mass imbalance and the rest of the rotor, for the closed forms.
struct Parts {
    closed_form::BareRotor rest;
    closed_form::BallSet balls;
    closed_form::PlaneImbalance imbalance;
    double center = 0; ///< of the composite rotor, m
};

Parts parts_of(const Placed &placed, const Inertia &whole) {
    const model::Balancer &balancer = *placed.balancer;
    const balancers::HeldParts masses = placed.parts();
    Inertia rest = whole;
    rest -= placed.body();
    if (balancer.tilt_inertia) // of bodies about axes of their own: the closed forms know points
        rest += {0, 0, masses.own / 2, masses.own, 0};
    Parts parts;
    parts.center = whole.center();
    parts.rest = {rest.mass, rest.diametral(), rest.polar, balancer.z - rest.center()};
    // One ball that stands for all of them.
    parts.balls = {1, masses.mass, std::sqrt(masses.on_circle / masses.mass)};
    parts.imbalance = {balancer.imbalance, balancers::imbalance_mass(balancer)};
    return parts;
}

/// Anisotropy over the mean inertia, with another second harmonic.
double relative_anisotropy(closed_form::CompositeRotor composite, std::complex<double> D) {
    composite.second_harmonic = D;
    const double terms = composite.ball_inertia + composite.imbalance_inertia;
    return without_rounding(std::abs(composite.anisotropy()), terms) / composite.mean_inertia();
}

/// Those that need the bearings. Unit of time sqrt(M/c_x), of mass M, of length sqrt(A/M).
/// @param A  mean diametral inertia about the centre of mass
void add_supports(results::RotorNumbers &numbers, const model::Rotor &rotor, double M, double A,
                  double center, std::string &why) {
    const auto supports = reduced_supports(rotor, center, why);
    if (!supports)
        return;
    const double w0 = std::sqrt(supports->c_x / M);
    const double cross = std::sqrt(M * A);
    numbers.omega_0 = w0;
    numbers.p2 = supports->c_beta / A / (w0 * w0);
    numbers.c_y = supports->c_y / (cross * w0 * w0);
    numbers.h_x = supports->h_x / (M * w0);
    numbers.h_beta = supports->h_beta / (A * w0);
    numbers.h_y = supports->h_y / (cross * w0);
}

results::DimensionlessNumbers dimensionless_numbers(const Parts &parts, const Placed &placed,
                                                    std::optional<std::complex<double>> D,
                                                    const model::Rotor &rotor, std::string &why) {
    // Masses and inertias do not ask for D: any will do.
    const auto composite = composite_rotor(parts.rest, parts.balls, parts.imbalance, D.value_or(0));
    const double M = composite.mass;
    const double A = composite.mean_inertia();
    results::DimensionlessNumbers numbers;
    numbers.rotor.C = composite.polar_inertia / A;
    if (D)
        numbers.rotor.A = relative_anisotropy(composite, *D);
    add_supports(numbers.rotor, rotor, M, A, parts.center, why);
    numbers.A_m = composite.ball_inertia / A;
    numbers.A_m0 = composite.imbalance_inertia / A;
    numbers.m = parts.balls.count * parts.balls.mass / M;
    numbers.z_A = composite.balancer_position / std::sqrt(A / M);
    if (const auto rate = placed.kind()->rate(); rate && !placed.held && numbers.rotor.omega_0)
        numbers.h_s = *rate / *numbers.rotor.omega_0;
    return numbers;
}

/// Diametral inertias about angles 0 and pi/2 over the mean one; the principal ones where D is not
/// real.
results::Interval diametral_pair(const closed_form::CompositeRotor &composite) {
    const double mean = composite.mean_inertia();
    if (std::abs(composite.second_harmonic.imag()) < 1e-12)
        return {composite.inertia_about(0) / mean, composite.inertia_about(pi / 2) / mean};
    const double size = std::abs(composite.anisotropy());
    return {(mean - size) / mean, (mean + size) / mean};
}

void add_point(results::CompositeCurves &curves, const closed_form::CompositeRotor &composite,
               double m) {
    const double mean = composite.mean_inertia();
    const std::complex<double> D = composite.second_harmonic;
    curves.m.push_back(m);
    curves.A_m.push_back(composite.ball_inertia / mean);
    curves.C.push_back(composite.polar_inertia / mean);
    const auto [first, second] = diametral_pair(composite);
    curves.A_C1.push_back(first);
    curves.A_C2.push_back(second);
    const auto [first_paper, second_paper] = diametral_pair(composite.with_unsigned_harmonic());
    curves.A_C1_paper.push_back(first_paper);
    curves.A_C2_paper.push_back(second_paper);
    curves.A.push_back(relative_anisotropy(composite, D));
    curves.A_paper.push_back(relative_anisotropy(composite, std::abs(D)));
    curves.A_without.push_back(relative_anisotropy(composite, 0));
    curves.A_full.push_back(relative_anisotropy(composite, 1));
}

void add_hodograph(results::CompositeCurves &curves, const closed_form::CompositeRotor &composite) {
    constexpr int steps = 240; // points of a closed curve in a figure: smooth on a page
    const double mean = composite.mean_inertia();
    const closed_form::CompositeRotor paper = composite.with_unsigned_harmonic();
    for (int i = 0; i <= steps; ++i) {
        const double angle = 2 * pi * i / steps;
        curves.angle.push_back(angle);
        curves.A_C.push_back(composite.inertia_about(angle) / mean);
        curves.A_C_paper.push_back(paper.inertia_about(angle) / mean);
    }
}

/// Ball and imbalance masses scaled together, so that the capacity stays: n m/M_s from 0 to ten
/// times the case's own value or 0.2, and past that value, but short of a rotor of nothing else.
results::CompositeCurves composite_curves(const Parts &parts, std::complex<double> D,
                                          const std::optional<results::Interval> &anisotropy) {
    constexpr int steps = 100; // points of a curve in a figure
    const double ball_mass = parts.balls.count * parts.balls.mass;
    const double added = 1 + parts.imbalance.mass / ball_mass; // (n m + m0)/(n m)
    const auto composite = composite_rotor(parts.rest, parts.balls, parts.imbalance, D);
    const double own = ball_mass / composite.mass;
    const double widest =
        std::min(std::max(std::min(0.2, 10 * own), 1.25 * own), std::max(own, 0.9 / added));
    results::CompositeCurves curves;
    for (int i = 0; i <= steps; ++i) {
        const double m = widest * i / steps;
        const double scale = m * parts.rest.mass / (1 - m * added) / ball_mass;
        Parts scaled = parts;
        scaled.balls.mass *= scale;
        scaled.imbalance.mass *= scale;
        scaled.imbalance.moment *= scale;
        const auto point = composite_rotor(scaled.rest, scaled.balls, scaled.imbalance, D);
        add_point(curves, point, m);
        if (!anisotropy)
            continue;
        // Both inertias of the plane grow with the scale, and so do the ends of the interval.
        curves.A_least.push_back(anisotropy->from * scale / point.mean_inertia());
        curves.A_largest.push_back(anisotropy->to * scale / point.mean_inertia());
    }
    add_hodograph(curves, composite);
    return curves;
}

/// Ends of an interval of values that are sums of terms of that size.
std::optional<results::Interval> ends(const std::optional<balancers::PositionInterval> &interval,
                                      double terms) {
    if (!interval)
        return std::nullopt;
    return results::Interval{without_rounding(interval->least, terms),
                             without_rounding(interval->largest, terms)};
}

/// Second harmonic D of the parts where they stand, measured from the imbalance, and their angles;
/// a note where they have no such place.
void add_place(results::BalancerNumbers &numbers, const Placed &placed,
               std::vector<results::Sentence> &notes) {
    const model::Balancer &balancer = *placed.balancer;
    const auto kind = placed.kind();
    const bool positions = !kind->circled().empty();
    if (!positions)
        notes.emplace_back(
            model::Weight::information, "{}: inertias are those of the {} {}; E = {}", placed.label,
            kind->parts(), placed.held ? "where they are held" : "at rest", kind->reach().formula);
    if (placed.held) {
        const balancers::HeldParts parts = placed.parts();
        numbers.D =
            parts.second_moment / parts.on_circle * std::polar(1.0, -2 * balancer.imbalance_phase);
        if (positions)
            numbers.position = placed.held->angles;
    } else if (!positions) {
        numbers.D = 0;
    } else {
        try {
            numbers.position = balancers::angles_at_balance(balancer, placed.label);
        } catch (const model::BadInput &none) {
            notes.push_back(none.sentence());
            return;
        }
        numbers.D = balancers::second_harmonic_of(balancer, numbers.position);
        numbers.position = balancers::turned(numbers.position, balancer.imbalance_phase);
    }
    if (without_rounding(std::abs(numbers.D->imag()), 1) == 0)
        numbers.D = numbers.D->real();
}

/// Everything that depends on where the parts stand.
void add_position(results::BalancerNumbers &numbers, const Placed &placed, const Parts &parts,
                  std::vector<results::Sentence> &notes) {
    const model::Balancer &balancer = *placed.balancer;
    add_place(numbers, placed, notes);
    if (!numbers.D)
        return;
    const auto [A_m, A_m0] = placed.inertias();
    numbers.dA = without_rounding(std::abs(A_m0 + A_m * *numbers.D) / 2, A_m0 + A_m);
    numbers.dA_paper = (A_m0 + A_m * std::abs(*numbers.D)) / 2;
    const auto kind = placed.kind();
    if (kind->circled().empty())
        return;
    numbers.D_interval = ends(balancers::second_harmonic_interval(balancer), 1);
    numbers.dA_interval = ends(balancers::anisotropy_interval(balancer), A_m0 + A_m);
    if (!numbers.D_interval && std::ssize(kind->circled()) > balancers::largest_searched_count)
        notes.emplace_back(model::Weight::information,
                           "{}: the intervals over all balanced positions are searched "
                           "for up to {} {}",
                           placed.label, balancers::largest_searched_count, kind->parts());
    numbers.curves = composite_curves(parts, *numbers.D, numbers.dA_interval);
}

} // namespace

std::vector<results::BalancerNumbers> show_balancers(const model::Rotor &rotor,
                                                     const Inertia &whole,
                                                     std::vector<results::Sentence> &notes) {
    std::vector<results::BalancerNumbers> all;
    std::string why;
    for (const Placed &placed : all_balancers(rotor)) {
        const Parts parts = parts_of(placed, whole);
        results::BalancerNumbers numbers;
        numbers.name = placed.balancer->name;
        numbers.z = placed.balancer->z;
        numbers.E = balancers::capacity(*placed.balancer);
        numbers.held = placed.held != nullptr;
        numbers.bare = {parts.rest.mass, parts.rest.diametral_inertia, parts.rest.polar_inertia,
                        parts.rest.balancer_distance};
        add_position(numbers, placed, parts, notes);
        numbers.dimensionless = dimensionless_numbers(parts, placed, numbers.D, rotor, why);
        all.push_back(numbers);
    }
    if (!why.empty())
        notes.emplace_back("no dimensionless stiffness and damping: {}", why);
    if (all.size() > 1)
        notes.emplace_back(model::Weight::information,
                           "the dimensionless numbers of each balancer count the other "
                           "balancers as masses of the bare rotor");
    return all;
}

results::RotorNumbers rotor_numbers(const model::Rotor &rotor, const Inertia &whole,
                                    std::string &why) {
    const double A = whole.diametral();
    results::RotorNumbers numbers;
    numbers.C = whole.polar / A;
    std::vector<results::BalancerNumbers> places;
    std::vector<results::Sentence> ignored; // of a missing place there is no number
    for (const Placed &placed : all_balancers(rotor)) {
        places.emplace_back().held = placed.held != nullptr;
        add_place(places.back(), placed, ignored);
    }
    if (const auto a = anisotropy_of(rotor, places))
        numbers.A = std::abs(*a) > nothing_of_inertia * A ? std::abs(*a) / A : 0;
    add_supports(numbers, rotor, whole.mass, A, whole.center(), why);
    return numbers;
}

namespace {

using NumbersByName = std::map<std::string, std::optional<double>>;

NumbersByName by_name(const results::RotorNumbers &of) {
    return {
        {"C", of.C},     {"A", of.A},     {"p2", of.p2},         {"c_y", of.c_y},
        {"h_x", of.h_x}, {"h_y", of.h_y}, {"h_beta", of.h_beta}, {model::speed_number, of.omega_0}};
}

} // namespace

double dimensionless_number(const model::Rotor &rotor, const model::DimensionlessNumber &number) {
    const Inertia whole = inertia_of(rotor);
    std::string why;
    std::optional<double> found;
    const auto is_of = [&number](const auto &names) {
        return std::ranges::find(names, number.name) != names.end();
    };
    if (number.balancer || is_of(model::balancer_numbers)) {
        const Placed placed = all_balancers(rotor).at(number.balancer.value_or(0));
        results::BalancerNumbers place;
        std::vector<results::Sentence> reasons;
        add_place(place, placed, reasons);
        const auto of = dimensionless_numbers(parts_of(placed, whole), placed, place.D, rotor, why);
        if (number.name == "A" && !of.rotor.A && !reasons.empty())
            why = reasons.back().text();
        if (number.name == "h_s" && why.empty())
            why = "the balancer is held, or its parts have no damping of their own";
        NumbersByName all = by_name(of.rotor);
        all.insert(
            {{"A_m", of.A_m}, {"A_m0", of.A_m0}, {"m", of.m}, {"z_A", of.z_A}, {"h_s", of.h_s}});
        found = all.at(number.name);
    } else {
        const results::RotorNumbers of = rotor_numbers(rotor, whole, why);
        if (number.name == "A")
            why = "a balancer has no balanced position";
        found = by_name(of).at(number.name);
    }
    if (!found)
        throw model::BadInput(
            fmt::format("{}: expected a rotor with the number {}, it has none: {}", number.place,
                        number.name, why));
    return *found;
}

std::optional<std::complex<double>>
anisotropy_of(const model::Rotor &rotor, const std::vector<results::BalancerNumbers> &balancers) {
    std::complex<double> a = 0;
    for (const model::Anisotropy &anisotropy : rotor.anisotropies)
        a += anisotropy.dI * std::polar(1.0, 2 * anisotropy.angle);
    auto free = rotor.balancers.begin();
    for (const results::BalancerNumbers &numbers : balancers) {
        if (numbers.held) // among the rotor's anisotropies
            continue;
        if (!numbers.D)
            return std::nullopt;
        const model::Balancer &balancer = *free++;
        const auto [A_m, A_m0, own] =
            balancers::added_inertias(balancer); // D is measured from the imbalance
        a += (A_m0 + A_m * *numbers.D) / 2.0 * std::polar(1.0, 2 * balancer.imbalance_phase);
    }
    return a;
}

} // namespace whirl::rigid
