// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "voice/talker.h"

namespace theatron::voice {
namespace {

int level_of(std::span<const float> frame) {
    double sum = 0;
    for (const float v : frame)
        sum += double(v) * double(v);
    const double mean = sum / double(frame.size());
    return int(std::lround(std::clamp(10 * std::log10(std::max(mean, 1e-13)), -127.0, 0.0)));
}

}  // namespace

Talker::Talker(int frame_ms, std::function<void(ByteView)> send)
    : frame_ms_(frame_ms), encoder_(frame_ms), send_(std::move(send)) {}

void Talker::take(std::span<const float> samples, TimePoint end) {
    waiting_.insert(waiting_.end(), samples.begin(), samples.end());
    const std::size_t size = encoder_.frame_samples();
    std::size_t done = 0;
    for (; waiting_.size() - done >= size; done += size) {
        const auto behind = std::int64_t(waiting_.size() - done) * 1'000'000 / sample_rate;
        send_frame(std::span(waiting_).subspan(done, size), end - Duration(behind));
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + std::ptrdiff_t(done));
}

void Talker::send_frame(std::span<const float> frame, TimePoint time) {
    const std::uint32_t number = number_++;
    level_db_ = level_of(frame);
    // A closed microphone ends with a frame of silence: nothing said after closing is sent.
    static const std::vector<float> silence(std::size_t(sample_rate) / 50);
    if (!is_open_)
        frame = std::span(silence).first(frame.size());
    if (!is_open_ && !is_speaking_)
        return;
    const bool is_voice = encoder_.encode(frame, opus_) && is_open_;
    if (!is_voice && !is_speaking_)
        return;
    is_speaking_ = is_voice;
    Packet packet;
    packet.number = number;
    packet.time = time;
    packet.frame_ms = frame_ms_;
    packet.pauses = !is_voice;
    packet.level_db = is_open_ ? level_db_ : -127;
    packet.opus = opus_;
    write_packet(packet, packet_);
    send_(packet_);
}

}  // namespace theatron::voice
