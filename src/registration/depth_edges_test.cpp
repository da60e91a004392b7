// SPDX-License-Identifier: Apache-2.0
#include "registration/depth_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "registration/modelled_camera_test.h"

namespace theatron::registration {
namespace {

constexpr int near_mm = 1500, far_mm = 2200;

// The share of a pixel that begins at `at` behind an edge at `edge`.
double share_before(double at, double edge) {
    return std::clamp(edge - at, 0.0, 1.0);
}

class Edges : public ::testing::Test {
protected:
    Edges() : camera_(azure_camera(), 1), depth_(camera_.model.size) {}

    // A plate that ends at column `right` (in the middle row; the edge leans) and at row `bottom`,
    // before a wall. Pixels that show both have a depth between them.
    DepthView plate(double right, double bottom) {
        for (int y = 0; y < depth_.size.height; ++y)
            for (int x = 0; x < depth_.size.width; ++x) {
                const double near = share_before(x, right + 0.3 * (y - 288)) *
                                    share_before(y, bottom + 0.2 * (x - 320));
                depth_.view().row(y)[x] =
                    std::uint16_t(std::lround(near * near_mm + (1 - near) * far_mm));
            }
        return std::as_const(depth_).view();
    }

    std::vector<DepthEdge> edges_of(int images = 4) {
        EdgeReference reference(depth_.size);
        for (int i = 0; i < images; ++i)
            reference.add(std::as_const(depth_).view());
        return reference.edges(camera_, 0.004);
    }

    SurfaceCamera camera_;
    DepthImage depth_;
};

TEST_F(Edges, StandAtAFractionOfAPixel) {
    plate(330.3, 300.6);
    const std::vector<DepthEdge> edges = edges_of();
    int in_rows = 0;
    for (const DepthEdge& edge : edges) {
        in_rows += edge.is_in_row;
        const double truth = edge.is_in_row ? 330.3 + 0.3 * (edge.y - 288) - edge.x - 0.5
                                            : 300.6 + 0.2 * (edge.x - 320) - edge.y - 0.5;
        EXPECT_NEAR(edge.position, truth, 0.02) << edge.x << " " << edge.y;
        EXPECT_TRUE(edge.is_near_first);
        EXPECT_NEAR(edge.near_units, near_mm, 1);
        EXPECT_NEAR(edge.far_units, far_mm, 1);
    }
    EXPECT_GT(in_rows, 40);
    EXPECT_GT(int(edges.size()) - in_rows, 40);
}

TEST_F(Edges, FollowAPlateThatMovesAndNothingElse) {
    plate(330.3, 300.6);
    const std::vector<DepthEdge> edges = edges_of();
    const std::vector<float> moved = edge_positions(edges, plate(330.8, 300.6));
    ASSERT_EQ(moved.size(), edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const bool is_in_row = edges[i].is_in_row;
        EXPECT_NEAR(moved[i] - edges[i].position, is_in_row ? 0.5 : 0, 0.02);
        // The point of the edge leaves the edge's plane by as much.
        Vec3 point;
        ASSERT_TRUE(edge_point(edges[i], moved[i], camera_, point));
        const double moved_mm = std::abs(dot(edges[i].normal, point - edges[i].at)) * 1000;
        // Half a pixel across a line that leans, more in the corners of the picture.
        EXPECT_GT(moved_mm, is_in_row ? 1.3 : -1);
        EXPECT_LT(moved_mm, is_in_row ? 1.8 : 0.1);
    }
}

TEST_F(Edges, ArePlacedByTheMiddleOfPixelsWithoutDepth) {
    plate(330, 1000);
    for (int y = 0; y < depth_.size.height; ++y)
        for (int x = 0; x < depth_.size.width; ++x)
            if (std::abs(x + 0.5 - (330 + 0.3 * (y - 288))) < 1.5)
                depth_.view().row(y)[x] = 0;
    const std::vector<DepthEdge> edges = edges_of();
    ASSERT_GT(edges.size(), 40u);
    double mean = 0;
    for (const DepthEdge& edge : edges)
        mean +=
            (edge.position - (330 + 0.3 * (edge.y - 288) - edge.x - 0.5)) / double(edges.size());
    EXPECT_NEAR(mean, 0, 0.05);
}

TEST_F(Edges, AreUnknownWhereSomethingElseStandsBeforeThem) {
    plate(330, 1000);
    const std::vector<DepthEdge> edges = edges_of();
    for (int y = 0; y < 288; ++y)
        std::fill_n(depth_.view().row(y), depth_.size.width, std::uint16_t(900));
    const std::vector<float> hidden = edge_positions(edges, std::as_const(depth_).view());
    for (std::size_t i = 0; i < edges.size(); ++i)
        EXPECT_EQ(std::isnan(hidden[i]), edges[i].y < 288) << edges[i].y;
}

TEST_F(Edges, OfThingsThatMoveAreLeftOut) {
    EdgeReference reference(depth_.size);
    for (int i = 0; i < 8; ++i)
        reference.add(plate(330 + 3 * i, 1000));
    EXPECT_TRUE(reference.edges(camera_, 0.004).empty());
}

TEST_F(Edges, NeedAStepInDepth) {
    for (int y = 0; y < depth_.size.height; ++y)
        for (int x = 0; x < depth_.size.width; ++x)
            depth_.view().row(y)[x] = std::uint16_t(1500 + 2 * x);
    EXPECT_TRUE(edges_of().empty());
    std::fill(depth_.pixels.begin(), depth_.pixels.end(), std::uint16_t(0));
    EXPECT_TRUE(edges_of().empty());
    EXPECT_TRUE(EdgeReference({640, 576}).edges(camera_, 0.004).empty()) << "no image";
}

}  // namespace
}  // namespace theatron::registration
