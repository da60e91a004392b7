// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "geometry/calibration.h"
#include "geometry/ray_table.h"

namespace theatron {
namespace {

// An Azure-Kinect-like depth camera.
CameraModel distorted() {
    CameraModel c = pinhole({640, 576}, 65);
    c.cx = 325.3;
    c.cy = 331.8;
    c.k = {0.548, -0.021, -0.0027, 0.89, 0.086, -0.0139};
    c.p1 = 2e-5;
    c.p2 = -7e-5;
    c.max_radius = 1.74;
    return c;
}

void expect_near(Vec3 a, Vec3 b) {
    EXPECT_LT(length(a - b), 1e-9) << a.x << " " << a.y << " " << a.z;
}

TEST(Pose, InverseUndoesIt) {
    const Pose p{normalized(Quat{0.3, -0.5, 0.7, 0.1}), {1, -2, 3}};
    expect_near(inverse(p) * (p * Vec3{4, 5, 6}), {4, 5, 6});
    expect_near((inverse(p) * p) * Vec3{4, 5, 6}, {4, 5, 6});
}

TEST(Pose, MatrixAndQuaternionAgree) {
    for (const Quat q :
         {Quat{1, 0, 0, 0}, Quat{0, 1, 0, 0}, Quat{0, 0, 1, 0}, Quat{0.1, 0.2, 0.3, 0.9}}) {
        const Quat n = normalized(q);
        const Mat3 m = matrix_from_quat(n);
        const Vec3 v{0.3, -0.8, 2};
        const Vec3 by_matrix{m.m[0][0] * v.x + m.m[0][1] * v.y + m.m[0][2] * v.z,
                             m.m[1][0] * v.x + m.m[1][1] * v.y + m.m[1][2] * v.z,
                             m.m[2][0] * v.x + m.m[2][1] * v.y + m.m[2][2] * v.z};
        expect_near(by_matrix, rotate(n, v));
        expect_near(rotate(quat_from_matrix(m), v), rotate(n, v));
    }
}

TEST(Pose, LookAtPutsTheTargetOnTheAxisAndUpUp) {
    const Pose room_from_camera = look_at({0, 2, 2}, {0, 1, 0}, {0, 1, 0});
    const Vec3 target = inverse(room_from_camera) * Vec3{0, 1, 0};
    EXPECT_NEAR(target.x, 0, 1e-12);
    EXPECT_NEAR(target.y, 0, 1e-12);
    EXPECT_GT(target.z, 0);
    EXPECT_LT((inverse(room_from_camera) * Vec3{0, 1.5, 0}).y, 0);  // camera y points down
}

TEST(CameraModel, UnprojectUndoesProject) {
    const CameraModel c = distorted();
    for (const Vec3 p : {Vec3{0, 0, 1}, Vec3{0.5, -0.4, 1}, Vec3{-1.2, 0.9, 2}}) {
        const auto pixel = project(c, p);
        ASSERT_TRUE(pixel);
        const auto direction = unproject(c, *pixel);
        ASSERT_TRUE(direction);
        EXPECT_NEAR(direction->x, p.x / p.z, 1e-8);
        EXPECT_NEAR(direction->y, p.y / p.z, 1e-8);
    }
}

TEST(CameraModel, SeesNothingBehindOrBeyondItsRadius) {
    EXPECT_FALSE(project(distorted(), {0, 0, -1}));
    EXPECT_FALSE(project(distorted(), {0, 0, 0}));
    EXPECT_FALSE(project(distorted(), {2, 0, 1}));
}

TEST(CameraModel, ScalingKeepsTheImageEdge) {
    const CameraModel c = distorted();
    const CameraModel half = scaled(c, {320, 288});
    const auto full_pixel = project(c, {0.3, 0.2, 1});
    const auto half_pixel = project(half, {0.3, 0.2, 1});
    EXPECT_NEAR((full_pixel->x + 0.5) / 2, half_pixel->x + 0.5, 1e-9);
    EXPECT_NEAR((full_pixel->y + 0.5) / 2, half_pixel->y + 0.5, 1e-9);
}

TEST(RayTable, AgreesWithUnproject) {
    const CameraModel c = scaled(distorted(), {32, 28});
    const Image<Ray> table = make_ray_table(c);
    const auto direction = unproject(c, {5, 20});
    EXPECT_FLOAT_EQ(table.view().row(20)[5].x, float(direction->x));
    EXPECT_FLOAT_EQ(table.view().row(20)[5].y, float(direction->y));
}

Calibration sample() {
    Calibration c;
    c.depth = distorted();
    c.color = pinhole({1280, 720}, 90);
    c.color_from_depth = {rotation_about({1, 0, 0}, 0.1), {-0.032, -0.002, 0.004}};
    c.room_from_camera = look_at({1, 2, 2}, {0, 1, 0}, {0, 1, 0});
    c.registered = true;
    return c;
}

TEST(Calibration, RoundTrips) {
    const auto decoded = decode_calibration(encode_calibration(sample()));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, sample());
}

TEST(Calibration, RoundTripsWithoutColor) {
    Calibration c = sample();
    c.color = {};
    const auto decoded = decode_calibration(encode_calibration(c));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, c);
}

