// SPDX-License-Identifier: Apache-2.0
// Photos of persons that were drawn, so that shape and texture of the face are known.
#include "face/enrol.h"

#include <gtest/gtest.h>

#include <cmath>

#include "face/face_texture.h"
#include "face/fit_figures.h"
#include "face/painted_face.h"

namespace theatron::face {
namespace {

constexpr Size photo_size{640, 720};
constexpr double view_degrees = 40;

struct Made {
    PaintedPerson person;
    std::vector<PaintedPhoto> photos;
    std::optional<Enrolment> enrolment;
};

Made enrolled(const MorphModel& model, std::uint64_t seed, std::span<const Emotion> emotions,
              double noise_px) {
    Made made;
    made.person = painted_person(model, seed);
    for (const Emotion emotion : emotions)
        made.photos.push_back(
            painted_photo(model, made.person, emotion, seed, photo_size, view_degrees, noise_px));
    std::vector<EnrolPhoto> photos;
    for (std::size_t i = 0; i < made.photos.size(); ++i)
        photos.push_back({emotions[i], made.photos[i].picture.view(), made.photos[i].landmarks_px,
                          view_degrees});
    made.enrolment = enrol(model, photos);
    return made;
}

// In dB, over the texels of `where`, after the brightness that fits best: a photo does not tell
// how bright a face is.
double likeness(const ColorImage& a, const ColorImage& truth, const std::vector<bool>& where) {
    double square = 0, count = 0;
    const auto value = [](const ColorImage& of, std::size_t i, int c) {
        const Rgb pixel = of.pixels[i];
        return double(c == 0 ? pixel.r : c == 1 ? pixel.g : pixel.b);
    };
    for (int c = 0; c < 3; ++c) {
        double sum = 0, true_sum = 0;
        for (std::size_t i = 0; i < texel_count; ++i)
            if (where[i]) {
                sum += value(a, i, c);
                true_sum += value(truth, i, c);
            }
        for (std::size_t i = 0; i < texel_count; ++i)
            if (where[i]) {
                const double miss = value(a, i, c) * true_sum / sum - value(truth, i, c);
                square += miss * miss;
                ++count;
            }
    }
    return 10 * std::log10(255 * 255 * count / square);
}

// Texels that the true face shows to the camera.
std::vector<bool> seen_texels(const MorphModel& model, const TextureMap& map, const Made& made,
                              std::size_t photo) {
    const TexturePart part =
        unwrap_photo(map, mesh_of(model, made.person.identity, made.photos[photo].channels),
                     made.photos[photo].camera, made.photos[photo].picture.view());
    std::vector<bool> seen(texel_count);
    for (std::size_t i = 0; i < texel_count; ++i)
        seen[i] = part.weights[i] > 0.2F;
    return seen;
}

TEST(Enrol, OnePhotoGivesShapeAndTextureOfTheFace) {
    const MorphModel model = generated_head();
    const TextureMap map(model);
    constexpr Emotion only_neutral[] = {Emotion::neutral};
    double error = 0, mean_face_error = 0, dB = 0;
    constexpr int persons = 3;
    for (std::uint64_t seed = 1; seed <= persons; ++seed) {
        const Made made = enrolled(model, seed, only_neutral, 1);
        ASSERT_TRUE(made.enrolment);
        error += surface_error_mm(model, made.person.identity, made.enrolment->fit.identity, true);
        mean_face_error += surface_error_mm(model, made.person.identity, {}, true);
        EXPECT_LT(made.enrolment->fit.residual_px, 3);
        EXPECT_GT(made.enrolment->seen_share, 0.3);
        const auto& texture = made.enrolment->textures[std::size_t(Emotion::neutral)];
        ASSERT_TRUE(texture);
        dB += likeness(*texture, made.person.texture, seen_texels(model, map, made, 0));
        EXPECT_FALSE(made.enrolment->textures[std::size_t(Emotion::anger)]);
    }
    RecordProperty("texture_dB", std::to_string(dB / persons));
    RecordProperty("error_mm", std::to_string(error / persons));
    RecordProperty("mean_face_error_mm", std::to_string(mean_face_error / persons));
    EXPECT_LT(error / persons, 2.5) << "the mean face: " << mean_face_error / persons;
    EXPECT_LT(error, mean_face_error);
    EXPECT_GT(dB / persons, 24);
}

TEST(Enrol, LandmarksBesideTheJawLayNoBackgroundOnTheSkin) {
    const MorphModel model = generated_head();
    const PaintedPerson person = painted_person(model, 2);
    const PaintedPhoto photo = painted_photo(model, person, Emotion::neutral, 2, photo_size, 65);
    EnrolPhoto given{Emotion::neutral, photo.picture.view(), photo.landmarks_px, 65};
    const double width = given.landmarks_px[16].x - given.landmarks_px[0].x;
    for (std::size_t i = 0; i <= 16; ++i)  // the jaw, as finders of landmarks draw it
        given.landmarks_px[i].x += (i < 8 ? -0.05 : 0.05) * width * (i == 8 ? 0 : 1);
    const auto made = enrol(model, std::span(&given, 1));
    ASSERT_TRUE(made);
    const ColorImage& texture = *made->textures[std::size_t(Emotion::neutral)];
    const TextureMap map(model);
    const Rgb background = photo.picture.pixels[0];
    std::size_t skin = 0, dark = 0;
    for (std::size_t i = 0; i < texel_count; ++i)
        if (map.shows_skin(i)) {
            ++skin;
            const Rgb pixel = texture.pixels[i];
            dark += std::abs(pixel.r - background.r) < 12 &&
                    std::abs(pixel.g - background.g) < 12 && std::abs(pixel.b - background.b) < 12;
        }
    EXPECT_LT(double(dark), 0.001 * double(skin));
}

TEST(Enrol, PhotosOfEmotionsAreLaidOverEachOther) {
    const MorphModel model = generated_head();
    const TextureMap map(model);
    constexpr Emotion three[] = {Emotion::neutral, Emotion::happiness, Emotion::surprise};
    const Made made = enrolled(model, 4, three, 0.5);
    ASSERT_TRUE(made.enrolment);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& texture = made.enrolment->textures[std::size_t(three[i])];
        ASSERT_TRUE(texture);
        EXPECT_GT(likeness(*texture, made.person.texture, seen_texels(model, map, made, i)), 22)
            << to_text(three[i]);
        EXPECT_LT(made.enrolment->fit.photos[i].residual_px, 3);
    }
    // A strong expression is not taken for a smaller head that is nearer.
    EXPECT_NEAR(made.enrolment->eyes_apart_mm, eye_distance_mm(model, made.person.identity), 6);
    // All are as bright as the neutral one, whatever the photos were.
    const auto mean = [](const ColorImage& image) {
        double sum = 0;
        for (const Rgb pixel : image.pixels)
            sum += pixel.g;
        return sum / double(image.pixels.size());
    };
    const double neutral = mean(*made.enrolment->textures[std::size_t(Emotion::neutral)]);
    const double surprise = mean(*made.enrolment->textures[std::size_t(Emotion::surprise)]);
    EXPECT_NEAR(surprise / neutral, 1, 0.05);
}

TEST(Enrol, WhatNoPhotoShowsIsTakenFromTheOtherSide) {
    const MorphModel model = generated_head();
    const TextureMap map(model);
    // The left half is red, the right half was not seen.
    TexturePart half{std::vector<Light>(texel_count), std::vector<float>(texel_count)};
    for (std::size_t i = 0; i < texel_count; ++i)
        if (i % texture_side >= texture_side / 2) {
            half.light[i] = {0.5F, 0.1F, 0.1F};
            half.weights[i] = 1;
        }
    const std::vector<Light> whole = completed(map, half);
    for (std::size_t i = 0; i < texel_count; i += 97) {
        EXPECT_NEAR(whole[i][0], 0.5, 0.01) << i;
        EXPECT_NEAR(whole[i][1], 0.1, 0.01) << i;
    }
    const std::size_t cheek = 300 * texture_side + 150;
    const std::uint32_t other = map.mirrored(cheek);
    ASSERT_NE(other, TextureMap::nothing);
    EXPECT_NEAR(int(other % texture_side), texture_side - 150, 2);
    EXPECT_NEAR(int(other / texture_side), 300, 2);
}

TEST(Enrol, ACheekBehindTheNoseIsNotSeen) {
    const MorphModel model = generated_head();
    const FaceMesh mesh = mesh_of(model, {}, Channels{});
    const ColorImage photo(photo_size);
    const TextureMap map(model);
    const auto weight_beside_nose = [&](double yaw) {
        const TexturePart part =
            unwrap_photo(map, mesh, portrait_camera(mesh, photo_size, yaw), photo.view());
        // Both sides of the nose's back.
        const float* place = mesh.places.data() + 2 * std::size_t(model.landmarks[29]);
        const auto row = std::size_t(place[1] * texture_side) * texture_side;
        return std::array{part.weights[row + 232], part.weights[row + 280]};
    };
    const auto front = weight_beside_nose(0);
    EXPECT_GT(front[0], 0.3F);
    EXPECT_NEAR(front[0], front[1], 0.05);
    const auto turned = weight_beside_nose(60), back = weight_beside_nose(-60);
    EXPECT_LT(std::min(turned[0], turned[1]), 0.05F);
    EXPECT_NEAR(turned[0], back[1], 0.05);
    EXPECT_NE(turned[0] < turned[1], back[0] < back[1]);
}

TEST(Enrol, ADistanceOfTheEyesTellsTheSize) {
    const MorphModel model = generated_head();
    double with = 0, without = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const DrawnPerson person = drawn_person(model, seed, 1);
        const EyeDistance eyes{eye_distance_mm(model, person.identity)};
        const auto fit = fit_face(model, std::span(&person.photo, 1), eyes);
        const auto blind = fit_face(model, std::span(&person.photo, 1));
        ASSERT_TRUE(fit && blind);
        EXPECT_NEAR(eye_distance_mm(model, fit->identity), eyes.mm, 1.5);
        with += surface_error_mm(model, person.identity, fit->identity);
        without += surface_error_mm(model, person.identity, blind->identity);
    }
    EXPECT_LT(with, 0.9 * without);
    const DrawnPerson person = drawn_person(model, 1, 1);
    EXPECT_FALSE(fit_face(model, std::span(&person.photo, 1), EyeDistance{20}));
    EXPECT_FALSE(fit_face(model, std::span(&person.photo, 1), EyeDistance{63, 0}));
}

TEST(Enrol, OtherPhotosThanOneOfEachEmotionAreRefused) {
    const MorphModel model = generated_head();
    const ColorImage picture({64, 64});
    EnrolPhoto photo{Emotion::neutral, picture.view(), {}, view_degrees};
    EXPECT_FALSE(enrol(model, {}));
    EXPECT_FALSE(enrol(model, std::span(&photo, 1)));  // landmarks on one point
    photo.landmarks_px = drawn_person(model, 1, 0).photo.landmarks_px;
    const EnrolPhoto twice[] = {photo, photo};
    EXPECT_FALSE(enrol(model, twice));
    photo.emotion = Emotion::anger;
    EXPECT_FALSE(enrol(model, std::span(&photo, 1)));
}

}  // namespace
}  // namespace theatron::face
