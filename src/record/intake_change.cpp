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

// The colour of a depth stream's camera, or the depth of a colour stream's.
StreamId beside(StreamId stream) {
    const CameraId camera = camera_of(stream);
    return is_depth(stream) ? color_stream(camera) : depth_stream(camera);
}

}  // namespace

void Intake::begin_change(Description next, TimePoint now) {
    change_ = Change{std::move(next), {}, 0, {}, now, {}};
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

bool Intake::is_change_over(TimePoint now) const {
    return now - change_->since >= change_patience ||
           change_->held_bytes >= options_.buffer_bytes / held_share ||
           std::none_of(entries_.begin(), entries_.end(),
                        [&](const auto& entry) { return is_awaited(entry.first); });
}

// The cameras or settings change once more. Held frames of streams that have other settings now
// belong to a segment of their own; those of cameras that have left do not.
void Intake::describe_change(Description next) {
    const bool only_left = are_among(next.cameras, change_->next.cameras) &&
                           std::ranges::includes(change_->next.settings, next.settings);
    if (only_left) {
        change_->settings_after = std::move(next.settings);
        return;
    }
    const bool has_others =
        std::any_of(change_->held.begin(), change_->held.end(),
                    [&](const Held& held) { return !is_of(next, held.header); });
    if (has_others)
        end_change(change_->held.back().now);
    if (!change_)
        return;
    change_->next = std::move(next);
    change_->settings_after.reset();
}

void Intake::end_change_in_time(const Now& now) {
    if (change_ && is_change_over(now.local))
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
