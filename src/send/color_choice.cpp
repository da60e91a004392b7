// SPDX-License-Identifier: Apache-2.0
#include "send/color_choice.h"

#include <algorithm>
#include <cmath>

#include "send/jpeg_budget.h"

namespace theatron::send {
namespace {

std::string percent(double share) {
    return std::to_string(int(std::lround(100 * share))) + " %";
}

// JPEG, with the bound of its pictures.
std::string jpeg() {
    return "JPEG of at most " + std::to_string(int(JpegBudget::most_mbit)) + " Mbit/s a camera: ";
}

}  // namespace

ColorChoice::ColorChoice(std::string missing)
    : possible_(missing.empty()),
      reason_(jpeg() + (missing.empty() ? "nothing is measured yet" : missing)) {}

bool ColorChoice::observe(const ColorLoad& load, TimePoint now) {
    if (!possible_)
        return false;
    const bool was_h264 = is_h264_;
    if (load.busy <= most_busy || !is_h264_ || !load.in_use)
        last_calm_ = now;
    if (now - window_ > patience || !load.in_use) {
        window_ = now;
        lost_at_window_ = load.lost;
    }
    if (!load.in_use) {
        // Without a receiver a change costs nothing, and it is no trial.
        began_ = now;
        is_h264_ = now >= not_before_ && load.busy + load.h264 <= most_busy - margin;
        reason_ = (is_h264_ ? "H.264: " : jpeg()) + "the processor is " + percent(load.busy) +
                  " busy, H.264 would take " + percent(load.h264);
    } else if (is_h264_) {
        if (load.lost - lost_at_window_ >= most_lost)
            end(now, std::to_string(load.lost - lost_at_window_) +
                         " frames were lost while H.264 was encoded");
        else if (now - last_calm_ >= patience)
            end(now, "the processor was " + percent(load.busy) + " busy with H.264");
        else if (now - began_ >= longest_pause)
            pause_ = first_pause;
    } else if (now >= not_before_ && load.busy + load.h264 <= most_busy - margin) {
        begin(now, load.busy);
    }
    return is_h264_ != was_h264;
}

void ColorChoice::begin(TimePoint now, double busy) {
    is_h264_ = true;
    began_ = now;
    reason_ = "H.264: the processor is " + percent(busy) + " busy";
}

void ColorChoice::end(TimePoint now, const std::string& why) {
    is_h264_ = false;
    not_before_ = now + pause_;
    reason_ = jpeg() + why + "; H.264 is tried again after " +
              std::to_string(int(to_seconds(pause_))) + " s";
    pause_ = std::min(2 * pause_, longest_pause);
}

}  // namespace theatron::send
