// SPDX-License-Identifier: Apache-2.0
#include "host/operators_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "host/session_folder.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two sessions: "OR 3" with the links operator-3, expert-3 and so on, "OR 4" with operator-4.
class Operators : public ::testing::Test {
protected:
    PortSession session(const std::string& name, const std::string& number) {
        PortSession s;
        s.find_token = [this, number](const std::string& secret) {
            std::optional<session::Admission::Token> found;
            for (const wire::Role role : wire::roles)
                if (secret == wire::text_of(role) + ("-" + number))
                    found =
                        session::Admission::Token{secret, role, std::nullopt, wire::text_of(role)};
            if (found && is_expired)
                found->expires_utc = 1;
            return found;
        };
        s.is_held_back = [this](const std::string& secret) { return secret == held_back; };
        s.figures = [this, name] {
            HostFigures figures;
            figures.name = name;
            figures.cameras.resize(1);
            figures.cameras[0].lane.name = "box";
            figures.participants.push_back({ParticipantId{7}, "Ada"});
            figures.participants.back().link = link_of_ada;
            figures.visitors.push_back(
                {ParticipantId{8}, "Bob", Bytes(4), wire::Role::expert, false});
            figures.problems.room = "The room cannot be saved.";
            return figures;
        };
        s.picture = [name](std::size_t camera) {
            return camera == 0 ? "picture of " + name : std::string();
        };
        s.links = [number] {
            return std::vector<KnownLink>{
                {"operator", wire::Role::operator_, "operator-" + number, std::nullopt, ""},
                {"5f0c2a91", wire::Role::expert, "secret-of-ada", 4102444800, "Dr. Ada"}};
        };
        s.make_link = [this](wire::Role role, std::optional<files::UtcSeconds> expires,
                             const std::string& label, const std::string& by) {
            if (is_full)
                throw Error("There are 256 links already.");
            done.push_back("made for " + label + " by " + by + (expires ? " with an end" : ""));
            return KnownLink{"0badcafe", role, "new-secret", expires, label};
        };
        s.revoke_link = [this](const std::string& link, const std::string& by) {
            done.push_back("revoked " + link + " by " + by);
        };
        s.manage = [this, name](wire::ManageAction action, ParticipantId person,
                                const std::string& by) {
            done.push_back(name + ": " + std::to_string(int(action)) + " on " +
                           std::to_string(std::uint32_t(person)) + " by " + by);
        };
        s.audit = [this](const session::AuditEvent& event) {
            audited.push_back(std::string(text_of(event.what)) + " " + event.detail + " by " +
                              event.by);
        };
        s.recording = [this]() -> RecordingProgram& { return recording; };
        return s;
    }
    net::HttpAnswer ask(const std::string& target, const std::string& token) const {
        return answer_operator({target, "Bearer " + token}, sessions, closed);
    }
    net::HttpAnswer act(const std::string& target, const std::string& token = "operator-3") const {
        return act_for_operator(
            {"/operators/" + target, "Bearer " + token}, sessions,
            {{"or-3.example", 4400, "", "aa"}, {"127.0.0.1", 4400, "", "aa"}, folder.path()});
    }
    nlohmann::json facts(const std::string& token) const {
        return nlohmann::json::parse(ask("/operators/facts", token).body);
    }

    testing::TemporaryFolder folder;
    RecordingProgram recording{{folder.path() / "recordings", {"/bin/false"}}};
    bool is_expired = false, is_full = false;
    std::string held_back, link_of_ada = "expert";
    std::vector<std::string> done, audited;
    std::vector<ClosedSession> closed;
    SessionSwitch::Sessions sessions{{SessionNumber{1}, session("OR 3", "3")},
                                     {SessionNumber{2}, session("OR 4", "4")}};
};

TEST_F(Operators, AreTheOnlyOnesWhoSeeAndDoAnything) {
    for (const char* target : {"/operators/facts", "/operators/picture?camera=0"}) {
        EXPECT_EQ(ask(target, "operator-3").status, 200);
        EXPECT_EQ(ask(target, "expert-3").status, 403);
        EXPECT_EQ(ask(target, "observer-3").status, 403);
        EXPECT_EQ(ask(target, "").status, 401);
        EXPECT_EQ(ask(target, "operator-5").status, 401);
    }
    for (const char* target :
         {"link?role=operator", "link?show=5f0c2a91", "link?revoke=5f0c2a91",
          "person?id=7&do=remove", "recording?do=start", "session?create=OR5", "session?end=OR4"}) {
        EXPECT_EQ(act(target, "expert-3").status, 403) << target;
        EXPECT_EQ(act(target, "operator-5").status, 401) << target;
        EXPECT_EQ(ask(std::string("/operators/") + target, "operator-3").status, 404)
            << target << " by GET";
    }
    held_back = "operator-3";
    EXPECT_EQ(ask("/operators/facts", "operator-3").status, 403);
    is_expired = true;
    EXPECT_EQ(ask("/operators/facts", "operator-3").status, 410);
    EXPECT_EQ(act("link?role=expert").status, 410);
    EXPECT_THAT(done, IsEmpty());
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "recordings"));
}

