// SPDX-License-Identifier: Apache-2.0
#include "bench_case.h"

#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"
#include "viewer/case_actions.h"

namespace theatron::bench {

void open_offered_case(client::Participant& participant) {
    const TimePoint patience = steady_now() + 30s;
    while (participant.cases().empty()) {
        if (steady_now() > patience)
            throw Error("The host offers no case; make one with 'theatron case synth'.");
        std::this_thread::sleep_for(20ms);
    }
    const auto id = to_content_hash(participant.cases().front().hash);
    if (!id || !viewer::open_case(participant, *id, {0, 1.3, 0}, {0, 1.6, 1}))
        throw Error("The case was not opened.");
}

session::ContentFetch::Progress case_progress(const client::Participant& participant) {
    std::uint64_t version = 0;
    const auto open = participant.open_case(version);
    return open ? open->progress : session::ContentFetch::Progress{};
}

}  // namespace theatron::bench
