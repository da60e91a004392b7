// SPDX-License-Identifier: Apache-2.0
#include "visit/tracked_face.h"

#include <algorithm>

#include "base/steady_clock.h"

namespace theatron::visit {

face::FaceNow TrackedFace::next(TimePoint end) {
    TimePoint now = steady_now();
    do {
        const ByteView packet = socket_.receive(std::max(end - now, Duration::zero()));
        now = steady_now();
        if (!packet.empty() && osc_.take(packet, now))
            input_.put(osc_.mapped(), now);
    } while (now < end);
    return input_.at(now);
}

}  // namespace theatron::visit
