// SPDX-License-Identifier: Apache-2.0
// The choice of a page between JPEG and H.264.
//
// JPEG pictures do not need each other, and a page decodes them in any browser. H.264 takes a fifth
// of the bytes, and a browser needs its own time to decode it. So a page asks for JPEG while it
// gets all that it asked for; otherwise it tries H.264, and keeps it if more pictures a second come
// out. Pure; time and measurements are arguments.
//
// It does not leave the choice to the host (video::auto_color), which looks at its own processor
// alone: on a link of 20 Mbit/s that gave half of the pictures (docs/browser.md).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "base/time.h"

namespace theatron::client {

// A page's measurements, several a second.
struct ColorMeasure {
    bool is_thinned = false;         // the host sends less than was asked for
    bool has_h264 = false;           // pictures come as H.264
    double pictures_per_second = 0;  // decoded, of the slowest live camera
    double decode_ms = 0;            // from a picture's arrival to its image, of the slowest camera
    std::uint64_t lost = 0;          // by decoders that took them, since the beginning
};

// Counts how often a decoder fails, whatever number of pictures it loses each time.
class DecoderFailures {
public:
    // A decoder with `most` failures within `window` is given up.
    static constexpr std::size_t most = 3;
    static constexpr Duration window = 30s;

    // `lost` as in ColorMeasure; figures may have been reset.
    bool are_too_many(std::uint64_t lost, TimePoint now);

private:
    std::optional<std::uint64_t> lost_;
    std::deque<TimePoint> failures_;
};

class ColorPreference {
public:
    // Time without all pictures before H.264 is tried, and time of a try until it is judged.
    static constexpr Duration patience = 4s, trial = 6s;
    // H.264 ends if a try gives less than this share of the pictures that came before, ...
    static constexpr double enough = 0.9;
    // ... if its pictures take longer than this for `patience`, or after too many failures.
    static constexpr double slow_decode_ms = 150;
    // Time before H.264 is tried again: twice as long after each end, up to `longest_pause`. H.264
    // that lasts for `longest_pause` resets it to `first_pause`.
    static constexpr Duration first_pause = 30s, longest_pause = 480s;

    explicit ColorPreference(bool can_h264);

    // True if codec() changed. After more than `standstill` without a call the page stood still,
    // as one behind another tab does: it has lost pictures with each codec, and begins to measure
    // anew.
    static constexpr Duration standstill = 1s;
    bool observe(const ColorMeasure& measure, TimePoint now);

    // That the page asks the host for.
    const std::string& codec() const { return codec_; }
    // One sentence for people: the choice and why.
    const std::string& reason() const { return reason_; }

private:
    void begin(const ColorMeasure& measure);
    void end(const std::string& why, TimePoint now);
    void judge(const ColorMeasure& measure, TimePoint now);

    const bool can_h264_;
    std::string codec_, reason_;
    bool asks_h264_ = false, has_tried_ = false;
    std::optional<TimePoint> last_call_;
    std::optional<TimePoint> last_whole_;  // all that was asked for came
    TimePoint not_before_;                 // H.264 is tried again
    Duration pause_ = first_pause;
    // These are of H.264 while it is asked for.
    std::optional<TimePoint> began_;  // its first picture
    TimePoint last_fast_;
    bool is_judged_ = false;
    double pictures_before_ = 0;
    DecoderFailures failures_;
};

}  // namespace theatron::client
