// SPDX-License-Identifier: Apache-2.0
#include "room/mark_scene.h"

#include <algorithm>
#include <utility>

#include "room/mark_shape.h"
#include "room/people.h"
#include "room/srgb.h"

namespace theatron::room {

using session::Mark;
using session::MarkedSurface;
using session::MarkKind;
using session::MarkPoint;

namespace {

// A line through an organ, where the organ hides it.
constexpr double hidden_opacity = 0.35;

// A measured surface has noise, which grows with its distance, and moves; others stand still.
constexpr double before_cloud_m = 0.02, before_cloud_per_distance = 0.01;
constexpr double before_organ_m = 0.004, before_organ_per_distance = 0.001;

bool is_in_picture(Vec3 place, const render::CameraView& view) {
    const Vec3 p = inverse(view.room_from_eye) * place;
    return p.z > view.near_m && p.x > view.left * p.z && p.x < view.right * p.z &&
           p.y > view.top * p.z && p.y < view.bottom * p.z;
}

}  // namespace

void MarkScene::add_to(render::SceneFrame& frame, const std::vector<PlacedMark>& marks,
                       const render::CameraView& view) {
    std::map<Bytes, render::SceneLineMesh> before = std::exchange(meshes_, {});
    for (const PlacedMark& placed : marks) {
        // Scaled points, but lines and pins of the usual thickness.
        Mark mark = placed.mark;
        for (MarkPoint& point : mark.points)
            point.position = point.position * placed.scale;
        const Bytes key = encode_mark(mark);
        auto known = meshes_.find(key);
        if (known == meshes_.end()) {
            if (auto node = before.extract(key))
                known = meshes_.insert(std::move(node)).position;
            else
                known = meshes_.emplace(key, render::SceneLineMesh(mark_line(mark))).first;
        }
        const Rgb color = srgb_of(color_of(ParticipantId{mark.color}));
        const bool is_measured = mark.surface == MarkedSurface::cloud;
        frame.lines.push_back({&known->second, placed.room_from_points, color,
                               is_measured ? before_cloud_m : before_organ_m,
                               is_measured ? before_cloud_per_distance : before_organ_per_distance,
                               mark.kind == MarkKind::distance ? hidden_opacity : 0, placed.cut});

        std::vector<Vec3> places;
        for (const Vec3 in_frame : label_places(mark)) {
            const Vec3 place = placed.room_from_points * in_frame;
            if (!placed.cut || dot(placed.cut->normal, place) <= placed.cut->distance_m)
                places.push_back(place);
        }
        // The length in the organ, also where that is shown larger.
        const std::string text = label_of(placed.mark);
        if (places.empty() || text.empty())
            continue;
        const auto seen = std::find_if(places.begin(), places.end(),
                                       [&](Vec3 place) { return is_in_picture(place, view); });
        frame.labels.push_back(
            {text, seen == places.end() ? places[0] : *seen, color, rank_of(mark.kind)});
    }
}

}  // namespace theatron::room
