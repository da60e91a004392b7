// SPDX-License-Identifier: Apache-2.0
#include "photon/stages.h"

namespace theatron::photon {
namespace {

struct StageEnd {
    const char* id;
    const char* name;
    TimePoint FrameTimes::*point;
};

constexpr std::array<StageEnd, stage_count> stage_ends = {{
    {"delivered", "camera: from exposure until its driver hands the picture over",
     &FrameTimes::delivered},
    {"filtered", "host: waiting, and filters of depth", &FrameTimes::filtered},
    {"encoded", "host: encoding", &FrameTimes::encoded},
    {"sent", "host: waiting to be sent", &FrameTimes::sent},
    {"received", "network", &FrameTimes::received},
    {"decoded", "participant: waiting, and decoding of depth", &FrameTimes::decoded},
    {"uploaded", "participant: the other images of the moment, and upload to the graphics card",
     &FrameTimes::uploaded},
    {"presented", "participant: drawing", &FrameTimes::presented},
}};

bool is_known(TimePoint point) {
    return point != TimePoint{};
}

}  // namespace

void StageSum::add(const FrameTimes& times) {
    if (!is_known(times.captured) || !is_known(times.presented))
        return;
    ++pictures_;
    TimePoint before = times.captured;
    for (std::size_t i = 0; i < stage_ends.size(); ++i) {
        const TimePoint end = times.*stage_ends[i].point;
        if (!is_known(end))
            continue;
        sum_ms_[i] += to_ms(end - before);
        ++counted_[i];
        before = end;
    }
}

std::vector<Stage> StageSum::means() const {
    std::vector<Stage> result;
    for (std::size_t i = 0; i < stage_ends.size(); ++i)
        if (counted_[i] > 0)
            result.push_back({stage_ends[i].id, stage_ends[i].name, sum_ms_[i] / pictures_});
    return result;
}

}  // namespace theatron::photon
