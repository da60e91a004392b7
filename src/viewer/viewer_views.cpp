// SPDX-License-Identifier: Apache-2.0
// Views of the person at the window besides the clouds: plain pictures, and the place under the
// mouse.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "phrases/phrase.h"
#include "viewer/age_text.h"
#include "viewer/viewer.h"
#include "wire/manage_text.h"

namespace theatron::viewer {
namespace {

// Widths of the plain pictures, in pixels.
constexpr int small_width = 320, large_width = 1280;
constexpr int legend_colors = 32;

std::string meters(double m, int digits = 2) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.*f m", digits, m);
    return decimal(text);
}

std::vector<Rgb> depth_legend() {
    std::vector<Rgb> colors;
    for (int i = 0; i < legend_colors; ++i)
        colors.push_back(depth_color(i / double(legend_colors - 1)));
    return colors;
}

// "x 0.12  y 0.93  z -1.40 m": of one width as long as the signs stay.
std::string place_text(Vec3 place) {
    char text[96];
    std::snprintf(text, sizeof(text), "x %.2f  y %.2f  z %.2f m", place.x, place.y, place.z);
    return decimal(text);
}

}  // namespace

void Viewer::go_home(const window::KeyPress& key, Size picture, TimePoint now) {
    stop_following();
    if (const auto place = meeting_place(); place && eye_.is_placed()) {
        eye_.go_to(at_eye_height(*place));
        scene_changed_ = true;
        return;
    }
    ViewChoice choice{eye_.home().camera, 0, 0};
    if (key.action == window::Action::view_camera)
        choice.camera = CameraId(key.camera);
    try {
        eye_.go_home(choice, cameras(), picture);
        scene_changed_ = true;
        note(say(Phrase::view_of, camera_text(choice.camera)), now);
    } catch (const Error& e) {
        note(e.what(), now);
    }
}

void Viewer::prepare(bool gpu_is_idle) {
    constexpr unsigned calls_while_resting = 3;
    if (rest_.step() == 0 || ++preparations_ % calls_while_resting == 0)
        scene_changed_ = scene_.prepare(gpu_is_idle) || scene_changed_;
}

void Viewer::view_from_above(TimePoint now) {
    auto place = from_above(cameras());
    if (!place || !eye_.is_placed())
        return note(say(Phrase::nothing_from_above), now);
    stop_following();
    if (const auto& space = scene_.free_space())  // below the ceiling
        place->translation = room::kept_inside(*space, place->translation);
    // Without the lamps, which hang above the heads.
    constexpr double seen_below_m = 1.95, least_m = 0.05;
    eye_.go_to(*place, std::max(place->translation.y - seen_below_m, least_m));
    scene_changed_ = true;
    note(say(Phrase::from_above), now);
}

void Viewer::change_point_size(double factor, TimePoint now) {
    constexpr double smallest = 0.25, largest = 4;
    point_size_ = std::clamp(point_size_ * factor, smallest, largest);
    scene_.set_point_size(point_size_);
    scene_changed_ = true;
    const bool has_points = way().renderer == "splat" || way().renderer == "disc";
    char text[48];
    std::snprintf(text, sizeof(text), "%.2f", point_size_);
    note(say(has_points ? Phrase::point_size : Phrase::point_size_unused, decimal(text),
             way().renderer),
         now);
}

void Viewer::freeze(TimePoint now) {
    frozen_ = !frozen_;
    if (!frozen_)
        note(say(participant_.looks_back() ? Phrase::goes_on : Phrase::live_again), now);
}

bool Viewer::may(session::Right right) const {
    return session::may(participant_.status().standing.role, right);
}

void Viewer::slide(double value) {
    if (slides_playback_)
        playing_.slide(value);
    else
        adjusting_.slide(value);
}

// The recording that a host plays is moved for all; without one a person looks back alone. False:
// the key is not meant so.
bool Viewer::look_back(const window::KeyPress& key, TimePoint now) {
    const bool is_looking = participant_.looks_back();
    const bool moves =
        key.action == window::Action::seek_back || key.action == window::Action::seek_forward;
    if (key.action == window::Action::live && is_looking)
        look_back(Duration(0), now);
    else if (!moves || (!is_looking && participant_.playback()))
        return key.action == window::Action::live;
    else if (key.action == window::Action::seek_back)
        look_back(looking_back_.further(participant_, now), now);
    else if (is_looking)
        look_back(looking_back_.nearer(participant_, now), now);
    return true;
}

void Viewer::look_back(Duration ago, TimePoint now) {
    if (!looking_back_.go(ago, participant_, now))
        note(wire::text_of(wire::ManageRefusal::nothing_kept), now);
}

