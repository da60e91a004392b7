// SPDX-License-Identifier: Apache-2.0
#include "geometry/calibration.h"

#include <cmath>

namespace theatron {
namespace {

constexpr std::uint8_t version = 1;

void put_camera(ByteWriter& out, const CameraModel& c) {
    out.put(std::uint16_t(c.size.width));
    out.put(std::uint16_t(c.size.height));
    for (const double v : {c.fx, c.fy, c.cx, c.cy, c.k[0], c.k[1], c.k[2], c.k[3], c.k[4], c.k[5],
                           c.p1, c.p2, c.max_radius})
        out.put_f64(v);
}

CameraModel get_camera(ByteReader& in) {
    CameraModel c;
    c.size.width = in.get<std::uint16_t>();
    c.size.height = in.get<std::uint16_t>();
    for (double* v : {&c.fx, &c.fy, &c.cx, &c.cy, &c.k[0], &c.k[1], &c.k[2], &c.k[3], &c.k[4],
                      &c.k[5], &c.p1, &c.p2, &c.max_radius})
        *v = in.get_f64();
    return c;
}

void put_pose(ByteWriter& out, const Pose& p) {
    for (const double v : {p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z, p.translation.x,
                           p.translation.y, p.translation.z})
        out.put_f64(v);
}

Pose get_pose(ByteReader& in) {
    Pose p;
    for (double* v : {&p.rotation.w, &p.rotation.x, &p.rotation.y, &p.rotation.z, &p.translation.x,
                      &p.translation.y, &p.translation.z})
        *v = in.get_f64();
    return p;
}

bool all_finite(const CameraModel& c) {
    for (const double v : {c.fx, c.fy, c.cx, c.cy, c.k[0], c.k[1], c.k[2], c.k[3], c.k[4], c.k[5],
                           c.p1, c.p2, c.max_radius})
        if (!std::isfinite(v))
            return false;
    return true;
}

bool plausible(const CameraModel& c) {
    return is_valid(c.size) && all_finite(c) && c.fx > 0 && c.fy > 0 && c.max_radius >= 0;
}

bool plausible(const Pose& p) {
    const Quat q = p.rotation;
    const double norm = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    const double distance = length(p.translation);
    return std::abs(norm - 1) < 1e-6 && std::isfinite(distance) && distance < 1e6;
}

}  // namespace

Bytes encode_calibration(const Calibration& calibration) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(version);
    out.put(std::uint8_t(calibration.registered));
    put_camera(out, calibration.depth);
    put_camera(out, calibration.color);
    put_pose(out, calibration.color_from_depth);
    out.put_f64(calibration.depth_unit_mm);
    put_pose(out, calibration.room_from_camera);
    return bytes;
}

Result<Calibration> decode_calibration(ByteView bytes) {
    ByteReader in(bytes);
    if (in.get<std::uint8_t>() > version)
        return Status::unsupported_version;
    Calibration c;
    const auto registered = in.get<std::uint8_t>();
    c.registered = registered == 1;
    c.depth = get_camera(in);
    c.color = get_camera(in);
    c.color_from_depth = get_pose(in);
    c.depth_unit_mm = in.get_f64();
    c.room_from_camera = get_pose(in);
    if (!in.ok())
        return Status::truncated;
    if (!in.rest().empty())
        return Status::trailing_bytes;

    if (c.depth.size.area() > max_depth_pixels || c.color.size.area() > max_color_pixels)
        return Status::too_large;
    const bool has_color = c.color.size != Size{};
    const bool unit_ok = c.depth_unit_mm > 1e-3 && c.depth_unit_mm < 1e3;
    if (registered > 1 || !plausible(c.depth) || (has_color && !plausible(c.color)) || !unit_ok ||
        !plausible(c.color_from_depth) || !plausible(c.room_from_camera))
        return Status::malformed;
    if (!has_color && !all_finite(c.color))
        return Status::malformed;
    return c;
}

}  // namespace theatron
