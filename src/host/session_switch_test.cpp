// SPDX-License-Identifier: Apache-2.0
#include "host/session_switch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "wire/control.h"

namespace theatron::host {
namespace {

using net::PeerId;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Bytes join_with(const std::string& token) {
    wire::Join join;
    join.token = token;
    join.name = "Ada";
    return wire::encode(wire::ToHost(join));
}

class SwitchOfTwo : public ::testing::Test {
protected:
    // A session that notes its calls as "NAME CALL PEER".
    PortSession session(const std::string& name, const std::string& token) {
        PortSession s;
        const auto note = [this, name](const char* what) {
            return [this, name, what](PeerId peer, const auto&... rest) {
                calls.push_back(name + " " + what + " " + std::to_string(int(peer)));
                if (throws == name)
                    throw std::runtime_error("fault");
                (void)sizeof...(rest);
            };
        };
        s.events.connected = note("connected");
        s.events.control = note("control");
        s.events.state = note("state");
        s.events.voice = note("voice");
        s.events.frame_left = note("frame_left");
        s.events.control_lost = note("control_lost");
        s.events.closed = note("closed");
        s.events.media = [n = note("media")](PeerId peer, Bytes&) {
            n(peer);
            return false;
        };
        s.events.tick = [n = note("tick")] { n(PeerId{}); };
        s.events.alarm = [n = note("alarm")] { n(PeerId{}); };
        s.find_token = [token](const std::string& secret) {
            std::optional<session::Admission::Token> found;
            if (secret == token)
                found = session::Admission::Token{token, wire::Role::expert, std::nullopt, ""};
            return found;
        };
        return s;
    }
    void enter(PeerId peer, const std::string& token) {
        sessions.connected(peer, "10.0.0.1", true);
        sessions.control(peer, join_with(token));
    }
    std::vector<std::string> take() { return std::exchange(calls, {}); }

    std::vector<std::string> calls;
    std::vector<TimePoint> alarms;
    std::string throws;  // the session whose calls throw
    std::vector<net::PeerId> turned_back;
    SessionSwitch sessions{[this](TimePoint when) { alarms.push_back(when); },
                           [this](net::PeerId peer) { turned_back.push_back(peer); }};
    const SessionNumber first = sessions.add(session("first", "token-1")),
                        second = sessions.add(session("second", "token-2"));
};

TEST_F(SwitchOfTwo, LeadsEachConnectionToTheSessionOfItsToken) {
    enter(PeerId{7}, "token-2");
    EXPECT_THAT(take(), ElementsAre("second connected 7", "second control 7"));
    enter(PeerId{8}, "token-1");
    EXPECT_THAT(take(), ElementsAre("first connected 8", "first control 8"));

    Bytes bytes;
    sessions.control(PeerId{7}, {});
    sessions.state(PeerId{7}, {});
    sessions.voice(PeerId{8}, {});
    sessions.frame_left(PeerId{8});
    sessions.control_lost(PeerId{7});
    EXPECT_FALSE(sessions.media(PeerId{8}, bytes));
    sessions.closed(PeerId{7}, "left");
    EXPECT_THAT(take(), ElementsAre("second control 7", "second state 7", "first voice 8",
                                    "first frame_left 8", "second control_lost 7", "first media 8",
                                    "second closed 7"));
}

// A later token does not move a connection.
TEST_F(SwitchOfTwo, KeepsAConnectionWhereItEntered) {
    enter(PeerId{7}, "token-2");
    (void)take();
    sessions.control(PeerId{7}, join_with("token-1"));
    EXPECT_THAT(take(), ElementsAre("second control 7"));
}

TEST_F(SwitchOfTwo, LeadsOthersToTheOldestSessionWhichRefusesThem) {
    EXPECT_TRUE(sessions.is_invited(join_with("token-1")));
    EXPECT_TRUE(sessions.is_invited(join_with("token-2")));
    EXPECT_FALSE(sessions.is_invited(join_with("token-3")));
    EXPECT_FALSE(sessions.is_invited({}));
    enter(PeerId{7}, "token-3");
    EXPECT_THAT(take(), ElementsAre("first connected 7", "first control 7"));
}

// A camera may take long to open after the host has begun.
TEST_F(SwitchOfTwo, TurnsBackThoseWhoseSessionIsNotOpenYet) {
    sessions.set_closed({{"third", "", {"token-3"}}, {"second", "", {"token-2"}}});
    EXPECT_TRUE(sessions.is_invited(join_with("token-3")));
    enter(PeerId{7}, "token-3");
    EXPECT_THAT(take(), IsEmpty());
    EXPECT_THAT(turned_back, ElementsAre(PeerId{7}));
    enter(PeerId{8}, "token-2");
    EXPECT_THAT(take(), ElementsAre("second connected 8", "second control 8")) << "it is open";
    sessions.set_closed({});
    EXPECT_FALSE(sessions.is_invited(join_with("token-3")));
}

TEST_F(SwitchOfTwo, CallsNothingOfASessionThatHasLeft) {
    enter(PeerId{7}, "token-2");
    enter(PeerId{8}, "token-1");
    sessions.set_alarm(second, from_us(100));
    (void)take();
    EXPECT_THAT(sessions.remove(second), ElementsAre(PeerId{7}));
    EXPECT_FALSE(sessions.is_invited(join_with("token-2")));
    Bytes bytes;
    sessions.control(PeerId{7}, {});
    EXPECT_TRUE(sessions.media(PeerId{7}, bytes)) << "nothing waits for a session that has left";
    sessions.closed(PeerId{7}, "left");
    sessions.alarm(from_us(200));
    EXPECT_THAT(take(), IsEmpty());
    sessions.control(PeerId{8}, {});
    EXPECT_THAT(take(), ElementsAre("first control 8"));
}

TEST_F(SwitchOfTwo, ForgetsAConnectionThatEndsBeforeItsFirstMessage) {
    sessions.connected(PeerId{7}, "10.0.0.1", true);
    sessions.closed(PeerId{7}, "gone");
    sessions.control(PeerId{7}, join_with("token-2"));
    EXPECT_THAT(take(), IsEmpty());
}

TEST_F(SwitchOfTwo, SetsTheEarliestAlarmAndCallsThoseThatAreDue) {
    sessions.set_alarm(first, from_us(300));
    sessions.set_alarm(second, from_us(200));
    EXPECT_THAT(alarms, ElementsAre(from_us(300), from_us(200)));
    sessions.alarm(from_us(200));
    EXPECT_THAT(take(), ElementsAre("second alarm 0"));
    EXPECT_EQ(alarms.back(), from_us(300));
    sessions.set_alarm(first, from_us(400));
    EXPECT_EQ(alarms.back(), from_us(400)) << "a session's new alarm replaces its old one";
    sessions.alarm(from_us(399));
    EXPECT_THAT(take(), IsEmpty());
    EXPECT_EQ(alarms.size(), 5u) << "an alarm that came too early is set again";
    sessions.alarm(from_us(400));
    EXPECT_THAT(take(), ElementsAre("first alarm 0"));
    EXPECT_EQ(alarms.size(), 5u);
}

TEST_F(SwitchOfTwo, AFaultOfOneSessionLeavesTheOthers) {
    throws = "first";
    sessions.tick();
    EXPECT_THAT(take(), ElementsAre("first tick 0", "second tick 0"));
    sessions.set_alarm(first, from_us(100));
    sessions.set_alarm(second, from_us(100));
    sessions.alarm(from_us(100));
    EXPECT_THAT(take(), ElementsAre("first alarm 0", "second alarm 0"));
}

}  // namespace
}  // namespace theatron::host
