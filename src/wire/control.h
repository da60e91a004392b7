// SPDX-License-Identifier: Apache-2.0
// Control messages as plain structs, and their bytes (FlatBuffers, control.fbs).
//
// Each direction has a variant of its own, so a message cannot be sent the wrong way. Every struct
// lists its fields once, in the order of its table in control.fbs, texts and lists with the most
// characters or elements that they may have; encoding and decoding follow that list.
//
// Times in messages are session time unless a comment says otherwise.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/status.h"
#include "base/time.h"
#include "wire/role.h"
#include "wire/text.h"

namespace theatron::wire {

// Versions of the protocol that this build speaks.
inline constexpr std::uint16_t protocol_min = 3;
inline constexpr std::uint16_t protocol_max = 3;

// Limits of decoding, in characters and elements. Decoding makes every text clean
// (base/outside_text.h) and cuts it to its limit; a longer list makes its message malformed.
inline constexpr std::size_t max_name = 64;                // of a participant, a host, a camera
inline constexpr std::size_t max_token = 256;              // the host compares it whole
inline constexpr std::size_t max_codec = 200;              // one codec in its spelling
inline constexpr std::size_t max_renderer = 40;            // one renderer's name
inline constexpr std::size_t max_filter = 1000;            // a chain of filters in its spelling
inline constexpr std::size_t max_cameras = 63;             // at once, as many as a recording holds
inline constexpr std::size_t max_calibration_size = 4096;  // bytes of one camera's
// Most bytes in one message: of a request, of a changed object, of a part of a snapshot.
inline constexpr std::size_t max_room_request_size = 4352;
inline constexpr std::size_t max_room_object_size = 4352;
inline constexpr std::size_t max_room_part_size = 48 * 1024;
inline constexpr std::size_t max_streams = 2 * max_cameras;
// Settings of all cameras of one publisher together.
inline constexpr std::size_t max_encodings = 64;

// Numbers of optional parts of the protocol. A program skips numbers that it does
// not know.
enum class Feature : std::uint16_t {
    publish = 1,        // sends cameras
    sends_only = 2,     // is sent no cameras of others
    room = 3,           // keeps the objects of the room (session/room_replica.h)
    cases = 4,          // is told of the host's cases, and takes their content
    voice_consent = 5,  // says with VoiceConsent if others may record its voice
    adjusting = 6,      // cameras are adjusted: AdjustCamera, CameraChanged
    playback = 7,       // is told where the host's recording is, and may play it
    screens = 8,        // is told with ShareEnded that others have ended its screens
    look_back = 9,      // may look back at the last minute: LookBack
    webcam = 10,        // is told of faces (CameraFrame::face), and may send its own
    patient = 11,       // shows who the patient of the open case is, to a person who may know it
    direct = 12,        // pictures go from publisher to receiver: OfferDirect, DirectGrants
};
inline constexpr std::size_t max_features = 32;
inline constexpr std::size_t person_id_size = 16;
inline constexpr std::size_t max_visitors = 32;  // people who wait for admission at once
inline constexpr std::size_t max_offered_cases = 64;
inline constexpr std::size_t max_patient_text = 200;             // of a patient's name, of an id
inline constexpr std::size_t max_adjustment_size = 64;           // bytes of one camera's
inline constexpr std::size_t content_hash_size = 32;             // base/content_hash.h
inline constexpr std::size_t max_content_piece = 16 * 1024;      // bytes of content in one message
inline constexpr std::size_t max_content_request = 1024 * 1024;  // bytes that one request asks for

// Direct sending (docs/decisions/direct-sending.md): addresses of one publisher, receivers of one
// publisher, publishers that one receiver may connect to.
inline constexpr std::size_t max_direct_addresses = 6;
inline constexpr std::size_t max_direct_receivers = 32;
inline constexpr std::size_t max_direct_grants = 32;
inline constexpr std::size_t direct_secret_size = 32;
inline constexpr std::size_t fingerprint_size = 32;  // SHA-256 of a certificate

// A run of a host; random. Numbers of cameras and participants are of one session.
enum class SessionId : std::uint32_t {};

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

// The frame that a camera's calibration calls the room.
enum class CameraFrame : std::uint8_t {
    room = 0,
    // The head of the person who publishes the camera: the origin is between the eyes, y is up, -z
    // points where the person looks, without its slope. The person's pose moves it through the
    // room.
    person = 1,
    // None: the camera is the picture of its publisher's face, a small screen (geometry/screen.h)
    // that is drawn on the head. For those who have Feature::webcam; others cannot read it.
    face = 2,
};

// A camera that a participant offers. The host gives it its number.
struct OfferedCamera {
    std::string name;
    bool has_color = false;
    double frames_per_second = 0;
    Bytes calibration;  // geometry/calibration.h
    // Its participant agrees that others record it; else the host sends it to no recorder.
    bool may_record = false;
    CameraFrame frame{};

