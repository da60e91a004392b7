// SPDX-License-Identifier: Apache-2.0
#include "viewer/live_scene.h"

#include <algorithm>
#include <utility>

#include "base/camera_names.h"
#include "base/error.h"
#include "client/participant_figures.h"
#include "session/room_object.h"
#include "wire/condition_text.h"
#include "xr/font.h"

namespace theatron::viewer {
namespace {

// Presence of a stale camera, and the time of a fade from 1 to 0.
constexpr double stale_presence = 0.3;
constexpr double fading_seconds = 0.5;
constexpr Duration judge_every = std::chrono::milliseconds(200);

LiveScene::Origin origin_of(const client::Participant::Camera& camera) {
    return {camera.description.session, camera.description.name};
}

// The person whom the camera sees and moves with, if it is no camera of the room. In a replay the
// host's cameras see people of the recording.
std::optional<ParticipantId> person_of(const client::Participant::Camera& camera) {
    if (camera.description.frame == wire::CameraFrame::person)
        return camera.description.publisher;
    if (camera.calibration.person != 0)
        return ParticipantId(camera.calibration.person | session::recorded_bit);
    return std::nullopt;
}

}  // namespace

std::vector<CameraId> LiveScene::take(client::Participant& participant) {
    std::uint64_t generation = 0;
    const auto cameras = participant.cameras(generation);
    if (generation != generation_) {
        take_cameras(cameras);
        cut_people(cameras);
        generation_ = generation;
    }
    if (generation_ > 0)
        update_room(cameras);
    std::vector<CameraId> updated;
    for (const auto& frame : participant.take_frames())
        // A frame of a size that the calibration does not know cannot be shown.
        if (person_clouds_.has(frame->camera)) {
            if (person_clouds_.upload(frame) == Status::ok)
                updated.push_back(frame->camera);
        } else if (upload(*frame) == Status::ok) {
            newest_[frame->camera] = frame;
            updated.push_back(frame->camera);
        }
    return updated;
}

bool LiveScene::take_meeting(const client::Participant& participant) {
    meeting_.set_clouds(person_clouds_.seen());
    const bool changed = meeting_.take(participant);
    if (changed)
        person_clouds_.place(meeting_.people());
    return changed;
}

// Applies cameras that left, joined or have a new calibration; the others keep their pictures. A
// camera of another session is another camera, even if it has the same number.
void LiveScene::take_cameras(const std::vector<client::Participant::Camera>& cameras) {
    const auto announced = [&](CameraId id) {
        return std::find_if(cameras.begin(), cameras.end(),
                            [&](const auto& camera) { return camera.description.id == id; });
    };
    const auto shown = origins_;
    for (const auto& [id, origin] : shown)
        if (const auto camera = announced(id);
            camera == cameras.end() || origin_of(*camera) != origin) {
            if (calibrations_.erase(id) > 0)
                clouds_.remove_camera(id);
            person_clouds_.remove_camera(id);
            origins_.erase(id);
            presence_.erase(id);
            newest_.erase(id);
        }
    for (const auto& camera : cameras) {
        const CameraId id = camera.description.id;
        if (const auto person = person_of(camera)) {
            origins_[id] = origin_of(camera);
            person_clouds_.set_camera(*person, id, camera.calibration);
            continue;
        }
        const auto known = calibrations_.find(id);
        const bool is_new = known == calibrations_.end();
        // No more can be drawn; the first ones stay.
        if (is_new && calibrations_.size() == std::size_t(render::max_cameras))
            continue;
        if (!is_new && known->second == camera.calibration)
            continue;
        const bool same_lens = !is_new && known->second.depth == camera.calibration.depth &&
                               known->second.color == camera.calibration.color;
        if (!same_lens)
            newest_.erase(id);
        clouds_.set_camera(id, camera.calibration);
        calibrations_[id] = camera.calibration;
        origins_[id] = origin_of(camera);
    }
}

Status LiveScene::upload(const receive::CameraFrame& frame) {
    return clouds_.upload(frame.camera, frame.depth.view(),
                          frame.color ? frame.color->view() : ColorView{});
}

void LiveScene::set_depth_step(int step) {
    person_clouds_.set_depth_step(step);
    if (!clouds_.set_depth_step(step))
        return;
    for (const auto& [camera, frame] : newest_)
        (void)upload(*frame);
}

// Heads stay at the places of the options. A host that returns with other cameras is no error.
void LiveScene::cut_people(const std::vector<client::Participant::Camera>& cameras) {
    std::vector<std::string> names;
    for (const auto& camera : cameras)
        names.push_back(camera.description.name);
    for (const SeenPerson& person : people_) {
        try {
            const std::size_t number = find_camera(person.camera, names);
            clouds_.set_cut(cameras[number].description.id, person.cut());
        } catch (const Error&) {
            if (generation_ == 0)
                throw;
        }
    }
}

void LiveScene::update_room(const std::vector<client::Participant::Camera>& cameras) {
    std::vector<room::RoomCamera> marks;
    for (const auto& camera : cameras) {
        if (person_of(camera))
            continue;
        std::string label = camera.description.name;
        if (camera.state.condition != wire::CameraCondition::live)
            label += std::string(" (") + text_of(camera.state.condition) + ")";
        marks.push_back({std::move(label), camera.calibration});
    }
    room_.set_cameras(marks);
}

std::vector<CloudCamera> LiveScene::cloud() const {
    std::vector<CloudCamera> cameras;
    for (const auto& [id, frame] : newest_)
        if (const auto known = calibrations_.find(id); known != calibrations_.end())
            cameras.push_back({std::uint32_t(id), &known->second, frame->depth.view()});
    return cameras;
}

void LiveScene::add_pointers(const render::CameraView& view) {
    std::vector<room::Pointer> pointers;
    for (const room::RoomPerson& person : meeting_.people())
        if (person.points && !person.is_stale)
            pointers.push_back({person.id, person.name, person.right_hand->translation,
                                rotate(person.right_hand->rotation, {0, 0, -1}), std::nullopt});
    if (own_pointer_)
        pointers.push_back(*own_pointer_);
    if (pointers.empty())
        return;
    const std::vector<CloudCamera> cameras = cloud();
    for (room::Pointer& pointer : pointers) {
        const render::PickRay ray{pointer.from, pointer.direction};
        if (const auto picked = render::pick(frame_, ray))
            pointer.reach_m = picked->distance_m;
        if (const auto point = pick_cloud(cameras, ray);
            point && point->distance_m < pointer.reach_m.value_or(farthest_pick_m))
            pointer.reach_m = point->distance_m;
    }
    if (!pointers_)
        pointers_ = std::make_unique<room::Pointers>();
    pointers_->add_to(frame_, pointers, view);
}

const render::SceneFrame* LiveScene::scene_for(const render::CameraView& view) {
    frame_.objects.clear();
    frame_.texts.clear();
    if (choice_.shown) {
        if (!passes_)
            frame_.quality = choice_.quality.value_or(render::usual_quality());
        room_.add_to(frame_, view);
        meeting_.add_to(frame_, view);
        add_pointers(view);
    }
    if (frame_.empty())
        return nullptr;
    if (!passes_) {
        const render::FontAtlas atlas = render::load_font_atlas(xr::text_font());
        passes_ = std::make_unique<render::ScenePasses>(&atlas);
    }
    return &frame_;
}

void LiveScene::draw(const render::CameraView& view, const render::DrawTarget& target,
                     const std::string& renderer) {
    const render::SceneFrame* scene = scene_for(view);
    render::draw({scene, clouds(renderer), {{view, target}}}, passes_.get());
}

render::Picture LiveScene::render(const std::vector<render::CameraView>& eyes, Size size,
                                  const std::string& renderer, bool with_room) {
    const render::SceneFrame* scene = with_room ? scene_for(eyes.front()) : nullptr;
    return render::draw_and_read(scene, clouds(renderer), eyes, size, passes_.get());
}

std::vector<render::DrawnClouds> LiveScene::clouds(const std::string& renderer) {
    std::vector<render::DrawnClouds> clouds{{&clouds_, renderer}};
    person_clouds_.add_to(clouds, renderer);
    return clouds;
}

bool LiveScene::fade(const client::Participant& participant, TimePoint now) {
    const double step = to_seconds(now - faded_at_) / fading_seconds;
    faded_at_ = now;
    if (now - judged_at_ >= judge_every) {
        judged_at_ = now;
        live_.clear();
        for (const auto& one : client::figures_of(participant).cameras)
            live_[one.camera.description.id] =
                one.camera.state.condition == wire::CameraCondition::live;
    }
    bool changed = false;
    for (const auto& [id, live] : live_) {
        if (person_clouds_.has(id))
            person_clouds_.set_live(id, live);
        if (calibrations_.count(id) == 0)
            continue;
        const double wanted = live ? 1 : stale_presence;
        double& presence = presence_.emplace(id, 1).first->second;
        if (presence == wanted)
            continue;
        presence = live ? std::min(wanted, presence + step) : std::max(wanted, presence - step);
        clouds_.set_presence(id, presence);
        changed = true;
    }
    return changed;
}

}  // namespace theatron::viewer
