// SPDX-License-Identifier: Apache-2.0
// The scene's parts and how they are put together.
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

// Everything that moves, as one mesh in its rest pose.
struct MovingMesh {
    Mesh mesh;
    std::vector<Influence> influences;  // one for each vertex

    void append(const Mesh& part, std::uint16_t bone);
    void append(const Mesh& part, const std::vector<Influence>& bones);
};

// Numbers of the bones. Each person has person_bones in a row, see person.h.
inline constexpr std::uint16_t person_bone_count = 48;
enum Bone : std::uint16_t {
    still = 0,       // never moves
    breath = 1,      // the patient's belly
    organ = 2,       // rises with the breath, sideways too
    first_tool = 4,  // see Tool
    first_person = 16,
    bone_count = first_person + 2 * person_bone_count,
};

// Things held in hands; each is one bone.
enum Tool { scissors_a, scissors_b, forceps, hemostat, retractor, tool_count };

// Builders. Each adds its own part; all in the room's frame.
void add_room_shell(Mesh& still);
void add_room_furniture(Mesh& still);
void add_lamps(Mesh& still);
void add_table(Mesh& still);
void add_tray(Mesh& still, std::uint32_t seed);
void add_bricks(Mesh& still, std::uint32_t seed);
void add_monitor(Mesh& still);
void add_patient(Mesh& still, MovingMesh& moving, double detail);
void add_situs(Mesh& still, MovingMesh& moving, double detail);
void add_people(MovingMesh& moving, double detail, std::uint32_t seed);
void add_tools(MovingMesh& moving);

// The bones' places at `phase` (0 … 1 through the loop): they take rest-pose
// points to the room.
std::vector<Affine> pose_bones(double phase, double loop_seconds, std::uint32_t seed);

// Darkens what stands close to other things: looks from many directions at the
// whole and counts for each vertex how often it is seen.
void bake_openness(Mesh& mesh, int directions);

}  // namespace theatron::synthetic
