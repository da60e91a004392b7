// SPDX-License-Identifier: Apache-2.0
// A host and participants in simulated time, over links that delay, with poses that overtake
// requests and changes, participants that join and leave, and a host that restarts.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <random>

#include "session/room_replica.h"
#include "session/room_state.h"

namespace theatron::session {
namespace {

using namespace std::chrono_literals;

Pose at(double x) {
    return {{}, {x, 0, 0}};
}

constexpr ParticipantId anna{1}, ben{2};

// A room with one brick, created by anna.
struct OneBrick {
    RoomState host;
    ObjectId brick{};

    OneBrick() {
        host.on_joined(anna, {});
        host.on_joined(ben, {});
        brick =
            request(anna, 1, request::Create{ObjectKind::brick, at(0), 1, {}}).changes[0].object;
    }
    RoomState::Decision request(ParticipantId from, std::uint32_t number, const Request& request) {
        return host.on_request(from, number, request, true);
    }
    const RoomObject& object() const { return host.objects().at(brick); }
};

TEST(RoomState, LetsOneParticipantHoldAnObject) {
    OneBrick room;
    EXPECT_EQ(room.request(anna, 2, request::Grab{room.brick}).refusal, Refusal::none);
    EXPECT_EQ(room.request(ben, 1, request::Grab{room.brick}).refusal, Refusal::held_by_another);
    EXPECT_EQ(room.request(ben, 2, request::Remove{room.brick}).refusal, Refusal::held_by_another);
    EXPECT_EQ(room.request(ben, 3, request::Release{room.brick, 2, at(9), 1}).refusal,
              Refusal::not_held_by_you);
    EXPECT_EQ(room.request(anna, 3, request::Release{room.brick, 2, at(5), 2}).refusal,
              Refusal::none);
    EXPECT_EQ(room.object().room_from_object, at(5));
    EXPECT_EQ(room.object().scale, 2);
    EXPECT_EQ(room.request(ben, 4, request::Grab{room.brick}).refusal, Refusal::none);
}

TEST(RoomState, TakesOnlyPosesOfThePresentGripAndNewerOnes) {
    OneBrick room;
    room.request(anna, 2, request::Grab{room.brick});
    EXPECT_TRUE(room.host.on_pose(anna, {room.brick, {anna, 2}, TimePoint(20ms), at(2), 1}));
    EXPECT_FALSE(room.host.on_pose(anna, {room.brick, {anna, 2}, TimePoint(10ms), at(1), 1}));
    EXPECT_FALSE(room.host.on_pose(anna, {room.brick, {anna, 1}, TimePoint(30ms), at(1), 1}));
    EXPECT_FALSE(room.host.on_pose(ben, {room.brick, {anna, 2}, TimePoint(30ms), at(1), 1}));
    EXPECT_EQ(room.object().room_from_object, at(2));
    room.request(anna, 3, request::Release{room.brick, 2, at(3), 1});
    EXPECT_FALSE(room.host.on_pose(anna, {room.brick, {anna, 2}, TimePoint(40ms), at(4), 1}));
    EXPECT_EQ(room.object().room_from_object, at(3));
}

// The clock of the next holder may be a little behind that of the last one.
TEST(RoomState, TakesThePosesOfANewGripWhateverTheTimeOfTheLastOnes) {
    OneBrick room;
    room.request(anna, 2, request::Grab{room.brick});
    EXPECT_TRUE(room.host.on_pose(anna, {room.brick, {anna, 2}, TimePoint(50ms), at(2), 1}));
    room.request(anna, 3, request::HandOver{room.brick, 2, ben});
    const Grip given{ben, 3 | given_grip};
    EXPECT_TRUE(room.host.on_pose(ben, {room.brick, given, TimePoint(40ms), at(3), 1}));
    room.request(ben, 1, request::Release{room.brick, given.number, at(3), 1});
    room.request(anna, 4, request::Grab{room.brick});
    EXPECT_TRUE(room.host.on_pose(anna, {room.brick, {anna, 4}, TimePoint(30ms), at(4), 1}));
    EXPECT_EQ(room.object().room_from_object, at(4));
}

TEST(RoomState, HandsOverOnlyToSomebodyWhoIsThere) {
    OneBrick room;
    room.request(anna, 2, request::Grab{room.brick});
    EXPECT_EQ(room.request(anna, 3, request::HandOver{room.brick, 2, ParticipantId{7}}).refusal,
              Refusal::no_such_participant);
    EXPECT_EQ(room.request(anna, 4, request::HandOver{room.brick, 2, ben}).refusal, Refusal::none);
    EXPECT_EQ(room.object().grip, (Grip{ben, 4 | given_grip}));
    EXPECT_TRUE(room.host.on_pose(ben, {room.brick, room.object().grip, TimePoint(1ms), at(1), 1}));
    EXPECT_EQ(room.request(anna, 5, request::Release{room.brick, 2, at(9), 1}).refusal,
              Refusal::not_held_by_you);
}

TEST(RoomState, AGripThatComesAgainByGivingToOneselfKeepsItsNewestPose) {
    OneBrick room;
    room.request(anna, 2, request::Grab{room.brick});
    room.request(anna, 4, request::HandOver{room.brick, 2, ben});
    const Grip given{ben, 4 | given_grip};
    EXPECT_TRUE(room.host.on_pose(ben, {room.brick, given, TimePoint(50ms), at(3), 1}));
    room.request(ben, 4, request::HandOver{room.brick, given.number, ben});
    EXPECT_EQ(room.object().grip, given);
    EXPECT_EQ(room.object().moved_at, TimePoint(50ms));
}

TEST(RoomState, LetsGoWhatAParticipantHeldWhoLeaves) {
    OneBrick room;
    room.request(ben, 2, request::Grab{room.brick});
    room.host.on_pose(ben, {room.brick, {ben, 2}, TimePoint(1ms), at(4), 1});
    EXPECT_EQ(room.host.on_left(ben).size(), 2u);
    EXPECT_EQ(room.object().grip, Grip{});
    EXPECT_EQ(room.object().room_from_object, at(4));
    EXPECT_EQ(room.host.objects().size(), 2u) << "the brick and anna";
}

TEST(RoomState, LetsOnlyTheHostMakeAndChangePeople) {
    OneBrick room;
    const ObjectId person = room.host.objects().begin()->first;
    ASSERT_EQ(room.host.objects().at(person).kind, ObjectKind::person);
    EXPECT_EQ(room.request(ben, 1, request::Create{ObjectKind::person, at(0), 1, {}}).refusal,
              Refusal::role);
    EXPECT_EQ(room.request(anna, 2, request::SetProperties{person, Bytes(3)}).refusal,
              Refusal::role);
    EXPECT_EQ(room.request(anna, 3, request::Remove{person}).refusal, Refusal::role);
    EXPECT_EQ(room.request(anna, 4, request::Grab{person}).refusal, Refusal::no_such_object);
}

TEST(RoomState, BoundsThePropertiesOfAllObjectsTogether) {
    OneBrick room;
    const Bytes large(RoomState::max_property_bytes);
    std::size_t created = 0;
    std::uint32_t number = 2;
    while (
        room.request(anna, number++, request::Create{ObjectKind::mark, at(0), 1, large}).refusal ==
        Refusal::none)
        ++created;
    EXPECT_EQ(created, RoomState::max_property_bytes_of_all / RoomState::max_property_bytes);
    EXPECT_EQ(room.request(ben, 1, request::SetProperties{room.brick, Bytes(1)}).refusal,
              Refusal::too_many);
}

TEST(RoomState, RefusesWhatNoHonestClientSends) {
    OneBrick room;
    const double nan = std::nan("");
    EXPECT_EQ(room.request(ben, 1, request::Create{ObjectKind(77), at(0), 1, {}}).refusal,
              Refusal::malformed);
    EXPECT_EQ(room.request(ben, 2, request::Create{ObjectKind::brick, at(nan), 1, {}}).refusal,
              Refusal::malformed);
    EXPECT_EQ(room.request(ben, 3, request::Create{ObjectKind::brick, at(0), 0, {}}).refusal,
              Refusal::malformed);
    EXPECT_EQ(room.request(ben, 0, request::Grab{room.brick}).refusal, Refusal::malformed);
    EXPECT_EQ(room.request(ben, given_grip, request::Grab{room.brick}).refusal, Refusal::malformed);
    EXPECT_EQ(room.request(ben, 4, request::Grab{ObjectId{99}}).refusal, Refusal::no_such_object);
    EXPECT_EQ(room.host.on_request(ben, 5, request::Grab{room.brick}, false).refusal,
              Refusal::role);
    const Bytes large(RoomState::max_property_bytes + 1);
    EXPECT_EQ(room.request(ben, 6, request::SetProperties{room.brick, large}).refusal,
              Refusal::too_many);
    std::uint32_t number = 7;
    for (std::size_t i = 0; i < RoomState::max_objects_of_one; ++i)
        room.request(ben, number++, request::Create{ObjectKind::mark, at(0), 1, {}});
    EXPECT_EQ(room.request(ben, number, request::Create{ObjectKind::mark, at(0), 1, {}}).refusal,
              Refusal::too_many);
}

TEST(RoomState, GoesOnAfterARestartWithoutPeopleAndGrips) {
    OneBrick room;
    room.request(ben, 2, request::Grab{room.brick});
    RoomState again(room.host.snapshot());
    EXPECT_EQ(again.objects().size(), 1u);
    EXPECT_EQ(again.objects().at(room.brick).grip, Grip{});
    again.on_joined(anna, {});
    const auto created =
        again.on_request(anna, 1, request::Create{ObjectKind::brick, at(0), 1, {}}, true);
    EXPECT_GT(created.changes[0].object, room.brick) << "an id is never given again";
}

TEST(RoomReplica, ShowsItsOwnDoingAtOnceAndTakesItBackWhenRefused) {
    OneBrick room;
    RoomReplica replica(ben);
    replica.on_snapshot(room.host.snapshot());
    room.request(anna, 2, request::Grab{room.brick});  // ben does not know yet
    const std::uint32_t number = replica.request(request::Grab{room.brick});
    EXPECT_TRUE(replica.move(room.brick, at(3), 1, TimePoint(1ms)));
    EXPECT_EQ(replica.predicted().at(room.brick).room_from_object, at(3));
    EXPECT_EQ(replica.confirmed().at(room.brick).room_from_object, at(0));

    EXPECT_EQ(room.request(ben, number, request::Grab{room.brick}).refusal,
              Refusal::held_by_another);
    EXPECT_TRUE(replica.on_change({room.host.revision(), room.brick, room.object()}));
    replica.on_decision(number);
    EXPECT_TRUE(replica.take_poses_again().empty());
    EXPECT_EQ(replica.predicted(), room.host.objects());
    EXPECT_FALSE(replica.move(room.brick, at(4), 1, TimePoint(2ms)));
}

TEST(RoomReplica, DoesNotShowWhatTheHostCannotAccept) {
    OneBrick room;
    room.request(anna, 2, request::Grab{room.brick});
    RoomReplica replica(ben);
    replica.on_snapshot(room.host.snapshot());
    const auto grip = [&] { return replica.predicted().at(room.brick).grip; };
    replica.request(request::Grab{room.brick});
    EXPECT_EQ(grip(), (Grip{anna, 2})) << "it is held";
    replica.request(request::HandOver{room.brick, 2, ben});
    EXPECT_EQ(grip(), (Grip{anna, 2})) << "only its holder hands it over";
}

TEST(RoomReplica, GivesEachOwnPoseALaterTime) {
    OneBrick room;
    room.request(anna, 2, request::Grab{room.brick});
    RoomReplica replica(anna);
    replica.on_snapshot(room.host.snapshot());
    for (const double x : {1.0, 2.0})
        EXPECT_TRUE(room.host.on_pose(anna, *replica.move(room.brick, at(x), 1, TimePoint(5ms))));
    EXPECT_EQ(room.object().room_from_object, at(2));
}

TEST(RoomReplica, AsksForASnapshotWhenAChangeIsMissing) {
    OneBrick room;
    RoomReplica replica(ben);
    EXPECT_FALSE(replica.on_change({1, room.brick, room.object()})) << "before any snapshot";
    replica.on_snapshot(room.host.snapshot());
    EXPECT_TRUE(replica.on_change({1, room.brick, std::nullopt})) << "an old one changes nothing";
    EXPECT_EQ(replica.confirmed(), room.host.objects());
    EXPECT_FALSE(replica.on_change({room.host.revision() + 2, room.brick, std::nullopt}));
    EXPECT_EQ(replica.confirmed(), room.host.objects());
}

TEST(RoomReplica, TakesNoOlderPoseOfAnother) {
    OneBrick room;
    room.request(anna, 2, request::Grab{room.brick});
    RoomReplica replica(ben);
    replica.on_snapshot(room.host.snapshot());
    replica.on_pose({room.brick, {anna, 2}, TimePoint(20ms), at(2), 1});
    replica.on_pose({room.brick, {anna, 2}, TimePoint(10ms), at(1), 1});
    EXPECT_EQ(replica.predicted().at(room.brick).room_from_object, at(2));
}

// One participant with its link. Requests, changes and decisions keep their order; of poses only
// the newest of each object is under way, and it may overtake the others.
class Simulation {
public:
    explicit Simulation(unsigned seed) : random_(seed) {}

