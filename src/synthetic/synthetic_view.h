// SPDX-License-Identifier: Apache-2.0
// Internals of OperatingRoom: the scene's data, a posed moment, a camera's view.
#pragma once

#include "synthetic/operating_room.h"
#include "synthetic/scene.h"

namespace theatron::synthetic {

struct SceneData {
    SceneOptions options;
    Mesh still;
    MovingMesh moving;
    std::vector<Picture> pictures;
    std::vector<ShadowMap> still_shadows;
};

// The moving parts, posed.
class PosedMoment final : public RoomMoment {
public:
    PosedMoment(const SceneData& scene, Duration time);
    Duration time() const override { return time_; }

    std::vector<F3> positions, normals;
    std::vector<ShadowMap> shadows;  // of the moving parts, one for each lamp

private:
    Duration time_;
};

std::unique_ptr<RoomView> make_view(const SceneData& scene, const Calibration& camera,
                                    const RenderOptions& options, const Pulse& pulse);

}  // namespace theatron::synthetic
