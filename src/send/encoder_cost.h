// SPDX-License-Identifier: Apache-2.0
// Measures the cost of encoding in each setting and chooses the settings that are encoded at once.
//
// All frames pass through the same few threads. One participant's choice must not slow down the
// others: a frame is encoded at once in the cheapest setting and in those that take no more than
// their share. Background threads encode the other settings and skip the pictures for which they
// have no time. Pure; costs are CPU time, which other load on the machine hardly changes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/time.h"

namespace theatron::send {

class EncoderCost {
public:
    explicit EncoderCost(Duration expected = {}) : expected_(expected) {}
    // Adds the cost of one picture.
    void add(Duration cpu);
    // True if enough pictures were measured.
    bool known() const { return pictures_ >= 2; }
    Duration typical() const { return typical_; }
    // Estimate for the next picture: the measured cost if it is known, else the larger one of
    // the expected cost and the first picture's cost.
    Duration likely() const { return known() ? typical_ : std::max(typical_, expected_); }

private:
    std::uint32_t pictures_ = 0;
    Duration typical_{}, expected_{};
};

// Rough CPU time for a picture of 640x576: it orders settings that were never measured.
// `codec` is a depth or colour setting in its canonical spelling.
Duration expected_cost(std::string_view codec);

// CPU time that a setting may take for a picture in addition to the cheapest setting, so that
// SettingTable::max_active more of depth and of colour together take at most three eighths of
// `threads` threads, which `cameras` share.
inline constexpr int share_divisor = 16;
constexpr Duration encoder_share(double frames_per_second, int threads, std::size_t cameras) {
    const double interval_us = 1e6 / (frames_per_second > 1 ? frames_per_second : 1);
    return Duration(std::int64_t(interval_us * threads / double(cameras * share_divisor)));
}

// Writes the settings that are encoded at once into `at_once`: indices of `costs`, cheapest first.
// The one with the lowest likely() cost is always among them, others only once they are known. A
// setting that `was_at_once` stays until it takes more than 1.5 times its share.
void choose_at_once(std::span<const EncoderCost> costs, const std::vector<bool>& was_at_once,
                    Duration share, std::vector<std::size_t>& at_once);

// Tells whether an encoder keeps up with its camera: no longer after it skipped `too_many` of the
// last `window` pictures, again after it skipped none of them.
class KeepingUp {
public:
    static constexpr int window = 32;
    static constexpr int too_many = 16;  // skipped pictures in a window

    // A picture came and was taken or skipped. True if keeps_up() changed.
    bool on_picture(bool taken);
    bool keeps_up() const { return keeps_up_; }

private:
    std::uint32_t left_out_ = 0;  // a bit for each of the last pictures
    bool keeps_up_ = true;
};

}  // namespace theatron::send
