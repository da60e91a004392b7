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

namespace theatron::wire {

// Versions of the protocol that this build speaks.
inline constexpr std::uint16_t protocol_min = 2;
inline constexpr std::uint16_t protocol_max = 2;

// What decoding lets through, in characters. It makes every text clean
// (base/outside_text.h) and cuts it to these; a list that is longer makes its message malformed.
inline constexpr std::size_t max_name = 64;       // of a participant, a host, a camera
inline constexpr std::size_t max_token = 256;     // the host compares it whole
inline constexpr std::size_t max_codec = 200;     // one codec in its spelling
inline constexpr std::size_t max_renderer = 40;   // one renderer's name
inline constexpr std::size_t max_sentence = 500;  // a reason, a problem, a note, a step
inline constexpr std::size_t max_filter = 1000;   // a chain of filters in its spelling
inline constexpr std::size_t max_cameras = 63;    // of one host, as many as a recording holds
inline constexpr std::size_t max_calibration_size = 4096;  // bytes of one camera's
inline constexpr std::size_t max_streams = 2 * max_cameras;

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
    // It records: it is sent everything in order, however late, and nobody else's doing changes
    // its encodings while it stays.
    bool records = false;

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
    }
};

// The participant wants other codecs from now on. An empty text keeps its codec.
struct ChooseCodecs {
    std::string depth_codec;
    std::string color_codec;

    static void fields(auto& m, auto&& field) {
        field(m.depth_codec, max_codec);
        field(m.color_codec, max_codec);
    }
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

    static void fields(auto& m, auto&& field) {
        field(m.stream);
        field(m.newest_frame);
        field(m.frames);
        field(m.bytes);
        field(m.age);
    }
};

// Sent by participants a few times a second.
struct Report {
    std::vector<StreamReport> streams;
    std::string renderer;  // how it draws now; empty: it does not, or does not tell

    static void fields(auto& m, auto&& field) {
        field(m.streams, max_streams);
        field(m.renderer, max_renderer);
    }
};

// What the host should aim at for this participant from now on.
struct ChooseDelivery {
    std::uint32_t target_latency_ms = 0;  // age of what is shown; 0: never leave anything out
    std::uint32_t max_kbit_per_s = 0;     // 0: no ceiling

    static void fields(auto& m, auto&& field) {
        field(m.target_latency_ms);
        field(m.max_kbit_per_s);
    }
};

struct Camera {
    CameraId id{};
    std::string name;
    StreamId depth_stream{};
    StreamId color_stream{};
    bool has_color = false;
    double frames_per_second = 0;
    Bytes calibration;  // geometry/calibration.h

    static void fields(auto& m, auto&& field) {
        field(m.id);
        field(m.name, max_name);
        field(m.depth_stream);
        field(m.color_stream);
        field(m.has_color);
        field(m.frames_per_second);
        field(m.calibration, max_calibration_size);
    }
};

// The host's answer to Join.
struct Welcome {
    std::uint16_t protocol = 0;
    ParticipantId participant{};
    std::string host_name;
    std::vector<Camera> cameras;

    static void fields(auto& m, auto&& field) {
        field(m.protocol);
        field(m.participant);
        field(m.host_name, max_name);
        field(m.cameras, max_cameras);
    }
};

// The host will close the connection; `reason` is one sentence for the user.
struct Refused {
    std::string reason;

    static void fields(auto& m, auto&& field) { field(m.reason, max_sentence); }
};

struct StreamSetting {
    StreamId stream{};
    SettingId setting{};
    std::string codec;
    bool operator==(const StreamSetting&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.stream);
        field(m.setting);
        field(m.codec, max_codec);
    }
};

// What this participant now gets. `note` is empty or says why it is not what
// was asked for.
struct Settings {
    std::vector<StreamSetting> settings;
    std::string note;

    static void fields(auto& m, auto&& field) {
        field(m.settings, max_streams);
        field(m.note, max_sentence);
    }
};

enum class CameraCondition : std::uint8_t { live = 0, stale = 1, ended = 2, failed = 3 };

struct CameraState {
    CameraId camera{};
    CameraCondition condition{};
    std::string problem;
    std::string filter;  // the filters that run on its depth (docs/filters.md); empty: none

    static void fields(auto& m, auto&& field) {
        field(m.camera);
        field(m.condition);
        field(m.problem, max_sentence);
        field(m.filter, max_filter);
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

// What the host leaves out for this participant so that the newest stays new.
struct Delivery {
    std::uint8_t level = 0;   // 0: all that was asked for
    std::uint8_t levels = 1;  // how many there are
    std::string what;         // "half of the frames", for people
    std::string reason;       // "frames were too old", for people

    static void fields(auto& m, auto&& field) {
        field(m.level);
        field(m.levels);
        field(m.what, max_sentence);
        field(m.reason, max_sentence);
    }
};

// How the host wants this participant to draw from now on. Not sent until the host has a wish.
struct SetRenderer {
    std::string renderer;  // as on the command line; empty: as it is
    bool locked = false;   // the participant cannot change it
    bool operator==(const SetRenderer&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.renderer, max_renderer);
        field(m.locked);
    }
};

// The session is over; `reason` is one sentence for the user. The host closes the connection,
// and coming back is of no use.
struct Goodbye {
    std::string reason;

    static void fields(auto& m, auto&& field) { field(m.reason, max_sentence); }
};

// In the order of the unions in control.fbs.
using ToHost = std::variant<Join, ChooseCodecs, RequestKey, Ping, Report, ChooseDelivery>;
using ToParticipant =
    std::variant<Welcome, Settings, CameraState, Pong, Delivery, SetRenderer, Refused, Goodbye>;

Bytes encode(const ToHost& message);
Bytes encode(const ToParticipant& message);

// Safe for untrusted input. Status::unsupported for a message of a newer
// protocol, which may be ignored. What is returned takes no more memory than max_decoded_size,
// however often the message refers to the same bytes.
inline constexpr std::size_t max_decoded_size = 1 << 20;
Result<ToHost> decode_to_host(ByteView bytes);
Result<ToParticipant> decode_to_participant(ByteView bytes);

}  // namespace theatron::wire