TEST_F(Operators, OfTheFirstSessionSeeAllAndOthersTheirOwn) {
    closed.push_back({"OR 9", "its camera is missing", {}});
    const auto all = facts("operator-3");
    ASSERT_EQ(all["sessions"].size(), 2u);
    EXPECT_EQ(all["sessions"][1]["name"], "OR 4");
    EXPECT_EQ(all["sessions"][1]["may_end"], true);
    EXPECT_EQ(all["sessions"][0]["may_end"], false);
    EXPECT_EQ(all["closed"][0]["name"], "OR 9");
    EXPECT_EQ(all["may_create"], true);
    const auto one = facts("operator-4");
    ASSERT_EQ(one["sessions"].size(), 1u);
    EXPECT_EQ(one["sessions"][0]["name"], "OR 4");
    EXPECT_THAT(one["closed"], IsEmpty());
    EXPECT_EQ(one["may_create"], false);

    EXPECT_EQ(ask("/operators/picture?session=2&camera=0", "operator-3").body, "picture of OR 4");
    EXPECT_EQ(ask("/operators/picture?session=1&camera=0", "operator-4").status, 404);
    EXPECT_EQ(ask("/operators/picture?session=1&camera=9", "operator-3").status, 204);
    EXPECT_EQ(ask("/operators/picture?camera=x", "operator-3").status, 404);
    EXPECT_EQ(act("person?id=7&do=mute&session=2").status, 204);
    EXPECT_EQ(act("person?id=7&do=mute&session=1", "operator-4").status, 404);
    EXPECT_EQ(act("session?create=OR5", "operator-4").status, 403);
    EXPECT_THAT(done, ElementsAre("OR 4: 3 on 7 by page of operator"));
}

TEST_F(Operators, SeeCamerasPeopleAndLinksWithoutTheirTokens) {
    const net::HttpAnswer answer = ask("/operators/facts", "operator-3");
    const auto session = nlohmann::json::parse(answer.body)["sessions"][0];
    EXPECT_EQ(session["cameras"][0]["name"], "box");
    EXPECT_EQ(session["people"][0]["name"], "Ada");
    EXPECT_EQ(session["visitors"][0]["name"], "Bob");
    EXPECT_EQ(session["links"][1]["for"], "Dr. Ada");
    EXPECT_EQ(session["links"][1]["until"], "2100-01-01T00:00:00Z");
    EXPECT_EQ(session["links"][0]["is_own"], true);
    EXPECT_EQ(session["links"][1]["is_own"], false);
    EXPECT_EQ(session["problems"][0], "The room cannot be saved.");
    for (const char* secret : {"secret-of-ada", "operator-3", "operator-4"})
        EXPECT_EQ(answer.body.find(secret), std::string::npos) << secret;
    EXPECT_THAT(answer.headers, IsEmpty()) << "no permission to keep it";
}

TEST_F(Operators, MakeShowAndRevokeLinks) {
    const auto made =
        nlohmann::json::parse(act("link?role=observer&hours=2&for=Dr.%20Ad%C3%A4").body);
    EXPECT_THAT(made["link"].get<std::string>(),
                HasSubstr("https://or-3.example:4400/#join=new-secret"));
    EXPECT_EQ(made["role"], "observer");
    EXPECT_EQ(made["for"], "Dr. Ad\u00e4");
    EXPECT_EQ(made["qr"].size(), made["qr"][0].get<std::string>().size());
    EXPECT_THAT(act("link?show=5f0c2a91").body, HasSubstr("secret-of-ada"));
    EXPECT_EQ(act("link?revoke=5f0c2a91").status, 204);
    EXPECT_THAT(done, ElementsAre("made for Dr. Ad\u00e4 by page of operator with an end",
                                  "revoked 5f0c2a91 by page of operator"));
    done.clear();
    EXPECT_EQ(act("link?revoke=operator").status, 409) << "by which this page is open";
    for (const char* wrong : {"link?show=none", "link?revoke=none"})
        EXPECT_EQ(act(wrong).status, 404) << wrong;
    for (const char* wrong : {"link", "link?role=king"})
        EXPECT_EQ(act(wrong).status, 400) << wrong;
    EXPECT_EQ(nlohmann::json::parse(act("link?show=operator&session=2").body)["is_own"], false)
        << "of another session";
    for (const char* hours : {"0", "-1", "nan", "inf", "1e9", "2h", "%00"})
        EXPECT_EQ(act(std::string("link?role=expert&hours=") + hours).status, 409) << hours;
    is_full = true;
    EXPECT_THAT(act("link?role=expert").body, HasSubstr("256 links"));
    EXPECT_THAT(done, IsEmpty());
}

