// SPDX-License-Identifier: Apache-2.0
#include "voice/playout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "voice/stretch.h"

namespace theatron::voice {
namespace {

// The share of packets that may be later than the playing delay: 1 in 200.
constexpr std::size_t late_share = 200;
// Before this number of packets the delay of the first ones decides too little.
constexpr std::size_t first_judgement = 50;
// Beside the delays that were seen, and beside the blocks in which the sound card takes samples: a
// block is complete when its first sample is taken.
constexpr Duration margin = std::chrono::milliseconds(3);
constexpr double tolerance_us = 4'000;
// A larger error is corrected at any place, a smaller one only where the voice is periodic.
constexpr double urgent_us = 40'000;
constexpr double good_similarity = 0.6;
// An error that would take seconds of stretching is skipped.
constexpr double jump_us = 250'000;
constexpr std::size_t stretch_interval = sample_rate / 25;  // samples between two stretches
// Weight of a new value in the mean delay, per frame of 10 ms: the pulls of a sound card are
// uneven.
constexpr double delay_weight = 0.05;
// Concealment of a frame that may still come; after it comes silence.
constexpr std::size_t longest_concealment = sample_rate / 10;
// A number that differs more belongs to a speaker who began again.
constexpr std::int64_t longest_step = 500;
// After a pause of more frames the delays from before it say nothing: clocks have drifted.
constexpr std::int64_t long_pause = 250;
// Further numbers begin a new stream, so that no product of a number and a time overflows.
constexpr std::int64_t largest_number = std::int64_t(1) << 40;

}  // namespace

void Playout::begin(std::int64_t number) {
    waiting_.clear();
    transits_.clear();
    oldest_transit_ = 0;
    newest_ = next_ = number;
    playing_ = pauses_ = delay_known_ = false;
    owed_ = 0;
}

void Playout::put(const Packet& packet, TimePoint now) {
    std::int64_t number = newest_ + std::int32_t(packet.number - std::uint32_t(newest_));
    const std::int64_t step = number - newest_;
    // A pause may be long: its frames were counted, so the numbers go on with time.
    const bool is_near =
        step > -longest_step && (pauses_ || step < longest_step) && number < largest_number;
    if (frame_ms_ != packet.frame_ms || !is_near) {
        frame_ms_ = packet.frame_ms;
        frame_samples_ = packet.samples();
        number = packet.number;
        begin(number);
    } else if (pauses_ && step > long_pause) {
        begin(number);
    }
    note_delay(number, now);
    newest_ = std::max(newest_, number);
    if (number < next_ && playing_) {
        ++figures_.late;
        return;
    }
    if (!playing_)
        next_ = std::min(next_, number);
    if (waiting_.size() < max_waiting_packets)
        waiting_.try_emplace(number, Waiting{Bytes(packet.opus.begin(), packet.opus.end()),
                                             packet.pauses, packet.level_db});
}

void Playout::note_delay(std::int64_t number, TimePoint now) {
    const std::int64_t transit = to_us(now) - number * frame_time().count();
    if (transits_.size() < remembered_delays) {
        transits_.push_back(transit);
    } else {
        transits_[oldest_transit_] = transit;
        oldest_transit_ = (oldest_transit_ + 1) % remembered_delays;
    }
    std::vector<std::int64_t> sorted = transits_;
    const std::size_t late = sorted.size() / late_share;
    const auto quantile = sorted.end() - 1 - std::ptrdiff_t(late);
    std::nth_element(sorted.begin(), quantile, sorted.end());
    const std::int64_t base = *std::min_element(sorted.begin(), quantile + 1);
    // The mean delay counts from the base.
    delay_us_ += double(base_us_ - base);
    base_us_ = base;
    const Duration seen = Duration(*quantile - base) + block_time_ + margin;
    if (transits_.size() >= first_judgement || seen > target_)
        target_ = std::clamp(seen, margin, longest_delay);
}

void Playout::pull(std::span<float> out, TimePoint now) {
    block_time_ = Duration(std::int64_t(out.size()) * 1'000'000 / sample_rate);
    std::size_t done = 0;
    while (done < out.size()) {
        if (taken_ == ready_.size())
            next_block(now + Duration(std::int64_t(done) * 1'000'000 / sample_rate));
        const std::size_t count = std::min(out.size() - done, ready_.size() - taken_);
        std::copy_n(ready_.begin() + std::ptrdiff_t(taken_), count,
                    out.begin() + std::ptrdiff_t(done));
        taken_ += count;
        done += count;
    }
}

// `now` is the time at which the block's first sample is heard.
void Playout::next_block(TimePoint now) {
    ready_.clear();
    taken_ = 0;
    // Without a frame to play, silence comes in short blocks, so that a first packet begins in
    // time.
    constexpr std::size_t quiet_block = sample_rate / 1000;
    if (frame_ms_ == 0) {
        ready_.assign(quiet_block, 0);
        return;
    }
    const auto delay_now = [&] {
        return double(to_us(now) - next_ * frame_time().count() - base_us_);
    };
    if (!playing_) {
        if (waiting_.empty() || delay_now() < double(target_.count())) {
            ready_.assign(quiet_block, 0);
            return;
        }
        playing_ = true;
        next_ = waiting_.begin()->first;
    }
    if (delay_now() > double(target_.count()) + jump_us)
        skip_to(double(target_.count()), now);
    const double weight = delay_known_ ? delay_weight * double(frame_ms_) / 10 : 1;
    delay_us_ += (delay_now() - delay_us_) * weight;
    delay_known_ = true;

    const bool is_voice = next_frame(ready_);
    const double error = delay_us_ - double(target_.count());
    if (!is_voice) {
        // Nothing can be heard where silence gets shorter or longer.
        if (error < -tolerance_us) {
            ready_.resize(ready_.size() + min_period, 0);
            delay_us_ += min_period * 1e6 / sample_rate;
        } else if (error > tolerance_us && ready_.size() > min_period) {
            ready_.resize(ready_.size() - min_period);
            delay_us_ -= min_period * 1e6 / sample_rate;
        }
        return;
    }
    figures_.samples += ready_.size();
    since_stretch_ += ready_.size();
    if (since_stretch_ >= stretch_interval && std::abs(error) > tolerance_us)
        adjust(ready_, error);
}

// Appends the next frame, or what replaces it. False if it is silence.
bool Playout::next_frame(std::vector<float>& block) {
    while (!waiting_.empty() && waiting_.begin()->first < next_)
        waiting_.erase(waiting_.begin());
    const auto found = waiting_.empty() ? waiting_.end() : waiting_.begin();
    const bool is_here = found != waiting_.end() && found->first == next_;
    if (!is_here && pauses_) {
        ++next_;
        level_db_ = -127;
        block.resize(block.size() + frame_samples_, 0);
        return false;
    }
    if (!is_here && found != waiting_.end()) {
        // A later frame is here: this one is lost. Its time may already have passed.
        if (owed_ >= frame_samples_) {
            owed_ -= frame_samples_;
            ++next_;
            return next_frame(block);
        }
        const std::size_t at = block.size();
        const bool is_next = found->first == next_ + 1;
        ++next_;
        block.resize(at + frame_samples_);
        if (is_next && decoder_.recover(found->second.opus, std::span(block).subspan(at))) {
            figures_.recovered += frame_samples_;
            concealed_run_ = 0;
            return true;
        }
        block.resize(at);
        append_concealed(block);
        return true;
    }
    if (!is_here) {
        // Nothing waits: the frame is late or the link stands still. Its place is kept.
        if (owed_ >= longest_concealment) {
            level_db_ = -127;
            block.resize(block.size() + frame_samples_, 0);
            return false;
        }
        owed_ += frame_samples_;
        append_concealed(block);
        return true;
    }
    const Waiting frame = std::move(found->second);
    waiting_.erase(found);
    ++next_;
    owed_ = 0;
    pauses_ = frame.pauses;
    level_db_ = frame.level_db;
    const std::size_t at = block.size();
    block.resize(at + frame_samples_);
    if (decoder_.decode(frame.opus, std::span(block).subspan(at))) {
        concealed_run_ = 0;
        return true;
    }
    block.resize(at);
    append_concealed(block);
    return true;
}

void Playout::append_concealed(std::vector<float>& block) {
    const std::size_t at = block.size();
    block.resize(at + frame_samples_);
    decoder_.conceal(std::span(block).subspan(at));
    figures_.concealed += frame_samples_;
    concealed_run_ += frame_samples_;
    figures_.longest_concealed = std::max(figures_.longest_concealed, concealed_run_);
}

void Playout::adjust(std::vector<float>& block, double error_us) {
    // A period of a deep voice needs two frames of 10 ms.
    if (block.size() < 2 * max_period && !waiting_.empty() && waiting_.begin()->first == next_) {
        const std::size_t before = block.size();
        (void)next_frame(block);
        figures_.samples += block.size() - before;
    }
    const Period period = find_period(block);
    const double length_us = double(period.samples) * 1e6 / sample_rate;
    if (period.samples == 0 ||
        (period.similarity < good_similarity && std::abs(error_us) < urgent_us) ||
        length_us > std::abs(error_us) + tolerance_us)
        return;
    if (error_us > 0)
        leave_out(block, period.samples);
    else
        repeat(block, period.samples);
    delay_us_ += error_us > 0 ? -length_us : length_us;
    since_stretch_ = 0;
    ++figures_.stretches;
}

// Leaves out frames until the delay is the wanted one; the decoder goes on as after a loss.
void Playout::skip_to(double delay_us, TimePoint now) {
    if (!pauses_ && next_ >= newest_)
        return;
    const double excess = double(to_us(now) - next_ * frame_time().count() - base_us_) - delay_us;
    const auto frames = std::int64_t(excess / double(frame_time().count()));
    next_ = pauses_ ? next_ + frames : std::min(next_ + frames, newest_);
    owed_ = 0;
    delay_known_ = false;
}

}  // namespace theatron::voice
