// SPDX-License-Identifier: Apache-2.0
#include "viewer_window.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "base/log.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "files/png_file.h"
#include "files/state_folder.h"
#include "host/filter_choice.h"
#include "participant_json.h"
#include "phrases/phrase.h"
#include "render/gl_driver.h"
#include "saved_view.h"
#include "session/permissions.h"
#include "sound/device_watch.h"
#include "source_remarks.h"
#include "viewer/renderer_text.h"
#include "xr/overlay_native.h"
#include "xr/scaled_picture.h"

namespace theatron::app {
namespace {

// In the person's language, where it has a word for them.
std::string filter_name(const std::string& spelling) {
    if (spelling.empty())
        return say(Phrase::nothing_chosen);
    const std::string shown = host::shown_filter(spelling);
    return shown == "default" ? say(Phrase::usual) : shown;
}

constexpr Duration texts_every = 250ms, camera_pictures_every = 100ms, voices_every = 100ms;

// Remarks of the participant's thread for the window's thread.
class Remarks {
public:
    void add(const std::string& text) {
        const std::lock_guard lock(mutex_);
        texts_.push_back(text);
    }
    std::vector<std::string> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(texts_, {});
    }

private:
    std::mutex mutex_;
    std::vector<std::string> texts_;
};

// For somebody who was in.
bool is_over(const client::Participant::Status& status) {
    using Phase = client::Participant::Phase;
    return status.joins > 0 && (status.phase == Phase::ended || status.phase == Phase::refused);
}

std::string title_of(const viewer::Facts& facts, const std::string& address) {
    const std::string& host = facts.received.status.host_name;
    return (host.empty() ? address : host) + " - " + facts.way.renderer + " - Theatron";
}

// The key for leaving must be pressed twice, against leaving by accident; once is enough if no
// session is joined.
class Leaving {
public:
    static constexpr Duration confirm_within = 3s;

