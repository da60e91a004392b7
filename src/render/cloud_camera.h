// SPDX-License-Identifier: Apache-2.0
// One camera of a set of clouds on the GPU: its images, what was drawn from them for all views,
// and how it is to be shown.
//
// Each camera has textures of exactly its own size. Nothing of a camera depends on which others
// there are, and with the camera goes all that belongs to it.
#pragma once

#include <memory>
#include <optional>

#include "base/status.h"
#include "geometry/calibration.h"
#include "image/image.h"
#include "render/camera_view.h"
#include "render/cloud_cut.h"
#include "render/gl.h"
#include "render/grid_mesh.h"

namespace theatron::render {

// Pictures that a pass draws from a camera's images, once for all views. Each remembers of which
// content it is, 0: nothing was drawn yet.

// By ColorVisibility.
struct VisibilityMap {
    std::optional<Texture> nearest;
    Size size;
    unsigned content = 0;
};

// By SteadyColors.
struct SteadyColor {
    std::optional<Texture> pictures[2];  // of the newest frame and of the one before
    unsigned newest = 0;                 // which of the two is which
    Size size;
    unsigned colors = 0;
};

// By EdgeMaps.
struct EdgeMap {
    std::optional<Texture> whole;
    std::optional<Texture> distances[2];
    unsigned newest = 0;
};

// By SurfaceMaps.
struct SurfaceMap {
    std::optional<Texture> map;
    std::optional<Texture> refined[2];
    unsigned newest = 0;
    EdgeMap edges;
    unsigned images = 0, content = 0;
};

class CloudCamera {
public:
    // `grid` is of the depth image's size.
    CloudCamera(const Calibration& calibration, std::shared_ptr<GridMesh> grid);

    // For a calibration whose depth lens is the same; else make another camera, and give it
    // what take_settings takes over.
    void set_calibration(const Calibration& calibration);
    void take_settings(const CloudCamera& before);

    // See CloudSet. The buffer is only for the way to the GPU.
    Status upload(DepthView depth, ColorView color, const Buffer& staging);

    // Uploads what the shaders of cloud.glsl know of the camera for this view.
    void set_view(const CameraView& view);
    // Binds that, and the images to their units.
    void bind() const;

    const Calibration& calibration() const { return calibration_; }
    Size depth_size() const { return calibration_.depth.size; }
    Size color_size() const { return color_size_; }  // of the newest picture; 0 x 0: none yet
    GridMesh& grid() const { return *grid_; }

    // How many frames were uploaded: temporal filters take one step for each.
    unsigned images() const { return images_; }
    unsigned colors() const { return colors_; }  // of them with colour
    // Other than before whenever the images or what is found in them changed: also by another
    // colour lens, but not by where the camera stands.
    unsigned content() const { return content_; }

    double presence = 1;        // see CloudSet
    Vec3 color_gain{1, 1, 1};   // red, green, blue; see ColorBalance
    double depth_offset_m = 0;  // see DepthOffsets
    CloudCut cut;

    VisibilityMap visibility;
    SteadyColor steady;
    SurfaceMap surfaces[2];  // by SurfaceMaps::Kind

private:
    Calibration calibration_;
    std::shared_ptr<GridMesh> grid_;
    Texture depth_, rays_;
    std::optional<Texture> color_;
    Size color_size_;
    Buffer block_;
    unsigned images_ = 0, colors_ = 0, content_ = 1;
};

}  // namespace theatron::render
