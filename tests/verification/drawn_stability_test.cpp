// Rotors drawn at random, written as case files that the program and the oracles read each by
// itself: ends of growth, level-I stability and permissible anisotropy against whole spectra of
// dense matrices in long double. Two-node elements, which both have alike.

#include "analyses/stability.h"
#include "assembly/discretization.h"
#include "assembly/rotating_system.h"
#include "balancers/arrangement.h"
#include "balancers/linear_element.h"
#include "input/case_file.h"
#include "oracles/dense_rotor.h"
#include "oracles/floquet.h"
#include "oracles/rotating_state.h"
#include "properties/draw.h"
#include "properties/transforms.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace {

using namespace whirl;
using oracles::Complex;
using oracles::Real;
using oracles::RealMatrix;
using properties::Draw;

struct Scene {
    std::string text;
    model::Case scene;
    oracles::CaseRotor own; ///< as the oracles read it
};

Scene scene_of(std::string text) {
    const auto *test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / fmt::format("drawn_{}.toml", test->name());
    std::ofstream(file) << text;
    return {std::move(text), input::load_case(file), oracles::read_case(file.string(), {})};
}

/// What has been drawn so far.
struct Drawn {
    std::string text;
    std::vector<double> z; ///< of the nodes: ends of the two segments, m
    std::vector<double> disc_z, disc_Id;
    double bending = 0; ///< stiffness of the shaft on rigid supports at its ends, N/m
};

/// A shaft of two elements with one to three discs at their ends.
Drawn shaft_and_discs(Draw &draw, double internal_damping, bool asymmetric) {
    Drawn out;
    const bool thick = draw.chance(0.5);
    const double length = thick ? draw.between(1.5, 4) : draw.between(0.5, 1.8);
    const double outer = length * draw.between(0.05, 0.12);
    const double cut = draw.between(0.25, 0.75);
    const double E = draw.chance(0.5) ? 2.1e11 : 7e10;
    out.z = {0, cut * length, length};
    out.bending = 48 * E * std::pow(outer, 4) / 20 / std::pow(length, 3);
    out.text = fmt::format("format = 1\n[material.m]\nE = {}\nnu = 0.3\nrho = {}\n[shaft]\n"
                           "order = 1\ninternal_damping = {}\nsegments = [\n",
                           E, draw.between(2700, 7850), internal_damping);
    for (const double share : {cut, 1 - cut})
        out.text += fmt::format(
            "{{length = {}, outer = {}, inner = {}, material = \"m\", asymmetry = {}}},\n",
            share * length, outer * draw.between(0.8, 1.2),
            draw.chance(0.5) ? 0 : outer * draw.between(0.1, 0.5),
            asymmetric ? draw.between(-0.15, 0.15) : 0);
    out.text += "]\n";
    const int first = draw.integer(0, 2);
    for (int i = 0; i < draw.integer(1, 3); ++i) {
        const double mass = 6000 * outer * outer * length * draw.over_decades(0.2, 4);
        const double radius = draw.between(0.1, 0.3) * length;
        out.disc_z.push_back(out.z[static_cast<std::size_t>((first + i) % 3)]);
        out.disc_Id.push_back(mass * radius * radius / 4);
        out.text +=
            fmt::format("[[disc]]\nz = {}\nmass = {}\nId = {}\nIp = {}\n", out.disc_z.back(), mass,
                        out.disc_Id.back(), out.disc_Id.back() * draw.between(0.6, 1.9));
    }
    return out;
}

/// Two bearings that are the same from every direction.
/// @param stiffness  N/m, of their order
/// @param damping    over their stiffness, s
std::string two_bearings(Draw &draw, const Drawn &on, double stiffness, double damping) {
    std::string out;
    const std::size_t without = static_cast<std::size_t>(draw.integer(0, 2));
    for (std::size_t i = 0; i < on.z.size(); ++i) {
        const double k = stiffness * draw.over_decades(0.03, 30);
        if (i != without)
            out += fmt::format("[[bearing]]\nz = {}\nk = {}\nc = {}\n", on.z[i], k, damping * k);
    }
    return out;
}

