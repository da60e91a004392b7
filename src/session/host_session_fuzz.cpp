// SPDX-License-Identifier: Apache-2.0
// Any control messages (each behind a two-byte length) from two participants, one
// of whom has joined: the host's state stays sound and its actions can be sent.
#include <cstdlib>

#include "session/host_session.h"
#include "session/viewer_session.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    using session::HostSession;
    const auto check = [](const std::string& text) {
        return HostSession::CheckedCodec{text.substr(0, 20), text.size() > 20 ? "Too long." : ""};
    };
    HostSession host({"secret",
                      "room",
                      {wire::Camera{}},
                      check,
                      check,
                      [](std::string_view a, std::string_view b) { return a == b; }});
    session::ViewerSession viewer({"secret", "someone"});
    TimePoint now = from_us(0);
    host.on_connected(ParticipantId{1}, now);
    host.on_connected(ParticipantId{2}, now);
    host.on_control(ParticipantId{1}, viewer.begin(), now);

    ByteReader in(std::as_bytes(std::span(data, size)));
    while (!in.rest().empty()) {
        const auto control = in.get<std::uint8_t>();
        const std::size_t length = in.get<std::uint16_t>();
        if (control % 16 == 3)
            host.set_renderer(ParticipantId(1 + control / 128), {"mesh", control > 99});
        const ByteView part = in.get_bytes(std::min(length, in.rest().size()));
        host.on_control(ParticipantId(1 + control % 2), part, now);
        now += 100ms;
        host.on_tick(now);
        for (const auto& action : host.take_actions())
            if (action.kind == HostSession::Action::Kind::send)
                (void)viewer.on_control(wire::encode_control(action.message));
        if (host.depth_settings().size() > session::SettingTable::max_active)
            std::abort();
    }
    return 0;
}
