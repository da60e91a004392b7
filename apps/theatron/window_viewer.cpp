// SPDX-License-Identifier: Apache-2.0
#include "window_viewer.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "participant_json.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"
#include "viewer/renderer_text.h"

namespace theatron::app {
namespace {

constexpr Duration choice_shown = 2s, remark_shown = 5s;
constexpr Duration texts_every = 250ms;
// A camera that is to be looked from, but sends nothing, is waited for this long.
constexpr Duration camera_patience = 2s;

// The name after `current` in `names`; `current` may have options behind a colon.
std::string next_name(const std::vector<std::string>& names, const std::string& current) {
    const auto found = std::find(names.begin(), names.end(), current.substr(0, current.find(':')));
    const auto next = found == names.end() || found + 1 == names.end() ? names.begin() : found + 1;
    return *next;
}

}  // namespace

WindowViewer::WindowViewer(Options options)
    : options_(std::move(options)),
      window_("Theatron", options_.size),
      scene_(options_.room, options_.people),
      choice_(options_.renderer),
      pace_(xr::automatic_ways(1, options_.scale)),
      participant_(with_callbacks(options_.join)) {}

client::Participant::Options WindowViewer::with_callbacks(client::Participant::Options join) {
    join.news = [this] { window_.wake(); };
    join.remark = [this, also = join.remark](const std::string& text) {
        also(text);
        {
            const std::lock_guard lock(mutex_);
            remarks_.push_back(text);
        }
        window_.wake();
    };
    return join;
}

void WindowViewer::note(const std::string& text, Duration length) {
    notice_ = text;
    notice_until_ = steady_now() + length;
    next_texts_ = {};
}

void WindowViewer::run() {
    TimePoint next_picture{};
    while (!cli::stop_requested()) {
        const TimePoint before = steady_now();
        window_.wait((before < next_picture || fading_ ? next_picture : next_texts_) - before);

        const xr::WindowInput input = window_.poll();
        const TimePoint now = steady_now();
        if (input.close || !obey(input))
            break;
        if (input.grabbed)
            grab(*input.grabbed);
        steer(input.steering, now);
        if (options_.seconds > 0 && first_picture_at_ != TimePoint{} &&
            now - first_picture_at_ >= seconds_to_duration(options_.seconds))
            break;
        follow_host();
        if (now < next_picture)
            continue;

        for (const CameraId camera : scene_.take(participant_)) {
            updated_.insert(camera);
            scene_changed_ = true;
        }
        choose_pace();  // for the cameras that there are now
        fading_ = scene_.fade(participant_, now);
        scene_changed_ = scene_changed_ || fading_;
        find_view();
        if (now >= next_texts_)
            update_texts(now);
        if ((scene_changed_ || texts_changed_) && window_.is_visible()) {
            next_picture = now + window_.picture_time();
            draw(now);
        }
    }
    std::printf("%s\n", status_line(participant_).c_str());
    std::printf("drew %llu pictures, age on screen %.0f ms (half), %.0f ms (99 of 100)\n",
                static_cast<unsigned long long>(pictures_), all_ages_.percentile(0.5),
                all_ages_.percentile(0.99));
    if (window_.gl_errors() > 0)
        std::fprintf(stderr, "The graphics driver reported %d errors, the first: %s\n",
                     window_.gl_errors(), window_.first_gl_error().c_str());
}

// False when the person leaves.
bool WindowViewer::obey(const xr::WindowInput& input) {
    if (input.redraw)
        scene_changed_ = true;
    for (const xr::KeyPress& key : input.keys) {
        if (key.action == xr::Action::leave)
            return false;
        obey(key);
    }
    return true;
}

void WindowViewer::obey(const xr::KeyPress& key) {
    client::Participant::Options& join = options_.join;
    switch (key.action) {
        case xr::Action::help:
            texts_.help = !texts_.help;
            texts_changed_ = true;
            break;
        case xr::Action::full_screen:
            window_.toggle_full_screen();
            break;
        case xr::Action::next_renderer:
            choose_renderer();
            break;
        case xr::Action::next_depth_codec:
            join.depth_codec = next_name(video::depth_codec_names(), join.depth_codec);
            participant_.choose_codecs(join.depth_codec, "");
            note("Depth codec: " + join.depth_codec, choice_shown);
            break;
        case xr::Action::next_color_codec:
            join.color_codec = next_name(video::color_codec_names(), join.color_codec);
            participant_.choose_codecs("", join.color_codec);
            note("Colour codec: " + join.color_codec, choice_shown);
            break;
        case xr::Action::own_view:
        case xr::Action::view_camera: {
            viewer::ViewChoice choice{options_.view.camera, 0, 0};
            if (key.action == xr::Action::view_camera)
                choice.camera = CameraId(key.camera);
            try {
                go_home(choice);
                note("View of " + camera_text(choice.camera), choice_shown);
            } catch (const Error&) {
                note("Nothing comes from " + camera_text(choice.camera), choice_shown);
            }
            break;
        }
        case xr::Action::leave:
            break;
    }
}

void WindowViewer::choose_renderer() {
    if (!choice_.choose(next_name(viewer::renderer_choices(), choice_.renderer())))
        return note("The host has set this way of drawing: " + choice_.renderer(), choice_shown);
    choose_pace();
    const bool as_drawn = choice_.renderer() == way().renderer;
    note("Drawing: " + choice_.renderer() + (as_drawn ? "" : ", now " + way().renderer),
         choice_shown);
}

void WindowViewer::follow_host() {
    const auto word = participant_.take_renderer_word();
    if (!word)
        return;
    const session::RendererChoice before = choice_;
    if (const std::string problem = viewer::follow_host(choice_, *word); !problem.empty())
        return note(problem, remark_shown);
    if (choice_.renderer() != before.renderer() || choice_.locked() != before.locked())
        note(choice_.locked() || !before.locked()
                 ? "The host has set the way of drawing: " + choice_.renderer()
                 : "The way of drawing is yours again.",
             remark_shown);
    choose_pace();
}

// Begins anew where there are other ways to draw than before.
void WindowViewer::choose_pace() {
    auto ways = choice_.renderer() == viewer::automatic
                    ? xr::automatic_ways(scene_.calibrations().size(), options_.scale)
                    : xr::ways_of(choice_.renderer(), options_.scale);
    if (ways == pace_.ways())
        return;
    pace_ = xr::DrawingPace(std::move(ways));
    scene_changed_ = true;
}

// Throws Error if that camera does not exist or sent nothing yet.
void WindowViewer::go_home(const viewer::ViewChoice& choice) {
    const auto own = choice.resolve(scene_.calibrations(), scene_.newest(), window_.pixels());
    const Calibration& calibration = scene_.calibrations().at(choice.camera);
    const DepthView depth = scene_.newest().at(choice.camera)->depth.view();
    viewpoint_ = {own.room_from_eye, render::point_of_interest(calibration, depth)};
    lens_ = calibration.depth;
    options_.view = choice;
    moved_ = false;
    scene_changed_ = true;
}

// As soon as there is a picture to look at; and again when the host came back
// with other cameras, unless the person has gone elsewhere.
void WindowViewer::find_view() {
    if (!scene_.has_picture())
        return;
    const TimePoint now = steady_now();
    if (first_picture_at_ == TimePoint{})
        first_picture_at_ = now;
    if (viewpoint_ && (moved_ || updated_.empty()))
        return;
    const auto& newest = scene_.newest();
    const CameraId wanted = options_.view.camera;
    if (!viewpoint_ && scene_.calibrations().count(wanted) == 0 && participant_.status().joins == 1)
        (void)options_.view.resolve(scene_.calibrations(), newest, window_.pixels());  // tells why
    if (newest.count(wanted) == 0) {
        if (!viewpoint_ && now - first_picture_at_ >= camera_patience)
            go_home({newest.begin()->first, 0, 0});
        return;
    }
    // The point of interest is found once; only a camera that was moved is followed.
    const Pose& own = scene_.calibrations().at(wanted).room_from_camera;
    if (!viewpoint_ || home_pose_ != own) {
        go_home(options_.view);
        home_pose_ = own;
    }
}

// Counted from 1, as the keys are, with the name that the host gave it.
std::string WindowViewer::camera_text(CameraId camera) const {
    std::string text = "camera " + std::to_string(int(camera) + 1);
    std::uint64_t generation = 0;
    for (const auto& known : participant_.cameras(generation))
        if (known.description.id == camera)
            text += ": " + known.description.name;
    return text;
}

render::CameraView WindowViewer::view() const {
    return render::view_of_camera(lens_, viewpoint_->room_from_eye, window_.pixels());
}

// What was grabbed with the mouse stays under it.
void WindowViewer::grab(Vec2 place) {
    if (!viewpoint_)
        return;
    const render::CameraView v = view();
    const Vec2 on_picture{v.left + place.x * (v.right - v.left),
                          v.top + place.y * (v.bottom - v.top)};
    if (const auto distance = picture_.distance_at(place))
        viewpoint_ = xr::around(*viewpoint_, on_picture, *distance);
}

void WindowViewer::steer(const xr::Steering& steering, TimePoint now) {
    const bool flew = std::exchange(flying_, viewpoint_ && steering.fly != Vec3{});
    const Duration elapsed = flew ? now - steered_at_ : Duration{};
    steered_at_ = now;
    if (!viewpoint_ || !steering.moves())
        return;
    const render::CameraView before = view();
    viewpoint_ = xr::steered(*viewpoint_, steering, before.bottom - before.top, elapsed);
    moved_ = true;
    scene_changed_ = true;
}

void WindowViewer::update_texts(TimePoint now) {
    {
        const std::lock_guard lock(mutex_);
        if (!remarks_.empty()) {
            notice_ = remarks_.back();
            notice_until_ = now + remark_shown;
            remarks_.clear();
        }
    }
    const auto status = participant_.status();
    if (status.phase == client::Participant::Phase::refused && status.joins == 0)
        throw Error(status.problem);

    OnScreen screen;
    screen.has_picture = viewpoint_.has_value();
    if (age_at_presentation_) {
        // What stays on screen grows old; while pictures come, what matters is how old they are.
        const double since = to_ms(now - presented_at_);
        screen.age_ms = since > 500 ? *age_at_presentation_ + since : ages_.percentile(0.5);
    }
    screen.drawn_per_second = drawn_.per_second(now);
    screen.way = way();
    screen.renderer_by = choice_.locked()                          ? OnScreen::By::host
                         : choice_.renderer() == viewer::automatic ? OnScreen::By::program
                                                                   : OnScreen::By::person;
    participant_.tell_renderer(screen.way.renderer);
    screen.address = options_.join.link.host + ":" + std::to_string(options_.join.link.port);

    xr::OverlayContent texts;
    texts.help = texts_.help;
    texts.facts = window_facts(participant_, screen);
    const WindowMessage message = window_message(status, screen);
    texts.message = message.message;
    texts.detail = message.detail;
    texts.warning = window_warning(status, screen);
    if (message.message.empty() && now < notice_until_)
        texts.notice = notice_;
    texts_changed_ = texts_changed_ || texts != texts_;
    texts_ = std::move(texts);
    next_texts_ = now + texts_every;

    const std::string host = status.host_name.empty() ? screen.address : status.host_name;
    const std::string title = host + " - " + screen.way.renderer + " - Theatron";
    if (title != title_)
        window_.set_title(title_ = title);
}

void WindowViewer::draw_scene() {
    const render::DrawTarget target = picture_.begin(window_.pixels(), way().scale);
    const std::string& wanted = way().renderer;
    scene_.set_depth_step(way().depth_step);
    try {
        scene_.draw(view(), target, wanted);
        working_renderer_ = wanted;
    } catch (const Error& e) {
        // A driver that cannot do one way of drawing must not end the session.
        if (working_renderer_.empty() || working_renderer_ == wanted)
            throw;
        note(e.what(), remark_shown);
        choice_.follow({working_renderer_, choice_.locked()});
        choose_pace();
    }
}

void WindowViewer::draw(TimePoint begin) {
    const bool scene = std::exchange(scene_changed_, false) && viewpoint_;
    texts_changed_ = false;
    if (scene)
        draw_scene();
    picture_.show(window_.pixels());
    overlay_.draw(texts_, window_.pixels(), window_.text_pixels());
    window_.present();
    if (!scene)
        return;

    const TimePoint end = steady_now();
    pace_.add(end, end - begin);
    drawn_.add(end);
    ++pictures_;
    if (updated_.empty())
        return;
    // The session's time is known once the host has answered.
    presented_at_ = end;
    const auto status = participant_.status();
    if (status.phase == client::Participant::Phase::joined && status.round_trip > Duration{}) {
        const TimePoint presented = participant_.now();
        double age_ms = 0;
        for (const CameraId camera : updated_)
            if (const auto frame = scene_.newest().find(camera); frame != scene_.newest().end())
                age_ms = std::max(age_ms, to_ms(presented - frame->second->times.captured));
        age_at_presentation_ = age_ms;
        ages_.add(age_ms);
        all_ages_.add(age_ms);
    }
    updated_.clear();
}

}  // namespace theatron::app
