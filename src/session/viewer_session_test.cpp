// SPDX-License-Identifier: Apache-2.0
#include "session/viewer_session.h"

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

// Host and viewer, each fed with the messages of the other.
TEST_F(Host, AViewerJoinsAndChangesItsCodec) {
    ViewerSession viewer({"secret", "Dr. A", "trvl", "jpeg"});
    session.on_connected(alice, now);
    session.on_control(alice, viewer.begin(), now);
    std::vector<ViewerSession::Change> changes;
    const auto deliver = [&] {
        changes.clear();
        for (const auto& a : all<action::Send>(session.take_actions()))
            changes.push_back(viewer.on_control(wire::encode(a.message)));
    };
    deliver();
    using Change = ViewerSession::Change;
    EXPECT_EQ(changes, (std::vector{Change::welcomed, Change::standing, Change::settings}));
    EXPECT_EQ(viewer.cameras().size(), 1u);
    EXPECT_EQ(viewer.settings().size(), 2u);

    session.on_control(alice, viewer.choose("rvl", ""), now);
    deliver();
    EXPECT_EQ(changes, std::vector{Change::settings});
    EXPECT_EQ(viewer.settings()[0].codec, "rvl");
    EXPECT_EQ(viewer.wishes().depth_codec, "rvl");

    session.on_control(alice, viewer.choose("bad", ""), now);
    deliver();
    EXPECT_EQ(viewer.note(), wire::as_written("There is no codec bad."));
    EXPECT_EQ(viewer.settings()[0].codec, "rvl");

    session.set_renderer({"mesh", true});
    deliver();
    EXPECT_EQ(changes, std::vector{Change::renderer});
    EXPECT_EQ(viewer.renderer_command(), (wire::SetRenderer{"mesh", true}));
    (void)viewer.begin();
    EXPECT_EQ(viewer.renderer_command(), wire::SetRenderer{}) << "another host may think otherwise";
}

TEST_F(Host, EverybodyIsToldOnceThatTheSessionIsOver) {
    join(alice);
    session.on_connected(bob, now);  // has not joined
    session.take_actions();
    session.end();
    session.end();
    const auto ends = all<action::End>(session.take_actions());
    ASSERT_EQ(ends.size(), 1u);
    const action::End* end = ends.data();
    EXPECT_EQ(end->participant, alice);

    ViewerSession viewer({});
    EXPECT_EQ(viewer.on_control(wire::encode(end->message)), ViewerSession::Change::goodbye);
    EXPECT_EQ(viewer.goodbye().code, wire::TextCode::session_over);
    (void)viewer.begin();
    EXPECT_TRUE(viewer.goodbye().empty());
}

TEST(ViewerSession, IgnoresWhatItDoesNotUnderstand) {
    ViewerSession viewer({});
    EXPECT_EQ(viewer.on_control(Bytes(7)), ViewerSession::Change::nothing);
    EXPECT_EQ(viewer.on_control(wire::encode(wire::Refused{})), ViewerSession::Change::refused);
    EXPECT_EQ(viewer.refusal().code, wire::TextCode::no_reason);
}

// A host that speaks a protocol which this program does not know should have refused it.
TEST(ViewerSession, AWelcomeInAnotherProtocolIsNotEnteredAndSaysWhatToUpdate) {
    const auto of_protocol = [](int protocol) {
        return wire::encode(wire::Welcome{std::uint16_t(protocol), ParticipantId{7}, "OR 3"});
    };
    const std::string newest = std::to_string(wire::protocol_max);
    const std::string next = std::to_string(wire::protocol_max + 1);
    const std::string oldest = std::to_string(wire::protocol_min);
    const std::string before = std::to_string(wire::protocol_min - 1);
    ViewerSession viewer({});
    EXPECT_EQ(viewer.on_control(of_protocol(wire::protocol_max + 1)),
              ViewerSession::Change::refused);
    EXPECT_FALSE(viewer.joined());
    EXPECT_EQ(wire::english(viewer.refusal()), "Your Theatron is too old for this host (protocol " +
                                                   newest + ", it needs " + next + "); update it.");
    (void)viewer.begin();
    EXPECT_TRUE(viewer.refusal().empty()) << "the host may be another one now";
    EXPECT_EQ(viewer.on_control(of_protocol(wire::protocol_min - 1)),
              ViewerSession::Change::refused);
    EXPECT_EQ(wire::english(viewer.refusal()), "This host is older than your Theatron (protocol " +
                                                   before + ", you need " + oldest +
                                                   "); update the host.");
    (void)viewer.begin();
    for (int known = wire::protocol_min; known <= wire::protocol_max; ++known)
        EXPECT_EQ(viewer.on_control(of_protocol(known)), ViewerSession::Change::welcomed);
}

TEST(ViewerSession, ANewerHostRefusesInAnUnderstandableSentence) {
    ViewerSession viewer({});
    (void)viewer.on_control(
        wire::encode(wire::Refused{"The door is locked.", {wire::TextCode{199}, {"7"}}}));
    EXPECT_EQ(wire::english(viewer.refusal()), "The door is locked.");
    (void)viewer.on_control(wire::encode(wire::Refused{"", {wire::TextCode{199}, {"7"}}}));
    EXPECT_NE(wire::english(viewer.refusal()).find("199, 7"), std::string::npos);
    (void)viewer.on_control(wire::encode(wire::Refused{"Falsch.", {wire::TextCode::link_expired}}));
    EXPECT_EQ(viewer.refusal().code, wire::TextCode::link_expired) << "the code counts";
}

}  // namespace
}  // namespace theatron::session
