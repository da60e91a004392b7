// SPDX-License-Identifier: Apache-2.0
// The images of all cameras in one set of array textures, a layer each.
//
// The arrays are as large as the largest image; smaller ones lie in the upper
// left corner, with depth 0 beside them. Adding cameras or larger images moves
// everything to new textures and keeps what the cameras show.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/ids.h"
#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "image/image.h"
#include "render/cloud_cut.h"
#include "render/gl.h"

namespace theatron::render {

// The largest layers that the arrays get, in pixels. Cameras that would need larger ones are
// refused.
inline constexpr std::size_t max_layer_depth_pixels = 2 * max_depth_pixels;
inline constexpr std::size_t max_layer_color_pixels = 2 * max_color_pixels;

// One camera's place in the set.
struct CloudSource {
    Calibration calibration;
    int layer = 0;
    double presence = 1;        // see CloudScene
    Vec3 color_gain{1, 1, 1};   // red, green, blue; see ColorBalance
    double depth_offset_m = 0;  // see DepthOffsets
    Size color_size;            // of the newest picture; 0 x 0: none yet
    CloudCut cut;
    unsigned revision = 0;  // other than before whenever images or calibration changed
    Image<Ray> rays;        // kept for moving to larger textures
};

class CloudTextures {
public:
    // See CloudScene for what these do.
    void set_camera(CameraId camera, const Calibration& calibration);
    void set_presence(CameraId camera, double presence);
    void set_cut(CameraId camera, const CloudCut& cut);
    void set_color_gain(CameraId camera, Vec3 gain);
    void set_depth_offset(CameraId camera, double offset_m);
    void remove_camera(CameraId camera);
    Status upload(CameraId camera, DepthView depth, ColorView color);

    const std::map<CameraId, CloudSource>& sources() const { return sources_; }
    // The size that all layers of depth share; 0 x 0 without cameras.
    Size depth_size() const { return depth_size_; }
    // That all layers of colour share; at least 1 x 1 with cameras.
    Size color_size() const { return color_size_; }
    int layers() const { return layers_; }

    // Binds depth, rays and colour to the texture units 0, 1 and 2.
    void bind() const;

private:
    void make_room(int layers, Size depth, Size color);
    void copy_layer(const Texture& from, const Texture& to, int layer, Size size) const;
    int free_layer() const;

    std::map<CameraId, CloudSource> sources_;
    int layers_ = 0;
    unsigned revision_ = 0;
    Size depth_size_, color_size_;
    std::optional<Texture> depth_, rays_, color_;
    Framebuffer copy_source_;
    Buffer staging_;
};

}  // namespace theatron::render
