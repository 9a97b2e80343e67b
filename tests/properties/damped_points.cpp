#include "analyses/campbell.h"
#include "oracles/continuum_roots.h"
#include "properties/error_points.h"
#include "results/campbell.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace whirl::properties {

namespace {

using WideComplex = oracles::Complex;

/// The rotor with everything that takes or gives energy times a share.
model::Rotor with_damping(model::Rotor rotor, double share) {
    for (model::Bearing &bearing : rotor.bearings)
        for (model::BearingCoefficients &at : bearing.rows) {
            at.c *= share;
            at.ct *= share;
            const double skew = (at.k(0, 1) - at.k(1, 0)) / 2;
            const double even = (at.k(0, 1) + at.k(1, 0)) / 2;
            at.k(0, 1) = even + share * skew;
            at.k(1, 0) = even - share * skew;
        }
    rotor.shaft.internal_damping *= share;
    return rotor;
}

struct PrintedPair {
    WideComplex eigenvalue;
    double estimate = 0;
    results::Whirl whirl = results::Whirl::mixed;
};

std::vector<PrintedPair> printed_at(const model::Case &scene, double share) {
    model::Case step = scene;
    step.rotor = with_damping(scene.rotor, share);
    std::vector<PrintedPair> out;
    for (const results::CampbellMode &mode : analyses::campbell(step).modes)
        if (mode.frequency[0])
            out.push_back({WideComplex(mode.real[0].value_or(0), *mode.frequency[0]),
                           mode.error[0].value_or(std::numeric_limits<double>::quiet_NaN()),
                           mode.whirl[0]});
    std::sort(out.begin(), out.end(), [](const PrintedPair &a, const PrintedPair &b) {
        return a.eigenvalue.imag() < b.eigenvalue.imag();
    });
    return out;
}

/// One mode from undamped to damped, in the program and in the continuum.
struct Chain {
    int index = 0;
    oracles::Motion motion = oracles::Motion::both;
    PrintedPair printed;
    WideComplex printed_before;
    WideComplex truth, truth_before;
    bool lost = false;
};

std::vector<Chain> undamped_chains(const model::Case &scene, double speed, std::size_t wanted) {
    std::vector<PrintedPair> printed = printed_at(scene, 0);
    printed.resize(std::min(printed.size(), wanted));
    const oracles::Continuum continuum(continuum_of(with_damping(scene.rotor, 0)));
    std::vector<Chain> chains;
    const auto add = [&](oracles::Motion motion, const std::vector<PrintedPair> &some) {
        if (some.empty())
            return;
        const auto truth =
            frequencies(continuum, {motion, speed, false}, static_cast<int>(some.size()),
                        4 * some.back().eigenvalue.imag());
        for (std::size_t i = 0; i < std::min(truth.size(), some.size()); ++i) {
            const WideComplex lambda(0, truth[i]);
            chains.push_back({static_cast<int>(i) + 1, motion, some[i], some[i].eigenvalue, lambda,
                              lambda, false});
        }
    };
    if (continuum.coupled()) {
        add(oracles::Motion::both, printed);
        return chains;
    }
    for (const bool forward : {true, false}) {
        std::vector<PrintedPair> some;
        for (const PrintedPair &p : printed)
            if ((p.whirl == results::Whirl::forward) == forward)
                some.push_back(p);
        add(forward ? oracles::Motion::forward : oracles::Motion::backward, some);
    }
    return chains;
}

/// The printed eigenvalue that continues a chain; none where two could.
std::optional<PrintedPair> continuation_of(const WideComplex &expected, const WideComplex &last,
                                           const std::vector<PrintedPair> &all) {
    double nearest = std::numeric_limits<double>::infinity();
    double next = nearest;
    std::optional<PrintedPair> best;
    for (const PrintedPair &p : all) {
        const auto distance = static_cast<double>(std::abs(p.eigenvalue - expected));
        if (distance < nearest) {
            next = nearest;
            nearest = distance;
            best = p;
        } else {
            next = std::min(next, distance);
        }
    }
    const bool small = nearest < 0.1 * static_cast<double>(std::abs(last));
    return small && nearest < 0.3 * next ? best : std::nullopt;
}

/// One step of all chains to a larger share of the damping.
void advance(std::vector<Chain> &chains, const model::Case &scene, double speed, double before,
             double last, double share) {
    const std::vector<PrintedPair> printed = printed_at(scene, share);
    const oracles::Continuum continuum(continuum_of(with_damping(scene.rotor, share)));
    const auto ahead =
        static_cast<oracles::Real>(last > before ? (share - last) / (last - before) : 0);
    for (Chain &chain : chains) {
        if (chain.lost)
            continue;
        // A rotor whose bearings become unequal only with the damping is followed as one.
        const oracles::Motion motion = continuum.coupled() ? oracles::Motion::both : chain.motion;
        const WideComplex here = chain.printed.eigenvalue;
        const auto next =
            continuation_of(here + ahead * (here - chain.printed_before), here, printed);
        const WideComplex guess = chain.truth + ahead * (chain.truth - chain.truth_before);
        const auto truth = eigenvalue_near(continuum, {motion, speed, false}, guess);
        if (!next || !truth || std::abs(*truth - guess) > 0.1L * std::abs(guess)) {
            chain.lost = true;
            continue;
        }
        chain.printed_before = here;
        chain.printed = *next;
        chain.truth_before = chain.truth;
        chain.truth = *truth;
    }
}

/// Chains that ended on the same eigenvalue are all given up.
void drop_doubles(std::vector<Chain> &chains) {
    const auto same = [](const WideComplex &a, const WideComplex &b) {
        return std::abs(a - b) < 1e-12L * std::abs(a);
    };
    for (std::size_t i = 0; i < chains.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (same(chains[i].truth, chains[j].truth) ||
                same(chains[i].printed.eigenvalue, chains[j].printed.eigenvalue))
                chains[i].lost = chains[j].lost = true;
}

} // namespace

ErrorPoints damped_points(const model::Case &as_given, int number) {
    ErrorPoints out;
    model::Case scene = as_given;
    const double speed = std::max(20.0, as_given.speeds->to);
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.campbell.modes += 4; // neighbours into which the damping may carry a mode
    try {
        std::vector<Chain> chains =
            undamped_chains(scene, speed, static_cast<std::size_t>(as_given.campbell.modes));
        double before = 0;
        double last = 0;
        for (const double share : {0.02, 0.1, 0.25, 0.5, 0.75, 1.0}) {
            advance(chains, scene, speed, before, last, share);
            before = last;
            last = share;
        }
        drop_doubles(chains);
        for (const Chain &chain : chains) {
            if (chain.lost)
                continue;
            ErrorPoint p;
            p.what = "damped";
            p.rotor = number;
            p.kind = Kind::damped;
            p.order = scene.rotor.shaft.order;
            p.mode = chain.index;
            p.sense = chain.motion == oracles::Motion::both      ? "both"
                      : chain.motion == oracles::Motion::forward ? "forward"
                                                                 : "backward";
            p.speed = speed;
            p.printed = static_cast<double>(chain.printed.eigenvalue.imag());
            p.truth = static_cast<double>(chain.truth.imag());
            p.estimate = chain.printed.estimate;
            p.error = static_cast<double>(std::abs(chain.printed.eigenvalue - chain.truth) /
                                          std::abs(chain.printed.eigenvalue));
            out.points.push_back(p);
        }
    } catch (const std::exception &failure) {
        out.refusals.push_back("damped: " + std::string(failure.what()));
    }
    return out;
}

} // namespace whirl::properties
