// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_guide.h"

#include <gtest/gtest.h>

#include "enrol/photo_texts.h"
#include "face/painted_face.h"

namespace theatron::enrol {
namespace {

using Step = PhotoGuide::Step;

const face::MorphModel& model() {
    static const face::MorphModel made = face::generated_head();
    return made;
}

PhotoGuide::Usual usual() {
    PhotoGuide::Usual usual;
    for (std::size_t i = 0; i < face::emotion_count; ++i)
        usual[i] = face::usual_landmarks(model(), face::Emotion(i));
    return usual;
}

ColorImage picture(std::uint8_t red) {
    ColorImage made({640, 480});
    std::fill(made.pixels.begin(), made.pixels.end(), Rgb{red, 0, 0});
    return made;
}

face::Landmarks some_landmarks(double shift = 0) {
    face::Landmarks landmarks = usual()[std::size_t(face::Emotion::neutral)];
    for (Vec2& point : landmarks)
        point = {point.x + 200 + shift, point.y + 200};
    return landmarks;
}

bool has_button(const PhotoGuide& guide, GuideCommand command) {
    for (const auto& panel : guide_content(guide, true, {}).panels)
        for (const auto& row : panel.rows)
            for (const auto& button : row.buttons)
                if (button.command == int(command))
                    return true;
    return false;
}

class PhotoGuideTest : public ::testing::Test {
protected:
    // From the camera's picture to landmarks that were found.
    void take_one(std::uint8_t red = 100) {
        guide.take_photo(now);
        now += PhotoGuide::count_down;
        ASSERT_TRUE(guide.on_picture(picture(red).view(), now));
        ASSERT_EQ(guide.step(), Step::find);
        guide.on_found(some_landmarks(red), PhotoGuide::Search::found);
        ASSERT_EQ(guide.step(), Step::mark);
    }

