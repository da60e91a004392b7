// SPDX-License-Identifier: Apache-2.0
// A model of the Azure Kinect's depth sensor: exact depth in, its depth image out.
//
// The sensor emits infrared light and measures the phase of the reflected light. Nearly all of
// its errors depend on the amplitude of that light. The model first computes the amplitude of
// each pixel, then derives noise, dropouts, and the result of pixels that see two surfaces.
// docs/synthetic_sensor.md lists the parameters with their sources and compares the result
// with real frames.
//
// The output depends only on parameters, camera seed, frame number and ground truth: every
// run gives equal images, and frames may be computed in any order.
#pragma once

#include <cstdint>
#include <vector>

#include "image/view.h"
#include "synthetic/sensor_random.h"

namespace theatron::synthetic {

// Exact images of the scene for the depth camera. All views have one size.
struct DepthTruth {
    View<const float> depth_m;        // along the optical axis; 0 = no surface
    View<const float> reflectivity;   // share of infrared light reflected diffusely, 0 to 1
    View<const float> cos_incidence;  // cosine of surface normal and line of sight, 0 to 1
    View<const float> specular;       // share reflected specularly, 0 to 1; empty: none
};

struct DepthSensorParams {
    // Amplitude of a white surface one metre in front of the lens, in counts of the camera's
    // infrared image. Falls with the square of the distance.
    float counts_at_1m = 2000;
    float corner_falloff = 0.6f;  // share of the light missing half a width off the centre
    float min_counts = 40;        // pixels below are invalid
    float max_counts = 45000;     // pixels above saturate and are invalid
    float counts_jitter = 0.49f;  // noise of these limits, relative

    // Variance of one measurement: shot_mm2 / counts + read_mm2 / counts^2.
    float shot_mm2 = 130;
    float read_mm2 = 36000;
    float noise_radius_px = 1.5f;     // smoothing by the sensor
    float noise_white_share = 0.35f;  // share of the variance that is independent per pixel

    // Pixels that see two surfaces: invalid if the error exceeds this.
    float max_mixed_mm = 32;
    float mixed_jitter = 0.22f;  // noise of that limit, relative
    float blur_next = 0.20f;     // weight of the light from the next pixel
    float blur_second = 0.012f;  // weight of the light from the one after

    // Errors that are constant over frames, drawn from the camera's seed.
    float offset_mm = 2;      // deviation, same for all distances
    float scale = 0.0005f;    // deviation, share of the distance
    float wiggle_mm = 1.5f;   // amplitude of the error that is periodic in the distance
    float field_mm = 1.5f;    // deviation of the error that varies slowly over the image
    float fixed_mm = 0.15f;   // deviation of the fixed-pattern error per pixel
    float multipath = 0.15f;  // error as a share of the depth of a corner

    bool operator==(const DepthSensorParams&) const = default;
};

// Azure Kinect in its narrow field of view, 640x576: the mode of the synthetic cameras.
DepthSensorParams nfov_unbinned();
// The same with 2x2 binning: 320x288, four times the light per pixel.
DepthSensorParams nfov_binned();

// One depth camera. The constructor draws its calibration errors; capture() computes a frame.
// One thread at a time.
class DepthSensor {
public:
    DepthSensor(const DepthSensorParams& params, Size size, std::uint32_t seed);

    // Writes the depth image of frame `frame` in millimetres. `truth` and `out`
    // have the size of the sensor.
    void capture(const DepthTruth& truth, std::uint32_t frame, MutableDepthView out);

    // The constant error at this distance, without the error of the pixel.
    float distance_error_mm(float depth_mm) const;

private:
    void receive_light(const DepthTruth& truth);
    void add_multipath();
    void mix_at_edges(std::uint32_t frame);
    void mix_pixel(int x, int y, float jitter);
    bool measurable(float counts, float noise) const;

    DepthSensorParams params_;
    Size size_;
    std::uint32_t seed_;
    std::vector<std::uint8_t> mask_;  // 1 inside the hexagon
    std::vector<float> illumination_;
    std::vector<float> pixel_error_mm_;
    std::vector<float> distance_error_;  // one value per centimetre
    NoiseField noise_;

    // State of the current frame.
    std::vector<float> counts_;
    std::vector<float> depth_mm_;               // 0 = no surface
    std::vector<float> seen_counts_, seen_mm_;  // including light of neighbouring pixels
    std::vector<float> corner_mm_;              // multipath on a coarse grid
    std::vector<std::uint8_t> near_edge_;       // of one row
};

// True if this pixel is ever measured: the hexagon of the narrow field of view.
bool inside_mask(Size size, int x, int y);

// Relative illumination of the pixel by the camera: 1 in the middle, less in the corners.
float illumination_at(const DepthSensorParams& params, Size size, int x, int y);

struct ColorSensorParams {
    float exposure_stops = 0.12f;  // deviation between cameras
    float white_balance = 0.03f;   // deviation of the red and blue gains between cameras
    float noise = 1.6f;            // deviation of a mid-grey pixel, in units of 1/255
};

// Applies the exposure, white balance and noise of one camera to a noise-free picture.
void apply_color_sensor(const ColorSensorParams& params, std::uint32_t seed, std::uint32_t frame,
                        ColorView picture, MutableColorView out);

}  // namespace theatron::synthetic
