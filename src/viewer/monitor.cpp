// SPDX-License-Identifier: Apache-2.0
#include "viewer/monitor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "image/scratch.h"
#include "phrases/phrase.h"
#include "room/mesh_parts.h"
#include "room/organ_mesh.h"
#include "viewer/slice_texts.h"

namespace theatron::viewer {
namespace {

using render::MeshData;
using render::SurfaceLook;

// Texts and lines stand so far before the picture.
constexpr double before_m = 0.003;
constexpr double letter_m = 0.02, fact_m = 0.013, letter_width = 0.75;
constexpr Rgb ink{255, 220, 90};

// Objects have y up and their front towards z; pictures have y down and z away from the reader.
const Pose object_from_picture{Quat{0, 1, 0, 0}, {}};

Vec3 in_organ(Vec3 direction_lps) {
    return room::organ_from_patient(direction_lps, {}) * 1000;
}

Vec3 towards_reader(const medical::SlicePlane& plane) {
    return plane.normal() * -1;
}

MeshData two_sided_panel(double width_m, double height_m) {
    MeshData mesh = render::make_panel_mesh(width_m, height_m);
    const std::size_t count = mesh.vertices.size(), indices = mesh.indices.size();
    for (std::size_t i = 0; i < count; ++i) {
        MeshData::Vertex back = mesh.vertices[i];
        back.nz = -back.nz;
        mesh.vertices.push_back(back);
    }
    for (std::size_t i = 0; i < indices; i += 3)
        for (const std::size_t corner : {0, 2, 1})
            mesh.indices.push_back(mesh.indices[i + corner] + std::uint32_t(count));
    return mesh;
}

SurfaceLook unlit(Vec3 color) {
    SurfaceLook look;
    look.base_color = color;
    look.unlit = true;
    return look;
}

// Texts and lines on a screen, in the frame of its picture.
struct ScreenWriter {
    render::SceneFrame& frame;
    const session::RoomObject& object;

    ScreenWriter(render::SceneFrame& to, const session::RoomObject& screen)
        : frame(to), object(screen) {}
    Pose at(double x, double y) const {
        return object.room_from_object * object_from_picture *
               Pose{{}, Vec3{x, y, -before_m} * object.scale};
    }
    void write(const std::string& text, double x, double y, double height) const {
        frame.texts.push_back({text, at(x, y), height * object.scale, ink});
    }
};

}  // namespace

SlicePicture slice_picture(const medical::Volume& volume, const session::CaseScreen& screen) {
    const auto orientation = medical::Orientation(screen.orientation);
    const medical::SliceRange range = medical::slice_range(volume.grid, orientation);
    SlicePicture slice;
    slice.plane = medical::slice_plane(
        volume.grid, orientation, std::clamp(screen.position_mm, range.first_mm, range.last_mm));
    // Fresh memory would cost more than the slice.
    auto& samples = scratch_of_this_thread<Image<std::int16_t>>(slice.plane.size);
    medical::reslice(volume, slice.plane,
                     volume.inverted ? std::numeric_limits<std::int16_t>::max()
                                     : std::numeric_limits<std::int16_t>::min(),
                     samples.view());
    const medical::GreyTable greys({screen.center, screen.width}, volume);
    slice.picture = ColorImage(slice.plane.size);
    for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
        const std::uint8_t grey = greys[samples.pixels[i]];
        slice.picture.pixels[i] = {grey, grey, grey};
    }
    return slice;
}

void Monitor::take(const std::optional<session::CaseInRoom>& room,
                   const client::OpenCase* content) {
    wanted_.reset();
    std::shared_ptr<const medical::Volume> volume;
    std::shared_ptr<const ColorImage> picture;
    const bool known = room && room->screen && content && content->description &&
                       content->id == room->screen->facts.of_case;
    pictures_ = known ? int(content->pictures.size()) : 0;
    if (known && room->screen->facts.series < content->volumes.size()) {
        wanted_ = room->screen->facts;
        wanted_->picture.reset();
        volume = content->volumes[wanted_->series];
        series_ = content->description->series[wanted_->series].name;
        case_name_ = content->description->name;
    }
    wants_picture_ = known && room->screen->facts.picture.value_or(pictures_) < pictures_;
    if (wants_picture_) {
        number_ = *room->screen->facts.picture;
        picture = content->pictures[std::size_t(number_)];
        picture_name_ = content->description->pictures[std::size_t(number_)].name;
    }
    if (volume != volume_) {
        volume_ = std::move(volume);
        shown_.reset();
    }
    if (wants_picture_ && (picture != picture_ || !picture_face_.panel)) {
        picture_ = std::move(picture);
        picture_is_new_ = true;
    }
}