/// Speed (rad/s) beyond the first forward critical speeds of a rotor without its asymmetries.
double beyond_critical_speeds(const oracles::CaseRotor &rotor, int count) {
    double out = 0;
    for (const oracles::Crossing &crossing : oracles::crossings(oracles::dense_rotor(rotor)))
        if (crossing.forward && count-- > 0)
            out = crossing.speed;
    return 1.3 * out;
}

/// A rotor with a turning anisotropy; its damping by its number: none, internal, or of bearings
/// too.
Scene anisotropic(int seed) {
    Draw draw(static_cast<std::uint64_t>(seed));
    const int kind = seed % 3;
    const bool asymmetric = kind != 0 && draw.chance(0.7);
    Drawn drawn = shaft_and_discs(draw, kind == 0 ? 0 : draw.over_decades(1e-7, 1e-5), asymmetric);
    drawn.text += two_bearings(draw, drawn, drawn.bending * draw.over_decades(0.1, 10),
                               kind == 2 ? draw.over_decades(1e-6, 1e-4) : 0);
    if (!asymmetric || draw.chance(0.5))
        drawn.text +=
            fmt::format("[[anisotropy]]\nz = {}\ndI = {}\nangle = {}\n", drawn.disc_z[0],
                        drawn.disc_Id[0] * draw.over_decades(0.02, 0.3), draw.between(-1.5, 1.5));
    const Scene scene = scene_of(drawn.text + "[speeds]\nto = 1\n");
    return scene_of(drawn.text + fmt::format("[speeds]\nto = {}\ncount = 21\n",
                                             beyond_critical_speeds(scene.own, 3)));
}

/// Numbers of growing motions over the speed by the oracle.
class Counted {
  public:
    explicit Counted(const oracles::CaseRotor &rotor)
        : _rotor(oracles::rotating_shaft(rotor)), _noise(rotor.damped() ? 0 : 2e-9L) {}

    [[nodiscard]] int growing(double speed) const {
        const std::vector<Complex> values = _rotor.eigenvalues(speed);
        Real largest = 0;
        for (const Complex &l : values)
            largest = std::max(largest, std::abs(l));
        return static_cast<int>(std::count_if(values.begin(), values.end(), [&](const Complex &l) {
            return l.real() > _noise * largest;
        }));
    }
    struct End {
        double speed;
        int below, above;
    };
    /// Between neighbours of ascending speeds, by halving.
    [[nodiscard]] std::vector<End> ends(const std::vector<double> &speeds) const {
        std::vector<End> out;
        int before = growing(speeds.front());
        for (std::size_t k = 1; k < speeds.size(); ++k) {
            const int here = growing(speeds[k]);
            halve(speeds[k - 1], before, speeds[k], here, out);
            before = here;
        }
        return out;
    }

  private:
    oracles::RotatingRotor _rotor;
    Real _noise; ///< of real parts that are zero, over the largest |l|: the root of rounding

    void halve(double a, int at_a, double b, int at_b, std::vector<End> &out) const {
        if (at_a == at_b)
            return;
        if (b - a < 1e-9 * b) {
            out.push_back({(a + b) / 2, at_a, at_b});
            return;
        }
        const double middle = (a + b) / 2;
        const int there = growing(middle);
        halve(a, at_a, middle, there, out);
        halve(middle, there, b, at_b, out);
    }
};

void expect_ends(const Counted &counted, const std::vector<results::StabilityEnd> &ends, double to,
                 const std::string &name) {
    constexpr int steps = 40;
    std::vector<double> speeds;
    for (int k = 0; k <= steps; ++k)
        speeds.push_back(to * (k + 0.01) / (steps + 0.02));
    for (std::size_t i = 1; i < ends.size(); ++i) // narrower than a step
        speeds.push_back((ends[i - 1].speed + ends[i].speed) / 2);
    std::sort(speeds.begin(), speeds.end());
    const auto expected = counted.ends(speeds);
    std::string all;
    for (const auto &end : expected)
        all += fmt::format("\n{:.10g} {} {}", end.speed, end.below, end.above);
    all += "\nfor";
    for (const auto &end : ends)
        all += fmt::format("\n{:.10g} {} {} {}", end.speed, end.growing_below, end.growing_above,
                           results::end_kind_name(end.kind));
    ASSERT_EQ(ends.size(), expected.size()) << name << all;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const double end = ends[i].speed;
        // Growth of undamped motions begins as a root of the distance: it is seen 1e-7 later.
        EXPECT_NEAR(end, expected[i].speed, 1e-7 * end) << name;
        EXPECT_EQ(ends[i].growing_below, expected[i].below) << name << ": " << end;
        EXPECT_EQ(ends[i].growing_above, expected[i].above) << name << ": " << end;
    }
}