    static void fields(auto& m, auto&& field) {
        field(m.name, max_name);
        field(m.has_color);
        field(m.frames_per_second);
        field(m.calibration, max_calibration_size);
        field(m.may_record);
        field(m.frame);
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
    // The setting whose frames come directly from the publisher now; {}: none.
    SettingId direct{};

    static void fields(auto& m, auto&& field) {
        field(m.stream);
        field(m.newest_frame);
        field(m.frames);
        field(m.bytes);
        field(m.age);
        field(m.direct);
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

// The participant agrees that others record its voice from now on, or no longer. Until it agrees
// the host sends its voice to no recorder.
struct VoiceConsent {
    bool may_record = false;

    static void fields(auto& m, auto&& field) { field(m.may_record); }
};

// The participant listens for receivers of its cameras. The host sends receivers there, and answers
// with DirectReceivers. Port 0: it no longer listens.
struct OfferDirect {
    std::vector<std::string> addresses;  // IPv4 or IPv6, of its machine
    std::uint16_t port = 0;
    Bytes fingerprint;  // of the certificate that it shows

    static void fields(auto& m, auto&& field) {
        field(m.addresses, max_direct_addresses);
        field(m.port);
        field(m.fingerprint, fingerprint_size);
    }
};

struct Camera {
    CameraId id{};
    std::string name;
    StreamId depth_stream{};
    StreamId color_stream{};
    bool has_color = false;
    double frames_per_second = 0;
    Bytes calibration;          // geometry/calibration.h
    ParticipantId publisher{};  // 0: the host
    SessionId session{};        // to which it belongs
    bool may_record = false;    // as in OfferedCamera; always for the host's own
    CameraFrame frame{};
    // The changes by operators (session/camera_adjustment.h); the calibration contains it.
    Bytes adjustment;

    static void fields(auto& m, auto&& field) {
        field(m.id);
        field(m.name, max_name);
        field(m.depth_stream);
        field(m.color_stream);
        field(m.has_color);
        field(m.frames_per_second);
        field(m.calibration, max_calibration_size);
        field(m.publisher);
        field(m.session);
        field(m.may_record);
        field(m.frame);
        field(m.adjustment, max_adjustment_size);
    }
};

// The host's answer to Join.
struct Welcome {
    std::uint16_t protocol = 0;
    ParticipantId participant{};
    std::string host_name;
    std::vector<Camera> cameras;
    // Those of Join that hold in this session.
    std::vector<Feature> features;
    SessionId session{};

    static void fields(auto& m, auto&& field) {
        field(m.protocol);
        field(m.participant);
        field(m.host_name, max_name);
        field(m.cameras, max_cameras);
        field(m.features, max_features);
        field(m.session);
    }
};

// Cameras have joined the session. The others stay as they are.
struct CamerasAdded {
    std::vector<Camera> cameras;

    static void fields(auto& m, auto&& field) { field(m.cameras, max_cameras); }
};

// Cameras have left the session. Their numbers never come again.
struct CamerasRemoved {
    std::vector<CameraId> cameras;

    static void fields(auto& m, auto&& field) { field(m.cameras, max_cameras); }
};

// The host's answer to Publish: the numbers of the cameras, in their order. Where `problem` is not
// empty, none was taken.
struct Published {
    std::vector<CameraId> cameras;
    Text problem;

    static void fields(auto& m, auto&& field) {
        field(m.cameras, max_cameras);
        field(m.problem);
    }
};

// The host will close the connection. `in_english` is for programs of every age: theirs may be a
// protocol without `reason`, or not know its code.
struct Refused {
    std::string in_english;
    Text reason;

    static void fields(auto& m, auto&& field) {
        field(m.in_english, max_sentence);
        field(m.reason);
    }
};

struct StreamSetting {
    StreamId stream{};
    SettingId setting{};
    std::string codec;
    bool past = false;  // its pictures are not of the present: see LookBack
    bool operator==(const StreamSetting&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.stream);
        field(m.setting);
        field(m.codec, max_codec);
        field(m.past);
    }
};

// The settings of these streams for this participant from now on; others do not change. `note` is
// empty, or says why they are not the requested ones.
struct Settings {
    std::vector<StreamSetting> settings;
    Text note;

    static void fields(auto& m, auto&& field) {
        field(m.settings, max_streams);
        field(m.note);
    }
};

enum class CameraCondition : std::uint8_t { live = 0, stale = 1, ended = 2, failed = 3 };

// Said by the host about any camera, by a publisher about its own.
struct CameraState {
    CameraId camera{};
    CameraCondition condition{};
    Text problem;
    std::string filter;  // the filters that run on its depth (docs/filters.md); empty: none

    static void fields(auto& m, auto&& field) {
        field(m.camera);
        field(m.condition);
        field(m.problem);
        field(m.filter, max_filter);
    }
};

// To a publisher: how to encode its streams from now on, exactly so; streams without a setting are
// not encoded.
struct Encode {
    std::vector<StreamSetting> settings;

    static void fields(auto& m, auto&& field) { field(m.settings, max_encodings); }
};

// To a publisher: the next frame of this stream in this setting is to be a key frame.
struct EncodeKey {
    StreamId stream{};
    SettingId setting{};

    static void fields(auto& m, auto&& field) {
        field(m.stream);
        field(m.setting);
    }
};

struct Pong {
    TimePoint ping_sent;  // copied from the ping
    TimePoint received;
    TimePoint sent;

    static void fields(auto& m, auto&& field) {
        field(m.ping_sent);
        field(m.received);
        field(m.sent);
    }
};

// The ladder step of this participant: the data that the host leaves out to keep latency low.
struct Delivery {
    std::uint8_t level = 0;             // 0: all that was requested
    std::uint8_t levels = 1;            // number of levels
    std::uint8_t one_frame_of = 1;      // of so many frames one is sent
    std::string color_codec;            // coarser colour; empty: as requested
    bool lossy_outside_region = false;  // depth has bounded loss outside the region of interest
    Text reason;

    static void fields(auto& m, auto&& field) {
        field(m.level);
        field(m.levels);
        field(m.one_frame_of);
        field(m.color_codec, max_codec);
        field(m.lossy_outside_region);
        field(m.reason);
    }
};

// The host's command for this participant's renderer. Not sent before the host gives one.
struct SetRenderer {
    std::string renderer;  // as on the command line; empty: as it is
    bool locked = false;   // the participant cannot change it
    bool operator==(const SetRenderer&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.renderer, max_renderer);
        field(m.locked);
    }
};

// All objects of the room, in `parts` messages. RoomChange counts on from `revision`.
struct RoomSnapshot {
    std::uint64_t revision = 0;
    std::uint16_t part = 0, parts = 1;
    Bytes objects;              // session/room_bytes.h
    std::uint32_t decided = 0;  // the receiver's newest request that the host has decided on

