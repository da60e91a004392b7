// SPDX-License-Identifier: Apache-2.0
#include "render/pick.h"

#include "render/triangle_tree.h"

namespace theatron::render {

std::optional<Picked> pick(const SceneFrame& frame, const PickRay& ray) {
    const Vec3 direction = normalized(ray.direction);
    std::optional<Picked> nearest;
    for (const SceneObject& object : frame.objects) {
        if (object.id == ObjectId::none)
            continue;
        const Pose object_from_room = inverse(object.room_from_object);
        const auto hit = object.mesh->triangles().nearest(
            object_from_room * ray.from, rotate(object_from_room.rotation, direction));
        if (!hit || (nearest && nearest->distance_m <= hit->distance))
            continue;
        Vec3 normal = rotate(object.room_from_object.rotation, hit->normal);
        if (dot(normal, direction) > 0)
            normal = normal * -1;
        nearest = {object.id, hit->distance, ray.from + direction * hit->distance, normal};
    }
    return nearest;
}

PickRay ray_through(const CameraView& view, Vec2 place) {
    const Vec3 in_eye{view.left + (view.right - view.left) * place.x,
                      view.top + (view.bottom - view.top) * place.y, 1};
    return {view.room_from_eye.translation, rotate(view.room_from_eye.rotation, in_eye)};
}

}  // namespace theatron::render