Calibration corrected() {
    Calibration c = sample();
    c.registration = 0x0123456789abcdef;
    c.covariance.emplace();
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            (*c.covariance)[6 * i + j] = 1e-6 * double((i + 1) * (j + 1));
    c.depth_offset_mm = -3.5;
    c.color_gain = {1.25, 1, 0.5};
    c.person = 7;
    return c;
}

TEST(Calibration, RoundTripsWithItsCorrections) {
    const auto decoded = decode_calibration(encode_calibration(corrected()));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, corrected());
}

TEST(Calibration, RoundTripsWithoutDepth) {
    Calibration c = sample();
    c.depth = {};
    const auto decoded = decode_calibration(encode_calibration(c));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, c);
    c.color = {};
    EXPECT_FALSE(decode_calibration(encode_calibration(c))) << "no lens at all";
}

// Version 1 of docs/formats/calibration.md, field by field.
Bytes in_version_1(const Calibration& c) {
    Bytes bytes;
    ByteWriter out(bytes);
    const auto put_all = [&](std::initializer_list<double> values) {
        for (const double v : values)
            out.put_f64(v);
    };
    const auto put_pose = [&](const Pose& p) {
        put_all({p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z, p.translation.x,
                 p.translation.y, p.translation.z});
    };
    out.put(std::uint8_t(1));
    out.put(std::uint8_t(c.registered));
    for (const CameraModel& m : {c.depth, c.color}) {
        out.put(std::uint16_t(m.size.width));
        out.put(std::uint16_t(m.size.height));
        put_all({m.fx, m.fy, m.cx, m.cy, m.k[0], m.k[1], m.k[2], m.k[3], m.k[4], m.k[5], m.p1, m.p2,
                 m.max_radius});
    }
    put_pose(c.color_from_depth);
    out.put_f64(c.depth_unit_mm);
    put_pose(c.room_from_camera);
    return bytes;
}

TEST(Calibration, Version1IsStillRead) {
    Bytes bytes = in_version_1(sample());
    EXPECT_EQ(bytes.size(), 338u);
    const auto decoded = decode_calibration(bytes);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, sample());
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_FALSE(decode_calibration(ByteView(bytes).first(n)));
    bytes.push_back({});
    EXPECT_EQ(decode_calibration(bytes).error(), Status::trailing_bytes);
}

TEST(Calibration, AFieldOfANewerProgramIsSkipped) {
    Bytes bytes = encode_calibration(corrected());
    for (const int b : {200, 2, 0, 7, 7})
        bytes.push_back(std::byte(b));
    const auto decoded = decode_calibration(bytes);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, corrected());
    for (const int b : {200, 0, 0})
        bytes.push_back(std::byte(b));
    EXPECT_EQ(decode_calibration(bytes).error(), Status::malformed) << "fields come once";
}

// Cut between two fields it is a calibration that says less.
TEST(Calibration, RefusesEveryTruncationInsideAField) {
    const Bytes whole = encode_calibration(sample());
    int accepted = 0;
    for (std::size_t n = 0; n < whole.size(); ++n)
        accepted += bool(decode_calibration(ByteView(whole).first(n)));
    EXPECT_EQ(accepted, 4) << "behind depth, colour, the pose between them, and the unit";
    Bytes more = whole;
    more.push_back({});
    EXPECT_FALSE(decode_calibration(more));
}

TEST(Calibration, RefusesCorrectionsThatCannotBe) {
    for (const auto& spoil : std::vector<void (*)(Calibration&)>{
             [](Calibration& c) { c.depth_offset_mm = 101; },
             [](Calibration& c) { c.depth_offset_mm = NAN; },
             [](Calibration& c) { c.color_gain->y = 0; },
             [](Calibration& c) { c.color_gain->x = 4.1; },
             [](Calibration& c) { (*c.covariance)[7] = -1; },
             [](Calibration& c) { (*c.covariance)[1] = INFINITY; }}) {
        Calibration c = corrected();
        spoil(c);
        EXPECT_EQ(decode_calibration(encode_calibration(c)).error(), Status::malformed);
    }
}

TEST(Calibration, DepthIsCorrectedByItsOffset) {
    Calibration c;
    c.depth_unit_mm = 0.5;
    EXPECT_DOUBLE_EQ(depth_m(c, 2000), 1);
    c.depth_offset_mm = 4;
    EXPECT_DOUBLE_EQ(depth_m(c, 2000), 0.996);
    EXPECT_EQ(depth_m(c, 0), 0) << "nothing was measured";
    EXPECT_EQ(depth_m(c, 7), 0) << "nothing is behind the camera";
}

TEST(Calibration, RefusesWhatIsNotACamera) {
    for (const auto& spoil : std::vector<void (*)(Calibration&)>{
             [](Calibration& c) { c.depth.fx = 0; }, [](Calibration& c) { c.depth.fx = NAN; },
             [](Calibration& c) {
                 c.depth.size = {0, 5};
             },
             [](Calibration& c) { c.depth_unit_mm = 0; },
             [](Calibration& c) {
                 c.room_from_camera.rotation = {0, 0, 0, 0};
             },
             [](Calibration& c) { c.color.k[3] = INFINITY; }}) {
        Calibration c = sample();
        spoil(c);
        EXPECT_EQ(decode_calibration(encode_calibration(c)).error(), Status::malformed);
    }
}

}  // namespace
}  // namespace theatron