// Nothing depends on the units that the numbers are in.
TEST(DrawnRotors, EndsAreTheSameInOtherUnits) {
    for (int seed = 1; seed <= 20; ++seed) {
        const Scene scene = anisotropic(seed);
        const auto here = analyses::stability(scene.scene, {}).ends;
        for (const properties::Units &units :
             {properties::Units{8, 0.25, 2}, properties::Units{3, 0.7, 1.05}}) {
            const auto there =
                analyses::stability(properties::in_units(scene.scene, units), {}).ends;
            ASSERT_EQ(there.size(), here.size()) << seed;
            for (std::size_t i = 0; i < here.size(); ++i) {
                // Of motions that meet next to zero rounding leaves the root of itself.
                EXPECT_NEAR(there[i].speed * units.time, here[i].speed, 1e-7 * here[i].speed)
                    << seed;
                EXPECT_EQ(there[i].growing_below, here[i].growing_below) << seed;
                EXPECT_EQ(there[i].growing_above, here[i].growing_above) << seed;
                EXPECT_EQ(there[i].kind, here[i].kind) << seed << ": " << here[i].speed;
            }
        }
    }
}

TEST(DrawnRotors, EndsAreThoseOfTheCountedSpectrum) {
    constexpr int rotors = 24;
    std::size_t ends = 0;
    for (int seed = 1; seed <= rotors; ++seed) {
        const Scene scene = anisotropic(seed);
        const results::StabilityResult result = analyses::stability(scene.scene, {});
        const std::string name = fmt::format("rotor {}", seed);
        expect_ends(Counted(scene.own), result.ends, result.speeds.back(), name);
        for (const results::Sentence &note : result.model.notes)
            EXPECT_EQ(note.find("growing motions"), std::string::npos) << name << ": " << note;
        ends += result.ends.size();
    }
    EXPECT_GE(ends, 60U); // otherwise little was compared
}

// A drum on supports a millionth as stiff as its shaft, with two balancers: the rounding of a
// decomposition in double precision hides the decay of its slow motions, and one that grows was
// taken for one of these. Against all eigenvalues in long double.
TEST(WasherDrum, GrowthIsThatOfAllMotions) {
    model::Case scene = input::load_case(WHIRL_ROOT "/tests/verification/scenes/washer_drum.toml");
    scene.rotor.shaft.order = 1;
    scene.speeds = model::SpeedRange{5, 140, 6};
    const results::StabilityResult result = analyses::stability(scene, {});
    const assembly::Discretization d(scene.rotor, 1);
    const auto elements = balancers::balancer_elements(
        scene.rotor, balancers::sampled_arrangements(scene.rotor, 1).front());
    const assembly::RotatingSystem system = assembly::assemble_rotating(d, 0, elements);
    bool grows = false;
    for (std::size_t k = 0; k < result.speeds.size(); ++k) {
        const double W = result.speeds[k];
        const Eigen::MatrixXd M = system.M.view();
        const Eigen::MatrixXd D = system.damping(W).view();
        const Eigen::MatrixXd K = system.stiffness(W).view();
        Real largest = -HUGE_VAL;
        for (const Complex &l :
             oracles::state_eigenvalues(M.cast<Real>(), D.cast<Real>(), K.cast<Real>(), 1e3))
            largest = std::max(largest, l.real());
        const auto growth = static_cast<double>(largest);
        // Of decay a hundred thousand times slower than the rotor turns rounding leaves six digits.
        EXPECT_NEAR(result.growth[k], growth, 1e-6 * std::abs(growth) + 1e-12 * W) << W;
        grows = grows || growth > 1e-4 * W;
    }
    EXPECT_TRUE(grows); // else nothing would be told from rounding
}

