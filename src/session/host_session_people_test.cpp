// SPDX-License-Identifier: Apache-2.0
// Roles, admission by an operator, and decisions on people.
#include <gtest/gtest.h>

#include <algorithm>

#include "session/host_session_testing.h"
#include "session/room_bytes.h"
#include "wire/clear_objects.h"

namespace theatron::session {
namespace {

using wire::ManageAction;
using wire::ManageRefusal;
using What = AuditEvent::What;

class People : public Host {
protected:
    explicit People(bool asks = false) {
        HostSession::Config c = config();
        c.admission.tokens = {{"or", Role::operator_, {}, "operator"},
                              {"see", Role::observer, {}, "observer"},
                              {"secret", Role::expert, {}, "a1"},
                              {"other", Role::expert, {}, "b2"},
                              {"send", Role::publisher, {}, "publisher"}};
        c.admission.asks = asks;
        session_.emplace(std::move(c));
    }
    // A different person for each participant, the same when it comes again.
    void come(ParticipantId id, const char* token, int person = 0, bool records = false) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.name = "P" + std::to_string(person ? person : int(id));
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.records = records;
        hello.features = {wire::Feature::room, wire::Feature::publish};
        hello.person = Bytes(wire::person_id_size, std::byte(person ? person : int(id)));
        tell(id, hello);
    }
    void tell(ParticipantId id, const wire::ToHost& message) {
        session_->on_control(id, wire::encode(message), now);
        taken = session_->take_actions();
    }
    ManageRefusal manage(ParticipantId by, ManageAction action, ParticipantId who = {},
                         Role role = {}) {
        tell(by, wire::Manage{++number, action, who, role});
        const auto answers = messages_to<wire::Managed>(by, taken);
        EXPECT_TRUE(answers.empty() || answers[0].number == number);
        return answers.empty() ? ManageRefusal{99} : answers[0].refusal;
    }
    template <class T>
    std::vector<T> to(ParticipantId id) const {
        return messages_to<T>(id, taken);
    }
    bool is_in(ParticipantId id) const { return session_->participants().at(id).takes_part(); }
    std::string refusal_of(ParticipantId id) const {
        const auto refused = to<wire::Refused>(id);
        return refused.empty() ? "" : refused[0].in_english;
    }
    std::string note_of(ParticipantId id) const {
        std::string note;
        for (const auto& settings : to<wire::Settings>(id))
            note += wire::english(settings.note);
        return note;
    }
    std::vector<What> audited() const {
        std::vector<What> all;
        for (const auto& a : actions_of<action::Audit>(taken))
            all.push_back(a.event.what);
        return all;
    }
    std::uint8_t create_brick(ParticipantId id) {
        tell(id, wire::RoomRequest{++number,
                                   encode_request(request::Create{ObjectKind::brick, {}, 1, {}})});
        const auto decisions = to<wire::RoomDecision>(id);
        return decisions.empty() ? 255 : decisions[0].refusal;
    }
    ObjectId newest_object() const { return session_->room().snapshot().objects.rbegin()->first; }
    std::uint8_t ask(ParticipantId id, const Request& request) {
        tell(id, wire::RoomRequest{++number, encode_request(request)});
        return to<wire::RoomDecision>(id).at(0).refusal;
    }

    std::optional<HostSession> session_;
    std::vector<Action> taken;
    std::uint32_t number = 0;
};

class AskedPeople : public People {
protected:
    AskedPeople() : People(true) {}
};

constexpr auto not_allowed = std::uint8_t(Refusal::role);

TEST_F(People, OnlyOperatorsDecideOnOthers) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "see");
    come(dave, "send");
    for (const ParticipantId id : {bob, carol, dave})
        for (int action = 1; action <= 8; ++action)
            EXPECT_EQ(manage(id, ManageAction(action), id == bob ? carol : bob),
                      ManageRefusal::role);
    for (const ParticipantId id : {alice, bob, carol, dave})
        EXPECT_TRUE(is_in(id));
    EXPECT_EQ(session_->participants().at(bob).denied, 8u);
    EXPECT_EQ(session_->participants().at(alice).denied, 0u);
}

