// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/azure_calibration.h"
#include "capture/folder_calibration.h"

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr Size vga{640, 480}, hd{1280, 720};

Json our_camera(Size size) {
    return {{"width", size.width}, {"height", size.height}, {"fx", 500},
            {"fy", 501},           {"cx", 320.5},           {"cy", 240}};
}

Json our_file() {
    return {{"depth", our_camera(vga)}, {"color", our_camera(hd)}};
}

// An invented factory calibration of the usual form.
Json azure_file() {
    const auto camera = [](const char* location, int width, int height) {
        return Json{
            {"Location", location},
            {"SensorWidth", width},
            {"SensorHeight", height},
            {"MetricRadius", 0},
            {"Intrinsics",
             {{"ModelType", "CALIBRATION_LensDistortionModelBrownConrady"},
              {"ModelParameters", {0.5, 0.25, 0.75, 1.0, 1, 2, 3, 4, 5, 6, 0, 0, 0.02, 0.01}}}},
            {"Rt", {{"Rotation", {1, 0, 0, 0, 1, 0, 0, 0, 1}}, {"Translation", {0, 0, 0}}}}};
    };
    Json cameras = Json::array({camera("CALIBRATION_CameraLocationD0", 1024, 1024),
                                camera("CALIBRATION_CameraLocationPV0", 4096, 3072)});
    cameras[1]["Rt"]["Translation"] = {-0.032, 0, 0};
    return {{"CalibrationInformation", {{"Cameras", cameras}}}};
}

std::string problem_with(const Json& file, Size depth = vga, Size color = hd) {
    return parse_folder_calibration(file.dump(), depth, color).problem;
}

TEST(FolderCalibration, ReadsEveryField) {
    Json file = our_file();
    file["depth"]["k"] = {1, 2, 3, 4, 5, 6};
    file["depth"]["p1"] = 0.1;
    file["depth"]["p2"] = 0.2;
    file["depth"]["max_radius"] = 1.5;
    file["depth_unit_mm"] = 0.25;
    file["color_from_depth"] = {{"rotation", {0, -1, 0, 1, 0, 0, 0, 0, 1}},
                                {"translation", {1, 2, 3}}};
    file["room_from_camera"] = {{"quaternion", {0, 0, 1, 0}}, {"translation", {0, 1.5, 0}}};
    const ParsedCalibration parsed = parse_folder_calibration(file.dump(), vga, hd);
    ASSERT_EQ(parsed.problem, "");
    const Calibration& c = parsed.calibration;
    EXPECT_EQ(c.depth, (CameraModel{vga, 500, 501, 320.5, 240, {1, 2, 3, 4, 5, 6}, 0.1, 0.2, 1.5}));
    EXPECT_EQ(c.color, (CameraModel{hd, 500, 501, 320.5, 240}));
    EXPECT_EQ(c.depth_unit_mm, 0.25);
    const Vec3 turned = c.color_from_depth * Vec3{1, 0, 0};
    EXPECT_NEAR(length(turned - Vec3{1, 3, 3}), 0, 1e-12);
    EXPECT_TRUE(c.registered);
    EXPECT_EQ(c.room_from_camera, (Pose{{0, 0, 1, 0}, {0, 1.5, 0}}));
}

TEST(FolderCalibration, WhatIsWrittenReadsAsTheSame) {
    Calibration calibration;
    calibration.depth = {vga, 500.1, 501, 320.5, 1.0 / 3, {1, 2, 3, 4, 5, 6}, 0.1, 0.2, 1.5};
    calibration.color = {hd, 900, 901, 640.5, 360};
    calibration.color_from_depth = {{0, 0, 1, 0}, {-0.032, 0.1, 1e-9}};
    calibration.depth_unit_mm = 0.125;
    calibration.room_from_camera = {{0, 1, 0, 0}, {3, 1.25, -2}};
    calibration.registered = true;
    const auto again = parse_folder_calibration(write_folder_calibration(calibration), vga, hd);
    EXPECT_EQ(again.problem, "");
    EXPECT_EQ(again.calibration, calibration);

    Calibration depth_only;
    depth_only.depth = pinhole(vga, 60);
    const auto alone = parse_folder_calibration(write_folder_calibration(depth_only), vga, {});
    EXPECT_EQ(alone.problem, "");
    EXPECT_EQ(alone.calibration, depth_only);
}

TEST(FolderCalibration, ColorWithoutCameraIsAlignedWithDepth) {
    Json file = our_file();
    file.erase("color");
    const Calibration c = parse_folder_calibration(file.dump(), vga, {320, 240}).calibration;
    EXPECT_EQ(c.color, scaled(c.depth, {320, 240}));
    EXPECT_FALSE(c.registered);
    EXPECT_EQ(parse_folder_calibration(file.dump(), vga, {}).calibration.color, CameraModel{});
}

