// SPDX-License-Identifier: Apache-2.0
// Which filters run on a camera's depth, in which order, with which parameters.
//
// Written as one line, `range:max_mm=3500+holes+kalman`, as the name of a preset,
// or as a small JSON file (docs/filters.md). Lengths are in millimetres whatever
// the camera's unit. Reading is safe for any bytes.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace theatron::filter {

// Removes what is nearer or further than this.
struct RangeParams {
    int min_mm = 0;
    int max_mm = 5000;
    bool operator==(const RangeParams&) const = default;
};

// Removes what lies at or behind the recorded empty scene, less a margin that
// grows with the sensor's noise at that distance.
struct BackgroundParams {
    int margin_mm = 25;
    int margin_sigmas = 3;
    bool operator==(const BackgroundParams&) const = default;
};

// Removes pixels that too few of their eight neighbours support.
struct FlyingPixelParams {
    int step_mm = 6;     // neighbours this close support a pixel, and
    int slope_1000 = 8;  // this share of the distance more
    int min_support = 3;
    bool operator==(const FlyingPixelParams&) const = default;
};

// Removes connected components of at most so many pixels.
struct SpeckleParams {
    int max_pixels = 24;
    int step_mm = 12;
    int slope_1000 = 15;
    bool operator==(const SpeckleParams&) const = default;
};

// Fills holes, at most so many pixels wide, from their rim inwards, a ring of
// pixels an iteration, with the median of the measured neighbours. Where these
// are further apart than the step there is an edge, and the hole stays.
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
    int gain_1000 = 80;         // of a pixel that has long been still
    int reset_sigmas = 5;       // a change beyond this is motion, at once
    int trend_sigmas_100 = 50;  // a lasting change beyond this is slow motion
    int hold_frames = 8;        // so long a still pixel that comes and goes may be missing
    bool operator==(const KalmanParams&) const = default;
};

using Step = std::variant<RangeParams, BackgroundParams, FlyingPixelParams, SpeckleParams,
                          HoleParams, KalmanParams>;

inline constexpr std::size_t max_steps = 16;

struct ChainSettings {
    std::vector<Step> steps;      // in their order; empty: depth is as the sensor gives it
    std::string background_file;  // of the step `background`; the caller reads it

    bool off() const { return steps.empty(); }
    bool needs_background() const;

    // The one line that names these filters with all that differs from the usual,
    // without the file's name; empty if off. parse_chain() reads it.
    std::string spelling() const;

    bool operator==(const ChainSettings&) const = default;
};

// Settings, or one sentence that says what is wrong and what would be right.
struct ParsedChain {
    ChainSettings settings;
    std::string problem;  // empty: none
};

// A preset's name (`off`, `paper`, `default`) or a line as spelling() gives it. A
// preset may be followed by steps: `default+background:file=room.background` is
// the preset behind background subtraction, wherever it stands.
ParsedChain parse_chain(std::string_view text);

// The content of a JSON file.
ParsedChain parse_chain_json(std::string_view json);

}  // namespace theatron::filter