TEST_F(People, AnObserverSeesButChangesNothingAndSendsNothing) {
    come(alice, "see");
    EXPECT_EQ(to<wire::Welcome>(alice).size(), 1u);
    EXPECT_EQ(to<wire::Standing>(alice).at(0).role, Role::observer);
    EXPECT_FALSE(to<wire::Settings>(alice).empty()) << "it gets the cameras";
    EXPECT_EQ(create_brick(alice), not_allowed);
    tell(alice, wire::Publish{{{"face", true, 30, {}}}});
    EXPECT_FALSE(to<wire::Published>(alice).at(0).problem.empty());
    EXPECT_EQ(session_->participants().at(alice).denied, 2u);
    EXPECT_FALSE(session_->allow(alice, Right::point));
    EXPECT_EQ(session_->participants().at(alice).denied, 3u);
    // A snapshot is seeing.
    tell(alice, wire::RoomRequest{});
    EXPECT_EQ(to<wire::RoomSnapshot>(alice).size(), 1u);
    come(bob, "see", 0, true);
    EXPECT_NE(refusal_of(bob).find("cannot record"), std::string::npos);
}

TEST_F(People, ARecordingEndsWithTheRightToRecord) {
    come(alice, "or");
    come(bob, "secret", 0, true);
    EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::publisher), ManageRefusal::none);
    EXPECT_TRUE(is_in(bob)) << "a publisher may record";
    EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::observer), ManageRefusal::none);
    EXPECT_EQ(audited(), std::vector{What::role_changed});
    EXPECT_FALSE(is_in(bob));
    EXPECT_NE(refusal_of(bob).find("cannot record"), std::string::npos);
    session_->on_closed(bob);
    come(carol, "secret", int(bob), true);
    EXPECT_NE(refusal_of(carol).find("cannot record"), std::string::npos);
}

TEST_F(People, ANewRoleHoldsAtOnceAndWhenThePersonComesAgain) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(create_brick(bob), 0);
    const ObjectId brick = newest_object();
    EXPECT_EQ(ask(bob, request::Grab{brick}), 0);
    EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::observer), ManageRefusal::none);
    EXPECT_EQ(to<wire::Standing>(bob).at(0).role, Role::observer);
    EXPECT_EQ(audited(), std::vector{What::role_changed});
    EXPECT_EQ(session_->room().snapshot().objects.at(brick).grip.holder, ParticipantId{})
        << "an observer holds nothing";
    EXPECT_EQ(create_brick(bob), not_allowed);
    // All see it.
    bool is_observer = false;
    for (const auto& [id, object] : session_->room().snapshot().objects)
        if (object.kind == ObjectKind::person && object.creator == bob)
            is_observer = decode_person(object.properties)->role == Role::observer;
    EXPECT_TRUE(is_observer);

    session_->on_closed(bob);
    come(carol, "secret", int(bob));
    EXPECT_EQ(to<wire::Standing>(carol).at(0).role, Role::observer);
    session_->on_closed(carol);
    come(carol, "send", int(bob));
    EXPECT_EQ(to<wire::Standing>(carol).at(0).role, Role::publisher) << "another link";
}

TEST_F(People, NothingIsGivenToAnObserver) {
    come(alice, "or");
    come(bob, "see");
    EXPECT_EQ(create_brick(alice), 0);
    const ObjectId brick = newest_object();
    EXPECT_EQ(ask(alice, request::Grab{brick}), 0);
    const std::uint32_t grip = number;
    EXPECT_EQ(ask(alice, request::HandOver{brick, grip, bob}), not_allowed);
    EXPECT_EQ(session_->room().snapshot().objects.at(brick).grip.holder, alice);
}

TEST_F(People, ARoleThatMayPublishGetsAWelcomeThatSaysSoAndOneThatMayNotLosesItsCameras) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::publisher), ManageRefusal::none);
    ASSERT_EQ(to<wire::Welcome>(bob).size(), 1u);
    const auto features = to<wire::Welcome>(bob)[0].features;
    EXPECT_EQ(std::count(features.begin(), features.end(), wire::Feature::publish), 1);
    Calibration calibration;
    calibration.depth.size = calibration.color.size = {64, 48};
    calibration.depth.fx = calibration.depth.fy = calibration.color.fx = calibration.color.fy = 60;
    tell(bob, wire::Publish{{{"face", true, 30, encode_calibration(calibration)}}});
    EXPECT_EQ(to<wire::Published>(bob).at(0).cameras.size(), 1u);
    EXPECT_EQ(audited(), std::vector{What::shared});
    EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::expert), ManageRefusal::none);
    EXPECT_EQ(audited(), (std::vector{What::unshared, What::role_changed}));
    EXPECT_EQ(session_->streams().cameras().size(), 1u);
    EXPECT_EQ(to<wire::CamerasRemoved>(alice).size(), 1u);
    EXPECT_EQ(to<wire::Welcome>(bob).size(), 1u);
}

