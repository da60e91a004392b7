// SPDX-License-Identifier: Apache-2.0
// Somebody who comes back is not new.
#include <gtest/gtest.h>

#include <map>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

using wire::TextCode;

class ComingBack : public Host {
protected:
    ComingBack() {
        HostSession::Config c = config();
        c.admission.tokens = {{"or", Role::operator_, {}, "operator"},
                              {"watch", Role::observer, {}, "observer"},
                              {"secret", Role::expert, {}, "expert"},
                              {"short", Role::expert, from_us(5'000'000), "short"}};
        session_.emplace(std::move(c));
    }

    struct Guest {
        std::string token = "secret";
        int person = 1;
        std::uint64_t run = 1;
        bool records = false, sends_only = false;
    };
    // TextCode::none: it is in, or waits.
    TextCode come(ParticipantId id, const Guest& guest) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.token = guest.token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.records = guest.records;
        if (guest.sends_only)
            hello.features = {wire::Feature::sends_only};
        if (guest.person > 0) {
            hello.person = Bytes(wire::person_id_size, std::byte(guest.person));
            hello.person[0] = std::byte(guest.person >> 8);
        }
        hello.run = guest.run;
        session_->on_control(id, wire::encode(hello), now);
        taken = session_->take_actions();
        return refusal_of(id);
    }
    TextCode refusal_of(ParticipantId id) const {
        const auto refused = messages_to<wire::Refused>(id, taken);
        return refused.empty() ? TextCode::none : refused[0].reason.code;
    }
    std::vector<ParticipantId> dropped() const {
        std::vector<ParticipantId> all;
        for (const auto& drop : actions_of<action::Drop>(taken))
            all.push_back(drop.participant);
        return all;
    }
    bool is_in(ParticipantId id) const { return session_->participants().at(id).takes_part(); }
    void answer(ParticipantId id) { session_->on_control(id, wire::encode(wire::Ping{now}), now); }
    void leave(ParticipantId id) {
        session_->on_closed(id);
        taken = session_->take_actions();
    }
    // Persons from `first` on, one connection each.
    int fill(const std::string& token, int first, int most) {
        int came = 0;
        while (came < most &&
               come(ParticipantId(1000 + first + came), {token, first + came}) == TextCode::none)
            ++came;
        return came;
    }

    std::optional<HostSession> session_;
    std::vector<Action> taken;
};

TEST_F(ComingBack, ANewConnectionOfTheSameRunReplacesTheOldOneAtOnce) {
    EXPECT_EQ(come(alice, {}), TextCode::none);
    EXPECT_EQ(come(bob, {}), TextCode::none);
    EXPECT_EQ(dropped(), std::vector{alice});
    EXPECT_EQ(refusal_of(alice), TextCode::none) << "nobody hears it";
    EXPECT_FALSE(is_in(alice));
    EXPECT_TRUE(is_in(bob));
    // By another link, or of another person, it is another one.
    EXPECT_EQ(come(carol, {"watch"}), TextCode::none);
    EXPECT_EQ(come(dave, {"secret", 2}), TextCode::none);
    EXPECT_TRUE(dropped().empty());
    EXPECT_TRUE(is_in(bob) && is_in(carol));
}

TEST_F(ComingBack, WindowsOfOnePersonGoOnSideBySide) {
    for (const bool sends_only : {false, true}) {
        const int first = sends_only ? 10 : 1;
        for (int i = 0; i < 2; ++i, now += 2s) {
            EXPECT_EQ(come(ParticipantId(first + i),
                           {"secret", 1, std::uint64_t(i + 1), false, sends_only}),
                      TextCode::none);
            EXPECT_TRUE(dropped().empty());
        }
    }
    EXPECT_TRUE(is_in(ParticipantId{1}) && is_in(ParticipantId{2}));
    EXPECT_TRUE(is_in(ParticipantId{10}) && is_in(ParticipantId{11}));
}

TEST_F(ComingBack, AnotherRunReplacesOnlyOneThatIsSilent) {
    EXPECT_EQ(come(alice, {"secret", 1, 1}), TextCode::none);
    now += Admission::silent_after;
    EXPECT_EQ(come(bob, {"secret", 1, 2}), TextCode::none);
    EXPECT_TRUE(dropped().empty());
    answer(bob);
    now += 1ms;
    EXPECT_EQ(come(carol, {"secret", 1, 3}), TextCode::none);
    EXPECT_EQ(dropped(), std::vector{alice});
    // One for another purpose stays, and so does a recorder, which may still get what is kept.
    EXPECT_EQ(come(dave, {"secret", 1, 4, true}), TextCode::none);
    now += 1min;
    EXPECT_EQ(come(ParticipantId{5}, {"secret", 1, 5, true}), TextCode::none);
    EXPECT_TRUE(dropped().empty());
}

