// SPDX-License-Identifier: Apache-2.0
// The patient of the open case: told to those who may know it, and withdrawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "session/host_session_testing.h"
#include "session/room_bytes.h"

namespace theatron::session {
namespace {

constexpr std::string_view secret_texts[] = {"Doe", "1961", "4711", "Roe"};

CaseFacts case_of(std::uint8_t number) {
    CaseFacts facts;
    facts.id.bytes[0] = std::byte(number);
    facts.name = "liver";
    facts.opacities.assign(2, 255);
    return facts;
}

wire::Patient patient_of(std::uint8_t number, const char* name) {
    const CaseFacts facts = case_of(number);
    return {Bytes(facts.id.bytes.begin(), facts.id.bytes.end()), name, "1961-02-03", "AB-4711",
            "2026-03-01"};
}

class KnownPatient : public Host {
protected:
    explicit KnownPatient(std::vector<Role> patient_for = {Role::operator_}) {
        HostSession::Config c = config();
        c.admission.tokens = {{"or", Role::operator_, {}, "operator"},
                              {"see", Role::observer, {}, "observer"},
                              {"secret", Role::expert, {}, "a1"}};
        c.patient_for = std::move(patient_for);
        all_.emplace(std::move(c));
        all_->set_cases({case_of(1), case_of(2)},
                        {patient_of(1, "Doe, Jane"), patient_of(2, "Roe")});
    }
    void come(ParticipantId id, const char* token, bool shows_patient = true,
              bool records = false) {
        all_->on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.records = records;
        hello.features = {wire::Feature::room, wire::Feature::cases};
        if (shows_patient)
            hello.features.insert(hello.features.end(),
                                  {wire::Feature::patient, wire::Feature::asks_patient});
        tell(id, hello);
    }
    void tell(ParticipantId id, const wire::ToHost& message) {
        all_->on_control(id, wire::encode(message), now);
        collect();
    }
    void collect() {
        for (const auto& a : actions_of<action::Send>(all_->take_actions())) {
            if (const auto* patient = std::get_if<wire::Patient>(&a.message))
                told[a.participant].push_back(patient->name);
            if (const auto* answer = std::get_if<wire::AskedPatient>(&a.message))
                answers[a.participant].push_back(answer->patient);
            const Bytes bytes = wire::encode(a.message);
            const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            for (const std::string_view secret : secret_texts)
                if (text.find(secret) != text.npos)
                    learned.insert(a.participant);
        }
    }
    void ask(ParticipantId id, const Request& request) {
        tell(id, wire::RoomRequest{++number_, encode_request(request)});
    }
    static wire::Patient without_texts(std::uint8_t number) {
        return {patient_of(number, "").of_case, {}, {}, {}, {}};
    }
    void ask_whose(ParticipantId id, std::uint8_t number) {
        tell(id, wire::AskPatient{patient_of(number, "").of_case});
    }
    void open(ParticipantId by, std::uint8_t number) {
        ask(by, request::Create{
                    ObjectKind::organ, {}, 1, encode_case_object(CaseOrgan{case_of(number).id})});
    }
    void close(ParticipantId by) {
        for (const auto& [id, object] : all_->room().snapshot().objects)
            if (decode_as<CaseOrgan>(object.kind, object.properties))
                return ask(by, request::Remove{id});
    }
    void set_role(ParticipantId id, Role role) {
        ASSERT_EQ(all_->manage({1, wire::ManageAction::set_role, id, role}, now),
                  wire::ManageRefusal::none);
        collect();
    }
    using Names = std::vector<std::string>;

    std::optional<HostSession> all_;
    std::map<ParticipantId, Names> told;  // names in messages about the patient; "": withdrawn
    std::map<ParticipantId, std::vector<wire::Patient>> answers;
    std::set<ParticipantId> learned;  // any message to them had a text that identifies

private:
    std::uint32_t number_ = 0;
};

TEST_F(KnownPatient, IsToldToOperatorsWhileTheCaseIsOpen) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "see");
    EXPECT_TRUE(told.empty());
    open(bob, 1);
    EXPECT_EQ(told[alice], (Names{"Doe, Jane"}));
    open(bob, 2);
    EXPECT_EQ(told[alice], (Names{"Doe, Jane", "Roe"}));
    close(bob);
    EXPECT_EQ(told[alice], (Names{"Doe, Jane", "Roe", ""}));
    EXPECT_EQ(learned, std::set{alice});
}

