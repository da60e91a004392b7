// SPDX-License-Identifier: Apache-2.0
// Shared screens in the room, over messages: a host's and its members' halves.
#include "session/shared_screen.h"

#include <gtest/gtest.h>

#include "session/room_members_testing.h"
#include "session/screen_places.h"

namespace theatron::session {
namespace {

constexpr ParticipantId sharer{1}, guest{2}, watcher{3}, chief{4}, cart{9};
constexpr CameraId scope{5}, other{6};

Bytes person_of(int number) {
    return Bytes(16, std::byte(number));
}

class ScreensInRoom : public RoomMembers {
protected:
    ScreensInRoom() {
        join(sharer, Role::publisher, "Anna", person_of(1));
        join(guest, Role::expert, "Ben", person_of(2));
        join(watcher, Role::observer, "Cleo", person_of(3));
        join(chief, Role::operator_, "Dora", person_of(4));
    }
    static ScreenOffer offer(ParticipantId publisher = sharer, const std::string& name = "scope",
                             bool has_place = false) {
        ScreenOffer offered;
        offered.publisher = publisher;
        offered.publisher_name = publisher == cart ? "cart" : "Anna";
        offered.person = person_of(publisher == cart ? 2 : 1);
        offered.name = name;
        offered.calibration = screen_calibration({1920, 1080}, 1.2, {Quat{0, 1, 0, 0}, {1, 2, 3}});
        offered.calibration.registered = has_place;
        return offered;
    }
    ScreenPlace share(CameraId camera, const ScreenOffer& offered) {
        const HostRoom::ChosenPlace chosen = host.place_screen(offered);
        host.add_screen(camera, offered, chosen);
        deliver();
        return chosen.place;
    }
    ObjectId id_of(CameraId camera) {
        return find_screen(host.snapshot().objects, camera, "").value();
    }
    RoomObject object_of(CameraId camera) { return members[guest].objects().at(id_of(camera)); }
    SharedScreen facts_of(CameraId camera) {
        const RoomObject object = object_of(camera);
        return *decode_shared_screen(object.kind, object.properties);
    }
    Refusal pin(ParticipantId by, CameraId camera, bool pinned) {
        SharedScreen screen = facts_of(camera);
        screen.pinned = pinned;
        return ask(by, request::SetProperties{id_of(camera), encode_shared_screen(screen)});
    }
    // Leaves the screen with this place and width.
    Refusal put(ParticipantId by, CameraId camera, Vec3 place, double width_m) {
        const std::uint32_t grip = members[by].ask(request::Grab{id_of(camera)});
        return ask(by, request::Release{
                           id_of(camera), grip, {usual_screen_place.rotation, place}, width_m});
    }
    bool all_agree() {
        for (auto& [id, member] : members)
            if (hash_of(member.objects()) != hash_of(host.snapshot().objects))
                return false;
        return true;
    }

private:
};

TEST_F(ScreensInRoom, GetPlacesThatOverlapNeitherEachOtherNorTheFurniture) {
    std::vector<ScreenPlace> places;
    for (int i = 0; i < 6; ++i) {
        places.push_back(share(CameraId(10 + i), offer(sharer, "scope " + std::to_string(i))));
        EXPECT_TRUE(is_clear_of_furniture(places.back())) << i;
        for (int k = 0; k < i; ++k)
            EXPECT_FALSE(overlap(places[std::size_t(i)], places[std::size_t(k)])) << i << k;
    }
    EXPECT_EQ(places[0].room_from_screen, usual_screen_place);
    EXPECT_NEAR(places[0].height_m, 1.2 * 9 / 16, 1e-9);
    const ScreenPlace given = share(other, offer(sharer, "given", true));
    EXPECT_NEAR(length(given.room_from_screen.translation - Vec3{1, 2, 3}), 0, 1e-9);
}

TEST_F(ScreensInRoom, AFullRoomHasTheUsualPlace) {
    ScreenPlace last;
    for (int i = 0; i < 30; ++i)
        last = share(CameraId(10 + i), offer(sharer, std::to_string(i)));
    EXPECT_EQ(last.room_from_screen, usual_screen_place);
}

TEST_F(ScreensInRoom, AreMovedAndScaledByAllWhoHandleObjectsWithinLimits) {
    share(scope, offer());
    EXPECT_EQ(put(guest, scope, {0.5, 1.6, -1}, 2.5), Refusal::none);
    EXPECT_EQ(object_of(scope).scale, 2.5);
    EXPECT_EQ(place_of(object_of(scope), facts_of(scope)).height_m, 2.5 * 1080 / 1920);
    EXPECT_EQ(object_of(scope).creator, sharer);
    EXPECT_EQ(put(watcher, scope, {}, 1), Refusal::role);
    EXPECT_EQ(put(guest, scope, {}, 11), Refusal::malformed) << "the limit is 10 m";
    EXPECT_EQ(object_of(scope).scale, 2.5);
    host.leave(guest);
    deliver();
    EXPECT_EQ(host.snapshot().objects.at(id_of(scope)).grip.holder, ParticipantId{})
        << "the holder is gone";
}

TEST_F(ScreensInRoom, AHeldScreenIsNotTakenAndPosesKeepItsWidth) {
    share(scope, offer());
    const std::uint32_t number = members[guest].ask(request::Grab{id_of(scope)});
    deliver();
    EXPECT_EQ(ask(sharer, request::Grab{id_of(scope)}), Refusal::held_by_another);
    const Grip grip{guest, number};
    const auto pose = [&](int us, double width_m) {
        const Bytes body =
            encode_object_pose({id_of(scope), grip, from_us(us), Pose{{}, {1, 1, 1}}, width_m});
        const wire::State state{{wire::StateTopic::object, std::uint32_t(id_of(scope))}, body};
        return host.on_pose(guest, state, from_us(us)).receivers.size();
    };
    EXPECT_EQ(pose(10, 0.8), 3u);
    EXPECT_EQ(host.snapshot().objects.at(id_of(scope)).scale, 0.8);
    EXPECT_EQ(pose(20, 0.01), 0u);
    EXPECT_EQ(host.snapshot().objects.at(id_of(scope)).scale, 0.8);
}

TEST_F(ScreensInRoom, OnlyItsSharerAndOperatorsPinAScreenWhichNobodyHoldsThen) {
    share(scope, offer());
    EXPECT_EQ(pin(guest, scope, true), Refusal::of_sharer);
    EXPECT_EQ(pin(sharer, scope, true), Refusal::none);
    EXPECT_TRUE(facts_of(scope).pinned);
    for (const ParticipantId by : {sharer, guest, chief})
        EXPECT_EQ(ask(by, request::Grab{id_of(scope)}), Refusal::pinned);
    EXPECT_EQ(pin(guest, scope, false), Refusal::of_sharer);
    EXPECT_EQ(pin(chief, scope, false), Refusal::none);
    EXPECT_EQ(put(guest, scope, {0, 1, 0}, 1), Refusal::none);
    SharedScreen forged = facts_of(scope);
    forged.camera = other;
    EXPECT_EQ(ask(sharer, request::SetProperties{id_of(scope), encode_shared_screen(forged)}),
              Refusal::malformed);
    EXPECT_EQ(ask(sharer, request::SetProperties{id_of(scope), {}}), Refusal::malformed);
    EXPECT_TRUE(all_agree());
}

TEST_F(ScreensInRoom, OnlyItsSharerAndOperatorsEndAShareAlsoOutOfAHand) {
    share(scope, offer());
    share(other, offer(sharer, "second"));
    const ObjectId first = id_of(scope), second = id_of(other);
    const auto end = [&](ParticipantId by, ObjectId screen) {
        return host.on_request(by, {members[by].ask(request::Remove{screen}),
                                    encode_request(request::Remove{screen})});
    };
    EXPECT_EQ(end(guest, first), std::nullopt);
    EXPECT_EQ(end(sharer, first), scope);
    members[guest].ask(request::Grab{second});
    deliver();
    EXPECT_EQ(end(chief, second), other);
    deliver();
    EXPECT_FALSE(host.snapshot().objects.contains(first));
    EXPECT_FALSE(host.snapshot().objects.contains(second));
    EXPECT_TRUE(all_agree());
}

TEST_F(ScreensInRoom, ThePersonOfAPublisherInTheRoomIsTheSharer) {
    share(scope, offer(cart));
    EXPECT_EQ(object_of(scope).creator, guest) << "the same person";
    EXPECT_EQ(pin(guest, scope, true), Refusal::none);
    host.leave(guest);
    members.erase(guest);
    constexpr ParticipantId again{12};
    join(again, Role::expert, "Ben", person_of(2));
    EXPECT_EQ(host.snapshot().objects.at(id_of(scope)).creator, again);
}

TEST_F(ScreensInRoom, ALatecomerSeesThemAsTheyAre) {
    share(scope, offer());
    ASSERT_EQ(put(guest, scope, {0.5, 1.6, -1}, 2.5), Refusal::none);
    ASSERT_EQ(pin(sharer, scope, true), Refusal::none);
    constexpr ParticipantId late{20};
    join(late, Role::expert, "Eva");
    EXPECT_EQ(hash_of(members[late].objects()), hash_of(host.snapshot().objects));
    const RoomObjects seen = members[late].objects();
    EXPECT_TRUE(is_pinned(seen.at(*find_screen(seen, scope, ""))));
}

TEST_F(ScreensInRoom, ASourceThatComesBackHasItsPlaceWidthAndPin) {
    share(scope, offer());
    ASSERT_EQ(put(guest, scope, {0.5, 1.6, -1}, 2.5), Refusal::none);
    ASSERT_EQ(pin(sharer, scope, true), Refusal::none);
    host.remove_screen(scope);
    deliver();
    EXPECT_EQ(find_screen(host.snapshot().objects, scope, ""), std::nullopt);
    EXPECT_TRUE(all_agree());
    EXPECT_EQ(host.place_screen(offer(sharer, "another")).place.room_from_screen,
              usual_screen_place);
    share(other, offer());
    EXPECT_EQ(object_of(other).scale, 2.5);
    EXPECT_EQ(object_of(other).room_from_object.translation, (Vec3{0.5, 1.6, -1}));
    EXPECT_TRUE(facts_of(other).pinned);
}

TEST_F(ScreensInRoom, AKeptPlaceThatIsTakenMeanwhileIsGivenUp) {
    share(scope, offer());
    host.remove_screen(scope);
    share(other, offer(sharer, "another"));
    const ScreenPlace again = share(scope, offer());
    EXPECT_FALSE(overlap(again, place_of(object_of(other), facts_of(other))));
}

TEST_F(ScreensInRoom, AHostThatIsRestartedKeepsTheirPlaces) {
    share(scope, offer());
    ASSERT_EQ(put(guest, scope, {0.5, 1.6, -1}, 2.5), Refusal::none);
    ASSERT_EQ(pin(sharer, scope, true), Refusal::none);
    members[guest].ask(request::Grab{id_of(scope)});
    std::vector<Action> later;
    HostRoom restarted{{host.revision(), host.snapshot().objects, 0}, later};
    EXPECT_EQ(find_screen(restarted.snapshot().objects, scope, ""), std::nullopt)
        << "numbers of cameras begin again";
    restarted.add_screen(scope, offer(), restarted.place_screen(offer()));
    const RoomObjects objects = restarted.snapshot().objects;
    const RoomObject& screen = objects.at(*find_screen(objects, scope, ""));
    EXPECT_EQ(screen.scale, 2.5);
    EXPECT_EQ(screen.room_from_object.translation, (Vec3{0.5, 1.6, -1}));
    EXPECT_EQ(screen.grip, Grip{});
    EXPECT_TRUE(is_pinned(screen));
}

TEST_F(ScreensInRoom, SourcesOfTheSameNamesHaveEachItsOwnPlaceAlsoAfterARestart) {
    const ScreenOffer left = offer(), right = offer();
    ScreenOffer of_ben = offer();  // who calls himself Anna
    of_ben.person = person_of(2);
    constexpr CameraId third{7};
    share(scope, left);
    share(other, right);
    share(third, of_ben);
    ASSERT_EQ(put(guest, scope, {-1.5, 1.6, -1}, 0.5), Refusal::none);
    ASSERT_EQ(put(guest, other, {0, 1.6, -1}, 0.75), Refusal::none);
    ASSERT_EQ(put(guest, third, {1.5, 1.6, -1}, 1), Refusal::none);

    const auto widths_of = [&](HostRoom& room) {
        const auto bens = room.place_screen(of_ben);
        room.add_screen(third, of_ben, bens);
        const auto first = room.place_screen(left), second = room.place_screen(right, {first});
        room.add_screen(scope, left, first);
        room.add_screen(other, right, second);
        std::vector<double> widths;
        for (const CameraId camera : {scope, other, third}) {
            const RoomObjects objects = room.snapshot().objects;
            const RoomObject& screen = objects.at(*find_screen(objects, camera, ""));
            EXPECT_NEAR(screen.room_from_object.translation.y, 1.6, 1e-9) << "an earlier place";
            widths.push_back(screen.scale);
        }
        return widths;
    };
    std::vector<Action> later;
    HostRoom restarted{{host.revision(), host.snapshot().objects, 0}, later, host.authors()};
    EXPECT_EQ(widths_of(restarted), (std::vector{0.5, 0.75, 1.0}));
    for (const CameraId camera : {scope, other, third})
        host.remove_screen(camera);
    EXPECT_EQ(widths_of(host), (std::vector{0.5, 0.75, 1.0})) << "the publishers come back";
}

TEST_F(ScreensInRoom, FewPlacesOfSourcesThatAreAwayAreKept) {
    for (int i = 0; i < int(HostRoom::max_kept_screens) + 5; ++i) {
        share(CameraId(i), offer(sharer, std::to_string(i)));
        host.remove_screen(CameraId(i));
    }
    std::size_t kept = 0;
    for (const auto& [id, object] : host.snapshot().objects)
        kept += is_shared_screen(object);
    EXPECT_EQ(kept, HostRoom::max_kept_screens);
}

TEST_F(ScreensInRoom, ANewSessionForgetsPlacesOfSourcesThatAreAway) {
    share(scope, offer());
    share(other, offer(sharer, "second"));
    host.remove_screen(scope);
    host.clear();
    deliver();
    std::size_t screens = 0;
    for (const auto& [id, object] : members[guest].objects())
        screens += is_shared_screen(object);
    EXPECT_EQ(screens, 1u);
    EXPECT_TRUE(find_screen(members[guest].objects(), other, ""));
}

TEST_F(ScreensInRoom, ACaseLeavesThemAlone) {
    CaseFacts liver;
    liver.screen = CaseScreen{};
    host.set_cases({liver});
    share(scope, offer());
    const auto open = [&] {
        return ask(guest, request::Create{
                              ObjectKind::organ, {}, 1, encode_case_object(CaseOrgan{liver.id})});
    };
    EXPECT_EQ(open(), Refusal::none);
    EXPECT_EQ(open(), Refusal::none);
    EXPECT_TRUE(find_screen(members[guest].objects(), scope, ""));
    EXPECT_TRUE(case_in_room(members[guest].objects())->screen);
    EXPECT_EQ(
        ask(sharer,
            request::Create{ObjectKind::screen, {}, 1, encode_shared_screen(facts_of(scope))}),
        Refusal::malformed)
        << "only publishing makes a screen";
}

TEST(SharedScreen, IsReadAsItWasWrittenAndNothingElseIs) {
    const SharedScreen screen{CameraId{7}, true, {640, 480}, "Anna", "scope"};
    const Bytes bytes = encode_shared_screen(screen);
    EXPECT_EQ(decode_shared_screen(ObjectKind::screen, bytes), screen);
    EXPECT_FALSE(decode_shared_screen(ObjectKind::brick, bytes));
    EXPECT_FALSE(decode_case_object(ObjectKind::screen, bytes));
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_shared_screen(ObjectKind::screen, ByteView(bytes).first(size)));
    Bytes wrong = bytes;
    wrong.push_back({});
    EXPECT_FALSE(decode_shared_screen(ObjectKind::screen, wrong));
    wrong = bytes;
    wrong[3] = std::byte(2);  // flags
    EXPECT_FALSE(decode_shared_screen(ObjectKind::screen, wrong));
    SharedScreen flat = screen;
    flat.picture = {0, 480};
    EXPECT_FALSE(decode_shared_screen(ObjectKind::screen, encode_shared_screen(flat)));
}

TEST(SharedScreen, AReplayShowsTheCameraOfTheRecordedName) {
    RoomObjects objects;
    const auto add = [&](std::uint32_t id, int camera, const char* name) {
        RoomObject object;
        object.kind = ObjectKind::screen;
        object.properties =
            encode_shared_screen({CameraId(camera), false, {640, 480}, "Anna", name});
        objects[ObjectId(id)] = object;
    };
    add(recorded_bit | 1, 4, "scope");
    EXPECT_EQ(find_screen(objects, CameraId{0}, "scope"), ObjectId(recorded_bit | 1));
    EXPECT_EQ(find_screen(objects, CameraId{4}, "lamp"), std::nullopt);
    add(9, 0, "scope");
    EXPECT_EQ(find_screen(objects, CameraId{0}, "scope"), ObjectId(9)) << "a live one";
}

TEST(ScreenPlaces, ScreensThatTouchTheirNeighbourOverlapInAnyDirection) {
    const ScreenPlace first{usual_screen_place, 1.2, 0.675};
    const auto at = [&](Vec3 by, double degrees = 0) {
        const Pose turned{rotation_about({0, 1, 0}, radians_of(degrees)), {}};
        return ScreenPlace{
            {turned.rotation * usual_screen_place.rotation, usual_screen_place.translation + by},
            1.2,
            0.675};
    };
    EXPECT_TRUE(overlap(first, at({0.5, 0.3, 0})));
    EXPECT_FALSE(overlap(first, at({1.3, 0, 0})));
    EXPECT_FALSE(overlap(first, at({0, 0.9, 0})));
    EXPECT_FALSE(overlap(first, at({0, 0, 0.3})));
    EXPECT_TRUE(overlap(first, at({0, 0, 0.3}, 60))) << "it goes through the first";
    EXPECT_TRUE(is_clear_of_furniture(first));
    EXPECT_FALSE(is_clear_of_furniture(at({1.5, 0, 0}))) << "the hanging monitor";
    EXPECT_FALSE(is_clear_of_furniture(at({0, 0, -3}))) << "the wall";
    EXPECT_FALSE(is_clear_of_furniture(at({0, 1, 0}))) << "the ceiling";
}

}  // namespace
}  // namespace theatron::session