TEST_F(ComingBack, APersonIsInFourTimesAndTheOldestViewGoes) {
    for (int i = 1; i <= Admission::max_of_one_person; ++i)
        EXPECT_EQ(come(ParticipantId(i), {"secret", 1, std::uint64_t(i), i == 1, i == 2}),
                  TextCode::none);
    EXPECT_EQ(come(ParticipantId{5}, {"secret", 1, 5}), TextCode::none);
    EXPECT_EQ(refusal_of(ParticipantId{3}), TextCode::came_in_again);
    EXPECT_TRUE(is_in(alice) && is_in(bob)) << "one records, one sends cameras";
    leave(ParticipantId{3});
    EXPECT_EQ(come(ParticipantId{6}, {"secret", 1, 6, true}), TextCode::none);
    EXPECT_EQ(refusal_of(ParticipantId{4}), TextCode::came_in_again);
    EXPECT_EQ(come(ParticipantId{7}, {"secret", 1, 7, false, true}), TextCode::none);
    EXPECT_EQ(refusal_of(ParticipantId{5}), TextCode::came_in_again);
    for (const ParticipantId id : {ParticipantId{4}, ParticipantId{5}})
        leave(id);
    EXPECT_EQ(come(ParticipantId{8}, {"secret", 1, 8}), TextCode::person_is_in_often);
    now += 4s;
    for (const int id : {2, 6, 7})
        answer(ParticipantId(id));
    EXPECT_EQ(come(ParticipantId{9}, {"secret", 1, 9}), TextCode::none);
    EXPECT_EQ(dropped(), std::vector{alice}) << "it was silent";
}

TEST_F(ComingBack, HundredsOfConnectionsOfOnePersonAreFour) {
    for (int i = 1; i <= 200; ++i) {
        now += 1s;  // a link's budget of joins
        EXPECT_EQ(come(ParticipantId(i), {"watch", 1, std::uint64_t(i)}), TextCode::none);
    }
    int in = 0;
    for (const auto& [id, there] : session_->participants())
        in += there.takes_part();
    EXPECT_EQ(in, Admission::max_of_one_person);
}

TEST_F(ComingBack, ALinkThatHasExpiredHoldsForThoseWhoCameBefore) {
    EXPECT_EQ(come(alice, {"short"}), TextCode::none);
    now = from_us(60'000'000);
    answer(alice);
    EXPECT_EQ(come(bob, {"short", 2}), TextCode::link_expired);
    EXPECT_EQ(come(bob, {"short"}), TextCode::none) << "its break was not noticed";
    leave(alice);
    leave(bob);
    now += AdmissionMemory::kept_for;
    EXPECT_EQ(come(carol, {"short"}), TextCode::none);
    leave(carol);
    now += AdmissionMemory::kept_for + 1s;
    EXPECT_EQ(come(dave, {"short"}), TextCode::link_expired);
}

TEST_F(ComingBack, WhoWasRemovedOrHasNoLinkAnyMoreIsNotKnownAgain) {
    EXPECT_EQ(come(alice, {"or", 7}), TextCode::none);
    EXPECT_EQ(come(bob, {"short"}), TextCode::none);
    now = from_us(60'000'000);
    session_->on_control(alice, wire::encode(wire::Manage{1, wire::ManageAction::remove, bob, {}}),
                         now);
    leave(bob);
    EXPECT_EQ(come(carol, {"short"}), TextCode::link_expired);
    EXPECT_EQ(come(ParticipantId{9}, {"secret"}), TextCode::removed_by_operator);
    EXPECT_EQ(come(dave, {"secret", 2}), TextCode::none);
    session_->set_tokens({{"or", Role::operator_, {}, "operator"}});
    leave(dave);
    EXPECT_EQ(come(ParticipantId{5}, {"secret", 2}), TextCode::wrong_token);
}

TEST_F(ComingBack, ARecorderFindsItsPlaceThoughOthersTookIt) {
    const auto recorder = [](int person, std::uint64_t run = 1) {
        return Guest{"secret", person, run, true, false};
    };
    for (int i = 1; i <= Admission::max_recorders; ++i)
        EXPECT_EQ(come(ParticipantId(i), recorder(i)), TextCode::none);
    // Its connection broke four times, and nothing was noticed.
    for (int i = 0; i < 4; ++i, now += 5s)
        EXPECT_EQ(come(ParticipantId(10 + i), recorder(1)), TextCode::none);
    EXPECT_EQ(come(ParticipantId{20}, recorder(9)), TextCode::too_many_recordings);
    leave(ParticipantId{13});
    now += 9min;
    EXPECT_EQ(come(ParticipantId{21}, recorder(9)), TextCode::none);
    EXPECT_EQ(come(ParticipantId{22}, recorder(1)), TextCode::none);
    EXPECT_EQ(come(ParticipantId{23}, recorder(10)), TextCode::too_many_recordings);
    // Its program was started anew after it had been killed.
    EXPECT_EQ(come(ParticipantId{24}, recorder(9, 2)), TextCode::too_many_recordings);
    now += 4s;
    EXPECT_EQ(come(ParticipantId{25}, recorder(9, 2)), TextCode::none);
    EXPECT_EQ(dropped(), std::vector{ParticipantId{21}});
}