TEST_F(People, WhoIsMutedIsMutedWhenItComesAgainUntilUnmuted) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(manage(alice, ManageAction::mute, bob), ManageRefusal::none);
    EXPECT_TRUE(to<wire::Standing>(bob).at(0).muted);
    EXPECT_FALSE(to<wire::RoomChange>(alice).empty()) << "all see it";
    session_->on_closed(bob);
    come(bob, "secret");
    EXPECT_TRUE(to<wire::Standing>(bob).at(0).muted);
    EXPECT_EQ(manage(alice, ManageAction::unmute, bob), ManageRefusal::none);
    EXPECT_FALSE(to<wire::Standing>(bob).at(0).muted);
    EXPECT_EQ(audited(), std::vector{What::unmuted});
}

TEST_F(People, WhoIsRemovedIsGoneAtOnceAndStaysOut) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(manage(alice, ManageAction::remove, bob), ManageRefusal::none);
    EXPECT_NE(refusal_of(bob).find("removed you"), std::string::npos);
    EXPECT_EQ(actions_of<action::Close>(taken).size(), 1u);
    EXPECT_FALSE(is_in(bob));
    tell(bob, wire::Ping{});
    EXPECT_TRUE(taken.empty());
    session_->on_closed(bob);
    come(carol, "secret", int(bob));
    EXPECT_NE(refusal_of(carol).find("removed you"), std::string::npos);
    come(dave, "secret");
    EXPECT_TRUE(is_in(dave)) << "another person by the same link";
    EXPECT_EQ(manage(alice, ManageAction::remove, bob), ManageRefusal::no_such_participant);
    EXPECT_EQ(manage(alice, ManageAction::remove, alice), ManageRefusal::yourself);
}

TEST_F(People, DecisionsHoldForAllConnectionsOfAPerson) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "secret", int(bob));
    come(dave, "secret");
    EXPECT_EQ(manage(alice, ManageAction::mute, bob), ManageRefusal::none);
    EXPECT_TRUE(to<wire::Standing>(bob).at(0).muted);
    EXPECT_TRUE(to<wire::Standing>(carol).at(0).muted);
    EXPECT_TRUE(to<wire::Standing>(dave).empty());
    EXPECT_EQ(manage(alice, ManageAction::set_role, carol, Role::observer), ManageRefusal::none);
    EXPECT_EQ(session_->participants().at(bob).role, Role::observer);
    EXPECT_EQ(session_->participants().at(dave).role, Role::expert);
    EXPECT_EQ(manage(alice, ManageAction::remove, carol), ManageRefusal::none);
    EXPECT_EQ(audited(), (std::vector{What::removed, What::removed}));
    EXPECT_FALSE(is_in(bob));
    EXPECT_FALSE(is_in(carol));
    EXPECT_TRUE(is_in(dave));
}

TEST_F(People, ARoleByOneLinkOutlivesADecisionOnAnother) {
    come(alice, "or");
    come(bob, "or");
    EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::observer), ManageRefusal::none);
    session_->on_closed(bob);
    come(bob, "secret");
    EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::observer), ManageRefusal::none);
    session_->on_closed(bob);
    for (const char* link : {"or", "secret"}) {
        come(bob, link);
        EXPECT_EQ(session_->participants().at(bob).role, Role::observer) << link;
        session_->on_closed(bob);
    }
}

