// SPDX-License-Identifier: Apache-2.0
#include "session/direct_load.h"

#include <algorithm>

namespace theatron::session {

const DirectLoad::Receiver* DirectLoad::find(const Bytes& secret) const {
    const auto found =
        std::find_if(receivers_.begin(), receivers_.end(),
                     [&](const Receiver& receiver) { return receiver.secret == secret; });
    return found == receivers_.end() ? nullptr : &*found;
}

DirectLoad::Receiver& DirectLoad::at(const Bytes& secret) {
    if (const Receiver* known = find(secret))
        return const_cast<Receiver&>(*known);
    receivers_.emplace_back().secret = secret;
    return receivers_.back();
}

bool DirectLoad::may_come(const Bytes& secret, TimePoint now) const {
    const Receiver* receiver = find(secret);
    return !receiver || receiver->bar == Duration(0) || now >= receiver->bar_ends;
}

void DirectLoad::on_come(const Bytes& secret, TimePoint now) {
    Receiver& receiver = at(secret);
    receiver.is_here = true;
    receiver.came = now;
    receiver.losses = 0;
}

void DirectLoad::on_left(const Bytes& secret) {
    at(secret).is_here = false;
}

void DirectLoad::on_loss(const Bytes& secret) {
    ++at(secret).losses;
}

Bytes DirectLoad::send_away(Receiver& receiver, Duration least_bar, TimePoint now) {
    receiver.is_here = false;
    receiver.bar = std::clamp(2 * receiver.bar, least_bar, longest_bar);
    receiver.bar_ends = now + receiver.bar;
    return receiver.secret;
}

std::vector<Bytes> DirectLoad::on_tick(const std::vector<Bytes>& late, TimePoint now) {
    std::vector<Receiver*> slow;
    bool is_too_much = false;
    for (Receiver& receiver : receivers_) {
        if (!receiver.is_here)
            continue;
        receiver.losses *= losses_kept;
        receiver.losses += double(std::count(late.begin(), late.end(), receiver.secret));
        if (now - receiver.came > proven)
            receiver.bar = {};
        is_too_much = is_too_much || receiver.losses > max_losses;
        if (receiver.losses > shared_losses || now - receiver.came < trial)
            slow.push_back(&receiver);
    }
    if (!is_too_much)
        return {};
    Receiver* last = *std::max_element(
        slow.begin(), slow.end(), [](const auto* a, const auto* b) { return a->came < b->came; });
    for (Receiver* receiver : slow)
        receiver->losses = 0;
    return {send_away(*last, slow.size() > 1 ? first_shared_bar : first_bar, now)};
}

void DirectLoad::keep_only(const std::vector<Bytes>& secrets) {
    std::erase_if(receivers_, [&](const Receiver& receiver) {
        return std::find(secrets.begin(), secrets.end(), receiver.secret) == secrets.end();
    });
}

}  // namespace theatron::session
