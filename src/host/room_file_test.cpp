// SPDX-License-Identifier: Apache-2.0
#include "host/room_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "files/private_file.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

constexpr ParticipantId anna{1};

TEST(RoomFile, KeepsObjectsOverARestartWithoutPeople) {
    const testing::TemporaryFolder folder;
    files::open_private_folder(folder.path() / "state");
    const auto path = folder.path() / "state" / "room";
    std::vector<session::Action> actions;
    {
        RoomFile file(path);
        session::HostRoom room(file.load(), actions);
        room.join(anna, {{}, false, "Anna"}, true);
        room.on_request(anna, {1, session::encode_request(session::request::Create{
                                      session::ObjectKind::brick, {{}, {1, 2, 3}}, 1, Bytes(3)})});
        file.on_tick(room, TimePoint(10s));
    }
    RoomFile file(path);
    const session::HostRoom room(file.load(), actions);
    const auto objects = room.snapshot().objects;
    ASSERT_EQ(objects.size(), 1u);
    EXPECT_EQ(objects.begin()->second.room_from_object.translation, (Vec3{1, 2, 3}));
}

TEST(RoomFile, ADamagedOneIsKeptAsideAndAnEmptyRoomBegins) {
    const testing::TemporaryFolder folder;
    files::open_private_folder(folder.path() / "state");
    const auto path = folder.path() / "state" / "room";
    session::RoomSnapshot room;
    room.revision = 5;
    room.objects[session::ObjectId{1}] = {session::ObjectKind::mark, anna, {}, {}, {}, 1, {}};
    Bytes bytes = encode_room(room);
    ASSERT_TRUE(decode_room(bytes));
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        Bytes flipped = bytes;
        flipped[at] ^= std::byte{1};
        EXPECT_FALSE(decode_room(flipped)) << at;
    }
    bytes[20] ^= std::byte{4};
    files::write_private_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    RoomFile file(path);
    EXPECT_TRUE(file.load().objects.empty());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "state" / "room.damaged"));
    EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace theatron::host