    bool pressed(const client::Participant::Status& status, TimePoint now) {
        const bool again = now - pressed_at_ < confirm_within;
        pressed_at_ = now;
        return again || status.phase != client::Participant::Phase::joined;
    }

private:
    TimePoint pressed_at_ = TimePoint(-confirm_within);
};

std::string save_seen(xr::Action action, viewer::Viewer& viewer, Size pixels,
                      const std::filesystem::path& folder, TimePoint now) {
    if (viewer.first_picture_at() == TimePoint{})
        return say(Phrase::no_picture_yet);
    const viewer::ShownMoment moment = viewer.shown_moment(now);
    const std::string when = name_part(moment);
    if (action == xr::Action::save_picture)
        return save_view(folder, when, ".png", files::encode_png(viewer.picture(pixels).view()));
    const std::vector<ColoredPoint> points = viewer.points();
    if (points.empty())
        return say(Phrase::no_points_yet);
    const std::string comments[] = {points_in_room, moment_text(moment, utc_now())};
    return save_view(folder, when, ".ply", encode_ply(points, comments));
}

// Each returns a line about it.
std::string change_push_to_talk(VoiceLine& voice, ViewerWindow& options) {
    const std::string text = voice.toggle_push_to_talk();
    options.settings.push_to_talk = voice.pushes_to_talk();
    if (options.keep)
        options.keep(options.settings);
    return text;
}

// A person who came without a microphone gets the one of the settings.
std::string change_microphone(VoiceLine& voice, const client::Participant& participant,
                              ViewerWindow& options) {
    const auto state = voice.voices().microphone;
    if (!session::may(participant.status().standing.role, session::Right::speak) ||
        (state && state != viewer::Microphone::none && state != viewer::Microphone::missing))
        return voice.toggle_microphone();
    voice.use_microphone(options.settings.microphone);
    options.settings.speaks = true;
    if (options.keep)
        options.keep(options.settings);
    return say(Phrase::microphone_is_opening);
}

std::string change_voice_recording(client::Participant& participant, ViewerWindow& options) {
    const bool agrees = !participant.voice_may_record();
    participant.allow_voice_recording(agrees);
    options.settings.voice_may_record = agrees;
    if (options.keep)
        options.keep(options.settings);
    if (agrees && !participant.asks_voice_consent())
        return say(Phrase::host_asks_no_consent);
    return say(agrees ? Phrase::voice_may_record : Phrase::voice_may_not_record);
}

std::string change_face(publish::OwnFace& face, bool shown) {
    face.show(shown);
    return say(shown ? Phrase::webcam_is_opening : Phrase::webcam_is_off);
}

viewer::OwnFace own_face(const publish::OwnFace& face) {
    using State = publish::OwnFace::State;
    const State state = face.state();
    return state == State::off    ? viewer::OwnFace::off
           : state == State::seen ? viewer::OwnFace::seen
                                  : viewer::OwnFace::opening;
}

// Takes over the camera that was opened, and the choice in the panel.
void follow_face(publish::OwnFace& face, const client::Participant& participant,
                 viewer::Viewer& viewer, TimePoint now) {
    if (const auto wish = viewer.take_face_wish())
        viewer.note(change_face(face, *wish), now);
    face.on_tick();
    if (const std::string problem = face.take_problem(); !problem.empty())
        viewer.note(problem, now);
    // The host does not take it: its remark has said so.
    if (face.state() == publish::OwnFace::State::offered &&
        !participant.status().face_problem.empty())
        face.show(false);
    viewer.set_own_face(own_face(face));
}

// Carries out the choice in the panel, and gives the panel the devices while it is open.
void follow_sound(VoiceLine& voice, sound::DeviceWatch& devices, viewer::Viewer& viewer,
                  ViewerWindow& options, TimePoint now) {
    if (const auto wish = viewer.take_sound_wish()) {
        client::Settings& settings = options.settings;
        if (wish->kind == viewer::UseSound::Kind::microphone) {
            voice.use_microphone(settings.microphone = wish->device);
            settings.speaks = true;
        } else {
            voice.use_speaker(settings.loudspeaker = wish->device);
            settings.hears = true;
        }
        if (options.keep)
            options.keep(settings);
    }
    if (!viewer.shows_sound())
        return;
    viewer.set_sound_choices(voice.sound_choices(devices.devices_at(now)));
}

// The keyboard's way through the buttons. Takes the keys that it uses out of `input`; returns the
// button that was pressed.
std::optional<std::size_t> follow_focus(xr::WindowInput& input, const xr::Overlay& overlay,
                                        std::optional<std::size_t>& focus) {
    const std::size_t controls = overlay.controls();
    std::optional<std::size_t> pressed;
    const auto step_of = [&](const xr::KeyPress& key) -> std::optional<xr::FocusStep> {
        using Action = xr::Action;
        if (key.action == Action::next_control)
            return xr::FocusStep::next;
        if (key.action == Action::previous_control)
            return xr::FocusStep::previous;
        if (!focus)
            return std::nullopt;
        if (key.action == Action::leave)
            return xr::FocusStep::none;
        if (key.action != Action::nudge)
            return std::nullopt;
        return key.nudge == xr::Nudge::left || key.nudge == xr::Nudge::farther
                   ? xr::FocusStep::left
                   : xr::FocusStep::right;
    };
    std::erase_if(input.keys, [&](const xr::KeyPress& key) {
        if (const auto step = step_of(key)) {
            focus = xr::moved_focus(focus, *step, controls, overlay.keyboard_begin());
            return true;
        }
        const bool presses =
            key.action == xr::Action::press_control || key.action == xr::Action::freeze;
        if (focus && presses && *focus < controls)
            pressed = focus;
        return focus && presses;
    });
    // The key that presses buttons is that of push to talk.
    input.talks = input.talks && !focus;
    return pressed;
}

// The number of the panel to which the keyboard comes first; 0: there is none.
std::uint64_t keyboard_of(const xr::OverlayContent& content) {
    for (const xr::Panel& panel : content.panels)
        if (panel.keyboard != 0)
            return panel.keyboard;
    return 0;
}

void print_end(viewer::Viewer& viewer, const client::Participant& participant,
               const xr::DesktopWindow& window) {
    char drawn[128];
    std::snprintf(drawn, sizeof(drawn),
                  "drew %llu pictures, age on screen %.0f ms (half), %.0f ms (99 of 100)\n",
                  static_cast<unsigned long long>(viewer.pictures()),
                  viewer.ages_ms().percentile(0.5), viewer.ages_ms().percentile(0.99));
    output::print(status_line(participant) + "\n" + drawn);
    if (window.gl_errors() > 0)
        log::say("The graphics driver reported " + std::to_string(window.gl_errors()) +
                 " errors, the first: " + window.first_gl_error());
}

}  // namespace

bool has_display() {
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY"})
        if (const char* value = std::getenv(variable); value && *value != '\0')
            return true;
    return false;
}

std::optional<render::SceneQuality> parse_quality(const std::string& text) {
    if (text == "auto")
        return std::nullopt;
    return text == "high" ? render::SceneQuality::high : render::SceneQuality::low;
}

