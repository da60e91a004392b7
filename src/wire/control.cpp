// SPDX-License-Identifier: Apache-2.0
#include "wire/control.h"

#include <flatbuffers/flatbuffers.h>

#include "base/outside_text.h"
#include "control_generated.h"

namespace theatron::wire {
namespace {

using Builder = flatbuffers::FlatBufferBuilder;
using Body = flatbuffers::Offset<void>;

// One overload per message: from struct to table.

Body pack(Builder& b, const Join& m) {
    return fbs::CreateJoin(b, m.protocol_min, m.protocol_max, b.CreateString(m.token),
                           b.CreateString(m.name), b.CreateString(m.depth_codec),
                           b.CreateString(m.color_codec), m.target_latency_ms, m.max_kbit_per_s,
                           m.records)
        .Union();
}

Body pack(Builder& b, const ChooseCodecs& m) {
    return fbs::CreateChooseCodecs(b, b.CreateString(m.depth_codec), b.CreateString(m.color_codec))
        .Union();
}

Body pack(Builder& b, const RequestKey& m) {
    return fbs::CreateRequestKey(b, std::uint16_t(m.stream), std::uint16_t(m.setting)).Union();
}

Body pack(Builder& b, const Ping& m) {
    return fbs::CreatePing(b, to_us(m.sent)).Union();
}

Body pack(Builder& b, const Report& m) {
    std::vector<flatbuffers::Offset<fbs::StreamReport>> streams;
    for (const StreamReport& s : m.streams)
        streams.push_back(fbs::CreateStreamReport(b, std::uint16_t(s.stream), s.newest_frame,
                                                  s.frames, s.bytes, s.age.count()));
    return fbs::CreateReport(b, b.CreateVector(streams), b.CreateString(m.renderer)).Union();
}

Body pack(Builder& b, const Welcome& m) {
    std::vector<flatbuffers::Offset<fbs::Camera>> cameras;
    for (const Camera& c : m.cameras) {
        const auto calibration = b.CreateVector(
            reinterpret_cast<const std::uint8_t*>(c.calibration.data()), c.calibration.size());
        cameras.push_back(fbs::CreateCamera(
            b, std::uint16_t(c.id), b.CreateString(c.name), std::uint16_t(c.depth_stream),
            std::uint16_t(c.color_stream), c.has_color, c.frames_per_second, calibration));
    }
    return fbs::CreateWelcome(b, m.protocol, std::uint32_t(m.participant),
                              b.CreateString(m.host_name), b.CreateVector(cameras))
        .Union();
}

Body pack(Builder& b, const Refused& m) {
    return fbs::CreateRefused(b, b.CreateString(m.reason)).Union();
}

Body pack(Builder& b, const Settings& m) {
    std::vector<flatbuffers::Offset<fbs::Setting>> settings;
    for (const StreamSetting& s : m.settings)
        settings.push_back(fbs::CreateSetting(b, std::uint16_t(s.stream), std::uint16_t(s.setting),
                                              b.CreateString(s.codec)));
    return fbs::CreateSettings(b, b.CreateVector(settings), b.CreateString(m.note)).Union();
}

Body pack(Builder& b, const CameraState& m) {
    return fbs::CreateCameraState(b, std::uint16_t(m.camera), std::uint8_t(m.condition),
                                  b.CreateString(m.problem), b.CreateString(m.filter))
        .Union();
}

Body pack(Builder& b, const Pong& m) {
    return fbs::CreatePong(b, to_us(m.ping_sent), to_us(m.received), to_us(m.sent)).Union();
}

Body pack(Builder& b, const Received& m) {
    return fbs::CreateReceived(b, m.media_bytes).Union();
}

Body pack(Builder& b, const ChooseDelivery& m) {
    return fbs::CreateChooseDelivery(b, m.target_latency_ms, m.max_kbit_per_s).Union();
}

Body pack(Builder& b, const Delivery& m) {
    return fbs::CreateDelivery(b, m.level, m.levels, b.CreateString(m.what),
                               b.CreateString(m.reason))
        .Union();
}

Body pack(Builder& b, const SetRenderer& m) {
    return fbs::CreateSetRenderer(b, b.CreateString(m.renderer), m.locked).Union();
}

Body pack(Builder& b, const Goodbye& m) {
    return fbs::CreateGoodbye(b, b.CreateString(m.reason)).Union();
}

// The union's numbers follow the order of the variant's alternatives, from 1.
static_assert(int(fbs::Body::Join) == 1 && int(fbs::Body::Goodbye) == 15);
static_assert(std::variant_size_v<Control> == 15);

// From table to struct. Strings and vectors may be absent. Tables may share strings and vectors,
// so each field has a limit of its own: the size of the message limits nothing.

std::string text(const flatbuffers::String* s, std::size_t max_characters) {
    return s ? clean_text(s->string_view(), max_characters) : std::string();
}

template <class Vector>
bool too_long(const Vector* vector, std::size_t limit) {
    return vector && vector->size() > limit;
}

Join unpack(const fbs::Join& m) {
    return {m.protocol_min(),
            m.protocol_max(),
            text(m.token(), max_token),
            text(m.name(), max_name),
            text(m.depth_codec(), max_codec),
            text(m.color_codec(), max_codec),
            m.target_latency_ms(),
            m.max_kbit_per_s(),
            m.records()};
}

ChooseCodecs unpack(const fbs::ChooseCodecs& m) {
    return {text(m.depth_codec(), max_codec), text(m.color_codec(), max_codec)};
}

RequestKey unpack(const fbs::RequestKey& m) {
    return {StreamId(m.stream()), SettingId(m.setting())};
}

Ping unpack(const fbs::Ping& m) {
    return {from_us(m.sent_us())};
}

Report unpack(const fbs::Report& m) {
    Report report;
    if (m.streams())
        for (const auto* s : *m.streams())
            report.streams.push_back({StreamId(s->stream()), s->newest_frame(), s->frames(),
                                      s->bytes(), Duration(s->age_us())});
    report.renderer = text(m.renderer(), max_renderer);
    return report;
}

Welcome unpack(const fbs::Welcome& m) {
    Welcome welcome{
        m.protocol(), ParticipantId(m.participant()), text(m.host_name(), max_name), {}};
    if (m.cameras())
        for (const auto* c : *m.cameras()) {
            Camera camera{CameraId(c->id()),
                          text(c->name(), max_name),
                          StreamId(c->depth_stream()),
                          StreamId(c->color_stream()),
                          c->has_color(),
                          c->frames_per_second(),
                          {}};
            if (c->calibration()) {
                const auto bytes =
                    std::as_bytes(std::span(c->calibration()->data(), c->calibration()->size()));
                camera.calibration.assign(bytes.begin(), bytes.end());
            }
            welcome.cameras.push_back(std::move(camera));
        }
    return welcome;
}

Refused unpack(const fbs::Refused& m) {
    return {text(m.reason(), max_sentence)};
}

Settings unpack(const fbs::Settings& m) {
    Settings settings{{}, text(m.note(), max_sentence)};
    if (m.settings())
        for (const auto* s : *m.settings())
            settings.settings.push_back(
                {StreamId(s->stream()), SettingId(s->setting()), text(s->codec(), max_codec)});
    return settings;
}

CameraState unpack(const fbs::CameraState& m) {
    return {CameraId(m.camera()), CameraCondition(m.state()), text(m.problem(), max_sentence),
            text(m.filter(), max_filter)};
}

Pong unpack(const fbs::Pong& m) {
    return {from_us(m.ping_sent_us()), from_us(m.received_us()), from_us(m.sent_us())};
}

Received unpack(const fbs::Received& m) {
    return {m.media_bytes()};
}

ChooseDelivery unpack(const fbs::ChooseDelivery& m) {
    return {m.target_latency_ms(), m.max_kbit_per_s()};
}

Delivery unpack(const fbs::Delivery& m) {
    return {m.level(), m.levels(), text(m.what(), max_sentence), text(m.reason(), max_sentence)};
}

SetRenderer unpack(const fbs::SetRenderer& m) {
    return {text(m.renderer(), max_renderer), m.locked()};
}

Goodbye unpack(const fbs::Goodbye& m) {
    return {text(m.reason(), max_sentence)};
}

}  // namespace

Bytes encode_control(const Control& message) {
    Builder builder;
    const auto type = fbs::Body(message.index() + 1);
    const Body body = std::visit([&](const auto& m) { return pack(builder, m); }, message);
    builder.Finish(fbs::CreateControl(builder, type, body));
    const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
    return {bytes.begin(), bytes.end()};
}

namespace {

// Lists within their limits, and no setting without a number.
bool is_sound(const fbs::Control& control) {
    if (const auto* report = control.body_as_Report())
        return !too_long(report->streams(), max_streams);
    if (const auto* state = control.body_as_CameraState())
        return state->state() <= std::uint8_t(CameraCondition::failed);
    if (const auto* welcome = control.body_as_Welcome()) {
        if (too_long(welcome->cameras(), max_cameras))
            return false;
        if (welcome->cameras())
            for (const auto* camera : *welcome->cameras())
                if (too_long(camera->calibration(), max_calibration_size))
                    return false;
    }
    if (const auto* settings = control.body_as_Settings()) {
        if (too_long(settings->settings(), max_streams))
            return false;
        if (settings->settings())
            for (const auto* setting : *settings->settings())
                if (setting->setting() == 0)
                    return false;
    }
    return true;
}

}  // namespace

Result<Control> decode_control(ByteView bytes) {
    // FlatBuffers wants aligned memory; a message is small, so it is copied.
    std::vector<std::uint64_t> aligned((bytes.size() + 7) / 8);
    if (!bytes.empty())
        std::memcpy(aligned.data(), bytes.data(), bytes.size());
    const auto* data = reinterpret_cast<const std::uint8_t*>(aligned.data());
    flatbuffers::Verifier verifier(data, bytes.size(), 16, 4096);
    if (!fbs::VerifyControlBuffer(verifier))
        return Status::malformed;

    const fbs::Control& control = *fbs::GetControl(data);
    if (!control.body())
        return control.body_type() == fbs::Body::NONE ? Status::malformed : Status::unsupported;
    if (!is_sound(control))
        return Status::malformed;
    switch (control.body_type()) {
        case fbs::Body::Join:
            return Control(unpack(*control.body_as_Join()));
        case fbs::Body::ChooseCodecs:
            return Control(unpack(*control.body_as_ChooseCodecs()));
        case fbs::Body::RequestKey:
            return Control(unpack(*control.body_as_RequestKey()));
        case fbs::Body::Ping:
            return Control(unpack(*control.body_as_Ping()));
        case fbs::Body::Report:
            return Control(unpack(*control.body_as_Report()));
        case fbs::Body::Welcome:
            return Control(unpack(*control.body_as_Welcome()));
        case fbs::Body::Refused:
            return Control(unpack(*control.body_as_Refused()));
        case fbs::Body::Settings:
            return Control(unpack(*control.body_as_Settings()));
        case fbs::Body::CameraState:
            return Control(unpack(*control.body_as_CameraState()));
        case fbs::Body::Pong:
            return Control(unpack(*control.body_as_Pong()));
        case fbs::Body::Received:
            return Control(unpack(*control.body_as_Received()));
        case fbs::Body::ChooseDelivery:
            return Control(unpack(*control.body_as_ChooseDelivery()));
        case fbs::Body::Delivery:
            return Control(unpack(*control.body_as_Delivery()));
        case fbs::Body::SetRenderer:
            return Control(unpack(*control.body_as_SetRenderer()));
        case fbs::Body::Goodbye:
            return Control(unpack(*control.body_as_Goodbye()));
        case fbs::Body::NONE:
            break;
    }
    return Status::unsupported;
}

}  // namespace theatron::wire
