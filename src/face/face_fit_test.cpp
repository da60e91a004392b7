// SPDX-License-Identifier: Apache-2.0
#include "face/face_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/float_bytes.h"
#include "face/fit_figures.h"

namespace theatron::face {
namespace {

TEST(MorphModel, BytesRoundTripAndEveryTruncationIsRefused) {
    const MorphModel model = generated_head();
    const Bytes whole = model_bytes(model);
    const Result<MorphModel> read = parse_model(whole);
    ASSERT_TRUE(read);
    EXPECT_EQ(model_bytes(*read), whole);
    for (std::size_t n = 0; n < whole.size(); n += n < 400 ? 1 : 60013)
        EXPECT_EQ(parse_model(ByteView(whole).first(n)).error(),
                  n < 6 ? Status::malformed : Status::truncated)
            << n;
    Bytes longer = whole;
    longer.push_back(std::byte(0));
    EXPECT_EQ(parse_model(longer).error(), Status::trailing_bytes);
    Bytes newer = whole;
    newer[6] = std::byte(3);
    EXPECT_EQ(parse_model(newer).error(), Status::unsupported_version);
    Bytes huge = whole;
    huge[10] = std::byte(0x7f);  // the highest byte of the number of vertices
    EXPECT_EQ(parse_model(huge).error(), Status::too_large);
    Bytes outside = whole;
    store_le(outside.data() + 23 + 4 * part_count, std::uint32_t(99999));  // the first landmark
    EXPECT_EQ(parse_model(outside).error(), Status::malformed);
    Bytes unparted = whole;
    unparted[23] = std::byte(std::to_integer<unsigned>(unparted[23]) ^ 1U);
    EXPECT_EQ(parse_model(unparted).error(), Status::malformed);
    Bytes astray = whole;
    const std::size_t places_at = 23 + 4 * (part_count + landmark_count) + model.neutral.size() * 4;
    store_f32(astray.data() + places_at, 1.5F);
    EXPECT_EQ(parse_model(astray).error(), Status::malformed);
}

TEST(MorphModel, FilesOfTheFirstVersionHaveOnePartRoundACylinder) {
    const MorphModel model = generated_head();
    Bytes old = model_bytes(model);
    old[6] = std::byte(1);
    const auto at = [&](std::size_t bytes) { return old.begin() + std::ptrdiff_t(bytes); };
    const std::size_t places_at = 23 + 4 * (part_count + landmark_count) + model.neutral.size() * 4;
    old.erase(at(places_at), at(places_at + model.places.size() * 4));
    old.erase(at(23), at(23 + 4 * part_count));
    const Result<MorphModel> read = parse_model(old);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->neutral, model.neutral);
    EXPECT_EQ(read->part_sizes, model.part_sizes);
    ASSERT_EQ(read->places.size(), model.places.size());
    const std::size_t nose = model.landmarks[33];
    EXPECT_NEAR(read->places[2 * nose], 0.5, 0.01);
    EXPECT_LT(read->places[2 * std::size_t(model.landmarks[0])], 0.4);  // the right ear
}

TEST(GeneratedHead, HasLandmarksWhereAFaceHasThem) {
    const MorphModel head = generated_head();
    const auto at = [&](std::size_t landmark) {
        return blended_vertex(head, {}, Channels{}, head.landmarks[landmark]);
    };
    EXPECT_LT(at(0).x, -50);  // the right ear
    EXPECT_GT(at(16).x, 50);
    EXPECT_LT(at(8).y, at(57).y);  // the chin below the mouth
    for (std::size_t i = 0; i < landmark_count; ++i)
        EXPECT_LE(at(i).z, at(33).z + 15) << "the nose stands out";
    std::vector<float> blended(head.neutral.size());
    Channels smile{};
    smile[mouth_smile_left] = 1;
    const std::vector<float> person = {1, -1};
    blend_shape(head, person, smile, blended);
    for (const std::uint32_t vertex : head.landmarks) {
        const Vec3 one = blended_vertex(head, person, smile, vertex);
        EXPECT_NEAR(blended[vertex * 3 + 1], one.y, 1e-3);
    }
    // The left corner of the mouth rises, the right one stays.
    EXPECT_GT(blended_vertex(head, {}, smile, head.landmarks[54]).y, at(54).y + 4);
    EXPECT_NEAR(blended_vertex(head, {}, smile, head.landmarks[48]).y, at(48).y, 0.1);
}

TEST(FaceFit, ExactLandmarksGiveThePoseBack) {
    const MorphModel head = generated_head();
    const DrawnPerson person = drawn_person(head, 7, 0);
    const auto fit = fit_face(head, std::span(&person.photo, 1));
    ASSERT_TRUE(fit);
    EXPECT_LT(fit->residual_px, 1);
    EXPECT_LT(turned_degrees(person.camera_from_face, fit->photos[0].camera_from_face), 1.5);
}

TEST(FaceFit, IsBetterThanTheMeanFace) {
    const MorphModel head = generated_head();
    const FitFigures figures = fit_figures(head, 8, 1);
    EXPECT_EQ(figures.refused, 0);
    // One photo does not tell how large a head is.
    EXPECT_LT(figures.shape_error_mm, 0.8 * figures.mean_face_shape_error_mm);
    EXPECT_LT(figures.shape_error_mm, 2.5);
    EXPECT_LT(figures.pose_degrees, 2);
}

TEST(FaceFit, TwoPhotosGiveOnePerson) {
    const MorphModel head = generated_head();
    double with_two = 0, with_one = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const DrawnPerson first = drawn_person(head, seed, 2);
        const FacePhoto photos[] = {first.photo, drawn_person(head, seed, 2, 1).photo};
        const auto two = fit_face(head, photos), one = fit_face(head, std::span(photos).first(1));
        ASSERT_TRUE(two && one);
        EXPECT_EQ(two->photos.size(), 2U);
        with_two += surface_error_mm(head, first.identity, two->identity, true);
        with_one += surface_error_mm(head, first.identity, one->identity, true);
    }
    EXPECT_LT(with_two, with_one);
}

TEST(FaceFit, RefusesPhotosWithoutAFace) {
    const MorphModel head = generated_head();
    EXPECT_FALSE(fit_face(head, {}));
    FacePhoto photo = drawn_person(head, 1, 0).photo;
    photo.landmarks_px[5].x = NAN;
    EXPECT_FALSE(fit_face(head, std::span(&photo, 1)));
    photo = drawn_person(head, 1, 0).photo;
    photo.focal_px = 0;
    EXPECT_FALSE(fit_face(head, std::span(&photo, 1)));
    photo.focal_px = 1000;
    photo.landmarks_px.fill({3, 3});
    EXPECT_FALSE(fit_face(head, std::span(&photo, 1)));
}

TEST(Pts, ReadsLandmarksAndRefusesOthers) {
    std::string text = "version: 1\nn_points:  68\n{\n";
    for (int i = 0; i < 68; ++i)
        text += std::to_string(i) + ".5 " + std::to_string(2 * i) + "\r\n";
    const auto read = parse_pts(text + "}\n");
    ASSERT_TRUE(read);
    EXPECT_EQ((*read)[67], (Vec2{67.5, 134}));
    EXPECT_EQ(parse_pts(text).error(), Status::truncated);
    EXPECT_EQ(parse_pts(text + "1 2\n}").error(), Status::malformed);
    EXPECT_EQ(parse_pts("n_points: 51\n{").error(), Status::size_mismatch);
    EXPECT_EQ(parse_pts("a face").error(), Status::malformed);
}

}  // namespace
}  // namespace theatron::face
