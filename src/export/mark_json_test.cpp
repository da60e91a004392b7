// SPDX-License-Identifier: Apache-2.0
#include "export/mark_json.h"

#include <gtest/gtest.h>

namespace theatron::exporting {
namespace {

TEST(MarkJson, APinHasItsNumberAuthorAndOrgan) {
    session::Mark mark;
    mark.kind = session::MarkKind::pin;
    mark.surface = session::MarkedSurface::organ;
    mark.object = 7;
    mark.number = 3;
    mark.initials = "AB";
    mark.points = {{{1, 2, 0.5}, {0, 1, 0}}};
    EXPECT_EQ(mark_json(mark), nlohmann::json::parse(R"({"kind": "pin", "surface": "organ",
        "object": 7, "number": 3, "initials": "AB", "points": [[1.0, 2.0, 0.5]]})"));
}

TEST(MarkJson, ADistanceHasItsLengthAndItsDeviationIfKnown) {
    session::Mark mark;
    mark.kind = session::MarkKind::distance;
    mark.points = {{{0, 0, 0}, {0, 1, 0}}, {{0, 3, 4}, {0, 1, 0}}};
    EXPECT_EQ(mark_json(mark).at("length_m"), 5.0);
    EXPECT_FALSE(mark_json(mark).contains("deviation_m"));
    mark.deviation_m = 0.25f;
    EXPECT_EQ(mark_json(mark).at("deviation_m"), 0.25);
    EXPECT_FALSE(mark_json(mark).contains("number"));
}

}  // namespace
}  // namespace theatron::exporting