// Looking back, a person changes nothing of the present by what is shown of the past.
void Viewer::keep_present(window::WindowInput& input, TimePoint now) {
    tools_.choose(ToolKind::none, scene_.meeting());
    const std::size_t count = input.keys.size();
    const auto last =
        std::remove_if(input.keys.begin(), input.keys.end(), [](const window::KeyPress& key) {
            return key.action == window::Action::new_brick || key.action == window::Action::give ||
                   key.action == window::Action::remove || key.action == window::Action::marks ||
                   key.action == window::Action::undo_mark ||
                   key.action == window::Action::slice_here;
        });
    input.keys.erase(last, input.keys.end());
    if (input.points || input.keys.size() < count)
        note(say(Phrase::changes_nothing), now);
    input.points = false;
}

std::string Viewer::past(TimePoint now) const {
    const std::set<CameraId> looking = participant_.past_cameras();
    const auto& shown = scene_.newest();
    if (looking.empty() && std::none_of(shown.begin(), shown.end(),
                                        [](const auto& entry) { return entry.second->past; }))
        return "";
    std::map<CameraId, std::string> names;
    std::uint64_t generation = 0;
    for (const auto& camera : participant_.cameras(generation))
        names[camera.description.id] = name_of(camera);
    return past_text(shown, looking, names, participant_.session_time(now));
}

// While this person looks back, it is past() that says what is shown.
std::string Viewer::played(TimePoint now) const {
    const auto playback = participant_.looks_back() ? std::nullopt : participant_.playback();
    return playback ? playback_text(*playback, participant_.session_time(now)) : "";
}

ShownMoment Viewer::shown_moment(TimePoint now) const {
    const client::ParticipantFigures figures = client::figures_of(participant_);
    std::set<CameraId> stale;
    for (const client::CameraFigures& one : figures.cameras)
        if (one.camera.state.condition != wire::CameraCondition::live)
            stale.insert(one.camera.description.id);
    ShownMoment moment;
    // Without the session's clock no age is known.
    if (figures.status.clock_known)
        moment = viewer::shown_moment(scene_.newest(), stale, participant_.session_time(now));
    moment.is_live = moment.is_live && !frozen_;
    moment.is_recording = participant_.playback().has_value();
    return moment;
}

void Viewer::on_camera_key(const window::KeyPress& key, Size picture, TimePoint now) {
    if (look_back(key, now))
        return;
    if (key.action == window::Action::pause_recording)
        on(PlayStep{PlayStep::What::toggle}, now);
    else if (key.action == window::Action::seek_back)
        on(PlayStep{PlayStep::What::back}, now);
    else if (key.action == window::Action::seek_forward)
        on(PlayStep{PlayStep::What::forward}, now);
    else
        adjust_cameras(key, picture, now);
}

// Sends what the person wants of the cameras.
void Viewer::follow_cameras(TimePoint now) {
    if (adjusting_.is_shown()) {
        std::uint64_t generation = 0;
        auto cameras = participant_.cameras(generation);
        for (auto& camera : cameras)
            camera.description.name = name_of(camera);
        adjusting_.take(cameras);
        adjusting_.show(may(session::Right::adjust));
    }
    adjusting_.on_tick(participant_, now);
    playing_.on_tick(participant_, now);
}

void Viewer::note_unseen_people(TimePoint now) {
    // Cameras send their first pictures one after another.
    constexpr Duration patience = std::chrono::seconds(2);
    if (has_checked_people_ || first_picture_at_ == TimePoint{} ||
        now - first_picture_at_ < patience)
        return;
    has_checked_people_ = true;
    for (const std::string& text : scene_.unseen_people())
        note(text, now);
}

void Viewer::adjust_cameras(const window::KeyPress& key, Size picture, TimePoint now) {
    if (key.action == window::Action::nudge) {
        if (!adjusting_.is_shown() || !eye_.is_placed())
            return;
        const Vec3 forward = rotate(eye_.view(picture).room_from_eye.rotation, {0, 0, 1});
        return adjusting_.nudge(key.nudge, std::atan2(-forward.x, -forward.z));
    }
    if (!adjusting_.is_shown() && !may(session::Right::adjust))
        return note(wire::text_of(wire::ManageRefusal::adjusting_role), now);
    adjusting_.show(!adjusting_.is_shown());
    // The eye no longer follows the camera whose view it has, so that one sees it move.
    if (adjusting_.is_shown() && eye_.is_placed())
        eye_.go_to(eye_.view(picture).room_from_eye);
}

void Viewer::draw_region(window::WindowInput& input, Size picture, TimePoint now) {
    if (!adjusting_.is_shown() || !eye_.is_placed())
        return;
    if (const std::string text = adjusting_.draw(input, eye_.view(picture), scene_.cloud());
        !text.empty())
        note(text, now);
}