/// A damped rotor, every second one on bearings that differ between their directions, with cross
/// coupling at a node.
Scene with_level1(int seed) {
    Draw draw(static_cast<std::uint64_t>(seed));
    Drawn drawn =
        shaft_and_discs(draw, draw.chance(0.5) ? draw.over_decades(1e-9, 1e-6) : 0, false);
    const double stiffness = drawn.bending * draw.over_decades(0.1, 10);
    for (const double z : {drawn.z[0], drawn.z[2]}) {
        const double kx = stiffness * draw.over_decades(0.1, 10);
        const double ky = seed % 2 == 0 ? kx : kx * draw.between(0.5, 2);
        const double c = draw.over_decades(1e-6, 1e-3) * kx;
        drawn.text += fmt::format("[[bearing]]\nz = {}\nkxx = {}\nkyy = {}\ncxx = {}\ncyy = {}\n",
                                  z, kx, ky, c, seed % 2 == 0 ? c : c * draw.between(0.5, 2));
    }
    const double speed = std::sqrt(drawn.bending / 1000) * draw.over_decades(0.5, 20);
    drawn.text += fmt::format("[speeds]\nto = {0}\ncount = 2\n[operation]\nfrom = {1}\nto = {0}\n"
                              "[level1]\nz = {2}\n",
                              speed, 0.8 * speed, drawn.z[1]);
    return scene_of(drawn.text);
}

/// All eigenvalues at the highest operating speed with coupling q at the place.
std::vector<Complex> coupled_spectrum(const oracles::CaseRotor &rotor, double q) {
    const oracles::DenseRotor dense = oracles::dense_rotor(rotor);
    const double speed = rotor.operation.to;
    const Eigen::Index x = dense.deflection(rotor.operation.level1_z);
    const Eigen::Index y = dense.planar() + x;
    Eigen::MatrixXd K = dense.K + speed * dense.Kc;
    K(x, y) += q;
    K(y, x) -= q;
    const Eigen::MatrixXd D = dense.C + speed * dense.G;
    double fastest = 0;
    for (Eigen::Index i = 0; i < K.rows(); ++i)
        fastest = std::max(fastest, std::sqrt(std::abs(K(i, i) / dense.M(i, i))));
    return oracles::state_eigenvalues(dense.M.cast<Real>(), D.cast<Real>(), K.cast<Real>(),
                                      fastest);
}

Complex least_damped(const oracles::CaseRotor &rotor, double q) {
    const auto all = coupled_spectrum(rotor, q);
    return *std::max_element(all.begin(), all.end(), [](const Complex &a, const Complex &b) {
        return a.real() < b.real();
    });
}

// Of all motions of the mesh; where one that the elements do not resolve begins to grow before, it
// is said so, and what is answered is still a root.
TEST(DrawnRotors, LevelOneIsTheFirstOfAllMotionsToGrow) {
    int first = 0;
    for (int seed = 1; seed <= 36; ++seed) {
        const Scene scene = with_level1(seed);
        const results::StabilityResult result = analyses::stability(scene.scene, {});
        ASSERT_TRUE(result.level1.has_value());
        const auto &found = result.level1->critical_cross_coupling;
        const std::string name = fmt::format("rotor {}", seed);
        if (least_damped(scene.own, 0).real() > 0) {
            EXPECT_FALSE(found.has_value()) << name; // internal damping drives it
            continue;
        }
        ASSERT_TRUE(found.has_value()) << name;
        double low = 0;
        double high = 1e-6 * *found;
        for (; least_damped(scene.own, high).real() <= 0; high *= 1.5)
            low = high;
        while (high - low > 1e-11 * high)
            (least_damped(scene.own, (low + high) / 2).real() > 0 ? high : low) = (low + high) / 2;
        const bool said =
            std::any_of(result.model.notes.begin(), result.model.notes.end(), [](const auto &note) {
                return note.find("does not resolve") != std::string::npos;
            });
        if (said) {
            EXPECT_GT(*found, high) << name;
            Real nearest = HUGE_VAL;
            const Complex root(0, *result.level1->critical_frequency);
            for (const Complex &l : coupled_spectrum(scene.own, *found))
                nearest = std::min(nearest, std::abs(l - root));
            EXPECT_LT(nearest, 1e-8 * std::abs(root)) << name;
            continue;
        }
        EXPECT_NEAR(*found, high, 1e-8 * high) << name;
        EXPECT_NEAR(*result.level1->critical_frequency,
                    static_cast<double>(std::abs(least_damped(scene.own, high).imag())),
                    1e-8 * *result.level1->critical_frequency)
            << name;
        ++first;
    }
    EXPECT_GE(first, 20);
}

