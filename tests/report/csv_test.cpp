
#include "results/response.h"
#include "sample_results.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::report {

TEST(Csv, CampbellHasUnitsOneRowAModeAndSpeedAndEmptyCells) {
    const auto lines = lines_of(to_csv(sample_campbell()));
    ASSERT_EQ(lines.size(), 1u + 3 * 2);
    EXPECT_EQ(lines[0],
              "speed [rad/s],mode,frequency [rad/s],real [1/s],damping_ratio,log_dec,"
              "whirl,forward_fraction,error,residual,plane [rad],error_mesh,error_reduction,"
              "error_rounding");
    EXPECT_EQ(lines[1].substr(0, 25), "0,1B,85.389371234123,0,0,");
    EXPECT_EQ(lines[4], "100,1F,,,,,forward,1,,1e-15,,,,");
    EXPECT_EQ(lines[6], "200,1F,110,2,-0.02,-0.1,forward,1,,1e-15,,0.5,0,0.25");
}

TEST(Csv, TextWithCommasAndQuotesStaysOneCell) {
    results::ResponseResult result;
    result.speeds = {100};
    result.nodes.resize(1);
    results::ResponseNode &node = result.nodes[0];
    node.z = 0.5;
    node.name = "disc, \"big\"";
    node.amplitude = node.major = {1e-5};
    node.phase = {0.1};
    node.minor = {-1e-6};
    EXPECT_EQ(lines_of(to_csv(result)).at(1),
              "100,node,\"disc, \"\"big\"\"\",0.5,1e-05,0.1,1e-05,-1e-06,,,,,,,,");
}

TEST(Csv, ProbesStandInTheResponseWithTheirDirections) {
    results::ResponseResult result;
    result.speeds = {100, 200};
    const double infinite = std::numeric_limits<double>::infinity();
    result.probes = {{0.25, 0.5, "left", {1e-5, infinite}, {-2, std::nan("")}, {1e-9, infinite}}};
    const auto lines = lines_of(to_csv(result));
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[1], "100,probe,left,0.25,1e-05,-2,,,,,,,,,1e-09,0.5");
    EXPECT_EQ(lines[2], "200,probe,left,0.25,,,,,,,,,,,,0.5") << "no limit";
    EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','),
              std::count(lines[1].begin(), lines[1].end(), ','));
}

} // namespace whirl::report
