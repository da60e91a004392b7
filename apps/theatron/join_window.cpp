// SPDX-License-Identifier: Apache-2.0
#include "join_window.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "cli/stop_signal.h"
#include "client/recent_links.h"
#include "entry.h"
#include "files/state_folder.h"
#include "link_argument.h"
#include "viewer/head_text.h"
#include "viewer_window.h"

namespace theatron::app {
namespace {

constexpr const char* without_display =
    "Use --offscreen FILE.png for a picture, or --no-window to receive without one.";

// Those that the last windows have entered. A problem is said.
client::RecentLinks recent_links() {
    std::string problem;
    client::RecentLinks links = client::load_recent_links(files::state_folder(), problem);
    if (!problem.empty())
        log::say(problem);
    return links;
}

void keep(const client::RecentLinks& links) {
    if (const std::string problem = client::save_recent_links(files::state_folder(), links);
        !problem.empty())
        log::say(problem);
}

void forget_link(const std::string& link) {
    client::RecentLinks links = recent_links();
    std::erase_if(links, [&](const client::RecentLink& recent) { return recent.link == link; });
    keep(links);
}

}  // namespace

void join_in_window(const JoinFlags& flags) {
    ViewerWindow shown{.join = participant_options(flags)};
    shown.join.shows_patient = true;
    shown.seconds = flags.seconds;
    shown.save_to = flags.save_to;
    shown.viewer.view = viewer::parse_view(flags.view);
    shown.viewer.room = parse_room(flags);
    shown.viewer.people = viewer::parse_seen_people(flags.people, flags.myself);
    use_kept_settings(shown, flags.name, flags.renderer, flags.quality);
    shown.viewer.scale = parse_render_scale(flags.render_scale);
    const bool is_named = flags.name || shown.settings.now.name != client::Settings().name;
    bool asks = flags.link.empty() || (!is_named && !flags.is_alone);
    if (!flags.link.empty())
        shown.join.link = parse_link_argument(flags.link);
    window::EntryFields fields{flags.link,
                               is_named ? shown.settings.now.name : "",
                               is_named ? shown.settings.now.hears : true,
                               shown.settings.now.speaks,
                               flags.voice_may_record || shown.settings.now.voice_may_record,
                               !flags.webcam.empty()};
    cli::catch_stop_signals();
    window::DesktopWindow window("Theatron", parse_size(flags.size), without_display);
    WindowWatch watch(window);
    const auto expression = open_face(flags);
    for (std::string problem;;) {
        if (asks) {
            watch.rest();
            const auto entered = ask_entry(window, fields, problem, recent_links(), forget_link);
            if (!entered)
                return;
            fields = entered->fields;
            shown.join.link = entered->link;
            client::Settings chosen = shown.settings.now;
            shown.join.name = chosen.name = fields.name;
            chosen.hears = fields.hears;
            chosen.speaks = fields.speaks;
            chosen.voice_may_record = fields.voice_may_record;
            shown.settings.change(chosen);
        }
        std::string microphone = flags.microphone, speaker = flags.speaker;
        const client::Settings& kept = shown.settings.now;
        const bool are_kept = microphone.empty() && speaker.empty();
        if (microphone.empty() && kept.speaks)
            microphone = kept.microphone;
        if (speaker.empty() && kept.hears)
            speaker = kept.loudspeaker;
        visit::VoiceLine voice({microphone, speaker, flags.voice_frame_ms,
                                flags.push_to_talk || shown.settings.now.push_to_talk,
                                parse_cleaning(flags.echo_cancellation),
                                parse_spatial(flags.spatial_voices), are_kept});
        ViewerWindow now = shown;
        now.join.voice_may_record = flags.voice_may_record || shown.settings.now.voice_may_record;
        now.settings.keep = [&shown](const client::Settings& settings) {
            shown.settings.change(settings);
        };
        now.entered = [link = net::format_link(shown.join.link)](const std::string& session) {
            keep(client::with_newest(recent_links(), {link, session}));
        };
        now.watch = &watch;
        now.ports.voice = &voice;
        now.is_last = !asks;
        const auto publisher = open_own_cameras(flags, now.join);
        now.ports.cameras = publisher.get();
        // Off unless the person wants it now: this choice is not kept.
        publish::OwnFace face(flags.webcam.empty() ? usual_webcam : flags.webcam);
        now.ports.face = &face;
        now.ports.expression = expression.get();
        face.show(fields.shows_face);
        try {
            problem.clear();
            const WindowEnd end = show(window, std::move(now));
            if (end == WindowEnd::closed || !asks)
                return;
        } catch (const SessionEnded& ended) {
            // Nobody is there to fill in a form.
            if (flags.seconds > 0)
                throw;
            // Its last picture makes way for the form.
            asks = true;
            problem = ended.what();
            fields.link = net::format_link(shown.join.link);
        } catch (const Error& error) {
            if (!asks)
                throw;
            problem = error.what();
        }
        // The next form begins with the person's last choices.
        fields.shows_face = face.is_wanted();
        fields.hears = shown.settings.now.hears;
        fields.speaks = shown.settings.now.speaks;
        fields.voice_may_record = shown.settings.now.voice_may_record;
    }
}

void join_as_or_screen(const JoinFlags& flags) {
    client::Participant::Options options = participant_options(flags);
    // It waits for the file of its link.
    const bool waits = is_link_file(flags.link);
    if (!waits)
        options.link = parse_link_argument(flags.link);
    options.name = flags.name.value_or(or_screen_name);
    visit::VoiceLine voice({flags.microphone, flags.speaker, flags.voice_frame_ms,
                            flags.push_to_talk, parse_cleaning(flags.echo_cancellation),
                            parse_spatial(flags.spatial_voices)});
    cli::catch_stop_signals();
    window::DesktopWindow window("Theatron", parse_size(flags.size), without_display);
    show_or_screen(window, {waits ? flags.link : "", std::move(options), voice, flags.seconds});
}

}  // namespace theatron::app
