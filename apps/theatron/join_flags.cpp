// SPDX-License-Identifier: Apache-2.0
#include "join_flags.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.h"
#include "base/log.h"
#include "client/person_id.h"
#include "files/state_folder.h"
#include "published_cameras.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"
#include "viewer_window.h"
#include "visit/face_files.h"
#include "visit/shown_face.h"

namespace theatron::app {

std::string best_color() {
    const auto h264 = video::parse_color_setting("h264").setting;
    return video::missing_color_decoder(h264).empty() ? std::string(video::auto_color)
                                                      : video::ColorSetting().text;
}

namespace {

// A codec setting in one spelling. Throws Error with one sentence if this build does not have it.
std::string checked_color(const std::string& text) {
    const bool automatic = text == video::auto_color;
    const auto parsed = video::parse_color_setting(automatic ? "h264" : text);
    for (const std::string& problem :
         {parsed.problem, video::missing_color_decoder(parsed.setting)})
        if (!problem.empty())
            throw Error(problem);
    return automatic ? text : parsed.setting.text;
}

struct Use {
    const char* option;
    bool is_used;
    const char* what;  // the end of a sentence
};

}  // namespace

void refuse_unused(const JoinFlags& flags) {
    const bool or_screen = flags.or_screen && (flags.window() || !flags.offscreen.empty());
    const bool file = !flags.offscreen.empty() || !flags.depth_file.empty();
    const bool view = (flags.window() || file) && !or_screen;
    const bool usual_window = flags.window() && !or_screen;
    // The panel of that window opens a microphone and a loudspeaker later, too.
    const bool speaks = usual_window || !flags.microphone.empty();
    const bool hears = usual_window || !flags.speaker.empty();
    constexpr const char* picture =
        "is about a picture of the clouds: it needs a window or --offscreen, and no --or-screen.";
    constexpr const char* window = "is about the usual window, which does not open here.";
    constexpr const char* voice = "is about what you say: it needs --microphone.";
    const Use uses[] = {
        {"--depth", !or_screen, "is about a picture of the clouds: it goes without --or-screen."},
        {"--stereo", file && !or_screen,
         "is about a picture in a file: it needs --offscreen or --depth, and no --or-screen."},
        {"--view", view, picture},
        {"--renderer", view, picture},
        {"--room", view, picture},
        {"--quality", view, picture},
        {"--person", view, picture},
        {"--myself", view, picture},
        {"--size", flags.window() || file, "is about a picture: it needs a window or --offscreen."},
        {"--save-to", usual_window, window},
        {"--render-scale", usual_window, window},
        {"--warmup", !flags.window(), "is about figures: it needs --json, --every or a file."},
        {"--push-to-talk", speaks, voice},
        {"--voice-frame", speaks, voice},
        {"--echo-cancellation", speaks, voice},
        {"--face", !or_screen, "is about how the others see you: it goes without --or-screen."},
        {"--face-model", !flags.face.empty(), "is about what your face shows: it needs --face."},
        {"--face-channels", !flags.face.empty(), "is about what your face shows: it needs --face."},
        {"--own-face", !flags.face.empty(),
         "needs --face: a tracker, voice or actor, that moves it."},
        {"--passphrase-file", !flags.own_face.empty(), "is about --own-face: it needs that."},
        {"--spatial-voices", hears, "is about what you hear: it needs --speaker."},
    };
    for (const Use& use : uses)
        if (flags.given.contains(use.option) && !use.is_used)
            throw Error(std::string(use.option) + " " + use.what);
}

viewer::RoomChoice parse_room(const JoinFlags& flags) {
    viewer::RoomChoice choice;
    choice.shown = flags.room == "on";
    choice.quality = parse_quality(flags.quality.value_or("auto"));
    return choice;
}

double parse_render_scale(const std::string& text) {
    if (text == "auto")
        return 0;
    char* end = nullptr;
    const double scale = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !(scale >= 0.1 && scale <= 1))
        throw Error("The render scale '" + text + "' is neither auto nor between 0.1 and 1.");
    return scale;
}

std::uint32_t to_kbit(double mbit) {
    return std::uint32_t(std::clamp(mbit * 1000, 0.0, 4e9));
}

client::Participant::Options participant_options(const JoinFlags& flags) {
    client::Participant::Options options;
    const auto depth = video::parse_depth_setting(flags.depth_codec);
    for (const std::string& problem : {depth.problem, video::missing_depth_decoder(depth.setting)})
        if (!problem.empty())
            throw Error(problem);
    options.depth_codec = depth.setting.text;
    options.color_codec = checked_color(flags.color_codec);
    options.delivery = {flags.target_latency_ms, to_kbit(flags.max_mbit)};
    options.person = client::load_or_make_person_id(files::state_folder());
    options.remark = [](const std::string& text) { log::say(text); };
    options.keeps_room = true;
    options.keeps_cases = true;
    options.knows_studies = !flags.or_screen;
    options.shows_chat = true;
    // A service keeps what its programs print; messages are for a person at a terminal. The OR
    // screen shows them.
    if (!flags.or_screen)
        options.written = [](const std::string& text) {
            if (isatty(STDERR_FILENO))
                log::say(text);
        };
    options.voice_may_record = flags.voice_may_record;
    options.takes_faces = !flags.or_screen;
    options.takes_own_faces = true;
    options.by_relay = flags.relay == "on";
    return options;
}

std::unique_ptr<publish::CameraPublisher> open_own_cameras(const JoinFlags& flags,
                                                           client::Participant::Options& options) {
    const std::vector<std::string> cameras = with_shared(flags.cameras, flags.shared);
    if (cameras.empty() && flags.may_record)
        throw Error("--may-record is about what you send: it needs --publish or --share.");
    if (cameras.empty())
        return nullptr;
    auto publisher = open_published(cameras, {}, "", {flags.may_record, wire::CameraKind::person});
    options.publishing = publisher->events();
    return publisher;
}

std::unique_ptr<visit::FaceLine> open_face(const JoinFlags& flags) {
    if (flags.face.empty())
        return nullptr;
    visit::FaceLine::Options options{flags.face, flags.face_model, flags.face_channels, nullptr};
    if (!flags.own_face.empty()) {
        // A wrong file is told before a passphrase is asked for.
        visit::require_own_face(flags.own_face);
        const auto own = visit::read_own_face(flags.own_face,
                                              visit::face_passphrase(flags.passphrase_file, false));
        options.own_face = std::make_shared<const Bytes>(visit::shown_face(own, flags.own_face));
    }
    return std::make_unique<visit::FaceLine>(options);
}

visit::VoiceLine::Options::Cleaning parse_cleaning(const std::string& text) {
    using Cleaning = visit::VoiceLine::Options::Cleaning;
    return text == "on" ? Cleaning::on : text == "off" ? Cleaning::off : Cleaning::automatic;
}

visit::VoiceLine::Options::Spatial parse_spatial(const std::string& text) {
    using Spatial = visit::VoiceLine::Options::Spatial;
    return text == "on" ? Spatial::on : text == "off" ? Spatial::off : Spatial::automatic;
}

}  // namespace theatron::app
