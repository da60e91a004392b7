// SPDX-License-Identifier: Apache-2.0
#include "tracked_face.h"

#include <algorithm>

#include "base/steady_clock.h"
#include "cli/stop_signal.h"

namespace theatron::app {

face::FaceNow TrackedFace::next(TimePoint end) {
    TimePoint now = steady_now();
    do {
        const ByteView packet = socket_.receive(std::max(end - now, Duration::zero()));
        now = steady_now();
        if (!packet.empty() && osc_.take(packet, now))
            input_.put(osc_.mapped(), now);
    } while (now < end && !cli::stop_requested());
    return input_.at(now);
}

}  // namespace theatron::app
