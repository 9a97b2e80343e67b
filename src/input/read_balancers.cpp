#include "input/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace whirl::input {
namespace {

/// `position`, angles of all balls or rings; "symmetric" leaves the list empty.
void read_position(CheckedTable &table, const char *part, std::int64_t count,
                   model::Balancer &balancer) {
    const Node *entry = table.find("position");
    if (!entry || (entry->kind == Node::Kind::text && entry->text == "symmetric"))
        return;
    if (entry->kind != Node::Kind::list) {
        table.fail("position", fmt::format("expected \"symmetric\" or a list of {} angles, got {}",
                                           part, shown(*entry)));
        return;
    }
    balancer.position = table.numbers("position", Quantity::angle);
    if (std::ssize(balancer.position) != count)
        table.fail("position", fmt::format("expected {} angles, one for each {}, got {}", count,
                                           part, balancer.position.size()));
}

/// One ball on a circle of this radius, m.
void read_ball_of_row(CheckedTable &table, double radius, model::BallRow &row) {
    row.mass = table.number("mass", Quantity::mass, Range::positive());
    row.radius = radius;
    row.damping = table.number_or("damping", 0, Quantity::damping, Range::not_negative());
    constexpr double steel = 7800; // kg/m3
    row.diameter =
        table.number_or("ball_diameter", std::cbrt(6 * row.mass / (std::numbers::pi * steel)),
                        Quantity::length, Range::positive());
    if (row.diameter >= 2 * row.radius && table.has("ball_diameter"))
        table.fail("ball_diameter", fmt::format("expected less than twice the radius of the circle "
                                                "of ball centres, {:.6g} m, got {:.6g} m",
                                                2 * row.radius, row.diameter));
    row.rolling = table.number_or("rolling_resistance", 0, Quantity::length, Range::not_negative());
}

void read_row(CheckedTable &table, model::BallRow &row) {
    row.n = table.whole_or("n", row.n, 1, most_parts);
    read_ball_of_row(table, table.number("radius", Quantity::length, Range::positive()), row);
}

/// Walls across the races, at angles of their own.
void read_walls(CheckedTable &table, model::Balls &balls) {
    if (!table.has("walls"))
        return;
    const std::size_t mistakes = table.context().problems.count();
    balls.walls = table.numbers("walls", Quantity::angle);
    if (table.context().problems.count() > mistakes)
        return;
    if (balls.walls.empty())
        table.fail("walls", "expected a list of at least one angle, got none");
    if (std::ranges::any_of(balls.walls,
                            [](double wall) { return !(std::abs(wall) <= 2 * std::numbers::pi); }))
        table.fail("walls", "expected angles within one turn, up to 6.283 rad, got one beyond");
    constexpr double apart = 1e-9; // rad, of angles as they are written
    for (std::size_t i = 0; i < balls.walls.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (std::abs(std::remainder(balls.walls[i] - balls.walls[k], 2 * std::numbers::pi)) <
                apart)
                table.fail("walls", fmt::format("expected walls at angles of their own, got two at "
                                                "{:.6g} rad",
                                                balls.walls[i]));
}

/// Balls that do not pass each other must have room.
void read_contact(CheckedTable &table, model::Balls &balls) {
    balls.contact = table.flag_or("contact", false);
    balls.restitution = table.number_or("restitution", 0.9, Quantity::number, Range{0, 1});
    if (!balls.contact && !table.has("walls") && table.has("restitution"))
        table.fail("restitution", "expected only with contact = true or walls, got it alone");
    for (const model::BallRow &row : balls.rows) {
        const double room = row.n * row.touching_angle();
        if (balls.contact && !(room <= 2 * std::numbers::pi))
            table.fail("contact", fmt::format("expected balls that fit beside each other in their "
                                              "race, got {} of {:.6g} m on a circle of {:.6g} m",
                                              row.n, row.diameter, row.radius));
    }
}

/// Tracks of their own in one plane: a row of one ball each.
void read_tracks(CheckedTable &table, model::Balls &balls) {
    for (const char *key : {"n", "radius", "rows", "contact"})
        if (table.has(key))
            table.fail(key, "expected either radii, one a ball, or this key, got both");
    std::vector<double> radii = table.numbers("radii", Quantity::length);
    if (radii.empty() || std::ssize(radii) > most_parts)
        table.fail("radii",
                   fmt::format("expected a list of 1 to {} radii, one a ball, got {} numbers",
                               most_parts, radii.size()));
    else if (std::ranges::any_of(radii, [](double radius) { return !(radius > 0); }))
        table.fail("radii", "expected radii above 0 m, got one that is not");
    std::erase_if(radii, [](double radius) { return !(radius > 0); });
    if (radii.empty())
        radii.push_back(1); // said above; the other keys are read all the same
    model::BallRow row;
    row.n = 1;
    read_ball_of_row(table, *std::ranges::min_element(radii), row);
    balls.rows.assign(radii.size(), row);
    for (std::size_t i = 0; i < radii.size(); ++i)
        balls.rows[i].radius = radii[i];
}

/// Room between the tracks of one plane, after ellipticity: at the short axis of races out of
/// round.
void check_tracks(CheckedTable &table, const model::Balls &balls) {
    std::vector<double> sorted;
    for (const model::BallRow &row : balls.rows)
        sorted.push_back(row.radius);
    std::ranges::sort(sorted);
    const double room = balls.rows.front().diameter / (1 - balls.ellipticity);
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i] - sorted[i - 1] < room)
            table.fail("radii",
                       fmt::format("expected tracks in one plane that leave room for the balls, "
                                   "{:.6g} m from each other or more (ball_diameter), got {:.6g} m "
                                   "and {:.6g} m; tracks side by side are rows",
                                   room, sorted[i - 1], sorted[i]));
}

