// SPDX-License-Identifier: Apache-2.0
#include "viewer/live_scene.h"

#include <algorithm>
#include <utility>

#include "base/camera_names.h"
#include "base/error.h"
#include "client/participant_figures.h"
#include "phrases/phrase.h"
#include "room/facing.h"
#include "session/room_object.h"
#include "session/whose_camera.h"
#include "viewer/age_text.h"
#include "viewer/first_met.h"
#include "viewer/looking_back.h"
#include "viewer/still_cover.h"
#include "window/font.h"
#include "wire/condition_text.h"

namespace theatron::viewer {
namespace {

// Presence of a stale camera, and the time of a fade from 1 to 0.
constexpr double stale_presence = 0.3;
constexpr double fading_seconds = 0.5;
// Below the camera's name.
constexpr double age_below_m = 0.21, age_height_m = 0.045, letter_width = 0.8;
constexpr Duration judge_every = std::chrono::milliseconds(200);

LiveScene::Origin origin_of(const client::Participant::Camera& camera) {
    return {camera.description.session, camera.description.name};
}

bool is_face(const client::Participant::Camera& camera) {
    return camera.description.kind == wire::CameraKind::face;
}

// The person whom the camera sees and moves with, if it is no camera of the room. In a replay the
// host's cameras see people of the recording.
std::optional<ParticipantId> person_of(const client::Participant::Camera& camera) {
    if (camera.description.kind == wire::CameraKind::person)
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
        captions_changed_ |= follow_screens();
        generation_ = generation;
    }
    if (generation_ > 0)
        update_room(cameras);
    std::vector<CameraId> updated;
    for (const auto& frame : participant.take_frames())
        // A frame of a size that the calibration does not know cannot be shown.
        if (faces_.has(frame->camera)) {
            faces_.take(*frame, participant.now());
            updated.push_back(frame->camera);
        } else if (screens_.has(frame->camera)) {
            screens_.take(*frame);
            updated.push_back(frame->camera);
        } else if (person_clouds_.has(frame->camera)) {
            if (person_clouds_.upload(frame) == Status::ok)
                updated.push_back(frame->camera);
        } else {
            same_moment_.add(frame, participant.now());
        }
    for (const auto& frame : same_moment_.take(participant.now()))
        if (upload(*frame) == Status::ok) {
            newest_[frame->camera] = frame;
            updated.push_back(frame->camera);
        }
    leave_out_other_moments(participant);
    note_screens(participant);
    captions_changed_ |= faces_.note(participant.now());
    return updated;
}

// Pictures of two moments in one cloud would show what never was.
void LiveScene::leave_out_other_moments(const client::Participant& participant) {
    const std::set<CameraId> before =
        std::exchange(left_out_, of_another_moment(newest_, participant.past_cameras()));
    if (before == left_out_)
        return;
    for (const auto& [id, calibration] : calibrations_)
        clouds_.set_presence(id, presence_of(id));
}

std::optional<TimePoint> LiveScene::past_moment() const {
    std::optional<TimePoint> oldest;
    for (const auto& [id, frame] : newest_)
        if (frame->past && !left_out_.contains(id))
            oldest = std::min(oldest.value_or(frame->times.captured), frame->times.captured);
    return oldest;
}

double LiveScene::presence_of(CameraId camera) const {
    const auto known = presence_.find(camera);
    return left_out_.contains(camera) ? 0 : known == presence_.end() ? 1 : known->second;
}

void LiveScene::note_screens(const client::Participant& participant) {
    const TimePoint now = participant.now();
    if (screens_.empty() || now - screens_noted_at_ < judge_every)
        return;
    screens_noted_at_ = now;
    captions_changed_ |= screens_.note(client::figures_of(participant).cameras, now);
}

bool LiveScene::take_meeting(const client::Participant& participant) {
    meeting_.set_clouds(person_clouds_.seen());
    meeting_.set_cloud_skins(person_clouds_.skins());
    meeting_.show_moment(past_moment());
    const bool changed = meeting_.take(participant);
    if (changed) {
        person_clouds_.place(meeting_.people());
        (void)follow_screens();
    }
    return changed;
}

bool LiveScene::follow_screens() {
    return screens_.follow(meeting_.room().objects, meeting_.room().self);
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
            screens_.remove_camera(id);
            captions_changed_ |= faces_.has(id);
            faces_.remove_camera(id);
            origins_.erase(id);
            presence_.erase(id);
            left_out_.erase(id);
            newest_.erase(id);
            same_moment_.remove(id);
        }
    for (const auto& camera : cameras) {
        const CameraId id = camera.description.id;
        if (is_face(camera)) {
            origins_[id] = origin_of(camera);
            if (is_screen(camera.calibration))
                faces_.set_camera(camera.description.publisher, id, camera.calibration);
            continue;
        }
        if (const auto person = person_of(camera)) {
            origins_[id] = origin_of(camera);
            person_clouds_.set_camera(*person, id, camera.calibration);
            continue;
        }
        if (is_screen(camera.calibration)) {
            origins_[id] = origin_of(camera);
            screens_.set_camera(id, camera.description.name, camera.calibration);
            continue;
        }
        const auto known = calibrations_.find(id);
        const bool is_new = known == calibrations_.end();
        // No more can be drawn; the first ones stay.
        if (is_new && calibrations_.size() == std::size_t(render::max_set_cameras))
            continue;
        if (!is_new && known->second == camera.calibration)
            continue;
        const bool same_lens = !is_new && known->second.depth == camera.calibration.depth &&
                               known->second.color == camera.calibration.color;
        if (!same_lens) {
            newest_.erase(id);
            same_moment_.remove(id);
        }
        clouds_.set_camera(id, camera.calibration);
        made_cameras_ = made_cameras_ || !same_lens;
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
    person_at_.clear();
    for (std::size_t i = 0; i < people_.size(); ++i) {
        try {
            const CameraId id = cameras[find_camera(people_[i].camera, names)].description.id;
            clouds_.set_cut(id, people_[i].cut());
            person_at_[id] = i;
        } catch (const Error&) {
            if (generation_ == 0)
                throw;
        }
    }
}

std::vector<std::string> LiveScene::unseen_people() const {
    std::vector<std::string> sentences;
    for (const auto& [id, person] : person_at_) {
        const auto frame = newest_.find(id);
        const auto known = calibrations_.find(id);
        if (frame == newest_.end() || known == calibrations_.end())
            continue;
        std::string text =
            nothing_seen(people_[person], known->second, frame->second->depth.view());
        if (!text.empty())
            sentences.push_back(std::move(text));
    }
    return sentences;
}

void LiveScene::update_room(const std::vector<client::Participant::Camera>& cameras) {
    std::vector<room::RoomCamera> marks;
    for (const auto& camera : cameras) {
        if (person_of(camera) || is_screen(camera.calibration) || is_face(camera))
            continue;
        std::string label = session::whose_camera(camera.description, meeting_.room().objects);
        if (camera.state.condition != wire::CameraCondition::live)
            label += std::string(" (") + text_of(camera.state.condition) + ")";
        marks.push_back({std::move(label), camera.calibration});
    }
    room_.set_cameras(marks);
}

std::vector<CloudCamera> LiveScene::cloud() const {
    std::vector<CloudCamera> cameras;
    for (const auto& [id, frame] : newest_)
        if (const auto known = calibrations_.find(id);
            !real_room_ && known != calibrations_.end() && !left_out_.contains(id))
            cameras.push_back({std::uint32_t(id), &known->second, frame->depth.view()});
    return cameras;
}

std::optional<double> LiveScene::pick_surface(const render::PickRay& ray) const {
    const auto point = pick_cloud(cloud(), ray);
    return point ? std::optional(point->distance_m) : std::nullopt;
}

std::vector<ColoredPoint> LiveScene::points() const {
    std::vector<ColoredPoint> all;
    for (const auto& [id, frame] : newest_) {
        const auto known = calibrations_.find(id);
        if (known == calibrations_.end() || left_out_.contains(id) ||
            frame->depth.size != known->second.depth.size)
            continue;
        Calibration calibration = known->second;
        const ColorView color = frame->color ? frame->color->view() : ColorView{};
        calibration.color = scaled(calibration.color, color.size);
        std::vector<ColoredPoint> points;
        append_points(frame->depth.view(), make_ray_table(calibration.depth), color, calibration,
                      points);
        transform_points(calibration.room_from_camera, points);
        all.insert(all.end(), points.begin(), points.end());
    }
    return all;
}

// Others point at the present: what their rays meet is not in a picture of the past.
void LiveScene::add_pointers() {
    const bool is_present = !past_moment();
    for (const room::RoomPerson& person : meeting_.people())
        if (is_present && person.points && !person.is_stale) {
            const render::PickRay ray = grip_of_hand(*person.right_hand).ray;
            pointers_.push_back({person.id, person.name, ray.from, ray.direction, std::nullopt});
        }
    pointers_.insert(pointers_.end(), own_pointers_.begin(), own_pointers_.end());
    if (pointers_.empty())
        return;
    const std::vector<CloudCamera> cameras = cloud();
    for (room::Pointer& pointer : pointers_) {
        pointer.twin.reset();
        const auto met = first_met(frame_, cameras, {pointer.from, pointer.direction});
        if (!met)
            continue;
        pointer.reach_m = met->distance_m;
        if (met->object)
            pointer.twin = meeting_.case_scene().twin_place(
                session::ObjectId(std::uint32_t(*met->object)), met->place);
    }
    if (!drawn_pointers_)
        drawn_pointers_ = std::make_unique<room::Pointers>();
    drawn_pointers_->add_to(frame_, pointers_);
}

void LiveScene::add_headset_text(const render::CameraView& view) {
    if (headset_text_.empty())
        return;
    constexpr double ahead_m = 1, below_m = 0.25, height_m = 0.016;
    const double half_width = 0.5 * height_m * letter_width * double(headset_text_.size());
    // The eye's frame is that of texts.
    frame_.texts.push_back({headset_text_,
                            view.room_from_eye * Pose{{}, {-half_width, below_m, ahead_m}},
                            height_m,
                            {255, 220, 150}});
}

// Nearer than the clouds, so that none hides it.
void LiveScene::add_cover(const render::CameraView& view) {
    if (!shows_cover_ || cover_.empty() || real_room_)
        return;
    constexpr double ahead_m = 0.5, width_m = 0.5, plate_height_m = 0.1, letters_m = 0.03;
    constexpr double before_m = 0.002;
    if (!plate_)
        plate_ =
            std::make_unique<render::SceneMesh>(render::make_panel_mesh(width_m, plate_height_m));
    render::SurfaceLook look{{0.02, 0.02, 0.02}, 0, 0.6};
    look.unlit = true;
    render::SceneObject plate{plate_.get(), view.room_from_eye * Pose{{}, {0, 0, ahead_m}}, look};
    plate.casts_shadow = false;
    frame_.objects.push_back(plate);
    const double half_width = 0.5 * letters_m * letter_width * double(cover_.size());
    frame_.texts.push_back(
        {cover_,
         view.room_from_eye * Pose{{}, {-half_width, letters_m / 2, ahead_m - before_m}},
         letters_m,
         {255, 190, 70}});
}

// As large as the virtual room's table (furniture/table.cpp), with a mark at the patient's head.
void LiveScene::add_table_outline() {
    constexpr double half_length_m = 1, half_width_m = 0.26, height_m = 0.9;
    if (!table_)
        table_ =
            std::make_unique<render::SceneMesh>(render::make_box_mesh({-1, -1, -1}, {1, 1, 1}));
    render::SurfaceLook look{{0.1, 0.55, 0.75}, 0, 0.6, 0.45};
    look.unlit = true;
    const auto add = [&](Vec3 middle, double scale) {
        render::SceneObject object{table_.get(), {{}, middle}, look};
        object.scale = scale;
        object.casts_shadow = false;
        frame_.objects.push_back(object);
    };
    constexpr double dot_m = 0.02, dots_apart_m = 0.2, head_m = 0.07;
    const int last = int((2 * half_length_m + dot_m) / dots_apart_m);
    for (const double z : {-half_width_m, half_width_m})
        for (int i = 0; i <= last; ++i)
            add({i * dots_apart_m - half_length_m, height_m, z}, dot_m);
    add({-half_length_m + head_m, height_m, 0}, head_m);
}

const std::vector<room::Pointer>& LiveScene::pointers(const render::CameraView& view) {
    (void)scene_for(view);
    return pointers_;
}

const render::SceneFrame* LiveScene::scene_for(const render::CameraView& view) {
    frame_.objects.clear();
    frame_.texts.clear();
    frame_.lines.clear();
    frame_.labels.clear();
    pointers_.clear();
    if (choice_.in_steps && !passes_)
        return nullptr;
    if (choice_.shown) {
        if (!passes_)
            frame_.quality = choice_.quality.value_or(render::usual_quality());
        if (!choice_.in_steps)
            room_.build(frame_.quality);
        if (!real_room_)
            room_.add_to(frame_, view);
        meeting_.set_faces(faces_.pictures());
        meeting_.add_to(frame_, view);
        add_pointers();
        for (const Plate* plate : plates_)
            plate->add_to(frame_);
        if (shows_table_)
            add_table_outline();
        if (!real_room_)
            add_ages(view);
        if (!choice_.has_texts) {
            frame_.texts.clear();
            frame_.labels.clear();
        }
        add_headset_text(view);
    }
    add_cover(view);
    if (frame_.empty())
        return nullptr;
    if (!passes_)
        make_passes();
    return &frame_;
}

void LiveScene::make_passes() {
    const render::FontAtlas atlas = render::load_font_atlas(window::text_font());
    passes_ = std::make_unique<render::ScenePasses>(&atlas);
}

bool LiveScene::prepare(bool gpu_is_idle) {
    if (!choice_.in_steps || !choice_.shown)
        return false;
    if (passes_)
        return room_.build_step(frame_.quality);
    if (!begun_programs_) {
        frame_.quality = choice_.quality.value_or(render::usual_quality());
        begun_programs_ = std::make_unique<render::BegunScenePrograms>(frame_.quality);
    }
    // Questions to the driver wait for all that it does. In a headset it is never seen idle.
    constexpr int busy_patience = 60;
    if ((!gpu_is_idle && ++busy_steps_ < busy_patience) || !begun_programs_->are_ready())
        return false;
    make_passes();
    return true;
}

void LiveScene::draw(const render::CameraView& view, const render::DrawTarget& target,
                     const std::string& renderer) {
    draw(view, {{view, target}}, renderer);
}

void LiveScene::draw(const render::CameraView& head, std::vector<render::EyePicture> eyes,
                     const std::string& renderer) {
    const render::SceneFrame* scene = scene_for(head);
    render::draw({scene, clouds(renderer), std::move(eyes)}, passes_.get());
}

render::Picture LiveScene::render(const std::vector<render::CameraView>& eyes, Size size,
                                  const std::string& renderer, bool with_room) {
    const render::SceneFrame* scene = with_room ? scene_for(eyes.front()) : nullptr;
    return render::draw_and_read(scene, clouds(renderer), eyes, size, passes_.get());
}

std::vector<render::DrawnClouds> LiveScene::clouds(const std::string& renderer) {
    std::vector<render::DrawnClouds> clouds;
    if (!real_room_)
        clouds.push_back({&clouds_, renderer});
    person_clouds_.add_to(clouds, renderer);
    for (const render::DrawnClouds& drawn : clouds)
        drawn.set->set_point_size(point_size_);
    return clouds;
}

void LiveScene::set_ages_shown(bool shown) {
    shows_ages_ = shown;
    meeting_.set_ages_shown(shown);
}

bool LiveScene::shows_present(CameraId camera) const {
    const auto live = live_.find(camera);
    const auto frame = newest_.find(camera);
    return (live == live_.end() || live->second) &&
           (frame == newest_.end() || !frame->second->past);
}

// True if a warning is another one than before. Other ages are drawn with the next picture.
bool LiveScene::note_ages(const client::Participant& participant) {
    const auto before = std::exchange(ages_, {});
    bool changed = false;
    if (participant.status().clock_known)
        for (const auto& [id, frame] : newest_) {
            const bool is_live = shows_present(id) && !left_out_.contains(id);
            const double ms = to_ms(participant.now() - frame->times.captured);
            if (is_live && (!shows_ages_ || ms < least_told_ms))
                continue;
            const auto known = before.find(id);
            std::string age = left_out_.contains(id)
                                  ? say(Phrase::not_drawn_age, age_text(std::max(ms, 0.0)))
                                  : seen_age(ms, is_live);
            changed = changed || (!is_live && (known == before.end() || known->second != age));
            ages_.emplace(id, std::move(age));
        }
    return changed;
}

// Below the cameras' names.
void LiveScene::add_ages(const render::CameraView& view) {
    const Vec3 eye = view.room_from_eye.translation;
    for (const auto& [id, age] : ages_) {
        const auto camera = calibrations_.find(id);
        if (camera == calibrations_.end() || !camera->second.registered)
            continue;
        const Vec3 lens = camera->second.room_from_camera.translation;
        if (length(lens - eye) < room::camera_label_from_m)
            continue;
        const bool is_live = shows_present(id) && !left_out_.contains(id);
        Pose place = room::facing(lens - Vec3{0, age_below_m, 0}, eye);
        place.translation =
            place * Vec3{-0.5 * age_height_m * letter_width * double(age.size()), 0, 0};
        frame_.texts.push_back(
            {age, place, age_height_m, is_live ? Rgb{175, 186, 196} : Rgb{255, 190, 70}});
    }
}

bool LiveScene::fade(const client::Participant& participant, TimePoint now) {
    const double step = to_seconds(now - faded_at_) / fading_seconds;
    faded_at_ = now;
    // Also while no frames are taken.
    bool changed = faces_.note(participant.now());
    changed = std::exchange(captions_changed_, false) || changed;
    if (now - judged_at_ >= judge_every) {
        judged_at_ = now;
        live_.clear();
        const client::ParticipantFigures figures = client::figures_of(participant);
        for (const client::CameraFigures& one : figures.cameras)
            live_[one.camera.description.id] =
                one.camera.state.condition == wire::CameraCondition::live &&
                !stands_still(shown_camera(one, now), now);
        still_ = past_moment() ? std::nullopt : all_still(shown_cameras(figures.cameras, now), now);
        changed = std::exchange(cover_, still_text(still_)) != cover_ || changed;
        changed = note_ages(participant) || changed;
    }
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
        clouds_.set_presence(id, presence_of(id));
        changed = true;
    }
    return changed;
}

}  // namespace theatron::viewer
