// SPDX-License-Identifier: Apache-2.0
#include "capture/recorded_room.h"

#include <algorithm>

namespace theatron::capture {

void RecordedRoom::rewind() {
    reader_ = {};
    next_part_ = 0;
    time_ = {};
}

// Far behind, reading begins with the newest snapshot before `time`.
void RecordedRoom::skip_to_snapshot_before(Duration time) {
    const auto& parts = recording_->room().frames;
    const auto later = std::upper_bound(
        parts.begin() + std::ptrdiff_t(next_part_), parts.end(), time,
        [](Duration t, const record::RecordedFrame& part) { return t < part.time(); });
    auto snapshot = std::size_t(later - parts.begin());
    while (snapshot > next_part_ && !parts[snapshot - 1].key)
        --snapshot;
    constexpr std::size_t far = 64;
    if (snapshot < next_part_ + far)
        return;
    next_part_ = snapshot - 1;
    reader_.lose();
}

// Begins the next part. False if it cannot be read.
bool RecordedRoom::begin_part() {
    const record::RecordedFrame& part = recording_->room().frames[next_part_++];
    const bool follows = part.segment == segment_ && part.number == number_ + 1;
    segment_ = part.segment;
    number_ = part.number;
    ++figures_.parts;
    if (!follows)
        reader_.lose();
    Status status = recording_->read_payload(part, payload_);
    if (status == Status::ok) {
        figures_.bytes += payload_.size();
        status = reader_.begin(payload_, TimePoint(part.time()), part.key);
    } else {
        reader_.lose();
    }
    figures_.undecodable += status == Status::missing_reference;
    figures_.damaged += status != Status::ok && status != Status::missing_reference;
    return status == Status::ok;
}

bool RecordedRoom::go_to(Duration time) {
    const auto& parts = recording_->room().frames;
    // The first snapshot comes a little later than the first picture.
    if (!parts.empty())
        time = std::max(time, parts.front().time());
    bool changed = time < time_;
    if (changed)
        rewind();
    time_ = time;
    if (!reader_.next())
        skip_to_snapshot_before(time);
    while (true) {
        while (reader_.next() && *reader_.next() <= TimePoint(time)) {
            changed = true;
            const Status status = reader_.step();
            ++(status == Status::ok ? figures_.changes : figures_.damaged);
        }
        if (reader_.next() || next_part_ == parts.size() || parts[next_part_].time() > time)
            return changed;
        begin_part();
    }
}

std::optional<Duration> RecordedRoom::next() {
    if (const auto at = reader_.next())
        return at->time_since_epoch();
    const auto& parts = recording_->room().frames;
    if (next_part_ == parts.size())
        return std::nullopt;
    return std::max(parts[next_part_].time(), time_);
}

}  // namespace theatron::capture