/// The races' centre beside the axis.
void read_eccentricity(CheckedTable &table, model::Balls &balls) {
    balls.eccentricity =
        table.number_or("eccentricity", 0, Quantity::length, Range::not_negative());
    balls.eccentricity_angle = table.number_or("eccentricity_angle", 0, Quantity::angle);
    if (balls.eccentricity == 0) {
        if (table.has("eccentricity_angle") && !table.has("eccentricity"))
            table.fail("eccentricity_angle", "expected only with eccentricity, got it alone");
        return;
    }
    // Against tilting the balls count as on circles about the axis.
    constexpr double largest = 0.1;
    const double radius = std::ranges::min(balls.rows, {}, &model::BallRow::radius).radius;
    if (balls.eccentricity > largest * radius)
        table.fail("eccentricity",
                   fmt::format("expected at most a tenth of the radius of the circle of ball "
                               "centres, {:.6g} m, got {:.6g} m",
                               radius, balls.eccentricity));
    if (balls.resists())
        table.fail("eccentricity", "expected a race about the axis, eccentricity 0, for balls that "
                                   "resist rolling, got an eccentric one");
}

/// Races whose radius changes twice around.
void read_ellipticity(CheckedTable &table, model::Balls &balls) {
    constexpr double largest = 0.1; // beyond it one harmonic hardly describes a race
    balls.ellipticity = table.number_or("ellipticity", 0, Quantity::number, Range{0, largest});
    balls.ellipticity_angle = table.number_or("ellipticity_angle", 0, Quantity::angle);
    if (table.has("ellipticity_angle") && !table.has("ellipticity"))
        table.fail("ellipticity_angle", "expected only with ellipticity, got it alone");
    if (balls.ellipticity == 0)
        return;
    if (balls.contact || balls.resists())
        table.fail("ellipticity", "expected a round race, ellipticity 0, for balls that touch or "
                                  "resist rolling, got one out of round");
    // The short axis. A ball at a wall must not fill the race: where it touches is found by steps
    // that leave 2 ellipticity tan(a) of the error, sin(a) the diameter over that of the circle.
    constexpr double widest = 0.9;
    const double least = 1 - balls.ellipticity;
    for (const model::BallRow &row : balls.rows)
        if (!balls.walls.empty() && row.diameter > 2 * widest * least * row.radius)
            table.fail("walls",
                       fmt::format("expected balls of less than {:.6g} m (ball_diameter) between "
                                   "the walls of this race out of round, got {:.6g} m",
                                   2 * widest * least * row.radius, row.diameter));
}

