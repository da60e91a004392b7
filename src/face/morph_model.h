// SPDX-License-Identifier: Apache-2.0
// A morphable head: a mesh, ways in which persons differ, and what each channel moves.
//
// Millimetres; x to the head's left, y up, z out of the face. Pure; the bytes of a model are
// specified in docs/formats/face_model.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "face/channels.h"
#include "geometry/vec.h"

namespace theatron::face {

// The 68 points of iBUG (300-W): jaw 0-16, brows 17-26, nose 27-35, eyes 36-47, mouth 48-67.
inline constexpr std::size_t landmark_count = 68;

// The part of a head to which a triangle belongs. Only the skin has a texture (enrolled_face.h).
enum class HeadPart : std::uint8_t { skin, head, gums, teeth, sclera, iris };
inline constexpr std::size_t part_count = 6;

struct MorphModel {
    std::vector<float> neutral;  // x, y, z of each vertex: the mean person at rest
    // u, v of each vertex in the skin's texture: from (0, 0) at the upper left to (1, 1), the
    // head's right on the left.
    std::vector<float> places;
    // Counter-clockwise seen from outside, those of a part behind each other in the parts' order.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::array<std::uint32_t, part_count> part_sizes{};  // triangles of each part; all together
    // Offsets of all vertices for one standard deviation of a way in which persons differ.
    std::vector<std::vector<float>> identities;
    // Offsets of all vertices at the channel's value 1. Two shapes may have the same channel: a
    // left and a right half of what ARKit does not part.
    struct Expression {
        Channel channel = eye_blink_left;
        std::vector<float> offsets;
    };
    std::vector<Expression> expressions;
    std::array<std::uint32_t, landmark_count> landmarks{};

    std::size_t vertex_count() const { return neutral.size() / 3; }
};

inline constexpr std::uint32_t max_vertices = 100000, max_triangles = 200000, max_shapes = 256;

// The vertices of a person with an expression. `identity` may be shorter than the model's list.
// `out` has three floats a vertex.
void blend_shape(const MorphModel& model, std::span<const float> identity, const Channels& channels,
                 std::span<float> out);

// The same for one vertex.
Vec3 blended_vertex(const MorphModel& model, std::span<const float> identity,
                    const Channels& channels, std::uint32_t vertex);

Bytes model_bytes(const MorphModel& model);
// Safe on any bytes. Files of version 1 have neither parts nor places: all is skin, laid round a
// cylinder.
Result<MorphModel> parse_model(ByteView bytes);

// A head of our own making: simple but human, so that everything works without another's model.
MorphModel generated_head();

}  // namespace theatron::face
