// SPDX-License-Identifier: Apache-2.0
#include "registration/registration_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::registration {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RegistrationReport two_cameras() {
    RegistrationReport report;
    report.made = "2026-05-04T10:20:30Z";
    report.before = "earlier places";
    RegistrationReport::Camera left;
    left.name = "left";
    left.bias.offset_m = 0.0031;
    left.bias.per_m = 0.0002;
    left.bias_sigma = {0.0007, 0.001, 0.001, 0.0009};
    left.is_reference = true;
    RegistrationReport::Camera right = left;
    right.is_reference = false;
    right.sigma = {1.4, 0.03};
    right.name = "<script>\"&right";
    right.earlier = Pose{{}, {0, 0.012, 0}};
    report.cameras = {left, right};
    RegistrationReport::Pair pair;
    pair.b = 1;
    pair.places = 10;
    for (int i = 0; i < 9; ++i) {
        pair.before.push_back({{0.1 * i, 1, 0}, 8});
        pair.after.push_back({{0.1 * i, 1, 0}, 1.2});
    }
    report.pairs = {pair};
    return report;
}

TEST(Report, SaysWhichFixedErrorsWereFoundAndHowFarSurfacesAreApart) {
    const std::string html = to_html(two_cameras());
    EXPECT_THAT(html, HasSubstr("<td class=found>+3.1 &#177; 0.7 mm"));
    EXPECT_THAT(html, HasSubstr("<td>+0.2 &#177; 0.9 mm/m"));  // cannot be told from none
    EXPECT_THAT(html, HasSubstr("Median of 9 surfaces: 8.0 mm before, 1.2 mm after"));
    EXPECT_THAT(html, HasSubstr("12.0 mm, 0.00&deg;"));
}

TEST(Report, IsOneFileThatNamesCannotBreakAndThatRefersToNothingOutside) {
    const std::string html = to_html(two_cameras());
    EXPECT_THAT(html, HasSubstr("&lt;script&gt;&quot;&amp;right"));
    for (const char* outside : {"<script>", "http", "src=", "url(", "<link"})
        EXPECT_THAT(html, Not(HasSubstr(outside)));
}

TEST(Report, ThereIsOneReferenceAndNoUncertaintyThatNobodyEstimated) {
    RegistrationReport report = two_cameras();
    std::string html = to_html(report);
    EXPECT_EQ(html.find("the reference"), html.rfind("the reference"));
    EXPECT_THAT(html, HasSubstr("1.4 mm, 0.03&deg;"));

    // As after a refinement on surfaces.
    for (RegistrationReport::Camera& camera : report.cameras) {
        camera.is_reference = false;
        camera.sigma.reset();
        camera.bias = {0.0025, 0, 0, 0};
        camera.bias_sigma = {};
    }
    html = to_html(report);
    EXPECT_THAT(html, Not(HasSubstr("the reference")));
    EXPECT_THAT(html, HasSubstr("not estimated"));
    EXPECT_THAT(html, HasSubstr("+2.5 mm, as before"));
    EXPECT_THAT(html, HasSubstr("not looked for"));
}

TEST(Report, CamerasWithoutACommonSurfaceAreSaidToBe) {
    RegistrationReport report = two_cameras();
    report.pairs[0].before.clear();
    report.pairs[0].after.clear();
    EXPECT_THAT(to_html(report), HasSubstr("They see no common surface"));
    EXPECT_THAT(to_html({}), HasSubstr("Registration of 0 cameras"));
}

}  // namespace
}  // namespace theatron::registration
