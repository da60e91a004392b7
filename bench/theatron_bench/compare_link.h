// SPDX-License-Identifier: Apache-2.0
// The pictures of cameras over a link, in made-up time: how many arrive, and how old they are.
#pragma once

#include <cstddef>
#include <vector>

namespace theatron::bench {

struct CompareLink {
    double mbit = 20, latency_ms = 20;  // one way
};

// All cameras' pictures of one moment. Times are those of the slowest camera: each camera has a
// core of its own on both sides.
struct SentMoment {
    std::size_t bytes = 0;  // of all cameras together
    double sender_ms = 0, receiver_ms = 0;
};

struct LinkFigures {
    CompareLink link;
    double pictures_per_s = 0;              // at the receiver
    double delay_ms = 0, delay_p95_ms = 0;  // from capture until decoded: mean, 95th percentile
};

// Sends ten seconds of moments, `moments` again and again; the first one, which no other precedes,
// is sent once. A moment is left out, before it is encoded, while the sender or the link is busy
// with an older one, and after it has arrived, while the receiver is. There is at least one.
LinkFigures sent_over(const CompareLink& link, const std::vector<SentMoment>& moments,
                      double moments_per_s);

}  // namespace theatron::bench