/// Races that do not lie across the shaft.
void read_tilt(CheckedTable &table, model::Balls &balls) {
    constexpr double largest = 0.1; // rad: terms of the third order are a percent
    balls.tilt = table.number_or("tilt", 0, Quantity::angle, Range{0, largest});
    balls.tilt_angle = table.number_or("tilt_angle", 0, Quantity::angle);
    if (table.has("tilt_angle") && !table.has("tilt"))
        table.fail("tilt_angle", "expected only with tilt, got it alone");
    if (balls.tilt == 0)
        return;
    if (balls.resists())
        table.fail("tilt", "expected a race across the shaft, tilt 0, for balls that resist "
                           "rolling, got a tilted one");
    for (const char *key : {"held", "tilt_inertia"})
        if (table.has(key) && table.flag_or(key, false) == (std::string(key) == "held"))
            table.fail(key, "expected free balls that resist tilting (held = false, tilt_inertia = "
                            "true) in a tilted race, got others");
}

void read_release(CheckedTable &table, model::Balls &balls) {
    balls.release_speed =
        table.optional_number("release_speed", Quantity::speed, Range::positive());
    if (!balls.release_speed)
        return;
    if (balls.contact || balls.resists() || !balls.walls.empty())
        table.fail("release_speed",
                   "expected balls that pass each other, do not resist rolling and "
                   "meet no walls, got others");
    table.context().remarks.emplace_back(
        "balls with a release_speed are held up to it in `simulate` alone: every other answer is "
        "of free balls, or of held ones with held = true");
}

void read_ball(CheckedTable &table, model::Balancer &balancer) {
    model::Balls balls;
    if (table.has("radii")) {
        read_tracks(table, balls);
    } else if (table.has("rows")) {
        for (const char *key :
             {"n", "mass", "radius", "damping", "ball_diameter", "rolling_resistance"})
            if (table.has(key))
                table.fail(key, "expected either rows or n, mass, radius, damping, got both");
        balls.rows.clear();
        read_each(table, "rows", balls.rows, read_row);
        if (balls.rows.empty())
            table.fail("rows", "expected a list of at least one row, {n, mass, radius, damping}, "
                               "got none");
    } else {
        read_row(table, balls.rows.front());
    }
    read_walls(table, balls);
    read_contact(table, balls);
    read_eccentricity(table, balls);
    read_ellipticity(table, balls);
    read_tilt(table, balls);
    if (table.has("radii"))
        check_tracks(table, balls);
    read_release(table, balls);
    std::int64_t count = 0;
    for (const model::BallRow &row : balls.rows)
        count += row.n;
    read_position(table, "ball", count, balancer);
    balancer.parts = balls;
}

void read_pendulum(CheckedTable &table, model::Balancer &balancer) {
    model::Pendulums pendulums;
    pendulums.mass = table.number("mass", Quantity::mass, Range::positive());
    pendulums.arm = table.number("arm", Quantity::length, Range::positive());
    pendulums.pivot = table.number("pivot", Quantity::length, Range::not_negative());
    pendulums.damping =
        table.number_or("damping", 0, Quantity::tilt_damping, Range::not_negative());
    balancer.parts = pendulums;
}

