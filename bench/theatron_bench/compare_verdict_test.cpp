// SPDX-License-Identifier: Apache-2.0
#include "compare_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "given_comparison.h"

namespace theatron::bench {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

CompareMethod with_shares(CompareMethod method, const char* id, double rightly, double wrongly) {
    method.id = id;
    method.wound->near = {rightly, wrongly, 100 - rightly - wrongly, 0, 3.4};
    return method;
}

// A usual call that shows 40 %.
Compared with_ours(double rightly, double wrongly) {
    Compared c = given_comparison();
    c.methods.back() = with_shares(c.methods.back(), theatron_id, rightly, wrongly);
    return c;
}

Compared with_zoomed(Compared c, double rightly) {
    c.methods.push_back(with_shares(c.methods.front(), zoomed_call_id, rightly, 0));
    c.methods.back().wound->near.detail_mm = 0.5;
    return c;
}

TEST(CompareVerdict, BeginsWithWhatIsShownOfTheWoundAndWhetherItMayBeJudged) {
    const auto first = [](double rightly, double wrongly) {
        return compare_verdict(with_ours(rightly, wrongly)).front();
    };
    EXPECT_EQ(
        first(60, 38.16),
        "Of what an expert at the foot of the table should see in a circle at the wound, 20 cm "
        "wide, Theatron's picture shows 60.0 % rightly, which is at most 2 cm off, something "
        "else in place of 38.2 %, without a warning, and nothing in place of 1.8 %: do not "
        "judge the wound from it.");
    const std::string look = ": look at the video, too, before you judge the wound.";
    EXPECT_THAT(first(94, 4.9), EndsWith(look));
    EXPECT_THAT(first(94, 0.4), EndsWith(look));  // much is not shown
    EXPECT_THAT(first(98, 0.4), EndsWith("nothing in place of 1.6 %."));
}

TEST(CompareVerdict, SaysWhetherAVideoCallShowsMore) {
    const auto against = [](double rightly, double wrongly, double zoomed) {
        return compare_verdict(with_zoomed(with_ours(rightly, wrongly), zoomed)).at(2);
    };
    EXPECT_EQ(against(60, 30, 50),
              "At the wound Theatron shows more than the zoomed video call, and also what is not "
              "there: it does not replace the video.");
    EXPECT_EQ(against(60, 0.5, 50),
              "At the wound Theatron is better than the zoomed video call: it shows more, and next "
              "to nothing falsely.");
    EXPECT_EQ(
        against(60, 30, 70),
        "At the wound the zoomed video call is better than Theatron alone: it shows more, and "
        "nothing falsely.");
    EXPECT_EQ(against(60, 30, 60.5),
              "At the wound the zoomed video call is better than Theatron alone: it shows as much, "
              "and nothing falsely.");
    EXPECT_EQ(against(60, 0.5, 70),
              "At the wound the zoomed video call is better than Theatron alone: it shows more.");
    EXPECT_EQ(against(60, 0.5, 60.5),
              "At the wound Theatron and the zoomed video call show as much.");
}

TEST(CompareVerdict, TellsTheShareAndTheDetailOfCalls) {
    EXPECT_THAT(compare_verdict(with_zoomed(with_ours(60, 30), 45)),
                AllOf(Contains("A video call shows 40.0 % of it, a zoomed one 45.0 %, and nothing "
                               "falsely: what no camera of it sees from its fixed place is "
                               "hidden."),
                      Contains("Detail: a pixel of the best camera is 3.4 mm of the wound with "
                               "Theatron, and 0.5 mm with the zoomed video call.")));
    EXPECT_THAT(compare_verdict(with_ours(60, 30)),
                AllOf(Contains(StartsWith("A video call shows 40.0 % of it, and nothing")),
                      Contains(HasSubstr("more than the video call, and also"))));
}

TEST(CompareVerdict, AdvisesBothAtOnceWithTheirPriceWhileTheWoundIsNotToBeJudged) {
    Compared c = with_ours(60, 30);
    EXPECT_THAT(compare_verdict(c), Contains("Use Theatron beside a video picture of the wound, "
                                             "not in its place. Where they differ, believe the "
                                             "video."));
    c.methods.push_back(with_shares(c.methods.back(), theatron_and_call_id, 88, 5));
    EXPECT_THAT(compare_verdict(c),
                Contains("Use Theatron beside a video picture of the wound, not in its place: "
                         "together they need 31.0 Mbit/s, and at least one of the two pictures "
                         "shows 88.0 % rightly. Where they differ, believe the video."));
    EXPECT_THAT(compare_verdict(with_ours(98, 0.4)), Not(Contains(HasSubstr("not in its place"))));
}

TEST(CompareVerdict, SaysWhatTheatronShowsWhereTheVideoShowsNothing) {
    Compared c = with_zoomed(with_ours(60, 30), 80);
    c.methods.push_back(with_shares(c.methods[2], theatron_and_call_id, 88, 12));
    EXPECT_THAT(
        compare_verdict(c),
        Contains(HasSubstr("Where the video shows nothing, Theatron shows 8.0 % rightly and "
                           "12.0 % wrongly: do not judge what only Theatron shows.")));
}

TEST(CompareVerdict, NamesTwoOrdinaryCamerasWhereTheyShowAsMuch) {
    const auto with_two = [](double rightly) {
        Compared c = with_ours(60, 30);
        c.methods.push_back(with_shares(c.methods.front(), two_camera_call_id, rightly, 0));
        return compare_verdict(c);
    };
    EXPECT_THAT(with_two(86),
                AllOf(Contains("For the wound alone, a video call with two cameras shows as much "
                               "for 2.0 Mbit/s, and nothing falsely."),
                      Contains(HasSubstr("one with two cameras 86.0 % at 3.4 mm a pixel"))));
    EXPECT_THAT(with_two(50), Not(Contains(StartsWith("For the wound alone"))));
}

TEST(CompareVerdict, SaysTheLargestCauseAndWhatInstrumentsLose) {
    EXPECT_THAT(
        compare_verdict(given_comparison()),
        AllOf(Contains("The largest cause of what Theatron does not show rightly: no camera "
                       "sees the place, 30.0 of 38.0 %; its sensors, filters and drawing lose the "
                       "other 8.0."),
              Contains("32.0 % of the surface of instruments is missing in Theatron's "
                       "picture: do not guide "
                       "an instrument by it.")));
}

TEST(CompareVerdict, SaysWhetherANearCameraHelpsAndWhatItCosts) {
    const auto with_near = [](double rightly, double wrongly) {
        Compared c = with_ours(60, 30);
        c.methods.push_back(with_shares(c.methods.back(), theatron_near_id, rightly, wrongly));
        c.methods.back().mbit_per_camera = 23.5;
        return compare_verdict(c);
    };
    EXPECT_THAT(
        with_near(90, 3),
        Contains("With one camera more, about a metre from the wound, Theatron shows 90.0 % "
                 "rightly in place of 60.0 %, and 3.0 % wrongly in place of 30.0 %; it "
                 "needs 47.0 Mbit/s in place of 31.0 Mbit/s."));
    EXPECT_THAT(with_near(80, 9),
                Contains(EndsWith("9.0 % shown wrongly are still too much to judge the wound.")));
    EXPECT_THAT(with_near(60, 3), Contains(EndsWith("This camera does not help.")));
}

TEST(CompareVerdict, IsEmptyWithoutThePictureOfTheWound) {
    Compared c = given_comparison();
    c.methods.back().wound.reset();
    EXPECT_TRUE(compare_verdict(c).empty());
    c = given_comparison();
    c.methods.back().reason = "No encoder.";
    EXPECT_TRUE(compare_verdict(c).empty());
}

}  // namespace
}  // namespace theatron::bench
