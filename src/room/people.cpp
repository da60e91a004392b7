// SPDX-License-Identifier: Apache-2.0
#include "room/people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "phrases/phrase.h"
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

// The picture of a face: 4:3 with round corners, before the drawn face's nose, in a rim of the
// person's colour.
constexpr double face_width_m = 0.28, face_height_m = 0.21, face_corner_m = 0.045;
constexpr double face_before_m = 0.14, rim_m = 0.009, rim_behind_m = 0.004;
constexpr int corner_steps = 6;

// A rectangle with round corners, as render::make_panel_mesh().
MeshData rounded_mesh(double width_m, double height_m, double corner_m) {
    MeshData mesh;
    const auto add = [&](double x, double y) {
        mesh.vertices.push_back(
            {float(x), float(y), 0, 0, 0, -1, float(x / width_m + 0.5), float(y / height_m + 0.5)});
    };
    add(0, 0);
    for (int quarter = 0; quarter < 4; ++quarter)
        for (int step = 0; step <= corner_steps; ++step) {
            const double angle = std::numbers::pi / 2 * (quarter + double(step) / corner_steps);
            const double right = quarter == 0 || quarter == 3 ? 1 : -1, up = quarter < 2 ? 1 : -1;
            add(right * (width_m / 2 - corner_m) + corner_m * std::cos(angle),
                -up * (height_m / 2 - corner_m) - corner_m * std::sin(angle));
        }
    const auto rim = std::uint32_t(mesh.vertices.size() - 1);
    for (std::uint32_t i = 0; i < rim; ++i)
        mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % rim});
    return mesh;
}

// Behind the picture, seen from both sides.
MeshData rim_mesh() {
    MeshData mesh =
        rounded_mesh(face_width_m + 2 * rim_m, face_height_m + 2 * rim_m, face_corner_m + rim_m);
    const auto corners = std::uint32_t(mesh.vertices.size());
    const std::size_t front = mesh.indices.size();
    for (std::uint32_t i = 0; i < corners; ++i) {
        MeshData::Vertex back = mesh.vertices[i];
        back.nz = 1;
        mesh.vertices.push_back(back);
    }
    for (std::size_t i = 0; i < front; i += 3)
        mesh.indices.insert(mesh.indices.end(),
                            {mesh.indices[i] + corners, mesh.indices[i + 2] + corners,
                             mesh.indices[i + 1] + corners});
    return mesh;
}

// The frame of a picture on the head (x right for its reader, y down, z away) at this distance
// before the head's middle.
Pose head_from_picture(double before_m) {
    return {Quat{0, 0, 0, 1}, {0, 0, -before_m}};
}

// A head with ears' width, and a body that ends in the air.
MeshData skin_mesh() {
    const MeshData ball = render::make_sphere_mesh(1, rings);
    MeshData mesh;
    append(mesh, ball, {0.9 * head_radius_m, 1.15 * head_radius_m, head_radius_m}, {});
    append(mesh, ball, {0.16, 0.17, 0.09}, {0, -0.33, 0.03});
    append(mesh, ball, {0.05, 0.08, 0.05}, {0, -0.14, 0.01});
    return mesh;
}

MeshData nose_mesh() {
    MeshData mesh;
    append(mesh, render::make_sphere_mesh(1, rings), {0.018, 0.02, 0.03},
           {0, -0.012, -head_radius_m});
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
      nose_(nose_mesh()),
      eyes_(pair_mesh(0.024, {0.037, 0.02, -0.085})),
      pupils_(pair_mesh(0.012, {0.037, 0.02, -0.102})),
      hand_(hand_mesh()),
      picture_(rounded_mesh(face_width_m, face_height_m, face_corner_m)),
      rim_(rim_mesh()) {}

void People::add_face(render::SceneFrame& frame, const RoomPerson& person, double opacity) const {
    const double shown = person.face ? opacity * person.face->opacity : 0;
    if (!person.face || person.face->opacity < 1) {
        frame.objects.push_back({&nose_, *person.head, look(color_of(person.id), opacity)});
        frame.objects.push_back({&eyes_, *person.head, look({0.9, 0.9, 0.9}, opacity)});
        frame.objects.push_back({&pupils_, *person.head, look({0.02, 0.02, 0.02}, opacity)});
    }
    if (shown <= 0)
        return;
    frame.objects.push_back({&rim_, *person.head * head_from_picture(face_before_m - rim_behind_m),
                             look(color_of(person.id), shown)});
    render::SurfaceLook face = look({1, 1, 1}, shown);
    face.texture = person.face->texture;
    face.unlit = true;
    render::SceneObject picture{&picture_, *person.head * head_from_picture(face_before_m), face};
    picture.casts_shadow = false;
    frame.objects.push_back(picture);
}

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
            add_face(frame, person, opacity);
        }
        const std::string name = person.is_stale && person.age.empty()
                                     ? say(Phrase::person_of_old_view, person.name)
                                     : person.name;
        const double height = std::clamp(name_per_distance * length(person.head->translation - eye),
                                         least_name_m, largest_name_m);
        Pose place = facing(person.head->translation + Vec3{0, name_above_m, 0}, eye);
        place.translation = place * Vec3{-0.5 * height * letter_width * double(name.size()), 0, 0};
        frame.texts.push_back({name, place, height, {235, 240, 240}});
        const bool has_old_face = !person.has_cloud && person.face && !person.face->age.empty();
        const std::string age =
            person.age + (has_old_face ? (person.age.empty() ? "" : ", ") + person.face->age : "");
        if (age.empty())
            continue;
        const double small = age_share * height;
        Pose above =
            facing(person.head->translation + Vec3{0, name_above_m + age_lines * height, 0}, eye);
        above.translation = above * Vec3{-0.5 * small * letter_width * double(age.size()), 0, 0};
        const bool is_old = person.is_stale || has_old_face;
        frame.texts.push_back({age, above, small, is_old ? Rgb{255, 190, 70} : Rgb{175, 186, 196}});
    }
}

}  // namespace theatron::room
