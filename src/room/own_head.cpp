// SPDX-License-Identifier: Apache-2.0
#include "room/own_head.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "face/sent_face.h"
#include "image/srgb.h"

namespace theatron::room {
namespace {

using face::Emotion, face::HeadPart;

// The pupils of a bust (bust_meshes()): so far before the head's origin.
constexpr double bust_pupils_before_m = 0.074;
// The cap's rim: its height above the eyes, and its ellipse at scale 1 (bust_meshes()).
constexpr double rim_above_m = 0.05, cap_rim_y = 0.03;
constexpr double rim_side = 0.0805, rim_front = 0.1005, rim_back = 0.014, rim_margin = 1.03;
// Skin in this band goes through the rim; what is higher is hidden.
constexpr double rim_band_m = 0.008, hidden_above_m = 0.012;
constexpr double least_scale = 0.7, most_scale = 1.5;
// The bust's neck at scale 1, the band in which a head's own neck is measured, and how much thinner
// the bust's is in it.
constexpr double neck_side = 0.053, neck_depth = 0.054, neck_back = 0.032, neck_margin = 0.94;
constexpr double neck_high_m = -0.125, neck_low_m = -0.155, widest_neck_m = 0.07;
// A whole head moves at most by this towards its neck's place.
constexpr double farthest_shift_m = 0.045;
// Skin below this, and farther from the neck's axis than the collar is wide, is hidden.
constexpr double collar_below_m = -0.14, collar_m = 0.06;
// Sides and back of a whole head's neck get narrower from here to there, so that they go into the
// collar; its distances from the axis there.
constexpr double wide_at_m = -0.09, wide_m = 0.072, narrow_at_m = -0.15, narrow_m = 0.0548;
// A head that reaches less far behind its eyes is a face alone.
constexpr double whole_behind_m = 0.11;
// A face alone is that of the generated head, whose forehead is narrower than a cap: as in
// face_shape.cpp.
constexpr double forehead_wider = 0.43, forehead_before = 0.22, forehead_mm = 60;
// How far back the bust's head reaches at the rim, and how much narrower its back is than the face.
constexpr double back_reach_m = 0.104, back_margin = 0.985;
// Steps of an emotion's weight for the skin's picture.
constexpr float share_steps = 16;

}  // namespace

bool ShownFace::operator==(const ShownFace& other) const {
    return emotions == other.emotions && direct.jaw_open == other.direct.jaw_open &&
           direct.blink_left == other.direct.blink_left &&
           direct.blink_right == other.direct.blink_right;
}

OwnHead::OwnHead(face::EnrolledFace face, Textures textures)
    : face_(std::move(face)),
      textures_(std::move(textures)),
      eyes_mm_(face::between_eyes(face_)),
      pupils_before_m_(bust_pupils_before_m),
      is_hidden_(face_.rest.triangles.size()) {
    std::map<std::array<float, 3>, std::uint32_t> at;
    for (std::uint32_t i = 0; i < face_.rest.vertex_count(); ++i) {
        const float* p = &face_.rest.points[3 * std::size_t(i)];
        same_place_.push_back(at.try_emplace({p[0], p[1], p[2]}, i).first->second);
    }
    for (std::size_t i = 0; i < face_.rest.vertex_count(); ++i)
        is_whole_ |= eyes_mm_.z - face_.rest.point(i).z > 1000 * whole_behind_m;
    measure_back();
    measure_neck();
    measure_cap();
    hide_what_clothes_cover();
}

// The face looks along z with x to its left; the head along -z with x to its right.
Vec3 OwnHead::in_head(const float* mm) const {
    Vec3 p{double(mm[0]) - eyes_mm_.x, double(mm[1]) - eyes_mm_.y, double(mm[2])};
    if (!is_whole_ && p.y > 0) {
        const double above = p.y / forehead_mm;
        p.x *= 1 + forehead_wider * above * above;
        p.z *= 1 + (p.z > 0 ? forehead_before : 0) * above * above;
    }
    return {-p.x / 1000, p.y / 1000, (eyes_mm_.z - p.z) / 1000 - pupils_before_m_};
}

// A vertex that has moved; in_head() with the neck that the collar takes.
Vec3 OwnHead::dressed(const float* mm) const {
    Vec3 p = in_head(mm);
    if (!is_whole_ || p.y >= wide_at_m)
        return p;
    const double share = std::min((wide_at_m - p.y) / (wide_at_m - narrow_at_m), 1.0);
    const double limit = wide_m + share * (narrow_m - wide_m);
    // In front are the chin and the throat.
    const bool is_behind = p.z > neck_back;
    const double away = is_behind ? std::hypot(p.x, p.z - neck_back) : std::abs(p.x);
    if (away <= limit)
        return p;
    p.x *= limit / away;
    if (is_behind)
        p.z = neck_back + (p.z - neck_back) * limit / away;
    return p;
}

// The back begins inside of the face's edges, at every height.
void OwnHead::measure_back() {
    BackSizes farthest;
    farthest.fill(-1);
    for (std::size_t i = 0; i < face_.rest.vertex_count(); ++i) {
        const Vec3 p = in_head(&face_.rest.points[3 * i]);
        for (std::size_t k = 0; k < back_.size(); ++k)
            if (std::abs(p.y - back_heights[k]) < rim_band_m && p.z > farthest[k]) {
                farthest[k] = p.z;
                back_[k] =
                    std::clamp(back_margin * std::abs(p.x), least_scale * usual_back_widths[k],
                               most_scale * usual_back_widths[k]);
            }
    }
}

void OwnHead::measure_neck() {
    double side = 0, front = 1, back = -1;
    for (std::size_t i = 0; i < face_.rest.vertex_count(); ++i) {
        const Vec3 p = in_head(&face_.rest.points[3 * i]);
        if (p.y < neck_low_m || p.y > neck_high_m || std::abs(p.x) > widest_neck_m)
            continue;
        side = std::max(side, std::abs(p.x));
        front = std::min(front, p.z);
        back = std::max(back, p.z);
    }
    if (!is_whole_ || back <= front)
        return;
    neck_.scale =
        std::clamp(neck_margin * std::min(side / neck_side, (back - front) / 2 / neck_depth),
                   least_scale, 1.0);
    // So that its neck stands in the collar, and turns about the bust's pivot.
    pupils_before_m_ -=
        std::clamp(neck_back - (front + back) / 2, -farthest_shift_m, farthest_shift_m);
    neck_.place.translation.z = neck_back - neck_back * neck_.scale;
}

// Thinner, so that it does not come out of the person's own.
OwnHead::Part OwnHead::neck_in_cloud() const {
    Part neck;
    neck.scale = 0.85 * neck_.scale;
    neck.place.translation.z = neck_back - neck_back * neck.scale;
    return neck;
}

// The cap goes round the head at the height of its rim, and round the bust's back behind a face
// alone.
void OwnHead::measure_cap() {
    double side = 0, front = 1, back = -1;
    for (std::size_t i = 0; i < face_.rest.vertex_count(); ++i) {
        const Vec3 p = in_head(&face_.rest.points[3 * i]);
        if (std::abs(p.y - rim_above_m) > rim_band_m)
            continue;
        side = std::max(side, std::abs(p.x));
        front = std::min(front, p.z);
        back = std::max(back, p.z);
    }
    if (!is_whole_) {
        side = std::max(side, back_.back());
        back = back_reach_m;
    }
    if (back <= front)
        return;
    cap_.scale = std::clamp(rim_margin * std::max(side / rim_side, (back - front) / 2 / rim_front),
                            least_scale, most_scale);
    cap_.place.translation = {0, rim_above_m - cap_rim_y * cap_.scale,
                              (front + back) / 2 - rim_back * cap_.scale};
}

void OwnHead::hide_what_clothes_cover() {
    for (std::size_t t = 0; t < is_hidden_.size(); ++t) {
        bool is_above = true, is_below = false;
        for (const std::uint32_t corner : face_.rest.triangles[t]) {
            const Vec3 p = dressed(&face_.rest.points[3 * std::size_t(corner)]);
            is_above = is_above && p.y > rim_above_m + hidden_above_m;
            is_below =
                is_below || (p.y < collar_below_m && std::hypot(p.x, p.z - neck_back) > collar_m);
        }
        is_hidden_[t] = is_above || is_below;
    }
}

std::array<render::MeshData, face::part_count> OwnHead::meshes(const ShownFace& shown) const {
    const face::FaceMesh& rest = face_.rest;
    const std::size_t count = rest.vertex_count();
    std::vector<float> points(rest.points.size());
    face::blend_face(face_, shown.emotions, shown.direct, points);
    std::vector<Vec3> places(count), normals(count);
    for (std::size_t i = 0; i < count; ++i)
        places[i] = dressed(&points[3 * i]);
    for (const auto& corners : rest.triangles) {
        const Vec3 a = places[corners[0]];
        const Vec3 normal = cross(places[corners[1]] - a, places[corners[2]] - a);
        for (const std::uint32_t corner : corners) {
            Vec3& sum = normals[same_place_[corner]];
            sum = sum + normal;
        }
    }
    std::array<render::MeshData, face::part_count> meshes;
    std::vector<std::uint32_t> numbers(count);
    std::size_t triangle = 0;
    for (std::size_t part = 0; part < face::part_count; ++part) {
        render::MeshData& mesh = meshes[part];
        std::fill(numbers.begin(), numbers.end(), 0);
        for (std::uint32_t i = 0; i < rest.part_sizes[part]; ++i, ++triangle) {
            if (is_hidden_[triangle])
                continue;
            for (const std::uint32_t corner : rest.triangles[triangle]) {
                if (numbers[corner] == 0) {
                    const Vec3 sum = normals[same_place_[corner]];
                    const double size = length(sum);
                    const Vec3 n = size > 0 ? (1 / size) * sum : Vec3{0, 0, -1};
                    const Vec3 p = places[corner];
                    mesh.vertices.push_back({float(p.x), float(p.y), float(p.z), float(n.x),
                                             float(n.y), float(n.z),
                                             rest.places[2 * std::size_t(corner)],
                                             rest.places[2 * std::size_t(corner) + 1]});
                    numbers[corner] = std::uint32_t(mesh.vertices.size());
                }
                mesh.indices.push_back(numbers[corner] - 1);
            }
        }
    }
    return meshes;
}

Vec3 OwnHead::color(HeadPart part) const {
    const Rgb color = face_.colors[std::size_t(part)];
    const auto linear = [](std::uint8_t value) { return srgb_to_linear(double(value) / 255); };
    return {linear(color.r), linear(color.g), linear(color.b)};
}

OwnHead::Shares OwnHead::shares(const face::Emotions& emotions) const {
    const face::Emotions limited = face::limited_weights(emotions);
    Shares shares{};
    unsigned others = 0;
    constexpr auto neutral = std::size_t(Emotion::neutral);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (i == neutral || textures_[i].empty())
            continue;
        const auto steps = unsigned(std::lround(limited[i] * share_steps));
        shares[i] = std::uint16_t(
            std::min(steps * (whole_share / unsigned(share_steps)), whole_share - others));
        others += shares[i];
    }
    shares[neutral] = std::uint16_t(whole_share - others);
    return shares;
}

void OwnHead::blend(const Shares& shares, ColorImage& out) const {
    out.resize(texture_size());
    const std::size_t bytes = 3 * out.pixels.size();
    std::vector<std::uint16_t> sums(bytes, whole_share / 2);
    static_assert(sizeof(Rgb) == 3);
    for (std::size_t e = 0; e < shares.size(); ++e) {
        if (shares[e] == 0)
            continue;
        const auto* from = reinterpret_cast<const std::uint8_t*>(textures_[e].pixels.data());
        const std::uint16_t share = shares[e];
        for (std::size_t i = 0; i < bytes; ++i)
            sums[i] = std::uint16_t(sums[i] + share * from[i]);
    }
    auto* to = reinterpret_cast<std::uint8_t*>(out.pixels.data());
    for (std::size_t i = 0; i < bytes; ++i)
        to[i] = std::uint8_t(sums[i] >> 8);
}

}  // namespace theatron::room
