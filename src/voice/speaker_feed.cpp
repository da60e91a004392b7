// SPDX-License-Identifier: Apache-2.0
#include "voice/speaker_feed.h"

#include <algorithm>
#include <utility>

namespace theatron::voice {
namespace {

// Calls of a device that the rendering thread has not seen yet; it learns only what further ones
// took.
constexpr std::size_t most_calls = 64;

}  // namespace

SpeakerFeed::SpeakerFeed(int channels)
    : channels_(std::size_t(channels)),
      ready_(most_blocks * largest_block * channels_),
      asked_(most_calls) {
    block_.reserve(largest_block * channels_);
}

void SpeakerFeed::play(std::span<float> out, TimePoint now) noexcept {
    const std::size_t count = ready_.take(out);
    std::fill(out.begin() + std::ptrdiff_t(count), out.end(), 0.0f);
    played_ += count;
    if (count < out.size() && has_rendered_)
        missing_ += (out.size() - count) / channels_;
    const Asked asked{now, out.size() / channels_, played_};
    (void)asked_.put({&asked, 1});
}

TimePoint SpeakerFeed::fill(const Now& now, const Render& render) {
    for (Asked asked{}; asked_.take({&asked, 1}) == 1;) {
        if (asked.samples > 0)
            pace_.note(std::min(asked.samples, largest_block), asked.at);
        taken_ = asked.taken;
    }
    if (!pace_.is_known())
        return TimePoint::max();
    const TimePoint begin = now();
    const std::size_t most = most_blocks * pace_.block();
    const std::size_t wanted = std::min(pace_.asked_until(begin + lead_), most);
    std::size_t ready = std::size_t(rendered_ - taken_) / channels_;
    while (ready < wanted) {
        const std::size_t count = std::min(wanted - ready, pace_.block());
        block_.resize(count * channels_);
        render(block_, pace_.time_of(ready) - lead_ + least_lead);
        rendered_ += ready_.put(block_);
        has_rendered_ = true;
        ready += count;
    }
    const TimePoint end = now();
    if (begin >= planned_)
        note_delay(end - planned_);
    planned_ = ready < most ? std::max(pace_.time_of(ready) - lead_, end) : TimePoint::max();
    return planned_;
}

void SpeakerFeed::note_delay(Duration delay) {
    newest_delay_ = std::max(newest_delay_, delay);
    lead_ = std::clamp(std::max(newest_delay_, older_delay_) + lead_margin, least_lead, most_lead);
    if (++delays_ < remembered_delays / 2)
        return;
    delays_ = 0;
    older_delay_ = std::exchange(newest_delay_, Duration{});
}

}  // namespace theatron::voice