// Somebody else may have got hold of the id; and what is remembered of it would shut out the
// operator at its next join.
TEST_F(People, AnOperatorDecidesOnOneConnectionOfItsOwnIdAlone) {
    come(alice, "or");
    come(carol, "send", int(alice));
    for (const char* link : {"or", "secret"}) {
        come(bob, link, int(alice));
        EXPECT_NE(note_of(alice).find("your own id, as P1 (number 2)"), std::string::npos)
            << link << ": " << note_of(alice);
        EXPECT_EQ(note_of(bob), "");
        EXPECT_EQ(manage(alice, ManageAction::mute, bob), ManageRefusal::none);
        EXPECT_TRUE(session_->participants().at(bob).muted);
        EXPECT_EQ(manage(alice, ManageAction::set_role, bob, Role::observer), ManageRefusal::none);
        EXPECT_EQ(session_->participants().at(bob).role, Role::observer);
        EXPECT_EQ(manage(alice, ManageAction::remove, bob), ManageRefusal::none);
        EXPECT_FALSE(is_in(bob));
        session_->on_closed(bob);
        EXPECT_FALSE(session_->participants().at(alice).muted);
        EXPECT_TRUE(is_in(alice) && is_in(carol)) << link;
    }
    come(bob, "secret", int(alice));
    EXPECT_FALSE(is_in(bob)) << "kept out by the link by which the stranger came";
    session_->on_closed(bob);
    session_->on_closed(alice);
    come(alice, "or");
    EXPECT_TRUE(is_in(alice));
    EXPECT_EQ(session_->participants().at(alice).role, Role::operator_);
    EXPECT_FALSE(session_->participants().at(alice).muted);
}

TEST_F(People, ARevokedLinkEndsTheConnectionsOfAllWhoCameByItAndOfNobodyElse) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "secret");
    come(dave, "other");
    EXPECT_EQ(manage(alice, ManageAction::revoke_link, bob), ManageRefusal::none);
    for (const ParticipantId id : {bob, carol})
        EXPECT_NE(refusal_of(id).find("no longer valid"), std::string::npos);
    EXPECT_TRUE(is_in(dave));
    ASSERT_EQ(actions_of<action::RevokeLink>(taken).size(), 1u);
    EXPECT_EQ(actions_of<action::RevokeLink>(taken)[0].link, "a1");
    const auto lines = actions_of<action::Audit>(taken);
    ASSERT_EQ(audited(), std::vector(3, What::link_revoked));
    EXPECT_EQ(lines[0].event.participant, ParticipantId{})
        << "the link, also if nobody is in by it";
    EXPECT_EQ(lines[0].event.link, "a1");
    EXPECT_EQ(lines[1].event.participant, bob);
    constexpr ParticipantId eve{5};
    come(eve, "secret");
    EXPECT_NE(refusal_of(eve).find("access code of this link is wrong"), std::string::npos);
    ASSERT_EQ(audited(), std::vector{What::refused});
    EXPECT_NE(actions_of<action::Audit>(taken)[0].event.detail.find("access code"),
              std::string::npos);
}

TEST_F(People, AnOperatorDoesNotRevokeTheLinkByWhichItCame) {
    come(alice, "or");
    come(bob, "or");
    EXPECT_EQ(manage(alice, ManageAction::revoke_link, bob), ManageRefusal::yourself);
    EXPECT_TRUE(is_in(alice) && is_in(bob));
    EXPECT_TRUE(actions_of<action::RevokeLink>(taken).empty());
}

TEST_F(People, TokensThatTheHostNoLongerHasEndConnections) {
    come(alice, "secret");
    come(bob, "other");
    // The link has kept its name and got another token.
    session_->set_tokens({{"new", Role::expert, {}, "a1"}, {"other", Role::expert, {}, "b2"}});
    taken = session_->take_actions();
    EXPECT_NE(refusal_of(alice).find("no longer valid"), std::string::npos);
    EXPECT_TRUE(is_in(bob));
    const auto lines = actions_of<action::Audit>(taken);
    for (const What what : {What::link_revoked, What::link_made})
        EXPECT_TRUE(std::ranges::any_of(lines, [&](const auto& line) {
            return line.event.what == what && line.event.link == "a1" &&
                   line.event.participant == ParticipantId{};
        }));
    come(carol, "new");
    EXPECT_TRUE(is_in(carol));
}

TEST_F(People, AnOperatorEndsTheSessionForAll) {
    come(alice, "or");
    come(bob, "see");
    (void)manage(alice, ManageAction::end_session);
    EXPECT_EQ(actions_of<action::End>(taken).size(), 2u);
    EXPECT_EQ(audited(), std::vector{What::ended});
    EXPECT_FALSE(is_in(alice));
}

