// SPDX-License-Identifier: Apache-2.0
#include "capture/azure_calibration.h"

#include <optional>

namespace theatron::capture {
namespace {

using Json = JsonFields::Json;

// The sensor's size after binning or scaling, and the offset of the picture in it.
struct Mode {
    Size picture;
    Size sensor;
    int left = 0, top = 0;
    const char* name;
};

constexpr Size depth_sensor{1024, 1024};
constexpr Mode depth_modes[] = {
    {{320, 288}, {512, 512}, 96, 90, "NFOV_2X2BINNED"},
    {{640, 576}, {1024, 1024}, 192, 180, "NFOV_UNBINNED"},
    {{512, 512}, {512, 512}, 0, 0, "WFOV_2X2BINNED"},
    {{1024, 1024}, {1024, 1024}, 0, 0, "WFOV_UNBINNED"},
};
constexpr Mode color_modes[] = {
    {{1280, 720}, {1280, 960}, 0, 120, "MJPG_720P"},
    {{1920, 1080}, {1920, 1440}, 0, 180, "MJPG_1080P"},
    {{2560, 1440}, {2560, 1920}, 0, 240, "MJPG_1440P"},
    {{2048, 1536}, {2048, 1536}, 0, 0, "MJPG_1536P"},
    {{3840, 2160}, {3840, 2880}, 0, 360, "MJPG_2160P"},
    {{4096, 3072}, {4096, 3072}, 0, 0, "MJPG_3072P"},
};

// The SDK's radius for cameras whose factory calibration has none, about 120 degrees.
constexpr double usual_metric_radius = 1.7;

template <std::size_t N>
std::optional<Mode> mode_of(const Mode (&modes)[N], Size picture) {
    for (const Mode& mode : modes)
        if (mode.picture == picture)
            return mode;
    return std::nullopt;
}

struct Sensor {
    Size size;
    CameraModel model;  // fx, fy, cx, cy as shares of the sensor's width and height
    Pose camera_from_device;
};

Sensor read_sensor(JsonFields& fields, const Json& cameras, std::string_view location) {
    for (const Json& camera : cameras) {
        const Json& found = fields.member(camera, "Location");
        if (!found.is_string() || found.get_ref<const std::string&>() != location)
            continue;
        Sensor sensor;
        sensor.size = {fields.integer(camera, "SensorWidth"),
                       fields.integer(camera, "SensorHeight")};

        const Json& intrinsics = fields.member(camera, "Intrinsics");
        const Json& type = fields.member(intrinsics, "ModelType");
        if (!type.is_string() ||
            type.get_ref<const std::string&>() != "CALIBRATION_LensDistortionModelBrownConrady")
            fields.note("has a lens model other than BrownConrady");
        // Order: cx, cy, fx, fy, k1 to k6, the distortion's centre (unused), p2, p1.
        double p[14] = {};
        fields.numbers(intrinsics, "ModelParameters", p, /*at_least=*/true);
        CameraModel& model = sensor.model;
        model.cx = p[0];
        model.cy = p[1];
        model.fx = p[2];
        model.fy = p[3];
        std::copy(p + 4, p + 10, model.k.begin());
        model.p2 = p[12];
        model.p1 = p[13];
        model.max_radius = fields.number(camera, "MetricRadius");
        if (model.max_radius <= 0.0001)
            model.max_radius = usual_metric_radius;

        const Json& rt = fields.member(camera, "Rt");
        sensor.camera_from_device = {fields.rotation_matrix(rt, "Rotation"),
                                     fields.vector(rt, "Translation")};
        return sensor;
    }
    fields.note("describes no camera at " + std::string(location));
    return {};
}

// Early devices were calibrated for the middle 16:9 part of the 4:3 sensor.
void widen_to_four_by_three(CameraModel& model) {
    model.cy = (model.cy * 2304 + 384) / 3072;
    model.fy = model.fy * 2304 / 3072;
}

CameraModel in_mode(const CameraModel& normalised, const Mode& mode) {
    CameraModel model = normalised;
    model.size = mode.picture;
    model.fx *= mode.sensor.width;
    model.fy *= mode.sensor.height;
    // From the corner of the first pixel to its centre: half a pixel.
    model.cx = model.cx * mode.sensor.width - mode.left - 0.5;
    model.cy = model.cy * mode.sensor.height - mode.top - 0.5;
    return model;
}

}  // namespace

bool looks_like_azure_calibration(std::string_view text) {
    return text.find("\"CalibrationInformation\"") != std::string_view::npos;
}

ParsedCalibration parse_azure_calibration(std::string_view text, Size depth, Size color) {
    const bool has_color = color != Size{};
    const auto refused = [](std::string problem) {
        return ParsedCalibration{.calibration = {}, .problem = std::move(problem)};
    };
    const std::optional<Mode> depth_mode = mode_of(depth_modes, depth);
    if (!depth_mode)
        return refused("is an Azure Kinect's, which gives no depth of " + to_text(depth));
    const std::optional<Mode> color_mode = mode_of(color_modes, color);
    if (has_color && !color_mode)
        return refused("is an Azure Kinect's, which gives no colour of " + to_text(color));

    JsonFields fields;
    const Json json = fields.parse(text);
    const Json& cameras = fields.member(fields.member(json, "CalibrationInformation"), "Cameras");
    if (!cameras.is_array())
        fields.note("holds no list as 'Cameras'");
    if (!fields.problem().empty())
        return refused(fields.problem());

    const Sensor depth_camera = read_sensor(fields, cameras, "CALIBRATION_CameraLocationD0");
    if (depth_camera.size != depth_sensor)
        fields.note("describes a depth sensor of " + to_text(depth_camera.size) +
                    " instead of 1024x1024");
    Calibration calibration;
    calibration.depth = in_mode(depth_camera.model, *depth_mode);
    if (has_color) {
        Sensor color_camera = read_sensor(fields, cameras, "CALIBRATION_CameraLocationPV0");
        const auto [width, height] = color_camera.size;
        if (std::int64_t(width) * 9 == std::int64_t(height) * 16)
            widen_to_four_by_three(color_camera.model);
        else if (std::int64_t(width) * 3 != std::int64_t(height) * 4)
            fields.note("describes a colour sensor of " + to_text(color_camera.size));
        calibration.color = in_mode(color_camera.model, *color_mode);
        calibration.color_from_depth =
            color_camera.camera_from_device * inverse(depth_camera.camera_from_device);
    }
    if (fields.problem().empty())
        fields.note(implausibility(calibration));
    if (!fields.problem().empty())
        return refused(fields.problem());
    return {.calibration = calibration, .problem = {}};
}

AzureDescription describe_as_azure(const Calibration& calibration) {
    const auto sensor = [](const char* location, const CameraModel& model, const Mode& mode,
                           Size whole, const Pose& camera_from_device) {
        const auto [width, height] = mode.sensor;
        const Mat3 r = matrix_from_quat(camera_from_device.rotation);
        const Vec3 t = camera_from_device.translation;
        // "No limit" becomes a radius larger than that of any lens.
        constexpr double unlimited = 100;
        return Json{{"Intrinsics",
                     {{"ModelParameterCount", 14},
                      {"ModelParameters",
                       {(model.cx + mode.left + 0.5) / width, (model.cy + mode.top + 0.5) / height,
                        model.fx / width, model.fy / height, model.k[0], model.k[1], model.k[2],
                        model.k[3], model.k[4], model.k[5], 0, 0, model.p2, model.p1}},
                      {"ModelType", "CALIBRATION_LensDistortionModelBrownConrady"}}},
                    {"Location", location},
                    {"Purpose", "CALIBRATION_CameraPurposeUnknown"},
                    {"MetricRadius", model.max_radius > 0 ? model.max_radius : unlimited},
                    {"Rt",
                     {{"Rotation",
                       {r.m[0][0], r.m[0][1], r.m[0][2], r.m[1][0], r.m[1][1], r.m[1][2], r.m[2][0],
                        r.m[2][1], r.m[2][2]}},
                      {"Translation", {t.x, t.y, t.z}}}},
                    {"SensorWidth", whole.width},
                    {"SensorHeight", whole.height},
                    {"Shutter", "CALIBRATION_ShutterTypeUndefined"},
                    {"ThermalAdjustmentParams", {{"Params", Json::array()}}}};
    };
    AzureDescription result;
    Json cameras = Json::array();
    if (const auto mode = mode_of(depth_modes, calibration.depth.size)) {
        result.depth_mode = mode->name;
        cameras.push_back(
            sensor("CALIBRATION_CameraLocationD0", calibration.depth, *mode, depth_sensor, {}));
    }
    constexpr Size color_sensor{4096, 3072};
    if (const auto mode = mode_of(color_modes, calibration.color.size)) {
        result.color_mode = mode->name;
        cameras.push_back(sensor("CALIBRATION_CameraLocationPV0", calibration.color, *mode,
                                 color_sensor, calibration.color_from_depth));
    } else if (calibration.color.size == Size{}) {
        result.color_mode = "OFF";
    }
    result.calibration =
        Json{{"CalibrationInformation",
              {{"Cameras", std::move(cameras)}, {"InertialSensors", Json::array()}}}}
            .dump();
    return result;
}

}  // namespace theatron::capture