    static void fields(auto& m, auto&& field) {
        field(m.revision);
        field(m.part);
        field(m.parts);
        field(m.objects, max_room_part_size);
        field(m.decided);
    }
};

// An object of the room is new or has changed; without bytes it is removed.
struct RoomChange {
    std::uint64_t revision = 0;
    std::uint32_t object = 0;
    Bytes now;  // one object as in RoomSnapshot

    static void fields(auto& m, auto&& field) {
        field(m.revision);
        field(m.object);
        field(m.now, max_room_object_size);
    }
};

// The host has decided on this participant's request of this number.
struct RoomDecision {
    std::uint32_t number = 0;
    std::uint8_t refusal = 0;  // session::Refusal

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.refusal);
    }
};

// The answer to Join where an operator decides on the participant first. Welcome or Refused
// follows.
struct Waiting {
    std::string host_name;

    static void fields(auto& m, auto&& field) { field(m.host_name, max_name); }
};

// The receiver's role from now on. A muted participant is not heard.
struct Standing {
    Role role{};
    bool muted = false;
    bool operator==(const Standing&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.role);
        field(m.muted);
    }
};

// Someone who waits for admission.
struct Visitor {
    ParticipantId participant{};
    std::string name;
    Bytes person;  // the first bytes of Join::person, by which a person is told from another
    Role role{};   // of its link
    bool records = false;  // it would record the session
    bool operator==(const Visitor&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.participant);
        field(m.name, max_name);
        field(m.person, person_id_size);
        field(m.role);
        field(m.records);
    }
};

