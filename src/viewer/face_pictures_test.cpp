// SPDX-License-Identifier: Apache-2.0
#include "viewer/face_pictures.h"

#include <gtest/gtest.h>

#include "geometry/screen.h"
#include "render/test_context.h"

namespace theatron::viewer {
namespace {

constexpr ParticipantId face_owner{2};
constexpr CameraId face{7};

TEST(FaceOpacity, IsWholeWhileFreshAndFadesToNothing) {
    EXPECT_EQ(face_opacity(0), 1);
    EXPECT_EQ(face_opacity(fresh_face_ms), 1);
    EXPECT_NEAR(face_opacity((fresh_face_ms + gone_face_ms) / 2), 0.5, 1e-9);
    EXPECT_EQ(face_opacity(gone_face_ms), 0);
    EXPECT_EQ(face_opacity(1e9), 0);
}

class FacePicturesTest : public ::testing::Test {
protected:
    FacePicturesTest() {
        render::test_context();
        faces.set_camera(face_owner, face, screen_calibration(size, 0.3, {}));
    }
    static receive::CameraFrame frame(TimePoint captured, Size of = size) {
        receive::CameraFrame frame;
        frame.camera = face;
        frame.times.captured = captured;
        frame.color = std::make_shared<ColorImage>(of);
        return frame;
    }

    static constexpr Size size{32, 24};
    const TimePoint begin = from_us(5'000'000);
    FacePictures faces;
};

TEST_F(FacePicturesTest, APersonWithoutAPictureHasTheDrawnFace) {
    EXPECT_FALSE(faces.note(begin));
    EXPECT_TRUE(faces.pictures().empty());
}

TEST_F(FacePicturesTest, APictureIsOfItsPersonUntilItStandsStill) {
    faces.take(frame(begin), begin);
    EXPECT_TRUE(faces.note(begin));
    ASSERT_TRUE(faces.pictures().contains(face_owner));
    EXPECT_EQ(faces.pictures().at(face_owner).opacity, 1);
    EXPECT_EQ(faces.pictures().at(face_owner).age, "");
    EXPECT_FALSE(faces.note(begin + 1s)) << "nothing to draw again";
    EXPECT_TRUE(faces.note(begin + 2s));
    EXPECT_NEAR(faces.pictures().at(face_owner).opacity, 2.0 / 3, 1e-9);
    EXPECT_EQ(faces.pictures().at(face_owner).age, "picture stands still for 2 s");
    EXPECT_TRUE(faces.note(begin + 4s));
    EXPECT_TRUE(faces.pictures().empty());
    faces.take(frame(begin + 4s), begin + 4s);
    EXPECT_TRUE(faces.note(begin + 4s));
    EXPECT_EQ(faces.pictures().at(face_owner).opacity, 1) << "it goes on";
}

TEST_F(FacePicturesTest, APictureOfTheFutureFadesAsWell) {
    faces.take(frame(begin + 1h), begin);
    faces.note(begin + 4s);
    EXPECT_TRUE(faces.pictures().empty());
}

TEST_F(FacePicturesTest, TheSamePictureAgainIsNoNewerOne) {
    receive::CameraFrame again = frame(begin);
    faces.take(again, begin);
    again.times.captured = begin + 4s;
    faces.take(again, begin + 4s);
    faces.note(begin + 4s);
    EXPECT_TRUE(faces.pictures().empty());
}

TEST_F(FacePicturesTest, PicturesOfAnotherSizeAreNotShown) {
    faces.take(frame(begin, {64, 48}), begin);
    faces.note(begin);
    EXPECT_TRUE(faces.pictures().empty());
}

TEST_F(FacePicturesTest, AfterItsCameraHasLeftThereIsNone) {
    faces.take(frame(begin), begin);
    faces.note(begin);
    faces.remove_camera(face);
    EXPECT_TRUE(faces.pictures().empty());
}

}  // namespace
}  // namespace theatron::viewer
