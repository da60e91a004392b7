// SPDX-License-Identifier: Apache-2.0
#include "session/camera_adjustment.h"

#include <cmath>
#include <cstdio>

#include "phrases/phrase.h"

namespace theatron::session {
namespace {

constexpr std::uint8_t version = 1;
constexpr double parts_of_one = 1e6;  // in a metre and in a degree
// A value that lies on a limit may exceed it by half of a step in each axis.
constexpr double tolerance = 1e-6;

void put(ByteWriter& out, Vec3 value) {
    for (const double part : {value.x, value.y, value.z})
        out.put(std::int32_t(std::lround(part * parts_of_one)));
}

Vec3 get_vec(ByteReader& in) {
    Vec3 value;
    for (double* part : {&value.x, &value.y, &value.z})
        *part = in.get<std::int32_t>() / parts_of_one;
    return value;
}

Quat rotation_of(const CameraAdjustment& adjustment) {
    const double angle_deg = length(adjustment.turned_deg);
    return angle_deg > 0 ? rotation_about(adjustment.turned_deg, radians_of(angle_deg)) : Quat{};
}

}  // namespace

bool is_within_limits(const CameraAdjustment& adjustment, Size depth) {
    if (!(length(adjustment.moved_m) <= CameraAdjustment::max_moved_m + tolerance) ||
        !(length(adjustment.turned_deg) <= CameraAdjustment::max_turned_deg + tolerance))
        return false;
    if (!adjustment.region)
        return true;
    const PictureBox& box = *adjustment.region;
    return box.x >= 0 && box.y >= 0 && box.width > 0 && box.height > 0 &&
           box.width <= depth.width - box.x && box.height <= depth.height - box.y;
}

Pose nudged(const Pose& registered, const CameraAdjustment& adjustment) {
    return {normalized(rotation_of(adjustment) * registered.rotation),
            registered.translation + adjustment.moved_m};
}

Pose without_nudge(const Pose& nudged, const CameraAdjustment& adjustment) {
    return {normalized(conjugate(rotation_of(adjustment)) * nudged.rotation),
            nudged.translation - adjustment.moved_m};
}

std::string text_of(const CameraAdjustment& adjustment) {
    char text[160];
    std::string all;
    const auto add = [&](Phrase what) { all += (all.empty() ? "" : "; ") + say(what, text); };
    if (adjustment.moved_m != Vec3{}) {
        std::snprintf(text, sizeof(text), "%.1f, %.1f, %.1f", adjustment.moved_m.x * 1000,
                      adjustment.moved_m.y * 1000, adjustment.moved_m.z * 1000);
        add(Phrase::moved_by);
    }
    if (adjustment.turned_deg != Vec3{}) {
        std::snprintf(text, sizeof(text), "%.2f, %.2f, %.2f", adjustment.turned_deg.x,
                      adjustment.turned_deg.y, adjustment.turned_deg.z);
        add(Phrase::turned_by);
    }
    if (adjustment.region) {
        std::snprintf(text, sizeof(text), "%d:%d:%dx%d", adjustment.region->x, adjustment.region->y,
                      adjustment.region->width, adjustment.region->height);
        add(Phrase::depth_only_in);
    }
    return all.empty() ? say(Phrase::as_registered) : all;
}

Bytes encode_adjustment(const CameraAdjustment& adjustment) {
    Bytes bytes;
    if (!adjustment.is_nudged() && !adjustment.region)
        return bytes;
    ByteWriter out(bytes);
    out.put(version);
    put(out, adjustment.moved_m);
    put(out, adjustment.turned_deg);
    const PictureBox box = adjustment.region.value_or(PictureBox{});
    for (const int value : {box.x, box.y, box.width, box.height})
        out.put(std::uint16_t(value));
    return bytes;
}

CameraAdjustment rounded(const CameraAdjustment& adjustment) {
    return decode_adjustment(encode_adjustment(adjustment)).value();
}

Result<CameraAdjustment> decode_adjustment(ByteView bytes) {
    CameraAdjustment adjustment;
    if (bytes.empty())
        return adjustment;
    ByteReader in(bytes);
    const auto of_version = in.get<std::uint8_t>();
    if (of_version != version)
        return of_version > version ? Status::unsupported : Status::malformed;
    adjustment.moved_m = get_vec(in);
    adjustment.turned_deg = get_vec(in);
    PictureBox box;
    for (int* value : {&box.x, &box.y, &box.width, &box.height})
        *value = in.get<std::uint16_t>();
    if (!in.ok())
        return Status::truncated;
    if (!in.rest().empty())
        return Status::trailing_bytes;
    if (box != PictureBox{})
        adjustment.region = box;
    return adjustment;
}

}  // namespace theatron::session
