// SPDX-License-Identifier: Apache-2.0
#include "host/room_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "files/private_file.h"
#include "record/crc32c.h"
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
        session::HostRoom room(file.load().room, actions);
        room.join(anna, {{}, false, "Anna"}, true);
        room.on_request(anna, {1, session::encode_request(session::request::Create{
                                      session::ObjectKind::brick, {{}, {1, 2, 3}}, 1, Bytes(3)})});
        file.on_tick(room, {}, TimePoint(10s));
    }
    RoomFile file(path);
    const session::HostRoom room(file.load().room, actions);
    const auto objects = room.snapshot().objects;
    ASSERT_EQ(objects.size(), 1u);
    EXPECT_EQ(objects.begin()->second.room_from_object.translation, (Vec3{1, 2, 3}));
}

TEST(RoomFile, ADamagedOneIsKeptAsideAndAnEmptyRoomBegins) {
    const testing::TemporaryFolder folder;
    files::open_private_folder(folder.path() / "state");
    const auto path = folder.path() / "state" / "room";
    session::ObjectsSnapshot room;
    room.revision = 5;
    room.objects[session::ObjectId{1}] = {session::ObjectKind::mark, anna, {}, {}, {}, 1, {}};
    const UtcTime utc{std::chrono::microseconds(1'700'000'000'123'456)};
    Bytes bytes = encode_room({room, {}, from_us(77), utc, {}});
    const auto decoded = decode_room(bytes);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->utc, utc);
    EXPECT_EQ(decoded->session_time, from_us(77));
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        Bytes flipped = bytes;
        flipped[at] ^= std::byte{1};
        EXPECT_FALSE(decode_room(flipped)) << at;
    }
    // A second one does not replace the first.
    for (const char* const kept : {"room.damaged", "room.damaged.2", "room.damaged.3"}) {
        bytes[20] ^= std::byte{4};
        files::write_private_file(path,
                                  {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        bytes[20] ^= std::byte{4};
        RoomFile file(path);
        EXPECT_TRUE(file.load().room.objects.empty());
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "state" / kept));
        EXPECT_FALSE(std::filesystem::exists(path));
    }
    // Neither does a file of another program, however large.
    files::write_private_file(path, std::string(3 << 20, 'x'));
    RoomFile file(path);
    EXPECT_TRUE(file.load().room.objects.empty());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "state" / "room.damaged.4"));
}

TEST(RoomFile, KeepsAdjustmentsOfCameras) {
    const testing::TemporaryFolder folder;
    files::open_private_folder(folder.path() / "state");
    const auto path = folder.path() / "state" / "room";
    std::vector<session::Action> actions;
    const session::KeptAdjustment kept{
        "Anna", "lärm", look_at({1, 2, 3}, {}, {0, 1, 0}), {{0.01, 0, 0}, {0, 1.5, 0}, {}}};
    {
        RoomFile file(path);
        session::HostRoom room(file.load().room, actions);
        file.on_tick(room, {kept}, TimePoint(10s));
    }
    EXPECT_EQ(RoomFile(path).load().adjustments, std::vector{kept});
    SavedRoom bad;
    bad.adjustments = {kept};
    bad.adjustments[0].registered.translation.x = std::nan("");
    EXPECT_EQ(decode_room(encode_room(bad)).error(), Status::malformed);
}

TEST(RoomFile, OfANewerVersionIsNotCalledDamaged) {
    Bytes bytes = encode_room({});
    bytes[4] = std::byte{9};
    bytes.resize(bytes.size() - 4);
    ByteWriter out(bytes);
    out.put(record::crc32c(bytes));
    EXPECT_EQ(decode_room(bytes).error(), Status::unsupported);
}

TEST(RoomFile, ThatCannotBeWrittenIsTriedAgainUntilItCan) {
    const testing::TemporaryFolder folder;
    const auto state = folder.path() / "state";
    files::open_private_folder(state);
    std::vector<session::Action> actions;
    session::HostRoom room({}, actions);
    room.join(anna, {{}, false, "Anna"}, true);
    // A folder in the file's place.
    std::filesystem::create_directories(state / "room" / "in the way");
    RoomFile file(state / "room");
    TimePoint now(10s);
    const auto tick_until = [&](auto is_done) {
        while (!is_done()) {
            now += RoomFile::interval;
            file.on_tick(room, {}, now);
            std::this_thread::yield();
        }
    };
    tick_until([&] { return !file.problem().empty(); });
    std::filesystem::remove_all(state / "room");
    tick_until([&] { return file.problem().empty(); });
    EXPECT_TRUE(std::filesystem::is_regular_file(state / "room"));
}

TEST(RoomFile, OlderVersionsHadNoTimesAdjustmentsOrAuthors) {
    session::ObjectsSnapshot room;
    room.revision = 5;
    room.objects[session::ObjectId{1}] = {session::ObjectKind::mark, anna, {}, {}, {}, 1, {}};
    const Bytes now = encode_room({room, {}, from_us(77), UtcTime(1s), {}});
    // Where times, adjustments, authors and the objects begin.
    constexpr std::ptrdiff_t times_at = 16, adjustments_at = 32, authors_at = 34, objects_at = 38;
    constexpr std::ptrdiff_t check_size = 4;
    for (const int version : {1, 2, 3}) {
        Bytes before(now.begin(), now.end() - check_size);
        before[4] = std::byte(version);
        const std::ptrdiff_t begin[] = {times_at, adjustments_at, authors_at};
        before.erase(before.begin() + begin[version - 1], before.begin() + objects_at);
        ByteWriter out(before);
        out.put(record::crc32c(before));
        const auto decoded = decode_room(before);
        ASSERT_TRUE(decoded) << version;
        EXPECT_EQ(decoded->room.objects.size(), 1u);
        EXPECT_EQ(decoded->utc, version == 1 ? UtcTime{} : UtcTime(1s));
        EXPECT_TRUE(decoded->authors.empty());
    }
}

TEST(RoomFile, KeepsTheAuthorsOfMarksThatAreThere) {
    const session::ObjectId mark{7}, gone{8};
    const Bytes eve(wire::person_id_size, std::byte(5));
    session::ObjectsSnapshot room;
    room.revision = 9;
    room.objects[mark] = {session::ObjectKind::mark, anna, {}, {}, {}, 1, {}};
    const Bytes bytes = encode_room({room, {{mark, eve}, {gone, eve}}, {}, {}, {}});
    const auto decoded = decode_room(bytes);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->authors, (session::HostRoom::Authors{{mark, eve}}));
    // More authors announced than there are bytes.
    Bytes more(bytes.begin(), bytes.end() - 4);
    more[37] = std::byte(0xff);
    ByteWriter out(more);
    out.put(record::crc32c(more));
    EXPECT_FALSE(decode_room(more));
}

}  // namespace
}  // namespace theatron::host
