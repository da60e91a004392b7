// SPDX-License-Identifier: Apache-2.0
// The parts of the scene, and their builders.
#pragma once

#include <array>
#include <memory>

#include "synthetic/lighting.h"
#include "synthetic/picture.h"

namespace theatron::synthetic {

// A vertex follows up to four bones.
struct Influence {
    std::array<std::uint16_t, 4> bone{};
    std::array<float, 4> weight{1, 0, 0, 0};
};

// All moving parts as one mesh in its rest pose.
struct MovingMesh {
    Mesh mesh;
    std::vector<Influence> influences;  // one for each vertex

    void append(const Mesh& part, std::uint16_t bone);
    void append(const Mesh& part, const std::vector<Influence>& bones);
};

// Bone numbers. Each person has person_bone_count consecutive bones, see person.h.
inline constexpr std::uint16_t person_bone_count = 48;
enum Bone : std::uint16_t {
    still = 0,       // never moves
    breath = 1,      // the patient's belly
    organ = 2,       // rises with the breath, sideways too
    first_tool = 4,  // see Tool
    first_person = 16,
    bone_count = first_person + 2 * person_bone_count,
};

// Things held in hands; each has one bone.
enum Tool { scissors_a, scissors_b, forceps, hemostat, retractor, tool_count };

// Builders. Each appends one part in the room's frame.
void add_room_shell(Mesh& still);
void add_room_furniture(Mesh& still);
void add_lamps(Mesh& still);
void add_table(Mesh& still);
void add_tray(Mesh& still, std::uint32_t seed);
void add_bricks(Mesh& still, std::uint32_t seed);
void add_monitor(Mesh& still);
void add_patient(Mesh& still, MovingMesh& moving, double detail);
void add_situs(Mesh& still, MovingMesh& moving, double detail);
void add_people(MovingMesh& moving, double detail, std::uint32_t seed, const Pulse& pulse);
void add_tools(MovingMesh& moving);

// Transforms of the bones at `phase` (0 to 1 through the loop), from the rest pose to the room.
std::vector<Affine> pose_bones(double phase, double loop_seconds, std::uint32_t seed);

// Computes ambient occlusion: renders the mesh from many directions and counts how often each
// vertex is visible.
void bake_openness(Mesh& mesh, int directions, const Pulse& pulse);

}  // namespace theatron::synthetic