TEST_F(KnownPatient, IsToldToOperatorsWhoComeLaterAndToNobodyWhoDoesNotShowItOrRecords) {
    come(bob, "secret");
    open(bob, 1);
    come(alice, "or");
    come(carol, "or", false);
    come(dave, "or", true, true);
    EXPECT_EQ(told[alice], (Names{"Doe, Jane"}));
    EXPECT_EQ(learned, std::set{alice});
}

TEST_F(KnownPatient, FollowsTheRole) {
    come(alice, "or");
    come(bob, "secret");
    open(bob, 1);
    set_role(bob, Role::operator_);
    EXPECT_EQ(told[bob], (Names{"Doe, Jane"}));
    set_role(bob, Role::expert);
    EXPECT_EQ(told[bob], (Names{"Doe, Jane", ""}));
    set_role(bob, Role::publisher);
    EXPECT_EQ(told[bob].back(), "");
}

TEST_F(KnownPatient, IsWithdrawnWithTheCasesFolderAndWithTheSession) {
    come(alice, "or");
    open(alice, 1);
    all_->set_cases({case_of(2)}, {patient_of(2, "Roe")});
    collect();
    EXPECT_EQ(told[alice], (Names{"Doe, Jane", ""}));
    // The folder is back, perhaps with other identifiers.
    all_->set_cases({case_of(1)}, {patient_of(1, "Doe, John")});
    collect();
    EXPECT_EQ(told[alice].back(), "Doe, John");
    all_->resynchronise(alice);
    collect();
    EXPECT_EQ(told[alice], (Names{"Doe, Jane", "", "Doe, John", "Doe, John"}));
    all_->end();
    all_->on_closed(alice);
    told.clear();
    come(bob, "or");
    EXPECT_TRUE(told.empty()) << "the room of the next session is empty";
}

TEST_F(KnownPatient, OfAReplayedCaseIsNotTold) {
    come(alice, "or");
    RoomObjects recorded;
    std::uint32_t number = 1;
    for (const RoomObject& object : case_objects(case_of(1), {}))
        recorded[ObjectId{number++}] = object;
    (void)all_->replay_room(recorded, now);
    all_->set_cases({case_of(1)}, {patient_of(1, "Doe, Jane")});
    collect();
    EXPECT_TRUE(told.empty());
}

using Answers = std::vector<wire::Patient>;

TEST_F(KnownPatient, OfACaseThatIsNotOpenIsToldToThoseWhoAskAndMayKnowIt) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "see");
    come(dave, "or", true, true);
    EXPECT_TRUE(learned.empty()) << "nobody has asked";
    for (const ParticipantId id : {alice, bob, carol, dave})
        ask_whose(id, 2);
    EXPECT_EQ(answers[alice], (Answers{patient_of(2, "Roe")}));
    EXPECT_EQ(answers[bob], (Answers{without_texts(2)})) << "the question is answered all the same";
    EXPECT_TRUE(answers[carol].empty()) << "an observer opens no case";
    EXPECT_EQ(answers[dave], (Answers{without_texts(2)})) << "a recorder";
    EXPECT_EQ(learned, std::set{alice});
    EXPECT_TRUE(told.empty()) << "no case is open";
    ask_whose(alice, 9);
    EXPECT_EQ(answers[alice].back(), without_texts(9)) << "the host offers no such case";
    set_role(alice, Role::expert);
    ask_whose(alice, 1);
    EXPECT_EQ(answers[alice].back(), without_texts(1));
}

TEST_F(KnownPatient, IsNoAnswerForAProgramThatDoesNotShowIt) {
    come(alice, "or", false);
    ask_whose(alice, 1);
    EXPECT_TRUE(answers.empty());
    EXPECT_TRUE(learned.empty());
}

struct PatientOfAll : KnownPatient {
    PatientOfAll() : KnownPatient({Role::operator_, Role::expert, Role::observer}) {}
};

TEST_F(PatientOfAll, ObserversNeverLearnIt) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "see");
    open(alice, 1);
    EXPECT_EQ(told[bob], (Names{"Doe, Jane"}));
    set_role(bob, Role::observer);
    EXPECT_EQ(told[bob], (Names{"Doe, Jane", ""}));
    EXPECT_EQ(learned, (std::set{alice, bob}));
}

struct PatientOfNobody : KnownPatient {
    PatientOfNobody() : KnownPatient(std::vector<Role>{}) {}
};

TEST_F(PatientOfNobody, IsToldToNobody) {
    come(alice, "or");
    open(alice, 1);
    EXPECT_TRUE(told.empty());
    EXPECT_TRUE(learned.empty());
}

}  // namespace
}  // namespace theatron::session
