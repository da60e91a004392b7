// SPDX-License-Identifier: Apache-2.0
#include "face/enrol.h"

#include <utility>

#include "face/face_texture.h"

namespace theatron::face {
namespace {

FacePhoto landmarks_photo(const EnrolPhoto& photo) {
    FacePhoto seen;
    seen.landmarks_px = photo.landmarks_px;
    seen.focal_px = focal_of(photo.picture.size, photo.view_degrees);
    seen.expected = channels_of(photo.emotion);
    seen.centre_px = {photo.picture.size.width / 2.0, photo.picture.size.height / 2.0};
    return seen;
}

bool are_sound(std::span<const EnrolPhoto> photos) {
    std::array<bool, emotion_count> has{};
    for (const EnrolPhoto& photo : photos) {
        if (std::exchange(has[std::size_t(photo.emotion)], true) || !is_valid(photo.picture.size) ||
            !(photo.view_degrees > 0 && photo.view_degrees < 170))
            return false;
    }
    return !photos.empty() && photos[0].emotion == Emotion::neutral;
}

// The skin's mean, and what the photo shows of the eyes.
void set_colors(const FaceMesh& mesh, const FaceCamera& camera, ColorView photo,
                const TextureMap& map, const std::vector<Light>& texture, EnrolledFace& face) {
    Light mean{};
    float count = 0;
    for (std::size_t i = 0; i < texel_count; ++i)
        if (map.shows_skin(i)) {
            ++count;
            for (std::size_t c = 0; c < 3; ++c)
                mean[c] += texture[i][c];
        }
    for (float& value : mean)
        value /= std::max(count, 1.F);
    face.colors[std::size_t(HeadPart::skin)] = face.colors[std::size_t(HeadPart::head)] =
        to_srgb(mean);
    const auto seen = colors_of_parts(mesh, camera, photo);
    for (const HeadPart part : {HeadPart::sclera, HeadPart::iris})
        if (const auto color = seen[std::size_t(part)])
            face.colors[std::size_t(part)] = *color;
}

double seen_share(const TextureMap& map, const TexturePart& part) {
    double skin = 0, seen = 0;
    for (std::size_t i = 0; i < texel_count; ++i)
        if (map.shows_skin(i)) {
            ++skin;
            seen += part.weights[i] > 0 ? 1 : 0;
        }
    return seen / std::max(skin, 1.0);
}

}  // namespace

std::optional<Enrolment> enrol(const MorphModel& model, std::span<const EnrolPhoto> photos,
                               std::optional<EyeDistance> eyes) {
    if (!are_sound(photos))
        return std::nullopt;
    std::vector<FacePhoto> seen;
    for (const EnrolPhoto& photo : photos)
        seen.push_back(landmarks_photo(photo));
    auto fit = fit_face(model, seen, eyes);
    if (!fit)
        return std::nullopt;
    Enrolment result;
    result.face = enrolled_person(model, fit->identity);
    result.eyes_apart_mm = eye_distance_mm(model, fit->identity);
    const TextureMap map(model);
    const auto mesh_in = [&](std::size_t photo) {
        return mesh_of(model, fit->identity, fit->photos[photo].channels);
    };
    const auto camera_in = [&](std::size_t photo) {
        return FaceCamera{fit->photos[photo].camera_from_face, seen[photo].focal_px,
                          seen[photo].centre_px};
    };
    const FaceMesh mesh = mesh_in(0);
    const FaceCamera camera = camera_in(0);
    const TexturePart neutral = unwrap_photo(map, mesh, camera, photos[0].picture);
    const std::vector<Light> whole = completed(map, neutral);
    set_colors(mesh, camera, photos[0].picture, map, whole, result.face);
    result.seen_share = seen_share(map, neutral);
    result.textures[std::size_t(Emotion::neutral)] = texture_of(whole);
    for (std::size_t i = 1; i < photos.size(); ++i) {
        const TexturePart part = unwrap_photo(map, mesh_in(i), camera_in(i), photos[i].picture);
        result.textures[std::size_t(photos[i].emotion)] =
            texture_of(completed(part, neutral, whole));
    }
    result.fit = std::move(*fit);
    return result;
}

}  // namespace theatron::face