/// A rigid rotor with an anisotropic disc on bearings that differ between their directions, damped
/// by a few per cent.
std::string on_unequal_bearings(Draw &draw, double dI) {
    const double Id = draw.between(0.6, 1.2);
    std::string out = fmt::format(
        "format = 1\n[material.m]\nE = 2e11\nnu = 0.3\nrho = 1e-9\n[shaft]\nrigid = true\n"
        "segments = [{{length = 1, outer = 0.05, material = \"m\"}}]\n[[disc]]\nz = 0.5\nmass = "
        "20\nId = {}\n"
        "Ip = {}\n[[anisotropy]]\nz = 0.5\ndI = {:.17g}\n",
        Id, Id * draw.between(0.3, 0.6), dI);
    for (const double z : {0.0, 1.0}) {
        const double k = draw.between(3e5, 8e5);
        const double ratio = draw.between(0.6, 0.9);
        const double c = k * draw.between(2e-5, 8e-5);
        out += fmt::format("[[bearing]]\nz = {}\nkxx = {}\nkyy = {}\ncxx = {}\ncyy = {}\n", z, k,
                           ratio * k, c, c);
    }
    return out + "[speeds]\nfrom = 250\nto = 1500\ncount = 31\n";
}

using Periodic = oracles::PeriodicSystem (*)(const oracles::CaseRotor &, Real);

/// A speed next to which a turning anisotropy can make something grow, and how wide that is.
struct Resonance {
    double speed = 0; ///< rad/s
    double width = 0; ///< rad/s
    double least = 0; ///< of both motions' decays, 1/s
};

/// The anisotropy turns at twice the spin speed when seen from the fixed frame: of the rotor
/// without it two whirl frequencies, or one twice, add up to that. Where growth begins, the
/// coupling is as strong as the damping and so the resonance about as wide as the motions decay.
std::vector<Resonance> resonances(Periodic periodic, oracles::CaseRotor rotor) {
    rotor.anisotropies.clear();
    const auto motions = [&](double speed) {
        const auto at = static_cast<Real>(speed);
        const oracles::PeriodicSystem steady = periodic(rotor, at);
        const RealMatrix M = steady.M(0);
        const RealMatrix K = steady.K(0);
        Real fastest = at * at;
        for (Eigen::Index i = 0; i < M.rows(); ++i)
            fastest = std::max(fastest, K(i, i) / M(i, i));
        std::vector<Complex> out;
        for (const Complex &value :
             oracles::state_eigenvalues(M, steady.D(0), K, std::sqrt(fastest)))
            if (value.imag() > 0)
                out.push_back(value);
        std::ranges::sort(out, {}, [](const Complex &value) { return value.imag(); });
        return out;
    };
    const auto past = [](const Complex &a, const Complex &b, double speed) {
        return static_cast<double>((a + b).imag() - 2 * static_cast<Real>(speed));
    };
    constexpr int steps = 100;
    const double step = (rotor.speed_to - rotor.speed_from) / steps;
    std::vector<Resonance> out;
    double speed = rotor.speed_from;
    std::vector<Complex> here = motions(speed);
    for (int k = 0; k < steps; ++k, speed += step) {
        const std::vector<Complex> next = motions(speed + step);
        for (std::size_t i = 0; i < std::min(here.size(), next.size()); ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double low = speed;
                double high = speed + step;
                double before = past(here[i], here[j], low);
                double after = past(next[i], next[j], high);
                if (before <= 0 || after > 0)
                    continue;
                double at = low;
                for (int turn = 0; turn < 3; ++turn) { // frequencies are smooth over the speed
                    at = low + (high - low) * before / (before - after);
                    const std::vector<Complex> there = motions(at);
                    const double value = past(there.at(i), there.at(j), at);
                    (value > 0 ? low : high) = at;
                    (value > 0 ? before : after) = value;
                }
                const std::array decays{-here[i].real(), -here[j].real()};
                out.push_back({at, static_cast<double>(decays[0] + decays[1]) / 2,
                               static_cast<double>(std::min(decays[0], decays[1]))});
            }
        here = next;
    }
    return out;
}

