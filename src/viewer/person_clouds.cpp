// SPDX-License-Identifier: Apache-2.0
#include "viewer/person_clouds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/cloud_skin.h"

namespace theatron::viewer {
namespace {

// Closer to the vertical than this, the direction of the head says nothing about that of the body.
constexpr double least_horizontal = 0.3;
// Light changes slowly, and looking for skin takes some milliseconds.
constexpr Duration skin_interval = std::chrono::seconds(2);
// A new colour of the skin counts this share, so that the face does not flicker.
constexpr double new_share = 0.3;

}  // namespace

Pose room_from_person(const Pose& room_from_head) {
    Vec3 ahead = rotate(room_from_head.rotation, {0, 0, -1});
    if (std::hypot(ahead.x, ahead.z) < least_horizontal)
        ahead = rotate(room_from_head.rotation, {0, ahead.y < 0 ? 1.0 : -1.0, 0});
    const double yaw = std::atan2(-ahead.x, -ahead.z);
    return {rotation_about({0, 1, 0}, yaw), room_from_head.translation};
}

PersonClouds::Person* PersonClouds::person_of(CameraId camera) const {
    for (const auto& [id, person] : people_)
        if (person->cameras.contains(camera))
            return person.get();
    return nullptr;
}

void PersonClouds::set_camera(ParticipantId id, CameraId number, const Calibration& calibration) {
    if (!programs_)
        programs_ = std::make_shared<render::CloudPrograms>();
    std::unique_ptr<Person>& person = people_[id];
    if (!person) {
        person = std::make_unique<Person>(Person{render::CloudSet(programs_), {}, {}, false, {}});
        person->clouds.set_depth_step(depth_step_);
    }
    if (!person->cameras.contains(number) &&
        person->cameras.size() == std::size_t(render::max_set_cameras))
        return;
    Camera& camera = person->cameras[number];
    if (camera.person_from_camera == calibration)
        return;
    camera.person_from_camera = calibration;
    camera.newest.reset();
    camera.rays = {};
    person->clouds.set_camera(number, calibration);
}

void PersonClouds::remove_camera(CameraId number) {
    for (auto person = people_.begin(); person != people_.end(); ++person)
        if (person->second->cameras.erase(number) > 0) {
            person->second->clouds.remove_camera(number);
            if (person->second->cameras.empty())
                people_.erase(person);
            return;
        }
}

void PersonClouds::set_live(CameraId number, bool is_live) {
    if (Person* person = person_of(number)) {
        person->cameras[number].is_live = is_live;
        person->clouds.set_presence(number, is_live ? 1 : 0);
    }
}

Status PersonClouds::upload(const receive::CameraFramePtr& frame) {
    Person* person = person_of(frame->camera);
    if (!person)
        return Status::size_mismatch;
    const Status status = person->clouds.upload(frame->camera, frame->depth.view(),
                                                frame->color ? frame->color->view() : ColorView{});
    if (status == Status::ok) {
        Camera& camera = person->cameras[frame->camera];
        camera.newest = frame;
        if (person->has_own_head)
            note_skin(*person, camera);
    }
    return status;
}

void PersonClouds::note_skin(Person& person, Camera& camera) {
    const receive::CameraFrame& frame = *camera.newest;
    if (!frame.color || frame.times.captured - camera.skin_of < skin_interval)
        return;
    camera.skin_of = frame.times.captured;
    Calibration calibration = camera.person_from_camera;
    if (camera.rays.empty())
        camera.rays = make_ray_table(calibration.depth);
    calibration.color = scaled(calibration.color, frame.color->size);
    const auto seen = cloud_skin(frame.depth.view(), frame.color->view(), calibration, camera.rays);
    if (seen)
        person.skin = person.skin ? *person.skin * (1 - new_share) + *seen * new_share : *seen;
}

std::map<ParticipantId, Vec3> PersonClouds::skins() const {
    std::map<ParticipantId, Vec3> skins;
    for (const auto& [id, person] : people_)
        if (person->has_own_head && person->skin)
            skins[id] = *person->skin;
    return skins;
}

void PersonClouds::set_depth_step(int step) {
    depth_step_ = step;
    for (const auto& [id, person] : people_)
        if (person->clouds.set_depth_step(step))
            for (const auto& [number, camera] : person->cameras)
                if (camera.newest)
                    (void)upload(camera.newest);
}

void PersonClouds::place(const std::vector<room::RoomPerson>& people) {
    for (const auto& [id, person] : people_) {
        const auto known = std::find_if(people.begin(), people.end(),
                                        [wanted = id](const auto& p) { return p.id == wanted; });
        const auto head = known == people.end() ? std::nullopt : known->head;
        const bool has_own_head =
            known != people.end() && known->own_head && known->expression.has_value();
        if (head == person->room_from_head && has_own_head == person->has_own_head)
            continue;
        person->room_from_head = head;
        person->has_own_head = has_own_head;
        if (!head)
            continue;
        const Pose place = room_from_person(*head);
        // The cut's frame has y down and z forward.
        constexpr Quat turned{0, 1, 0, 0};
        render::CloudCut cut = render::other_person(place * Pose{turned, {}});
        if (has_own_head)
            cut.remove = render::head_of(*head * Pose{turned, {}});
        for (const auto& [number, camera] : person->cameras) {
            Calibration calibration = camera.person_from_camera;
            calibration.room_from_camera = place * calibration.room_from_camera;
            person->clouds.set_camera(number, calibration);
            person->clouds.set_cut(number, cut);
        }
    }
}

bool PersonClouds::is_seen(const Person& person) {
    return std::any_of(person.cameras.begin(), person.cameras.end(), [](const auto& camera) {
        return camera.second.is_live && camera.second.newest != nullptr;
    });
}

std::set<ParticipantId> PersonClouds::seen() const {
    std::set<ParticipantId> seen;
    for (const auto& [id, person] : people_)
        if (is_seen(*person))
            seen.insert(id);
    return seen;
}

void PersonClouds::add_to(std::vector<render::DrawnClouds>& clouds, const std::string& renderer) {
    for (const auto& [id, person] : people_) {
        if (!person->room_from_head || !is_seen(*person))
            continue;
        const bool blends = person->cameras.size() > 1;
        clouds.push_back({&person->clouds, renderer == "blend" && !blends ? "mesh" : renderer});
    }
}

}  // namespace theatron::viewer
