// SPDX-License-Identifier: Apache-2.0
// Monitors on ceiling arms.
#include "synthetic/scene.h"

namespace theatron::synthetic {
namespace {

// Looks along +z of its own frame, centre at the origin.
Mesh display(float width, float height, PictureNumber picture) {
    Mesh m;
    m.append(make_box({width + 0.05f, height + 0.05f, 0.045f}, 0.012f, Look::dark_plastic));
    m.append(make_box({width * 0.6f, height * 0.6f, 0.05f}, 0.02f, Look::grey_plastic),
             translation({0, 0, -0.04f}));
    m.append(make_picture(width, height, int(picture), Look::screen), translation({0, 0, 0.0235f}));
    return m;
}

void add_arm(Mesh& still, F3 ceiling_point, F3 screen) {
    const F3 elbow{ceiling_point.x, screen.y + 0.42f, ceiling_point.z};
    still.append(make_tube({ceiling_point, elbow}, {0.035f}, 16, Look::painted_metal));
    still.append(make_tube({elbow, mix(elbow, screen, 0.8f) + F3{0, 0.1f, 0}, screen}, {0.026f}, 14,
                           Look::painted_metal));
    still.append(make_cylinder(0.14f, 0.05f, 28, Look::white_plastic),
                 translation(ceiling_point + F3{0, -0.05f, 0}));
}

}  // namespace

void add_monitor(Mesh& still) {
    const F3 left{-1.75f, 1.62f, 1.35f}, right{0.3f, 1.74f, -1.8f};
    const F3 watched{0, 1.5f, 0};
    for (const F3 at : {left, right}) {
        const F3 forward = normalized(F3{watched.x - at.x, -0.05f, watched.z - at.z});
        const Affine frame = facing(at, forward, {0, 1, 0});
        still.append(display(0.62f, 0.39f, PictureNumber::monitor_vitals),
                     frame * translation({-0.35f, 0, 0}) * rotation({0, 1, 0}, 0.12f));
        still.append(display(0.56f, 0.467f, PictureNumber::monitor_slice),
                     frame * translation({0.34f, 0, 0}) * rotation({0, 1, 0}, -0.12f));
        still.append(make_box({0.7f, 0.05f, 0.05f}, 0.01f, Look::painted_metal),
                     frame * translation({0, 0, -0.09f}));
        add_arm(still, {at.x - forward.x * 0.5f, 2.95f, at.z - forward.z * 0.5f},
                at - forward * 0.1f);
    }
}

}  // namespace theatron::synthetic