TEST(FolderCalibration, SaysWhatIsWrong) {
    EXPECT_EQ(problem_with(our_file()), "");
    EXPECT_EQ(problem_with(our_file(), {320, 240}),
              "is for depth of 640x480, but the pictures are 320x240");
    EXPECT_EQ(parse_folder_calibration("nonsense", vga, hd).problem, "is not JSON");
    EXPECT_EQ(parse_folder_calibration("[1]", vga, hd).problem, "is not a JSON object");

    const auto changed = [](const char* where, Json value) {
        Json file = our_file();
        file[Json::json_pointer(where)] = std::move(value);
        return problem_with(file);
    };
    EXPECT_EQ(changed("/depth/fx", "500"), "holds no number as 'fx'");
    EXPECT_EQ(changed("/depth/width", 640.5), "holds no whole number as 'width'");
    EXPECT_EQ(changed("/depth/k", {1, 2}), "holds no list of 6 numbers as 'k'");
    EXPECT_EQ(changed("/depth/fz", 1), "has the unknown key 'fz' in 'depth'");
    EXPECT_EQ(changed("/depth", 1), "holds no object as 'depth'");
    EXPECT_EQ(changed("/depth/fx", -1), "describes an impossible camera");
    EXPECT_EQ(changed("/depth_unit_mm", 0), "describes an impossible camera");
    EXPECT_EQ(changed("/color_from_depth/rotation", {1, 0, 0, 0, 1, 0, 0, 0, 2}),
              "holds no rotation matrix as 'rotation'");
    EXPECT_EQ(changed("/color_from_depth", {{"quaternion", {2, 0, 0, 0}}}),
              "holds no unit quaternion in 'color_from_depth'");
    EXPECT_EQ(changed("/colour", 1), "has the unknown key 'colour' in 'calibration'");
}

TEST(FolderCalibration, ReadsAMatrix) {
    const auto parse = [](std::string_view text) { return parse_intrinsics_matrix(text, vga, hd); };
    const ParsedCalibration parsed = parse("5.85e+02 0 320\n0 586 240\n0 0 1");
    ASSERT_EQ(parsed.problem, "");
    EXPECT_EQ(parsed.calibration.depth, (CameraModel{vga, 585, 586, 320, 240}));
    EXPECT_EQ(parsed.calibration.color.size, hd);
    EXPECT_EQ(parse("585 0 320 0 586").problem, "does not hold the nine numbers of a matrix");
    EXPECT_EQ(parse("585 0 320 0 586 240 0 0 2").problem, "is not the matrix of a pinhole camera");
    EXPECT_NE(parse("nan 0 320 0 586 240 0 0 1").problem, "");
    EXPECT_NE(parse("-5 0 320 0 586 240 0 0 1").problem, "");
}

TEST(AzureCalibration, DepthModesCutTheSensor) {
    const auto depth = [](Size size) {
        const auto parsed = parse_azure_calibration(azure_file().dump(), size, {});
        EXPECT_EQ(parsed.problem, "");
        return parsed.calibration.depth;
    };
    EXPECT_EQ(
        depth({640, 576}),
        (CameraModel{{640, 576}, 768, 1024, 319.5, 75.5, {1, 2, 3, 4, 5, 6}, 0.01, 0.02, 1.7}));
    EXPECT_EQ(
        depth({320, 288}),
        (CameraModel{{320, 288}, 384, 512, 159.5, 37.5, {1, 2, 3, 4, 5, 6}, 0.01, 0.02, 1.7}));
    EXPECT_EQ(depth({512, 512}).cy, 127.5);
    EXPECT_EQ(depth({1024, 1024}).cy, 255.5);
}

TEST(AzureCalibration, ColorModesScaleAndCutTheSensor) {
    const auto color = [](Size size) {
        const auto parsed = parse_azure_calibration(azure_file().dump(), {640, 576}, size);
        EXPECT_EQ(parsed.problem, "");
        return parsed.calibration.color;
    };
    EXPECT_EQ(color(hd),
              (CameraModel{hd, 960, 960, 639.5, 119.5, {1, 2, 3, 4, 5, 6}, 0.01, 0.02, 1.7}));
    EXPECT_EQ(color({1920, 1080}).cy, 0.25 * 1440 - 180 - 0.5);
    EXPECT_EQ(color({2560, 1440}).cy, 0.25 * 1920 - 240 - 0.5);
    EXPECT_EQ(color({2048, 1536}).cy, 0.25 * 1536 - 0.5);
    EXPECT_EQ(color({3840, 2160}).fx, 0.75 * 3840);
    EXPECT_EQ(color({4096, 3072}).fy, 3072);
}

