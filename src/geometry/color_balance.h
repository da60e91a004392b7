// SPDX-License-Identifier: Apache-2.0
// Cameras differ in exposure and white balance. Where two of them see the same surface, the ratio
// of their colours measures the difference; a common solution gives each camera a gain. Cameras
// whose calibration has gains keep them, and the others follow them.
//
// Works on small copies of a few of the cameras' images, on the CPU, so that it costs some
// milliseconds now and then. One thread at a time.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/ids.h"
#include "geometry/calibration.h"
#include "image/image.h"

namespace theatron {

class ColorBalance {
public:
    // Looks at one image of a camera in this number: two a second.
    static constexpr int usual_images_per_copy = 15;
    explicit ColorBalance(int images_per_copy = usual_images_per_copy)
        : images_per_copy_(unsigned(images_per_copy)) {}

    // Takes a camera's newest images; skips most of them. `color` may be empty, or a scaled picture
    // of the calibrated colour camera.
    void add(CameraId camera, const Calibration& calibration, DepthView depth, ColorView color);
    void remove(CameraId camera) { cameras_.erase(camera); }

    // The gain of a camera as far as no difference to another one determines it, and so also the
    // level of all together: 1 when added. Needs the camera.
    void set_usual_gain(CameraId camera, Vec3 gain);

    // Estimates the gains again if there are enough new samples. True if gains changed.
    bool update();

    // Factors for a camera's sRGB values: x, y, z for red, green, blue. Near 1; they change
    // slowly, except when a camera is first compared with others.
    Vec3 gain(CameraId camera) const;
    // The newest estimate alone; nullopt if the camera was compared with no other in it, and for
    // one whose calibration has gains.
    std::optional<Vec3> newest_gain(CameraId camera) const;

private:
    // A place on a surface as one camera sees it.
    struct Sample {
        Vec3 point_room;
        Vec3 light;  // linear, averaged over the surroundings
    };
    struct Camera {
        Calibration calibration;
        CameraModel color;  // of `light`
        DepthImage depth;   // a subset of columns and rows: one in `depth_step`
        int depth_step = 1;
        Image<Vec3> light;
        std::vector<Sample> samples;
        unsigned uploads = 0;
        bool estimated = false;
        Vec3 log_gain{0, 0, 0};  // linear light
        Vec3 usual_log_gain{0, 0, 0};
        std::optional<Vec3> newest_log_gain;
    };
    // Logarithm of the brightness of `b` relative to `a` in each channel, and its number of places.
    struct Difference {
        Vec3 log_ratio;
        double places = 0;
    };
    bool has_unknown_gains() const;
    static void copy_images(Camera& camera, DepthView depth, ColorView color);
    static std::optional<Vec3> light_at(const Camera& camera, Vec3 point_room);
    Difference compare(const Camera& a, const Camera& b, std::size_t step) const;

    unsigned images_per_copy_;
    std::map<CameraId, Camera> cameras_;
    std::size_t copies_ = 0;  // since the last estimate
};

}  // namespace theatron
