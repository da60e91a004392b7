// SPDX-License-Identifier: Apache-2.0
#include "session/relay_arrivals.h"

#include <algorithm>

#include "base/frame_order.h"

namespace theatron::session {

bool RelayArrivals::take(const wire::MediaHeader& header, Way way, TimePoint now) {
    const auto known = streams_.find(header.stream);
    if (known == streams_.end() && way == Way::by_host)
        return true;
    Stream& stream = streams_[header.stream];
    if (way == Way::by_relay) {
        stream.relayed = header.setting;
        stream.came_by_relay = now;
    }
    const bool is_first = stream.setting != header.setting || now - stream.taken > memory;
    if (!is_first && frames_after(header.frame, stream.newest) <= 0)
        return false;
    stream.setting = header.setting;
    stream.newest = header.frame;
    stream.taken = now;
    return true;
}

SettingId RelayArrivals::relayed_setting(StreamId stream, Duration period, TimePoint now) const {
    const auto found = streams_.find(stream);
    if (found == streams_.end())
        return {};
    const Duration longest = std::max(patience, patience_in_periods * period);
    return now - found->second.came_by_relay <= longest ? found->second.relayed : SettingId{};
}

void RelayArrivals::end(StreamId stream) {
    if (const auto found = streams_.find(stream); found != streams_.end())
        found->second.relayed = {};
}

}  // namespace theatron::session
