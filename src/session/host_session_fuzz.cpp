// SPDX-License-Identifier: Apache-2.0
// Any control messages (each behind a two-byte length) from participants who come and go, while
// frames are encoded, links are measured, encoders fall behind, operators decide on people and time
// goes on: the host's state stays sound, its actions can be sent, each participant who has joined
// has a setting, and nobody has more than its role allows.
#include <algorithm>
#include <cstdlib>
#include <set>

#include "geometry/calibration.h"
#include "session/host_session.h"
#include "session/room_bytes.h"
#include "session/viewer_session.h"

namespace {

using namespace theatron;
using session::HostSession;

// Codecs by their first letters: 'i' independent, others a chain that has layers.
session::CodecSteps steps() {
    session::CodecSteps steps;
    steps.layered = [](const std::string& depth) {
        const bool independent = depth.starts_with('i');
        return session::CodecSteps::Layered{independent ? depth : "layered " + depth, independent,
                                            !independent};
    };
    steps.coarser = [](const std::string& color) {
        return std::vector<session::CodecSteps::Coarser>{{"half " + color, 0.5},
                                                         {"tenth " + color, 0.1}};
    };
    steps.refers = [](std::uint8_t codec) { return codec % 2 == 1; };
    steps.lossy_outside_region = [](const std::string& depth) { return "lossy " + depth; };
    return steps;
}

wire::Camera camera(int number) {
    Calibration calibration;
    calibration.depth.size = calibration.color.size = {64, 48};
    calibration.depth.fx = calibration.depth.fy = calibration.color.fx = calibration.color.fy = 60;
    wire::Camera camera;
    camera.id = CameraId(number);
    camera.depth_stream = depth_stream(camera.id);
    camera.color_stream = color_stream(camera.id);
    camera.has_color = true;
    camera.frames_per_second = 30;
    camera.calibration = encode_calibration(calibration);
    return camera;
}

constexpr const char* secrets[] = {"secret", "operator", "observer", "expert", "relay"};

// The first ones of them.
std::vector<session::Admission::Token> tokens(std::size_t count) {
    using session::Role;
    constexpr Role roles[] = {Role::publisher, Role::operator_, Role::observer, Role::expert,
                              Role::relay};
    std::vector<session::Admission::Token> tokens;
    for (std::size_t i = 0; i < count; ++i)
        tokens.push_back({secrets[i], roles[i], {}, secrets[i]});
    return tokens;
}

HostSession::Config config(bool asks) {
    const auto check = [](const std::string& text) {
        // As with real codecs, an empty text is none.
        const char* problem = text.empty() ? "Empty." : text.size() > 20 ? "Too long." : "";
        return HostSession::CheckedCodec{text.substr(0, 20), problem};
    };
    HostSession::Config config;
    config.admission.tokens = tokens(5);
    config.admission.asks = asks;
    config.admission.equal_secrets = [](std::string_view a, std::string_view b) { return a == b; };
    config.name = "room";
    config.cameras = {camera(0), camera(1)};
    config.check_depth = config.check_color = check;
    config.streams.codecs = steps();
    config.streams.usual = {"strata", "jpeg"};
    config.past = {30s, 4096};
    config.make_secret = [] { return Bytes(wire::relay_secret_size, std::byte{1}); };
    return config;
}

constexpr std::uint32_t participants = 6;

// The first message of an honest participant.
Bytes hello(std::uint8_t choice) {
    static const char* const codecs[] = {"strata", "jpeg", "independent", "chain"};
    session::ViewerSession::Wishes wishes{secrets[choice / 6 % 5], "someone", codecs[choice % 4],
                                          codecs[choice / 4 % 4]};
    wishes.delivery.target_latency_ms = choice % 32 < 16 ? 100 : 0;
    wishes.records = choice >= 200;
    wishes.features = {wire::Feature::publish, wire::Feature::room,         wire::Feature::cases,
                       wire::Feature::screens, wire::Feature::look_back,    wire::Feature::patient,
                       wire::Feature::relay,   wire::Feature::asks_patient, wire::Feature::study,
                       wire::Feature::chat};
    if (choice / 6 % 5 == 4 || choice % 31 == 0)
        wishes.features.push_back(wire::Feature::relays);
    if (choice % 5 != 0)
        wishes.person = Bytes(wire::person_id_size, std::byte(choice % 7));
    wishes.run = choice % 3;
    return session::ViewerSession(wishes).begin();
}

// Nobody holds an object, publishes or waits whose role or state does not allow it.
void check_rights(const HostSession& host) {
    using session::Right;
    const auto& people = host.participants();
    const auto may = [&](ParticipantId id, Right right) {
        const auto found = people.find(id);
        return found != people.end() && found->second.may(right);
    };
    for (const auto& [id, object] : host.room().snapshot().objects) {
        if (object.grip.holder != ParticipantId{} && !may(object.grip.holder, Right::handle))
            std::abort();
        if (object.kind == session::ObjectKind::person && !may(object.creator, Right::see))
            std::abort();
    }
    for (const wire::Camera& camera : host.streams().cameras().descriptions())
        if (camera.publisher != session::host_publisher &&
            !may(camera.publisher, session::needed_right(camera.kind)))
            std::abort();
    for (const wire::Visitor& visitor : host.visitors())
        if (may(visitor.participant, Right::see))
            std::abort();
    if (host.visitors().size() > wire::max_visitors)
        std::abort();
}

// Nobody is shown the past of its own camera, nor of a camera that has left.
void check_past(const HostSession& host, const std::vector<session::LookBacks::Due>& pictures) {
    for (const session::LookBacks::Due& due : pictures) {
        const auto* camera = host.streams().cameras().find(camera_of(due.header.stream));
        const auto found = host.participants().find(due.receiver);
        if (!camera || !camera->may_be_kept() || camera->publisher() == due.receiver ||
            found == host.participants().end() || !found->second.takes_part())
            std::abort();
    }
}

session::CaseFacts case_facts(int number) {
    session::CaseFacts facts;
    facts.id.bytes[0] = std::byte(number);
    facts.name = "case";
    facts.opacities.assign(std::size_t(2 + number), 255);
    return facts;
}

// A screen of the room shows a camera that is here; few are kept whose source is away.
void check_screens(const HostSession& host) {
    std::size_t away = 0;
    std::set<CameraId> shown;
    for (const auto& [id, object] : host.room().snapshot().objects) {
        const auto screen = session::decode_shared_screen(object.kind, object.properties);
        if (!screen)
            continue;
        if (!session::is_screen_width(object.scale))
            std::abort();
        if (!screen->camera)
            ++away;
        else if (!host.streams().cameras().find(*screen->camera) ||
                 !shown.insert(*screen->camera).second)
            std::abort();
    }
    if (away > session::HostRoom::max_kept_screens)
        std::abort();
}

wire::Patient patient_of(int number) {
    const session::CaseFacts facts = case_facts(number);
    return {Bytes(facts.id.bytes.begin(), facts.id.bytes.end()), "Doe", "", "", ""};
}

// The receivers of a relay are bounded; a recorder gets nothing from a relay, and a relay nothing
// of the session.
void check_relays(const HostSession& host, const session::action::Send& send) {
    const auto* grants = std::get_if<wire::RelayGrants>(&send.message);
    const auto* receivers = std::get_if<wire::RelayReceivers>(&send.message);
    if (!grants && !receivers)
        return;
    const auto found = host.participants().find(send.participant);
    if (!wire::decode_to_participant(wire::encode(send.message)) ||
        (grants && !grants->grants.empty() &&
         (found == host.participants().end() || !found->second.takes_part() ||
          found->second.records || found->second.role == session::Role::relay)))
        std::abort();
    if (receivers &&
        (found == host.participants().end() || found->second.role != session::Role::relay))
        std::abort();
}

// A participant who waits for admission gets nothing of the session, and only an operator learns
// who the patient is.
void check_sent(const HostSession& host, const session::action::Send& send) {
    const auto found = host.participants().find(send.participant);
    const auto* patient = std::get_if<wire::Patient>(&send.message);
    if (const auto* answer = std::get_if<wire::AskedPatient>(&send.message))
        patient = &answer->patient;
    if (patient && !patient->name.empty() && found != host.participants().end() &&
        (found->second.role != session::Role::operator_ || found->second.records))
        std::abort();
    if (found == host.participants().end() || !found->second.waits())
        return;
    using wire::Managed, wire::Pong, wire::Published, wire::Waiting, wire::RoomDecision;
    if (!std::holds_alternative<Waiting>(send.message) &&
        !std::holds_alternative<Pong>(send.message) &&
        !std::holds_alternative<Managed>(send.message) &&
        !std::holds_alternative<Published>(send.message))
        std::abort();
}

void check(const HostSession& host) {
    std::set<SettingId> numbers;
    const std::vector<wire::Camera> cameras = host.streams().cameras().descriptions();
    if (cameras.size() > wire::max_cameras)
        std::abort();
    for (const wire::Camera& camera : cameras)
        for (const bool depth : {true, false}) {
            const auto& settings = host.streams().settings(camera.id, depth);
            if (settings.size() > session::SettingTable::max_active + 1)
                std::abort();
            for (const session::ActiveSetting& setting : settings)
                if (setting.id == SettingId{} || !numbers.insert(setting.id).second)
                    std::abort();
            for (const auto& [id, announced] : host.streams().cameras().find(camera.id)->receivers)
                if (id == camera.publisher ||
                    !host.streams().cameras().find(camera.id)->table(depth).find(
                        announced.of(depth)))
                    std::abort();
        }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    HostSession host(config(size % 2 == 1));
    session::ViewerSession viewer({});
    TimePoint now = from_us(0);
    FrameNumber frame = 0;

    ByteReader in(std::as_bytes(std::span(data, size)));
    while (!in.rest().empty()) {
        const auto what = in.get<std::uint8_t>();
        const auto choice = in.get<std::uint8_t>();
        const ParticipantId id{1 + choice % participants};
        const SettingId setting{std::uint16_t(choice / 8)};
        switch (what % 21) {
            case 0:
                if (!host.participants().contains(id))
                    host.on_connected(id, now);
                break;
            case 1:
                host.on_control(id, hello(choice), now);
                break;
            case 2:
                host.on_closed(id);
                break;
            case 3:
                host.set_renderer(id, {"mesh", choice > 99});
                break;
            case 4: {
                wire::MediaHeader header;
                header.frame = frame += choice % 3;
                header.stream = StreamId(choice % 5);
                header.setting = setting;
                header.temporal_layer = choice % 8;
                header.captured = now - std::chrono::milliseconds(choice);
                (void)host.on_media(header, std::size_t(choice) << what % 16, now);
                break;
            }
            case 5:
                host.on_link(id, {double(choice) * 1e5, 5ms, choice * 1ms, choice % 7}, now);
                break;
            case 6:
                host.on_region(choice % 2);
                break;
            case 7:
                host.on_encoding(CameraId(choice % 2), setting, choice % 3 == 0, choice);
                break;
            case 8:
                host.on_broken_stream(StreamId(choice % 4), setting);
                break;
            case 10: {
                wire::Camera offered = camera(0);
                if (what >= 128)
                    offered.calibration = encode_calibration(
                        screen_calibration({64, 48}, choice / 16.0, usual_screen_place));
                wire::Publish offer;
                for (int i = 0; i < choice % 4; ++i)
                    offer.cameras.push_back({"own", choice % 8 < 4, 30, offered.calibration});
                host.on_control(id, wire::encode(offer), now);
                break;
            }
            case 11:
                host.on_control(id, wire::encode(wire::Unpublish{{CameraId(choice / 8)}}), now);
                break;
            case 12: {
                wire::MediaHeader header;
                header.frame = header.reference = ++frame;
                header.key = true;
                header.stream = StreamId(choice / 4);
                header.setting = setting;
                header.captured = now;
                Bytes message(wire::media_header_size);
                wire::write_media_header(header, message.data());
                (void)host.on_media_from(id, message, now);
                break;
            }
            case 13:
                host.on_control(
                    id,
                    wire::encode(wire::Manage{choice, wire::ManageAction(1 + choice % 10),
                                              ParticipantId{1 + choice / 8 % participants},
                                              wire::Role(choice / 64)}),
                    now);
                break;
            case 14:
                (void)host.manage(
                    {choice, wire::ManageAction(1 + choice % 8), id, wire::Role(choice / 64)}, now);
                break;
            case 15:
                host.set_tokens(tokens(choice % 5));
                break;
            case 16: {
                const session::Request requests[] = {
                    session::request::Create{session::ObjectKind::brick, {}, 1, {}},
                    session::request::Grab{session::ObjectId(choice / 16)},
                    session::request::HandOver{session::ObjectId(choice / 16), choice / 16u,
                                               ParticipantId{1 + choice % participants}}};
                host.on_control(
                    id,
                    wire::encode(wire::RoomRequest{1u + choice / 16,
                                                   session::encode_request(requests[choice % 3])}),
                    now);
                break;
            }
            case 17: {
                host.set_cases({case_facts(0), case_facts(choice % 3)}, {patient_of(choice % 3)});
                const session::Request requests[] = {
                    session::request::Create{session::ObjectKind::organ,
                                             {},
                                             1,
                                             session::encode_case_object(session::CaseOrgan{
                                                 case_facts(choice / 8 % 4).id})},
                    session::request::Remove{session::ObjectId(choice / 4)},
                    session::request::SetProperties{
                        session::ObjectId(choice / 4),
                        session::encode_case_object(session::CasePart{case_facts(0).id, 1})}};
                host.on_control(
                    id,
                    wire::encode(wire::RoomRequest{1u + choice / 16,
                                                   session::encode_request(requests[choice % 3])}),
                    now);
                host.on_control(id, wire::encode(wire::RequestContent{Bytes(32), choice, choice}),
                                now);
                host.on_control(id, wire::encode(wire::VoiceConsent{choice % 3 == 0}), now);
                host.on_control(id, wire::encode(wire::RaiseHand{choice % 2 == 0}), now);
                host.on_control(
                    id, wire::encode(wire::WriteChat{choice / 8u, std::string(choice % 5, 'a')}),
                    now);
                break;
            }
            case 18: {
                const session::CameraAdjustment adjustment{{choice / 500.0, 0, 0},
                                                           {0, choice / 8.0, 0},
                                                           session::PictureBox{0, 0, choice, 8}};
                host.on_control(
                    id,
                    wire::encode(wire::AdjustCamera{choice, CameraId(choice % 4),
                                                    session::encode_adjustment(adjustment)}),
                    now);
                if (choice % 16 == 0)
                    host.set_playback({1s, now, 9s, false, ""});
                host.on_control(id,
                                wire::encode(wire::Play{choice, wire::PlayAction(1 + choice % 3),
                                                        Duration(std::int64_t(choice) << 40)}),
                                now);
                host.on_control(
                    id, wire::encode(wire::LookBack{choice, Duration(choice) * 300'000}), now);
                host.on_control(id, wire::encode(wire::AskPatient{patient_of(choice % 3).of_case}),
                                now);
                wire::ShowStudy shown{choice, ParticipantId{1 + choice % participants}, {}};
                shown.step.step = choice % 4;
                shown.step.kind = wire::StudyKind(choice % 9);
                host.on_control(id, wire::encode(shown), now);
                host.on_control(id,
                                wire::encode(wire::StudyReply{
                                    choice % 4u, wire::StudyAction(1 + choice % 3), choice}),
                                now);
                host.on_control(id,
                                wire::encode(wire::SetCondition{
                                    choice, ParticipantId{1 + choice / 4 % participants}, "mesh",
                                    choice % 2 ? "rvl" : "", "", Duration(choice), choice > 99}),
                                now);
                break;
            }
            case 9:
                host.on_camera({CameraId(choice % 2), wire::CameraCondition(choice % 4), {}, ""});
                break;
            case 20: {
                const std::uint16_t port = choice % 7 == 0 ? 0 : choice;
                host.on_control(
                    id,
                    wire::encode(wire::OfferRelay{
                        {"192.0.2.1", "127.0.0.1"}, port, Bytes(wire::fingerprint_size)}),
                    now);
                wire::Report report;
                for (int number = 0; number < choice % 8; ++number)
                    report.streams.push_back(
                        {StreamId(choice % 8), 0, 0, 0, {}, SettingId(choice / 16 + number)});
                host.on_control(id, wire::encode(report), now);
                break;
            }
            default: {
                const std::size_t length = in.get<std::uint16_t>();
                host.on_control(id, in.get_bytes(std::min(length, in.rest().size())), now);
            }
        }
        now += what < 128 ? 10ms : 200ms;
        host.on_tick(now);
        check_past(host, host.take_past(now));
        for (const session::Action& action : host.take_actions())
            if (const auto* send = std::get_if<session::action::Send>(&action)) {
                check_sent(host, *send);
                check_relays(host, *send);
                (void)viewer.on_control(wire::encode(send->message));
            }
        check(host);
        check_rights(host);
        check_screens(host);
    }
    return 0;
}
