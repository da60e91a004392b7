// SPDX-License-Identifier: Apache-2.0
// What encoding costs in each setting, and which settings get a picture at once.
//
// Everybody's frames pass through the same few threads. So that one participant's choice slows
// nobody down, a frame is encoded at once in the cheapest setting and in those that take no more
// than their share; the others follow behind, on other threads, and leave out what they cannot do
// in time. Pure; costs are CPU time, which other load on the machine does not change.
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
    // A picture took so much.
    void add(Duration cpu);
    // Whether enough pictures were measured to tell.
    bool known() const { return pictures_ >= 2; }
    Duration typical() const { return typical_; }
    // What the next picture may take: measured if it is known, else what was expected or, if
    // that is more, what the first picture took.
    Duration likely() const { return known() ? typical_ : std::max(typical_, expected_); }

private:
    std::uint32_t pictures_ = 0;
    Duration typical_{}, expected_{};
};

// CPU time that a picture of 640x576 takes on a usual machine, roughly: it orders settings that
// were never measured. `codec` is a depth or colour setting in its one spelling.
Duration expected_cost(std::string_view codec);

// What a setting may take of a picture's time beside the cheapest one, so that `max_settings` more
// of depth and of colour together take at most three eighths of `threads` threads. `cameras` share
// those.
inline constexpr int share_divisor = 16;
constexpr Duration encoder_share(double frames_per_second, int threads, std::size_t cameras) {
    const double interval_us = 1e6 / (frames_per_second > 1 ? frames_per_second : 1);
    return Duration(std::int64_t(interval_us * threads / double(cameras * share_divisor)));
}

// The settings that get a picture at once, cheapest first, into `at_once` (indices of `costs`).
// The one that is likely the cheapest is always among them, others only once they are known. One
// that `was_at_once` stays until it takes half as much again as its share.
void choose_at_once(std::span<const EncoderCost> costs, const std::vector<bool>& was_at_once,
                    Duration share, std::vector<std::size_t>& at_once);

// Whether an encoder keeps up with its camera: it no longer does when it left out much of the last
// pictures, and does again when it left out none for a while.
class KeepingUp {
public:
    static constexpr int window = 32;
    static constexpr int too_many = 16;  // left out of so many

    // A picture came and was taken or left out. True if the answer changed.
    bool on_picture(bool taken);
    bool keeps_up() const { return keeps_up_; }

private:
    std::uint32_t left_out_ = 0;  // a bit for each of the last pictures
    bool keeps_up_ = true;
};

}  // namespace theatron::send
