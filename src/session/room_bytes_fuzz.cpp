// SPDX-License-Identifier: Apache-2.0
// Any bytes as a room, a request, a pose and a person: reading stays inside the input, and valid
// bytes are equal after reading and writing. Then a member gets them as messages of a hostile host.
#include <cstdlib>

#include "session/host_room.h"
#include "session/member_room.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    using namespace theatron::session;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    if (const auto objects = decode_objects(bytes, RoomState::max_objects);
        objects && hash_of(*decode_objects(encode_objects(*objects), RoomState::max_objects)) !=
                       hash_of(*objects))
        std::abort();
    if (const auto request = decode_request(bytes)) {
        std::vector<Action> actions;
        HostRoom host({}, actions);
        host.join(ParticipantId{1}, {}, true);
        host.on_request(ParticipantId{1}, {1, encode_request(*request)});
        if (host.snapshot().objects.size() > 2)
            std::abort();
    }
    (void)decode_object_pose(ObjectId{1}, bytes);
    if (const auto facts = decode_person(bytes); facts && facts->name.size() > 4 * wire::max_name)
        std::abort();
    MemberRoom member;
    member.begin(ParticipantId{1});
    ByteReader in(bytes);
    while (!in.rest().empty()) {
        const auto what = in.get<std::uint8_t>();
        const ByteView part =
            in.get_bytes(std::min<std::size_t>(in.get<std::uint8_t>() * 4, in.rest().size()));
        const Bytes body(part.begin(), part.end());
        if (what % 4 == 0)
            member.on_message(wire::RoomSnapshot{what, std::uint16_t(what / 128), 2, body, what});
        else if (what % 4 == 1)
            member.on_message(wire::RoomChange{std::uint64_t(what / 4), what, body});
        else if (what % 4 == 2)
            member.on_message(wire::RoomDecision{what, what});
        else
            member.on_pose(ObjectId{what}, body);
        if (member.ask(request::Grab{ObjectId{what}}) != 0)
            (void)member.move(ObjectId{what}, {}, 1, TimePoint(1s));
        (void)member.objects();
        (void)member.take_requests();
    }
    return 0;
}
