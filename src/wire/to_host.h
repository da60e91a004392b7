// SPDX-License-Identifier: Apache-2.0
// The messages of participants to the host (wire/control.h).
#pragma once

#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "wire/protocol.h"
#include "wire/role.h"
#include "wire/text.h"

namespace theatron::wire {

// The first message of a participant.
struct Join {
    std::uint16_t protocol_min = wire::protocol_min;
    std::uint16_t protocol_max = wire::protocol_max;
    std::string token;
    std::string name;
    std::string depth_codec;  // as on the command line: "trvl"
    std::string color_codec;
    std::uint32_t target_latency_ms = 0;  // as in ChooseDelivery
    std::uint32_t max_kbit_per_s = 0;
    // The participant records: it gets everything in order, however late, and no other participant
    // changes its encodings while it stays.
    bool records = false;
    // The optional parts of the protocol that this program supports.
    std::vector<Feature> features;
    // 16 random bytes that this person's program keeps; empty: it keeps none. They are equal in all
    // of its connections, whereas a participant's number changes.
    Bytes person;
    // A random number that a program makes when it begins, and sends on each of its connections to
    // this session; 0: it has none. By it the host knows which connection takes whose place.
    std::uint64_t run = 0;

    static void fields(auto& m, auto&& field) {
        field(m.protocol_min);
        field(m.protocol_max);
        field(m.token, max_token);
        field(m.name, max_name);
        field(m.depth_codec, max_codec);
        field(m.color_codec, max_codec);
        field(m.target_latency_ms);
        field(m.max_kbit_per_s);
        field(m.records);
        field(m.features, max_features);
        field(m.person, person_id_size);
        field(m.run);
    }
};

// The participant requests other codecs. An empty text keeps its codec.
struct ChooseCodecs {
    std::string depth_codec;
    std::string color_codec;
    // For these cameras only. Empty: for all, also for later ones; choices for single cameras are
    // then removed.
    std::vector<CameraId> cameras;

    static void fields(auto& m, auto&& field) {
        field(m.depth_codec, max_codec);
        field(m.color_codec, max_codec);
        field(m.cameras, max_cameras);
    }
};

// The subject of a camera. By it a receiver knows which frame its calibration calls the room.
enum class CameraKind : std::uint8_t {
    // The room itself.
    room = 0,
    // Its publisher. The frame is that of the publisher's head: the origin is between the eyes, y
    // is up, -z points where the person looks, without its slope. The person's pose moves it
    // through the room.
    person = 1,
    // Its publisher's face, as a small screen (geometry/screen.h) that is drawn on the head: there
    // is no frame. For those who have Feature::webcam; others cannot read it.
    face = 2,
    // A screen of the room whose pictures come as JPEG alone, as a browser makes them
    // (session/own_pictures.h). In offers alone, to a host with Feature::shows_screen; the host
    // announces it as a screen like any other, of kind `room`.
    screen = 3,
};

// A camera that a participant offers. The host gives it its number.
struct OfferedCamera {
    std::string name;
    bool has_color = false;
    double frames_per_second = 0;
    Bytes calibration;  // geometry/calibration.h
    // Its participant agrees that others record it; else the host sends it to no recorder.
    bool may_record = false;
    CameraKind kind{};

    static void fields(auto& m, auto&& field) {
        field(m.name, max_name);
        field(m.has_color);
        field(m.frames_per_second);
        field(m.calibration, max_calibration_size);
        field(m.may_record);
        field(m.kind);
    }
};

// The participant offers to send these cameras. The host answers with Published.
struct Publish {
    std::vector<OfferedCamera> cameras;

    static void fields(auto& m, auto&& field) { field(m.cameras, max_cameras); }
};

// The participant takes these of its cameras out of the session.
struct Unpublish {
    std::vector<CameraId> cameras;

    static void fields(auto& m, auto&& field) { field(m.cameras, max_cameras); }
};

// The participant lost the reference frame of this stream.
struct RequestKey {
    StreamId stream{};
    SettingId setting{};

    static void fields(auto& m, auto&& field) {
        field(m.stream);
        field(m.setting);
    }
};

struct Ping {
    TimePoint sent;  // the participant's own steady clock

    static void fields(auto& m, auto&& field) { field(m.sent); }
};

struct StreamReport {
    StreamId stream{};
    FrameNumber newest_frame = 0;
    std::uint32_t frames = 0;
    std::uint64_t bytes = 0;
    Duration age{};  // of the newest frame when it was decoded
    // The setting whose frames come from a relay now; {}: none.
    SettingId relayed{};

