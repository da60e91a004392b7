// SPDX-License-Identifier: Apache-2.0
// One camera of a set of clouds on the GPU: its images, the maps that were drawn from them for all
// views, and the settings of its drawing.
//
// Each camera has textures of exactly its own size. Its state does not depend on other cameras and
// is destroyed with it.
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

// Maps that a pass draws from a camera's images, once for all views. Each stores the number of the
// content from which it was drawn; 0: not drawn yet.

// By ColorVisibility.
struct VisibilityMap {
    std::optional<Texture> nearest;
    Size size;
    unsigned content = 0;
};

// By SteadyColors.
struct SteadyColor {
    std::optional<Texture> pictures[2];  // of the newest frame and of the one before
    unsigned newest = 0;                 // index of the newest one
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

    // For a calibration with the same depth lens. For another lens make a new CloudCamera and
    // call its take_settings().
    void set_calibration(const Calibration& calibration);
    void take_settings(const CloudCamera& before);

    // See CloudSet. `staging` holds the images only during the upload to the GPU.
    Status upload(DepthView depth, ColorView color, const Buffer& staging);

    // Uploads the uniform block of cloud.glsl for this view.
    void set_view(const CameraView& view);
    // Binds that block, and the images to their units.
    void bind() const;

    const Calibration& calibration() const { return calibration_; }
    Size depth_size() const { return calibration_.depth.size; }
    // The side of the square that a depth pixel covers at a distance of one metre, in metres.
    double tan_per_pixel() const { return 2 / (calibration_.depth.fx + calibration_.depth.fy); }
    Size color_size() const { return color_size_; }  // of the newest picture; 0 x 0: none yet
    GridMesh& grid() const { return *grid_; }

    // Number of uploaded frames: temporal filters take one step for each.
    unsigned images() const { return images_; }
    unsigned colors() const { return colors_; }  // of them with colour
    // Changes whenever the images or the maps drawn from them change: also with another colour
    // lens, but not with the camera's place in the room, nor with its gains.
    unsigned content() const { return content_; }

    double presence = 1;  // see CloudSet
    // See ColorBalance. Where the calibration has gains, each image brings it closer to them, so
    // that other gains do not jump into view; the first one takes them at once.
    Vec3 color_gain{1, 1, 1};
    double depth_offset_m = 0;  // see DepthOffsets; a calibration with an offset overrides it
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
    ColorImage shades_;  // of a camera without colour
    Buffer block_;
    unsigned images_ = 0, colors_ = 0, content_ = 1;
};

}  // namespace theatron::render
