// SPDX-License-Identifier: Apache-2.0
#include "capture/folder_calibration.h"

#include <cstdlib>
#include <tuple>

#include "capture/azure_calibration.h"

namespace theatron::capture {
namespace {

using Json = JsonFields::Json;

CameraModel read_camera(JsonFields& fields, const Json& camera, const char* what, Size picture) {
    fields.only(camera, what,
                {"width", "height", "fx", "fy", "cx", "cy", "k", "p1", "p2", "max_radius"});
    CameraModel model;
    model.size = {fields.integer(camera, "width"), fields.integer(camera, "height")};
    model.fx = fields.number(camera, "fx");
    model.fy = fields.number(camera, "fy");
    model.cx = fields.number(camera, "cx");
    model.cy = fields.number(camera, "cy");
    if (fields.has(camera, "k"))
        fields.numbers(camera, "k", model.k);
    model.p1 = fields.number_or(camera, "p1", 0);
    model.p2 = fields.number_or(camera, "p2", 0);
    model.max_radius = fields.number_or(camera, "max_radius", 0);
    if (model.size != picture)
        fields.note("is for " + std::string(what) + " of " + to_text(model.size) +
                    ", but the pictures are " + to_text(picture));
    return model;
}

Pose read_pose(JsonFields& fields, const Json& pose, const char* what) {
    fields.only(pose, what, {"rotation", "quaternion", "translation"});
    Pose result;
    if (fields.has(pose, "quaternion")) {
        double q[4] = {};
        fields.numbers(pose, "quaternion", q);
        const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        if (!(norm > 0.99 && norm < 1.01))
            fields.note("holds no unit quaternion in '" + std::string(what) + "'");
        else
            result.rotation = normalized(Quat{q[0], q[1], q[2], q[3]});
    } else {
        result.rotation = fields.rotation_matrix(pose, "rotation");
    }
    result.translation = fields.vector(pose, "translation");
    return result;
}

void align_color_with_depth(Calibration& calibration, Size color) {
    calibration.color = color == Size{} ? CameraModel{} : scaled(calibration.depth, color);
    calibration.color_from_depth = {};
}

ParsedCalibration checked(const JsonFields& fields, const Calibration& calibration) {
    std::string problem = fields.problem();
    if (problem.empty())
        problem = implausibility(calibration);
    if (!problem.empty())
        return {.calibration = {}, .problem = std::move(problem)};
    return {.calibration = calibration, .problem = {}};
}

}  // namespace

ParsedCalibration parse_folder_calibration(std::string_view text, Size depth, Size color) {
    if (looks_like_azure_calibration(text))
        return parse_azure_calibration(text, depth, color);

    JsonFields fields;
    const Json json = fields.parse(text);
    if (!fields.problem().empty())
        return {.calibration = {}, .problem = fields.problem()};
    fields.only(json, "calibration",
                {"depth", "color", "color_from_depth", "depth_unit_mm", "room_from_camera"});
    Calibration calibration;
    calibration.depth = read_camera(fields, fields.member(json, "depth"), "depth", depth);
    calibration.depth_unit_mm = fields.number_or(json, "depth_unit_mm", 1);
    if (color != Size{} && fields.has(json, "color")) {
        calibration.color = read_camera(fields, json["color"], "color", color);
        if (fields.has(json, "color_from_depth"))
            calibration.color_from_depth =
                read_pose(fields, json["color_from_depth"], "color_from_depth");
    } else if (fields.problem().empty()) {
        align_color_with_depth(calibration, color);
    }
    if (fields.has(json, "room_from_camera")) {
        calibration.room_from_camera =
            read_pose(fields, json["room_from_camera"], "room_from_camera");
        calibration.registered = true;
    }
    return checked(fields, calibration);
}

std::string write_folder_calibration(const Calibration& calibration) {
    const auto camera = [](const CameraModel& m) {
        return nlohmann::ordered_json{{"width", m.size.width},
                                      {"height", m.size.height},
                                      {"fx", m.fx},
                                      {"fy", m.fy},
                                      {"cx", m.cx},
                                      {"cy", m.cy},
                                      {"k", m.k},
                                      {"p1", m.p1},
                                      {"p2", m.p2},
                                      {"max_radius", m.max_radius}};
    };
    const auto pose = [](const Pose& p) {
        const auto& [q, t] = std::tie(p.rotation, p.translation);
        return nlohmann::ordered_json{{"quaternion", {q.w, q.x, q.y, q.z}},
                                      {"translation", {t.x, t.y, t.z}}};
    };
    nlohmann::ordered_json json;
    json["depth"] = camera(calibration.depth);
    if (calibration.color.size != Size{}) {
        json["color"] = camera(calibration.color);
        json["color_from_depth"] = pose(calibration.color_from_depth);
    }
    json["depth_unit_mm"] = calibration.depth_unit_mm;
    if (calibration.registered)
        json["room_from_camera"] = pose(calibration.room_from_camera);
    return json.dump(2) + "\n";
}

ParsedCalibration parse_intrinsics_matrix(std::string_view text, Size depth, Size color) {
    // strtod needs the terminating zero.
    const std::string copy(text);
    double m[9] = {};
    const char* at = copy.c_str();
    for (double& value : m) {
        char* end = nullptr;
        value = std::strtod(at, &end);
        if (end == at)
            return {.calibration = {}, .problem = "does not hold the nine numbers of a matrix"};
        at = end;
    }
    JsonFields fields;
    if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
        fields.note("is not the matrix of a pinhole camera");
    Calibration calibration;
    calibration.depth.size = depth;
    calibration.depth.fx = m[0];
    calibration.depth.cx = m[2];
    calibration.depth.fy = m[4];
    calibration.depth.cy = m[5];
    align_color_with_depth(calibration, color);
    return checked(fields, calibration);
}

Calibration default_calibration(Size depth, Size color) {
    // Common RGB-D cameras have between 57 degrees (Kinect v1) and 69 (RealSense D435).
    Calibration calibration;
    calibration.depth = pinhole(depth, 64);
    align_color_with_depth(calibration, color);
    return calibration;
}

}  // namespace theatron::capture
