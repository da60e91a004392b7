// SPDX-License-Identifier: Apache-2.0
// Any bytes as parts of a recorded room, one after another: reading stays inside them, and the room
// that comes out can be written and read again without a difference.
#include <algorithm>
#include <cstdlib>

#include "session/room_track.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    using namespace theatron::session;
    ByteReader in(std::as_bytes(std::span(data, size)));
    RoomTrackReader reader;
    RoomTrackWriter writer;
    TimePoint now(1s);
    while (!in.rest().empty()) {
        const auto head = in.get<std::uint16_t>();
        const ByteView part = in.get_bytes(std::min<std::size_t>(head >> 1, in.rest().size()));
        Status status = reader.begin(Bytes(part.begin(), part.end()), now, head & 1);
        while (status == Status::ok && reader.next())
            status = reader.step();
        now += 100ms;
        writer.note_objects(reader.objects(), now);
        for (const auto& [person, body] : reader.poses())
            writer.note_pose(person, *wire::decode_person_pose(body), now);
    }
    const auto written = writer.take(now);
    if (!written)
        return 0;
    RoomTrackReader again;
    Status status = again.begin(written->bytes, written->begin, written->key);
    while (status == Status::ok && again.next())
        status = again.step();
    if (status != Status::ok || hash_of(again.objects()) != hash_of(reader.objects()))
        std::abort();
    return 0;
}