// A headset needs each picture, and the first ones come as soon as they can.
bool Viewer::rests_at(TimePoint now) const {
    constexpr Duration beginning = std::chrono::seconds(1);
    return !headset_ && first_picture_at_ != TimePoint{} && now - first_picture_at_ > beginning &&
           rest_.rests_until_later(now);
}

void Viewer::follow_receiving(TimePoint now) {
    constexpr Duration every = std::chrono::milliseconds(100);
    if (now - receiving_noted_ < every)
        return;
    receiving_noted_ = now;
    const client::ParticipantFigures figures = client::figures_of(participant_);
    const std::uint64_t before = std::exchange(dropped_, figures.dropped());
    double age_ms = 0;
    for (const client::CameraFigures& camera : figures.cameras)
        age_ms = std::max(age_ms, camera.depth.age_ms);
    const std::size_t step = rest_.step();
    rest_.observe({figures.status.delivery.level > 0 || dropped_ > before,
                   figures.live_frames_per_second(), age_ms},
                  now);
    // The host tries at once whether more comes through.
    if (rest_.step() > step)
        participant_.choose_delivery(figures.status.goal);
}

void Viewer::take_pictures(TimePoint now) {
    // The ages in the room go on.
    constexpr Duration frozen_drawn_every = std::chrono::milliseconds(500);
    if (!frozen_) {
        for (const CameraId camera : scene_.take(participant_)) {
            updated_.insert(camera);
            scene_changed_ = true;
        }
        choose_pace();  // for the cameras that there are now
    } else {
        (void)participant_.take_frames();  // the newest ones are there when the person goes on
        if (now - frozen_drawn_ >= frozen_drawn_every) {
            frozen_drawn_ = now;
            scene_changed_ = true;
        }
    }
    fading_ = scene_.fade(participant_, now);
    scene_changed_ = scene_changed_ || fading_;
}

ColorImage Viewer::picture(Size size) {
    return scene_.render({eye_.view(size)}, size, way().renderer, true).color;
}

void Viewer::add_camera_pictures(Facts& facts, RoomPanel& panel, TimePoint now) {
    if (!camera_pictures_)
        return;
    for (const auto& [camera, frame] : scene_.newest()) {
        const CameraId id = camera;  // a lambda cannot capture `camera` everywhere
        const auto known = scene_.calibrations().find(id);
        if (known == scene_.calibrations().end() || (large_ && large_->camera != id))
            continue;
        // Without the session's clock no age is known.
        std::optional<double> age_ms;
        if (facts.received.status.clock_known)
            age_ms = to_ms(participant_.session_time(now) - frame->times.captured);
        const bool is_live = scene_.shows_present(id) && !frozen_;
        const auto& pictures =
            camera_pictures_->of(id, frame->number, known->second, frame->depth.view(),
                                 frame->color, large_ ? large_width : small_width);
        const auto add = [&](PictureKind kind, Phrase name,
                             const std::shared_ptr<const ColorImage>& pixels) {
            const ShowLarge show{id, kind};
            if (!pixels || (large_ && *large_ != show))
                return;
            window::OverlayPicture picture{
                picture_title(camera_text(id) + ", " + say(name), age_ms, is_live),
                pixels,
                {},
                "",
                "",
                large_.has_value(),
                panel.add(show)};
            if (kind != PictureKind::color) {
                picture.legend = depth_legend();
                picture.legend_from = meters(pictures.range.near_m);
                picture.legend_to = meters(pictures.range.far_m);
            }
            facts.pictures.push_back(std::move(picture));
        };
        add(PictureKind::color, Phrase::color_picture, pictures.color);
        add(PictureKind::depth, Phrase::depth_picture, pictures.depth);
        add(PictureKind::blended, Phrase::blended_picture, pictures.blended);
    }
    if (facts.pictures.empty())
        large_.reset();  // the camera has left
}

std::string Viewer::pointed_text() {
    if (!mouse_ || !eye_.is_placed())
        return "";
    const render::CameraView view = eye_.view(picture_);
    const auto at =
        surface_at(render::ray_through(view, *mouse_), view, scene_.meeting(), scene_.cloud());
    if (!at)
        return say(Phrase::no_surface);
    if (!at->measured)
        return say(
            at->surface == session::MarkedSurface::slice ? Phrase::on_image : Phrase::on_organ,
            place_text(at->place));
    const auto camera = CameraId(at->measured->camera);
    const auto known = scene_.calibrations().find(camera);
    const bool is_registered = known != scene_.calibrations().end() && known->second.registered;
    return say(is_registered ? Phrase::from_camera : Phrase::from_unregistered,
               meters(length(at->measured->in_camera)), camera_text(camera), place_text(at->place));
}

}  // namespace theatron::viewer
