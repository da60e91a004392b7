// SPDX-License-Identifier: Apache-2.0
// Any states of faces from an expert, a recorder and an observer, and any answers to one who shows
// a face: nothing of an observer is kept, what is whole has the size that was offered, and a
// recorder is told of no face but its own.
#include <algorithm>
#include <cstdlib>

#include "session/face_upload.h"
#include "session/host_session.h"

namespace {

using namespace theatron;

class NoDigest : public ContentDigest {
public:
    void add(ByteView) override {}
    ContentHash finish() override { return {}; }
};

void join(session::HostSession& host, ParticipantId id, const char* token, bool records) {
    host.on_connected(id, {});
    wire::Join hello;
    hello.token = token;
    hello.depth_codec = hello.color_codec = "raw";
    hello.records = records;
    host.on_control(id, wire::encode(hello), {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    session::HostSession::Config config;
    config.admission.tokens = {{"expert", session::Role::expert, {}},
                               {"observer", session::Role::observer, {}}};
    config.admission.equal_secrets = [](std::string_view a, std::string_view b) { return a == b; };
    config.check_depth = config.check_color = [](const std::string& text) {
        return session::HostSession::CheckedCodec{text, ""};
    };
    config.make_digest = [] { return std::make_unique<NoDigest>(); };
    session::HostSession host(std::move(config));
    const ParticipantId expert{1}, recorder{2}, observer{3};
    join(host, expert, "expert", false);
    join(host, recorder, "expert", true);
    join(host, observer, "observer", false);
    session::FaceUpload upload;
    upload.show(std::make_shared<const Bytes>(20'000), {});
    upload.on_joined();
    TimePoint now = from_us(1'000'000);
    ByteReader in(std::as_bytes(std::span(data, size)));
    while (!in.rest().empty()) {
        const unsigned what = in.get<std::uint8_t>();
        const ParticipantId sender{1 + what % 3};
        const auto id = what & 4 ? std::uint32_t(sender) : in.get<std::uint16_t>();
        const std::size_t length = std::min<std::size_t>(in.get<std::uint8_t>(), in.rest().size());
        const ByteView part = in.get_bytes(length);
        const Bytes body(part.begin(), part.end());
        now += Duration(1000 * (what >> 3));
        const auto topic = what & 128 ? wire::StateTopic::own_face : wire::StateTopic::face_piece;
        (void)host.on_own_face(sender, {{topic, id}, body}, now);
        upload.on_answer(body, now);
        for (const auto& piece : upload.take(now))
            if (piece.body.empty() || piece.body.size() > wire::max_state_size)
                std::abort();
        for (const session::Action& action : host.take_actions()) {
            const auto* sent = std::get_if<session::action::SendState>(&action);
            if (!sent)
                continue;
            const auto face = wire::decode_own_face(sent->body);
            const bool is_own = sent->key.id == std::uint32_t(sent->participant);
            const bool of_observer = sent->key.id == std::uint32_t(observer);
            if (!face || (!is_own && (sent->participant == recorder || of_observer)))
                std::abort();
            if (!is_own && face->kind == wire::OwnFace::Kind::offered) {
                const auto whole = host.own_face(face->hash);
                if (!whole || whole->size() != face->bytes)
                    std::abort();
            }
        }
    }
    return 0;
}
