// SPDX-License-Identifier: Apache-2.0
// Any control messages (each behind a two-byte length) from participants who come and go, while
// frames are encoded, links are measured, encoders fall behind and time goes on: the host's state
// stays sound, its actions can be sent, and who has joined is always given a setting.
#include <algorithm>
#include <cstdlib>
#include <set>

#include "geometry/calibration.h"
#include "session/host_session.h"
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

HostSession::Config config() {
    const auto check = [](const std::string& text) {
        // As with real codecs, an empty text is none.
        const char* problem = text.empty() ? "Empty." : text.size() > 20 ? "Too long." : "";
        return HostSession::CheckedCodec{text.substr(0, 20), problem};
    };
    HostSession::Config config;
    config.admission.tokens = {{"secret", session::Role::publisher, {}}};
    config.admission.equal_secrets = [](std::string_view a, std::string_view b) { return a == b; };
    config.name = "room";
    config.cameras = {camera(0), camera(1)};
    config.check_depth = config.check_color = check;
    config.streams.codecs = steps();
    config.streams.usual = {"strata", "jpeg"};
    return config;
}

constexpr std::uint32_t participants = 6;

// The first message of an honest participant.
Bytes hello(std::uint8_t choice) {
    static const char* const codecs[] = {"strata", "jpeg", "independent", "chain"};
    session::ViewerSession::Wishes wishes{"secret", "someone", codecs[choice % 4],
                                          codecs[choice / 4 % 4]};
    wishes.delivery.target_latency_ms = choice % 32 < 16 ? 100 : 0;
    wishes.records = choice >= 200;
    wishes.features = {wire::Feature::publish};
    return session::ViewerSession(wishes).begin();
}

void check(const HostSession& host) {
    std::set<SettingId> numbers;
    const std::vector<wire::Camera> cameras = host.streams().cameras();
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
            for (const auto& [id, announced] : host.streams().find(camera.id)->receivers)
                if (id == camera.publisher ||
                    !host.streams().find(camera.id)->table(depth).find(announced.of(depth)))
                    std::abort();
        }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    HostSession host(config());
    session::ViewerSession viewer({});
    TimePoint now = from_us(0);
    FrameNumber frame = 0;

    ByteReader in(std::as_bytes(std::span(data, size)));
    while (!in.rest().empty()) {
        const auto what = in.get<std::uint8_t>();
        const auto choice = in.get<std::uint8_t>();
        const ParticipantId id{1 + choice % participants};
        const SettingId setting{std::uint16_t(choice / 8)};
        switch (what % 15) {
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
            case 9:
                host.on_camera({CameraId(choice % 2), wire::CameraCondition(choice % 4), {}, ""});
                break;
            default: {
                const std::size_t length = in.get<std::uint16_t>();
                host.on_control(id, in.get_bytes(std::min(length, in.rest().size())), now);
            }
        }
        now += what < 128 ? 10ms : 200ms;
        host.on_tick(now);
        for (const session::Action& action : host.take_actions())
            if (const auto* send = std::get_if<session::action::Send>(&action))
                (void)viewer.on_control(wire::encode(send->message));
        check(host);
    }
    return 0;
}
