// SPDX-License-Identifier: Apache-2.0
#include "send/encoder_cost.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/options.h"

namespace theatron::send {

void EncoderCost::add(Duration cpu) {
    ++pictures_;
    if (pictures_ == 1)
        typical_ = cpu;
    else if (pictures_ <= 4)
        typical_ = std::min(typical_, cpu);  // the first ones also make the encoder's memory
    else
        typical_ += (cpu - typical_) / 8;
}

Duration expected_cost(std::string_view codec) {
    Options options = Options::parse(codec);
    const std::string& kind = options.kind();
    if (kind == "zstd") {
        // About twice as much for every third level.
        const int level = options.take_int("level", 1, -7, 22);
        return Duration(std::int64_t(2000 * std::exp2(std::max(0, level) / 3.0)));
    }
    if (kind == "h264")
        return options.take("preset", "ultrafast") == "ultrafast" ? 6ms : 15ms;
    if (kind == "auto")
        return 5ms;  // it may be either
    if (kind == "raw")
        return 200us;
    return kind == "ans" ? 3ms : 2ms;
}

void choose_at_once(std::span<const EncoderCost> costs, const std::vector<bool>& was_at_once,
                    Duration share, std::vector<std::size_t>& at_once) {
    at_once.resize(costs.size());
    std::iota(at_once.begin(), at_once.end(), std::size_t(0));
    std::sort(at_once.begin(), at_once.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(costs[a].likely(), a) < std::pair(costs[b].likely(), b);
    });
    const auto fits = [&](std::size_t i) {
        return costs[i].known() &&
               costs[i].typical() <= (was_at_once[i] ? share + share / 2 : share);
    };
    if (!at_once.empty())
        at_once.erase(std::remove_if(at_once.begin() + 1, at_once.end(),
                                     [&](std::size_t i) { return !fits(i); }),
                      at_once.end());
}

bool KeepingUp::on_picture(bool taken) {
    left_out_ = left_out_ << 1 | (taken ? 0 : 1);
    const bool now = keeps_up_ ? std::popcount(left_out_) < too_many : left_out_ == 0;
    return std::exchange(keeps_up_, now) != now;
}

}  // namespace theatron::send
