#pragma once

#include "model/balancer.h"

namespace whirl::tests {

/// The first row of a ball balancer.
inline model::BallRow &row(model::Balancer &balancer) {
    return std::get<model::Balls>(balancer.parts).rows.front();
}
inline const model::BallRow &row(const model::Balancer &balancer) {
    return std::get<model::Balls>(balancer.parts).rows.front();
}

/// The pendulums of a balancer, which has none else.
inline model::Pendulums &pendulums_of(model::Balancer &balancer) {
    if (!std::holds_alternative<model::Pendulums>(balancer.parts))
        balancer.parts = model::Pendulums{};
    return std::get<model::Pendulums>(balancer.parts);
}

/// The damping of all parts: of balls N s/m, at hinges N m s/rad.
inline void set_damping(model::Balancer &balancer, double damping) {
    if (auto *balls = std::get_if<model::Balls>(&balancer.parts))
        for (model::BallRow &one : balls->rows)
            one.damping = damping;
    else if (auto *pendulums = std::get_if<model::Pendulums>(&balancer.parts))
        pendulums->damping = damping;
    else
        std::get<model::Rings>(balancer.parts).damping = damping;
}

/// The same parts in other units: lengths, masses and times times these factors.
inline void scale_parts(model::Balancer &balancer, double length, double mass, double time) {
    const double inertia = mass * length * length;
    if (auto *balls = std::get_if<model::Balls>(&balancer.parts)) {
        for (model::BallRow &one : balls->rows) {
            one.mass *= mass;
            one.radius *= length;
            one.damping *= mass / time;
            one.diameter *= length;
            one.rolling *= length;
        }
        balls->eccentricity *= length;
        if (balls->release_speed)
            *balls->release_speed /= time;
    } else if (auto *pendulums = std::get_if<model::Pendulums>(&balancer.parts)) {
        pendulums->mass *= mass;
        pendulums->arm *= length;
        pendulums->pivot *= length;
        pendulums->damping *= inertia / time;
    } else {
        auto &rings = std::get<model::Rings>(balancer.parts);
        rings.mass *= mass;
        rings.journal_radius *= length;
        rings.clearance *= length;
        rings.inertia *= inertia;
        rings.damping *= mass / time;
        rings.drag *= inertia / time;
    }
}

} // namespace whirl::tests
