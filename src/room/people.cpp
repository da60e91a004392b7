// SPDX-License-Identifier: Apache-2.0
#include "room/people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/utf8.h"
#include "phrases/phrase.h"
#include "room/facing.h"
#include "room/figure_meshes.h"

namespace theatron::room {
namespace {

using render::MeshData;

// An eye nearer than this to a head is inside of it, or so close that the head fills the picture.
constexpr double free_around_eye_m = 0.3;
constexpr double name_above_m = 0.18, letter_width = 0.8;
// Names have about the same size in the picture, within limits.
constexpr double least_name_m = 0.025, largest_name_m = 0.09, name_per_distance = 0.02;
// The age of a person above the name: height and place, in heights of the name's letters.
constexpr double age_share = 0.65, age_lines = 1.5;
constexpr double stale_opacity = 0.35;

// The plate, its rim, its letters before it, and the cone below it. Letters are in heights.
constexpr double plate_radius_m = 0.12, plate_rim_m = 0.01, rim_behind_plate_m = 0.004;
constexpr double initials_m = 0.1, before_plate_m = 0.004, initial_width = 1.0;
constexpr double cone_below_m = 0.175;
// Letters on a plate of more than this share of white's brightness are dark.
constexpr double bright = 0.3;

// Clothes and skin of busts; linear. Skin, mask and gown tell nothing of a person.
constexpr Vec3 skin_color{0.42, 0.3, 0.24}, mask_color{0.6, 0.72, 0.78},
    gown_color{0.2, 0.25, 0.31}, glove_color{0.72, 0.72, 0.68}, eye_color{0.025, 0.02, 0.02};
// The same of a face that shows an expression. The cap sits higher, so that brows are seen.
constexpr Vec3 white_color{0.72, 0.72, 0.7}, dark_color{0.05, 0.035, 0.03},
    lip_color{0.36, 0.19, 0.16}, mouth_color{0.03, 0.012, 0.012};
constexpr Pose head_from_cap{{}, {0, 0.019, 0.001}};
constexpr double cap_scale = 0.95;

// The picture of a face: 4:3 with round corners, before the middle of the head, in a rim of the
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

render::SurfaceLook look(Vec3 color, double opacity) {
    return {color, 0, 0.55, opacity, 0};
}

// Without light: a sign keeps its colour everywhere in the room.
render::SurfaceLook sign_look(Vec3 color, double opacity) {
    render::SurfaceLook sign = look(color, opacity);
    sign.unlit = true;
    return sign;
}

// The same for what is drawn into a cloud, whose colours are those of a camera: sRGB.
render::SurfaceLook cloud_look(Vec3 linear, double opacity) {
    const auto encoded = [](double value) { return std::pow(value, 1 / 2.2); };
    return sign_look({encoded(linear.x), encoded(linear.y), encoded(linear.z)}, opacity);
}

double brightness(Vec3 linear) {
    return 0.2126 * linear.x + 0.7152 * linear.y + 0.0722 * linear.z;
}

// The frame of a body below this head: upright, turned as the head about the vertical.
Pose body_below(const Pose& head) {
    Vec3 ahead = rotate(head.rotation, {0, 0, -1});
    // One who looks straight up or down still has a direction: that of the crown or of the chin.
    if (std::hypot(ahead.x, ahead.z) < 0.2)
        ahead = rotate(head.rotation, {0, ahead.y < 0 ? 1.0 : -1.0, 0});
    const double yaw = std::atan2(-ahead.x, -ahead.z);
    const Pose turned{rotation_about({0, 1, 0}, yaw), {}};
    return {turned.rotation, head * neck_pivot - turned * neck_pivot};
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

std::string initials_of(const std::string& name) {
    std::vector<std::string> words(1);
    for (std::size_t at = 0; at < name.size();) {
        const std::size_t bytes = first_character(std::string_view(name).substr(at)).bytes;
        if (name[at] == ' ') {
            words.emplace_back();
        } else {
            words.back() += name.substr(at, bytes);
            // A word that ends with a dot is a title or a short form.
            if (name[at] == '.')
                words.back().clear();
        }
        at += bytes;
    }
    // "(recorded)" and the like say something of the name.
    std::erase_if(words, [](const std::string& word) { return word.empty() || word[0] == '('; });
    if (words.empty())
        return name.substr(0, name.empty() ? 0 : first_character(name).bytes);
    const auto initial = [](const std::string& word) {
        std::string letter = word.substr(0, first_character(word).bytes);
        if (letter[0] >= 'a' && letter[0] <= 'z')
            letter[0] = char(letter[0] - 'a' + 'A');
        return letter;
    };
    return initial(words.front()) + (words.size() > 1 ? initial(words.back()) : "");
}

People::People()
    : bust_([] {
          const BustMeshes meshes = bust_meshes();
          return Bust{render::SceneMesh(meshes.head), render::SceneMesh(meshes.back),
                      render::SceneMesh(meshes.cap),  render::SceneMesh(meshes.mask),
                      render::SceneMesh(meshes.eyes), render::SceneMesh(meshes.neck),
                      render::SceneMesh(meshes.gown), render::SceneMesh(meshes.collar)};
      }()),
      left_(make_hand(Side::left, false)),
      right_(make_hand(Side::right, false)),
      pointing_(make_hand(Side::right, true)),
      plate_(disc_mesh(plate_radius_m)),
      plate_rim_(disc_mesh(plate_radius_m + plate_rim_m)),
      cone_(view_cone_mesh()),
      picture_(rounded_mesh(face_width_m, face_height_m, face_corner_m)),
      rim_(rim_mesh()) {}

People::Hand People::make_hand(Side side, bool points) {
    const HandMeshes meshes = hand_meshes(side, points);
    return {render::SceneMesh(meshes.glove), render::SceneMesh(meshes.cuff)};
}

void People::add_hands(render::SceneFrame& frame, const RoomPerson& person, double opacity) const {
    const auto add = [&](const Hand& hand, const Pose& place) {
        frame.objects.push_back({&hand.glove, place, look(glove_color, opacity)});
        frame.objects.push_back({&hand.cuff, place, look(color_of(person.id), opacity)});
    };
    if (person.left_hand)
        add(left_, *person.left_hand);
    if (person.right_hand)
        add(person.points ? pointing_ : right_, *person.right_hand);
}

// Uploads the face again where it shows something else than in the picture before.
const People::Face& People::face_of(const RoomPerson& person) {
    const auto found = drawn_faces_.find(person.id);
    if (found != drawn_faces_.end() && found->second.shown == *person.expression)
        return found->second;
    if (!shape_)
        shape_ = std::make_unique<FaceShape>();
    const FaceMeshes meshes = shape_->meshes(*person.expression);
    Face face{*person.expression,
              render::SceneMesh(meshes.skin),
              render::SceneMesh(meshes.whites),
              render::SceneMesh(meshes.dark),
              render::SceneMesh(meshes.lips),
              render::SceneMesh(meshes.mouth)};
    return drawn_faces_.insert_or_assign(person.id, std::move(face)).first->second;
}

void People::add_face(render::SceneFrame& frame, const RoomPerson& person, double opacity) {
    const Face& face = face_of(person);
    const auto add = [&](const render::SceneMesh& mesh, Vec3 color) {
        frame.objects.push_back({&mesh, *person.head, look(color, opacity)});
    };
    add(bust_.back, skin_color);
    add(face.skin, skin_color);
    add(face.whites, white_color);
    add(face.dark, dark_color);
    add(face.lips, lip_color);
    add(face.mouth, mouth_color);
    render::SceneObject cap{&bust_.cap, *person.head * head_from_cap,
                            look(color_of(person.id), opacity)};
    cap.scale = cap_scale;
    frame.objects.push_back(cap);
}

// Uploads what has changed since the picture before: the mesh, and more seldom the skin's picture.
const People::Own& People::own_of(const RoomPerson& person) {
    Own& own = own_heads_[person.id];
    const OwnHead& head = *person.own_head;
    const bool is_other = own.head != person.own_head;
    if (is_other || !(own.shown == person.shown_face)) {
        own.shown = person.shown_face;
        const auto meshes = head.meshes(own.shown);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            own.parts[i].reset();
            if (!meshes[i].indices.empty())
                own.parts[i].emplace(meshes[i]);
        }
    }
    if (is_other) {
        own.back.reset();
        if (!head.is_whole())
            own.back.emplace(head.back());
    }
    const OwnHead::Shares shares = head.shares(own.shown.emotions);
    if (is_other || shares != own.shares) {
        head.blend(shares, blended_);
        if (!own.skin || own.skin->size() != blended_.size)
            own.skin.emplace(blended_.size);
        own.skin->set(blended_.view());
        own.shares = shares;
    }
    own.head = person.own_head;
    return own;
}

void People::add_own_head(render::SceneFrame& frame, const RoomPerson& person, double opacity) {
    const Own& own = own_of(person);
    const OwnHead& head = *own.head;
    // In a cloud the pupils are at the head's origin, as in the person who wears the headset.
    const Pose in_cloud{{}, {0, 0, head.pupils_before_m()}};
    const Pose place = person.has_cloud ? *person.head * in_cloud : *person.head;
    const auto look_of = [&](Vec3 color) {
        const Vec3 gain = person.skin_gain;
        if (!person.has_cloud)
            return look(color, opacity);
        return cloud_look({color.x * gain.x, color.y * gain.y, color.z * gain.z}, opacity);
    };
    for (std::size_t i = 0; i < own.parts.size(); ++i) {
        if (!own.parts[i])
            continue;
        const auto part = face::HeadPart(i);
        const bool is_skin = part == face::HeadPart::skin;
        render::SurfaceLook of_part = look_of(is_skin ? Vec3{1, 1, 1} : head.color(part));
        if (is_skin)
            of_part.texture = &*own.skin;
        frame.objects.push_back({&*own.parts[i], place, of_part});
    }
    if (own.back)
        frame.objects.push_back({&*own.back, place, look_of(head.color(face::HeadPart::skin))});
    const Vec3 of_cap = color_of(person.id);
    render::SceneObject cap{&bust_.cap, place * head.cap().place,
                            person.has_cloud ? cloud_look(of_cap, opacity) : look(of_cap, opacity)};
    cap.scale = head.cap().scale;
    frame.objects.push_back(cap);
    // The cloud's own neck goes round it where it is seen.
    const OwnHead::Part of_neck = person.has_cloud ? head.neck_in_cloud() : head.neck();
    render::SceneObject neck{&bust_.neck, body_below(place) * of_neck.place,
                             look_of(head.color(face::HeadPart::skin))};
    neck.scale = of_neck.scale;
    frame.objects.push_back(neck);
}

void People::add_bust(render::SceneFrame& frame, const RoomPerson& person, double opacity) {
    const Pose body = body_below(*person.head);
    const Vec3 color = color_of(person.id);
    const bool has_own = person.expression && person.own_head;
    if (has_own) {
        add_own_head(frame, person, opacity);
    } else if (person.expression) {
        add_face(frame, person, opacity);
    } else {
        frame.objects.push_back({&bust_.head, *person.head, look(skin_color, opacity)});
        frame.objects.push_back({&bust_.cap, *person.head, look(color, opacity)});
        frame.objects.push_back({&bust_.mask, *person.head, look(mask_color, opacity)});
        frame.objects.push_back({&bust_.eyes, *person.head, look(eye_color, opacity)});
    }
    if (!has_own)
        frame.objects.push_back({&bust_.neck, body, look(skin_color, opacity)});
    frame.objects.push_back({&bust_.gown, body, look(gown_color, opacity)});
    frame.objects.push_back({&bust_.collar, body, look(color, opacity)});
}

void People::add_plate(render::SceneFrame& frame, const RoomPerson& person, double opacity,
                       Vec3 eye) const {
    const Vec3 color = color_of(person.id);
    const Pose plate = facing(person.head->translation, eye);
    const auto add = [&](const render::SceneMesh& mesh, double behind_m, Vec3 of) {
        render::SceneObject part{&mesh, plate * Pose{{}, {0, 0, behind_m}}, sign_look(of, opacity)};
        part.casts_shadow = false;
        frame.objects.push_back(part);
    };
    const bool is_bright = brightness(color) > bright;
    add(plate_rim_, rim_behind_plate_m,
        is_bright ? Vec3{0.01, 0.01, 0.015} : Vec3{0.85, 0.87, 0.88});
    add(plate_, 0, color);
    const Pose below{person.head->rotation, person.head->translation - Vec3{0, cone_below_m, 0}};
    frame.objects.push_back({&cone_, below, look(color, opacity)});
    const std::string initials = initials_of(person.name);
    std::size_t letters = 0;
    for (std::size_t at = 0; at < initials.size(); ++letters)
        at += first_character(std::string_view(initials).substr(at)).bytes;
    frame.texts.push_back({initials,
                           plate * Pose{{},
                                        {-0.5 * initials_m * initial_width * double(letters),
                                         0.5 * initials_m, -before_plate_m}},
                           initials_m, is_bright ? Rgb{20, 22, 26} : Rgb{245, 248, 250}});
}

void People::add_picture(render::SceneFrame& frame, const RoomPerson& person,
                         double opacity) const {
    const double shown = opacity * person.face->opacity;
    if (shown <= 0)
        return;
    frame.objects.push_back({&rim_, *person.head * head_from_picture(face_before_m - rim_behind_m),
                             look(color_of(person.id), shown)});
    render::SurfaceLook face = sign_look({1, 1, 1}, shown);
    face.texture = person.face->texture;
    render::SceneObject picture{&picture_, *person.head * head_from_picture(face_before_m), face};
    picture.casts_shadow = false;
    frame.objects.push_back(picture);
}

void People::add_to(render::SceneFrame& frame, const std::vector<RoomPerson>& people,
                    const render::CameraView& view) {
    const Vec3 eye = view.room_from_eye.translation;
    std::erase_if(drawn_faces_, [&](const auto& drawn) {
        return std::none_of(people.begin(), people.end(), [&](const RoomPerson& person) {
            return person.id == drawn.first && person.expression;
        });
    });
    std::erase_if(own_heads_, [&](const auto& drawn) {
        return std::none_of(people.begin(), people.end(), [&](const RoomPerson& person) {
            return person.id == drawn.first && person.own_head;
        });
    });
    for (const RoomPerson& person : people) {
        const double opacity = person.is_stale ? stale_opacity : 1;
        add_hands(frame, person, opacity);
        if (!person.head || length(person.head->translation - eye) < free_around_eye_m)
            continue;
        if (!person.has_cloud) {
            if (!person.face || person.face->opacity < 1) {
                if (person.has_headset || person.expression)
                    add_bust(frame, person, opacity);
                else
                    add_plate(frame, person, opacity, eye);
            }
            if (person.face)
                add_picture(frame, person, opacity);
        } else if (person.expression && person.own_head) {
            add_own_head(frame, person, opacity);
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
