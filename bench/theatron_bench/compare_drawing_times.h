// SPDX-License-Identifier: Apache-2.0
// How long the expert's computer takes to draw a picture. Needs the GL context current.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare_paths.h"
#include "render/camera_view.h"
#include "render/cloud_set.h"

namespace theatron::bench {

// The newest images of all cameras are uploaded and drawn: the median of some pictures, on the
// clock, until the GPU has finished. All must have been drawn before, so that programs are
// compiled.
double drawing_ms_of_clouds(render::CloudSet& clouds, const std::vector<ArrivedCamera>& arrived,
                            const render::CameraView& view, Size size, const std::string& renderer);

// The newest pictures of all cameras are uploaded and scaled beside each other into a picture of
// `size`.
double drawing_ms_of_video(const std::vector<ArrivedCamera>& arrived, Size size);

// The median time of some calls, on the clock.
double drawing_ms_of(const std::function<void()>& draw);

}  // namespace theatron::bench
