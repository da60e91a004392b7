// SPDX-License-Identifier: Apache-2.0
#include "host/lobby.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "files/png_file.h"
#include "host/port_pages.h"
#include "host/thumbnail.h"

namespace theatron::host {
namespace {

HostFigures figures() {
    HostFigures figures;
    figures.name = "OR 3";
    HostFigures::Camera camera;
    camera.lane.name = "lamp";
    figures.cameras.push_back(camera);
    HostFigures::Participant ada;
    ada.name = "Ada";
    ada.role = wire::Role::observer;
    figures.participants.push_back(ada);
    return figures;
}

TEST(Lobby, NamesPeopleAndCameras) {
    const auto lobby = lobby_json(figures(), {wire::Role::expert});
    EXPECT_EQ(lobby["role"], "expert");
    const auto& session = lobby["sessions"].at(0);
    EXPECT_EQ(session["name"], "OR 3");
    EXPECT_EQ(session["people"].at(0)["name"], "Ada");
    EXPECT_EQ(session["people"].at(0)["role"], "observer");
    EXPECT_EQ(session["cameras"].at(0)["name"], "lamp");
    EXPECT_EQ(session["thumbnail"], "/thumbnail");
}

TEST(Lobby, NamesWhoseTheCameraOfAParticipantIs) {
    HostFigures of_two = figures();
    of_two.participants[0].id = ParticipantId{7};
    HostFigures::Published webcam;
    webcam.name = "webcam";
    webcam.publisher = ParticipantId{7};
    of_two.published.push_back(webcam);
    const auto lobby = lobby_json(of_two, {wire::Role::expert});
    EXPECT_EQ(lobby["sessions"].at(0)["cameras"].at(0)["name"], "lamp");
    EXPECT_EQ(lobby["sessions"].at(0)["cameras"].at(1)["name"], "Ada: webcam");
    const std::string table = to_table(to_json(of_two));
    EXPECT_NE(table.find(" Ada: webcam of participant 7: "), std::string::npos) << table;
}

TEST(Lobby, TellsSomeoneWhoMustAskOnlyTheNumberOfPeople) {
    const auto lobby = lobby_json(figures(), {wire::Role::observer, true});
    EXPECT_EQ(lobby["sessions"].at(0)["people_count"], 1);
    EXPECT_TRUE(lobby["sessions"].at(0)["asks"]);
    EXPECT_EQ(lobby.dump().find("Ada"), std::string::npos);
    EXPECT_EQ(lobby.dump().find("lamp"), std::string::npos);
    EXPECT_EQ(lobby.dump().find("thumbnail"), std::string::npos);
}

// Two sessions: "OR 3" with the links "operator-3" and "expert-3", "OR 4" with "operator-4".
class LobbyOfTwo : public ::testing::Test {
protected:
    PortSession session(const std::string& name, const std::string& number) {
        PortSession s;
        s.find_token = [number](const std::string& secret) {
            std::optional<session::Admission::Token> found;
            for (const wire::Role role : wire::roles)
                if (secret == wire::text_of(role) + ("-" + number))
                    found = session::Admission::Token{secret, role, std::nullopt, ""};
            return found;
        };
        s.must_ask = [](wire::Role role) { return role == wire::Role::expert; };
        s.is_held_back = [this](const std::string& secret) { return secret == held_back; };
        s.http_tokens = [number] { return std::vector<std::string>{"operator-" + number}; };
        s.metrics_token = "metrics-" + number;
        s.figures = [name] {
            HostFigures figures;
            figures.name = name;
            return figures;
        };
        s.picture = [name](std::size_t) { return "picture of " + name; };
        return s;
    }
    net::HttpAnswer ask(const std::string& target, const std::string& token) const {
        return answer_page({target, "Bearer " + token}, Page(), sessions, closed);
    }
    std::vector<std::string> names(const std::string& token) const {
        std::vector<std::string> names;
        const auto lobby = nlohmann::json::parse(ask("/lobby", token).body);
        for (const auto& shown : lobby["sessions"])
            names.push_back(shown["name"]);
        return names;
    }
    std::string held_back;  // the token of a link by which somebody came who was removed
    std::vector<ClosedSession> closed;
    SessionSwitch::Sessions sessions{{SessionNumber{1}, session("OR 3", "3")},
                                     {SessionNumber{2}, session("OR 4", "4")}};
};

TEST_F(LobbyOfTwo, ShowsALinkItsSessionAndTheHostsOperatorAll) {
    EXPECT_EQ(names("operator-3"), (std::vector<std::string>{"OR 3", "OR 4"}));
    EXPECT_EQ(names("observer-3"), (std::vector<std::string>{"OR 3"}));
    EXPECT_EQ(names("operator-4"), (std::vector<std::string>{"OR 4"}));
    EXPECT_EQ(ask("/lobby", "operator-5").status, 401);
}

TEST_F(LobbyOfTwo, GivesThePictureOfASessionThatTheLinkShows) {
    EXPECT_EQ(ask("/thumbnail", "operator-3").body, "picture of OR 3");
    EXPECT_EQ(ask("/thumbnail?session=2", "operator-3").body, "picture of OR 4");
    EXPECT_EQ(ask("/thumbnail?session=2", "operator-4").body, "picture of OR 4");
    EXPECT_EQ(ask("/thumbnail?session=1", "operator-4").status, 404);
    EXPECT_EQ(ask("/thumbnail?session=2", "observer-3").status, 404);
    EXPECT_EQ(ask("/thumbnail?session=3", "operator-3").status, 404);
    EXPECT_EQ(ask("/thumbnail", "expert-4").status, 404) << "who must ask sees nothing before";
    sessions.at(0).second.picture = [](std::size_t) { return std::string(); };
    EXPECT_EQ(ask("/thumbnail", "operator-3").status, 204) << "none yet";
}

TEST_F(LobbyOfTwo, TheFiguresOfAllAreForTheHostsOperator) {
    const auto all = nlohmann::json::parse(ask("/status", "operator-3").body);
    EXPECT_EQ(all["name"], "OR 3");
    ASSERT_EQ(all["sessions"].size(), 1u);
    EXPECT_EQ(all["sessions"][0]["name"], "OR 4");
    const auto one = nlohmann::json::parse(ask("/status", "operator-4").body);
    EXPECT_EQ(one["name"], "OR 4");
    EXPECT_FALSE(one.contains("sessions"));
    EXPECT_EQ(ask("/status", "observer-3").status, 401);
}

TEST_F(LobbyOfTwo, VisitorsAreNamedToThoseWhoDecideOnThem) {
    PortSession& first = sessions.at(0).second;
    first.http_tokens = [] {
        return std::vector<std::string>{"operator-3", "publisher-3", "metrics-3"};
    };
    first.figures = [] {
        HostFigures figures;
        figures.visitors.push_back({ParticipantId{7}, "Ada", Bytes(4), wire::Role::expert, true});
        return figures;
    };
    for (const char* token : {"operator-3", "metrics-3"}) {
        const auto status = nlohmann::json::parse(ask("/status", token).body);
        EXPECT_EQ(status["visitors"].at(0)["name"], "Ada");
        EXPECT_NE(to_table(status).find("let in: Ada (expert, records, person 00000000)"),
                  std::string::npos)
            << to_table(status);
    }
    const auto status = nlohmann::json::parse(ask("/status", "publisher-3").body);
    EXPECT_EQ(status["visitors"].size(), 1u);
    EXPECT_EQ(status["visitors"].dump().find("Ada"), std::string::npos);
    EXPECT_NE(to_table(status).find("waits to be let in: somebody (expert)"), std::string::npos);
    EXPECT_NE(ask("/metrics", "publisher-3").body.find("visitors{} 1"), std::string::npos);
}

TEST_F(LobbyOfTwo, MetricsNameFurtherSessionsInALabel) {
    const std::string metrics = ask("/metrics", "operator-3").body;
    EXPECT_NE(metrics.find("\ntheatron_participants{} 0\n"), std::string::npos);
    EXPECT_NE(metrics.find("\ntheatron_participants{session=\"OR 4\"} 0\n"), std::string::npos);
    const std::string of_one = ask("/metrics", "operator-4").body;
    EXPECT_EQ(of_one.find("session="), std::string::npos);
}

TEST_F(LobbyOfTwo, ASessionThatCannotBeOpenedIsShownToTheHostsOperator) {
    closed = {{"OR 5", "There is no camera 2.", {"observer-5"}}};
    const auto lobby = nlohmann::json::parse(ask("/lobby", "operator-3").body);
    ASSERT_EQ(lobby["sessions"].size(), 3u);
    EXPECT_EQ(
        lobby["sessions"][2],
        (nlohmann::json{{"name", "OR 5"}, {"closed", true}, {"problem", "There is no camera 2."}}));
    const auto status = nlohmann::json::parse(ask("/status", "operator-3").body);
    EXPECT_EQ(status["closed_sessions"].at(0)["problem"], "There is no camera 2.");
    EXPECT_NE(to_table(status).find("OR 5: not open. There is no camera 2."), std::string::npos);
    const std::string metrics = ask("/metrics", "operator-3").body;
    EXPECT_NE(metrics.find("\ntheatron_session_open{} 1\n"), std::string::npos);
    EXPECT_NE(metrics.find("\ntheatron_session_open{session=\"OR 5\"} 0\n"), std::string::npos);
    for (const char* other : {"observer-3", "operator-4"})
        for (const char* page : {"/lobby", "/status", "/metrics"})
            EXPECT_EQ(ask(page, other).body.find("OR 5"), std::string::npos) << other << page;
}

TEST_F(LobbyOfTwo, ALinkByWhichSomebodyCameWhoWasRemovedShowsNobody) {
    const auto names_of = [&](const std::string& token) {
        return nlohmann::json::parse(ask("/lobby", token).body)["sessions"];
    };
    EXPECT_TRUE(names_of("operator-3").at(0).contains("people"));
    held_back = "operator-3";
    const auto sessions_shown = names_of("operator-3");
    ASSERT_EQ(sessions_shown.size(), 1u);
    EXPECT_TRUE(sessions_shown[0]["held_back"]);
    EXPECT_FALSE(sessions_shown[0].contains("people"));
    EXPECT_FALSE(sessions_shown[0].contains("cameras"));
    EXPECT_EQ(ask("/thumbnail", "operator-3").status, 404);
    EXPECT_EQ(ask("/thumbnail?session=2", "operator-3").status, 404);
    EXPECT_EQ(ask("/status", "operator-3").status, 403);
    EXPECT_EQ(ask("/metrics", "operator-3").status, 403);
    EXPECT_TRUE(names_of("observer-3").at(0).contains("people")) << "another link";
    EXPECT_EQ(ask("/thumbnail", "observer-3").status, 200);
}

FramePtr frame_of(Size size, Rgb color) {
    auto frame = std::make_shared<Frame>();
    frame->color.size = size;
    if (size != Size{}) {
        frame->color.pixels = ColorImage(size);
        for (Rgb& pixel : frame->color.pixels.pixels)
            pixel = color;
    }
    return frame;
}

TEST(Thumbnail, IsASmallPictureOfAFrameAndANewOneAfterTwoSeconds) {
    Thumbnail thumbnail;
    EXPECT_TRUE(thumbnail.png().empty());
    const TimePoint begin = from_us(1'000'000);
    thumbnail.on_frame(frame_of({}, {}), begin);
    EXPECT_TRUE(thumbnail.png().empty()) << "a camera without colour";
    const auto pixel_at = [&](TimePoint now, Rgb color) {
        thumbnail.on_frame(frame_of({1280, 721}, color), now);
        const std::string png = thumbnail.png();
        ColorImage picture;
        EXPECT_EQ(files::decode_png(as_bytes(png), picture), "");
        EXPECT_EQ(picture.size, (Size{213, 120}));
        return picture.pixels.at(0);
    };
    EXPECT_EQ(pixel_at(begin, {1, 2, 3}), (Rgb{1, 2, 3}));
    EXPECT_EQ(pixel_at(begin + Thumbnail::interval / 2, {9, 9, 9}), (Rgb{1, 2, 3}));
    EXPECT_EQ(pixel_at(begin + Thumbnail::interval, {9, 9, 9}), (Rgb{9, 9, 9}));
}

TEST(Thumbnail, KeepsAPictureThatIsSmallAlready) {
    const ColorImage picture(Size{7, 5});
    EXPECT_EQ(small_picture(picture.view(), Thumbnail::width), picture);
    EXPECT_TRUE(small_picture({}, Thumbnail::width).empty());
}

}  // namespace
}  // namespace theatron::host
