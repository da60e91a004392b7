// SPDX-License-Identifier: Apache-2.0
#include "face/enrol.h"

#include <utility>

#include "face/face_texture.h"
#include "face/painted_face.h"

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

// The skin's mean, and what the photo shows of eyes and mouth.
void set_colors(const FaceMesh& mesh, const FaceCamera& camera, const EnrolPhoto& photo,
                const TextureMap& map, const std::vector<Light>& texture, EnrolledFace& face) {
    Light mean{};
    float count = 0;
    for (std::size_t i = 0; i < texel_count; ++i)
        if (map.texels()[i].triangle != TextureMap::nothing) {
            ++count;
            for (std::size_t c = 0; c < 3; ++c)
                mean[c] += texture[i][c];
        }
    for (float& value : mean)
        value /= std::max(count, 1.F);
    face.colors[std::size_t(HeadPart::skin)] = face.colors[std::size_t(HeadPart::head)] =
        to_srgb(mean);
    for (const HeadPart part : {HeadPart::sclera, HeadPart::iris})
        if (const auto color = color_of_part(mesh, camera, photo.picture, part))
            face.colors[std::size_t(part)] = *color;
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
    TexturePart neutral;
    std::vector<Light> whole;
    for (std::size_t i = 0; i < photos.size(); ++i) {
        const FaceMesh mesh = mesh_of(model, fit->identity, fit->photos[i].channels);
        const FaceCamera camera{fit->photos[i].camera_from_face, seen[i].focal_px,
                                seen[i].centre_px};
        TexturePart part = unwrap_photo(map, mesh, camera, photos[i].picture);
        const std::size_t emotion = std::size_t(photos[i].emotion);
        if (i > 0) {
            result.textures[emotion] = texture_of(completed(part, neutral, whole));
            continue;
        }
        neutral = std::move(part);
        whole = completed(map, neutral);
        set_colors(mesh, camera, photos[i], map, whole, result.face);
        result.textures[emotion] = texture_of(whole);
        double skin = 0, found = 0;
        for (std::size_t t = 0; t < texel_count; ++t)
            if (map.texels()[t].triangle != TextureMap::nothing) {
                ++skin;
                found += neutral.weights[t] > 0 ? 1 : 0;
            }
        result.seen_share = found / std::max(skin, 1.0);
    }
    result.fit = std::move(*fit);
    return result;
}

}  // namespace theatron::face
