// SPDX-License-Identifier: Apache-2.0
#include "session/renderer_wishes.h"

#include "session/host_session_testing.h"
#include "session/renderer_choice.h"

namespace theatron::session {
namespace {

TEST_F(Host, SetsTheRendererOfOneOfANameOrOfAll) {
    const auto heard = [&](ParticipantId id, const auto& actions) {
        std::string text;
        for (const auto& command : sent<wire::SetRenderer>(id, actions))
            text += command.renderer + (command.locked ? "!" : "") + ";";
        return text;
    };
    join(alice);
    EXPECT_EQ(heard(alice, session.take_actions()), "") << "nothing was said yet";
    session.set_renderer({"mesh", true});
    session.set_renderer(dave, {"splat", false});  // who is not in
    auto actions = session.take_actions();
    EXPECT_EQ(heard(alice, actions), "mesh!;");
    EXPECT_EQ(heard(dave, actions), "");

    join(bob);
    EXPECT_EQ(heard(bob, session.take_actions()), "mesh!;") << "a later participant gets it, too";
    session.set_renderer(bob, {"blend", false});
    actions = session.take_actions();
    EXPECT_EQ(heard(alice, actions), "");
    EXPECT_EQ(heard(bob, actions), "blend;");
    session.on_closed(bob);
    join(bob);
    EXPECT_EQ(heard(bob, session.take_actions()), "mesh!;") << "a number is of one connection";

    session.set_renderer("guest", {"disc", true});  // as both are called
    actions = session.take_actions();
    EXPECT_EQ(heard(alice, actions) + heard(bob, actions), "disc!;disc!;");
    session.on_closed(bob);
    join(bob);
    EXPECT_EQ(heard(bob, session.take_actions()), "disc!;") << "a name is found again";
    session.set_renderer({"", false});
    join(carol);
    EXPECT_EQ(heard(carol, session.take_actions()), ";") << "names are forgotten";
}

TEST_F(Host, LogsHowSomebodyDrawsWhenThatChanges) {
    join(alice);
    session.take_actions();
    for (const char* renderer : {"mesh", "mesh", "ble\nnd", ""}) {
        now += 1s;
        say(alice, wire::Report{{}, renderer});
    }
    // A change so soon is believed when it is said again.
    say(alice, wire::Report{{}, "disc"});
    now += 1s;
    say(alice, wire::Report{{}, "splat"});
    std::vector<std::string> noted;
    for (const auto& a : all<action::Drawing>(session.take_actions()))
        noted.push_back(a.renderer);
    EXPECT_EQ(noted, (std::vector<std::string>{"mesh", "ble nd", "", "splat"}));
}

TEST(RendererChoice, TheLastWordHoldsUnlessTheHostLocksIt) {
    RendererChoice choice("auto");
    choice.follow({"mesh", false});
    EXPECT_EQ(choice.renderer(), "mesh");
    EXPECT_TRUE(choice.choose("splat"));
    EXPECT_EQ(choice.renderer(), "splat");
    choice.follow({"blend", true});
    EXPECT_FALSE(choice.choose("splat"));
    EXPECT_EQ(choice.renderer(), "blend");
    choice.follow({"", false});
    EXPECT_EQ(choice.renderer(), "blend") << "given back as it is";
    EXPECT_TRUE(choice.choose("splat"));
}

TEST(RendererChoice, TheChoiceFromBeforeTheLockComesBackAsItsOwn) {
    RendererChoice choice("auto");
    choice.follow({"mesh", true});
    choice.follow({"blend", true});
    choice.follow({own_renderer, false});
    EXPECT_EQ(choice.renderer(), "auto");
    EXPECT_FALSE(choice.locked());
    choice.follow({"splat", false});
    choice.follow({"mesh", true});
    choice.follow({"", false});  // a new connection
    choice.follow({"mesh", true});
    choice.follow({own_renderer, false});
    EXPECT_EQ(choice.renderer(), "splat");
}

}  // namespace
}  // namespace theatron::session
