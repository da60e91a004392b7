// SPDX-License-Identifier: Apache-2.0
// The change from one segment to the next without a lost frame: see Intake::describe().
#include <algorithm>
#include <cassert>
#include <utility>

#include "base/time_between.h"
#include "record/intake.h"

namespace theatron::record {
namespace {

// An older picture is a stale camera's, and says nothing on when a segment begins.
constexpr Duration oldest_held = std::chrono::seconds(3);

// A longer time between two looks at the clock is one in which the recorder itself stood still.
constexpr Duration longest_step = std::chrono::milliseconds(500);

// The colour of a depth stream's camera, or the depth of a colour stream's.
StreamId beside(StreamId stream) {
    const CameraId camera = camera_of(stream);
    return is_depth(stream) ? color_stream(camera) : depth_stream(camera);
}

}  // namespace

void Intake::begin_change(Description next, TimePoint now) {
    change_ = Change{std::move(next), {}, 0, {}, Duration(0), now, {}};
    for (auto& [id, entry] : entries_)
        if (is_awaited(id))
            entry.gate.want_key();
}

// True if frames of this stream still go into the segment before, until its next key frame.
bool Intake::is_awaited(StreamId stream) const {
    const auto entry = entries_.find(stream);
    if (entry == entries_.end() || change_->changed.contains(stream))
        return false;
    const auto before = current_.settings.find(stream);
    const auto after = change_->next.settings.find(stream);
    return before != current_.settings.end() && after != change_->next.settings.end() &&
           before->second == after->second && !entry->second.ended && !entry->second.silent &&
           entry->second.gate.is_open();
}

// A stream whose frames are all key frames changes together with the one beside it, so that depth
// and colour of a frame are in the same segment.
bool Intake::belongs_to_next(const Entry& entry, const wire::MediaHeader& header) {
    if (!is_of(change_->next, header))
        return false;
    if (change_->changed.contains(header.stream))
        return true;
    const auto other = entries_.find(beside(header.stream));
    const bool waits = is_of(current_, header) && !entry.gate.has_references() &&
                       other != entries_.end() && other->second.gate.has_references() &&
                       is_awaited(other->first);
    if (!header.key || waits)
        return false;
    change_->changed.insert(header.stream);
    return true;
}

bool Intake::is_change_over() const {
    return change_->waited >= change_patience ||
           change_->held_bytes >= options_.buffer_bytes / held_share ||
           std::none_of(entries_.begin(), entries_.end(),
                        [&](const auto& entry) { return is_awaited(entry.first); });
}

// The cameras or settings change once more. A camera that has left stays in the segment to come if
// frames of it are held. Held frames in settings that are no more belong to a segment of their own.
void Intake::describe_change(Description next) {
    Description with_left = next;
    for (const RecordedCamera& camera : change_->next.cameras) {
        const bool is_there = std::ranges::any_of(
            next.cameras, [&](const RecordedCamera& other) { return other.id == camera.id; });
        bool has_held = false;
        for (const StreamId stream : {depth_stream(camera.id), color_stream(camera.id)})
            if (!is_there && change_->changed.contains(stream)) {
                with_left.settings[stream] = change_->next.settings.at(stream);
                has_held = true;
            }
        if (has_held)
            with_left.cameras.push_back(camera);
    }
    const bool has_others = std::ranges::any_of(
        change_->held, [&](const Held& held) { return !is_of(with_left, held.header); });
    // Without cameras the room begins a segment.
    if (has_others || next.cameras.empty()) {
        end_change(change_->held.back().now);
        return;
    }
    change_->next = std::move(with_left);
    change_->settings_after = std::move(next.settings);
}

void Intake::end_change_in_time(const Now& now) {
    if (!change_)
        return;
    // A recorder that stood still takes what waits for it first.
    change_->waited += std::clamp(now.local - change_->seen, Duration(0), longest_step);
    change_->seen = now.local;
    if (is_change_over())
        end_change(now);
}

void Intake::end_change(Now now) {
    Change change = *std::exchange(change_, std::nullopt);
    assert(!change.held.empty());
    std::optional<TimePoint> first;
    TimePoint last{};
    for (const Held& held : change.held) {
        const TimePoint captured = held.header.captured;
        last = std::max(last, captured);
        // A stale camera's last picture is sent anew with its old time.
        if (time_between(captured, held.now.clock.session) < oldest_held)
            first = std::min(first.value_or(captured), captured);
    }
    if (!begin(std::move(change.next), first.value_or(change.held.front().header.captured), now,
               last))
        return;
    for (Held& held : change.held) {
        Entry& entry = entries_.at(held.header.stream);
        if (put(entry, held.header, std::move(held.message), held.filters, held.now))
            entry.gate.want_key();
    }
    if (change.settings_after)
        current_.settings = std::move(*change.settings_after);
}

void Intake::take_held() {
    const std::lock_guard lock(mutex_);
    if (change_)
        end_change(change_->held.back().now);
}

}  // namespace theatron::record