void use_kept_settings(ViewerWindow& window, const std::optional<std::string>& name,
                       const std::optional<std::string>& renderer,
                       const std::optional<std::string>& quality) {
    if (renderer)
        viewer::check_renderer_choice(*renderer);
    const std::filesystem::path folder = files::state_folder();
    std::string problem;
    const client::Settings kept = client::load_settings(folder, problem);
    if (!problem.empty())
        log::say(problem);
    const std::vector<std::string> known = viewer::renderer_choices();
    const bool is_known = std::find(known.begin(), known.end(), kept.renderer) != known.end();
    window.viewer.renderer = renderer.value_or(is_known ? kept.renderer : viewer::automatic);
    window.viewer.sits = kept.sits;
    window.viewer.shows_people = kept.shows_people;
    window.viewer.shows_facts = kept.shows_facts;
    window.join.name = name.value_or(kept.name);
    window.settings = kept;
    window.settings.name = window.join.name;
    window.settings.quality = quality.value_or(kept.quality);
    window.viewer.room.quality = parse_quality(window.settings.quality);
    window.keep = [folder](const client::Settings& settings) {
        if (const std::string trouble = client::save_settings(folder, settings); !trouble.empty())
            log::say(trouble);
    };
    if (window.settings != kept)
        window.keep(window.settings);
}

