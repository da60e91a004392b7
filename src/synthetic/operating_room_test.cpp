// SPDX-License-Identifier: Apache-2.0
#include "synthetic/operating_room.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/ray_table.h"

namespace theatron::synthetic {
namespace {

const SceneOptions small_scene{.seed = 3, .loop = 20s, .detail = 0.12};

// Shared by all tests, because construction takes about a second.
const OperatingRoom& small_room() {
    static const OperatingRoom room(small_scene);
    return room;
}

Calibration small_camera(int index) {
    Calibration c = synthetic_camera(Variant::room, index, 2, {});
    c.depth = scaled(c.depth, {160, 144});
    return c;
}

constexpr RenderOptions depth_and_surface{.depth = true, .surface = true, .color = false};

Vec3 room_point(const Calibration& c, const Image<Ray>& rays, int x, int y, float z) {
    const Ray r = rays.view().row(y)[x];
    return c.room_from_camera * Vec3{double(r.x) * z, double(r.y) * z, z};
}

TEST(OperatingRoom, TheFloorIsFlatToATenthOfAMillimetreInEveryCamera) {
    int seen = 0;
    for (int camera = 0; camera < 4; ++camera) {
        const Calibration c = small_camera(camera);
        const Image<Ray> rays = make_ray_table(c.depth);
        const GroundTruth truth = small_room().render(c, 3s, depth_and_surface);
        for (int y = 0; y < c.depth.size.height; ++y)
            for (int x = 0; x < c.depth.size.width; ++x) {
                if (truth.surface.view().row(y)[x].material != Material::floor)
                    continue;
                ++seen;
                const Vec3 p = room_point(c, rays, x, y, truth.depth_m.view().row(y)[x]);
                EXPECT_NEAR(p.y, 0, 1e-4) << "camera " << camera << " at " << x << ", " << y;
            }
    }
    EXPECT_GT(seen, 1000);
}

// For points seen by the first camera, a narrow camera at the second's position is aimed at
// the point. It must see that point or an occluder in front; most points must be visible.
TEST(OperatingRoom, TwoCamerasSeeTheSamePointOfAStillSurface) {
    const Calibration first = small_camera(0), second = small_camera(1);
    const Image<Ray> rays = make_ray_table(first.depth);
    const GroundTruth truth = small_room().render(first, 3s, depth_and_surface);
    const auto moment = small_room().at(3s);
    int same = 0, looked = 0;
    for (int y = 30; y < 130 && looked < 24; y += 11)
        for (int x = 20; x < 150 && looked < 24; x += 13) {
            const SurfaceSample& s = truth.surface.view().row(y)[x];
            if (s.material != Material::floor && s.material != Material::drape &&
                s.material != Material::paper && s.material != Material::brick)
                continue;
            ++looked;
            const Vec3 p = room_point(first, rays, x, y, truth.depth_m.view().row(y)[x]);
            const Vec3 eye = second.room_from_camera.translation;
            const Calibration narrow = free_viewpoint(eye, p, {1, 1}, 1);
            const auto view = small_room().look_from(narrow, {.depth = true, .color = false});
            const float z = view->render(*moment).depth_m.pixels[0];
            const double expected = length(p - eye);
            EXPECT_LT(z, expected + 1e-4);
            same += std::abs(z - expected) < 1e-4;
        }
    EXPECT_GE(looked, 12);
    EXPECT_GE(same, looked / 4);
}

TEST(OperatingRoom, NormalsAgreeWithTheDepthAround) {
    const Calibration c = small_camera(0);
    const Image<Ray> rays = make_ray_table(c.depth);
    const GroundTruth truth = small_room().render(c, 5s, depth_and_surface);
    const Pose camera_from_room = inverse(c.room_from_camera);
    int checked = 0, agreeing = 0;
    for (int y = 1; y + 1 < c.depth.size.height; ++y)
        for (int x = 1; x + 1 < c.depth.size.width; ++x) {
            const auto at = [&](int dx, int dy) {
                return camera_from_room * room_point(c, rays, x + dx, y + dy,
                                                     truth.depth_m.view().row(y + dy)[x + dx]);
            };
            const SurfaceSample& s = truth.surface.view().row(y)[x];
            const bool flat = s.material == Material::floor || s.material == Material::wall;
            const auto same = [&](int dx, int dy) {
                return truth.surface.view().row(y + dy)[x + dx].material == s.material;
            };
            if (!flat || !same(1, 0) || !same(0, 1) || !same(-1, 0) || !same(0, -1))
                continue;
            const Vec3 n = normalized(cross(at(0, 1) - at(0, -1), at(1, 0) - at(-1, 0)));
            ++checked;
            agreeing += dot(n, {s.nx, s.ny, s.nz}) > 0.999;
            const Ray r = rays.view().row(y)[x];
            EXPECT_LT(s.nx * r.x + s.ny * r.y + s.nz, 0) << "a normal that points away";
        }
    EXPECT_GT(checked, 500);
    EXPECT_GT(agreeing, checked * 9 / 10);
}

TEST(OperatingRoom, TheLoopClosesAndMovesInBetween) {
    const auto view = small_room().look_from(small_camera(0), {.color = false});
    const auto start = view->render(*small_room().at(0s)).depth_m;
    EXPECT_EQ(start, view->render(*small_room().at(20s)).depth_m);
    EXPECT_EQ(view->render(*small_room().at(3s)).depth_m,
              view->render(*small_room().at(43s)).depth_m);
    const auto later = view->render(*small_room().at(6s)).depth_m;
    int moved = 0;
    for (std::size_t i = 0; i < start.pixels.size(); ++i)
        moved += std::abs(start.pixels[i] - later.pixels[i]) > 0.005f;
    EXPECT_GT(moved, 100);

    // The seam changes hardly more pixels than any other pair of frames.
    const auto changes = [&](Duration a, Duration b) {
        const auto one = view->render(*small_room().at(a)).depth_m;
        const auto two = view->render(*small_room().at(b)).depth_m;
        int n = 0;
        for (std::size_t i = 0; i < one.pixels.size(); ++i)
            n += std::abs(one.pixels[i] - two.pixels[i]) > 0.02f;
        return n;
    };
    EXPECT_LT(changes(19967ms, 20000ms), 60 + 2 * changes(4000ms, 4033ms));
}

TEST(OperatingRoom, TheSameSeedGivesTheSamePixels) {
    Calibration c = small_camera(0);
    c.color = scaled(synthetic_camera(Variant::room, 0, 2, {1280, 720}).color, {64, 36});
    const OperatingRoom again(small_scene);
    const GroundTruth a = small_room().render(c, 7s), b = again.render(c, 7s);
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(a.depth_m, b.depth_m);
}

TEST(OperatingRoom, SharedViewsSeeTheSame) {
    const auto view = small_room().look_from(small_camera(1), {.color = false});
    const auto twin = view->share();
    const auto moment = small_room().at(1s);
    EXPECT_EQ(view->render(*moment).depth_m, twin->render(*moment).depth_m);
}

TEST(OperatingRoom, ShowsPeopleSitusAndTools) {
    std::array<int, std::size_t(Material::count)> pixels{};
    for (int camera = 0; camera < 2; ++camera) {
        Calibration c = synthetic_camera(Variant::room, camera, 2, {});
        c.depth = scaled(c.depth, {320, 288});
        for (const SurfaceSample& s : small_room().render(c, 3s, depth_and_surface).surface.pixels)
            ++pixels[std::size_t(s.material)];
    }
    for (const Material m :
         {Material::gown, Material::cap, Material::mask, Material::glove, Material::skin,
          Material::drape, Material::liver, Material::fat, Material::polished, Material::brick,
          Material::paper, Material::screen})
        EXPECT_GT(pixels[std::size_t(m)], 3) << to_text(m);
    // The room is closed: every ray inside the lens' circle hits a surface.
    EXPECT_EQ(pixels[std::size_t(Material::none)], 0);
}

TEST(SyntheticCamera, LooksAtTheSitusFromAllSides) {
    for (int i = 0; i < max_viewpoints; ++i) {
        const Calibration c = synthetic_camera(Variant::room, i, max_viewpoints, {1280, 720});
        const auto pixel = project(c.depth, inverse(c.room_from_camera) * Vec3{0, 1.05, 0});
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->x, 320, 60);
        EXPECT_NEAR(pixel->y, 288, 90);
        EXPECT_TRUE(c.registered);
        EXPECT_TRUE(decode_calibration(encode_calibration(c)));
    }
}

TEST(SyntheticCamera, TheHexagonIsThatOfTheRealSensor) {
    // First and last column with infrared light in a recorded frame, by row.
    constexpr int rows[][3] = {
        {0, 152, 513}, {144, 72, 593}, {240, 18, 639}, {432, 59, 605}, {575, 145, 519}};
    for (const auto& [y, first, last] : rows) {
        int x0 = 0, x1 = 639;
        while (!inside_hexagon({640, 576}, x0, y))
            ++x0;
        while (!inside_hexagon({640, 576}, x1, y))
            --x1;
        EXPECT_NEAR(x0, first, 2) << "row " << y;
        EXPECT_NEAR(x1, last, 2) << "row " << y;
    }
}

}  // namespace
}  // namespace theatron::synthetic
