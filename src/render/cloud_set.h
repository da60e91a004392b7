// SPDX-License-Identifier: Apache-2.0
// Live clouds: the images of a set of cameras, kept on the GPU and drawn from any viewpoint.
//
// The cameras of a set belong together: those of a room, or those of one person. They are drawn by
// one renderer, and balanced and blended with each other. Several sets are drawn one after another
// into the same target, whose depth test decides which of them is visible. Memory depends on the
// set's own cameras; sets that were made with the same CloudPrograms share their shaders.
//
// Depth and colour stay images: the vertex shader computes the points from the
// depth texture, a table of rays and the calibration. No GL type appears here,
// so that every other folder may include this file.
//
// All functions need the GL context current in which the scene was made, also
// the destructor.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/ids.h"
#include "base/status.h"
#include "geometry/calibration.h"
#include "image/image.h"
#include "render/camera_view.h"
#include "render/cloud_cut.h"
#include "render/draw_target.h"

namespace theatron::render {

// Largest number of cameras in a set.
inline constexpr int max_set_cameras = 16;

// The colour of pictures of clouds alone where there is none.
inline constexpr Rgb cloud_background{32, 34, 38};

// A picture read back. `depth_mm` is the distance along the view's axis in
// millimetres, 0 where no cloud was drawn and beyond 65 m.
struct Picture {
    ColorImage color;
    DepthImage depth_mm;
};

// The renderers, simplest first: "splat" (a round point for each depth pixel, sized by
// the gaps to its neighbours), "disc" (the same, lying in the surface, with its depth),
// "mesh" (the depth image as a grid, torn where it jumps), "blend" (the meshes of all
// cameras as one surface).
const std::vector<std::string>& renderer_names();

// A grid that is neither torn nor blended, for comparing times: it is accepted as a
// renderer, but not among renderer_names().
inline constexpr std::string_view yardstick_renderer = "bare_grid";

// Throws an Error that names the choices if there is no such renderer.
void check_renderer_name(std::string_view name);

// The shaders of all renderers, made when first used, and all else that does not depend on cameras.
class CloudPrograms {
public:
    CloudPrograms();
    ~CloudPrograms();
    CloudPrograms(const CloudPrograms&) = delete;
    CloudPrograms& operator=(const CloudPrograms&) = delete;

private:
    friend class CloudSet;
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

class CloudSet {
public:
    // Throws Error where the context lacks what the shaders need. Without programs the set makes
    // its own; those of other sets must be of the same context.
    explicit CloudSet(std::shared_ptr<CloudPrograms> programs = nullptr);
    ~CloudSet();
    CloudSet(CloudSet&&) noexcept;
    CloudSet& operator=(CloudSet&&) noexcept;

    // Adds a camera or changes its calibration. A change of its place alone is cheap and keeps its
    // images. A new depth lens takes some tens of milliseconds and drops the camera's images. No
    // other camera's picture changes. Throws Error beyond max_set_cameras.
    void set_camera(CameraId camera, const Calibration& calibration);
    void remove_camera(CameraId camera);
    // Sets a camera's opacity, from 0 to 1, so that new ones fade in and stale ones fade out. In
    // "blend" other cameras take over where they see the same surface, and elsewhere it becomes
    // transparent; the other renderers leave out more and more of its pixels. 1 when added.
    void set_presence(CameraId camera, double presence);

    // Draws only the depth pixels of every `step`-th column and row, for machines that are too slow
    // for all of them (1). Colour keeps its sharpness. True if the step changed: then clouds are
    // empty until their images are uploaded again.
    bool set_depth_step(int step);

    // Sets the part of a camera's cloud that is drawn; all of it when added.
    void set_cut(CameraId camera, const CloudCut& cut);

    // Factor of the diameter of points in "splat" and "disc": with 1 they leave no gaps. The other
    // renderers have no points.
    void set_point_size(double factor);

    // Takes a camera's newest images; both may be freed afterwards. `color` may
    // be empty (no pixels: the last one stays, grey if there was none) and of any size:
    // it is a scaled picture of the calibrated colour camera.
    // size_mismatch: depth is not of the calibrated size, or there is no such
    // camera; nothing was changed.
    Status upload(CameraId camera, DepthView depth, ColorView color);

    // Draws the clouds of this set over the target's content, tested against its depth. Colour goes
    // to the first draw buffer, the distance in millimetres to the second one (unsigned
    // integers), if there is one. Throws Error if there is no such renderer.
    void draw(const CameraView& view, const DrawTarget& target, std::string_view renderer);

    // The clouds alone before a dark background, read back: slow, waits for the GPU.
    Picture render(const CameraView& view, Size size, std::string_view renderer);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::render