void Monitor::Face::show(ColorView picture) {
    if (!texture || texture->size() != picture.size)
        texture.emplace(picture.size);
    texture->set(picture);
    const double scale = side_m / std::max(picture.size.width, picture.size.height);
    const Vec2 size{picture.size.width * scale, picture.size.height * scale};
    if (panel && size == size_m)
        return;
    size_m = size;
    panel.emplace(render::make_panel_mesh(size.x, size.y));
    // The bar's front is that of the picture: the facts stand before it.
    render::MeshData mesh =
        render::make_box_mesh({-size.x / 2, size.y / 2, 0}, {size.x / 2, size.y / 2 + bar_m, 0.01});
    room::append(
        mesh,
        render::make_box_mesh({-size.x / 2, -size.y / 2, 0.002}, {size.x / 2, size.y / 2, 0.01}),
        {1, 1, 1}, {});
    housing.emplace(mesh);
}

// Draws the slice again if it has changed.
void Monitor::update_slice() {
    if (!volume_ || !wanted_ || shown_ == wanted_)
        return;
    const SlicePicture slice = slice_picture(*volume_, *wanted_);
    plane_ = slice.plane;
    slice_.show(slice.picture.view());
    shown_ = wanted_;
    const double mm = plane_.mm_per_pixel * 0.001;
    const Vec2 life_size{plane_.size.width * mm, plane_.size.height * mm};
    const double ruler_m = medical::scale_bar(plane_.mm_per_pixel, plane_.size.width / 3.0).pixels *
                           slice_.size_m.x / plane_.size.width;
    if (inside_ && life_size == life_size_m_ && ruler_m == ruler_m_)
        return;
    life_size_m_ = life_size;
    ruler_m_ = ruler_m;
    inside_.emplace(two_sided_panel(life_size.x, life_size.y));
    ruler_.emplace(render::make_box_mesh({0, 0, 0}, {ruler_m, 0.004, 0.001}));
}

void Monitor::update_picture() {
    if (!std::exchange(picture_is_new_, false))
        return;
    if (picture_)
        return picture_face_.show(picture_->view());
    // An empty screen until it comes.
    ColorImage empty({4, 3});
    std::fill(empty.pixels.begin(), empty.pixels.end(), Rgb{20, 22, 24});
    picture_face_.show(empty.view());
}

const Monitor::Face* Monitor::face() const {
    if (wants_picture_)
        return picture_face_.panel ? &picture_face_ : nullptr;
    return shown_ ? &slice_ : nullptr;
}

void Monitor::add_to(render::SceneFrame& frame, const session::CaseInRoom& room, Vec3 middle_mm,
                     const render::CameraView&) {
    if (!wants_picture_ || room.organ.cut)
        update_slice();
    if (wants_picture_)
        update_picture();
    const Face* shown = face();
    if (!shown || !room.screen)
        return;
    const session::RoomObject& object = room.screen->object;
    const auto id = render::PickId(std::uint32_t(room.screen->id));
    const Pose place = object.room_from_object * object_from_picture;
    SurfaceLook look = unlit({1, 1, 1});
    look.texture = &*shown->texture;
    frame.objects.push_back({&*shown->panel, place, look, false, id, object.scale});
    frame.objects.push_back(
        {&*shown->housing, place, {{0.12, 0.14, 0.16}, 0, 0.5}, false, id, object.scale});
    if (wants_picture_)
        add_picture_facts(frame, object);
    else
        add_slice_facts(frame, object);
    if (!room.organ.cut || !shown_)
        return;
    // The slice in the organ.
    const session::ScaledPose inside =
        session::part_in_room(room.organ_object, organ_from_picture(middle_mm));
    look.texture = &*slice_.texture;
    frame.objects.push_back(
        {&*inside_, inside.pose, look, false, render::PickId::none, inside.scale});
}

void Monitor::add_slice_facts(render::SceneFrame& frame, const session::RoomObject& object) const {
    const ScreenWriter facts(frame, object);
    const Vec2 half{slice_.size_m.x / 2, slice_.size_m.y / 2};
    frame.objects.push_back({&*ruler_, facts.at(-half.x + 0.02, half.y - 0.02),
                             unlit({1, 0.86, 0.35}), false, render::PickId::none, object.scale});
    const auto width = [](const std::string& text) {
        return double(text.size()) * letter_m * letter_width;
    };
    const SliceTexts texts = slice_texts(plane_, *shown_, case_name_, series_);
    const medical::EdgeLetters& letters = texts.letters;
    facts.write(letters.left, -half.x + 0.01, letter_m / 2, letter_m);
    facts.write(letters.right, half.x - 0.01 - width(letters.right), letter_m / 2, letter_m);
    facts.write(letters.top, -width(letters.top) / 2, -half.y + 0.01 + letter_m, letter_m);
    facts.write(letters.bottom, -width(letters.bottom) / 2, half.y - 0.01, letter_m);
    const medical::ScaleBar ruler =
        medical::scale_bar(plane_.mm_per_pixel, plane_.size.width / 3.0);
    char text[120];
    std::snprintf(text, sizeof(text), "%g mm", ruler.length_mm);
    facts.write(text, -half.x + 0.02, half.y - 0.026, fact_m);
    facts.write(texts.case_name + "  " + texts.series, -half.x + 0.01, half.y + 0.3 * bar_m,
                fact_m);
    facts.write(texts.plane + "  " + texts.window, -half.x + 0.01, half.y + 0.61 * bar_m, fact_m);
    facts.write(texts.notice, -half.x + 0.01, half.y + 0.92 * bar_m, fact_m);
}

