// SPDX-License-Identifier: Apache-2.0
// The flags of theatron join, and what follows from them.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/participant.h"
#include "or_screen_window.h"
#include "publish/camera_publisher.h"
#include "viewer/live_scene.h"
#include "visit/face_line.h"
#include "visit/voice_line.h"

namespace theatron::app {

// The host chooses where H.264 can be decoded here.
std::string best_color();

struct JoinFlags {
    std::string link;
    std::optional<std::string> name;  // none: the kept one in a window, else "guest"
    std::string depth_codec = "strata";
    std::string color_codec = best_color();
    std::string offscreen, depth_file;
    std::string save_to = ".";
    std::optional<std::string> renderer;  // without: viewer::automatic
    std::string size = "1280x720";
    std::string view = "camera:0";
    std::string room = "on";
    std::optional<std::string> quality;  // if given, else auto, in a window that of the last one
    std::vector<std::string> people, myself;
    std::vector<std::string> cameras, shared;  // that are sent
    std::string language = "en";               // of texts for the person
    bool stereo = false;
    double seconds = 0;
    double warmup = 0;
    double every = 0;
    unsigned target_latency_ms = 150;
    double max_mbit = 0;
    bool json = false;
    bool no_window = false;
    bool may_record = false;
    bool voice_may_record = false;
    bool push_to_talk = false;
    std::string echo_cancellation = "auto", spatial_voices = "auto";
    bool list_devices = false;
    bool or_screen = false;
    std::string relay = "on";
    std::string render_scale = "auto";
    std::string microphone, speaker;
    std::string webcam;                     // empty: the face is not shown
    std::string own_face, passphrase_file;  // a file of 'theatron face enrol'; empty: none
    std::string face, face_model;  // as visit::FaceLine::Options; empty: no expression is sent
    bool face_channels = false;
    int voice_frame_ms = 20;
    std::set<std::string> given;  // "--size", ...: all that the person wrote
    bool is_alone = false;        // nobody else is in the session, so a window asks for no name

    // Files and figures are made without a window.
    bool window() const {
        return offscreen.empty() && depth_file.empty() && every <= 0 && !json && !no_window;
    }
};

// Joins until the session or the person ends it. Throws Error with one sentence.
void run_join(const JoinFlags& flags);

// Throws Error with one sentence if an option was given that has no effect beside the others.
void refuse_unused(const JoinFlags& flags);

viewer::RoomChoice parse_room(const JoinFlags& flags);
// "auto" is 0. Throws Error with one sentence.
double parse_render_scale(const std::string& text);
std::uint32_t to_kbit(double mbit);

// All but the link, the name and the voice. Throws Error for codecs that this build does not have.
client::Participant::Options participant_options(const JoinFlags& flags);
// Adds the publisher's events to `options`; null without own cameras.
std::unique_ptr<publish::CameraPublisher> open_own_cameras(const JoinFlags& flags,
                                                           client::Participant::Options& options);
// The camera of the face: the one of --webcam, else the usual one, which is off at first.
inline constexpr const char* usual_webcam = "/dev/video0";
// Null without --face. Throws Error with one sentence.
std::unique_ptr<visit::FaceLine> open_face(const JoinFlags& flags);
visit::VoiceLine::Options::Cleaning parse_cleaning(const std::string& text);
visit::VoiceLine::Options::Spatial parse_spatial(const std::string& text);

}  // namespace theatron::app