WindowEnd show(xr::DesktopWindow& window, ViewerWindow options) {
    xr::ScaledPicture picture;
    xr::Overlay overlay;
    Remarks remarks;
    options.join.news = [&] { window.wake(); };
    options.join.remark = [&, also = options.join.remark](const std::string& text) {
        also(text);
        remarks.add(text);
        window.wake();
    };
    const std::string address = net::host_and_port(options.join.link);
    options.viewer.depth_codec = options.join.depth_codec;
    options.viewer.color_codec = options.join.color_codec;
    client::Participant participant(std::move(options.join));
    std::optional<publish::Publishing> publishing;
    if (options.publisher)
        publishing.emplace(*options.publisher, participant);
    std::optional<publish::FaceShowing> showing;
    if (options.face)
        showing.emplace(*options.face, participant);
    std::optional<VoiceLine::Talking> talking;
    if (options.voice)
        talking.emplace(*options.voice, participant);
    std::optional<FaceLine::Sending> sending;
    if (options.expression)
        sending.emplace(*options.expression, participant);
    options.viewer.one_panel = true;
    viewer::Viewer viewer(std::move(options.viewer), participant);
    const bool is_software = render::is_software(render::driver_name());

    xr::OverlayContent texts;
    std::string title;
    Leaving leaving;
    SourceRemarks sources;
    TimePoint next_picture{}, next_texts{}, next_voices{};
    std::optional<xr::Overlay::Slider> slider;  // held with the mouse
    std::optional<std::size_t> focus;           // the button that has the keyboard
    sound::DeviceWatch sound_devices;
    WindowEnd end = WindowEnd::closed;
    std::string over;  // why the session is, for good
    while (!cli::stop_requested()) {
        const TimePoint before = steady_now();
        // Before the first picture there is nothing that looks live.
        if (options.watch && viewer.pictures() > 0)
            options.watch->beat();
        const bool picture_is_due = before < next_picture || viewer.is_animated();
        window.wait((picture_is_due ? next_picture : next_texts) - before);

        xr::WindowInput input = window.poll();
        const TimePoint now = steady_now();
        if (input.close)
            break;
        if (const auto pressed = follow_focus(input, overlay, focus)) {
            viewer.press(overlay.command_of(*pressed), now);
            next_texts = now;
        }
        if (input.released)
            slider.reset();
        if (input.grabbed && overlay.covers(*input.grabbed)) {
            if (slider = overlay.slider_at(*input.grabbed); slider && input.grabbed_left) {
                viewer.press(slider->command, now);
                viewer.slide(slider->value_at(*input.grabbed));
            } else if (const auto command = overlay.command_at(*input.grabbed))
                viewer.press(*command, now);
            input.grabbed.reset();
            focus.reset();
            next_texts = now;
        }
        for (const xr::KeyPress& key : viewer.take_pressed())
            input.keys.push_back(key);
        bool left = false;
        for (const xr::KeyPress& key : input.keys) {
            const bool leave = key.action == xr::Action::leave;
            const bool leaves_by_button = key.action == xr::Action::leave_session;
            if (key.action == xr::Action::full_screen || (leave && window.is_full_screen()))
                window.toggle_full_screen();
            else if ((leave || leaves_by_button) && leaving.pressed(participant.status(), now))
                left = true;
            else if (key.action == xr::Action::microphone && options.voice)
                viewer.note(change_microphone(*options.voice, participant, options), now);
            else if (key.action == xr::Action::push_to_talk && options.voice)
                viewer.note(change_push_to_talk(*options.voice, options), now);
            else if (key.action == xr::Action::voice_recording)
                viewer.note(change_voice_recording(participant, options), now);
            else if (key.action == xr::Action::own_face && options.face)
                viewer.note(change_face(*options.face, !options.face->is_wanted()), now);
            else if (key.action == xr::Action::save_picture ||
                     key.action == xr::Action::save_points)
                viewer.note(save_seen(key.action, viewer, window.pixels(), options.save_to, now),
                            now);
            else if (leave || leaves_by_button) {
                viewer.ask_leave(now, Leaving::confirm_within);
                viewer.note(say(leave ? Phrase::esc_again : Phrase::bar_leave_again), now);
            }
        }
        if (left) {
            end = WindowEnd::left;
            break;
        }
        if (slider && input.pointer) {
            viewer.slide(slider->value_at(*input.pointer));
            input.steering.turn = {};
            next_texts = now;
        }
        if (input.steering.approach != 0 && input.pointer && overlay.covers(*input.pointer)) {
            constexpr double rows_per_click = 3;
            overlay.scroll(*input.pointer,
                           -rows_per_click * std::exchange(input.steering.approach, 0));
            input.redraw = true;
        }
        input.pointer_covered = input.pointer && overlay.covers(*input.pointer);
        if (options.face)
            follow_face(*options.face, participant, viewer, now);
        if (const auto status = participant.status();
            status.phase == client::Participant::Phase::joined) {
            if (options.voice)
                options.voice->note(status.standing);
            if (options.entered)
                std::exchange(options.entered, nullptr)(status.host_name);
        } else if (is_over(status)) {
            over = say(Phrase::enter_again_later, status.problem);
            break;
        }
        if (options.voice)
            options.voice->hold(input.talks, now);
        if (options.voice && now >= next_voices) {
            viewer::Voices voices = options.voice->voices();
            if (participant.asks_voice_consent())
                voices.may_record = participant.voice_may_record();
            viewer.set_voices(std::move(voices));
            follow_sound(*options.voice, sound_devices, viewer, options, now);
            next_voices = now + voices_every;
        }
        viewer.on_input(input, input.grabbed ? picture.distance_at(*input.grabbed) : std::nullopt,
                        window.pixels(), now);
        if (const TimePoint first = viewer.first_picture_at();
            options.seconds > 0 && first != TimePoint{} &&
            now - first >= seconds_to_duration(options.seconds))
            break;
        if (viewer.first_picture_at() != TimePoint{} && !options.greeting.empty())
            viewer.note(std::exchange(options.greeting, {}), now);
        for (const std::string& text : remarks.take())
            viewer.remark(text, now);
        if (options.publisher)
            for (const std::string& text : sources.take(*options.publisher, now))
                viewer.note(text, now);
        if (now < next_picture)
            continue;

        const bool scene = viewer.step(window.pixels(), now);
        // The eye's pose has y down.
        if (options.voice && viewer.first_picture_at() != TimePoint{})
            options.voice->place(viewer.told_eye() * Pose{Quat{0, 1, 0, 0}, {}}, participant);
        const auto hovered = input.pointer ? overlay.control_at(*input.pointer) : std::nullopt;
        bool texts_changed = texts.hovered != hovered || texts.focused != focus;
        texts.hovered = hovered;
        texts.focused = focus;
        if (now >= next_texts || !input.keys.empty()) {
            const viewer::Facts facts = viewer.facts(now);
            xr::OverlayContent content = viewer::overlay_of(facts, address, filter_name);
            content.hovered = hovered;
            // Another button may stand where the keyboard was.
            if ((content.tools && texts.tools &&
                 content.tools->tools.size() != texts.tools->tools.size()) ||
                keyboard_of(content) != keyboard_of(texts))
                focus.reset();
            content.focused = focus;
            texts_changed = texts_changed || content != texts;
            texts = std::move(content);
            next_texts = now + (texts.pictures.empty() ? texts_every : camera_pictures_every);
            if (const auto settings = viewer.settings(options.settings);
                options.keep && settings != options.settings)
                options.keep(options.settings = settings);
            if (std::string newest = title_of(facts, address); newest != title)
                window.set_title(title = std::move(newest));
        }
        if ((!scene && !texts_changed && !input.redraw) || !window.is_visible())
            continue;
        next_picture = now + window.picture_time();
        if (scene)
            viewer.draw(window.pixels(), picture.begin(window.pixels(), viewer.way().scale), now);
        const TimePoint submitted = steady_now();
        picture.show(window.pixels());
        overlay.draw(texts, window.pixels(), window.text_pixels());
        window.present();
        if (scene)
            viewer.on_presented(now, (is_software ? steady_now() : submitted) - now, steady_now());
    }
    print_end(viewer, participant, window);
    if (!over.empty())
        throw SessionEnded(over);
    if (options.is_last || end == WindowEnd::closed)
        cli::begin_end();
    return end;
}

}  // namespace theatron::app
