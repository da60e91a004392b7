// SPDX-License-Identifier: Apache-2.0
// A person's own face as it goes into a session: without shoulders, with few vertices. Pure.
#pragma once

#include "face/enrolled_face.h"

namespace theatron::face {

// Bounds of a face in a session; one with more is refused by its receivers.
inline constexpr std::size_t max_sent_vertices = 8192, max_sent_triangles = 16384;
inline constexpr int max_sent_texture_side = 512;

// The point between the pupils, in millimetres in the frame of the face, about where they are seen.
Vec3 between_eyes(const EnrolledFace& face);

// Triangles that lie deeper than the neck are left out: a figure has clothes there.
EnrolledFace without_shoulders(const EnrolledFace& face);

// The face with at most about this number of vertices: edges are collapsed where that changes the
// face and its moves least (Garland and Heckbert, 1997), onto vertices that were there. Borders,
// also those in the texture, stay. Takes a second or two for a head of 25 000 vertices.
EnrolledFace thinned(const EnrolledFace& face, std::size_t most_vertices);

// The content of enrolled_bytes() as a receiver takes it. Safe on any bytes. The textures' bytes
// are not looked into.
Result<EnrolledFace> parse_sent_face(ByteView bytes);

}  // namespace theatron::face
