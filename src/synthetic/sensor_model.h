// SPDX-License-Identifier: Apache-2.0
// What an Azure Kinect would have measured: exact depth in, its depth image out.
//
// The sensor flashes infrared light and measures the phase of what comes back.
// Nearly all of its errors follow from how much comes back, so the model first
// computes that amplitude for each pixel and derives from it noise, dropouts and
// what happens where two surfaces share a pixel. docs/synthetic_sensor.md lists
// the parameters with their sources and compares the result with real frames.
//
// The output depends only on parameters, camera seed, frame number and truth:
// the same on every run, and frames may be drawn in any order.
#pragma once

#include <cstdint>
#include <vector>

#include "image/view.h"
#include "synthetic/sensor_random.h"

namespace theatron::synthetic {

// The exact scene as the depth camera sees it. All views have one size.
struct DepthTruth {
    View<const float> depth_m;        // along the optical axis; 0 = nothing there
    View<const float> reflectivity;   // share of infrared light sent back diffusely, 0 to 1
    View<const float> cos_incidence;  // surface normal to line of sight, 0 to 1
    View<const float> specular;       // mirror-like share, 0 to 1; may be empty: none
};

struct DepthSensorParams {
    // Amplitude, in counts of the camera's infrared image, of a white surface
    // one metre in front of the lens. Falls with the distance squared.
    float counts_at_1m = 2000;
    float corner_falloff = 0.6f;  // share of the light missing at half a width from the middle
    float min_counts = 40;        // less is not measured
    float max_counts = 45000;     // more saturates and is not measured
    float counts_jitter = 0.49f;  // noise of these decisions, relative to the limit

    // Variance of one measurement: shot_mm2 / counts + read_mm2 / counts^2.
    float shot_mm2 = 130;
    float read_mm2 = 36000;
    float noise_radius_px = 1.5f;     // the sensor's own smoothing
    float noise_white_share = 0.35f;  // of the variance, without neighbours in common

    // Where two surfaces share a pixel: beyond this error it is declared invalid.
    float max_mixed_mm = 32;
    float mixed_jitter = 0.22f;  // relative noise of that decision
    float blur_next = 0.20f;     // weight of the light from the next pixel
    float blur_second = 0.012f;  // and from the one after

    // Errors that stay the same from frame to frame, drawn from the camera's seed.
    float offset_mm = 2;      // deviation, same for all distances
    float scale = 0.0005f;    // deviation, share of the distance
    float wiggle_mm = 1.5f;   // amplitude of the error that swings with distance
    float field_mm = 1.5f;    // deviation of the slow error over the image
    float fixed_mm = 0.15f;   // deviation of the pattern from pixel to pixel
    float multipath = 0.15f;  // longer by this share of how far a corner lies inside

    bool operator==(const DepthSensorParams&) const = default;
};

// Azure Kinect, narrow field of view: 640x576, the mode of the synthetic cameras.
DepthSensorParams nfov_unbinned();
// The same with 2x2 pixels added up: 320x288, four times the light per pixel.
DepthSensorParams nfov_binned();

// One depth camera. Makes its calibration errors once; capture() draws a frame.
// Used by one thread at a time.
class DepthSensor {
public:
    DepthSensor(const DepthSensorParams& params, Size size, std::uint32_t seed);

    // Writes the depth image of frame `frame` in millimetres. `truth` and `out`
    // have the size of the sensor.
    void capture(const DepthTruth& truth, std::uint32_t frame, MutableDepthView out);

    // The constant error at this distance, before that of the pixel is added.
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
    std::vector<float> distance_error_;  // per centimetre
    NoiseField noise_;

    // Of the frame being drawn.
    std::vector<float> counts_;
    std::vector<float> depth_mm_;               // 0 = nothing there
    std::vector<float> seen_counts_, seen_mm_;  // after light from neighbouring pixels
    std::vector<float> corner_mm_;              // coarse grid of multipath
    std::vector<std::uint8_t> near_edge_;       // one row
};

// Whether this pixel is ever measured: the hexagon of the narrow field of view.
bool inside_mask(Size size, int x, int y);

// Share of the camera's light that falls there: 1 in the middle, less towards the corners.
float illumination_at(const DepthSensorParams& params, Size size, int x, int y);

struct ColorSensorParams {
    float exposure_stops = 0.12f;  // deviation between cameras
    float white_balance = 0.03f;   // deviation of the red and blue gains between cameras
    float noise = 1.6f;            // deviation of a mid-grey pixel, in steps of 255
};

// Gives a noise-free picture the exposure, white balance and noise of one camera.
void apply_color_sensor(const ColorSensorParams& params, std::uint32_t seed, std::uint32_t frame,
                        ColorView picture, MutableColorView out);

}  // namespace theatron::synthetic
