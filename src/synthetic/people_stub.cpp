#include "synthetic/scene.h"
namespace theatron::synthetic {
void add_people(MovingMesh&, double, std::uint32_t) {}
void add_tools(MovingMesh&) {}
std::vector<Affine> pose_bones(double, double, std::uint32_t) { return std::vector<Affine>(bone_count); }
}
