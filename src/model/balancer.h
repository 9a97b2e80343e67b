#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace whirl::model {

/// Equal balls in one race.
struct BallRow {
    int n = 2;
    double mass = 0;     ///< of one ball, kg
    double radius = 0;   ///< of the circle of ball centres, m
    double damping = 0;  ///< of one ball along the race, N s/m
    double diameter = 0; ///< of one ball, m; 0: not known
    double rolling = 0;  ///< lever arm of the resistance to rolling: moment over normal force, m

    /// Angle between the centres of two balls that touch, rad.
    [[nodiscard]] double touching_angle() const { return 2 * std::asin(diameter / (2 * radius)); }
};

/// Balls in races filled with fluid: one row, or several side by side of different balls and radii.
struct Balls {
    std::vector<BallRow> rows{BallRow{}};
    bool contact = false;   ///< balls of one row do not pass each other
    double restitution = 1; ///< speed after over speed before an impact, with contact
    /// The centre of all races lies off the axis by this, in this direction of the rotor, m and
    /// rad.
    double eccentricity = 0, eccentricity_angle = 0;
    /// Radius of a race at the angle a in the rotor over its mean: 1 + ellipticity cos 2(a -
    /// angle).
    double ellipticity = 0, ellipticity_angle = 0;
    /// The plane of all races is tilted against the cross-section of the shaft: at the angle a in
    /// the rotor a ball stands R tilt cos(a - angle) further along z.
    double tilt = 0, tilt_angle = 0;
    /// Angles in the rotor of thin walls across all races, which no ball passes, rad.
    std::vector<double> walls;
    /// Up to this speed the balls are held in the rotor, from then on they are free, rad/s.
    std::optional<double> release_speed;

    /// Some ball has dry resistance to rolling.
    [[nodiscard]] bool resists() const {
        return std::ranges::any_of(rows, [](const BallRow &r) { return r.rolling > 0; });
    }
};

/// Four pendulums: two tied pairs on two perpendicular lines.
struct Pendulums {
    double mass = 0;    ///< of one, kg
    double arm = 0;     ///< m
    double pivot = 0;   ///< radius of the pivots, m
    double damping = 0; ///< at the hinge, N m s/rad
};

/// Equal rigid rings side by side that hang with clearance on a journal turning with the rotor.
struct Rings {
    int n = 2;
    double mass = 0;           ///< of one, kg
    double journal_radius = 0; ///< m
    double clearance = 0;      ///< radial: radius of the circle of the rings' centres, m
    double inertia = 0;        ///< of one about its own axis, kg m2
    double damping = 0;        ///< against sliding on the journal, N s/m
    double drag = 0;           ///< against its own rotation relative to the rotor, N m s/rad

    [[nodiscard]] double bore_radius() const { return journal_radius + clearance; } ///< m
};

/// A passive auto-balancer at z. What its parts are is the business of balancers/ alone.
struct Balancer {
    std::string name;
    double z = 0; ///< m
    std::variant<Balls, Pendulums, Rings> parts;
    double imbalance = 0;                   ///< m0 R0 that it is to balance, kg m
    double imbalance_phase = 0;             ///< direction of that imbalance in the rotor, rad
    std::optional<double> imbalance_radius; ///< R0, m: the imbalance is a point mass that counts
    bool tilt_inertia = true; ///< false: parts and imbalance as if on the axis, for comparison with
                              ///< models that leave their moments of inertia out
    /// Angles of the balls (row after row) or ring centres in the rotor, rad; empty: chosen.
    std::vector<double> position;
    /// Its parts are to be fixed in the rotor. balancers::hold, with which a case is loaded, takes
    /// such balancers out of Rotor::balancers; all that are left there are free.
    bool held = false;
};

} // namespace whirl::model
