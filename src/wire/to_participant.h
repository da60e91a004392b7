// SPDX-License-Identifier: Apache-2.0
// The messages of the host to participants (wire/control.h).
#pragma once

#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "wire/protocol.h"
#include "wire/role.h"
#include "wire/text.h"
#include "wire/to_host.h"

namespace theatron::wire {

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
    CameraKind kind{};
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
        field(m.kind);
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

// Cameras have left the session. `interrupted`: nobody has decided it; their publisher's connection
// broke, and pictures are missing until they come back under other numbers, if they do.
struct CamerasRemoved {
    std::vector<CameraId> cameras;
    bool interrupted = false;

    static void fields(auto& m, auto&& field) {
        field(m.cameras, max_cameras);
        field(m.interrupted);
    }
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
    std::uint8_t one_frame_of = 1;      // one frame in this number is sent
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
    shows_no_study = 13,   // the participant's program does not know studies
    other_study = 14,      // the participant takes part in one that another operator leads
    no_such_codec = 15,    // in a condition
    large_step = 16,       // of a study: it does not fit into a message
    draws_flat = 17,       // a condition names what the participant's view does not have
};
inline constexpr ManageRefusal last_manage_refusal = ManageRefusal::draws_flat;

// The host has decided on the sender's Manage, AdjustCamera, Play, LookBack, ShowStudy or
// SetCondition of this number.
struct Managed {
    std::uint32_t number = 0;
    ManageRefusal refusal{};

    static void fields(auto& m, auto&& field) {
        field(m.number);
        field(m.refusal);
    }
};

// The session is over. The host closes the connection, and coming back is of no use, except where
// the reason is TextCode::host_may_return.
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
    std::string study_date;  // of its images; several are separated by commas
    bool operator==(const Patient&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.of_case, content_hash_size);
        field(m.name, max_patient_text);
        field(m.birth_date, max_patient_text);
        field(m.id, max_patient_text);
        field(m.study_date, max_patient_text);
    }
};

// The answer to AskPatient; without texts if nobody knows them, or this person may not.
struct AskedPatient {
    Patient patient;

    static void fields(auto& m, auto&& field) { field(m.patient); }
};

// To the operator whose program leads a study: the reply of this participant.
struct StudyReplied {
    ParticipantId participant{};
    StudyReply reply;
    bool operator==(const StudyReplied&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.participant);
        field(m.reply);
    }
};

// A message that somebody has written to all.
struct ChatMessage {
    std::uint64_t id = 0;  // as in WriteChat
    ParticipantId participant{};
    std::string name;  // as it was then
    std::string text;
    TimePoint at;  // when the host had it
    bool operator==(const ChatMessage&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.id);
        field(m.participant);
        field(m.name, max_name);
        field(m.text, max_chat_text);
        field(m.at);
    }
};

// New messages, the oldest first; after Welcome those that this run of the program may have missed.
struct ChatMessages {
    std::vector<ChatMessage> messages;

    static void fields(auto& m, auto&& field) { field(m.messages, max_chat_messages); }
};

// To a receiver: the permission to connect to this relay for all pictures, which come sealed
// (net/sealed_media.h).
struct RelayGrant {
    ParticipantId relay{};
    std::vector<std::string> addresses;  // to be tried in this order
    std::uint16_t port = 0;
    Bytes fingerprint;  // of the certificate that the relay shows
    Bytes secret;       // that the receiver shows
    std::uint32_t key_number = 0;
    Bytes key;  // of the session; pictures sealed with the one before may still be on the way
    bool operator==(const RelayGrant&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.relay);
        field(m.addresses, max_relay_addresses);
        field(m.port);
        field(m.fingerprint, fingerprint_size);
        field(m.secret, relay_secret_size);
        field(m.key_number);
        field(m.key, media_key_size);
    }
};

// All permissions of the receiver from now on.
struct RelayGrants {
    std::vector<RelayGrant> grants;
    bool operator==(const RelayGrants&) const = default;

    static void fields(auto& m, auto&& field) { field(m.grants, max_relay_grants); }
};

struct RelayReceiver {
    Bytes secret;                     // that it shows
    std::vector<SettingId> settings;  // whose frames it is sent
    ParticipantId participant{};
    Bytes layers;                      // for each of `settings` the highest that it is sent
    std::uint32_t max_kbit_per_s = 0;  // 0: no ceiling
    bool operator==(const RelayReceiver&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.secret, relay_secret_size);
        field(m.settings, max_relay_settings);
        field(m.participant);
        field(m.layers, max_relay_settings);
        field(m.max_kbit_per_s);
    }
};

// To a relay: all receivers that may connect to it from now on.
struct RelayReceivers {
    std::vector<RelayReceiver> receivers;
    std::vector<SettingId> retired;  // of earlier versions; empty
    bool operator==(const RelayReceivers&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.receivers, max_relay_receivers);
        field(m.retired, max_encodings);
    }
};

}  // namespace theatron::wire
