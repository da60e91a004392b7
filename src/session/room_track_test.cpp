// SPDX-License-Identifier: Apache-2.0
#include "session/room_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "session/room_bytes.h"

namespace theatron::session {
namespace {

using Parts = std::vector<RoomTrackWriter::Part>;

wire::PersonPose pose_at(TimePoint time, int person, bool has_hands) {
    const double t = to_seconds(time.time_since_epoch()) + person;
    const auto part = [&](double shift) {
        return wire::PartPose{{float(std::sin(t + shift)), float(1.6 + 0.1 * std::sin(3 * t)),
                               float(person + 0.3 * std::cos(t + shift))},
                              {float(std::cos(t / 2)), 0, float(std::sin(t / 2)), 0}};
    };
    wire::PersonPose pose;
    pose.time = time;
    pose.head = part(0);
    if (has_hands) {
        pose.left_hand = part(1);
        pose.right_hand = part(2);
    }
    return pose;
}

// A room in which people come, move and leave, and objects are made, moved and removed. Keeps the
// truth at each step.
struct Meeting {
    struct Moment {
        TimePoint time;
        std::uint64_t hash = 0;
        PoseBodies poses;
    };
    RoomTrackWriter writer;
    Parts parts;
    std::vector<Moment> moments;

    void run(int steps, unsigned seed) {
        std::minstd_rand random(seed);
        RoomObjects objects;
        PoseBodies poses;
        std::uint32_t next_id = 0;
        TimePoint now = from_us(1'000'000'000'007);
        for (int step = 0; step < steps; ++step) {
            now += Duration(11'111);
            const auto chance = [&](unsigned percent) { return random() % 100 < percent; };
            if (chance(3)) {
                RoomObject object;
                object.kind = ObjectKind::brick;
                object.creator = ParticipantId(random() % 5);
                object.properties = Bytes(random() % 9, std::byte(random()));
                objects[ObjectId(++next_id)] = object;
            }
            for (auto& [id, object] : objects)
                if (chance(30)) {
                    object.moved_at = now - Duration(random() % 5000);
                    object.room_from_object.translation.x = std::sin(double(random() % 1000));
                    object.grip = chance(50) ? object.grip
                                             : Grip{ParticipantId(random() % 3), unsigned(step)};
                }
            if (chance(2) && !objects.empty())
                objects.erase(objects.begin());
            writer.note_objects(objects, now);
            for (int person = 1; person < 5; ++person) {
                const auto id = ParticipantId(std::uint32_t(person));
                wire::PersonPose pose;
                if (!chance(1))
                    pose = pose_at(now, person, (step / 100 + person) % 2 == 0);
                pose.calls = pose.head && chance(10);
                pose.points = pose.right_hand && chance(30);
                if (!chance(80))
                    continue;
                writer.note_pose(id, pose, now);
                if (pose.head)
                    poses[id] = wire::encode_person_pose(pose);
                else
                    poses.erase(id);
            }
            if (step % 9 == 0)
                if (auto part = writer.take(now))
                    parts.push_back(std::move(*part));
            moments.push_back({now, hash_of(objects), poses});
        }
    }
};

// Plays parts up to a time.
struct Player {
    RoomTrackReader reader;
    std::size_t next = 0;

    void play(const Parts& parts, TimePoint until) {
        while (true) {
            while (reader.next() && *reader.next() <= until)
                if (reader.step() != Status::ok)
                    ADD_FAILURE() << "an entry was refused";
            if (reader.next() || next == parts.size() || parts[next].begin > until)
                return;
            const auto& part = parts[next++];
            (void)reader.begin(part.bytes, part.begin, part.key);
        }
    }
};

TEST(RoomTrack, GivesTheRoomAndAllPosesAtEachMoment) {
    Meeting meeting;
    meeting.run(2000, 7);
    Player player;
    std::size_t compared = 0;
    for (const Meeting::Moment& moment : meeting.moments) {
        if (moment.time < meeting.parts[0].begin || moment.time >= meeting.parts.back().begin)
            continue;
        player.play(meeting.parts, moment.time);
        ASSERT_EQ(hash_of(player.reader.objects()), moment.hash);
        ASSERT_EQ(player.reader.poses(), moment.poses);
        ++compared;
    }
    EXPECT_GT(compared, 1900u);
}

TEST(RoomTrack, GoesOnAtTheNextSnapshotWhereAPartIsMissing) {
    Meeting meeting;
    meeting.run(1000, 3);
    const std::size_t lost = 5;
    ASSERT_FALSE(meeting.parts[lost].key);
    Player player;
    for (const Meeting::Moment& moment : meeting.moments) {
        if (moment.time >= meeting.parts[lost].begin && player.next <= lost) {
            player.reader.lose();
            player.next = lost + 1;
        }
        if (moment.time < meeting.parts[0].begin || moment.time >= meeting.parts.back().begin)
            continue;
        player.play(meeting.parts, moment.time);
        const bool is_known = player.next > 0 && moment.time - meeting.parts[lost].begin > 2200ms;
        if (is_known) {
            ASSERT_EQ(hash_of(player.reader.objects()), moment.hash);
            ASSERT_EQ(player.reader.poses(), moment.poses);
        }
    }
    EXPECT_GT(player.next, lost + 20);
}

TEST(RoomTrack, WritesNothingWhileNothingChangesAndOneMoreSnapshotAfterTheLastChange) {
    RoomTrackWriter writer;
    RoomObjects objects;
    TimePoint now(5s);
    writer.note_objects(objects, now);
    ASSERT_TRUE(writer.take(now)->key);
    objects[ObjectId{1}].kind = ObjectKind::brick;
    writer.note_objects(objects, now += 100ms);
    EXPECT_FALSE(writer.take(now)->key);
    EXPECT_FALSE(writer.take(now += 100ms));
    EXPECT_TRUE(writer.take(now += 2s)->key);
    for (int i = 0; i < 10; ++i) {
        writer.note_objects(objects, now += 1s);
        EXPECT_FALSE(writer.take(now));
    }
}

TEST(RoomTrack, RefusesADamagedPartAndWhatRefersToIt) {
    Meeting meeting;
    meeting.run(300, 1);
    for (std::size_t cut = 0; cut < meeting.parts[0].bytes.size(); ++cut) {
        RoomTrackReader reader;
        Bytes bytes = meeting.parts[0].bytes;
        bytes.resize(cut);
        Status status = reader.begin(bytes, meeting.parts[0].begin, true);
        while (status == Status::ok && reader.next())
            status = reader.step();
        if (status == Status::ok)
            continue;  // cut between two entries
        EXPECT_EQ(reader.begin(meeting.parts[1].bytes, meeting.parts[1].begin, false),
                  Status::missing_reference);
    }
}

TEST(RoomTrack, AMovingPersonTakesLessThanFiveKilobytesASecond) {
    RoomTrackWriter writer;
    TimePoint now(100s);
    writer.note_objects({}, now);
    std::size_t bytes = 0;
    constexpr int people = 24, hertz = 90, seconds = 10;
    for (int i = 0; i < hertz * seconds; ++i, now += Duration(1'000'000 / hertz)) {
        for (int person = 0; person < people; ++person)
            writer.note_pose(ParticipantId(std::uint32_t(person)), pose_at(now, person, true), now);
        if (i % 9 == 8)
            bytes += writer.take(now)->bytes.size();
    }
    RecordProperty("bytes_per_second", int(bytes / seconds));
    EXPECT_LT(bytes / seconds / people, 5000u);
}

}  // namespace
}  // namespace theatron::session
