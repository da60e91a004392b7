// SPDX-License-Identifier: Apache-2.0
// The choice between H.264 and JPEG for automatic colour.
//
// H.264 takes a fifth of the bytes and several milliseconds of a core for a picture; a camera's own
// JPEG takes none. So H.264 is sent while the whole machine is less than 70 % busy and no frame is
// lost, else JPEG. Pure; time and measurements are arguments.
#pragma once

#include <cstdint>
#include <string>

#include "base/time.h"

namespace theatron::send {

// A host's measurements, about one a second. Shares are of all cores together, 0 to 1.
struct ColorLoad {
    double busy = 0;         // by all processes
    double h264 = 0;         // measured or expected share of H.264 for all colour that is sent
    bool in_use = false;     // a participant gets automatic colour
    std::uint64_t lost = 0;  // frames that cameras or its encoders left out since the beginning
};

class ColorChoice {
public:
    static constexpr double most_busy = 0.7;
    // H.264 begins only if this much below `most_busy` would be left.
    static constexpr double margin = 0.05;
    // H.264 ends after this time above `most_busy`, or at `most_lost` frames lost within it.
    static constexpr Duration patience = 3s;
    static constexpr std::uint64_t most_lost = 3;
    // Time before H.264 is tried again: twice as long after each failure, up to `longest_pause`. A
    // try that lasts for `longest_pause` resets it to `first_pause`.
    static constexpr Duration first_pause = 30s, longest_pause = 480s;

    // `missing`: one sentence if there is no H.264 encoder, otherwise empty.
    explicit ColorChoice(std::string missing);

    // True if the choice changed.
    bool observe(const ColorLoad& load, TimePoint now);

    bool is_h264() const { return is_h264_; }
    // One sentence for people: the choice and why.
    const std::string& reason() const { return reason_; }

private:
    void begin(TimePoint now, double busy);
    void end(TimePoint now, const std::string& why);

    const bool possible_;
    bool is_h264_ = false;
    std::string reason_;
    TimePoint last_calm_;  // below most_busy
    TimePoint window_;     // of lost frames
    std::uint64_t lost_at_window_ = 0;
    TimePoint began_;       // of H.264 that a participant gets
    TimePoint not_before_;  // H.264 is tried again
    Duration pause_ = first_pause;
};

}  // namespace theatron::send
