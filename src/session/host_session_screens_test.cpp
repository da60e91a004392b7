// SPDX-License-Identifier: Apache-2.0
// Screens that participants share with a session, from the offer to the end.
#include <gtest/gtest.h>

#include "session/host_session_testing.h"
#include "session/screen_places.h"
#include "session/shared_screen.h"

namespace theatron::session {
namespace {

class SharedScreens : public Host {
protected:
    void come(ParticipantId id, const char* token, std::vector<wire::Feature> features) {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.name = "person " + std::to_string(std::uint32_t(id));
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = std::move(features);
        say(id, hello);
    }
    void publish(ParticipantId id, std::vector<std::string> names, bool has_place = false) {
        wire::Publish offer;
        for (const std::string& name : names) {
            Calibration calibration = screen_calibration({1280, 720}, 1, {{}, {4, 5, 6}});
            calibration.registered = has_place;
            offer.cameras.push_back({name, true, 30, encode_calibration(calibration)});
        }
        say(id, offer);
    }
    ScreenPlace place(CameraId camera) {
        return screen_place(*decode_calibration(
            session.streams().cameras().find(camera)->description().calibration));
    }
    std::optional<ObjectId> object(CameraId camera) {
        return find_screen(session.room().snapshot().objects, camera, "");
    }
    void end(ParticipantId by, CameraId camera, std::uint32_t number = 1) {
        say(by, wire::RoomRequest{number, encode_request(request::Remove{*object(camera)})});
    }

    using F = wire::Feature;
};

TEST_F(SharedScreens, OfOneOfferGetFreePlacesThatAllSeeAlsoOlderPrograms) {
    come(alice, "publish", {F::publish, F::screens});
    come(bob, "secret", {});  // knows nothing of the room's objects
    publish(alice, {"scope", "tower"});
    const CameraId scope{1}, tower{2};
    EXPECT_FALSE(overlap(place(scope), place(tower)));
    const auto added = sent<wire::CamerasAdded>(bob, session.take_actions());
    ASSERT_EQ(added.size(), 1u);
    EXPECT_EQ(screen_place(*decode_calibration(added[0].cameras[0].calibration)).width_m, 1);
    for (const CameraId camera : {scope, tower}) {
        const RoomObjects objects = session.room().snapshot().objects;
        const RoomObject& screen = objects.at(*object(camera));
        EXPECT_NEAR(length(screen.room_from_object.translation -
                           place(camera).room_from_screen.translation),
                    0, 1e-9);
        EXPECT_EQ(screen.creator, alice);
    }
    publish(alice, {"placed"}, true);
    EXPECT_NEAR(length(place(CameraId{3}).room_from_screen.translation - Vec3{4, 5, 6}), 0, 1e-9);
}

TEST_F(SharedScreens, AreEndedByTheirSharerForAll) {
    come(alice, "publish", {F::publish, F::screens, F::room});
    come(bob, "secret", {F::room});
    publish(alice, {"scope", "tower"});
    (void)session.take_actions();
    end(bob, CameraId{1});
    EXPECT_TRUE(session.streams().cameras().find(CameraId{1})) << "Bob does not share it";
    (void)session.take_actions();
    end(alice, CameraId{1});
    const auto actions = session.take_actions();
    EXPECT_FALSE(session.streams().cameras().find(CameraId{1}));
    EXPECT_FALSE(object(CameraId{1}));
    EXPECT_TRUE(object(CameraId{2}));
    ASSERT_EQ(sent<wire::CamerasRemoved>(bob, actions).size(), 1u);
    const auto ended = sent<wire::ShareEnded>(alice, actions);
    ASSERT_EQ(ended.size(), 1u);
    EXPECT_EQ(ended[0].cameras, std::vector{CameraId{1}});
    EXPECT_EQ(ended[0].by, "person 1");
}

TEST_F(SharedScreens, AnOlderPublisherIsNotToldAndItsPicturesAreIgnored) {
    come(alice, "publish", {F::publish, F::room});
    publish(alice, {"scope"});
    (void)session.take_actions();
    end(alice, CameraId{1});
    EXPECT_TRUE(sent<wire::ShareEnded>(alice, session.take_actions()).empty());
    wire::MediaHeader header;
    header.stream = color_stream(CameraId{1});
    header.key = true;
    header.captured = now;
    Bytes message(wire::media_header_size);
    wire::write_media_header(header, message.data());
    EXPECT_TRUE(session.on_media_from(alice, message, now).receivers.empty());
    EXPECT_TRUE(all<action::Close>(session.take_actions()).empty());
}

TEST_F(SharedScreens, OfTheHostAreHandledWhereTheyHaveNoPlaceButDoNotEnd) {
    HostSession::Config own = config();
    own.admission.tokens.push_back({"operator", Role::operator_, {}});
    for (const bool has_place : {false, true}) {
        Calibration calibration = screen_calibration({1280, 720}, 1, {{}, {4, 5, 6}});
        calibration.registered = has_place;
        wire::Camera camera;
        camera.name = has_place ? "fixed" : "scope";
        camera.has_color = true;
        camera.calibration = encode_calibration(calibration);
        own.cameras.push_back(camera);
    }
    HostSession host(own);
    const RoomObjects objects = host.room().snapshot().objects;
    const auto screen = find_screen(objects, CameraId{1}, "");
    ASSERT_TRUE(screen);
    EXPECT_EQ(objects.at(*screen).room_from_object, usual_screen_place);
    EXPECT_FALSE(find_screen(objects, CameraId{2}, ""));
    host.on_connected(alice, now);
    wire::Join hello;
    hello.token = "operator";
    hello.depth_codec = "trvl";
    hello.color_codec = "jpeg";
    hello.features = {F::room};
    host.on_control(alice, wire::encode(hello), now);
    const wire::RoomRequest end{1, encode_request(request::Remove{*screen})};
    host.on_control(alice, wire::encode(wire::ToHost(end)), now);
    EXPECT_TRUE(find_screen(host.room().snapshot().objects, CameraId{1}, ""));
    EXPECT_TRUE(host.streams().cameras().find(CameraId{1}));
}

TEST_F(SharedScreens, APublisherThatIsLostLeavesItsPlaceToTheNextConnection) {
    come(alice, "publish", {F::publish, F::room});
    come(bob, "secret", {F::room});
    publish(alice, {"scope"});
    const ObjectId screen = *object(CameraId{1});
    say(bob, wire::RoomRequest{1, encode_request(request::Grab{screen})});
    say(bob, wire::RoomRequest{2, encode_request(request::Release{
                                      screen, 1, {usual_screen_place.rotation, {0, 1.4, -1}}, 2})});
    session.on_closed(alice);
    EXPECT_FALSE(object(CameraId{1}));
    session.on_connected(carol, now);
    wire::Join again;
    again.token = "publish";
    again.name = "person 1";
    again.depth_codec = "trvl";
    again.color_codec = "jpeg";
    again.features = {F::publish, F::room};
    say(carol, again);
    publish(carol, {"scope"});
    EXPECT_EQ(object(CameraId{2}), screen);
    EXPECT_NEAR(place(CameraId{2}).width_m, 2, 1e-9);
    EXPECT_NEAR(length(place(CameraId{2}).room_from_screen.translation - Vec3{0, 1.4, -1}), 0,
                1e-9);
}

}  // namespace
}  // namespace theatron::session