TEST(AzureCalibration, SixteenToNineCalibrationsDescribeTheMiddleOfTheSensor) {
    Json file = azure_file();
    file["CalibrationInformation"]["Cameras"][1]["SensorHeight"] = 2304;
    const auto color = parse_azure_calibration(file.dump(), {640, 576}, hd).calibration.color;
    // The calibrated area has exactly these 720 rows.
    EXPECT_DOUBLE_EQ(color.fy, 1.0 * 720);
    EXPECT_DOUBLE_EQ(color.cy, 0.25 * 720 - 0.5);
}

TEST(AzureCalibration, PosesAreBetweenTheCameras) {
    Json file = azure_file();
    const auto pose = [&] {
        return parse_azure_calibration(file.dump(), {640, 576}, hd).calibration.color_from_depth;
    };
    EXPECT_EQ(pose().translation, (Vec3{-0.032, 0, 0}));
    file["CalibrationInformation"]["Cameras"][0]["Rt"]["Translation"] = {0.001, 0, 0};
    EXPECT_NEAR(pose().translation.x, -0.033, 1e-12);
}

TEST(AzureCalibration, WhatIsDescribedReadsAsTheSame) {
    Calibration calibration;
    calibration.color = {hd, 611.8, 611.9, 639.3, 365.9, {1, 2, 3, 4, 5, 6}, 0.01, 0.02, 1.7};
    calibration.color_from_depth = {rotation_about({1, 2, 3}, 0.1), {-0.032, -0.002, 0.004}};
    for (const Size size : {Size{640, 576}, {320, 288}, {512, 512}, {1024, 1024}}) {
        calibration.depth = {size, 504.6, 504.7, 332.8, 288, {6, 5, 4, 3, 2, 1}, 0.1, 0.2, 1.74};
        const AzureDescription azure = describe_as_azure(calibration);
        EXPECT_EQ(azure.color_mode, "MJPG_720P");
        const auto again = parse_azure_calibration(azure.calibration, size, hd);
        ASSERT_EQ(again.problem, "");
        const Calibration& c = again.calibration;
        EXPECT_NEAR(c.depth.fx, calibration.depth.fx, 1e-9);
        EXPECT_NEAR(c.depth.cx, calibration.depth.cx, 1e-9);
        EXPECT_NEAR(c.depth.cy, calibration.depth.cy, 1e-9);
        EXPECT_EQ(c.depth.k, calibration.depth.k);
        EXPECT_EQ(c.depth.p1, calibration.depth.p1);
        EXPECT_EQ(c.depth.max_radius, calibration.depth.max_radius);
        EXPECT_NEAR(c.color.fy, calibration.color.fy, 1e-9);
        EXPECT_NEAR(c.color.cy, calibration.color.cy, 1e-9);
        EXPECT_NEAR(c.color_from_depth.rotation.x, calibration.color_from_depth.rotation.x, 1e-12);
        EXPECT_EQ(c.color_from_depth.translation, calibration.color_from_depth.translation);
    }
    calibration.depth.size = vga;
    EXPECT_EQ(describe_as_azure(calibration).depth_mode, "");
    calibration.color = {};
    EXPECT_EQ(describe_as_azure(calibration).color_mode, "OFF");
}

TEST(AzureCalibration, SaysWhatIsWrong) {
    const auto problem = [](const Json& file, Size depth = {640, 576}, Size color = hd) {
        return problem_with(file, depth, color);
    };
    EXPECT_EQ(problem(azure_file()), "");
    EXPECT_EQ(problem(azure_file(), vga), "is an Azure Kinect's, which gives no depth of 640x480");
    EXPECT_EQ(problem(azure_file(), {640, 576}, vga),
              "is an Azure Kinect's, which gives no colour of 640x480");
    const auto changed = [&](const char* where, Json value) {
        Json file = azure_file();
        file[Json::json_pointer("/CalibrationInformation" + std::string(where))] = std::move(value);
        return problem(file);
    };
    EXPECT_EQ(changed("/Cameras", 1), "holds no list as 'Cameras'");
    EXPECT_THAT(changed("/Cameras", Json::array()), HasSubstr("describes no camera"));
    EXPECT_EQ(changed("/Cameras/0", 1), "lacks 'Location'");
    EXPECT_EQ(changed("/Cameras/0/SensorWidth", 512),
              "describes a depth sensor of 512x1024 instead of 1024x1024");
    EXPECT_EQ(changed("/Cameras/1/SensorWidth", 512), "describes a colour sensor of 512x3072");
    EXPECT_THAT(changed("/Cameras/0/Intrinsics/ModelType", "fisheye"), HasSubstr("lens model"));
    EXPECT_THAT(changed("/Cameras/0/Intrinsics/ModelParameters", {1}), HasSubstr("14 numbers"));
    EXPECT_THAT(changed("/Cameras/0/Rt/Rotation", {0, 0, 0, 0, 0, 0, 0, 0, 0}),
                HasSubstr("rotation matrix"));
    EXPECT_EQ(changed("/Cameras/0/MetricRadius", "x"), "holds no number as 'MetricRadius'");
}

}  // namespace
}  // namespace theatron::capture
