// SPDX-License-Identifier: Apache-2.0
#include "compare_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "given_comparison.h"

namespace theatron::bench {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Compared with_see_through(double percent) {
    Compared c = given_comparison();
    c.methods.back().close_up->likeness->see_through_percent = percent;
    return c;
}

TEST(CompareVerdict, TheFiguresChooseTheSentence) {
    EXPECT_THAT(compare_verdict(with_see_through(28.16)),
                AllOf(Contains(HasSubstr("on 28.2 % of its area: do not judge the wound from it.")),
                      Contains(HasSubstr("not in its place"))));
    EXPECT_THAT(compare_verdict(with_see_through(4.9)),
                Contains(HasSubstr("look at the video, too, before you judge the wound.")));
    EXPECT_THAT(compare_verdict(with_see_through(0.4)),
                AllOf(Contains(HasSubstr("on 0.4 % of its area.")),
                      Not(Contains(HasSubstr("not in its place")))));
}

TEST(CompareVerdict, SaysTheLargestCauseAndWhatInstrumentsLose) {
    EXPECT_THAT(compare_verdict(given_comparison()),
                AllOf(Contains("The largest cause: no camera sees the place, 1.5 of 2.0 %."),
                      Contains("32.0 % of the surface of instruments is missing in Theatron's "
                               "picture: do not guide "
                               "an instrument by it.")));
}

TEST(CompareVerdict, SaysWhetherANearCameraHelps) {
    const auto with_near = [](double percent) {
        Compared c = with_see_through(28);
        CompareMethod near = c.methods.back();
        near.id = theatron_near_id;
        near.close_up->likeness->see_through_percent = percent;
        c.methods.push_back(near);
        return compare_verdict(c);
    };
    EXPECT_THAT(with_near(3), Contains(HasSubstr("the share is 3.0 % in place of 28.0 %.")));
    EXPECT_THAT(with_near(9), Contains(HasSubstr("still too much to judge the wound.")));
}

TEST(CompareVerdict, IsEmptyWithoutACloseUp) {
    Compared c = given_comparison();
    c.methods.back().close_up.reset();
    EXPECT_TRUE(compare_verdict(c).empty());
    c = given_comparison();
    c.methods.back().reason = "No encoder.";
    EXPECT_TRUE(compare_verdict(c).empty());
}

}  // namespace
}  // namespace theatron::bench