    PhotoGuide guide = PhotoGuide::from_camera(usual());
    TimePoint now{};
};

TEST_F(PhotoGuideTest, SixPhotosFromACamera) {
    for (std::size_t i = 0; i < face::emotion_count; ++i) {
        EXPECT_EQ(guide.index(), i);
        EXPECT_EQ(guide.emotion(), photo_order[i]);
        take_one(std::uint8_t(i + 1));
        EXPECT_EQ(guide.search(), PhotoGuide::Search::found);
        guide.go_on();
    }
    EXPECT_EQ(guide.step(), Step::done);
    const std::vector<Photo> photos = guide.take_photos();
    ASSERT_EQ(photos.size(), face::emotion_count);
    for (std::size_t i = 0; i < photos.size(); ++i) {
        EXPECT_EQ(photos[i].emotion, photo_order[i]);
        EXPECT_EQ(photos[i].picture.pixels[0].r, i + 1);
        EXPECT_EQ((*photos[i].landmarks_px)[0].x, some_landmarks(double(i + 1))[0].x);
    }
}

TEST_F(PhotoGuideTest, ThePhotoIsTheFirstPictureAfterTheCount) {
    EXPECT_FALSE(guide.on_picture(picture(1).view(), now));
    guide.take_photo(now);
    EXPECT_EQ(guide.seconds_left(now), 3);
    EXPECT_FALSE(guide.on_picture(picture(2).view(), now + 2900ms));
    EXPECT_EQ(guide.seconds_left(now + 2900ms), 1);
    EXPECT_TRUE(guide.on_picture(picture(3).view(), now + 3100ms));
    EXPECT_EQ(guide.photo().picture.pixels[0].r, 3);
}

TEST_F(PhotoGuideTest, ACountCanBeStopped) {
    guide.take_photo(now);
    guide.stop_counting();
    EXPECT_EQ(guide.step(), Step::look);
    EXPECT_FALSE(guide.on_picture(picture(1).view(), now + 10s));
}

TEST_F(PhotoGuideTest, APhotoIsTakenAgain) {
    take_one(1);
    const std::size_t turn = guide.turn();
    guide.take_again();
    EXPECT_EQ(guide.step(), Step::look);
    EXPECT_EQ(guide.emotion(), face::Emotion::neutral);
    EXPECT_NE(guide.turn(), turn) << "what is found in the first one is not wanted any more";
    take_one(2);
    guide.go_on();
    EXPECT_EQ(guide.index(), 1u);
}

TEST_F(PhotoGuideTest, TheFirstPhotoCannotBeLeftOutAndTheOthersCan) {
    EXPECT_FALSE(guide.can_leave_out());
    EXPECT_FALSE(guide.can_finish());
    guide.leave_out();
    guide.finish();
    EXPECT_EQ(guide.index(), 0u);
    take_one();
    EXPECT_FALSE(guide.can_finish()) << "the first photo is not kept yet";
    guide.go_on();
    EXPECT_TRUE(guide.can_leave_out());
    guide.leave_out();
    EXPECT_EQ(guide.emotion(), face::Emotion::surprise);
    take_one();
    guide.finish();
    EXPECT_EQ(guide.step(), Step::done);
    const std::vector<Photo> photos = guide.take_photos();
    ASSERT_EQ(photos.size(), 2u);
    EXPECT_EQ(photos[1].emotion, face::Emotion::surprise);
}

TEST_F(PhotoGuideTest, APhotoThatWasKeptAndLeftOutLaterIsNotThere) {
    take_one();
    guide.go_on();
    take_one();
    guide.leave_out();
    guide.finish();
    EXPECT_EQ(guide.take_photos().size(), 1u);
}

TEST_F(PhotoGuideTest, EightClicksMarkAPhoto) {
    PhotoGuide marking = PhotoGuide::of_photos({{face::Emotion::neutral, picture(1), {}}}, usual());
    EXPECT_EQ(marking.step(), Step::find);
    marking.on_found(std::nullopt, PhotoGuide::Search::none);
    const face::Landmarks truth = some_landmarks();
    for (const std::size_t landmark : {36, 39, 42, 45, 30, 48, 54, 8}) {
        EXPECT_FALSE(marking.can_go_on());
        EXPECT_EQ(usual_command(marking, false), std::nullopt);
        marking.press(truth[landmark], 10);
        marking.release();
    }
    EXPECT_TRUE(marking.can_go_on());
    EXPECT_EQ(usual_command(marking, false), GuideCommand::keep);
    marking.go_on();
    const auto photos = marking.take_photos();
    ASSERT_EQ(photos.size(), 1u);
    // The usual face itself: all other landmarks are where they are on it.
    for (std::size_t i = 0; i < face::landmark_count; ++i)
        EXPECT_NEAR((*photos[0].landmarks_px)[i].x, truth[i].x, 1e-6);
}

TEST_F(PhotoGuideTest, ALandmarkIsDraggedAndNudged) {
    take_one();
    const Vec2 brow = guide.draft().point(19);
    guide.press({brow.x + 2, brow.y}, 8);
    guide.drag({brow.x + 2, brow.y - 20});
    guide.release();
    guide.drag({0, 0});
    EXPECT_EQ(guide.draft().point(19).y, brow.y - 20);
    EXPECT_EQ(guide.chosen(), 19u);
    guide.nudge({1, 0});
    EXPECT_EQ(guide.draft().point(19).x, brow.x + 3);
    guide.undo();
    EXPECT_EQ(guide.draft().point(19).y, brow.y);
    guide.nudge({1, 0});
    EXPECT_EQ(guide.draft().point(19).x, brow.x) << "nothing is chosen after undo";
}

TEST_F(PhotoGuideTest, APressOnNothingMovesNothing) {
    take_one();
    const Vec2 chin = guide.draft().point(8);
    guide.press({chin.x, chin.y + 100}, 8);
    guide.drag({chin.x, chin.y + 50});
    EXPECT_EQ(guide.draft().point(8).y, chin.y);
}

TEST_F(PhotoGuideTest, GivenLandmarksAreLookedOver) {
    PhotoGuide given =
        PhotoGuide::of_photos({{face::Emotion::neutral, picture(1), some_landmarks()},
                               {face::Emotion::anger, picture(2), {}}},
                              usual());
    EXPECT_EQ(given.step(), Step::mark);
    EXPECT_TRUE(given.can_go_on());
    EXPECT_FALSE(has_button(given, GuideCommand::again)) << "there is no camera";
    given.go_on();
    EXPECT_EQ(given.step(), Step::find);
    EXPECT_TRUE(given.can_leave_out());
}

TEST_F(PhotoGuideTest, ButtonsAreThoseThatDoSomething) {
    EXPECT_TRUE(has_button(guide, GuideCommand::take));
    EXPECT_FALSE(has_button(guide, GuideCommand::keep));
    EXPECT_FALSE(has_button(guide, GuideCommand::leave_out));
    EXPECT_EQ(usual_command(guide, false), std::nullopt) << "no picture yet";
    guide.take_photo(now);
    EXPECT_EQ(usual_command(guide, true), GuideCommand::stop);
    guide.stop_counting();
    take_one();
    for (const auto command : {GuideCommand::keep, GuideCommand::again, GuideCommand::undo})
        EXPECT_TRUE(has_button(guide, command));
    obey(guide, GuideCommand::keep, now);
    EXPECT_TRUE(has_button(guide, GuideCommand::leave_out));
    EXPECT_TRUE(has_button(guide, GuideCommand::ask_finish));
}

TEST_F(PhotoGuideTest, TheWayBackKeepsWhatWasTaken) {
    EXPECT_FALSE(guide.can_go_back());
    take_one(1);
    guide.go_on();
    take_one(2);
    EXPECT_TRUE(has_button(guide, GuideCommand::back));
    obey(guide, GuideCommand::back, now);
    EXPECT_EQ(guide.index(), 0u);
    EXPECT_EQ(guide.step(), Step::mark);
    EXPECT_EQ(guide.photo().picture.pixels[0].r, 1);
    EXPECT_EQ(guide.draft().point(0).x, some_landmarks(1)[0].x);
    guide.take_again();
    take_one(3);
    guide.go_on();
    EXPECT_EQ(guide.photo().picture.pixels[0].r, 2) << "the second photo is still there";
    EXPECT_EQ(guide.step(), Step::find);
}

TEST_F(PhotoGuideTest, FewPhotosAreAskedAbout) {
    take_one();
    guide.go_on();
    obey(guide, GuideCommand::ask_finish, now);
    EXPECT_TRUE(guide.asks_finish());
    EXPECT_EQ(guide.step(), Step::look) << "nothing has ended yet";
    EXPECT_EQ(guide.missing().size(), face::emotion_count - 1);
    const auto rows = guide_content(guide, true, now).panels[0].rows;
    EXPECT_NE(rows[0].text.find("1 of 6"), std::string::npos) << rows[0].text;
    EXPECT_NE(rows[0].detail.find("Sadness"), std::string::npos) << rows[0].detail;
    EXPECT_FALSE(has_button(guide, GuideCommand::take)) << "one question at a time";
    obey(guide, GuideCommand::keep_taking, now);
    EXPECT_TRUE(has_button(guide, GuideCommand::take));
    obey(guide, GuideCommand::ask_finish, now);
    EXPECT_EQ(usual_command(guide, true), GuideCommand::finish);
    obey(guide, GuideCommand::finish, now);
    EXPECT_EQ(guide.step(), Step::done);
    EXPECT_EQ(guide.take_photos().size(), 1u);
}

TEST_F(PhotoGuideTest, APhotoThatWasMarkedAndNotKeptCountsWhenFinishing) {
    take_one();
    guide.go_on();
    take_one();
    guide.ask_finish();
    EXPECT_EQ(guide.missing().size(), face::emotion_count - 2);
}

TEST_F(PhotoGuideTest, ThePersonIsToldWhatWasFound) {
    const auto said = [](const PhotoGuide& shown) {
        return guide_content(shown, true, {}).panels[0].rows[0].detail;
    };
    using Search = PhotoGuide::Search;
    PhotoGuide none = PhotoGuide::of_photos({{face::Emotion::neutral, picture(1), {}}}, usual());
    none.on_found(std::nullopt, Search::no_face);
    EXPECT_NE(said(none).find("No face was found"), std::string::npos) << said(none);
    PhotoGuide many = PhotoGuide::of_photos({{face::Emotion::neutral, picture(1), {}}}, usual());
    many.on_found(some_landmarks(), Search::found_largest);
    EXPECT_NE(said(many).find("several faces"), std::string::npos) << said(many);
}

TEST_F(PhotoGuideTest, LandmarksThatCannotBeAFacesAreNotKept) {
    PhotoGuide marking = PhotoGuide::of_photos({{face::Emotion::neutral, picture(1), {}}}, usual());
    marking.on_found(std::nullopt, PhotoGuide::Search::none);
    const face::Landmarks truth = some_landmarks();
    // Left and right eye and mouth exchanged.
    for (const std::size_t landmark : {45, 42, 39, 36, 30, 54, 48, 8})
        marking.press(truth[landmark], 1), marking.release();
    EXPECT_TRUE(marking.fault().has_value());
    EXPECT_FALSE(marking.can_go_on());
    EXPECT_FALSE(has_button(marking, GuideCommand::keep));
    EXPECT_EQ(guide_content(marking, true, {}).panels[0].rows[0].text, reason_of(*marking.fault()));
    marking.go_on();
    EXPECT_EQ(marking.step(), Step::mark);
    for (int i = 0; i < 8; ++i)
        marking.undo();
    for (const std::size_t landmark : {36, 39, 42, 45, 30, 48, 54, 8})
        marking.press(truth[landmark], 1), marking.release();
    EXPECT_TRUE(marking.can_go_on());
}

TEST_F(PhotoGuideTest, EightPlacesAreSetByKeysAlone) {
    PhotoGuide marking = PhotoGuide::of_photos({{face::Emotion::neutral, picture(1), {}}}, usual());
    marking.on_found(std::nullopt, PhotoGuide::Search::none);
    EXPECT_EQ(marking.cross_px(), std::nullopt);
    const face::Landmarks truth = some_landmarks();
    for (const std::size_t landmark : {36, 39, 42, 45, 30, 48, 54, 8}) {
        const Vec2 from = marking.cross_px().value_or(Vec2{320, 240});
        marking.nudge({truth[landmark].x - from.x, truth[landmark].y - from.y});
        ASSERT_EQ(usual_command(marking, true), GuideCommand::put);
        obey(marking, GuideCommand::put, now);
    }
    EXPECT_EQ(marking.cross_px(), std::nullopt);
    ASSERT_TRUE(marking.can_go_on());
    for (std::size_t i = 0; i < face::landmark_count; ++i)
        EXPECT_NEAR(marking.draft().point(i).x, truth[i].x, 1e-6);
}

TEST_F(PhotoGuideTest, TheCrossStaysInThePhoto) {
    PhotoGuide marking = PhotoGuide::of_photos({{face::Emotion::neutral, picture(1), {}}}, usual());
    marking.on_found(std::nullopt, PhotoGuide::Search::none);
    marking.nudge({-1e6, 1e6});
    EXPECT_EQ(marking.cross_px()->x, 0);
    EXPECT_EQ(marking.cross_px()->y, 480);
}

}  // namespace
}  // namespace theatron::enrol