TEST_F(ComingBack, RecordersThatComeBackAreBounded) {
    int next = 1, in = 0;
    for (int person = 1; person <= 40; ++person)
        if (come(ParticipantId(next++), {"secret", person, 1, true}) == TextCode::none)
            leave(ParticipantId(next - 1));
    for (int person = 1; person <= 40; ++person)
        in += come(ParticipantId(next++), {"secret", person, 1, true}) == TextCode::none;
    EXPECT_EQ(in, Admission::max_recorders + Admission::kept_for_returned_recorders);
}

TEST_F(ComingBack, AShortVisitEarnsNoPlaceOfSomebodyWhoStayed) {
    int next = 1, in = 0;
    for (int person = 1; person <= Admission::max_by_one_link; ++person)
        EXPECT_EQ(come(ParticipantId(next++), {"secret", person}), TextCode::none);
    now += 1s;
    for (int id = 1; id < next; ++id) {
        answer(ParticipantId(id));
        leave(ParticipantId(id));
    }
    now += 5s;  // in which the link's newcomers are counted
    EXPECT_EQ(come(ParticipantId{900}, {"secret", 900, 1, true}), TextCode::none);
    EXPECT_EQ(come(ParticipantId{901}, {"secret", 901}), TextCode::none);
    now += 2s;
    for (int person = 1; person <= Admission::max_by_one_link; ++person)
        in += come(ParticipantId(next++), {"secret", person}) == TextCode::none;
    EXPECT_EQ(in, Admission::max_by_one_link - 2);
    EXPECT_TRUE(is_in(ParticipantId{900}));
    EXPECT_TRUE(is_in(ParticipantId{901}));
}

TEST_F(ComingBack, ARecorderThatRecordedLongFindsItsPlaceThoughManyComeBackBefore) {
    int next = 1;
    EXPECT_EQ(come(alice, {"or", 999, 1, true}), TextCode::none);
    now += 1min;
    for (int person = 1; person <= 9; ++person)
        if (come(ParticipantId(100 + next++), {"secret", person, 1, true}) == TextCode::none)
            leave(ParticipantId(100 + next - 1));
    answer(alice);
    leave(alice);
    now += 1s;
    for (int person = 1; person <= 9; ++person)
        (void)come(ParticipantId(100 + next++), {"secret", person, 1, true});
    EXPECT_EQ(come(bob, {"or", 999, 2, true}), TextCode::none);
}

TEST_F(ComingBack, WhoComesBackIntoAFullSessionTakesThePlaceOfTheNewest) {
    EXPECT_EQ(come(alice, {"watch", 999}), TextCode::none);
    EXPECT_EQ(come(bob, {"secret", 998}), TextCode::none);
    now += 5s;
    for (const ParticipantId id : {alice, bob}) {
        answer(id);
        leave(id);
    }
    EXPECT_EQ(fill("watch", 1, 100), Admission::max_by_one_link);
    EXPECT_EQ(come(carol, {"watch", 997}), TextCode::link_full);
    now += 1s;
    EXPECT_EQ(come(alice, {"watch", 999}), TextCode::none);
    EXPECT_EQ(refusal_of(ParticipantId(1000 + Admission::max_by_one_link)), TextCode::link_full);
    const int others =
        Admission::max_participants - Admission::kept_for_operators - Admission::max_by_one_link;
    EXPECT_EQ(fill("secret", 200, 100), others);
    EXPECT_EQ(come(bob, {"secret", 998}), TextCode::none);
    EXPECT_EQ(refusal_of(ParticipantId(1000 + 200 + others - 1)), TextCode::all_places_taken);
    for (int i = 0; i < Admission::kept_for_operators; ++i)
        EXPECT_EQ(come(ParticipantId(5000 + i), {"or", 500 + i}), TextCode::none);
    EXPECT_EQ(come(ParticipantId{6000}, {"or", 600}), TextCode::all_places_taken);
}

TEST_F(ComingBack, SomebodyWhoWaitedKeepsThePlaceAtTheDoor) {
    HostSession::Config c = config();
    c.admission.tokens = {{"secret", Role::expert, {}, "a"}, {"other", Role::expert, {}, "b"}};
    c.admission.asks = true;
    session_.emplace(std::move(c));
    EXPECT_EQ(come(alice, {"secret", 999}), TextCode::none);
    now += 1s;
    answer(alice);
    leave(alice);
    EXPECT_EQ(fill("secret", 1, 100), Admission::max_visitors_by_one_link);
    EXPECT_EQ(come(bob, {"secret", 998}), TextCode::too_many_visitors);
    EXPECT_EQ(come(alice, {"secret", 999}), TextCode::none);
    EXPECT_EQ(come(carol, {"secret", 999}), TextCode::none) << "the same run";
    EXPECT_EQ(dropped(), std::vector{alice});
    EXPECT_EQ(int(session_->visitors().size()), Admission::max_visitors_by_one_link);
}

}  // namespace
}  // namespace theatron::session
