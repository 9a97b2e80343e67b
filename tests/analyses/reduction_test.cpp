// Answers on few shapes against those on all unknowns (reduction = "off"): the same roots and
// maxima. Ends of bands and peaks are found again on, or certified by, the whole rotor to 1e-9.
#include "analyses/response.h"
#include "analyses/stability.h"
#include "input/case_file.h"
#include "results/response.h"
#include "results/stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace whirl::analyses {
namespace {

model::Case shipped(const std::string &name, bool reduction) {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/" + name);
    scene.reduction = reduction;
    return scene;
}

TEST(Reduction, LeavesThePeaksOfTheResponse) {
    for (const char *name : {"nelson_mcvaugh", "keyway_gravity"}) {
        const auto reduced = unbalance_response(shipped(name, true));
        const auto whole = unbalance_response(shipped(name, false));
        const auto peaks = [](const results::ResponseResult &result) {
            return result.gravity ? result.gravity->peaks : result.peaks;
        };
        const auto a = peaks(reduced);
        const auto b = peaks(whole);
        ASSERT_FALSE(b.empty()) << name;
        ASSERT_EQ(a.size(), b.size()) << name;
        for (std::size_t i = 0; i < b.size(); ++i) {
            EXPECT_EQ(a[i].of, b[i].of);
            EXPECT_EQ(a[i].z, b[i].z);
            EXPECT_NEAR(a[i].speed / b[i].speed, 1, 1e-8) << name; // flat tops: root of 1e-16
            if (std::isfinite(b[i].value))
                EXPECT_NEAR(a[i].value / b[i].value, 1, 3e-9) << name;
            else // a resonance without damping
                EXPECT_EQ(a[i].value, b[i].value) << name;
        }
    }
}

TEST(Reduction, LeavesEndsAndGrowthOfStability) {
    for (const char *name : {"centrifuge_two_balls", "disc_type_short"}) {
        const auto reduced = stability(shipped(name, true), {});
        const auto whole = stability(shipped(name, false), {});
        ASSERT_EQ(reduced.ends.size(), whole.ends.size()) << name;
        for (std::size_t i = 0; i < whole.ends.size(); ++i) {
            EXPECT_EQ(reduced.ends[i].kind, whole.ends[i].kind) << name;
            EXPECT_NEAR(reduced.ends[i].speed / whole.ends[i].speed, 1, 1e-9) << name;
            EXPECT_EQ(reduced.ends[i].growing_above, whole.ends[i].growing_above) << name;
        }
        ASSERT_EQ(reduced.growth.size(), whole.growth.size());
        for (std::size_t k = 0; k < whole.growth.size(); ++k)
            EXPECT_NEAR(reduced.growth[k], whole.growth[k], 1e-8 * (1 + whole.speeds[k]))
                << name << " " << whole.speeds[k];
    }
}

} // namespace
} // namespace whirl::analyses
