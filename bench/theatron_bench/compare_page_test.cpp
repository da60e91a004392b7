// SPDX-License-Identifier: Apache-2.0
#include "compare_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare_output.h"
#include "compare_page_parts.h"
#include "compare_words.h"
#include "given_comparison.h"
#include "svg_drawing.h"

namespace theatron::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int times_in(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

// The page with usual spaces in the place of those that do not break.
std::string page_of(const Compared& c) {
    std::string page = compare_page(c);
    const std::string kept = "\u00a0";
    for (std::size_t at = page.find(kept); at != std::string::npos; at = page.find(kept, at))
        page.replace(at, kept.size(), " ");
    return page;
}

// Behind the titles of the table's rows; Theatron's cells have a class.
std::string cell(const std::string& figure) {
    return "<td role=\"cell\" data-way=\"Video call\">" + figure + "</td>";
}
std::string our_cell(const std::string& figure) {
    return "<td role=\"cell\" class=\"ours\" data-way=\"Theatron\">" + figure + "</td>";
}

TEST(ComparePage, BeginsWithThreeSentencesAndWhatItDoesNotSay) {
    const std::string page = page_of(given_comparison());
    EXPECT_THAT(
        page,
        HasSubstr("<p class=\"lead\">Three ways to show an operation to an expert elsewhere are "
                  "listed here, and two of them were measured on this computer, in the same second "
                  "of the same operation and over the same lines. The "
                  "table says how many cameras each had. With Theatron the expert can look from "
                  "any place, which a video call does not allow; it needs 31.0 Mbit/s in place of "
                  "2.0 (2 cameras in place of 1), and 17.4 % of its picture stays dark. The "
                  "operation is generated and no surgeon has judged the pictures, so nothing here "
                  "shows that an expert helps better.</p>\n<div class=\"verdict\">"));
    for (const std::string& sentence : compare_limits())
        EXPECT_LT(page.find(escaped(sentence)), page.find("<h2>In short</h2>")) << sentence;
    EXPECT_THAT(page, HasSubstr("That takes a study with surgeons."));
}

TEST(ComparePage, EachWayHasItsTotal) {
    const std::string page = page_of(given_comparison());
    EXPECT_THAT(page, HasSubstr("Data for the whole view<small>all cameras together, at 30 "
                                "pictures a second</small></th>" +
                                cell("2.0 Mbit/s") + our_cell("31.0 Mbit/s")));
    EXPECT_THAT(page, HasSubstr("The whole view of 2 cameras needs 31.0 Mbit/s, 15 times what the "
                                "video call needs for its one camera; one camera&#39;s 15.5 Mbit/s "
                                "are 8 times as many. The expert"));
    EXPECT_THAT(page,
                HasSubstr("<small>set to 2.5 Mbit/s; these pictures needed less</small></td>" +
                          our_cell("15.5 Mbit/s")));
}

TEST(ComparePage, TellsDarkPartsAndMissingSurfacesAndHowTheyDiffer) {
    const std::string page = page_of(given_comparison());
    EXPECT_THAT(page, HasSubstr("On the mean of the expert&#39;s standing places 17.4 % of "
                                "Theatron&#39;s picture stays dark: 15.2 % because no "
                                "camera sees the place, 2.2 % although a camera does. In 4.3 % of "
                                "the rest a surface is missing, and something behind it shows."));
    EXPECT_THAT(page, HasSubstr("Of the surfaces that a camera sees, 3.3 % are missing. This is "
                                "what sensors and method lose."));
    EXPECT_THAT(page,
                HasSubstr("<li>Theatron, 31.0 Mbit/s: of the 20 cm around the wound 62.0 % "
                          "are shown rightly, 2.0 % wrongly, 36.0 % not; a pixel is 3.4 mm."));
    for (const char* figure : {"17.4 %", "15.2 %", "4.3 %", "3.3 %"})
        EXPECT_THAT(page, HasSubstr(our_cell(figure)));
}

TEST(ComparePage, EachLikenessHasItsWordsAndTheirScale) {
    const std::string page = page_of(given_comparison());
    EXPECT_THAT(page, HasSubstr(our_cell("20.9 dB<small>clear differences</small>")));
    EXPECT_THAT(page, HasSubstr(our_cell("0.772<small>clear differences</small>")));
    EXPECT_THAT(page, HasSubstr(cell("31.1 dB<small>small differences</small>")));
    EXPECT_THAT(page, HasSubstr(psnr_scale()));
    EXPECT_THAT(page, HasSubstr(ssim_scale()));
}

TEST(ComparePage, TheCloseUpComesFirstAndEachPictureStandsBesideItsMarks) {
    const std::string page = page_of(given_comparison());
    // The close-up has the truth, the video call and Theatron, each with its marks; the first of
    // two places has the same three, the second one the truth and Theatron.
    EXPECT_EQ(times_in(page, "src=\"data:image/jpeg;base64,"), 11);
    EXPECT_EQ(times_in(page, "<figure"), 11);
    EXPECT_EQ(times_in(page, "<figure class=\"ours\">"), 4);
    EXPECT_LT(page.find("<h2>Close to the wound"), page.find("The expert stands at the foot"));
    EXPECT_LT(page.find("The expert stands at the foot"),
              page.find("The expert takes a step to the left"));
    EXPECT_THAT(page, HasSubstr("The 50 cm around the wound as an expert at the foot"));
    EXPECT_THAT(page, HasSubstr("White line: the 20 cm around the wound."));
    for (const char* line :
         {"Of the 20 cm around the wound 40.0 % are shown rightly, 0.0 % wrongly, 60.0 % not; a "
          "pixel is 3.2 mm. Cut out of the camera&#39;s picture: 8 pixels wide, from the "
          "camera&#39;s place.",
          "Of the 20 cm around the wound 62.0 % are shown rightly, 2.0 % wrongly, 36.0 % not; a "
          "pixel is 3.4 mm. Likeness 22.0 dB: clear differences.",
          "Magenta: something else is shown in place of what is there, 20.0 % of the whole "
          "picture. "
          "Cyan: nothing is shown, 10.0 %.",
          "Dark 17.0 %, seen through 3.0 %; of what cameras see 2.5 % missing. "
          "Likeness 21.5 dB: clear differences.",
          "Dark 18.0 %, seen through 4.0 %; of what cameras see 4.5 % missing. "
          "Likeness 19.4 dB: strong differences."})
        EXPECT_THAT(page, HasSubstr("<small>" + std::string(line) + "</small>"));
}

TEST(ComparePage, NoPictureIsThereTwice) {
    Compared c = given_comparison();
    CompareMethod full_hd = c.methods.front();
    full_hd.id = full_hd_call_id;
    full_hd.name = "Full HD";
    c.methods.push_back(full_hd);
    const std::string page = page_of(c);
    // Its close-up is sharper; from further away it shows what the video call shows.
    EXPECT_EQ(times_in(page, "<b>Full HD</b>"), 1);
    EXPECT_EQ(times_in(page, "<b>Video call</b>"), 2);
    EXPECT_THAT(page, HasSubstr("The call in full HD shows the same as the video call, sharper."));
    EXPECT_THAT(page, HasSubstr("Video calls show the same as before"));
}

TEST(ComparePage, APairHasFiguresAndNoPicturesOfItsOwn) {
    Compared c = given_comparison();
    CompareMethod pair{.id = theatron_and_call_id, .name = "Both", .plain = "Both", .ran = "both"};
    pair.is_pair = true;
    pair.cameras = 3;
    pair.mbit_per_camera = 11;
    pair.links = c.methods.front().links;
    pair.wound = {{80, 1, 19, 30, 0.5}, {80, 10, 10, 20, 0.5}, {}};
    pair.sender_of_all_ms = 27.5;
    pair.expert_reason = "Its pictures are those of others.";
    c.methods.push_back(pair);
    const std::string page = page_of(c);
    EXPECT_EQ(times_in(page, "<figure"), 11);
    EXPECT_THAT(page, Not(HasSubstr("It has no pictures here")));
    for (const char* cell : {"33.0 Mbit/s", "80.0 %", "27.5 ms", "0.5 mm"})
        EXPECT_THAT(page, HasSubstr("data-way=\"Both\">" + std::string(cell) + "</td>"));
    EXPECT_THAT(page, HasSubstr("<td role=\"cell\" class=\"ours none\" data-way=\"Both\">"
                                "<small>two kinds of camera</small></td>"));
}

TEST(ComparePage, AllWaysThatAreListedAreCounted) {
    Compared c = given_comparison();
    c.methods[1] = c.methods[0];
    EXPECT_THAT(page_of(c), HasSubstr("Three ways to show an operation to an expert elsewhere are "
                                      "listed here and measured, in the same second"));
}

TEST(ComparePage, DrawingHasItsTimeAndItsDevice) {
    Compared c = given_comparison();
    EXPECT_THAT(page_of(c), HasSubstr("on the clock, by llvmpipe, which is the processor; a "
                                      "graphics card is many times quicker</small></th>" +
                                      cell("1.2 ms") + our_cell("250.5 ms")));
    c.methods.front().drawn_on = "the processor";
    c.methods.back().drawn_on.clear();
    EXPECT_THAT(page_of(c), HasSubstr("1.2 ms<small>by the processor</small></td>"
                                      "<td role=\"cell\" class=\"ours none\" "
                                      "data-way=\"Theatron\"><small>not measured</small></td>"));
}

TEST(ComparePage, ALargePictureIsWholeUntilItIsTouched) {
    EXPECT_THAT(compare_page_head(),
                HasSubstr("dialog img { display: block; margin: auto; width: 100%; height: 100%;"));
}

TEST(ComparePage, ACallOfTwoCamerasSaysWhosePicturesItShows) {
    Compared c = given_comparison();
    CompareMethod& two = c.methods[0];
    EXPECT_THAT(page_of(c), HasSubstr("<small>From the camera&#39;s place, not the expert&#39;s."));
    two.cameras = 2;
    const std::string page = page_of(c);
    EXPECT_THAT(page, HasSubstr("<small>The second camera&#39;s picture, from its place; the first "
                                "one&#39;s is the video call&#39;s.</small>"));
    EXPECT_THAT(page, HasSubstr("Cut out of each camera&#39;s picture that shows the wound: "
                                "together 8 pixels wide"));
    EXPECT_THAT(page, HasSubstr("from any place<small>or only from where a camera hangs</small>"
                                "</th>" +
                                cell("no") + our_cell("yes")));
}

TEST(ComparePage, AWayThatWasNotMeasuredHasNoBoxAndNoColumn) {
    Compared c = given_comparison();
    const std::string page = page_of(c);
    EXPECT_EQ(times_in(page, "scope=\"col\""), 2);
    EXPECT_THAT(page, HasSubstr("<dt>A point cloud codec</dt><dd>Points. <b>Not measured on this "
                                "computer</b>"));
    EXPECT_EQ(times_in(page, "This build has no PCL."), 1);
    std::erase_if(c.methods, [](const CompareMethod& m) { return m.id == pcl_id; });
    EXPECT_EQ(times_in(page_of(c), "<figure"), times_in(page, "<figure"));
}

TEST(ComparePage, AWayWithoutPicturesHasItsFiguresAndNoBox) {
    Compared c = given_comparison();
    CompareMethod& ours = c.methods.back();
    ours.expert.reset();
    ours.close_up.reset();
    ours.sights.reset();
    ours.wound.reset();
    ours.pictures.clear();
    ours.from_place.clear();
    ours.expert_reason = "There is no GL.";
    const std::string page = page_of(c);
    EXPECT_EQ(times_in(page, "<figure"), 7);
    EXPECT_THAT(page, Not(HasSubstr("<figure class=\"ours\">")));
    EXPECT_THAT(page, HasSubstr("It has no pictures here"));
    EXPECT_EQ(times_in(page, "There is no GL."), 1);
    EXPECT_THAT(page, HasSubstr(our_cell("31.0 Mbit/s")));
    EXPECT_THAT(page, Not(HasSubstr("stays dark")));
}

TEST(ComparePage, TheTableHasTheWoundBeforeTheStandingPlaces) {
    const std::string page = page_of(given_comparison());
    EXPECT_LT(page.find("The 20 cm around the wound: what an expert"),
              page.find("The 50 cm around the wound, from there"));
    EXPECT_LT(page.find("The 50 cm around the wound, from there"),
              page.find("Mean of the expert&#39;s 2 standing places, without the close-up"));
    for (const char* figure : {"40.0 %", "60.0 %", "3.2 mm", "50.0 %"})
        EXPECT_THAT(page, HasSubstr(cell(figure)));
    // Shares, their causes, seen through and instruments.
    for (const char* figure :
         {"62.0 %", "36.0 %", "3.4 mm", "30.0 %", "4.0 %", "70.0 %", "20.0 %", "32.0 %"})
        EXPECT_THAT(page, HasSubstr(our_cell(figure)));
    EXPECT_THAT(page, HasSubstr(our_cell("22.0 dB<small>clear differences</small>")));
}

TEST(ComparePage, CellsWithoutAFigureAreMarked) {
    const std::string page = page_of(given_comparison());
    EXPECT_THAT(page,
                HasSubstr("<td role=\"cell\" class=\"none\" data-way=\"Video call\"><small>no "
                          "such picture</small></td>"));
    EXPECT_THAT(page,
                HasSubstr("<td role=\"cell\" class=\"ours none\" data-way=\"Theatron\"><small>"
                          "sends none</small></td>"));
}

TEST(ComparePage, TheVerdictComesBeforeAllElse) {
    Compared c = given_comparison();
    c.methods.back().wound->near.wrongly_percent = 28;
    const std::string page = page_of(c);
    EXPECT_LT(page.find("do not judge the wound from it."), page.find("<div class=\"limits\">"));
}

TEST(ComparePage, AFigureStaysWithItsUnit) {
    EXPECT_EQ(kept_together("3.3 % of 20 Mbit/s in 5 ways"),
              "3.3\u00a0% of 20\u00a0Mbit/s in 5 ways");
    EXPECT_THAT(compare_page(given_comparison()), Not(HasSubstr("17.4 %")));
}

TEST(ComparePage, NeedsNoOtherFile) {
    const std::string page = page_of(given_comparison());
    EXPECT_THAT(page, Not(HasSubstr("http")));
    EXPECT_THAT(page, Not(HasSubstr("<link")));
    EXPECT_THAT(page, Not(HasSubstr("<script src")));
    EXPECT_THAT(page, HasSubstr("Some &lt;Processor&gt;"));
}

TEST(ComparePage, SaysWhatArrivesOverEachLine) {
    EXPECT_THAT(page_of(given_comparison()),
                HasSubstr("On a line of 20 Mbit/s: Theatron has 19 pictures a second, each 99 ms "
                          "old on arrival; the video call 30 pictures a second, each 35 ms old on "
                          "arrival."));
}

TEST(ComparePage, IsMadeWithoutAVideoCall) {
    Compared c = given_comparison();
    c.methods[0] = {
        .id = video_call_id, .name = "Video call", .plain = "", .ran = "", .reason = "No library."};
    const std::string page = page_of(c);
    EXPECT_THAT(page, HasSubstr("No library."));
    EXPECT_THAT(page, HasSubstr("Three ways to show an operation to an expert elsewhere are "
                                "listed here, and one of them was measured"));
    EXPECT_THAT(page, Not(HasSubstr("times what the video call")));
    EXPECT_THAT(page, Not(HasSubstr("A video call needs the least")));
}

TEST(ComparePage, IsMadeWithoutAnyMeasuredWay) {
    Compared c = given_comparison();
    for (CompareMethod& method : c.methods)
        method.reason = "No library.";
    const std::string page = page_of(c);
    EXPECT_THAT(page, HasSubstr("listed here, and none of them were measured"));
    EXPECT_THAT(page, Not(HasSubstr("<table")));
    EXPECT_EQ(times_in(page, "<figure"), 4);  // the truth
}

}  // namespace
}  // namespace theatron::bench