TEST_F(Operators, DecideOnPeople) {
    for (const char* what : {"admit", "turn_away", "mute", "unmute", "remove", "lower"})
        EXPECT_EQ(act(std::string("person?id=8&do=") + what).status, 204);
    EXPECT_THAT(
        done, ElementsAre("OR 3: 1 on 8 by page of operator", "OR 3: 2 on 8 by page of operator",
                          "OR 3: 3 on 8 by page of operator", "OR 3: 4 on 8 by page of operator",
                          "OR 3: 6 on 8 by page of operator", "OR 3: 10 on 8 by page of operator"));
    for (const char* wrong : {"person?id=8", "person?do=mute", "person?id=0&do=mute",
                              "person?id=x&do=mute", "person?id=8&do=end_session"})
        EXPECT_EQ(act(wrong).status, 400) << wrong;
    EXPECT_EQ(act("person?id=9&do=mute").status, 404) << "has left";
    link_of_ada = "operator";
    EXPECT_EQ(act("person?id=7&do=remove").status, 409) << "the page would be closed, too";
    EXPECT_EQ(done.size(), 6u);
    EXPECT_EQ(act("person?id=7&do=mute").status, 204);
    link_of_ada = "expert";
    EXPECT_EQ(act("person?id=7&do=remove").status, 204);
}

TEST_F(Operators, MakeSessionsThatAHostKeeps) {
    EXPECT_EQ(act("session?create=OR%205").status, 204);
    ASSERT_EQ(kept_sessions(folder.path()).size(), 1u);
    EXPECT_EQ(kept_sessions(folder.path())[0].name, "OR 5");
    EXPECT_THAT(act("session?create=OR%205").body, HasSubstr("There is a session 'OR 5' already"));
    EXPECT_EQ(act("session?create=%0A").status, 409);
    EXPECT_EQ(act("session?end=none").status, 409);
    EXPECT_EQ(act("session").status, 400);
    EXPECT_EQ(act("session?end=OR%205").status, 204);
    EXPECT_TRUE(kept_sessions(folder.path())[0].ends);
    EXPECT_THAT(audited, ElementsAre("created OR 5 by page of operator",
                                     "end_asked OR 5 by page of operator"));
}

TEST_F(Operators, HearWhyNothingIsRecorded) {
    const auto state = [&] { return facts("operator-3")["sessions"][0]["recording"]; };
    EXPECT_EQ(act("recording?do=stop").status, 409);
    EXPECT_EQ(act("recording?do=dance").status, 400);
    EXPECT_EQ(act("recording?do=start").status, 204);
    EXPECT_THAT(done, ElementsAre("made for the recording of the operators' page by page of "
                                  "operator with an end"));
    ASSERT_EQ(audited.size(), 1u);
    EXPECT_THAT(audited[0],
                ::testing::MatchesRegex("recording_begun OR-3-.*mkv by page of operator"));
    while (state()["phase"] == "running")
        std::this_thread::yield();
    EXPECT_EQ(state()["phase"], "failed");
    EXPECT_EQ(state()["problem"], "Its program ended and said nothing.");
    EXPECT_EQ(recording.take_end({})->link, "0badcafe");

    std::ofstream(folder.path() / "file");
    RecordingProgram blocked{{folder.path() / "file", {"/bin/true"}}};
    sessions[0].second.recording = [&]() -> RecordingProgram& { return blocked; };
    EXPECT_EQ(act("recording?do=start").status, 409);
    EXPECT_EQ(done.size(), 1u) << "no link is made for nothing";
    RecordingProgram none{{folder.path() / "recordings", {"/nonexistent"}}};
    sessions[0].second.recording = [&]() -> RecordingProgram& { return none; };
    EXPECT_EQ(act("recording?do=start").status, 409);
    EXPECT_EQ(done.back(), "revoked 0badcafe by page of operator");
}

}  // namespace
}  // namespace theatron::host
