// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_scene.h"

#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "render/cloud_passes.h"
#include "render/cloud_textures.h"
#include "render/color_balance.h"
#include "render/color_visibility.h"
#include "render/depth_offsets.h"
#include "render/fewer_points.h"
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

constexpr Rgb background{32, 34, 38};

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

struct CloudScene::Parts {
    std::map<CameraId, Calibration> calibrations;  // of the images as they come
    int depth_step = 1;
    CloudTextures textures;
    ColorBalance balance;
    DepthOffsets offsets;
    CameraBlock cameras;
    ColorVisibility visibility;
    GridMesh grid;
    // Core profiles draw nothing without one, though no attributes are used.
    VertexArray no_attributes;
    std::map<std::string, std::unique_ptr<CloudPass>, std::less<>> passes;  // made when first used
    std::optional<RenderTarget> picture;

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

CloudScene::CloudScene() : parts_(std::make_unique<Parts>()) {}
CloudScene::~CloudScene() = default;
CloudScene::CloudScene(CloudScene&&) noexcept = default;
CloudScene& CloudScene::operator=(CloudScene&&) noexcept = default;

void CloudScene::set_camera(CameraId camera, const Calibration& calibration) {
    Calibration drawn = calibration;
    drawn.depth = every_nth(calibration.depth, parts_->depth_step);
    parts_->textures.set_camera(camera, drawn);
    parts_->calibrations[camera] = calibration;
}

void CloudScene::set_presence(CameraId camera, double presence) {
    parts_->textures.set_presence(camera, presence);
}

void CloudScene::set_cut(CameraId camera, const CloudCut& cut) {
    parts_->textures.set_cut(camera, cut);
}

bool CloudScene::set_depth_step(int step) {
    if (step == parts_->depth_step)
        return false;
    // All else as it was when new: textures and maps have another size now.
    const auto before = std::exchange(parts_, std::make_unique<Parts>());
    parts_->depth_step = step;
    parts_->balance = std::move(before->balance);
    parts_->offsets = std::move(before->offsets);
    for (const auto& [camera, calibration] : before->calibrations) {
        const CloudSource& source = before->textures.sources().at(camera);
        set_camera(camera, calibration);
        set_presence(camera, source.presence);
        set_cut(camera, source.cut);
        parts_->textures.set_color_gain(camera, source.color_gain);
        parts_->textures.set_depth_offset(camera, source.depth_offset_m);
    }
    return true;
}

void CloudScene::remove_camera(CameraId camera) {
    parts_->calibrations.erase(camera);
    parts_->textures.remove_camera(camera);
    parts_->balance.remove(camera);
    parts_->offsets.remove(camera);
}

Status CloudScene::upload(CameraId camera, DepthView depth, ColorView color) {
    const auto known = parts_->calibrations.find(camera);
    if (known == parts_->calibrations.end() || depth.size != known->second.depth.size)
        return Status::size_mismatch;
    const Status status =
        parts_->depth_step == 1
            ? parts_->textures.upload(camera, depth, color)
            : parts_->textures.upload(camera, every_nth(depth, parts_->depth_step).view(), color);
    if (status == Status::ok) {
        parts_->balance.add(camera, known->second, depth, color);
        parts_->offsets.add(camera, known->second, depth, color);
    }
    return status;
}

void CloudScene::draw(const CameraView& view, const DrawTarget& target, std::string_view renderer) {
    CloudPass& pass = parts_->pass(renderer);
    if (parts_->textures.sources().empty())
        return;
#ifndef __EMSCRIPTEN__
    if (epoxy_is_desktop_gl())
        glEnable(GL_PROGRAM_POINT_SIZE);  // always on in ES
#endif
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);  // surfaces are seen from behind, too
    glBindVertexArray(parts_->no_attributes.name());
    if (parts_->balance.update())
        for (const auto& [id, source] : parts_->textures.sources())
            parts_->textures.set_color_gain(id, parts_->balance.gain(id));
    if (parts_->offsets.update())
        for (const auto& [id, source] : parts_->textures.sources())
            parts_->textures.set_depth_offset(id, parts_->offsets.offset_m(id));
    const CloudFrame frame{parts_->textures, view, target, parts_->grid};
    parts_->cameras.bind(frame);
    parts_->visibility.update(parts_->textures);
    pass.prepare(frame);

    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glViewport(target.x, target.y, target.size.width, target.size.height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    pass.draw(frame);
    glBindVertexArray(0);
}

Picture CloudScene::render(const CameraView& view, Size size, std::string_view renderer) {
    check_renderer_name(renderer);
    if (!parts_->picture || parts_->picture->size() != size)
        parts_->picture.emplace(size);
    parts_->picture->clear(background);
    draw(view, parts_->picture->target(), renderer);
    return parts_->picture->read();
}

}  // namespace theatron::render
