// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_target.h"

#include <gtest/gtest.h>

#include "registration/lattice_edges.h"
#include "registration/target_drawing.h"

namespace theatron::registration {
namespace {

constexpr int columns = LatticeTarget::columns, rows = LatticeTarget::rows;

int cells_that_differ(Face a, Face b, bool b_upside_down) {
    int count = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            count += is_filled(a, column, row) !=
                     (b_upside_down ? is_filled(b, columns - 1 - column, rows - 1 - row)
                                    : is_filled(b, column, row));
    return count;
}

TEST(LatticeTarget, LooksDifferentInEveryWayToSeeIt) {
    EXPECT_GE(cells_that_differ(Face::front, Face::back, false), 4);
    EXPECT_GE(cells_that_differ(Face::front, Face::front, true), 4);
    EXPECT_GE(cells_that_differ(Face::front, Face::back, true), 4);
}

TEST(LatticeTarget, TheBackIsTheFrontSeenFromBehindOneThicknessAway) {
    const LatticeTarget target = large_target();
    const Pose board_from_back = board_from_face(target, Face::back);
    const Rect corner = cell(target, 0, 0);
    const Vec3 on_back{corner.left, corner.top, 0};
    const Vec3 on_board = board_from_back * on_back;
    EXPECT_NEAR(on_board.x, -corner.left, 1e-12);
    EXPECT_NEAR(on_board.y, corner.top, 1e-12);
    EXPECT_NEAR(on_board.z, -target.thickness_m, 1e-12);
    EXPECT_TRUE(is_filled(Face::front, 0, 0));
    EXPECT_TRUE(is_filled(Face::back, columns - 1, 0));
}

TEST(LatticeTarget, RefusesSizesThatLeaveNoHoles) {
    EXPECT_TRUE(is_valid(large_target()));
    EXPECT_TRUE(is_valid(a2_target()));
    LatticeTarget target;
    target.bar_m = 0.15;
    EXPECT_FALSE(is_valid(target));
    target = {};
    target.thickness_m = -0.01;
    EXPECT_FALSE(is_valid(target));
    target = {};
    target.width_m = std::nan("");
    EXPECT_FALSE(is_valid(target));
}

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++n;
    return n;
}

TEST(TargetDrawing, HasTheOutlineAndEveryHoleAtTrueScale) {
    const LatticeTarget target = large_target();
    const std::string svg = svg_drawing(target);
    EXPECT_NE(svg.find("width=\"800.000mm\" height=\"600.000mm\" viewBox=\"0 0 800.000 600.000\""),
              std::string::npos);
    EXPECT_EQ(count(svg, "<rect "), 10);
    // The first hole of the first row lies two cells and three bars from the left.
    EXPECT_NE(svg.find("<rect x=\"430.000\" y=\"60.000\" width=\"125.000\" height=\"120.000\"/>"),
              std::string::npos);
    const std::string dxf = dxf_drawing(target);
    EXPECT_EQ(count(dxf, "POLYLINE"), 10);
    // Upwards in DXF: that hole's lower left corner.
    EXPECT_NE(dxf.find("VERTEX\n8\nCUT\n10\n430.000\n20\n420.000\n"), std::string::npos);
    EXPECT_NE(dxf.find("$INSUNITS\n70\n4\n"), std::string::npos);
}

TEST(ApparentEdge, LiesFurtherOutTheDarkerTheBackgroundIs) {
    const PixelBlur blur({1, 0});
    const EdgeReach reach{0.02, 1, 0.01};
    const double alike = apparent_edge_px(blur, {0, 0, 1}, reach);
    const double dark = apparent_edge_px(blur, {0, 0, 0.1}, reach);
    EXPECT_LT(std::abs(alike), 0.2);
    EXPECT_GT(dark, alike + 0.2);
    // A wall as bright as the face adds its width, minus the part too far behind the face; a black
    // one adds little.
    EXPECT_GT(apparent_edge_px(blur, {1.5, 1, 0.1}, reach), dark + 1);
    EXPECT_LT(apparent_edge_px(blur, {1.5, 0.01, 0.1}, reach),
              apparent_edge_px(blur, {1.5, 1, 0.1}, reach) - 0.3);
}

TEST(SeenEdges, DerivativesOfCoverageAreThoseOfItsValues) {
    const LatticeTarget target = large_target();
    BackgroundLight background;
    background.outline.fill(0.3);
    background.cells.fill(0.2);
    const Pose pose{rotation_about({0, 1, 0}, 2.6), {0.1, 0, 2}};
    const SeenEdges seen(target, Face::front, pose, 0.002, 0.02, background, 0.1);
    constexpr double ramp = 0.02, step = 1e-7;
    const EdgeParams at{0.001, 0.0005, 0.2};
    for (const auto& [u, v] :
         {std::pair{-0.398, 0.1}, {0.032, 0.18}, {0.157, 0.245}, {0.2, -0.299}}) {
        const Coverage c = seen.at(u, v, ramp, ramp, at);
        ASSERT_TRUE(c.by_u != 0 || c.by_v != 0) << u << " " << v;
        const auto share = [&, u = u, v = v](double du, double dv, EdgeParams p) {
            return seen.at(u + du, v + dv, ramp, ramp, p).share;
        };
        const auto by_param = [&](double EdgeParams::*member) {
            EdgeParams more = at, less = at;
            more.*member += step;
            less.*member -= step;
            return (share(0, 0, more) - share(0, 0, less)) / (2 * step);
        };
        EXPECT_NEAR(c.by_u, (share(step, 0, at) - share(-step, 0, at)) / (2 * step), 1e-5);
        EXPECT_NEAR(c.by_v, (share(0, step, at) - share(0, -step, at)) / (2 * step), 1e-5);
        EXPECT_NEAR(c.by_params[0], by_param(&EdgeParams::outline_growth_m), 1e-5);
        EXPECT_NEAR(c.by_params[1], by_param(&EdgeParams::hole_growth_m), 1e-5);
        EXPECT_NEAR(c.by_params[2], by_param(&EdgeParams::log_background), 1e-5);
    }
}

TEST(LatticeTarget, APatternKnowsHowFarAPlaceLiesFromItsEdges) {
    const LatticeTarget target = large_target();
    for (const Face face : {Face::front, Face::back}) {
        const FacePattern pattern(target, face);
        for (int row = 0; row < LatticeTarget::rows; ++row)
            for (int column = 0; column < LatticeTarget::columns; ++column) {
                const Rect c = cell(target, column, row);
                const double u = c.left + 0.01, v = (c.bottom + c.top) / 2;
                ASSERT_EQ(pattern.nearest_cell(u, v), row * LatticeTarget::columns + column);
                const bool is_hole = !is_filled(face, column, row);
                EXPECT_EQ(pattern.is_hole(pattern.nearest_cell(u, v)), is_hole);
                if (is_hole)
                    EXPECT_NEAR(pattern.inside(u, v).solid(), -0.01, 1e-12);
                else
                    EXPECT_GT(pattern.inside(u, v).solid(), 0.06);
            }
        EXPECT_NEAR(pattern.inside(-0.41, 0.1).outline, -0.01, 1e-12);
        EXPECT_NEAR(pattern.inside(0.38, 0).solid(), 0.02, 1e-12);
        EXPECT_EQ(pattern.side_beyond(-0.45, 0.1), 0);
        EXPECT_EQ(pattern.side_beyond(0.1, 0.35), 3);
    }
}

}  // namespace
}  // namespace theatron::registration
