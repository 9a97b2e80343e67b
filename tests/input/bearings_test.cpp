#include "model/variants.h"
#include "scratch_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::tests {
namespace {

const std::string at_0 = sound_case + "[[bearing]]\nz = 0\n";

TEST(Bearings, HaveMassCoefficients) {
    const model::Rotor rotor = load_text(at_0 + "k = 1e6\nmxx = 3\nmxy = 0.5\nmyx = -0.5\n"
                                                "myy = \"400 g\"\n"
                                                "[[bearing]]\nz = 1\nc = 5\nm = 2\n"
                                                "[[seal]]\nz = 0.5\nm = 3\nmxy = 1\n")
                                   .rotor;
    Eigen::Matrix2d first;
    first << 3, 0.5, -0.5, 0.4;
    EXPECT_EQ(rotor.bearings[0].rows[0].m, first);
    EXPECT_EQ(rotor.bearings[1].rows[0].m, Eigen::Matrix2d(2 * Eigen::Matrix2d::Identity()));
    Eigen::Matrix2d of_seal;
    of_seal << 3, 1, -1, 3;
    EXPECT_EQ(rotor.bearings[2].rows[0].m, of_seal);
    EXPECT_FALSE(rotor.support_masses_isotropic());
}

TEST(Bearings, HaveMassInTablesAndBesideThem) {
    const std::vector<std::pair<std::string, std::string>> files{
        {"with.csv", "speed [rad/s], k, mxx, myy\n0, 1, 2, 3\n10, 2, 2, 3\n"},
        {"without.csv", "speed [rad/s], k\n0, 1\n10, 2\n"}};
    const model::Rotor rotor =
        load_text(at_0 +
                      "table = \"with.csv\"\n[[bearing]]\nz = 1\ntable = \"without.csv\"\nm = 4\n",
                  {}, files)
            .rotor;
    EXPECT_EQ(rotor.bearings[0].at(5).m(0, 0), 2);
    EXPECT_EQ(rotor.bearings[0].at(50).m(1, 1), 3);
    EXPECT_EQ(rotor.bearings[1].at(7).m(1, 1), 4);
}

TEST(Bearings, HaveTablesOfTheirClearances) {
    const std::vector<std::pair<std::string, std::string>> files{
        {"a.csv", "speed [rad/s], k\n0, 1\n10, 2\n"},
        {"min.csv", "speed [rpm], k\n0, 3\n60, 5\n"},
        {"max.csv", "speed [rad/s], k\n5, 0.5\n"}};
    const model::Case scene = load_text(
        at_0 +
            "table = \"a.csv\"\ntable_min = \"min.csv\"\ntable_max = \"max.csv\"\nm = 4\nkt = 7\n"
            "clearance = \"0.2 mm\"\nclearance_min = \"0.15 mm\"\n"
            "[[bearing]]\nz = 1\nk = 9\n[operation]\nfrom = 1\nto = 2\n[speeds]\nto = 9\n"
            "[standard]\nunbalance = \"api617\"\nclearances = [\"max\", \"min\"]\n",
        {}, files);
    ASSERT_TRUE(scene.standard.has_value());
    EXPECT_TRUE(scene.standard->api617);
    EXPECT_EQ(scene.standard->fits,
              (std::vector{model::BearingFit::most, model::BearingFit::least}));
    const model::Rotor least = model::with_fit(scene.rotor, model::BearingFit::least);
    const model::Rotor most = model::with_fit(scene.rotor, model::BearingFit::most);
    const model::Bearing &bearing = least.bearings[0];
    EXPECT_DOUBLE_EQ(bearing.at(std::numbers::pi).k(0, 0), 4); // 30 rpm
    EXPECT_EQ(bearing.at(1).m(1, 1), 4); // what stands beside the table holds for all
    EXPECT_EQ(bearing.at(1).kt(0, 0), 7);
    EXPECT_DOUBLE_EQ(*bearing.clearance, 1.5e-4);
    EXPECT_EQ(most.bearings[0].at(100).k(1, 1), 0.5);
    EXPECT_DOUBLE_EQ(*most.bearings[0].clearance, 2e-4);
    EXPECT_EQ(most.bearings[1].at(0).k(0, 0), 9); // without tables it stays as it is
    EXPECT_EQ(scene.rotor.bearings[0].at(0).k(0, 0), 1);
}

TEST(Bearings, HavePedestalsThatDiffer) {
    const model::Rotor rotor = load_text(at_0 + "k = 1\npedestal_kx = 3\npedestal_ky = 4\n"
                                                "pedestal_mass = 5\npedestal_cx = 6\n"
                                                "pedestal_cy = 0\n")
                                   .rotor;
    const model::Pedestal &pedestal = *rotor.bearings[0].pedestal;
    EXPECT_EQ(pedestal.k, Eigen::Vector2d(3, 4));
    EXPECT_EQ(pedestal.mass, Eigen::Vector2d(5, 5));
    EXPECT_EQ(pedestal.c, Eigen::Vector2d(6, 0));
    EXPECT_FALSE(rotor.bearings_isotropic());
    EXPECT_TRUE(rotor.bearings_orthotropic());
}

TEST(Shafts, HaveDampingThatDoesNotTurnAndTorque) {
    const model::Shaft shaft =
        load_text(sound_material + "[shaft]\nsegments = [{length = 1.0, outer = 0.05}]\n"
                                   "alpha = \"3 1/s\"\nbeta = \"2 us\"\nmodal_damping = [0.01, 0]\n"
                                   "axial_torque = \"2 kN m\"\ntorque_kind = \"tangential\"\n"
                                   "[[bearing]]\nz = 0\nk = 1\n")
            .rotor.shaft;
    EXPECT_DOUBLE_EQ(shaft.alpha, 3);
    EXPECT_DOUBLE_EQ(shaft.beta, 2e-6);
    EXPECT_EQ(shaft.modal_damping, (std::vector<double>{0.01, 0}));
    EXPECT_DOUBLE_EQ(shaft.axial_torque, 2000);
    EXPECT_EQ(shaft.torque_kind, model::TorqueKind::tangential);
    EXPECT_TRUE(shaft.damped_outside());
}

/// A table of these speeds whose kxx is `value`.
template <class Value> std::string table_of(const std::vector<double> &speeds, Value value) {
    std::string text = "speed [rad/s], kxx, cyy\n";
    for (const double speed : speeds)
        text += fmt::format("{:.17g}, {:.17g}, {:.17g}\n", speed, value(speed), 5 + speed);
    return text;
}

model::Bearing splined(const std::string &table, const std::string &kind = "spline") {
    return load_text(at_0 + "table = \"b.csv\"\ninterpolation = \"" + kind + "\"\n", {},
                     {{"b.csv", table}})
        .rotor.bearings[0];
}

const std::vector<double> uneven{0, 30, 100, 140, 300, 500, 520};

TEST(Splines, ThroughACubicAreTheCubic) {
    const auto cubic = [](double s) { return 1e6 + 2e3 * s - 7 * s * s + 0.02 * s * s * s; };
    const model::Bearing bearing = splined(table_of(uneven, cubic));
    double largest = 0;
    for (const double s : uneven)
        largest = std::max({largest, std::abs(cubic(s)), 5 + s});
    // What the lines between the rows may depart by, and the damping beside them is a line.
    for (double s = 0; s <= 520; s += 3.7) {
        EXPECT_NEAR(bearing.at(s).k(0, 0), cubic(s), 1.0001e-5 * largest);
        EXPECT_NEAR(bearing.at(s).c(1, 1), 5 + s, 1e-12 * 525);
    }
}

TEST(Splines, PassThroughTheirRowsAndAreConstantOutside) {
    const auto wave = [](double s) { return 1e6 * (2 + std::sin(s / 60)); };
    const model::Bearing bearing = splined(table_of(uneven, wave));
    const model::Bearing lines = splined(table_of(uneven, wave), "linear");
    EXPECT_EQ(lines.rows.size(), uneven.size());
    for (const double s : uneven)
        EXPECT_EQ(bearing.at(s).k(0, 0), lines.at(s).k(0, 0)); // the same numbers
    EXPECT_EQ(bearing.at(-5).k, bearing.at(0).k);
    EXPECT_EQ(bearing.at(900).k, bearing.at(520).k);
    EXPECT_NE(bearing.at(200).k, lines.at(200).k);
}

/// Not-a-knot, as CubicSpline of SciPy and spline of MATLAB by default: four cubics whose sixteen
/// coefficients were solved for in rational numbers. The lines between the rows may depart by 1e-5
/// of 4e6.
TEST(Splines, AreThoseOfOtherPrograms) {
    const std::vector<double> speeds{0, 100, 150, 400, 700};
    const std::vector<double> k{1e6, 3e6, 2.5e6, 1e6, 4e6};
    const model::Bearing bearing = splined(table_of(speeds, [&](double s) {
        return k[static_cast<std::size_t>(std::find(speeds.begin(), speeds.end(), s) -
                                          speeds.begin())];
    }));
    EXPECT_NEAR(bearing.at(40).k(0, 0), 2570650.7462686566, 40.1);
    EXPECT_NEAR(bearing.at(120).k(0, 0), 2840731.6146540027, 40.1);
    EXPECT_NEAR(bearing.at(275).k(0, 0), 1369339.382632293, 40.1);
    EXPECT_NEAR(bearing.at(620).k(0, 0), 2595964.1791044776, 40.1);
}

/// Every row is a piece to solve for: of two bearings with tables over the same speeds the finer
/// rows hold the coarser ones.
TEST(Splines, OverTheSameSpeedsShareTheirRows) {
    const model::Bearing fine =
        splined(table_of(uneven, [](double s) { return 1e6 * (2 + std::sin(s / 60)); }));
    const model::Bearing coarse =
        splined(table_of(uneven, [](double s) { return 1e6 * (200 + std::sin(s / 60)); }));
    EXPECT_GT(fine.speeds.size(), 2 * coarse.speeds.size());
    EXPECT_GT(coarse.speeds.size(), uneven.size());
    EXPECT_TRUE(std::includes(fine.speeds.begin(), fine.speeds.end(), coarse.speeds.begin(),
                              coarse.speeds.end()));
}

TEST(Splines, ThroughThreeRowsAreAParabola) {
    const auto parabola = [](double s) { return 1e6 + 2e3 * s - 3 * s * s; };
    const model::Bearing bearing = splined(table_of({0, 30, 100}, parabola));
    for (double s = 0; s <= 100; s += 7)
        EXPECT_NEAR(bearing.at(s).k(0, 0), parabola(s), 1.0001e-5 * parabola(100));
    const auto line = [](double s) { return 1e6 + 2e3 * s; };
    EXPECT_EQ(splined(table_of({0, 30}, line)).rows.size(), 2U);
}

} // namespace
} // namespace whirl::tests