/// Largest growth over the speeds, 1/s; less than zero where all dies out. At a resonance known to
/// 1e-6 of what its motions decay with.
Real most_growth(Periodic periodic, const oracles::CaseRotor &rotor) {
    const auto growth = [&](double speed) {
        constexpr int enough = 6; // steps of order 8 over half a turn, one whirl period at most
        return oracles::floquet_growth(
            periodic(rotor, static_cast<Real>(std::clamp(speed, rotor.speed_from, rotor.speed_to))),
            enough);
    };
    Real most = growth(rotor.speed_from);
    constexpr int steps = 20;
    for (int k = 1; k <= steps; ++k)
        most = std::max(most,
                        growth(rotor.speed_from + k * (rotor.speed_to - rotor.speed_from) / steps));
    for (const auto &[speed, width, least] : resonances(periodic, rotor)) {
        double best = speed;
        Real top = growth(best);
        const auto look = [&](double at) {
            if (const Real here = growth(at); here > top) {
                top = here;
                best = at;
            }
        };
        for (const int k : {-3, -2, -1, 1, 2, 3})
            look(speed + k * width / 2);
        if (top < -least / 10) // at a hump that begins to grow it is least/32 below zero at most
            continue;
        for (double wide = width / 4; wide > 1e-3 * width; wide /= 2)
            for (const double at : {best - wide, best + wide})
                look(at);
        most = std::max(most, top);
    }
    return most;
}

/// Against multipliers of the fixed frame: just below it nothing grows, just above something does.
/// @param given  dI of the rotor as it is
/// @param scene  a drawn one with some dI
/// @returns whether there is something to compare
template <class Drawing>
bool is_where_growth_begins(Periodic periodic, double given, const Drawing &scene) {
    const auto found = analyses::stability(scene(given).scene, {}).permissible.at(0);
    if (!found.dI || *found.dI == 0)
        return false;
    constexpr double just = 1e-5; // ten times what the largest growth is known to
    EXPECT_LT(most_growth(periodic, scene((1 - just) * *found.dI).own), 0) << *found.dI;
    EXPECT_GT(most_growth(periodic, scene((1 + just) * *found.dI).own), 0) << *found.dI;
    return true;
}

TEST(DrawnRotors, PermissibleAnisotropyOnUnequalBearingsIsWhereGrowthBegins) {
    int compared = 0;
    for (int seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        compared += is_where_growth_begins(oracles::rigid_periodic, 0.01, [seed](double dI) {
            Draw draw(static_cast<std::uint64_t>(seed));
            return scene_of(on_unequal_bearings(draw, dI));
        });
    }
    EXPECT_GE(compared, 18);
}

/// A slender shaft with an anisotropic disc between bearings that differ between their directions,
/// damped so little that growth begins within millionths of the inertia.
std::string slender_on_unequal_bearings(Draw &draw, double dI) {
    const double Id = draw.between(2e-5, 6e-5);
    const double z = draw.between(0.06, 0.12);
    std::string out = fmt::format(
        "format = 1\n[material.m]\nE = 2.05e11\nnu = 0.3\nrho = 4500\n[shaft]\norder = 1\n"
        "segments = [{{length = 0.34, outer = {}, material = \"m\"}}]\n[[disc]]\nz = {}\n"
        "mass = 0.07\nId = {}\nIp = {}\n[[anisotropy]]\nz = {}\ndI = {:.17g}\n",
        draw.between(0.014, 0.02), z, Id, Id * draw.between(1.2, 1.8), z, dI);
    for (const double end : {0.0, 0.34}) {
        const double k = draw.between(1e8, 3e8);
        const double ratio = draw.between(0.4, 0.9);
        const double c = k * draw.over_decades(1e-7, 1e-6);
        out += fmt::format("[[bearing]]\nz = {}\nkxx = {}\nkyy = {}\ncxx = {}\ncyy = {}\n", end, k,
                           ratio * k, c, c / 2);
    }
    return out + "[speeds]\nfrom = 1900\nto = 11000\ncount = 31\n";
}

