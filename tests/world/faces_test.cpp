// SPDX-License-Identifier: Apache-2.0
// People who show a face of their own.
#include <gmock/gmock.h>

#include <algorithm>

#include "files/file_bytes.h"
#include "world/acts.h"
#include "world/session_recorder.h"

namespace theatron::world {
namespace {

using State = session::FaceUpload::State;

// Bytes that stand out in any file.
std::shared_ptr<const Bytes> some_face(std::size_t size) {
    Bytes face(size);
    for (std::size_t i = 0; i < size; ++i)
        face[i] = std::byte(i * i * 31 + i / 256);
    return std::make_shared<const Bytes>(std::move(face));
}

Person& with_faces(World& world, const std::string& name) {
    Person& person = world.person(name);
    person.options.takes_own_faces = true;
    return world.joined(name);
}

bool sees_face(Person& person, ParticipantId of, const std::shared_ptr<const Bytes>& face) {
    const auto faces = person->own_faces();
    const auto found = faces.find(of);
    return found != faces.end() && *found->second == *face;
}

TEST(WorldFaces, AnOwnFaceReachesAllWhoAreHereAndComeLater) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = with_faces(world, "Ben");
    const auto face = some_face(wire::max_own_face_bytes);
    anna->show_own_face(face);
    EXPECT_TRUE(world.until([&] { return sees_face(ben, anna.number(), face); }, 1min));
    EXPECT_EQ(anna->own_face_state(), State::there);
    Person& carl = with_faces(world, "Carl");
    EXPECT_TRUE(world.until([&] { return sees_face(carl, anna.number(), face); }, 1min));
    // Another face takes the place of the first.
    const auto other = some_face(5000);
    anna->show_own_face(other);
    EXPECT_TRUE(world.until([&] { return sees_face(carl, anna.number(), other); }, 1min));
    // `face off`.
    anna->show_own_face(nullptr);
    EXPECT_TRUE(
        world.until([&] { return ben->own_faces().empty() && carl->own_faces().empty(); }, 2s));
    EXPECT_EQ(anna->own_face_state(), State::none);
    Person& dora = with_faces(world, "Dora");
    world.advance(5s);
    EXPECT_TRUE(dora->own_faces().empty());
}

TEST(WorldFaces, ItIsForgottenWithItsOwnerAndComesAgainWithThem) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = with_faces(world, "Ben");
    const auto face = some_face(60'000);
    anna->show_own_face(face);
    EXPECT_TRUE(world.until([&] { return sees_face(ben, anna.number(), face); }, 1min));
    anna.path().reset();
    EXPECT_TRUE(world.until([&] { return ben->own_faces().empty(); }, 1min));
    EXPECT_TRUE(
        world.until([&] { return anna.is_in() && sees_face(ben, anna.number(), face); }, 1min));
    anna.leave();
    EXPECT_TRUE(world.until([&] { return ben->own_faces().empty(); }, 1min));
}

TEST(WorldFaces, WhoBecomesAnObserverIsSeenNoMore) {
    World world;
    Person& chief = world.joined("Chief", wire::Role::operator_);
    Person& anna = world.joined("Anna");
    Person& ben = with_faces(world, "Ben");
    const auto face = some_face(20'000);
    anna->show_own_face(face);
    EXPECT_TRUE(world.until([&] { return sees_face(ben, anna.number(), face); }, 1min));
    EXPECT_NE(chief->manage(wire::ManageAction::set_role, anna.number(), wire::Role::observer), 0u);
    EXPECT_TRUE(world.until([&] { return ben->own_faces().empty(); }, 1min));
}

TEST(WorldFaces, PosesAreNotLateWhileAFaceIsSentOverASlowConnection) {
    World world;
    Person& anna = world.person("Anna");
    anna.path().bytes_per_second = 25e3;  // 200 kbit/s
    (void)world.joined("Anna");
    Person& ben = with_faces(world, "Ben");
    anna->show_own_face(some_face(200'000));
    world.advance(2s);
    Duration latest{};
    int seen = 0;
    for (int i = 0; i < 200; ++i) {
        wire::PersonPose pose;
        pose.time = anna->now();
        pose.head = wire::PartPose{{0, 1.6F, float(i) * 0.01F}, {1, 0, 0, 0}};
        anna->send_pose(pose);
        const TimePoint sent = world.now();
        if (world.until(
                [&] {
                    const auto poses = ben->poses();
                    const auto found = poses.find(anna.number());
                    return found != poses.end() && found->second.time >= pose.time;
                },
                2s)) {
            ++seen;
            latest = std::max(latest, Duration(world.now() - sent));
        }
        world.advance(30ms);
    }
    EXPECT_EQ(seen, 200);
    // 40 ms of way, a tick of the host, and one group of pieces (7 KiB: 290 ms) that has begun.
    EXPECT_LT(latest, 400ms);
    EXPECT_EQ(anna->own_face_state(), State::sending);  // it was being sent all the time
}

TEST(WorldFaces, ARecordingHasNone) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = with_faces(world, "Ben");
    SessionRecorder recorder(world, "Recorder");
    const auto face = some_face(30'000);
    anna->show_own_face(face);
    EXPECT_TRUE(world.until([&] { return sees_face(ben, anna.number(), face); }, 1min));
    world.advance(5s);
    recorder.finish();
    const Bytes file = files::read_file(recorder.file(), std::size_t(64) << 20);
    for (std::size_t at = 0; at + 24 < face->size(); at += 997) {
        const auto piece = ByteView(*face).subspan(at, 24);
        ASSERT_EQ(std::search(file.begin(), file.end(), piece.begin(), piece.end()), file.end());
    }
}

}  // namespace
}  // namespace theatron::world
