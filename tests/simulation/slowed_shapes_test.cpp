// Shapes that motions in time take along slowed, on springs and dampers that turn with the rotor,
// against the rotor on all its shapes with nothing added: decay of its motions, and deflections
// under a force from outside.

#include "input/case_file.h"
#include "reduction/damped_motions.h"
#include "simulation/equations.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace whirl::simulation::slowed_shapes_test {
namespace {

using Complex = std::complex<double>;

model::Case drum(const std::vector<std::string> &set) {
    return input::load_case(std::filesystem::path(WHIRL_ROOT) / "cases" / "extractor_two_plane",
                            set);
}

/// A disc that overhangs, above its critical speed on stiff bearings with hardly any damping.
model::Case overhung(double damping, const std::vector<std::string> &set = {}) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / fmt::format("overhung_{}.toml", getpid());
    std::ofstream(file) << fmt::format(R"(format = 1
[material.steel]
E = 2.1e11
nu = 0.3
rho = 7850
[shaft]
segments = [{{length = 0.6, outer = 0.03, material = "steel", elements = 6}},
            {{length = 0.25, outer = 0.03, material = "steel", elements = 4}}]
order = 2
[[disc]]
z = 0.85
mass = 8
Id = 0.15
Ip = 0.29
[[bearing]]
z = 0
k = 1e8
c = {0}
[[bearing]]
z = 0.6
k = 1e8
c = {0}
[[balancer]]
z = 0.85
n = 2
mass = 0.02
radius = 0.1
damping = 0.01
imbalance = 1e-3
[speeds]
from = 600
count = 1
[simulate]
time = 60
)",
                                       damping);
    return input::load_case(file, set);
}

/// The rotor on few shapes, slowed, and on all of them as they are.
struct Both {
    MotionScene few, all;

    explicit Both(model::Case scene) : few(motion_scene(scene)) {
        scene.reduction = false;
        all = motion_scene(scene);
    }
    [[nodiscard]] double highest() const { return few.parts.rotor.frequencies.maxCoeff(); }
};

// The decay of each motion as slow as the spin is that of the whole rotor to a tenth, which is what
// slowing may change, and a hundredth, for the motions are described to 1e-3; and none grows.
// Without damping of its own the overhung rotor would be driven by any damping that turns with it.
void expect_decay_of_all(const Both &rotor, double speed) {
    const Eigen::VectorXcd all = reduction::damped_eigenvalues(rotor.all.parts.rotor, speed);
    const Eigen::VectorXcd few = reduction::damped_eigenvalues(rotor.few.parts.rotor, speed);
    ASSERT_LT(all.real().maxCoeff(), 0) << speed;
    EXPECT_LT(few.real().maxCoeff(), 0) << speed;
    int compared = 0;
    for (const Complex &value : all) {
        if (std::abs(value) > rotor.few.fastest)
            continue;
        Eigen::Index nearest = 0;
        (few.array() - value).abs().minCoeff(&nearest);
        EXPECT_NEAR(few(nearest).real() / value.real(), 1, 0.11) << speed << " " << value;
        ++compared;
    }
    EXPECT_GE(compared, 4) << speed; // a forward and a backward motion at the least, in x and y
}

TEST(SlowedShapes, LeaveTheDecayOfAnOverhungRotor) {
    for (const double damping : {10.0, 100.0, 1000.0, 1e5}) {
        SCOPED_TRACE(damping);
        expect_decay_of_all(Both(overhung(damping)), 600);
    }
}

TEST(SlowedShapes, LeaveTheDecayOfADrum) {
    const Both rotor(drum({"speeds.count=1", "speeds.from=1562.5"}));
    expect_decay_of_all(rotor, 1562.5);
    EXPECT_LT(rotor.highest(), 2.01 * 1562.5); // as slow as they may become
    EXPECT_GT(rotor.all.parts.rotor.frequencies.maxCoeff(), 100 * rotor.highest());
}

TEST(SlowedShapes, LeaveTheDecayAtTheSpeedsOfARunUp) {
    const Both rotor(overhung(100, {"simulate.run_up=[[0, 0], [60, 600]]"}));
    for (const double speed : {50.0, 130.0, 290.0, 410.0, 550.0, 600.0})
        expect_decay_of_all(rotor, speed);
}

/// Deflections of the stations under forward forces of 1 N at one of them, at this frequency: the
/// equations of a reduced rotor as docs/theory.md has them, solved as they stand.
Eigen::VectorXcd deflections(const MotionScene &scene, double z, double speed, double frequency) {
    const reduction::ReducedRotor &rotor = scene.parts.rotor;
    const auto at = rotor.supports_at(speed);
    const Eigen::Index r = rotor.size();
    const Complex iw(0, frequency);
    Eigen::MatrixXcd A = at.stiffness + iw * at.damping;
    A.diagonal().array() += iw * iw;
    const Eigen::MatrixXcd straight = rotor.elastic + iw * rotor.internal;
    const Eigen::MatrixXcd across = speed * (rotor.internal + iw * rotor.gyroscopic);
    A.topLeftCorner(r, r) += straight;
    A.bottomRightCorner(r, r) += straight;
    A.topRightCorner(r, r) += across;
    A.bottomLeftCorner(r, r) -= across;
    const auto station = std::ranges::find(scene.stations.z, z) - scene.stations.z.begin();
    const reduction::Row &load = scene.stations.rows[static_cast<std::size_t>(station)];
    Eigen::VectorXcd forces(2 * r);
    forces << load.cast<Complex>(), Complex(0, -1) * load.cast<Complex>();
    const Eigen::VectorXcd p = A.partialPivLu().solve(forces);
    Eigen::VectorXcd out(static_cast<Eigen::Index>(scene.stations.rows.size()));
    for (Eigen::Index i = 0; i < out.size(); ++i)
        out(i) = scene.stations.rows[static_cast<std::size_t>(i)].cast<Complex>().dot(p.head(r));
    return out;
}

// Where slowed shapes could ring: at twice the spin speed, as slow as they become, and above. The
// default tolerance, 1e-3, bounds what slowing changes; that and what few shapes leave out is twice
// it at the most.
TEST(SlowedShapes, AnswerForcesFromOutsideAsTheWholeRotor) {
    constexpr double speed = 1000;
    constexpr double z = 1.1;
    for (const double frequency : {0.0, 700.0, 2000.0, 3200.0}) {
        model::Case scene = drum({"speeds.count=1", "speeds.from=1000"});
        model::StationForce force;
        force.z = z;
        force.x = 100;
        force.frequency = frequency;
        scene.simulate.forces = {force};
        const Both rotor(scene);
        for (const double way : {frequency, -frequency}) {
            const Eigen::VectorXcd all = deflections(rotor.all, z, speed, way);
            const Eigen::VectorXcd few = deflections(rotor.few, z, speed, way);
            EXPECT_LT((few - all).cwiseAbs().maxCoeff(), 2e-3 * all.cwiseAbs().maxCoeff()) << way;
        }
    }
}

// Weight on what is not round acts at twice the spin speed: no shape is as slow as that.
TEST(SlowedShapes, StayAwayFromWhatWeightDrives) {
    const Both level(drum({"speeds.count=1", "speeds.from=1000", "simulate.gravity=9.81"}));
    EXPECT_GE(level.highest(), 4 * 1000 * (1 - 1e-12));
}

} // namespace
} // namespace whirl::simulation::slowed_shapes_test