/// About its own axis, kg m2: as given, or of a homogeneous ring out to outer_radius.
double read_ring_inertia(CheckedTable &table, const model::Rings &rings) {
    const double bore = rings.bore_radius();
    if (table.has("inertia") == table.has("outer_radius")) {
        table.fail(table.has("inertia") ? "inertia" : "outer_radius",
                   fmt::format("expected either outer_radius of a homogeneous ring or its inertia, "
                               "got {}",
                               table.has("inertia") ? "both" : "neither"));
        return 0;
    }
    if (table.has("outer_radius")) {
        const double outer = table.number("outer_radius", Quantity::length, Range::positive());
        if (outer <= bore)
            table.fail("outer_radius",
                       fmt::format("expected a radius above that of the bore, "
                                   "journal_radius + clearance = {:.6g} m, got {:.6g} m",
                                   bore, outer));
        return rings.mass * (outer * outer + bore * bore) / 2;
    }
    const double inertia = table.number("inertia", Quantity::inertia, Range::positive());
    const double least = rings.mass * bore * bore;
    constexpr double rounding = 1e-9; // of inputs with nine digits or more
    if (inertia < least * (1 - rounding))
        table.fail("inertia", fmt::format("expected at least mass (journal_radius + clearance)^2 = "
                                          "{:.6g} kg m2, as all mass lies outside the bore, got {}",
                                          least, inertia));
    return inertia;
}

void read_ring(CheckedTable &table, model::Balancer &balancer) {
    model::Rings rings;
    rings.n = table.whole_or("n", rings.n, 1, most_parts);
    rings.mass = table.number("mass", Quantity::mass, Range::positive());
    rings.journal_radius = table.number("journal_radius", Quantity::length, Range::positive());
    rings.clearance = table.number("clearance", Quantity::length, Range::positive());
    rings.inertia = read_ring_inertia(table, rings);
    rings.damping = table.number_or("damping", 0, Quantity::damping, Range::not_negative());
    rings.drag = table.number_or("drag", 0, Quantity::tilt_damping, Range::not_negative());
    read_position(table, "ring", rings.n, balancer);
    balancer.parts = rings;
}

struct KindOfTable {
    std::string name;
    std::vector<std::string> keys; ///< those that not every kind has
    void (*read)(CheckedTable &, model::Balancer &);
};

// A new kind: its row here.
const std::array kinds{
    KindOfTable{"ball",
                {"n", "radius", "position", "rows", "contact", "restitution", "ball_diameter",
                 "rolling_resistance", "radii", "eccentricity", "eccentricity_angle", "ellipticity",
                 "ellipticity_angle", "tilt", "tilt_angle", "walls", "release_speed"},
                read_ball},
    KindOfTable{"pendulum4", {"arm", "pivot"}, read_pendulum},
    KindOfTable{"ring",
                {"n", "position", "journal_radius", "clearance", "outer_radius", "inertia", "drag"},
                read_ring},
};

bool has_key(const KindOfTable &kind, const std::string &key) {
    return std::ranges::find(kind.keys, key) != kind.keys.end();
}

/// Collects a mistake at each key of another kind; all of them become known.
void refuse_keys_of_others(CheckedTable &table, const KindOfTable &own) {
    for (const KindOfTable &other : kinds)
        for (const std::string &key : other.keys) {
            if (has_key(own, key) || !table.has(key))
                continue;
            std::vector<std::string> owners;
            for (const KindOfTable &kind : kinds)
                if (has_key(kind, key))
                    owners.push_back(fmt::format("\"{}\"", kind.name));
            if (owners.front() == fmt::format("\"{}\"", other.name)) // once
                table.fail(key, fmt::format("expected only with kind = {}, got a {}",
                                            fmt::join(owners, " or "), own.name));
        }
}

} // namespace

void read_balancers(CheckedTable &root, model::Rotor &rotor) {
    std::vector<std::string> names;
    for (const KindOfTable &kind : kinds)
        names.push_back(kind.name);
    read_each(
        root, "balancer", rotor.balancers, [&](CheckedTable &table, model::Balancer &balancer) {
            read_place(table, balancer);
            const KindOfTable &kind = kinds.at(table.choice("kind", names, 0));
            kind.read(table, balancer);
            refuse_keys_of_others(table, kind);
            balancer.imbalance =
                table.number_or("imbalance", 0, Quantity::imbalance, Range::not_negative());
            balancer.imbalance_phase = table.number_or("imbalance_phase", 0, Quantity::angle);
            balancer.imbalance_radius =
                table.optional_number("imbalance_radius", Quantity::length, Range::positive());
            balancer.tilt_inertia = table.flag_or("tilt_inertia", true);
            balancer.held = table.flag_or("held", false);
        });
}

} // namespace whirl::input
