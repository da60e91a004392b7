// SPDX-License-Identifier: Apache-2.0
// The filters of a camera's depth: their order and parameters.
//
// Written as one line, `range:max_mm=3500+holes+kalman`, as the name of a preset, or as a
// small JSON file (docs/filters.md). Lengths are in millimetres, independent of the
// camera's unit. Parsing is safe for any bytes.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace theatron::filter {

// Removes pixels nearer than min_mm or further than max_mm.
struct RangeParams {
    int min_mm = 0;
    int max_mm = 5000;
    bool operator==(const RangeParams&) const = default;
};

// Removes pixels at or behind the recorded empty scene, less a margin that grows with the
// sensor's noise at that distance.
struct BackgroundParams {
    int margin_mm = 25;
    int margin_sigmas = 3;
    bool operator==(const BackgroundParams&) const = default;
};

// Removes pixels that are supported by too few of their eight neighbours.
struct FlyingPixelParams {
    int step_mm = 6;     // a neighbour supports a pixel up to this difference
    int slope_1000 = 8;  // plus this share of the distance
    int min_support = 3;
    bool operator==(const FlyingPixelParams&) const = default;
};

// Removes connected components of at most `max_pixels` pixels.
struct SpeckleParams {
    int max_pixels = 24;
    int step_mm = 12;
    int slope_1000 = 15;
    bool operator==(const SpeckleParams&) const = default;
};

// Fills holes at most `max_size` pixels wide from their rim inwards, one ring of pixels per
// iteration, with the median of the measured neighbours. If these differ by more than the
// step there is an edge, and the hole stays.
struct HoleParams {
    int iterations = 4;
    int max_size = 8;
    int min_neighbours = 3;
    int step_mm = 12;
    int slope_1000 = 15;
    bool operator==(const HoleParams&) const = default;
};

// Averages over time where nothing moves.
struct KalmanParams {
    int gain_1000 = 80;         // of a pixel that has not moved for long
    int reset_sigmas = 5;       // a change beyond this is motion and accepted at once
    int trend_sigmas_100 = 50;  // a lasting change beyond this is slow motion
    int hold_frames = 8;        // longest time for which a flickering pixel keeps its depth
    bool operator==(const KalmanParams&) const = default;
};

// Keeps a measured depth where nothing moves: for sensors that have few distinct depths.
struct SteadyParams {
    int step_mm = 1;        // a change up to this is noise
    int squared_mm = 8;     // plus this times (distance in metres)^2
    int frames = 8;         // a change that lasts is motion after this time
    int together_100 = 80;  // a change of this share of a block's pixels is motion at once
    int hold_frames = 1;    // time for which a pixel without measurement keeps its depth
    bool operator==(const SteadyParams&) const = default;
};

using Step = std::variant<RangeParams, BackgroundParams, FlyingPixelParams, SpeckleParams,
                          HoleParams, KalmanParams, SteadyParams>;

inline constexpr std::size_t max_steps = 16;

// The device on which filters run. All give the same pictures.
enum class Device {
    processor,
    cuda,      // an NVIDIA GPU; the processor where none can be used
    quickest,  // the one that takes less time for the camera's first frame
};

struct ChainSettings {
    std::vector<Step> steps;      // in order; empty: depth is not filtered
    std::string background_file;  // of the filter `background`; the caller reads it
    Device device = Device::processor;

    bool off() const { return steps.empty(); }
    bool needs_background() const;

    // The canonical line for these filters, with all parameters that differ from their
    // defaults, without the background file and the device; empty if off. parse_chain() accepts it.
    std::string spelling() const;

    bool operator==(const ChainSettings&) const = default;
};

// Settings, or one sentence on what is wrong and what would be accepted.
struct ParsedChain {
    ChainSettings settings;
    std::string problem;  // empty: none
};

// Parses a preset's name (`off`, `paper`, `default`, `stereo`) or a line like spelling()'s. Filters
// may follow a preset: `default+background:file=room.background` is the preset with background
// subtraction, which runs first wherever it is written. At the end `@cpu`, `@cuda` or `@auto` may
// choose the device.
ParsedChain parse_chain(std::string_view text);

// Parses the content of a JSON file.
ParsedChain parse_chain_json(std::string_view json);

}  // namespace theatron::filter
