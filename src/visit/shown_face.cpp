// SPDX-License-Identifier: Apache-2.0
#include "visit/shown_face.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "face/sent_face.h"
#include "image/image.h"
#include "video/jpeg_encoder_native.h"
#include "video/jpeg_native.h"
#include "wire/own_face.h"

namespace theatron::visit {
namespace {

// Enough for a head that nobody sees the triangles of; fewer where bytes are missing.
constexpr std::size_t usual_vertices = 6000, fewest_vertices = 1500;
constexpr int best_quality = 85, worst_quality = 35;

ColorImage halved(const ColorImage& picture) {
    ColorImage half(Size{picture.size.width / 2, picture.size.height / 2});
    for (int y = 0; y < half.size.height; ++y)
        for (int x = 0; x < half.size.width; ++x) {
            const Rgb* above = picture.view().row(2 * y) + 2 * x;
            const Rgb* below = picture.view().row(2 * y + 1) + 2 * x;
            const auto mean = [&](std::uint8_t Rgb::*part) {
                return std::uint8_t(
                    (above[0].*part + above[1].*part + below[0].*part + below[1].*part + 2) / 4);
            };
            half.view().row(y)[x] = {mean(&Rgb::r), mean(&Rgb::g), mean(&Rgb::b)};
        }
    return half;
}

// The skin's pictures, of one size that a session takes.
std::array<std::optional<ColorImage>, face::emotion_count> skin_of(const face::EnrolledFace& face,
                                                                   const std::string& file) {
    std::array<std::optional<ColorImage>, face::emotion_count> skin;
    const ColorImage* neutral = nullptr;
    for (std::size_t i = face::emotion_count; i-- > 0;) {  // neutral is the last
        if (face.textures[i].empty())
            continue;
        ColorImage picture;
        video::JpegDecompressor decompressor;
        if (decompressor.decompress(face.textures[i], picture) != Status::ok ||
            std::max(picture.size.width, picture.size.height) > face::max_texture_side)
            throw Error("A texture of the face in '" + file + "' is damaged; enrol it again.");
        while (std::max(picture.size.width, picture.size.height) > face::max_sent_texture_side)
            picture = halved(picture);
        if (neutral && picture.size != neutral->size)
            throw Error("The textures of the face in '" + file +
                        "' differ in size; enrol it again.");
        skin[i] = std::move(picture);
        neutral = &*skin[std::size_t(face::Emotion::neutral)];
    }
    return skin;
}

}  // namespace

Bytes shown_face(const face::EnrolledFace& face, const std::string& file) {
    const auto skin = skin_of(face, file);
    face::EnrolledFace shown = face::without_shoulders(face);
    std::size_t vertices = usual_vertices;
    for (int quality = best_quality; quality >= worst_quality; quality -= 10) {
        shown = face::thinned(shown, vertices);
        for (std::size_t i = 0; i < skin.size(); ++i)
            if (skin[i]) {
                video::JpegCompressor compressor(quality, true);
                const ByteView jpeg = compressor.compress(skin[i]->view());
                shown.textures[i] = Bytes(jpeg.begin(), jpeg.end());
            }
        const bool is_small =
            shown.rest.vertex_count() <= face::max_sent_vertices &&
            shown.rest.triangles.size() <= face::max_sent_triangles &&
            std::all_of(shown.textures.begin(), shown.textures.end(), [](const Bytes& texture) {
                return texture.size() <= face::max_texture_bytes;
            });
        if (is_small)
            if (Bytes bytes = face::enrolled_bytes(shown); bytes.size() <= wire::max_own_face_bytes)
                return bytes;
        vertices = std::max(fewest_vertices, vertices * 2 / 3);
    }
    throw Error("The face in '" + file +
                "' is too detailed for a session, also when it is made simpler; enrol it with "
                "another head (--model).");
}

}  // namespace theatron::visit