    // Random actions, for this many steps of a millisecond.
    void run(int steps) {
        for (int i = 0; i < steps; ++i) {
            now_ += 1ms;
            if (chance(0.002))
                join();
            if (chance(0.001) && !people_.empty())
                leave();
            if (chance(0.0002))
                restart_host();
            for (auto& person : people_)
                if (chance(0.05))
                    act(*person);
            deliver();
        }
    }
    // No actions until all messages have arrived.
    void settle() {
        for (int i = 0; i < 2000; ++i) {
            now_ += 1ms;
            deliver();
        }
    }
    std::size_t people() const { return people_.size(); }
    std::uint64_t hash_of_host() const { return hash_of(host_.objects()); }
    std::vector<std::uint64_t> hashes() const {
        std::vector<std::uint64_t> result;
        for (const auto& person : people_) {
            result.push_back(hash_of(person->replica.confirmed()));
            result.push_back(hash_of(person->replica.predicted()));
        }
        return result;
    }
    std::size_t objects() const { return host_.objects().size(); }
    std::size_t accepted() const { return accepted_; }

private:
    struct ToHost {
        std::uint32_t number = 0;  // 0: asks for a snapshot
        Request request;
    };
    struct Decided {
        std::uint32_t number = 0;
    };
    using FromHost = std::variant<ObjectChange, ObjectsSnapshot, Decided>;
    template <class Message>
    using Ordered = std::deque<std::pair<TimePoint, Message>>;
    using Poses = std::map<ObjectId, std::pair<TimePoint, ObjectPose>>;

