#include "model/variants.h"

namespace whirl::model {

namespace {

void take_mean(Eigen::Matrix2d &a) {
    const double mean = a.trace() / 2;
    a = mean * Eigen::Matrix2d::Identity();
}

} // namespace

Rotor without_damping(Rotor rotor) {
    for (Bearing &bearing : rotor.bearings) {
        for (BearingCoefficients &at : bearing.rows) {
            at.c.setZero();
            at.ct.setZero();
        }
        if (bearing.pedestal)
            bearing.pedestal->c.setZero();
    }
    rotor.shaft.internal_damping = rotor.shaft.alpha = rotor.shaft.beta = 0;
    rotor.shaft.modal_damping.clear();
    return rotor;
}

Rotor with_mean_bearings(Rotor rotor) {
    for (Bearing &bearing : rotor.bearings) {
        for (BearingCoefficients &row : bearing.rows)
            for (Eigen::Matrix2d *a : {&row.k, &row.c, &row.m, &row.kt, &row.ct})
                take_mean(*a);
        if (bearing.pedestal)
            for (Eigen::Vector2d *a :
                 {&bearing.pedestal->mass, &bearing.pedestal->k, &bearing.pedestal->c})
                a->setConstant(a->mean());
    }
    return rotor;
}

Rotor isotropic_without_damping(Rotor rotor) {
    rotor.shaft.axial_torque = 0;
    return without_damping(with_mean_bearings(std::move(rotor)));
}

Rotor with_support_stiffness(Rotor rotor, std::optional<std::size_t> support,
                             const std::vector<double> &k, const std::vector<double> &speeds) {
    const std::size_t count = rotor.supports().size();
    for (std::size_t i = support.value_or(0); i < (support ? *support + 1 : count); ++i) {
        Bearing &bearing = rotor.bearings[i];
        BearingCoefficients row;
        row.kt = bearing.rows.front().kt;
        row.m = bearing.rows.front().m;
        bearing.speeds = speeds;
        bearing.rows.clear();
        for (const double value : k) {
            row.k = value * Eigen::Matrix2d::Identity();
            bearing.rows.push_back(row);
        }
    }
    return rotor;
}

Rotor stiffened(Rotor rotor, double factor) {
    for (Segment &segment : rotor.shaft.segments) {
        segment.material.E *= factor;
        segment.material.G *= factor;
        for (Layer &layer : segment.layers) {
            layer.material.E *= factor;
            layer.material.G *= factor;
        }
    }
    return rotor;
}

Rotor with_order(Rotor rotor, int order) {
    if (rotor.shaft.order_auto)
        rotor.shaft.order = order;
    rotor.shaft.order_auto = false;
    return rotor;
}

Rotor without_elasticity(Rotor rotor) {
    rotor.shaft.rigid = true;
    return rotor;
}

Rotor with_fit(Rotor rotor, BearingFit fit) {
    if (fit == BearingFit::given)
        return rotor;
    for (Bearing &bearing : rotor.bearings) {
        const auto &own = fit == BearingFit::least ? bearing.least : bearing.most;
        if (!own)
            continue;
        bearing.speeds = own->speeds;
        bearing.rows = own->rows;
        if (own->clearance)
            bearing.clearance = own->clearance;
    }
    return rotor;
}

Rotor with_balancer_imbalances(Rotor rotor) {
    for (const Balancer &balancer : rotor.balancers)
        if (balancer.imbalance > 0)
            rotor.imbalances.push_back(
                {balancer.name, balancer.z, balancer.imbalance, balancer.imbalance_phase});
    return rotor;
}

} // namespace whirl::model
