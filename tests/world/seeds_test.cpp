// SPDX-License-Identifier: Apache-2.0
// An hour of a crowd for each of 20 seeds. SEEDS=1000 takes seeds 1 to 1000, SEED=17 that one
// alone, MINUTES=5 five minutes of each (docs/testing.md).
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/log.h"
#include "world/crowd.h"

namespace theatron::world {
namespace {

int given(const char* variable, int otherwise) {
    const char* value = std::getenv(variable);
    return value ? std::atoi(value) : otherwise;
}

TEST(WorldSeeds, AllAgreeAndNothingLeaks) {
    const int only = given("SEED", 0);
    const int last = only > 0 ? only : given("SEEDS", 20);
    const Duration time = std::chrono::minutes(given("MINUTES", 60));
    log::set_level(only > 0 ? log::Level::info : log::Level::error);
    Crowd::Seen seen;
    for (int seed = std::max(only, 1); seed <= last; ++seed) {
        Crowd crowd{unsigned(seed)};
        const std::string wrong = crowd.live(time);
        EXPECT_EQ(wrong, "") << "Again: SEED=" << seed
                             << " build/release/tests/world/world_test "
                                "--gtest_filter='WorldSeeds.*'";
        seen.people += crowd.seen().people;
        seen.objects += crowd.seen().objects;
        seen.held += crowd.seen().held;
    }
    log::set_level(log::Level::info);
    EXPECT_GT(seen.people, 0u);
    EXPECT_GT(seen.objects, seen.people);
    EXPECT_GT(seen.held, 0u);
    RecordProperty("people", std::to_string(seen.people));
    RecordProperty("objects", std::to_string(seen.objects));
    RecordProperty("held", std::to_string(seen.held));
}

}  // namespace
}  // namespace theatron::world