// To operators: all who wait now.
struct Visitors {
    std::vector<Visitor> visitors;

    static void fields(auto& m, auto&& field) { field(m.visitors, max_visitors); }
};

enum class ManageRefusal : std::uint8_t {
    none = 0,
    role = 1,                 // the sender is no operator
    no_such_participant = 2,  // it has left
    not_waiting = 3,
    still_waiting = 4,  // it must be admitted first
    yourself = 5,
    too_often = 6,
    no_such_camera = 7,    // or one that cannot be adjusted
    beyond_limits = 8,     // of a camera's adjustment
    adjusting_role = 9,    // the sender may not adjust cameras
    playing_role = 10,     // the sender may not play the recording
    nothing_to_play = 11,  // the host plays no recording
    nothing_kept = 12,     // of the past that the sender may see
};

// The host has decided on the sender's Manage, AdjustCamera, Play or LookBack of this number.
struct Managed {
    std::uint32_t number = 0;
    ManageRefusal refusal{};

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.refusal);
    }
};

// The session is over. The host closes the connection, and coming back is of no use.
struct Goodbye {
    Text reason;

    static void fields(auto& m, auto&& field) { field(m.reason); }
};

// A case of the host that can be opened in the room.
struct OfferedCase {
    Bytes hash;  // of its description (medical/shared_case.h), which names all its other content
    std::string name;
    std::uint64_t bytes = 0;  // of all its content
    bool operator==(const OfferedCase&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.hash, content_hash_size);
        field(m.name, max_name);
        field(m.bytes);
    }
};

// All cases of the host, after Welcome and whenever they change.
struct OfferedCases {
    std::vector<OfferedCase> cases;

    static void fields(auto& m, auto&& field) { field(m.cases, max_offered_cases); }
};

// A piece of requested content. `total` is the size of the whole; 0: the host does not have it.
struct Content {
    Bytes hash;
    std::uint64_t offset = 0;
    std::uint64_t total = 0;
    Bytes bytes;

    static void fields(auto& m, auto&& field) {
        field(m.hash, content_hash_size);
        field(m.offset);
        field(m.total);
        field(m.bytes, max_content_piece);
    }
};

// A known camera is described anew: an operator has adjusted it. Its number and its streams are the
// same.
struct CameraChanged {
    Camera camera;

    static void fields(auto& m, auto&& field) { field(m.camera); }
};

// Where the recording is that the host plays, after Welcome and whenever it does not just go on.
struct Playback {
    Duration position{};  // since its first picture, at session time `at`
    TimePoint at;
    Duration length{};
    bool paused = false;
    std::string by;  // who changed it; empty: nobody
    bool operator==(const Playback&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.position);
        field(m.at);
        field(m.length);
        field(m.paused);
        field(m.by, max_name);
    }
};

