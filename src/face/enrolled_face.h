// SPDX-License-Identifier: Apache-2.0
// A person's own face: the head that was fitted to their photos, what moves it, and a texture of
// each emotion. The bytes are specified in docs/formats/enrolled_face.md; on disk they are sealed
// with a passphrase (net/sealed_bytes.h).
//
// It needs no morphable model any more. Pure.
#pragma once

#include "face/emotion.h"
#include "face/expression.h"
#include "face/face_mesh.h"
#include "image/view.h"

namespace theatron::face {

// Moves of an enrolled face: the emotions without the lids that they open wider, and those that
// follow the person.
enum class Move : std::uint8_t {
    sadness,
    disgust,
    happiness,
    surprise,
    anger,
    jaw_open,
    blink_left,
    blink_right,
    wide_left,
    wide_right
};
inline constexpr std::size_t move_count = 10;

struct EnrolledFace {
    FaceMesh rest;  // neutral
    // Offsets of all vertices, x, y and z, at the move's full strength.
    std::array<std::vector<float>, move_count> moves;
    std::array<Rgb, part_count> colors{};  // of what has no texture; the skin's is its mean
    // JPEG pictures of the skin's texture. Empty: as neutral's, which is never empty.
    std::array<Bytes, emotion_count> textures;
};

inline constexpr std::size_t max_enrolled_vertices = 65535;
inline constexpr std::size_t max_enrolled_triangles = 131072;
inline constexpr std::size_t max_texture_bytes = 256 * 1024;
inline constexpr int max_texture_side = 1024;
// A longer file is refused before it is read.
inline constexpr std::size_t max_enrolled_bytes = std::size_t(16) << 20;

// A person of the model at rest, with all moves; without textures. `colors` are the usual ones.
// Precondition: at most max_enrolled_vertices and max_enrolled_triangles.
EnrolledFace enrolled_person(const MorphModel& model, std::span<const float> identity);

// The vertices of the face with these emotions; weights as blend_expressions() limits them.
void blend_face(const EnrolledFace& face, const Emotions& weights, const DirectChannels& direct,
                std::span<float> out);

// Points are rounded to 0.02 mm, offsets to 0.01 mm. Preconditions: as max_* say; coordinates are
// less than 650 mm, offsets less than 320 mm.
Bytes enrolled_bytes(const EnrolledFace& face);
// Safe on any bytes. The textures' bytes are not looked into.
Result<EnrolledFace> parse_enrolled(ByteView bytes);

}  // namespace theatron::face