    struct Person {
        ParticipantId id;
        RoomReplica replica;
        Ordered<ToHost> requests;
        Ordered<FromHost> news;
        Poses poses_up, poses_down;
        double x = 0;
        std::uint32_t decided = 0;  // as the host knows

        explicit Person(ParticipantId who) : id(who), replica(who) {}
    };

    bool chance(double share) { return std::uniform_real_distribution<>(0, 1)(random_) < share; }
    TimePoint arrival() {
        return now_ + Duration(std::uniform_int_distribution(1, 150)(random_) * 1000);
    }

    template <class Message>
    void send(Ordered<Message>& link, Message message) {
        const TimePoint after = link.empty() ? now_ : link.back().first;
        link.push_back({std::max(after, arrival()), std::move(message)});
    }
    void send(Poses& link, const ObjectPose& pose) {
        const auto known = link.find(pose.object);
        link[pose.object] = {known == link.end() ? arrival() : known->second.first, pose};
    }

    void join() {
        if (people_.size() >= 6)
            return;
        const ParticipantId id{++newest_participant_};
        tell({host_.on_joined(id, {})});
        people_.push_back(std::make_unique<Person>(id));
        send_snapshot(*people_.back());
    }
    void leave() {
        const auto who = people_.begin() + std::ptrdiff_t(random_() % people_.size());
        const ParticipantId id = (*who)->id;
        people_.erase(who);
        tell(host_.on_left(id));
    }
    void restart_host() {
        host_ = RoomState(host_.snapshot());
        people_.clear();  // they come back as other participants
    }
    void tell(const std::vector<ObjectChange>& changes) {
        for (const ObjectChange& change : changes)
            for (auto& person : people_)
                if (chance(0.01))
                    resynchronise(*person);
                else
                    send<FromHost>(person->news, change);
    }
    // As a host does for a peer that is too slow: drops waiting messages and sends a snapshot.
    void resynchronise(Person& person) {
        person.news.clear();
        send_snapshot(person);
    }
    void send_snapshot(Person& person) {
        ObjectsSnapshot snapshot = host_.snapshot();
        snapshot.decided = person.decided;
        send<FromHost>(person.news, std::move(snapshot));
    }
    std::uint32_t ask(Person& person, const Request& request) {
        const std::uint32_t number = person.replica.request(request);
        send(person.requests, ToHost{number, request});
        return number;
    }

