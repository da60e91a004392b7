// SPDX-License-Identifier: Apache-2.0
#include "room/people.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "room/facing.h"
#include "room/mesh_parts.h"

namespace theatron::room {
namespace {

using render::MeshData;

constexpr double head_radius_m = 0.105;
constexpr int rings = 14;
// An eye nearer than this to a head is inside of it, or so close that the head fills the picture.
constexpr double free_around_eye_m = 0.3;
constexpr double name_above_m = 0.18, letter_width = 0.8;
// Names have about the same size in the picture, within limits.
constexpr double least_name_m = 0.025, largest_name_m = 0.09, name_per_distance = 0.02;
// The age of a person above the name: height and place, in heights of the name's letters.
constexpr double age_share = 0.65, age_lines = 1.5;
constexpr double stale_opacity = 0.35;

// A head with ears' width, a nose, and a body that ends in the air.
MeshData skin_mesh() {
    const MeshData ball = render::make_sphere_mesh(1, rings);
    MeshData mesh;
    append(mesh, ball, {0.9 * head_radius_m, 1.15 * head_radius_m, head_radius_m}, {});
    append(mesh, ball, {0.018, 0.02, 0.03}, {0, -0.012, -head_radius_m});
    append(mesh, ball, {0.16, 0.17, 0.09}, {0, -0.33, 0.03});
    append(mesh, ball, {0.05, 0.08, 0.05}, {0, -0.14, 0.01});
    return mesh;
}

// Both of a pair, mirrored at x = 0.
MeshData pair_mesh(double radius, Vec3 place) {
    const MeshData ball = render::make_sphere_mesh(radius, rings);
    MeshData mesh;
    append(mesh, ball, {1, 1, 1}, place);
    append(mesh, ball, {1, 1, 1}, {-place.x, place.y, place.z});
    return mesh;
}

// A palm with a finger that points along -z.
MeshData hand_mesh() {
    const MeshData ball = render::make_sphere_mesh(1, rings);
    MeshData mesh;
    append(mesh, ball, {0.042, 0.024, 0.05}, {});
    append(mesh, ball, {0.011, 0.011, 0.06}, {0, 0, -0.075});
    append(mesh, ball, {0.011, 0.011, 0.035}, {-0.045, 0, -0.02});
    return mesh;
}

render::SurfaceLook look(Vec3 color, double opacity) {
    return {color, 0, 0.55, opacity, 0};
}

}  // namespace

Vec3 color_of(ParticipantId id) {
    // sRGB 0 to 255 of the palette's seven colours that are seen on a dark ground.
    static constexpr std::array<std::array<double, 3>, 7> palette{{{230, 159, 0},
                                                                   {86, 180, 233},
                                                                   {0, 158, 115},
                                                                   {240, 228, 66},
                                                                   {204, 121, 167},
                                                                   {213, 94, 0},
                                                                   {0, 114, 178}}};
    // A person in a replay has the recorded number with bit 31 set, and the colour that it had.
    const std::uint32_t number = std::uint32_t(id) & 0x7fff'ffffu;
    const auto& srgb = palette[number % palette.size()];
    const auto linear = [](double value) { return std::pow(value / 255, 2.2); };
    return {linear(srgb[0]), linear(srgb[1]), linear(srgb[2])};
}

People::People()
    : skin_(skin_mesh()),
      eyes_(pair_mesh(0.024, {0.037, 0.02, -0.085})),
      pupils_(pair_mesh(0.012, {0.037, 0.02, -0.102})),
      hand_(hand_mesh()) {}

void People::add_to(render::SceneFrame& frame, const std::vector<RoomPerson>& people,
                    const render::CameraView& view) const {
    const Vec3 eye = view.room_from_eye.translation;
    for (const RoomPerson& person : people) {
        const Vec3 color = color_of(person.id);
        const double opacity = person.is_stale ? stale_opacity : 1;
        for (const auto& hand : {person.left_hand, person.right_hand})
            if (hand)
                frame.objects.push_back({&hand_, *hand, look(color, opacity)});
        if (!person.head || length(person.head->translation - eye) < free_around_eye_m)
            continue;
        if (!person.has_cloud) {
            frame.objects.push_back({&skin_, *person.head, look(color, opacity)});
            frame.objects.push_back({&eyes_, *person.head, look({0.9, 0.9, 0.9}, opacity)});
            frame.objects.push_back({&pupils_, *person.head, look({0.02, 0.02, 0.02}, opacity)});
        }
        const std::string name =
            person.name + (person.is_stale && person.age.empty() ? " (view is old)" : "");
        const double height = std::clamp(name_per_distance * length(person.head->translation - eye),
                                         least_name_m, largest_name_m);
        Pose place = facing(person.head->translation + Vec3{0, name_above_m, 0}, eye);
        place.translation = place * Vec3{-0.5 * height * letter_width * double(name.size()), 0, 0};
        frame.texts.push_back({name, place, height, {235, 240, 240}});
        if (person.age.empty())
            continue;
        const double small = age_share * height;
        Pose above =
            facing(person.head->translation + Vec3{0, name_above_m + age_lines * height, 0}, eye);
        above.translation =
            above * Vec3{-0.5 * small * letter_width * double(person.age.size()), 0, 0};
        frame.texts.push_back(
            {person.age, above, small, person.is_stale ? Rgb{255, 190, 70} : Rgb{175, 186, 196}});
    }
}

}  // namespace theatron::room
