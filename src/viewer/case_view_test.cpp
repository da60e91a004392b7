// SPDX-License-Identifier: Apache-2.0
// The slice that the screen of a case shows, and its changes.
#include <gtest/gtest.h>

#include <map>

#include "viewer/case_panel.h"
#include "viewer/tools/slice.h"

namespace theatron::viewer {
namespace {

// Samples tell their place: 100 * slice + 10 * row + column.
medical::Volume volume() {
    medical::Volume v;
    v.grid = {4, 3, 5, {-10, 20, 100}, {2, 0, 0}, {0, 2, 0}, {0, 0, 5}};
    for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 4; ++i)
                v.samples.push_back(std::int16_t(100 * k + 10 * j + i));
    return v;
}

session::CaseScreen screen_at(double position_mm) {
    session::CaseScreen screen;
    screen.position_mm = position_mm;
    screen.center = 256;
    screen.width = 512;
    return screen;
}

TEST(CaseView, ASliceIsGreysOfTheSamplesThere) {
    const SlicePicture slice = slice_picture(volume(), screen_at(110));
    ASSERT_EQ(slice.picture.size, (Size{4, 3}));
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i)
            EXPECT_EQ(slice.picture.view().row(j)[i].g,
                      medical::grey_of(200 + 10 * j + i, {256, 512}));
    EXPECT_EQ(slice.plane.point_at(0, 0), (Vec3{-10, 20, 110}));
}

TEST(CaseView, SlicesBeyondTheImagesAreTheOutermost) {
    const medical::Volume v = volume();
    EXPECT_EQ(scrolled(screen_at(110), v, 1).position_mm, 115);
    EXPECT_EQ(scrolled(screen_at(110), v, -9).position_mm, 100);
    EXPECT_EQ(scrolled(screen_at(110), v, 1e9).position_mm, 120);
    EXPECT_EQ(slice_picture(v, screen_at(5000)).plane.top_left_mm.z, 120);
}

TEST(CaseView, AnotherOrientationGoesThroughTheMiddle) {
    const auto coronal = turned(screen_at(100), volume(), medical::Orientation::coronal);
    EXPECT_EQ(coronal.orientation, 1);
    EXPECT_EQ(coronal.position_mm, 22);
    EXPECT_EQ(coronal.center, 256);
}

TEST(CaseView, TheSliceGoesThroughAPlaceOfThePatient) {
    session::CaseScreen screen = screen_at(100);
    EXPECT_EQ(through(screen, {1, 2, 3}).position_mm, 3);
    screen.orientation = 1;
    EXPECT_EQ(through(screen, {1, 2, 3}).position_mm, 2);
    screen.orientation = 2;
    EXPECT_EQ(through(screen, {1, 2, 3}).position_mm, 1);
}

TEST(CaseView, PicturesAreSteppedThroughAndSlicesComeBack) {
    session::CaseScreen screen = screen_at(110);
    screen = stepped(screen, 3, 5);
    EXPECT_EQ(screen.picture, 0) << "the first one comes first";
    screen = stepped(screen, 3, 1);
    EXPECT_EQ(screen.picture, 1);
    EXPECT_EQ(stepped(screen, 3, 9).picture, 2);
    EXPECT_EQ(stepped(screen, 3, -9).picture, 0);
    EXPECT_EQ(screen.position_mm, 110) << "the slice stays";
    EXPECT_FALSE(turned(screen, volume(), medical::Orientation::axial).picture);
    EXPECT_FALSE(through(screen, {1, 2, 3}).picture);
    EXPECT_FALSE(of_series(screen, 1, nullptr).picture);
}

TEST(CaseView, AnotherSeriesHasItsOwnWindowAndASliceWithinIt) {
    medical::Volume v = volume();
    v.window = {7, 90};
    const session::CaseScreen screen = of_series(screen_at(5000), 3, &v);
    EXPECT_EQ(screen.series, 3);
    EXPECT_EQ(screen.center, 7);
    EXPECT_EQ(screen.width, 90);
    EXPECT_EQ(screen.position_mm, 120);
}

TEST(CasePanel, OffersCasesThatAreNotOpen) {
    Bytes first(32), second(32);
    second[0] = std::byte(7);
    CasePanelFacts facts;
    facts.offered = {{first, "One", 2'000'000}, {second, "Two", 48'300'000}};
    session::CaseInRoom room;
    room.organ.of_case = *to_content_hash(second);
    RoomPanel panel;
    add_case_panel(facts, panel);
    ASSERT_EQ(panel.panels.size(), 1u);
    ASSERT_EQ(panel.panels[0].rows.size(), 2u);
    EXPECT_EQ(panel.panels[0].rows[1].detail, "48 MB");
    const auto& open = std::get<AskToOpen>(
        panel.commands[std::size_t(panel.panels[0].rows[1].buttons[0].command)]);
    EXPECT_EQ(open.offered, *to_content_hash(second));

    facts.room = &room;
    RoomPanel with_open;
    add_case_panel(facts, with_open);
    const auto& rows = with_open.panels[0].rows;
    EXPECT_EQ(rows.back().text, "One") << "Two is open";
}

