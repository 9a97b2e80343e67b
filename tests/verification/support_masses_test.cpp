// Mass coefficients of bearings and pedestals that differ in x and y, against systems of two or
// four unknowns solved here.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/simulate.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "support/rigid_jeffcott.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using results::Form;
using Complex = std::complex<double>;

/// Eigenvalues of M u'' + C u' + K u = 0 with positive imaginary part, ascending by it.
std::vector<Complex> eigenvalues(const Eigen::MatrixXd &M, const Eigen::MatrixXd &C,
                                 const Eigen::MatrixXd &K) {
    const Eigen::Index n = M.rows();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).setIdentity();
    A.bottomLeftCorner(n, n) = -M.inverse() * K;
    A.bottomRightCorner(n, n) = -M.inverse() * C;
    std::vector<Complex> out;
    for (const Complex &value : A.eigenvalues())
        if (value.imag() > 0)
            out.push_back(value);
    std::sort(out.begin(), out.end(),
              [](const Complex &a, const Complex &b) { return a.imag() < b.imag(); });
    return out;
}

/// The nearest mode to each expected eigenvalue; the tilt has others.
void expect_among(const model::Rotor &rotor, Form form, double speed,
                  const std::vector<Complex> &expected) {
    const modes::Spectrum found = tests::spectrum_of(rotor, form, 1, speed, 8);
    for (const Complex &value : expected) {
        double nearest = 1e300;
        for (const modes::WhirlMode &mode : found.modes)
            nearest = std::min(nearest, std::abs(mode.eigenvalue - value));
        EXPECT_LT(nearest, 1e-9 * std::abs(value)) // rounding of a few unknowns
            << results::form_name(form) << " " << value;
    }
}

/// Its translation: mass on two bearings together, with masses in the films.
struct Jeffcott {
    tests::RigidJeffcott rotor;
    Eigen::Matrix2d m = Eigen::Matrix2d::Zero(); ///< of both bearings together, kg

    [[nodiscard]] model::Case scene() const {
        model::Case out = rotor.scene();
        for (model::Bearing &bearing : out.rotor.bearings)
            bearing.rows[0].m = m / 2;
        return out;
    }
    [[nodiscard]] std::vector<Complex> translation() const {
        const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
        return eigenvalues(rotor.mass * one + m, rotor.c * one,
                           Eigen::Vector2d(rotor.kx, rotor.ky).asDiagonal());
    }
};

TEST(SupportMasses, MoveWithTheRotor) {
    Jeffcott of;
    of.rotor.c = 0;
    of.m.diagonal() << 6, 6;
    const model::Case scene = of.scene();
    EXPECT_EQ(modes::choose_formulation(scene).form, Form::planar);
    const double natural = std::sqrt(of.rotor.kx / (of.rotor.mass + 6));
    ASSERT_NEAR(of.translation()[0].imag() / natural, 1, 1e-14);
    for (const Form form :
         {Form::planar, Form::planar_damped, Form::hyperbolic, Form::general, Form::rotating})
        expect_among(scene.rotor, form, 50, {Complex(0, natural)});
    model::Case swept = scene;
    swept.speeds = model::SpeedRange{0, 400, 5};
    const auto critical = analyses::critical_speeds(swept).critical_speeds;
    ASSERT_FALSE(critical.empty());
    EXPECT_NEAR(critical.front().speed / natural, 1, 1e-10);
}

TEST(SupportMasses, ThatDifferInXAndYSplitTheFrequencies) {
    Jeffcott of;
    of.rotor.c = 0;
    of.m.diagonal() << 6, 1;
    EXPECT_EQ(modes::choose_formulation(of.scene()).form, Form::hyperbolic);
    for (const Form form : {Form::hyperbolic, Form::general})
        expect_among(of.scene().rotor, form, 50,
                     {Complex(0, std::sqrt(1e6 / 16)), Complex(0, std::sqrt(1e6 / 11))});
}

TEST(SupportMasses, MayCoupleXAndY) {
    for (const double across : {2.0, -2.0}) { // myx = mxy, myx = -mxy
        Jeffcott of;
        of.m << 6, 2, across, 3;
        EXPECT_EQ(modes::choose_formulation(of.scene()).form, Form::general);
        expect_among(of.scene().rotor, Form::general, 50, of.translation());
    }
}

