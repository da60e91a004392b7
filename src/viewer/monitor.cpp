// SPDX-License-Identifier: Apache-2.0
#include "viewer/monitor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "room/mesh_parts.h"
#include "room/organ_mesh.h"

namespace theatron::viewer {
namespace {

using render::MeshData;
using render::SurfaceLook;

// Texts and lines stand so far before the picture.
constexpr double before_m = 0.003;
constexpr double letter_m = 0.02, fact_m = 0.013, letter_width = 0.75;
constexpr Rgb ink{255, 220, 90};
constexpr const char* orientation_names[] = {"axial", "coronal", "sagittal"};

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

}  // namespace

SlicePicture slice_picture(const medical::Volume& volume, const session::CaseScreen& screen) {
    const auto orientation = medical::Orientation(screen.orientation);
    const medical::SliceRange range = medical::slice_range(volume.grid, orientation);
    SlicePicture slice;
    slice.plane = medical::slice_plane(
        volume.grid, orientation, std::clamp(screen.position_mm, range.first_mm, range.last_mm));
    Image<std::int16_t> samples(slice.plane.size);
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
    if (room && room->screen && content && content->id == room->screen->facts.of_case &&
        room->screen->facts.series < content->volumes.size()) {
        wanted_ = room->screen->facts;
        volume = content->volumes[wanted_->series];
        series_ = content->description->series[wanted_->series].name;
    }
    if (volume != volume_) {
        volume_ = std::move(volume);
        shown_.reset();
    }
}

Vec2 Monitor::size_m() const {
    const double width = plane_.size.width, height = plane_.size.height;
    const double scale = side_m / std::max({width, height, 1.0});
    return {width * scale, height * scale};
}

// Draws the slice again if it has changed.
void Monitor::update() {
    if (!volume_ || !wanted_ || shown_ == wanted_)
        return;
    const SlicePicture slice = slice_picture(*volume_, *wanted_);
    plane_ = slice.plane;
    if (!texture_ || texture_->size() != slice.picture.size)
        texture_.emplace(slice.picture.size);
    texture_->set(slice.picture.view());
    shown_ = wanted_;
    const Vec2 size = size_m();
    const double mm = plane_.mm_per_pixel * 0.001;
    const double m_per_pixel = size.x / plane_.size.width;
    const double ruler_m =
        medical::scale_bar(plane_.mm_per_pixel, plane_.size.width / 3.0).pixels * m_per_pixel;
    if (panel_ && size == panel_size_ && ruler_m == ruler_m_)
        return;
    panel_size_ = size;
    ruler_m_ = ruler_m;
    panel_.emplace(render::make_panel_mesh(size.x, size.y));
    inside_.emplace(two_sided_panel(plane_.size.width * mm, plane_.size.height * mm));
    render::MeshData housing = render::make_box_mesh({-size.x / 2, size.y / 2, -0.01},
                                                     {size.x / 2, size.y / 2 + bar_m, 0.01});
    room::append(
        housing,
        render::make_box_mesh({-size.x / 2, -size.y / 2, 0.002}, {size.x / 2, size.y / 2, 0.01}),
        {1, 1, 1}, {});
    housing_.emplace(housing);
    ruler_.emplace(render::make_box_mesh({0, 0, 0}, {ruler_m, 0.004, 0.001}));
}

void Monitor::add_to(render::SceneFrame& frame, const session::CaseInRoom& room, Vec3 middle_mm,
                     const render::CameraView&) {
    update();
    if (!shown_ || !room.screen)
        return;
    const session::RoomObject& object = room.screen->object;
    const auto id = render::ObjectId(std::uint32_t(room.screen->id));
    const Pose place = object.room_from_object * object_from_picture;
    const double scale = object.scale;
    SurfaceLook look = unlit({1, 1, 1});
    look.texture = &*texture_;
    frame.objects.push_back({&*panel_, place, look, false, id, scale});
    frame.objects.push_back({&*housing_, place, {{0.12, 0.14, 0.16}, 0, 0.5}, false, id, scale});
    const auto at = [&](double x, double y) {
        return place * Pose{{}, Vec3{x, y, -before_m} * scale};
    };
    const Vec2 half{panel_size_.x / 2, panel_size_.y / 2};
    frame.objects.push_back({&*ruler_, at(-half.x + 0.02, half.y - 0.02), unlit({1, 0.86, 0.35}),
                             false, render::ObjectId::none, scale});
    const auto write = [&](const std::string& text, double x, double y, double height) {
        frame.texts.push_back({text, at(x, y), height * scale, ink});
    };
    const auto width = [](const std::string& text) {
        return double(text.size()) * letter_m * letter_width;
    };
    const medical::EdgeLetters letters = medical::edge_letters(plane_);
    write(letters.left, -half.x + 0.01, letter_m / 2, letter_m);
    write(letters.right, half.x - 0.01 - width(letters.right), letter_m / 2, letter_m);
    write(letters.top, -width(letters.top) / 2, -half.y + 0.01 + letter_m, letter_m);
    write(letters.bottom, -width(letters.bottom) / 2, half.y - 0.01, letter_m);
    const medical::ScaleBar ruler =
        medical::scale_bar(plane_.mm_per_pixel, plane_.size.width / 3.0);
    char text[120];
    std::snprintf(text, sizeof(text), "%g mm", ruler.length_mm);
    write(text, -half.x + 0.02, half.y - 0.026, fact_m);
    std::snprintf(text, sizeof(text), "%s  %s %.1f mm  window %.0f / %.0f", series_.c_str(),
                  orientation_names[shown_->orientation], shown_->position_mm, shown_->center,
                  shown_->width);
    write(text, -half.x + 0.01, half.y + 0.6 * bar_m, fact_m);
    if (!room.organ.cut)
        return;
    // The slice in the organ.
    const session::ScaledPose inside =
        session::part_in_room(room.organ_object, organ_from_picture(middle_mm));
    frame.objects.push_back(
        {&*inside_, inside.pose, look, false, render::ObjectId::none, inside.scale});
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
    const double life_size_m = plane_.size.width * plane_.mm_per_pixel * 0.001;
    frame.screen_scale = screen.scale * panel_size_.x / life_size_m;
    Pose screen_from_points = frame.picture_from_organ;
    screen_from_points.translation = screen_from_points.translation * frame.screen_scale;
    frame.screen_from_organ = screen.room_from_object * object_from_picture * screen_from_points;
    const auto range =
        medical::slice_range(volume_->grid, medical::Orientation(shown_->orientation));
    frame.half_step_m = 0.0005 * range.step_mm;
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

std::optional<Vec3> Monitor::patient_point(const session::CaseInRoom& room, Vec3 place) const {
    if (!shown_ || !room.screen)
        return std::nullopt;
    const session::RoomObject& object = room.screen->object;
    const Vec3 p = inverse(object.room_from_object * object_from_picture) * place;
    const double u = p.x / object.scale / panel_size_.x + 0.5,
                 v = p.y / object.scale / panel_size_.y + 0.5;
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1))
        return std::nullopt;
    return plane_.point_at(u * plane_.size.width - 0.5, v * plane_.size.height - 0.5);
}

}  // namespace theatron::viewer