TEST(CasePanel, AsksWhetherItIsTheRightPatientBeforeACaseIsOpened) {
    CasePanelFacts facts;
    facts.offered = {{Bytes(32), "Liver (2)", 2'000'000}};
    const auto row = [&](std::vector<RoomCommand>& commands) {
        RoomPanel panel;
        add_case_panel(facts, panel);
        commands = panel.commands;
        return panel.panels.at(0).rows.at(0);
    };
    std::vector<RoomCommand> commands;
    facts.asked = AskedCase{*to_content_hash(Bytes(32)), false, {}};
    EXPECT_EQ(row(commands).text, "Open the case Liver (2)?");
    ASSERT_EQ(commands.size(), 1u) << "it cannot be opened before it is known whose it is";
    EXPECT_TRUE(std::holds_alternative<LeaveClosed>(commands[0]));

    facts.asked->is_answered = true;
    EXPECT_EQ(row(commands).detail, "you are not told whose case it is");
    ASSERT_EQ(commands.size(), 2u);
    EXPECT_EQ(std::get<OpenOffered>(commands[0]).offered, facts.asked->offered);
    EXPECT_TRUE(std::holds_alternative<LeaveClosed>(commands[1]))
        << "the second click of two is where Open was";

    facts.asked->patient = {Bytes(32), "Miller, Ann", "1961-04-02", "AB-4711", "2026-03-01"};
    const window::PanelRow known = row(commands);
    EXPECT_EQ(known.text, "Open the case of Miller, Ann, born 1961-04-02, images of 2026-03-01?");
    EXPECT_EQ(known.detail, "Liver (2), number AB-4711");
    facts.asked->patient = {Bytes(32), "", "1961-04-02", "AB-4711", ""};
    EXPECT_EQ(row(commands).text, "Open the case of number AB-4711, born 1961-04-02?");

    facts.asked->offered.bytes[0] = std::byte(1);
    EXPECT_EQ(row(commands).text, "Liver (2)") << "another one is asked about";
    EXPECT_TRUE(std::holds_alternative<AskToOpen>(commands.at(0)));
}

TEST(CasePanel, ShowsPicturesSeriesAndThePresenter) {
    CasePanelFacts facts;
    session::CaseInRoom room;
    room.screen = session::CaseInRoom::Screen{};
    client::OpenCase content;
    content.description.emplace();
    content.description->series.resize(2);
    content.description->pictures.resize(2);
    content.volumes.resize(2);
    content.pictures.resize(2);
    facts.room = &room;
    facts.content = &content;
    const auto rows = [&] {
        RoomPanel panel;
        add_case_panel(facts, panel);
        std::map<std::string, window::PanelRow> found;
        for (const window::PanelRow& row : panel.panels[0].rows)
            found[row.text] = row;
        return found;
    };
    EXPECT_EQ(rows()["Series"].buttons.size(), 2u);
    EXPECT_EQ(rows()["Pictures"].buttons.size(), 1u);
    EXPECT_EQ(rows()["Screen"].detail, "all may change it");
    room.screen->facts.picture = 1;
    facts.presenter = "Ada";
    EXPECT_EQ(rows()["Pictures"].detail, "2 of 2");
    EXPECT_EQ(rows()["Pictures"].buttons.size(), 2u);
    EXPECT_EQ(rows()["Screen"].detail, "Ada presents");
    facts.presents = true;
    EXPECT_EQ(rows()["Screen"].detail, "you present");
}

TEST(CasePanel, NamesThePatientOfTheOpenCaseWhereItIsKnown) {
    CasePanelFacts facts;
    session::CaseInRoom room;
    facts.room = &room;
    const auto second_row = [&] {
        RoomPanel panel;
        add_case_panel(facts, panel);
        const window::PanelRow row = panel.panels[0].rows[1];
        return row.text + "; " + row.detail;
    };
    EXPECT_EQ(second_row(), "Parts; ");
    facts.patient = {Bytes(32), "Doe, Jane", "1961-02-03", "AB-4711", "2026-03-01"};
    EXPECT_EQ(second_row(),
              "Patient: Doe, Jane; born 1961-02-03, number AB-4711, images of 2026-03-01");
    facts.patient = {Bytes(32), "", "", "AB-4711", ""};
    EXPECT_EQ(second_row(), "Patient; number AB-4711");
    facts.room = nullptr;
    RoomPanel closed;
    add_case_panel(facts, closed);
    EXPECT_EQ(closed.panels[0].rows.size(), 1u) << "the host offers no case";
}

}  // namespace
}  // namespace theatron::viewer
