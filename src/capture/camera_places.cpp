// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_places.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "capture/json_fields.h"
#include "files/file_bytes.h"

namespace theatron::capture {
namespace {

using Json = JsonFields::Json;

constexpr std::size_t largest_file = 1 << 20;
constexpr std::size_t most_cameras = 64, longest_text = 500;
constexpr double farthest_m = 1000;

std::string text_of(JsonFields& fields, const Json& object, const char* key) {
    const Json& value = fields.member(object, key);
    if (value.is_string() && value.get_ref<const std::string&>().size() <= longest_text)
        return value.get<std::string>();
    fields.note("holds no text of at most " + std::to_string(longest_text) + " characters as '" +
                key + "'");
    return {};
}

Pose pose_of(JsonFields& fields, const Json& object) {
    fields.only(object, "room_from_camera", {"quaternion", "translation"});
    double q[4] = {1, 0, 0, 0};
    fields.numbers(object, "quaternion", q);
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(norm - 1) < 1e-3))
        fields.note("holds no unit quaternion as 'quaternion'");
    const Vec3 at = fields.vector(object, "translation");
    if (!(length(at) < farthest_m))
        fields.note("has a camera more than 1 km away");
    return {{q[0], q[1], q[2], q[3]}, at};
}

double offset_of(JsonFields& fields, const Json& camera) {
    const double mm = fields.number(camera, "depth_offset_mm");
    if (!(std::abs(mm) <= max_depth_offset_mm))
        fields.note("has a camera whose 'depth_offset_mm' is more than 100");
    return mm;
}

Vec3 gain_of(JsonFields& fields, const Json& camera) {
    const Vec3 gain = fields.vector(camera, "color_gain");
    for (const double v : {gain.x, gain.y, gain.z})
        if (!(v >= 1 / max_color_gain && v <= max_color_gain))
            fields.note("has a camera whose 'color_gain' is not three numbers from 0.25 to 4");
    return gain;
}

}  // namespace

const CameraPlaces::Entry* CameraPlaces::find(std::string_view camera) const {
    const auto found = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const Entry& e) { return e.camera == camera; });
    return found == cameras.end() ? nullptr : &*found;
}

// FNV-1a.
std::uint64_t CameraPlaces::registration() const {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : write_places(*this))
        hash = (hash ^ std::uint8_t(c)) * 0x100000001b3;
    return hash == 0 ? 1 : hash;
}

ParsedPlaces parse_places(std::string_view text) {
    JsonFields fields;
    const Json json = fields.parse(text);
    if (!fields.problem().empty())
        return {.places = {}, .problem = fields.problem()};
    CameraPlaces places;
    fields.only(json, "places", {"theatron_places", "made", "method", "cameras"});
    if (fields.problem().empty() && fields.integer(json, "theatron_places") != 1)
        fields.note("is of a version that this program does not know");
    places.made = text_of(fields, json, "made");
    places.method = text_of(fields, json, "method");
    const Json& cameras = fields.member(json, "cameras");
    if (!cameras.is_array() || cameras.empty() || cameras.size() > most_cameras)
        fields.note("holds no list of 1 to 64 cameras as 'cameras'");
    if (!fields.problem().empty())
        return {.places = {}, .problem = fields.problem()};
    for (const Json& camera : cameras) {
        fields.only(camera, "cameras",
                    {"camera", "room_from_camera", "covariance", "depth_offset_mm", "color_gain"});
        CameraPlaces::Entry entry;
        entry.camera = text_of(fields, camera, "camera");
        entry.room_from_camera = pose_of(fields, fields.member(camera, "room_from_camera"));
        if (fields.has(camera, "covariance"))
            fields.numbers(camera, "covariance", entry.covariance.emplace());
        if (fields.has(camera, "depth_offset_mm"))
            entry.depth_offset_mm = offset_of(fields, camera);
        if (fields.has(camera, "color_gain"))
            entry.color_gain = gain_of(fields, camera);
        if (places.find(entry.camera))
            fields.note("names the camera '" + entry.camera + "' twice");
        if (!fields.problem().empty())
            return {.places = {}, .problem = fields.problem()};
        places.cameras.push_back(std::move(entry));
    }
    return {.places = std::move(places), .problem = {}};
}

std::string write_places(const CameraPlaces& places) {
    nlohmann::ordered_json json;
    json["theatron_places"] = 1;
    json["made"] = places.made;
    json["method"] = places.method;
    json["cameras"] = nlohmann::ordered_json::array();
    for (const CameraPlaces::Entry& entry : places.cameras) {
        const auto& [q, t] = entry.room_from_camera;
        nlohmann::ordered_json camera;
        camera["camera"] = entry.camera;
        camera["room_from_camera"] = {{"quaternion", {q.w, q.x, q.y, q.z}},
                                      {"translation", {t.x, t.y, t.z}}};
        if (entry.covariance)
            camera["covariance"] = *entry.covariance;
        if (entry.depth_offset_mm)
            camera["depth_offset_mm"] = *entry.depth_offset_mm;
        if (entry.color_gain)
            camera["color_gain"] = {entry.color_gain->x, entry.color_gain->y, entry.color_gain->z};
        json["cameras"].push_back(std::move(camera));
    }
    // Invalid UTF-8 in a name is replaced by U+FFFD.
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

CameraPlaces load_places(const std::string& path) {
    const Bytes bytes = files::read_file(path, largest_file);
    ParsedPlaces parsed = parse_places({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!parsed.problem.empty())
        throw Error("The file of places '" + path + "' " + parsed.problem + ".");
    return std::move(parsed.places);
}

std::optional<Pose> parse_place(std::string_view text) {
    double values[6] = {};
    std::size_t count = 0;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(':', at), text.size());
        if (count == 6)
            return {};
        double& value = values[count++];
        const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, value);
        if (error != std::errc{} || stop != text.data() + end || !(std::abs(value) < farthest_m))
            return {};
        at = end + 1;
    }
    if (count < 3)
        return {};
    constexpr Quat level{0, 1, 0, 0};  // x right, y up, looks along -z
    const Quat rotation = rotation_about({0, 1, 0}, radians_of(values[3])) *
                          rotation_about({1, 0, 0}, radians_of(values[4])) *
                          rotation_about({0, 0, 1}, radians_of(-values[5])) * level;
    return Pose{rotation, {values[0], values[1], values[2]}};
}

}  // namespace theatron::capture
