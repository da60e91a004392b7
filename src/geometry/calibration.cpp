// SPDX-License-Identifier: Apache-2.0
#include "geometry/calibration.h"

#include <cmath>

namespace theatron {
namespace {

constexpr std::uint8_t version = 2;

// Fields of version 2, in this order.
enum class Field : std::uint8_t {
    depth = 1,
    color = 2,
    color_from_depth = 3,
    depth_unit_mm = 4,
    place = 5,
    registration = 6,
    covariance = 7,
    depth_offset_mm = 8,
    color_gain = 9,
    person = 10,
};
constexpr Field last_field = Field::person;

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

bool plausible(const std::array<double, 36>& covariance) {
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            if (!std::isfinite(covariance[6 * i + j]) || (i == j && covariance[6 * i + j] < 0))
                return false;
    return true;
}

bool is_gain(double v) {
    return v >= 1 / max_color_gain && v <= max_color_gain;
}

bool plausible(const Calibration& c) {
    const bool has_depth = c.depth.size != Size{}, has_color = c.color.size != Size{};
    if ((!has_depth && !has_color) || (has_depth && !plausible(c.depth)) ||
        (has_color && !plausible(c.color)))
        return false;
    if (!(c.depth_unit_mm > 1e-3 && c.depth_unit_mm < 1e3) || !plausible(c.color_from_depth) ||
        !plausible(c.room_from_camera) || (c.covariance && !plausible(*c.covariance)))
        return false;
    if (c.depth_offset_mm && !(std::abs(*c.depth_offset_mm) <= max_depth_offset_mm))
        return false;
    return !c.color_gain ||
           (is_gain(c.color_gain->x) && is_gain(c.color_gain->y) && is_gain(c.color_gain->z));
}

Status read_version_1(ByteReader& in, Calibration& c) {
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
    // A camera that is not there has size 0, but numbers nevertheless.
    if (c.color.size == Size{} && !all_finite(c.color))
        return Status::malformed;
    if (c.color.size == Size{})
        c.color = {};
    return registered > 1 || c.depth.size == Size{} ? Status::malformed : Status::ok;
}

// False if the value is none. Too short a field is noticed by its reader.
bool read_field(Field field, ByteReader& in, Calibration& c) {
    switch (field) {
        case Field::depth:
            c.depth = get_camera(in);
            return c.depth.size != Size{};
        case Field::color:
            c.color = get_camera(in);
            return c.color.size != Size{};
        case Field::color_from_depth:
            c.color_from_depth = get_pose(in);
            return true;
        case Field::depth_unit_mm:
            c.depth_unit_mm = in.get_f64();
            return true;
        case Field::place: {
            const auto registered = in.get<std::uint8_t>();
            c.registered = registered == 1;
            c.room_from_camera = get_pose(in);
            return registered <= 1;
        }
        case Field::registration:
            c.registration = in.get<std::uint64_t>();
            return c.registration != 0;
        case Field::covariance: {
            auto& covariance = c.covariance.emplace();
            for (std::size_t i = 0; i < 6; ++i)
                for (std::size_t j = i; j < 6; ++j)
                    covariance[6 * i + j] = covariance[6 * j + i] = in.get_f64();
            return true;
        }
        case Field::depth_offset_mm:
            c.depth_offset_mm = in.get_f64();
            return true;
        case Field::color_gain: {
            Vec3& gain = c.color_gain.emplace();
            for (double* v : {&gain.x, &gain.y, &gain.z})
                *v = in.get_f64();
            return true;
        }
        case Field::person:
            c.person = in.get<std::uint32_t>();
            return c.person != 0;
    }
    return true;  // of a newer program
}

Status read_version_2(ByteReader& in, Calibration& c) {
    std::uint8_t last = 0;
    while (!in.rest().empty()) {
        const auto field = in.get<std::uint8_t>();
        const std::size_t size = in.get<std::uint16_t>();
        if (!in.ok() || in.rest().size() < size)
            return Status::truncated;
        if (field <= last)
            return Status::malformed;
        last = field;
        ByteReader content(in.get_bytes(size));
        const bool is_value = read_field(Field(field), content, c);
        const bool is_known = field <= std::uint8_t(last_field);
        if (is_known && (!is_value || !content.ok() || !content.rest().empty()))
            return Status::malformed;
    }
    return Status::ok;
}

void put_field(ByteWriter& out, Field field, std::size_t size) {
    out.put(std::uint8_t(field));
    out.put(std::uint16_t(size));
}

constexpr std::size_t f64_size = 8, camera_size = 2 * 2 + 13 * f64_size, pose_size = 7 * f64_size;

}  // namespace

Bytes encode_calibration(const Calibration& c) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(version);
    if (c.depth.size != Size{}) {
        put_field(out, Field::depth, camera_size);
        put_camera(out, c.depth);
    }
    if (c.color.size != Size{}) {
        put_field(out, Field::color, camera_size);
        put_camera(out, c.color);
    }
    put_field(out, Field::color_from_depth, pose_size);
    put_pose(out, c.color_from_depth);
    put_field(out, Field::depth_unit_mm, f64_size);
    out.put_f64(c.depth_unit_mm);
    put_field(out, Field::place, 1 + pose_size);
    out.put(std::uint8_t(c.registered));
    put_pose(out, c.room_from_camera);
    if (c.registration != 0) {
        put_field(out, Field::registration, sizeof(c.registration));
        out.put(c.registration);
    }
    if (c.covariance) {
        put_field(out, Field::covariance, 21 * f64_size);
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = i; j < 6; ++j)
                out.put_f64((*c.covariance)[6 * i + j]);
    }
    if (c.depth_offset_mm) {
        put_field(out, Field::depth_offset_mm, f64_size);
        out.put_f64(*c.depth_offset_mm);
    }
    if (c.color_gain) {
        put_field(out, Field::color_gain, 3 * f64_size);
        for (const double v : {c.color_gain->x, c.color_gain->y, c.color_gain->z})
            out.put_f64(v);
    }
    if (c.person != 0) {
        put_field(out, Field::person, sizeof(c.person));
        out.put(c.person);
    }
    return bytes;
}

Calibration without_person(Calibration calibration) {
    if (calibration.person == 0)
        return calibration;
    const Calibration usual;
    calibration.person = usual.person;
    calibration.room_from_camera = usual.room_from_camera;
    calibration.registered = usual.registered;
    return calibration;
}

Result<Calibration> decode_calibration(ByteView bytes) {
    ByteReader in(bytes);
    const auto of_version = in.get<std::uint8_t>();
    if (of_version > version)
        return Status::unsupported_version;
    Calibration c;
    const Status status = of_version < version ? read_version_1(in, c) : read_version_2(in, c);
    if (status != Status::ok)
        return status;
    if (c.depth.size.area() > max_depth_pixels || c.color.size.area() > max_color_pixels)
        return Status::too_large;
    if (!plausible(c))
        return Status::malformed;
    return c;
}

}  // namespace theatron