    void act(Person& person) {
        const RoomObjects objects = person.replica.predicted();
        const auto bricks = std::count_if(objects.begin(), objects.end(), [](const auto& entry) {
            return entry.second.kind == ObjectKind::brick;
        });
        if (bricks == 0 || chance(0.05)) {
            if (bricks < 12)
                ask(person, request::Create{ObjectKind::brick, at(person.x), 1, {}});
            return;
        }
        const auto& [id, object] =
            *std::next(objects.begin(), std::ptrdiff_t(random_() % objects.size()));
        person.x += 0.25;
        if (object.grip.holder != person.id) {
            if (chance(0.1))
                ask(person, request::SetProperties{id, Bytes(1 + random_() % 9)});
            else if (chance(0.03))
                ask(person, request::Remove{id});
            else
                ask(person, request::Grab{id});
        } else if (chance(0.15)) {
            ask(person, request::Release{id, object.grip.number, at(person.x), 1 + person.x / 100});
        } else if (chance(0.05)) {
            ask(person,
                request::HandOver{id, object.grip.number, people_[random_() % people_.size()]->id});
        } else if (const auto pose = person.replica.move(id, at(person.x), 1, now_)) {
            send(person.poses_up, *pose);
        }
    }

    void deliver() {
        for (auto& person : people_) {
            for (; !person->requests.empty() && person->requests.front().first <= now_;
                 person->requests.pop_front())
                on_host(*person, person->requests.front().second);
            take_poses(person->poses_up, [&](const ObjectPose& pose) {
                if (host_.on_pose(person->id, pose))
                    for (auto& other : people_)
                        if (other != person)
                            send(other->poses_down, pose);
            });
        }
        for (auto& person : people_) {
            for (; !person->news.empty() && person->news.front().first <= now_;
                 person->news.pop_front())
                on_participant(*person, person->news.front().second);
            take_poses(person->poses_down,
                       [&](const ObjectPose& pose) { person->replica.on_pose(pose); });
        }
    }
    template <class Take>
    void take_poses(Poses& link, const Take& take) {
        for (auto entry = link.begin(); entry != link.end();)
            if (entry->second.first <= now_) {
                take(entry->second.second);
                entry = link.erase(entry);
            } else {
                ++entry;
            }
    }
    void on_host(Person& person, const ToHost& message) {
        if (message.number == 0)
            return send_snapshot(person);
        const RoomState::Decision decision =
            host_.on_request(person.id, message.number, message.request, true);
        accepted_ += decision.refusal == Refusal::none;
        tell(decision.changes);
        person.decided = message.number;
        send<FromHost>(person.news, Decided{message.number});
    }
    void on_participant(Person& person, const FromHost& message) {
        if (const auto* snapshot = std::get_if<ObjectsSnapshot>(&message))
            person.replica.on_snapshot(*snapshot);
        else if (const auto* decided = std::get_if<Decided>(&message)) {
            person.replica.on_decision(decided->number);
        } else if (!person.replica.on_change(std::get<ObjectChange>(message)))
            send(person.requests, ToHost{});
        for (const ObjectPose& pose : person.replica.take_poses_again())
            send(person.poses_up, pose);
    }

    std::mt19937 random_;
    TimePoint now_{};
    RoomState host_;
    std::uint32_t newest_participant_ = 0;
    std::vector<std::unique_ptr<Person>> people_;
    std::size_t accepted_ = 0;
};

TEST(Room, IsTheSameForAllOnceMessagesHaveArrived) {
    std::size_t compared = 0, accepted = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Simulation simulation(seed);
        for (int round = 0; round < 20; ++round) {
            simulation.run(500);
            simulation.settle();
            for (const std::uint64_t hash : simulation.hashes()) {
                ASSERT_EQ(hash, simulation.hash_of_host()) << "seed " << seed << " round " << round;
                ++compared;
            }
        }
        accepted += simulation.accepted();
    }
    EXPECT_GT(compared, 400u);
    EXPECT_GT(accepted, 2000u);
}

}  // namespace
}  // namespace theatron::session