// To a publisher: somebody has ended these of its screens for all. They are no longer in the
// session, and are not to be offered again.
struct ShareEnded {
    std::vector<CameraId> cameras;
    std::string by;  // name of the person

    static void fields(auto& m, auto&& field) {
        field(m.cameras, max_cameras);
        field(m.by, max_name);
    }
};

// The texts that identify the patient of the open case. The host sends them apart from all content,
// to people who may know them, and withdraws them with an empty message. Receivers keep them in
// memory only.
struct Patient {
    Bytes of_case;  // as in OfferedCase; empty: withdrawn
    std::string name, birth_date, id;
    bool operator==(const Patient&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.of_case, content_hash_size);
        field(m.name, max_patient_text);
        field(m.birth_date, max_patient_text);
        field(m.id, max_patient_text);
    }
};

// To a receiver: the permission to connect to this publisher for the pictures of its cameras.
struct DirectGrant {
    ParticipantId publisher{};
    std::vector<std::string> addresses;  // to be tried in this order
    std::uint16_t port = 0;
    Bytes fingerprint;  // of the certificate that the publisher shows
    Bytes secret;       // that the receiver shows
    bool operator==(const DirectGrant&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.publisher);
        field(m.addresses, max_direct_addresses + 1);
        field(m.port);
        field(m.fingerprint, fingerprint_size);
        field(m.secret, direct_secret_size);
    }
};

// All permissions of the receiver from now on.
struct DirectGrants {
    std::vector<DirectGrant> grants;
    bool operator==(const DirectGrants&) const = default;

    static void fields(auto& m, auto&& field) { field(m.grants, max_direct_grants); }
};

struct DirectReceiver {
    Bytes secret;                     // that it shows
    std::vector<SettingId> settings;  // whose frames it is sent
    bool operator==(const DirectReceiver&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.secret, direct_secret_size);
        field(m.settings, max_encodings);
    }
};

// To a publisher: all receivers that may connect to it from now on.
struct DirectReceivers {
    std::vector<DirectReceiver> receivers;
    // Nobody needs the frames of these settings from the host: they are not to be sent to it.
    std::vector<SettingId> not_to_host;
    bool operator==(const DirectReceivers&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.receivers, max_direct_receivers);
        field(m.not_to_host, max_encodings);
    }
};

// In the order of the unions in control.fbs.
using ToHost = std::variant<Join, ChooseCodecs, RequestKey, Ping, Report, ChooseDelivery, Publish,
                            Unpublish, CameraState, RoomRequest, Manage, RequestContent,
                            VoiceConsent, AdjustCamera, Play, LookBack, OfferDirect>;
using ToParticipant =
    std::variant<Welcome, Settings, CameraState, Pong, Delivery, SetRenderer, Refused, Goodbye,
                 CamerasAdded, CamerasRemoved, Published, Encode, EncodeKey, RoomSnapshot,
                 RoomChange, RoomDecision, Waiting, Standing, Visitors, Managed, OfferedCases,
                 Content, CameraChanged, Playback, ShareEnded, Patient, DirectGrants,
                 DirectReceivers>;

// A refusal with its English sentence.
Refused refused(Text reason);
// The part of the requested data that is sent, in English: "half of the frames, colour as jpeg".
std::string sent_part(const Delivery& delivery);

Bytes encode(const ToHost& message);
Bytes encode(const ToParticipant& message);

// Safe for untrusted input. Status::unsupported for a message of a newer
// protocol, which may be ignored. The result takes no more memory than max_decoded_size,
// however often the message refers to the same bytes.
inline constexpr std::size_t max_decoded_size = 1 << 20;
Result<ToHost> decode_to_host(ByteView bytes);
Result<ToParticipant> decode_to_participant(ByteView bytes);

}  // namespace theatron::wire
