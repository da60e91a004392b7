// SPDX-License-Identifier: Apache-2.0
// The path of one camera's pictures with each method: from the camera's images to those that
// arrive.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare_costs.h"
#include "compare_scene.h"
#include "point_file.h"

namespace theatron::bench {

// The last images of one camera that the expert's computer has, the newest at the end. Video has no
// depth, points have depth without colour beside them.
struct ArrivedCamera {
    Calibration calibration;  // of the images that arrive
    std::vector<DepthImage> depth;
    std::vector<ColorImage> color;
    PointCloud points;                          // in the camera's frame
    double point_edge_m = 0, point_grid_m = 0;  // as drawn; to which they were rounded
    std::string library;                        // that made the points, with its version
};

// Functions throw Error if a codec refuses a picture.
class CameraPath {
public:
    virtual ~CameraPath() = default;
    // Returns the number of bytes of the camera's picture `number`.
    virtual std::size_t send(const CompareCamera& camera, std::size_t number) = 0;
    // Adds the images of the last send().
    virtual void receive(ArrivedCamera& arrived) = 0;
    // Called after the last picture: adds what comes only then, and its costs.
    virtual void finish(ArrivedCamera&, std::vector<PictureCost>&) {}
};

std::unique_ptr<CameraPath> make_video_path(const std::string& color_codec);
std::unique_ptr<CameraPath> make_paper_path(const CompareCamera& camera);
std::unique_ptr<CameraPath> make_theatron_path(const CompareCamera& camera,
                                               const std::string& color_codec);
// Needs PCL: missing_pcl().
std::unique_ptr<CameraPath> make_pcl_path(const CompareCamera& camera);

}  // namespace theatron::bench
