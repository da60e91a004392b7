// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_set.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "geometry/color_balance.h"
#include "render/cloud_camera.h"
#include "render/cloud_passes.h"
#include "render/color_visibility.h"
#include "render/depth_offsets.h"
#include "render/fewer_points.h"
#include "render/grid_mesh.h"
#include "render/render_target.h"

namespace theatron::render {
namespace {

struct NamedPass {
    std::string_view name;
    std::unique_ptr<CloudPass> (*make)();
};

constexpr NamedPass passes[] = {{"splat", make_splat_pass},
                                {"disc", make_disc_pass},
                                {"mesh", make_mesh_pass},
                                {"blend", make_blend_pass},
                                {yardstick_renderer, make_bare_grid_pass}};

}  // namespace

const std::vector<std::string>& renderer_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const NamedPass& pass : passes)
            if (pass.name != yardstick_renderer)
                all.emplace_back(pass.name);
        return all;
    }();
    return names;
}

void check_renderer_name(std::string_view name) {
    if (name == yardstick_renderer)
        return;
    std::string choices;
    for (const std::string& known : renderer_names()) {
        if (known == name)
            return;
        choices += (choices.empty() ? "" : ", ") + known;
    }
    throw Error("There is no renderer \"" + std::string(name) + "\": choose one of " + choices +
                ".");
}

struct CloudPrograms::Parts {
    ColorVisibility visibility;
    GridMeshes grids;
    Buffer staging;
    // Core profiles draw nothing without one, though no attributes are used.
    VertexArray no_attributes;
    std::map<std::string, std::unique_ptr<CloudPass>, std::less<>> passes;  // made when first used

    CloudPass& pass(std::string_view name) {
        check_renderer_name(name);
        auto known = passes.find(name);
        if (known == passes.end())
            for (const NamedPass& candidate : render::passes)
                if (candidate.name == name)
                    known = passes.emplace(name, candidate.make()).first;
        return *known->second;
    }
};

CloudPrograms::CloudPrograms() : parts_(std::make_unique<Parts>()) {}
CloudPrograms::~CloudPrograms() = default;

struct CloudSet::Parts {
    struct Camera {
        Calibration calibration;  // of the images as they come
        CloudCamera drawn;
    };
    std::shared_ptr<CloudPrograms> programs;
    std::map<CameraId, Camera> cameras;
    int depth_step = 1;
    double point_size = 1;
    ColorBalance balance;
    DepthOffsets offsets;
    BlendLayers layers;
    std::optional<RenderTarget> picture;

    explicit Parts(std::shared_ptr<CloudPrograms> given)
        : programs(given ? std::move(given) : std::make_shared<CloudPrograms>()) {}

    Calibration of_drawn(Calibration calibration) const {
        calibration.depth = every_nth(calibration.depth, depth_step);
        return calibration;
    }
    CloudCamera make_camera(const Calibration& calibration) {
        const Calibration drawn = of_drawn(calibration);
        return {drawn, programs->parts_->grids.of(drawn.depth.size)};
    }
    // A camera with other images loses its state, except for the settings of its drawing.
    void replace(Camera& camera) {
        CloudCamera drawn = make_camera(camera.calibration);
        drawn.take_settings(camera.drawn);
        camera.drawn = std::move(drawn);
    }
    CloudCamera* find(CameraId id) {
        const auto known = cameras.find(id);
        return known == cameras.end() ? nullptr : &known->second.drawn;
    }
    void take_estimates() {
        if (balance.update())
            for (auto& [id, camera] : cameras)
                if (!camera.calibration.color_gain)
                    camera.drawn.color_gain = balance.gain(id);
        if (offsets.update())
            for (auto& [id, camera] : cameras)
                camera.drawn.depth_offset_m = offsets.offset_m(id);
    }
};

CloudSet::CloudSet(std::shared_ptr<CloudPrograms> programs)
    : parts_(std::make_unique<Parts>(std::move(programs))) {}