    static void fields(auto& m, auto&& field) {
        field(m.stream);
        field(m.newest_frame);
        field(m.frames);
        field(m.bytes);
        field(m.age);
        field(m.relayed);
    }
};

// Sent by participants a few times a second.
struct Report {
    std::vector<StreamReport> streams;
    std::string renderer;  // the current one; empty: it does not draw, or does not report it

    static void fields(auto& m, auto&& field) {
        field(m.streams, max_streams);
        field(m.renderer, max_renderer);
    }
};

// The goal of the host for this participant from now on.
struct ChooseDelivery {
    std::uint32_t target_latency_ms = 0;  // age of the shown picture; 0: leave nothing out
    std::uint32_t max_kbit_per_s = 0;     // 0: no ceiling

    static void fields(auto& m, auto&& field) {
        field(m.target_latency_ms);
        field(m.max_kbit_per_s);
    }
};

// A request to change the room. The host answers with the changes and then with RoomDecision.
// Number 0 without a request asks for a snapshot.
struct RoomRequest {
    std::uint32_t number = 0;  // counts this participant's requests from 1
    Bytes request;             // session/room_bytes.h

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.request, max_room_request_size);
    }
};

enum class ManageAction : std::uint8_t {
    admit = 1,      // a visitor
    turn_away = 2,  // a visitor
    mute = 3,
    unmute = 4,
    set_role = 5,     // to Manage::role
    remove = 6,       // until the session ends
    revoke_link = 7,  // the link of this participant: all who came by it are removed
    end_session = 8,  // for all; without a participant
    // 9: clear_objects.h
    lower_hand = 10,  // takes down the hand that the participant has raised
};

// A decision of an operator on a participant. The host answers with Managed.
struct Manage {
    std::uint32_t number = 0;  // counts this participant's decisions from 1
    ManageAction action{};
    ParticipantId participant{};
    Role role{};

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.action);
        field(m.participant);
        field(m.role);
    }
};

// An operator adjusts a camera. The host answers with CameraChanged to all, and with Managed.
struct AdjustCamera {
    std::uint32_t number = 0;  // counts on with those of Manage
    CameraId camera{};
    Bytes adjustment;  // session/camera_adjustment.h; empty: none any more

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.camera);
        field(m.adjustment, max_adjustment_size);
    }
};

enum class PlayAction : std::uint8_t {
    pause = 1,
    resume = 2,
    seek = 3,  // to Play::position; goes on, or stays paused
};

// The participant plays the recording that the host shows to all. The host answers with Managed,
// and with Playback to all.
struct Play {
    std::uint32_t number = 0;  // as in AdjustCamera
    PlayAction action{};
    Duration position{};  // since the recording's first picture; kept within its length

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.action);
        field(m.position);
    }
};

// The participant is shown the cameras of the room as they were `ago`, which goes on from there, or
// with 0 the present again; the others are not concerned. The host answers with Settings and with
// Managed.
struct LookBack {
    std::uint32_t number = 0;  // as in AdjustCamera
    Duration ago{};

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.ago);
    }
};

// The participant asks for `count` bytes of this content from `offset` on. The host answers with
// Content messages, in order.
struct RequestContent {
    Bytes hash;
    std::uint64_t offset = 0;
    std::uint32_t count = 0;

    static void fields(auto& m, auto&& field) {
        field(m.hash, content_hash_size);
        field(m.offset);
        field(m.count);
    }
};

// The participant asks who the patient of this offered case is, before it opens it.
struct AskPatient {
    Bytes of_case;  // as in OfferedCase

    static void fields(auto& m, auto&& field) { field(m.of_case, content_hash_size); }
};

// The participant agrees that others record its voice from now on, or no longer. Until it agrees
// the host sends its voice to no recorder.
struct VoiceConsent {
    bool may_record = false;

    static void fields(auto& m, auto&& field) { field(m.may_record); }
};

// A relay listens for receivers. The host sends receivers there, and answers with RelayReceivers.
// Port 0: it no longer listens.
struct OfferRelay {
    std::vector<std::string> addresses;  // under which receivers reach it: names, IPv4 or IPv6
    std::uint16_t port = 0;
    Bytes fingerprint;  // of the certificate that it shows
    // IPv4 networks ("10.2.0.0/16") of the receivers that it is for; empty: of all.
    std::vector<std::string> networks;

    static void fields(auto& m, auto&& field) {
        field(m.addresses, max_relay_addresses);
        field(m.port);
        field(m.fingerprint, fingerprint_size);
        field(m.networks, max_relay_networks);
    }
};

// The link of one receiver, since the report before: see session::LinkMeasure.
struct RelayLink {
    ParticipantId participant{};
    std::uint32_t kbit_per_s = 0;
    Duration round_trip{}, delay{};
    std::uint32_t dropped = 0;  // frames
    bool takes_nothing = false;
    bool operator==(const RelayLink&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.participant);
        field(m.kbit_per_s);
        field(m.round_trip);
        field(m.delay);
        field(m.dropped);
        field(m.takes_nothing);
    }
};

