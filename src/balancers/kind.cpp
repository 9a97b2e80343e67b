#include "balancers/kind.h"

#include "balancers/ball.h"
#include "balancers/pendulum4.h"
#include "balancers/ring.h"

#include <algorithm>

namespace whirl::balancers {

namespace {

// A new kind: its line here.
std::unique_ptr<Kind> made(const model::Balls &b) { return std::make_unique<BallKind>(b); }
std::unique_ptr<Kind> made(const model::Pendulums &p) { return std::make_unique<PendulumKind>(p); }
std::unique_ptr<Kind> made(const model::Rings &r) { return std::make_unique<RingKind>(r); }

} // namespace

void SmallMotions::set_diameter(std::complex<double> D, double rate) {
    constexpr double rounding = 1e-12;
    if (std::abs(std::abs(D) - 1) > rounding)
        return;
    diameter = D / std::abs(D);
    far = far_away * (rate > 0 ? rate : 1.0); // coupled to nothing: any rate does
}

double Outline::radius() const {
    double largest = 0;
    for (const double point : points)
        largest = std::max(largest, point);
    for (const auto *lines : {&arms, &sections})
        for (const auto &[from, to] : *lines)
            largest = std::max(largest, to);
    return largest;
}

std::unique_ptr<Kind> kind_of(const model::Balancer &balancer) {
    return std::visit([](const auto &parts) { return made(parts); }, balancer.parts);
}

} // namespace whirl::balancers