CloudSet::~CloudSet() = default;
CloudSet::CloudSet(CloudSet&&) noexcept = default;
CloudSet& CloudSet::operator=(CloudSet&&) noexcept = default;

void CloudSet::set_camera(CameraId id, const Calibration& calibration) {
    Parts& p = *parts_;
    const auto known = p.cameras.find(id);
    if (known == p.cameras.end()) {
        if (p.cameras.size() == std::size_t(max_set_cameras))
            throw Error("A set of clouds has at most " + std::to_string(max_set_cameras) +
                        " cameras.");
        p.cameras.emplace(id, Parts::Camera{calibration, p.make_camera(calibration)});
        return;
    }
    Parts::Camera& camera = known->second;
    const bool same_lens = camera.calibration.depth == calibration.depth;
    camera.calibration = calibration;
    if (same_lens)
        camera.drawn.set_calibration(p.of_drawn(calibration));
    else
        p.replace(camera);
}

void CloudSet::set_presence(CameraId id, double presence) {
    if (CloudCamera* camera = parts_->find(id))
        camera->presence = std::clamp(presence, 0.0, 1.0);
}

void CloudSet::set_cut(CameraId id, const CloudCut& cut) {
    if (CloudCamera* camera = parts_->find(id))
        camera->cut = cut;
}

bool CloudSet::set_depth_step(int step) {
    if (step == parts_->depth_step)
        return false;
    parts_->depth_step = step;
    for (auto& [id, camera] : parts_->cameras)
        parts_->replace(camera);
    return true;
}

void CloudSet::set_point_size(double factor) {
    parts_->point_size = factor;
}

void CloudSet::remove_camera(CameraId id) {
    parts_->cameras.erase(id);
    parts_->balance.remove(id);
    parts_->offsets.remove(id);
}

Status CloudSet::upload(CameraId id, DepthView depth, ColorView color) {
    Parts& p = *parts_;
    const auto known = p.cameras.find(id);
    if (known == p.cameras.end() || depth.size != known->second.calibration.depth.size)
        return Status::size_mismatch;
    Parts::Camera& camera = known->second;
    const Buffer& staging = p.programs->parts_->staging;
    const Status status =
        p.depth_step == 1
            ? camera.drawn.upload(depth, color, staging)
            : camera.drawn.upload(every_nth(depth, p.depth_step).view(), color, staging);
    if (status == Status::ok) {
        p.balance.add(id, camera.calibration, depth, color);
        p.offsets.add(id, camera.calibration, depth, color);
    }
    return status;
}

void CloudSet::draw(const CameraView& view, const DrawTarget& target, std::string_view renderer) {
    Parts& p = *parts_;
    CloudPrograms::Parts& programs = *p.programs->parts_;
    CloudPass& pass = programs.pass(renderer);
    if (p.cameras.empty())
        return;
#ifndef __EMSCRIPTEN__
    if (epoxy_is_desktop_gl())
        glEnable(GL_PROGRAM_POINT_SIZE);  // always on in ES
#endif
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);  // surfaces are seen from behind, too
    glBindVertexArray(programs.no_attributes.name());
    p.take_estimates();
    std::vector<CloudCamera*> cameras;
    for (auto& [id, camera] : p.cameras) {
        cameras.push_back(&camera.drawn);
        camera.drawn.set_view(view);
        camera.drawn.bind();
        programs.visibility.update(camera.drawn);
        pass.prepare(camera.drawn);
    }

    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glViewport(target.x, target.y, target.size.width, target.size.height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    pass.draw({cameras, view, target, p.layers, p.point_size});
    glBindVertexArray(0);
    glActiveTexture(GL_TEXTURE0);
}

Picture CloudSet::render(const CameraView& view, Size size, std::string_view renderer) {
    check_renderer_name(renderer);
    if (!parts_->picture || parts_->picture->size() != size)
        parts_->picture.emplace(size);
    parts_->picture->clear(cloud_background);
    draw(view, parts_->picture->target(), renderer);
    return parts_->picture->read();
}

}  // namespace theatron::render