TEST(DrawnRotors, PermissibleAnisotropyOfHardlyDampedShaftsIsWhereGrowthBegins) {
    int compared = 0;
    for (int seed = 1; seed <= 2; ++seed) {
        SCOPED_TRACE(seed);
        const double given = seed % 2 == 0 ? 1e-10 : 4e-7; // nothing grows yet, or something does
        compared += is_where_growth_begins(oracles::elastic_periodic, given, [seed](double dI) {
            Draw draw(static_cast<std::uint64_t>(seed));
            return scene_of(slender_on_unequal_bearings(draw, dI));
        });
    }
    EXPECT_EQ(compared, 2);
}

model::Case stored(const std::string &name) {
    return input::load_case(WHIRL_ROOT "/tests/verification/scenes/" + name + ".toml");
}

// Elements of order 3, which the oracle does not have; its tolerance is what rounding leaves of the
// growth, some 1e-9 1/s, over the derivative of it.
TEST(Permissible, OfAHardlyDampedShaftIsWhereItsMultipliersBeginToGrow) {
    const auto found = analyses::stability(stored("small_shaft_unequal_bearings"), {});
    ASSERT_TRUE(found.permissible.at(0).dI);
    EXPECT_NEAR(*found.permissible[0].dI, 7.116052e-9, 4e-15);
}

// Where the matrix of what stands still is singular; by elements of order 12 the same digits.
TEST(Ends, OfAnUndampedRotorAreThoseOfTheWholeOne) {
    const model::Case scene = stored("ends_asymmetric_undamped");
    for (const properties::Units &units : {properties::Units{}, properties::Units{8, 0.25, 2}}) {
        const auto found = analyses::stability(properties::in_units(scene, units), {});
        ASSERT_EQ(found.ends.size(), 2U);
        EXPECT_NEAR(found.ends[0].speed * units.time, 66.721728, 5e-7);
        EXPECT_NEAR(found.ends[1].speed * units.time, 66.979646, 5e-7);
        ASSERT_EQ(found.unstable.size(), 1U);
        EXPECT_EQ(found.unstable[0].from, found.ends[0].speed);
        EXPECT_EQ(found.unstable[0].to, found.ends[1].speed);
        EXPECT_TRUE(found.model.notes.empty()) << found.model.notes.front();
    }
}

TEST(Ends, WithHardlyAnyDampingAreThoseOfTheWholeRotor) {
    const model::Case scene = stored("ends_asymmetric_internal_damping");
    for (const properties::Units &units : {properties::Units{}, properties::Units{1, 1, 1.05}}) {
        const auto found = analyses::stability(properties::in_units(scene, units), {});
        ASSERT_EQ(found.ends.size(), found.zero_root_speeds.size());
        EXPECT_NEAR(found.ends[0].speed * units.time, 115.12889, 5e-6);
        for (std::size_t i = 0; i < found.ends.size(); ++i) { // one real root more passes zero
            EXPECT_EQ(found.ends[i].growing_below, static_cast<int>(i));
            EXPECT_EQ(found.ends[i].growing_above, static_cast<int>(i) + 1);
            EXPECT_EQ(found.ends[i].kind, results::EndKind::zero);
            EXPECT_NEAR(found.ends[i].speed, found.zero_root_speeds[i],
                        1e-9 * found.zero_root_speeds[i]);
        }
    }
}

// The first forward mode, at 2529 rad/s, does not begin to grow at all; another one does.
TEST(LevelOne, IsNotOfTheFirstForwardModeAlone) {
    const auto found = analyses::stability(stored("level1_no_answer_13107"), {});
    ASSERT_TRUE(found.level1 && found.level1->critical_cross_coupling);
    EXPECT_NEAR(*found.level1->critical_cross_coupling, 1.60203e6, 5);
    EXPECT_NEAR(*found.level1->critical_frequency, 5329.2, 0.05);
}

} // namespace
