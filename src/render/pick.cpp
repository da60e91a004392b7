// SPDX-License-Identifier: Apache-2.0
#include "render/pick.h"

#include "render/triangle_tree.h"

namespace theatron::render {

std::optional<Picked> pick(const SceneFrame& frame, const PickRay& ray) {
    const Vec3 direction = normalized(ray.direction);
    std::optional<Picked> nearest;
    for (const SceneObject& object : frame.objects) {
        if (object.id == PickId::none)
            continue;
        const Pose object_from_room = inverse(object.room_from_object);
        const Vec3 along = rotate(object_from_room.rotation, direction);
        // Where a ray enters the half that is left of an object; surfaces before it are cut away.
        Vec3 from = ray.from;
        double skipped = 0;
        if (object.cut) {
            const double outside = dot(object.cut->normal, from) - object.cut->distance_m;
            const double towards = -dot(object.cut->normal, direction);
            if (outside > 0 && towards <= 0)
                continue;
            skipped = outside > 0 ? outside / towards : 0;
            from = from + direction * skipped;
        }
        auto hit =
            object.mesh->triangles().nearest((object_from_room * from) * (1 / object.scale), along);
        if (!hit)
            continue;
        hit->distance = hit->distance * object.scale + skipped;
        const Vec3 place = ray.from + direction * hit->distance;
        if ((nearest && nearest->distance_m <= hit->distance) ||
            (object.cut && dot(object.cut->normal, place) > object.cut->distance_m + 1e-9))
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