TEST_F(People, AnOperatorWhoComesAfterTheEndBeginsANewSessionWithAnEmptyRoom) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(create_brick(bob), 0);
    EXPECT_EQ(manage(alice, ManageAction::mute, bob), ManageRefusal::none);
    (void)manage(alice, ManageAction::end_session);
    session_->on_closed(alice);
    session_->on_closed(bob);
    come(bob, "secret");
    EXPECT_NE(refusal_of(bob).find("session has ended"), std::string::npos);
    session_->on_closed(bob);
    come(alice, "or");
    EXPECT_TRUE(is_in(alice));
    EXPECT_EQ(audited(), (std::vector{What::began, What::joined}));
    EXPECT_EQ(actions_of<action::Audit>(taken).at(0).event.by, "P1");
    EXPECT_EQ(session_->room().snapshot().objects.size(), 1u) << "Alice";
    come(bob, "secret");
    EXPECT_FALSE(to<wire::Standing>(bob).at(0).muted);
}

TEST_F(AskedPeople, WhoKnocksGetsNothingUntilAnOperatorAdmits) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(to<wire::Waiting>(bob).at(0).host_name, "OR");
    EXPECT_TRUE(to<wire::Welcome>(bob).empty());
    EXPECT_TRUE(to<wire::Settings>(bob).empty());
    EXPECT_EQ(audited(), std::vector{What::waits});
    const auto seen = to<wire::Visitors>(alice).at(0).visitors;
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_EQ(seen[0].participant, bob);
    EXPECT_EQ(seen[0].name, "P2");
    EXPECT_EQ(seen[0].role, Role::expert);
    EXPECT_EQ(seen[0].person, Bytes(4, std::byte(2))) << "not all of it, which is a proof";

    // Nothing that it sends has an effect.
    EXPECT_EQ(create_brick(bob), 255);
    EXPECT_EQ(manage(bob, ManageAction::admit, bob), ManageRefusal::role);
    tell(bob, wire::ChooseCodecs{"raw", "", {}});
    EXPECT_TRUE(to<wire::Settings>(bob).empty());
    EXPECT_FALSE(session_->allow(bob, Right::see));
    // Only this, so that it notices a frozen connection.
    tell(bob, wire::Ping{now});
    EXPECT_EQ(to<wire::Pong>(bob).size(), 1u);
    now += std::chrono::minutes(10);
    session_->on_tick(now);
    EXPECT_TRUE(actions_of<action::Close>(session_->take_actions()).empty());

    EXPECT_EQ(manage(alice, ManageAction::mute, bob), ManageRefusal::still_waiting);
    EXPECT_EQ(manage(alice, ManageAction::admit, bob), ManageRefusal::none);
    EXPECT_EQ(to<wire::Welcome>(bob).size(), 1u);
    EXPECT_FALSE(to<wire::Settings>(bob).empty());
    EXPECT_EQ(audited(), (std::vector{What::admitted, What::joined}));
    EXPECT_TRUE(to<wire::Visitors>(alice).at(0).visitors.empty());
    EXPECT_EQ(create_brick(bob), 0);
    EXPECT_EQ(manage(alice, ManageAction::admit, bob), ManageRefusal::not_waiting);

    session_->on_closed(bob);
    come(bob, "secret");
    EXPECT_TRUE(is_in(bob)) << "admitted once for the session";
}

TEST_F(AskedPeople, WhoWaitsIsNotToldThatItsOtherConnectionIsMuted) {
    come(alice, "or");
    come(bob, "send");
    come(carol, "secret", int(bob));
    EXPECT_EQ(manage(alice, ManageAction::mute, bob), ManageRefusal::none);
    EXPECT_TRUE(to<wire::Standing>(bob).at(0).muted);
    EXPECT_TRUE(to<wire::Standing>(carol).empty());
    EXPECT_EQ(manage(alice, ManageAction::admit, carol), ManageRefusal::none);
    EXPECT_TRUE(session_->participants().at(carol).muted);
}

TEST_F(AskedPeople, OperatorsAndPublishersNeedNotAsk) {
    come(alice, "or");
    come(bob, "send");
    come(carol, "see");
    EXPECT_TRUE(is_in(alice));
    EXPECT_TRUE(is_in(bob));
    EXPECT_FALSE(is_in(carol));
}

TEST_F(AskedPeople, WhoIsTurnedAwayMayAskAgainAndWhoIsRemovedMayNot) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(manage(alice, ManageAction::turn_away, bob), ManageRefusal::none);
    EXPECT_NE(refusal_of(bob).find("not let you in"), std::string::npos);
    EXPECT_TRUE(to<wire::Visitors>(alice).at(0).visitors.empty());
    session_->on_closed(bob);
    come(bob, "secret");
    EXPECT_EQ(to<wire::Waiting>(bob).size(), 1u);
    EXPECT_EQ(manage(alice, ManageAction::remove, bob), ManageRefusal::none);
    session_->on_closed(bob);
    come(bob, "secret");
    EXPECT_NE(refusal_of(bob).find("removed you"), std::string::npos);
}

