#include "balancers/balance_family.h"
#include "balancers/balanced_position.h"
#include "balancers/kind.h"
#include "input/validate.h"
#include "model/mass.h"

#include <fmt/core.h>

#include <cmath>
#include <complex>

namespace whirl::input {
namespace {

/// Inertias are inputs with nine digits or more.
constexpr double rounding = 1e-9;

struct Inertias {
    double Id = 0; ///< kg m2
    double Ip = 0; ///< kg m2
};

/// Polar inertia of the whole rotor with its balls and point masses, where these count.
double polar_inertia(const model::Rotor &rotor) {
    double Ip = model::polar_inertia_of(rotor.shaft);
    for (const model::Disc &disc : rotor.discs)
        Ip += disc.Ip;
    for (const model::Balancer &balancer : rotor.balancers)
        Ip += balancers::added_inertias(balancer).polar();
    return Ip;
}

/// What stands at one place of the shaft.
struct Place {
    double z = 0;
    std::vector<std::size_t> anisotropies;
    std::complex<double> a = 0; ///< sum of dI exp(2 i angle), kg m2
    Inertias discs;
    bool has_disc = false;
};

std::vector<Place> places_with_anisotropy(const model::Rotor &rotor) {
    const double margin = rounding * rotor.shaft.length();
    std::vector<Place> places;
    for (std::size_t i = 0; i < rotor.anisotropies.size(); ++i) {
        const model::Anisotropy &anisotropy = rotor.anisotropies[i];
        Place *place = nullptr;
        for (Place &known : places)
            if (std::abs(known.z - anisotropy.z) <= margin)
                place = &known;
        if (!place)
            place = &places.emplace_back(Place{anisotropy.z, {}, 0, {}, false});
        place->anisotropies.push_back(i);
        place->a += anisotropy.dI * std::polar(1.0, 2 * anisotropy.angle);
    }
    for (Place &place : places)
        for (const model::Disc &disc : rotor.discs)
            if (std::abs(place.z - disc.z) <= margin) {
                place.discs.Id += disc.Id;
                place.discs.Ip += disc.Ip;
                place.has_disc = true;
            }
    return places;
}

/// "0.2 kg m2" or, of several at one place, "0.2 kg m2 (together with anisotropy[2])".
std::string amount(const Place &place) {
    std::string text = fmt::format("{} kg m2", std::abs(place.a));
    if (place.anisotropies.size() > 1) {
        text += " together with";
        for (std::size_t i = 1; i < place.anisotropies.size(); ++i)
            text += fmt::format("{} anisotropy[{}]", i > 1 ? "," : "", place.anisotropies[i]);
    }
    return text;
}

void check_place(const Place &place, double whole_Ip, const Check &check) {
    const double size = std::abs(place.a);
    std::string limit;
    if (!place.has_disc) {
        if (2 * size > whole_Ip * (1 + rounding))
            limit = fmt::format("half the polar inertia of the rotor (no disc stands at this "
                                "place), {} kg m2",
                                whole_Ip / 2);
    } else if (2 * size > place.discs.Ip * (1 + rounding)) {
        limit =
            fmt::format("half the polar inertia of the disc there, {} kg m2", place.discs.Ip / 2);
    } else if (size > place.discs.Id * (1 + rounding)) {
        limit = fmt::format("the diametral inertia of the disc there, {} kg m2", place.discs.Id);
    }
    if (limit.empty())
        return;
    const std::string path = fmt::format("anisotropy[{}].dI", place.anisotropies.front());
    check.fail(path, fmt::format("expected at most {}, got {}", limit, amount(place)));
}

/// The case asks for one ball or ring; a count that was refused also reads as 1.
bool asks_for_one(const std::string &path, const Node &root) {
    const Node *entry = find_path(root, path);
    return entry && entry->is_number() && entry->number == 1;
}

} // namespace

void check_anisotropies(const model::Rotor &rotor, const Check &check) {
    const double Ip = polar_inertia(rotor);
    for (const Place &place : places_with_anisotropy(rotor))
        check_place(place, Ip, check);
}

namespace {

/// Parts that are held stand where the case puts them, once, on balance or off it.
void check_held(const model::Case &scene, std::size_t index, const Check &check) {
    const model::Balancer &balancer = scene.rotor.balancers[index];
    const auto kind = balancers::kind_of(balancer);
    const std::string path = fmt::format("balancer[{}]", index);
    const auto &starts = scene.simulate.ball_angles;
    const std::vector<double> *start = index < starts.size() ? &starts[index] : nullptr;
    const std::size_t masses = kind->circled().size();
    const bool placed = balancer.position.size() == masses && masses > 0;
    if (start && placed && *start != balancer.position)
        check.fail(path + ".position",
                   fmt::format("expected one place of {} that are held, got another one in "
                               "simulate.ball_angles[{}]; leave one of them out",
                               kind->parts(), index));
    if (start || placed || !(kind->reach().imbalance > 0) || masses == 0)
        return;
    if (kind->obstructed()) {
        check.fail(path + ".held",
                   fmt::format("expected the place of {} in a race out of round or with walls, "
                               "position or simulate.ball_angles, got neither",
                               kind->parts()));
        return;
    }
    if (balancers::balance_exists(kind->circled(), balancer.imbalance))
        return;
    check.fail(path + ".held",
               fmt::format("expected the place of {} that cannot balance (capacity E = {} = "
                           "{:.6g}), position or simulate.ball_angles, got neither",
                           kind->parts(), kind->reach().formula, balancers::capacity(balancer)));
}

} // namespace

void check_ball_positions(const model::Case &scene, const Check &check) {
    const model::Rotor &rotor = scene.rotor;
    constexpr double tolerance = 1e-6; // angles as printed with six or seven digits
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i) {
        const model::Balancer &balancer = rotor.balancers[i];
        if (balancer.held) {
            check_held(scene, i, check);
            continue;
        }
        const auto kind = balancers::kind_of(balancer);
        const std::vector<balancers::CircledMass> masses = kind->circled();
        if (masses.empty() || kind->obstructed()) // no command asks for their balanced position
            continue;
        const double inverse = balancer.imbalance / kind->reach().imbalance; // 1/E
        const std::string count = fmt::format("balancer[{}].n", i);
        if (masses.size() == 1 && asks_for_one(count, check.tree) &&
            std::abs(inverse - 1) > rounding) {
            check.fail(count, fmt::format(
                                  "expected 2 {} or more, or a capacity E = {} of exactly 1 for "
                                  "one {}, got E = {}",
                                  kind->parts(), kind->reach().formula, kind->name(), 1 / inverse));
            continue;
        }
        if (balancer.position.empty() || balancer.position.size() != masses.size())
            continue;
        const std::complex<double> defect =
            balancers::defect_of(masses, balancer.imbalance,
                                 balancers::turned(balancer.position, -balancer.imbalance_phase)) /
            kind->reach().imbalance;
        if (!(std::abs(defect) > tolerance))
            continue;
        const std::string path = fmt::format("balancer[{}].position", i);
        const std::complex<double> mean = defect - inverse;
        check.fail(path,
                   fmt::format("expected {} angles that balance the imbalance: mean of cosines "
                               "-1/E = {:.8g} and mean of sines 0 within 1e-6, got {:.8g} and "
                               "{:.8g}",
                               kind->name(), 0 - inverse, mean.real(), mean.imag()));
    }
}

} // namespace whirl::input
