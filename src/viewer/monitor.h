// SPDX-License-Identifier: Apache-2.0
// The screen of the open case: a slice of its images with letters of directions, a scale bar, the
// case's name, its place and its window, in the room and as a plane inside of the organ; or a
// picture of the case, on the screen alone.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/participant.h"
#include "medical/slice.h"
#include "medical/window.h"
#include "render/camera_view.h"
#include "render/scene_frame.h"
#include "session/case_objects.h"

namespace theatron::viewer {

// The grey picture of a screen's slice. Pure.
struct SlicePicture {
    medical::SlicePlane plane;
    ColorImage picture;
};
SlicePicture slice_picture(const medical::Volume& volume, const session::CaseScreen& screen);

// Use from one thread, with the same GL context current.
class Monitor {
public:
    // The picture's larger side, and the bar at its lower edge by which it is held.
    static constexpr double side_m = 0.5, bar_m = 0.058;

    void take(const std::optional<session::CaseInRoom>& room, const client::OpenCase* content);
    void add_to(render::SceneFrame& frame, const session::CaseInRoom& room, Vec3 middle_mm,
                const render::CameraView& view);

    // The slice that is shown, for what is drawn on it. In the picture's frame x points right, y
    // down, z away from the reader; its origin is the picture's middle, lengths are life size.
    struct SliceFrame {
        Pose picture_from_organ;  // from the frame of the organ, metres
        // Where it is on the screen: a metre of the organ is `screen_scale` metres of the room.
        Pose screen_from_organ;
        double screen_scale = 1;
        double half_step_m = 0;  // half of the distance between two slices
        bool on_screen = true;   // else only in the organ: the screen shows a picture
    };
    std::optional<SliceFrame> slice_frame(const session::CaseInRoom& room, Vec3 middle_mm) const;

    // The slice's plane in the room: its normal points to the viewer of the picture.
    std::optional<render::Cut> plane_in(const session::CaseInRoom& room, Vec3 middle_mm) const;
    // True for a place of the room on the slice or picture, false beside it.
    bool shows_at(const session::CaseInRoom& room, Vec3 place) const;
    // The patient coordinates of a place of the room on the slice; nullopt beside it.
    std::optional<Vec3> patient_point(const session::CaseInRoom& room, Vec3 place) const;
    // The volume that the screen shows; null: it has not come.
    const medical::Volume* volume() const { return volume_.get(); }
    // The number of pictures of the case.
    int pictures() const { return pictures_; }

private:
    // A slice or a picture in its housing.
    struct Face {
        std::optional<render::SceneTexture> texture;
        std::optional<render::SceneMesh> panel, housing;
        Vec2 size_m;

        void show(ColorView picture);
    };
    void update_slice();
    void update_picture();
    const Face* face() const;
    // A place of the room in the picture, 0 to 1 in both directions; nullopt beside it.
    std::optional<Vec2> place_on(const session::CaseInRoom& room, Vec3 place) const;
    void add_slice_facts(render::SceneFrame& frame, const session::RoomObject& object) const;
    void add_picture_facts(render::SceneFrame& frame, const session::RoomObject& object) const;
    Pose organ_from_picture(Vec3 middle_mm) const;

    std::shared_ptr<const medical::Volume> volume_;
    std::optional<session::CaseScreen> wanted_, shown_;  // slices
    std::string series_, case_name_;
    medical::SlicePlane plane_;
    Face slice_;
    std::optional<render::SceneMesh> ruler_, inside_;
    Vec2 life_size_m_;
    double ruler_m_ = 0;

    bool wants_picture_ = false;
    int number_ = 0, pictures_ = 0;
    std::string picture_name_;
    std::shared_ptr<const ColorImage> picture_;  // null: it has not come
    bool picture_is_new_ = false;
    Face picture_face_;
};

}  // namespace theatron::viewer