TEST_F(AskedPeople, AnOperatorWhoComesLaterSeesWhoWaitsAndALeaverWaitsNoMore) {
    come(bob, "secret");
    come(carol, "see");
    come(alice, "or");
    EXPECT_EQ(to<wire::Visitors>(alice).at(0).visitors.size(), 2u);
    session_->on_closed(bob);
    taken = session_->take_actions();
    EXPECT_EQ(to<wire::Visitors>(alice).at(0).visitors.size(), 1u);
    EXPECT_EQ(audited(), std::vector{What::left});
    // Operators by promotion see it, too; those who are none any more do not.
    come(dave, "send");
    EXPECT_EQ(manage(alice, ManageAction::set_role, dave, Role::operator_), ManageRefusal::none);
    EXPECT_EQ(to<wire::Visitors>(dave).at(0).visitors.size(), 1u);
}

TEST_F(AskedPeople, WhoWaitsWhenTheSessionEndsHasLeftInTheAuditLog) {
    come(bob, "secret");
    session_->end();
    taken = session_->take_actions();
    EXPECT_EQ(audited(), std::vector{What::left});
    session_->on_closed(bob);
    taken = session_->take_actions();
    EXPECT_TRUE(audited().empty()) << "once";
}

TEST_F(AskedPeople, TooManyVisitorsAreRefusedAndHalfOfThemMayComeByOneLink) {
    constexpr std::uint32_t of_a_link = Admission::max_visitors_by_one_link;
    static_assert(2 * of_a_link == wire::max_visitors);
    std::uint32_t id = 0;
    for (const char* link : {"secret", "other"}) {
        for (std::uint32_t i = 0; i < of_a_link; ++i) {
            come(ParticipantId{++id}, link);
            EXPECT_EQ(refusal_of(ParticipantId{id}), "") << id;
        }
        come(ParticipantId{++id}, link);
        EXPECT_NE(refusal_of(ParticipantId{id}).find("Too many people"), std::string::npos);
    }
    EXPECT_EQ(session_->visitors().size(), wire::max_visitors);
    come(ParticipantId{++id}, "see");
    EXPECT_NE(refusal_of(ParticipantId{id}).find("Too many people"), std::string::npos);
}

TEST_F(AskedPeople, AllConnectionsOfAPersonThatWaitComeInTogether) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "secret", int(bob));
    come(dave, "secret");
    EXPECT_EQ(manage(alice, ManageAction::admit, carol), ManageRefusal::none);
    EXPECT_EQ(audited(), (std::vector{What::admitted, What::joined, What::admitted, What::joined}));
    EXPECT_TRUE(is_in(bob) && is_in(carol));
    EXPECT_FALSE(is_in(dave)) << "another person";
}

TEST_F(AskedPeople, ARecorderOfAnAdmittedPersonMustBeAdmittedToo) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "secret", int(bob), true);
    EXPECT_EQ(manage(alice, ManageAction::admit, bob), ManageRefusal::none);
    EXPECT_TRUE(is_in(bob));
    EXPECT_FALSE(is_in(carol));
    EXPECT_EQ(manage(alice, ManageAction::turn_away, carol), ManageRefusal::none);
    session_->on_closed(carol);
    come(carol, "secret", int(bob), true);
    EXPECT_FALSE(is_in(carol)) << "refused before, it asks again";
    EXPECT_EQ(manage(alice, ManageAction::admit, carol), ManageRefusal::none);
    session_->on_closed(carol);
    come(carol, "secret", int(bob), true);
    EXPECT_TRUE(is_in(carol)) << "after a lost connection";
}

TEST_F(AskedPeople, OperatorsAreToldThatAVisitorWouldRecord) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "secret", 0, true);
    const auto visitors = to<wire::Visitors>(alice).at(0).visitors;
    ASSERT_EQ(visitors.size(), 2u);
    EXPECT_FALSE(visitors[0].records);
    EXPECT_TRUE(visitors[1].records);
}

TEST_F(AskedPeople, ThePersonAtTheHostDecidesWithoutAnOperator) {
    come(bob, "secret");
    EXPECT_EQ(session_->manage({0, ManageAction::admit, bob, {}}, now), ManageRefusal::none);
    taken = session_->take_actions();
    EXPECT_EQ(to<wire::Welcome>(bob).size(), 1u);
    EXPECT_EQ(actions_of<action::Audit>(taken).at(0).event.by, "host");
}