void Monitor::add_picture_facts(render::SceneFrame& frame,
                                const session::RoomObject& object) const {
    const Vec2 half{picture_face_.size_m.x / 2, picture_face_.size_m.y / 2};
    ScreenWriter(frame, object)
        .write(say(picture_ ? Phrase::picture_facts : Phrase::picture_is_fetched, picture_name_,
                   std::to_string(number_ + 1), std::to_string(pictures_)),
               -half.x + 0.01, half.y + 0.6 * bar_m, fact_m);
}

Pose Monitor::organ_from_picture(Vec3 middle_mm) const {
    const Vec3 right = in_organ(plane_.right), down = in_organ(plane_.down);
    const Vec3 away = cross(right, down);
    const Quat turned = quat_from_matrix(
        {{{right.x, down.x, away.x}, {right.y, down.y, away.y}, {right.z, down.z, away.z}}});
    const Vec3 middle = room::organ_from_patient(
        plane_.point_at((plane_.size.width - 1) / 2.0, (plane_.size.height - 1) / 2.0), middle_mm);
    return {turned, middle};
}

std::optional<Monitor::SliceFrame> Monitor::slice_frame(const session::CaseInRoom& room,
                                                        Vec3 middle_mm) const {
    if (!volume_ || !shown_ || !room.screen)
        return std::nullopt;
    SliceFrame frame;
    frame.picture_from_organ = inverse(organ_from_picture(middle_mm));
    const session::RoomObject& screen = room.screen->object;
    frame.screen_scale = screen.scale * slice_.size_m.x / life_size_m_.x;
    Pose screen_from_points = frame.picture_from_organ;
    screen_from_points.translation = screen_from_points.translation * frame.screen_scale;
    frame.screen_from_organ = screen.room_from_object * object_from_picture * screen_from_points;
    const auto range =
        medical::slice_range(volume_->grid, medical::Orientation(shown_->orientation));
    frame.half_step_m = 0.0005 * range.step_mm;
    frame.on_screen = !wants_picture_;
    return frame;
}

std::optional<render::Cut> Monitor::plane_in(const session::CaseInRoom& room,
                                             Vec3 middle_mm) const {
    if (!volume_ || !wanted_)
        return std::nullopt;
    const auto orientation = medical::Orientation(wanted_->orientation);
    const medical::SliceRange range = medical::slice_range(volume_->grid, orientation);
    const medical::SlicePlane plane =
        medical::slice_plane(volume_->grid, orientation,
                             std::clamp(wanted_->position_mm, range.first_mm, range.last_mm));
    const Pose& organ = room.organ_object.room_from_object;
    const Vec3 normal = rotate(organ.rotation, in_organ(towards_reader(plane)));
    const Vec3 place =
        organ * (room::organ_from_patient(plane.top_left_mm, middle_mm) * room.organ_object.scale);
    return render::Cut{normal, dot(normal, place)};
}

std::optional<Vec2> Monitor::place_on(const session::CaseInRoom& room, Vec3 place) const {
    const Face* shown = face();
    if (!shown || !room.screen)
        return std::nullopt;
    const session::RoomObject& object = room.screen->object;
    const Vec3 p = inverse(object.room_from_object * object_from_picture) * place;
    const Vec2 in{p.x / object.scale / shown->size_m.x + 0.5,
                  p.y / object.scale / shown->size_m.y + 0.5};
    return in.x >= 0 && in.x <= 1 && in.y >= 0 && in.y <= 1 ? std::optional(in) : std::nullopt;
}

bool Monitor::shows_at(const session::CaseInRoom& room, Vec3 place) const {
    return place_on(room, place).has_value();
}

std::optional<Vec3> Monitor::patient_point(const session::CaseInRoom& room, Vec3 place) const {
    const auto in = wants_picture_ ? std::nullopt : place_on(room, place);
    if (!in)
        return std::nullopt;
    return plane_.point_at(in->x * plane_.size.width - 0.5, in->y * plane_.size.height - 0.5);
}

}  // namespace theatron::viewer
