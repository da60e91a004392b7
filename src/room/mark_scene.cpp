// SPDX-License-Identifier: Apache-2.0
#include "room/mark_scene.h"

#include <algorithm>
#include <utility>

#include "room/facing.h"
#include "room/mark_mesh.h"
#include "room/people.h"
#include "room/srgb.h"

namespace theatron::room {

using session::Mark;
using session::MarkPoint;

namespace {

// Labels have about the same size in the picture, within limits.
constexpr double least_label_m = 0.006, largest_label_m = 0.05, label_per_distance = 0.018;

}  // namespace

void MarkScene::add_to(render::SceneFrame& frame, const std::vector<PlacedMark>& marks,
                       const render::CameraView& view) {
    std::map<Bytes, render::SceneMesh> before = std::exchange(meshes_, {});
    const Vec3 eye = view.room_from_eye.translation;
    for (const PlacedMark& placed : marks) {
        // Scaled points, but tubes and pins of the usual thickness.
        Mark mark = placed.mark;
        for (MarkPoint& point : mark.points)
            point.position = point.position * placed.scale;
        const Bytes key = encode_mark(mark);
        auto known = meshes_.find(key);
        if (known == meshes_.end()) {
            if (auto node = before.extract(key))
                known = meshes_.insert(std::move(node)).position;
            else
                known = meshes_.emplace(key, render::SceneMesh(make_mark_mesh(mark))).first;
        }
        const Vec3 color = color_of(ParticipantId{mark.color});
        frame.objects.push_back({&known->second,
                                 placed.room_from_points,
                                 {color, 0, 0.6},
                                 false,
                                 render::ObjectId::none,
                                 1,
                                 placed.cut});

        const Vec3 at = placed.room_from_points * label_place(mark);
        if (placed.cut && dot(placed.cut->normal, at) > placed.cut->distance_m)
            continue;
        const double height =
            std::clamp(label_per_distance * length(at - eye), least_label_m, largest_label_m);
        // The length in the organ, also where that is shown larger.
        frame.texts.push_back({label_of(placed.mark), facing(at, eye), height, srgb_of(color)});
    }
}

}  // namespace theatron::room
