#include "properties/transforms.h"
#include "support/balancer_parts.h"

#include <algorithm>
#include <cmath>

namespace whirl::properties {

namespace {

/// Dimensions of the numbers of a case.
struct Factors {
    explicit Factors(const Units &u)
        : length(u.length), mass(u.mass), time(u.time), speed(1 / u.time),
          inertia(u.mass * u.length * u.length), stiffness(u.mass / (u.time * u.time)),
          damping(u.mass / u.time), moment(inertia / (u.time * u.time)) {}
    double length, mass, time, speed, inertia, stiffness, damping, moment;
};

void scale(model::Material &material, const Factors &f) {
    const double modulus = f.mass / (f.length * f.time * f.time);
    material.E *= modulus;
    material.G *= modulus;
    material.rho *= f.mass / (f.length * f.length * f.length);
}

void scale(model::Shaft &shaft, const Factors &f) {
    for (model::Segment &s : shaft.segments) {
        for (double *size : {&s.length, &s.outer_start, &s.outer_end, &s.inner_start, &s.inner_end,
                             &s.mass_outer, &s.mass_inner})
            *size *= f.length;
        scale(s.material, f);
        for (model::Layer &layer : s.layers) {
            layer.outer *= f.length;
            layer.inner *= f.length;
            scale(layer.material, f);
        }
    }
    shaft.internal_damping *= f.time;
    shaft.alpha /= f.time;
    shaft.beta *= f.time;
    shaft.axial_torque *= f.moment;
    shaft.axial_force *= f.mass * f.length / (f.time * f.time);
}

void scale(model::Bearing &b, const Factors &f) {
    b.z *= f.length;
    for (double &speed : b.speeds)
        speed *= f.speed;
    for (model::BearingCoefficients &at : b.rows) {
        at.k *= f.stiffness;
        at.c *= f.damping;
        at.m *= f.mass;
        at.kt *= f.moment;
        at.ct *= f.inertia / f.time;
    }
    if (b.pedestal) {
        b.pedestal->mass *= f.mass;
        b.pedestal->k *= f.stiffness;
        b.pedestal->c *= f.damping;
    }
}

void scale(model::Balancer &b, const Factors &f) {
    b.z *= f.length;
    tests::scale_parts(b, f.length, f.mass, f.time);
    b.imbalance *= f.mass * f.length;
    if (b.imbalance_radius)
        *b.imbalance_radius *= f.length;
}

/// @param amplitude  of the unit of its components
void scale(model::StationForce &force, double amplitude, const Factors &f) {
    force.z *= f.length;
    force.x *= amplitude;
    force.y *= amplitude;
    force.frequency *= f.speed;
    force.from *= f.time;
    if (force.to)
        *force.to *= f.time;
}

void scale(model::SimulateSettings &s, const Factors &f) {
    s.time *= f.time;
    for (auto &[time, speed] : s.run_up) {
        time *= f.time;
        speed *= f.speed;
    }
    for (model::HeldSpeed &held : s.held) {
        held.speed *= f.speed;
        held.from *= f.time;
        held.until *= f.time;
    }
    if (s.torque)
        *s.torque *= f.moment;
    s.torque_slope *= f.inertia / f.time;
    s.inertia *= f.inertia;
    const double acceleration = f.length / (f.time * f.time);
    s.gravity *= acceleration;
    for (model::SuddenImbalance &imbalance : s.imbalances) {
        imbalance.z *= f.length;
        imbalance.time *= f.time;
        imbalance.mr *= f.mass * f.length;
    }
    for (model::StationForce &force : s.forces)
        scale(force, f.mass * acceleration, f);
    if (s.base && s.base->harmonic)
        scale(*s.base->harmonic, acceleration, f);
    if (s.base)
        for (model::BaseMotion::Row &row : s.base->table) {
            row.time *= f.time;
            row.x *= acceleration;
            row.y *= acceleration;
        }
}

/// Forces and receptances of a response.
void scale_forces(model::Case &scene, const Factors &f) {
    for (model::Station &station : scene.rotor.stations)
        station.z *= f.length;
    for (model::HarmonicForce &force : scene.rotor.forces) {
        force.z *= f.length;
        force.amplitude *= f.mass * f.length / (f.time * f.time);
        if (force.frequency)
            *force.frequency *= f.speed;
    }
    for (model::Receptance &receptance : scene.response.receptances) {
        receptance.from *= f.length;
        receptance.to *= f.length;
    }
    scene.response.frequencies.from *= f.speed;
    scene.response.frequencies.to *= f.speed;
}

/// Operating speeds and the cross coupling that level I adds.
void scale_operation(model::Case &scene, const Factors &f) {
    if (auto &operation = scene.operation) {
        operation->from *= f.speed;
        operation->to *= f.speed;
        for (auto *speed : {&operation->trip, &operation->normal})
            if (*speed)
                **speed *= f.speed;
    }
    if (auto &limits = scene.limits) {
        if (limits->shaft)
            *limits->shaft *= f.length;
        if (limits->velocity)
            *limits->velocity *= f.length / f.time;
    }
    if (auto &level1 = scene.level1) {
        level1->z *= f.length;
        for (auto *stiffness : {&level1->to, &level1->anticipated})
            if (*stiffness)
                **stiffness *= f.stiffness;
        for (model::Stage &stage : level1->stages) {
            stage.power *= f.stiffness * f.length * f.length * f.speed;
            stage.diameter *= f.length;
            stage.width *= f.length;
            if (stage.speed)
                *stage.speed *= f.speed;
        }
    }
}

/// R m R^T.
Eigen::Matrix2d turned(const Eigen::Matrix2d &m, double angle) {
    Eigen::Matrix2d R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return R * m * R.transpose();
}

template <class Change> void change_coefficients(model::Rotor &rotor, Change &&change) {
    for (model::Bearing &b : rotor.bearings)
        for (model::BearingCoefficients &at : b.rows)
            for (Eigen::Matrix2d *m : {&at.k, &at.c, &at.m, &at.kt, &at.ct})
                *m = change(*m);
}

/// Calls change for the vector of each kind of attachment.
template <class Change> void change_attachments(model::Rotor &r, Change &&change) {
    change(r.discs);
    change(r.bearings);
    change(r.anisotropies);
    change(r.balancers);
    change(r.planes);
    change(r.imbalances);
}

} // namespace

model::Case in_units(model::Case scene, const Units &units) {
    const Factors f(units);
    model::Rotor &r = scene.rotor;
    scale(r.shaft, f);
    scale_forces(scene, f);
    for (model::Disc &d : r.discs) {
        for (double *size : {&d.z, &d.outer, &d.width})
            *size *= f.length;
        d.mass *= f.mass;
        d.Id *= f.inertia;
        d.Ip *= f.inertia;
    }
    for (model::Bearing &b : r.bearings)
        scale(b, f);
    for (model::Anisotropy &a : r.anisotropies) {
        a.z *= f.length;
        a.dI *= f.inertia;
    }
    for (model::Balancer &b : r.balancers)
        scale(b, f);
    for (model::CorrectionPlane &p : r.planes) {
        p.z *= f.length;
        if (p.radius)
            *p.radius *= f.length;
        if (p.max)
            *p.max *= f.mass * f.length;
        for (std::complex<double> &weight : p.fixed)
            weight *= f.mass * f.length;
    }
    for (model::Imbalance &i : r.imbalances) {
        i.z *= f.length;
        i.mr *= f.mass * f.length;
    }
    for (model::Probe &p : r.probes)
        p.z *= f.length;
    if (scene.speeds) {
        scene.speeds->from *= f.speed;
        scene.speeds->to *= f.speed;
    }
    if (scene.states)
        for (double &speed : scene.states->speeds)
            speed *= f.speed;
    scale(scene.simulate, f);
    scale_operation(scene, f);
    for (model::PendulumDesign &d : scene.balance.designs) {
        d.arm *= f.length;
        d.pivot *= f.length;
    }
    scene.map.reset(); // its axes are entries by name
    return scene;
}

model::Case turned(model::Case scene, double angle) {
    change_coefficients(scene.rotor,
                        [angle](const Eigen::Matrix2d &m) { return turned(m, angle); });
    return scene;
}

model::Case mirrored(model::Case scene) {
    model::Rotor &r = scene.rotor;
    const double length = r.shaft.length();
    std::reverse(r.shaft.segments.begin(), r.shaft.segments.end());
    for (model::Segment &s : r.shaft.segments) {
        std::swap(s.outer_start, s.outer_end);
        std::swap(s.inner_start, s.inner_end);
    }
    change_attachments(r, [length](auto &items) {
        for (auto &item : items)
            item.z = std::max(0.0, length - item.z);
    });
    return scene;
}

model::Case reflected(model::Case scene) {
    change_coefficients(scene.rotor, [](Eigen::Matrix2d m) {
        m(0, 1) = -m(0, 1);
        m(1, 0) = -m(1, 0);
        return m;
    });
    model::Rotor &r = scene.rotor;
    for (model::Anisotropy &a : r.anisotropies)
        a.angle = -a.angle;
    for (model::Segment &s : r.shaft.segments)
        s.asymmetry_angle = -s.asymmetry_angle;
    for (model::Imbalance &i : r.imbalances)
        i.phase = -i.phase;
    for (model::Balancer &b : r.balancers) {
        b.imbalance_phase = -b.imbalance_phase;
        for (double &angle : b.position)
            angle = -angle;
    }
    if (scene.speeds) {
        const model::SpeedRange before = *scene.speeds;
        scene.speeds = model::SpeedRange{-before.to, -before.from, before.count};
        if (before.count == 1)
            scene.speeds = model::SpeedRange{-before.from, -before.from, 1};
    }
    return scene;
}

model::Case split(model::Case scene, Draw &draw) {
    std::vector<model::Segment> parts;
    for (const model::Segment &s : scene.rotor.shaft.segments) {
        model::Segment first = s;
        model::Segment second = s;
        first.elements = std::max(1, s.elements / 2);
        second.elements = std::max(1, s.elements - first.elements);
        const double share = s.elements == 1 ? draw.between(0.2, 0.8)
                                             : static_cast<double>(first.elements) / s.elements;
        first.length = s.length * share;
        second.length = s.length - first.length;
        first.outer_end = second.outer_start =
            s.outer_start + share * (s.outer_end - s.outer_start);
        first.inner_end = second.inner_start =
            s.inner_start + share * (s.inner_end - s.inner_start);
        parts.push_back(first);
        parts.push_back(second);
    }
    scene.rotor.shaft.segments = parts;
    return scene;
}

model::Case permuted(model::Case scene) {
    change_attachments(scene.rotor, [](auto &items) {
        if (items.size() > 1)
            std::rotate(items.begin(), items.begin() + 1, items.end());
        std::reverse(items.begin(), items.end());
        if (items.size() > 1)
            std::swap(items.front(), items.back());
    });
    return scene;
}

model::Case renamed(model::Case scene) {
    int number = 0;
    change_attachments(scene.rotor, [&number](auto &items) {
        for (auto &item : items)
            item.name = item.name.empty() ? "part " + std::to_string(++number) : "";
    });
    return scene;
}

} // namespace whirl::properties
