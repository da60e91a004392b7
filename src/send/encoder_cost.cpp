// SPDX-License-Identifier: Apache-2.0
#include "send/encoder_cost.h"

#include <algorithm>
#include <bit>
#include <utility>

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

void choose_at_once(std::span<const EncoderCost> costs, const std::vector<bool>& was_at_once,
                    Duration share, std::vector<std::size_t>& at_once) {
    at_once.clear();
    if (costs.empty())
        return;
    for (std::size_t i = 0; i < costs.size(); ++i)
        if (costs[i].known())
            at_once.push_back(i);
    std::sort(at_once.begin(), at_once.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(costs[a].typical(), a) < std::pair(costs[b].typical(), b);
    });
    if (at_once.empty()) {
        at_once.push_back(0);
        return;
    }
    const auto fits = [&](std::size_t i) {
        return costs[i].typical() <= (was_at_once[i] ? share + share / 2 : share);
    };
    at_once.erase(
        std::remove_if(at_once.begin() + 1, at_once.end(), [&](std::size_t i) { return !fits(i); }),
        at_once.end());
}

bool KeepingUp::on_picture(bool taken) {
    left_out_ = left_out_ << 1 | (taken ? 0 : 1);
    const bool now = keeps_up_ ? std::popcount(left_out_) < too_many : left_out_ == 0;
    return std::exchange(keeps_up_, now) != now;
}

}  // namespace theatron::send
