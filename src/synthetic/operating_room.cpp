// SPDX-License-Identifier: Apache-2.0
#include "synthetic/operating_room.h"

#include "base/error.h"
#include "synthetic/synthetic_view.h"

namespace theatron::synthetic {

std::string_view to_text(Material material) {
    static constexpr std::string_view names[] = {
        "none",  "wall", "floor", "door",  "plastic", "metal",  "polished", "rubber", "glass",
        "drape", "gown", "cap",   "mask",  "glove",   "skin",   "eye",      "hair",   "tissue",
        "liver", "fat",  "gauze", "paper", "brick",   "screen", "scrubs"};
    static_assert(std::size(names) == std::size_t(Material::count));
    return material < Material::count ? names[std::size_t(material)] : "unknown";
}

PosedMoment::PosedMoment(const SceneData& scene, Duration time) : time_(time) {
    const Duration loop = scene.options.loop;
    const Duration within = (time % loop + loop) % loop;
    const double seconds = double(loop.count()) / 1e6;
    const std::vector<Affine> bones =
        pose_bones(double(within.count()) / double(loop.count()), seconds, scene.options.seed);
    const Mesh& rest = scene.moving.mesh;
    positions.resize(rest.positions.size());
    normals.resize(rest.positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Influence& in = scene.moving.influences[i];
        F3 p{}, n{};
        for (std::size_t b = 0; b < 4 && in.weight[b] > 0; ++b) {
            p += (bones[in.bone[b]] * rest.positions[i]) * in.weight[b];
            n += bones[in.bone[b]].turn(rest.normals[i]) * in.weight[b];
        }
        positions[i] = p;
        normals[i] = normalized(n);
    }
    for (const Lamp& lamp : lamps())
        shadows.emplace_back(lamp, positions);
}

struct OperatingRoom::Scene : SceneData {};

OperatingRoom::OperatingRoom(const SceneOptions& options, const Pulse& pulse) {
    if (options.loop < 2s || options.loop > 120s)
        throw Error("The synthetic room's loop must last between 2 and 120 seconds.");
    const auto go_on = [&] {
        if (pulse)
            pulse();
    };
    auto scene = std::make_unique<Scene>();
    scene->options = options;
    scene->pictures = make_pictures();
    Mesh& still = scene->still;
    go_on();
    add_room_shell(still);
    add_room_furniture(still);
    add_lamps(still);
    add_table(still);
    go_on();
    add_tray(still, options.seed);
    add_bricks(still, options.seed);
    add_monitor(still);
    Mesh cover;  // moves slightly, and is built among the static parts
    if (options.people) {
        go_on();
        add_patient(still, scene->moving, options.detail);
        cover = scene->moving.mesh;
        go_on();
        add_situs(still, scene->moving, options.detail);
        go_on();
        add_people(scene->moving, options.detail, options.seed, pulse);
        add_tools(scene->moving);
    }
    go_on();
    split_long_edges(still, 0.16f);
    Mesh together = still;
    together.append(cover);
    bake_openness(together, options.detail >= 1 ? 64 : options.detail > 0.1 ? 12 : 3, pulse);
    const auto first = together.openness.begin();
    const auto seam = first + std::ptrdiff_t(still.openness.size());
    std::copy(first, seam, still.openness.begin());
    std::copy(seam, together.openness.end(), scene->moving.mesh.openness.begin());
    for (const Lamp& lamp : lamps())
        scene->still_shadows.emplace_back(lamp, still.positions, still.triangles);
    scene_ = std::move(scene);
}

OperatingRoom::~OperatingRoom() = default;

const SceneOptions& OperatingRoom::options() const {
    return scene_->options;
}

std::shared_ptr<const RoomMoment> OperatingRoom::at(Duration time) const {
    return std::make_shared<PosedMoment>(*scene_, time);
}

std::unique_ptr<RoomView> OperatingRoom::look_from(const Calibration& camera,
                                                   const RenderOptions& options,
                                                   const Pulse& pulse) const {
    return make_view(*scene_, camera, options, pulse);
}

GroundTruth OperatingRoom::render(const Calibration& camera, Duration time,
                                  const RenderOptions& options) const {
    return look_from(camera, options)->render(*at(time));
}

}  // namespace theatron::synthetic
