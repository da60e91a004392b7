// SPDX-License-Identifier: Apache-2.0
// Cases and their content: all of them to those who may open one, to the others what the room
// shows.
#include <gtest/gtest.h>

#include "session/host_session_testing.h"
#include "session/room_bytes.h"

namespace theatron::session {
namespace {

ContentHash content_of_case(std::uint8_t number, std::uint8_t piece) {
    ContentHash hash;
    hash.bytes[0] = std::byte(number);
    hash.bytes[1] = std::byte(piece);
    return hash;
}

CaseFacts offered_case(std::uint8_t number) {
    CaseFacts facts;
    facts.id = content_of_case(number, 0);
    facts.name = "case " + std::to_string(int(number));
    facts.opacities.assign(2, 255);
    return facts;
}

Bytes offered_bytes(const ContentHash& hash) {
    return {hash.bytes.begin(), hash.bytes.end()};
}

class OfferedCasesTest : public Host {
protected:
    OfferedCasesTest() {
        HostSession::Config c = config();
        c.admission.tokens = {{"or", Role::operator_, {}, "operator"},
                              {"see", Role::observer, {}, "observer"},
                              {"secret", Role::expert, {}, "a1"}};
        session_.emplace(std::move(c));
        session_->set_cases(
            {offered_case(1), offered_case(2)}, {},
            {{content_of_case(1, 0), {content_of_case(1, 0), content_of_case(1, 1)}},
             {content_of_case(2, 0), {content_of_case(2, 0), content_of_case(2, 1)}}});
        come(alice, "or");
        come(bob, "secret");
        come(carol, "see");
    }
    void come(ParticipantId id, const char* token) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::room, wire::Feature::cases};
        tell(id, hello);
    }
    void tell(ParticipantId id, const wire::ToHost& message) {
        session_->on_control(id, wire::encode(message), now);
        collect();
    }
    void collect() {
        taken_ = session_->take_actions();
        for (const ParticipantId id : {alice, bob, carol})
            for (const auto& offer : messages_to<wire::OfferedCases>(id, taken_)) {
                std::string names;
                for (const wire::OfferedCase& offered : offer.cases)
                    names += offered.name + ";";
                told[id].push_back(names);
            }
    }
    void open(ParticipantId by, std::uint8_t number) {
        tell(by, wire::RoomRequest{++number_,
                                   encode_request(request::Create{
                                       ObjectKind::organ,
                                       {},
                                       1,
                                       encode_case_object(CaseOrgan{offered_case(number).id})})});
    }
    void close(ParticipantId by) {
        for (const auto& [id, object] : session_->room().snapshot().objects)
            if (decode_as<CaseOrgan>(object.kind, object.properties))
                return tell(by, wire::RoomRequest{++number_, encode_request(request::Remove{id})});
    }
    // True if the host is to send it; else the participant is told that there is no such content.
    bool gets(ParticipantId id, const ContentHash& content) {
        tell(id, wire::RequestContent{offered_bytes(content), 0, 100});
        const auto sent = actions_of<action::SendContent>(taken_);
        const auto refused = messages_to<wire::Content>(id, taken_);
        EXPECT_EQ(sent.size() + refused.size(), 1u);
        EXPECT_TRUE(sent.empty() || (sent[0].participant == id && sent[0].content == content));
        EXPECT_TRUE(refused.empty() || (refused[0].hash == offered_bytes(content) &&
                                        refused[0].total == 0 && refused[0].bytes.empty()));
        return !sent.empty();
    }
    using Lists = std::vector<std::string>;

    std::optional<HostSession> session_;
    std::map<ParticipantId, Lists> told;

private:
    std::vector<Action> taken_;
    std::uint32_t number_ = 0;
};

TEST_F(OfferedCasesTest, AreToldToThoseWhoMayOpenThemAndTheOpenOneToAll) {
    EXPECT_EQ(told[alice], (Lists{"case 1;case 2;"}));
    EXPECT_EQ(told[bob], (Lists{"case 1;case 2;"}));
    EXPECT_TRUE(told[carol].empty());
    open(bob, 2);
    EXPECT_EQ(told[carol], (Lists{"case 2;"}));
    open(bob, 1);
    EXPECT_EQ(told[carol], (Lists{"case 2;", "case 1;"}));
    close(bob);
    EXPECT_EQ(told[carol], (Lists{"case 2;", "case 1;", ""}));
    EXPECT_EQ(told[bob], (Lists{"case 1;case 2;"})) << "nothing has changed for him";
}

TEST_F(OfferedCasesTest, TheirContentGoesOnlyWhereTheCaseIsSeen) {
    for (const std::uint8_t number : {1, 2})
        for (const std::uint8_t piece : {0, 1}) {
            EXPECT_TRUE(gets(bob, content_of_case(number, piece)));
            EXPECT_FALSE(gets(carol, content_of_case(number, piece)));
        }
    open(bob, 2);
    EXPECT_TRUE(gets(carol, content_of_case(2, 0)));
    EXPECT_TRUE(gets(carol, content_of_case(2, 1)));
    EXPECT_FALSE(gets(carol, content_of_case(1, 0)));
    EXPECT_FALSE(gets(carol, content_of_case(1, 1)));
    close(bob);
    EXPECT_FALSE(gets(carol, content_of_case(2, 1)));
}

TEST_F(OfferedCasesTest, FollowTheRoleOfAPerson) {
    const auto set_role = [&](ParticipantId id, Role role) {
        ASSERT_EQ(session_->manage({1, wire::ManageAction::set_role, id, role}, now),
                  wire::ManageRefusal::none);
        collect();
    };
    set_role(carol, Role::expert);
    EXPECT_EQ(told[carol], (Lists{"case 1;case 2;"}));
    EXPECT_TRUE(gets(carol, content_of_case(1, 1)));
    set_role(carol, Role::observer);
    EXPECT_EQ(told[carol], (Lists{"case 1;case 2;", ""})) << "withdrawn";
    EXPECT_FALSE(gets(carol, content_of_case(1, 1)));
}

TEST_F(OfferedCasesTest, OfARecordingThatIsReplayedAreSeenByAll) {
    RoomObjects recorded;
    std::uint32_t next = 1;
    for (RoomObject& object : case_objects(offered_case(1), {}))
        recorded[ObjectId(next++)] = std::move(object);
    session_->replay_room(recorded, now);
    collect();
    EXPECT_EQ(told[carol], (Lists{"case 1;"}));
    EXPECT_TRUE(gets(carol, content_of_case(1, 1)));
    EXPECT_FALSE(gets(carol, content_of_case(2, 1)));
    session_->replay_room({}, now);
    collect();
    EXPECT_EQ(told[carol].back(), "");
}

}  // namespace
}  // namespace theatron::session
