// SPDX-License-Identifier: Apache-2.0
#include "synthetic/frame_maker.h"

#include <cmath>

#include "base/error.h"
#include "codec/rvl.h"
#include "geometry/ray_table.h"
#include "synthetic/sensor_model.h"

namespace theatron::synthetic {

// The models of the depth and colour sensors, with their input images.
struct FrameMaker::Sensor {
    DepthSensor depth;
    std::uint32_t seed;
    Image<Ray> rays;
    Image<float> reflectivity, cosine, specular;
    ColorImage color;

    Sensor(const CameraModel& camera, std::uint32_t camera_seed)
        : depth(camera.size.width > 320 ? nfov_unbinned() : nfov_binned(), camera.size,
                camera_seed),
          seed(camera_seed),
          rays(make_ray_table(camera)),
          reflectivity(camera.size),
          cosine(camera.size),
          specular(camera.size) {}

    void measure(const GroundTruth& truth, std::uint32_t frame, DepthImage& out) {
        for (std::size_t i = 0; i < rays.pixels.size(); ++i) {
            const SurfaceSample& s = truth.surface.pixels[i];
            const Ray r = rays.pixels[i];
            const float along = -(s.nx * r.x + s.ny * r.y + s.nz);
            cosine.pixels[i] = std::max(along / std::sqrt(r.x * r.x + r.y * r.y + 1), 0.0f);
            reflectivity.pixels[i] = s.infrared;
            specular.pixels[i] = s.specular;
        }
        out.resize(truth.depth_m.size);
        depth.capture({truth.depth_m.view(), reflectivity.view(), cosine.view(), specular.view()},
                      frame, out.view());
    }
};

void exact_depth_mm(const Image<float>& depth_m, DepthImage& out) {
    const Size size = depth_m.size;
    out.resize(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float mm = depth_m.view().row(y)[x] * 1000;
            out.view().row(y)[x] = mm > 0 && mm < 65535 && inside_hexagon(size, x, y)
                                       ? std::uint16_t(std::lround(mm))
                                       : std::uint16_t(0);
        }
}

FrameMaker::FrameMaker(const LoopOptions& options) {
    if (options.noise)
        sensor_ =
            std::make_unique<Sensor>(loop_calibration(options).depth,
                                     options.scene.seed * 1009 + std::uint32_t(options.camera));
    if (options.color.area() > 0)
        jpeg_ = video::make_color_encoder(video::parse_color_setting("jpeg:quality=90").setting);
}

FrameMaker::~FrameMaker() = default;

EncodedFrame FrameMaker::encode(const GroundTruth& truth, std::uint32_t frame) {
    if (sensor_)
        sensor_->measure(truth, frame, depth_);
    else
        exact_depth_mm(truth.depth_m, depth_);
    EncodedFrame encoded;
    scratch_.resize(codec::rvl::max_encoded_size(depth_.size));
    const std::size_t bytes = codec::rvl::encode(depth_.view(), scratch_);
    encoded.depth.assign(scratch_.begin(), scratch_.begin() + std::ptrdiff_t(bytes));
    if (jpeg_ && !truth.color.empty()) {
        color_.size = truth.color.size;
        color_.pixels.resize(color_.size);
        if (sensor_)
            apply_color_sensor({}, sensor_->seed, frame, truth.color.view(), color_.pixels.view());
        else
            color_.pixels = truth.color;
        const auto jpeg = jpeg_->encode(color_, true);
        if (!jpeg)
            throw Error("A picture of the synthetic room could not be compressed.");
        encoded.color.assign(jpeg->bytes.begin(), jpeg->bytes.end());
    }
    return encoded;
}

}  // namespace theatron::synthetic
