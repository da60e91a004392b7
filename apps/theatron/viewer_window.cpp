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
#include "viewer/renderer_text.h"
#include "visit/leaving.h"
#include "visit/shown_stay.h"
#include "window/keyboard_focus.h"
#include "window/overlay_native.h"
#include "window/scaled_picture.h"

namespace theatron::app {
namespace {

using Phase = client::Participant::Phase;

std::string filter_name(const std::string& spelling) {
    return viewer::filter_text(spelling.empty() ? "" : host::shown_filter(spelling));
}

constexpr Duration texts_every = 250ms, camera_pictures_every = 100ms;

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

std::string title_of(const viewer::Facts& facts, const std::string& address) {
    const std::string& host = facts.received.status.host_name;
    return (host.empty() ? address : host) + " - " + facts.way.renderer + " - Theatron";
}

std::string save_seen(window::Action action, viewer::Viewer& viewer, Size pixels,
                      const std::filesystem::path& folder, TimePoint now) {
    if (viewer.first_picture_at() == TimePoint{})
        return say(Phrase::no_picture_yet);
    const viewer::ShownMoment moment = viewer.shown_moment(now);
    const std::string when = name_part(moment);
    if (action == window::Action::save_picture)
        return save_view(folder, when, ".png", files::encode_png(viewer.picture(pixels).view()));
    const std::vector<ColoredPoint> points = viewer.points();
    if (points.empty())
        return say(Phrase::no_points_yet);
    const std::string comments[] = {points_in_room, moment_text(moment, utc_now())};
    return save_view(folder, when, ".ply", encode_ply(points, comments));
}

// The number of the panel to which the keyboard comes first; 0: there is none.
std::uint64_t keyboard_of(const window::OverlayContent& content) {
    for (const window::Panel& panel : content.panels)
        if (panel.keyboard != 0)
            return panel.keyboard;
    return 0;
}

void print_end(viewer::Viewer& viewer, const client::Participant& participant,
               const window::DesktopWindow& window) {
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

// The window's turns: input, stay, picture, texts.
class ViewerLoop {
public:
    ViewerLoop(window::DesktopWindow& window, ViewerWindow options)
        : window_(window),
          options_(prepared(std::move(options))),
          stay_(options_.join, options_.ports, std::move(options_.settings)),
          viewer_(options_.viewer, stay_.participant()),
          shown_(stay_, viewer_) {}

    WindowEnd run() {
        while (!end_ && !cli::stop_requested())
            turn();
        print_end(viewer_, stay_.participant(), window_);
        if (!over_.empty())
            throw SessionEnded(over_);
        const WindowEnd end = end_.value_or(WindowEnd::closed);
        if (options_.is_last || end == WindowEnd::closed)
            cli::begin_end();
        return end;
    }

private:
    ViewerWindow prepared(ViewerWindow options) {
        options.join.news = [this] { window_.wake(); };
        options.join.written = [this](const std::string& text) {
            remarks_.add(text);
            window_.wake();
        };
        options.join.remark = [also = options.join.remark,
                               shown = options.join.written](const std::string& text) {
            also(text);
            shown(text);
        };
        options.viewer.depth_codec = options.join.depth_codec;
        options.viewer.color_codec = options.join.color_codec;
        options.viewer.one_panel = true;
        return options;
    }

    void turn() {
        const TimePoint before = steady_now();
        // Before the first picture there is nothing that looks live.
        if (options_.watch && viewer_.pictures() > 0)
            options_.watch->beat();
        const bool picture_is_due = before < next_picture_ || viewer_.is_animated();
        window_.wait((picture_is_due ? next_picture_ : next_texts_) - before);

        window_.take_text(viewer_.takes_text());
        window::WindowInput input = window_.poll();
        const TimePoint now = steady_now();
        type(input, now);
        if (input.close)
            return end(WindowEnd::closed);
        press_controls(input, now);
        for (const window::KeyPress& key : viewer_.take_pressed())
            input.keys.push_back(key);
        for (const window::KeyPress& key : input.keys)
            obey(key.action, now);
        if (end_)
            return;
        shown_.tick(input.talks, now);
        if (stay_.is_over()) {
            over_ = say(Phrase::enter_again_later, stay_.participant().status().problem);
            return end(WindowEnd::closed);
        }
        greet(now);
        viewer_.on_input(input, input.grabbed ? picture_.distance_at(*input.grabbed) : std::nullopt,
                         window_.pixels(), now);
        if (const TimePoint first = viewer_.first_picture_at();
            options_.seconds > 0 && first != TimePoint{} &&
            now - first >= seconds_to_duration(options_.seconds))
            return end(WindowEnd::closed);
        for (const std::string& text : remarks_.take())
            viewer_.remark(text, now);
        if (now >= next_picture_)
            draw(input, now);
    }

    void end(WindowEnd how) { end_ = how; }

    // The mouse and the keyboard press buttons and move sliders and panels; what they use is taken
    // out of `input`.
    void press_controls(window::WindowInput& input, TimePoint now) {
        std::erase_if(input.keys, [&](const window::KeyPress& key) {
            using window::Nudge;
            if (key.action != window::Action::nudge ||
                (key.nudge != Nudge::up && key.nudge != Nudge::down) ||
                !overlay_.turn_page(key.nudge == Nudge::down ? 1 : -1))
                return false;
            input.redraw = true;
            return true;
        });
        if (const auto pressed = window::take_focus_keys(input, overlay_.controls(),
                                                         overlay_.keyboard_begin(), focus_)) {
            viewer_.press(overlay_.command_of(*pressed), now);
            next_texts_ = now;
        }
        if (input.released)
            slider_.reset();
        if (input.grabbed && overlay_.covers(*input.grabbed)) {
            if (slider_ = overlay_.slider_at(*input.grabbed); slider_ && input.grabbed_left) {
                viewer_.press(slider_->command, now);
                viewer_.slide(slider_->value_at(*input.grabbed));
            } else if (const auto command = overlay_.command_at(*input.grabbed))
                viewer_.press(*command, now);
            input.grabbed.reset();
            focus_.reset();
            next_texts_ = now;
        }
        if (slider_ && input.pointer) {
            viewer_.slide(slider_->value_at(*input.pointer));
            input.steering.turn = {};
            next_texts_ = now;
        }
        if (input.steering.approach != 0 && input.pointer && overlay_.covers(*input.pointer)) {
            constexpr double rows_per_click = 3;
            overlay_.scroll(*input.pointer,
                            -rows_per_click * std::exchange(input.steering.approach, 0));
            input.redraw = true;
        }
        input.pointer_covered = input.pointer && overlay_.covers(*input.pointer);
    }

    void type(window::WindowInput& input, TimePoint now) {
        for (window::FormKeyPress& press : input.typed) {
            if (press.key == window::FormKey::v && press.control)
                press = {window::FormKey::letters, false, false, window_.clipboard()};
            viewer_.type(press, now);
            next_texts_ = now;
            input.redraw = true;
        }
    }

    // The keys that are not the viewer's.
    void obey(window::Action action, TimePoint now) {
        using window::Action;
        if (const auto command = visit::stay_command(action))
            return viewer_.note(stay_.obey(*command), now);
        if (action == Action::leave && viewer_.give_up_mark())
            return;
        if (action == Action::full_screen || (action == Action::leave && window_.is_full_screen()))
            return window_.toggle_full_screen();
        if (action == Action::save_picture || action == Action::save_points)
            return viewer_.note(save_seen(action, viewer_, window_.pixels(), options_.save_to, now),
                                now);
        if (action != Action::leave && action != Action::leave_session)
            return;
        const bool is_joined = stay_.participant().status().phase == Phase::joined;
        if (leaving_.pressed(is_joined, now))
            return end(WindowEnd::left);
        viewer_.ask_leave(now, visit::Leaving::confirm_within);
        viewer_.note(say(action == Action::leave ? Phrase::esc_again : Phrase::bar_leave_again),
                     now);
    }

    void greet(TimePoint now) {
        const client::Participant::Status status = stay_.participant().status();
        if (status.phase == Phase::joined && options_.entered)
            std::exchange(options_.entered, nullptr)(status.host_name);
        if (viewer_.first_picture_at() != TimePoint{} && !options_.greeting.empty())
            viewer_.note(std::exchange(options_.greeting, {}), now);
    }

    void draw(const window::WindowInput& input, TimePoint now) {
        const bool scene = viewer_.step(window_.pixels(), now);
        shown_.place_voices();
        const bool texts = change_texts(input, now);
        if ((!scene && !texts && !input.redraw) || !window_.is_visible()) {
            // Nothing is drawn while decoding needs the processor; then an animation asks for no
            // turn at once.
            if (viewer_.is_animated())
                next_picture_ = now + window_.picture_time();
            return;
        }
        next_picture_ = now + window_.picture_time();
        if (scene)
            viewer_.draw(window_.pixels(), picture_.begin(window_.pixels(), viewer_.way().scale),
                         now);
        const TimePoint submitted = steady_now();
        picture_.show(window_.pixels());
        overlay_.draw(texts_, window_.pixels(), window_.text_pixels());
        window_.present();
        if (scene)
            viewer_.on_presented(now, (is_software_ ? steady_now() : submitted) - now,
                                 steady_now());
    }

    // True if the texts are others than those of the last picture.
    bool change_texts(const window::WindowInput& input, TimePoint now) {
        const auto hovered = input.pointer ? overlay_.control_at(*input.pointer) : std::nullopt;
        bool changed = texts_.hovered != hovered || texts_.focused != focus_;
        texts_.hovered = hovered;
        texts_.focused = focus_;
        if (now < next_texts_ && input.keys.empty())
            return changed;
        const viewer::Facts facts = viewer_.facts(now);
        window::OverlayContent content = viewer::overlay_of(facts, address_, filter_name);
        content.hovered = hovered;
        // Another button may stand where the keyboard was.
        if ((content.tools && texts_.tools &&
             content.tools->tools.size() != texts_.tools->tools.size()) ||
            keyboard_of(content) != keyboard_of(texts_))
            focus_.reset();
        content.focused = focus_;
        changed = changed || content != texts_;
        texts_ = std::move(content);
        next_texts_ = now + (texts_.pictures.empty() ? texts_every : camera_pictures_every);
        stay_.settings().change(viewer_.settings(stay_.settings().now));
        if (std::string newest = title_of(facts, address_); newest != title_)
            window_.set_title(title_ = std::move(newest));
        return changed;
    }

    window::DesktopWindow& window_;
    Remarks remarks_;
    ViewerWindow options_;
    visit::Stay stay_;
    viewer::Viewer viewer_;
    visit::ShownStay shown_;
    window::ScaledPicture picture_;
    window::Overlay overlay_;
    const bool is_software_ = render::is_software(render::driver_name());
    const std::string address_ = net::host_and_port(options_.join.link);

    visit::Leaving leaving_;
    window::OverlayContent texts_;
    std::string title_;
    TimePoint next_picture_{}, next_texts_{};
    std::optional<window::Overlay::Slider> slider_;  // held with the mouse
    std::optional<std::size_t> focus_;               // the button that has the keyboard
    std::optional<WindowEnd> end_;
    std::string over_;  // why the session is, for good
};

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
    window.viewer.tour_is_due = !kept.tour_seen;
    window.join.name = name.value_or(kept.name);
    client::Settings settings = kept;
    settings.name = window.join.name;
    settings.quality = quality.value_or(kept.quality);
    window.viewer.room.quality = parse_quality(settings.quality);
    window.settings.now = kept;
    window.settings.keep = [folder](const client::Settings& settings) {
        if (const std::string trouble = client::save_settings(folder, settings); !trouble.empty())
            log::say(trouble);
    };
    window.settings.change(settings);
}

WindowEnd show(window::DesktopWindow& window, ViewerWindow options) {
    return ViewerLoop(window, std::move(options)).run();
}

}  // namespace theatron::app