TEST_F(AskedPeople, AFloodAtTheDoorEndsOnlyItsOwnConnection) {
    come(alice, "or");
    come(bob, "secret");
    std::size_t closed = 0;
    for (int i = 0; i < 2000; ++i) {
        tell(bob, wire::Manage{1, ManageAction::admit, bob, {}});
        closed += actions_of<action::Close>(taken).size();
    }
    EXPECT_EQ(closed, 1u);
    EXPECT_TRUE(session_->visitors().empty());
    EXPECT_TRUE(is_in(alice));
}

TEST_F(People, WhoseNamesLookEqualAreToldApartExceptForTheSameProgram) {
    const auto name_of = [&](ParticipantId id, const std::string& name, std::uint8_t person) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.token = "secret";
        hello.name = name;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.person = Bytes(wire::person_id_size, std::byte(person));
        tell(id, hello);
        return session_->participants().at(id).name;
    };
    EXPECT_EQ(name_of(alice, "Ada", 1), "Ada");
    EXPECT_EQ(name_of(bob, "\u0410d\u200ba", 2), "\u0410da (2)") << "Cyrillic, and one unseen";
    EXPECT_EQ(name_of(carol, "Ada", 1), "Ada") << "who comes again before the old connection ends";
    session_->on_closed(alice);
    session_->on_closed(carol);
    EXPECT_EQ(name_of(dave, "ADA", 4), "ADA") << "nobody else is called so now";
    session_->on_closed(dave);
    EXPECT_EQ(name_of(dave, "host", 4), "host (2)") << "the audit log's name of the host's machine";
    session_->on_closed(dave);
    EXPECT_EQ(name_of(dave, "you", 4), "you (2)") << "what the page calls its reader";
}

TEST(Membership, ShowsTooLittleOfAnIdToPassForThePerson) {
    Bytes id(wire::person_id_size, std::byte(7));
    EXPECT_EQ(shown_person(id), Bytes(4, std::byte(7)));
    EXPECT_EQ(shown_person({}), Bytes{});
}

TEST(Membership, ForgetsTheOldestOfTooManyAndNotesNobodyWithoutAnId) {
    Membership membership(false);
    membership.remove({}, "token");
    EXPECT_TRUE(membership.tokens_of_removed().empty());
    EXPECT_EQ(membership.judge({}, Role::expert).entry, Membership::Entry::enters);
    const auto person = [](std::size_t number) {
        Bytes id(wire::person_id_size);
        id[0] = std::byte(number & 0xff);
        id[1] = std::byte(number >> 8);
        return id;
    };
    for (std::size_t i = 0; i <= Membership::max_known_people; ++i)
        membership.remove(person(i), "token " + std::to_string(i));
    EXPECT_EQ(membership.judge(person(0), Role::expert).entry, Membership::Entry::enters);
    EXPECT_EQ(membership.judge(person(1), Role::expert).entry, Membership::Entry::was_removed);
    EXPECT_EQ(membership.tokens_of_removed().size(), Membership::max_known_people);
    EXPECT_EQ(membership.tokens_of_removed().front(), "token 1");
    membership.forget_all();
    EXPECT_TRUE(membership.tokens_of_removed().empty());
}

TEST_F(People, AnOperatorRemovesWhatSomebodyMadeWhoWasRemoved) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "other");
    for (const ParticipantId id : {bob, bob, carol})
        EXPECT_EQ(create_brick(id), 0);
    EXPECT_EQ(manage(carol, wire::clear_objects, bob), ManageRefusal::role);
    EXPECT_EQ(manage(alice, ManageAction::remove, bob), ManageRefusal::none);
    session_->on_closed(bob);
    EXPECT_EQ(manage(alice, wire::clear_objects, bob), ManageRefusal::none);
    EXPECT_EQ(audited().back(), What::cleared);
    EXPECT_EQ(session_->room().snapshot().objects.size(), 3u) << "two people and a brick";
    EXPECT_EQ(manage(alice, wire::clear_objects, bob), ManageRefusal::no_such_participant);
    EXPECT_EQ(manage(alice, wire::clear_objects, carol), ManageRefusal::none);
}

}  // namespace
}  // namespace theatron::session