// Sent by a relay ten times a second, and when it needs a key frame.
struct RelayReport {
    std::vector<RelayLink> links;
    std::vector<RequestKey> keys;

    static void fields(auto& m, auto&& field) {
        field(m.links, max_relay_receivers);
        field(m.keys, max_encodings);
    }
};

// The parts of a step that a surface shows; src/study has all kinds of steps.
enum class StudyKind : std::uint8_t {
    interrupted = 0,  // nobody leads the study at present: nothing can be replied
    consent = 1,      // yes (1) or no (0)
    read = 2,         // done
    watch = 3,        // done, but not before StudyStep::watch is over
    number = 4,       // from lowest to highest
    yes_no = 5,
    rating = 6,  // from lowest to highest in steps
    choice = 7,  // 1 to the number of choices
    over = 8,    // the study has ended; nothing can be replied
};

struct StudyText {
    std::string text;
    bool operator==(const StudyText&) const = default;

    static void fields(auto& m, auto&& field) { field(m.text, max_study_text); }
};

// The step that a participant of a study sees from now on.
struct StudyStep {
    std::uint32_t step = 0, steps = 0;  // "4 of 31", from 1 on; a reply names the step
    StudyKind kind{};
    std::vector<StudyText> texts;  // paragraphs
    std::vector<StudyText> choices;
    std::string left, right;  // what the lowest and the highest point mean
    std::int32_t lowest = 0, highest = 0, step_size = 1;
    Duration watch{}, limit{};  // what is left of both; 0: none
    std::string problem;        // why the last reply was not taken; empty: none
    bool operator==(const StudyStep&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.step);
        field(m.steps);
        field(m.kind);
        field(m.texts, max_study_texts);
        field(m.choices, max_study_choices);
        field(m.left, max_study_text);
        field(m.right, max_study_text);
        field(m.lowest);
        field(m.highest);
        field(m.step_size);
        field(m.watch);
        field(m.limit);
        field(m.problem, max_sentence);
    }
};

// An operator's program, which leads a study, shows a step to a participant. The host answers with
// Managed.
struct ShowStudy {
    std::uint32_t number = 0;  // as in AdjustCamera
    ParticipantId participant{};
    StudyStep step;

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.participant);
        field(m.step);
    }
};

enum class StudyAction : std::uint8_t {
    answer = 1,  // with a value, or where there is nothing to answer: done
    skip = 2,    // the question is left out
    stop = 3,    // the participant ends the study
};

// The reply to the step of this number; to any other one it changes nothing.
struct StudyReply {
    std::uint32_t step = 0;
    StudyAction action = StudyAction::answer;
    std::int32_t value = 0;
    bool operator==(const StudyReply&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.step);
        field(m.action);
        field(m.value);
    }
};

// An operator sets how a participant sees the session. An empty text: as the participant asks for
// it. The host answers with Managed.
struct SetCondition {
    std::uint32_t number = 0;  // as in AdjustCamera
    ParticipantId participant{};
    std::string renderer, depth_codec, color_codec;
    // By which everything is late, to the participant and from it.
    Duration latency{};
    bool locked = false;  // the participant cannot change what is set
    bool operator==(const SetCondition&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.participant);
        field(m.renderer, max_renderer);
        field(m.depth_codec, max_codec);
        field(m.color_codec, max_codec);
        field(m.latency);
        field(m.locked);
    }
};

// The participant writes to all others. The host sends it back to all, its sender included, with
// ChatMessages. The sender repeats it until then: `id` is random, and the host takes it once.
struct WriteChat {
    std::uint64_t id = 0;
    std::string text;
    bool operator==(const WriteChat&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.id);
        field(m.text, max_chat_text);
    }
};

// The participant raises a hand, or takes it down. The others see it as a fact about its person
// (session/room_bytes.h). It ends with the connection.
struct RaiseHand {
    bool raised = false;

    static void fields(auto& m, auto&& field) { field(m.raised); }
};

enum class CameraCondition : std::uint8_t { live = 0, stale = 1, ended = 2, failed = 3 };

// Said by the host about any camera, by a publisher about its own.
struct CameraState {
    CameraId camera{};
    CameraCondition condition{};
    Text problem;
    std::string filter;  // the filters that run on its depth (docs/filters.md); empty: none
    // "cpu" or the name of the GPU on which they run; empty: not known.
    std::string filter_device = {};

    static void fields(auto& m, auto&& field) {
        field(m.camera);
        field(m.condition);
        field(m.problem);
        field(m.filter, max_filter);
        field(m.filter_device, max_filter_device);
    }
};

}  // namespace theatron::wire