TEST(SupportMasses, AreInTheResponse) {
    Jeffcott of;
    of.rotor.ky = 1.3e6;
    of.m << 6, 2, 1, 3;
    model::Case scene = of.scene();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3, 0.4)};
    scene.speeds = model::SpeedRange{100, 400, 4};
    const auto result = analyses::unbalance_response(scene);
    const auto middle = std::find_if(result.nodes.begin(), result.nodes.end(),
                                     [](const auto &node) { return node.z == 0.5; });
    ASSERT_NE(middle, result.nodes.end());
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double w = result.speeds[i];
        const Complex iw(0, w);
        const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
        const Eigen::Matrix2d K = Eigen::Vector2d(of.rotor.kx, of.rotor.ky).asDiagonal();
        const Eigen::Matrix2cd film = K + iw * of.rotor.c * one - w * w * of.m;
        const Complex f = 1e-3 * w * w * std::polar(1.0, 0.4);
        const Eigen::Vector2cd load(f, -Complex(0, 1) * f);
        const Eigen::Vector2cd u = (film - w * w * of.rotor.mass * one).inverse() * load;
        EXPECT_NEAR(middle->x[i] / std::abs(u(0)), 1, 1e-10);
        EXPECT_NEAR(middle->y[i] / std::abs(u(1)), 1, 1e-10);
        // Half of the force each; largest over a turn: the larger singular value of (Re, Im).
        const Eigen::Vector2cd force = film * u / 2;
        Eigen::MatrixXd parts(2, 2);
        parts << force.real(), force.imag();
        const double largest = parts.jacobiSvd().singularValues()(0);
        EXPECT_NEAR(result.bearings[0].force[i] / largest, 1, 1e-9);
    }
}

/// One plane of a mass on films in series with pedestals: two unknowns.
std::vector<Complex> on_pedestals(double mass, double k, double m, double c, double pedestal_mass,
                                  double pedestal_k, double pedestal_c) {
    Eigen::Matrix2d M;
    M << mass + m, -m, -m, pedestal_mass + m;
    Eigen::Matrix2d C;
    C << c, -c, -c, c + pedestal_c;
    Eigen::Matrix2d K;
    K << k, -k, -k, k + pedestal_k;
    return eigenvalues(M, C, K);
}

TEST(Pedestals, MayDifferInXAndY) {
    for (const double c : {0.0, 200.0}) {
        Jeffcott of;
        of.rotor.c = c;
        of.m.diagonal() << 2, 2;
        model::Case scene = of.scene();
        for (model::Bearing &bearing : scene.rotor.bearings) {
            bearing.pedestal.emplace();
            bearing.pedestal->mass << 5, 8; // together twice as much
            bearing.pedestal->k << 2e6, 0.7e6;
            bearing.pedestal->c << c, 3 * c;
        }
        const Form form = c == 0 ? Form::hyperbolic : Form::general;
        EXPECT_EQ(modes::choose_formulation(scene).form, form);
        std::vector<Complex> expected = on_pedestals(10, 1e6, 2, c, 10, 4e6, 2 * c);
        const std::vector<Complex> y = on_pedestals(10, 1e6, 2, c, 16, 1.4e6, 6 * c);
        expected.insert(expected.end(), y.begin(), y.end());
        ASSERT_EQ(expected.size(), 4U);
        expect_among(scene.rotor, form, 70, expected);
        expect_among(scene.rotor, Form::general, 70, expected);
    }
}

TEST(Pedestals, ThatDifferAreSolvedElementByElementToo) {
    model::Case scene;
    scene.rotor = tests::rotor_on_unlike_masses();
    scene.speeds = model::SpeedRange{20, 400, 8};
    const auto result = analyses::unbalance_response(scene);
    // The error is a difference to a finer model, condensed: order 4 is good to some 1e-7 here.
    for (const auto &node : result.nodes)
        for (const auto &error : node.error)
            EXPECT_LT(error, 1e-5);
    for (const auto &bearing : result.bearings)
        for (const auto &error : bearing.error)
            EXPECT_LT(error, 1e-5);
}

TEST(SupportMasses, AreRefusedWhereTheyWouldVaryInTime) {
    Jeffcott of;
    of.m.diagonal() << 6, 1;
    model::Case scene = of.scene();
    scene.rotor.anisotropies = {{"", 0.5, 0.01, 0}};
    EXPECT_THROW((void)modes::choose_formulation(scene), model::BadInput);
    model::Case simulated = of.scene();
    simulated.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    simulated.rotor.anisotropies = {{"", 0.5, 0.01, 0}};
    simulated.speeds = model::SpeedRange{50, 50, 1};
    simulated.simulate.time = 1;
    EXPECT_THROW((void)analyses::simulate(simulated), model::AnalysisFailure);
}

} // namespace
