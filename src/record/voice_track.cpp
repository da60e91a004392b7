// SPDX-License-Identifier: Apache-2.0
#include "record/voice_track.h"

#include <algorithm>
#include <array>

#include "base/time_between.h"

namespace theatron::record {
namespace {

// Silence in CELT mode, full band, one channel (RFC 6716, 3.1): frames of 10 and 20 ms, and six of
// 20 ms in one packet.
template <class... Values>
constexpr std::array<std::byte, sizeof...(Values)> bytes(Values... values) {
    return {std::byte(values)...};
}
constexpr auto silent_10_ms = bytes(0xf0, 0xff, 0xfe);
constexpr auto silent_20_ms = bytes(0xf8, 0xff, 0xfe);
constexpr auto silent_120_ms =
    bytes(0xfb, 0x06, 0xff, 0xfe, 0xff, 0xfe, 0xff, 0xfe, 0xff, 0xfe, 0xff, 0xfe, 0xff, 0xfe);
struct Silence {
    std::int64_t steps;
    ByteView opus;
};
constexpr std::int64_t longest_silence = 12;  // steps
const std::array<Silence, 3> silences{
    Silence{longest_silence, silent_120_ms}, {2, silent_20_ms}, {1, silent_10_ms}};

// A speaker may claim any time; the sequence grows by no more than this at once.
constexpr Duration most_at_once = std::chrono::minutes(10);

// Packets that overtake each other are fewer than this.
constexpr std::int64_t most_overtaken = 100;

// Rounded to the nearest step.
std::int64_t steps_of(Duration time) {
    return (time.count() + (time.count() < 0 ? -1 : 1) * voice_step.count() / 2) /
           voice_step.count();
}

}  // namespace

void VoiceSequence::silence(std::int64_t steps, const Write& write) {
    for (const Silence& one : silences)
        for (; steps >= one.steps; steps -= one.steps) {
            write({voice_step * next_, true, -127, one.opus});
            next_ += one.steps;
        }
}

void VoiceSequence::put(const VoicePacket& packet, const Write& write) {
    const std::int64_t length = packet.frame_ms / 10;
    std::int64_t lost =
        speaks_ && newest_ ? std::int64_t(std::int32_t(packet.number - *newest_ - 1)) : 0;
    // Numbers that begin anew, as after a change of the microphone.
    if (lost < -most_overtaken || lost * length > most_at_once / voice_step)
        lost = 0;
    const Duration error = time_between(begin_, packet.time) - voice_step * (next_ + length * lost);
    if (lost < 0 || error > most_at_once) {
        ++figures_.left_out;
        return;
    }
    newest_ = packet.number;
    // Its place is silence already, or the speaker's clock is too fast.
    if (error < -max_voice_error) {
        ++figures_.left_out;
        return;
    }
    figures_.missing += std::uint64_t(lost);
    silence(lost * length, write);
    // In speech, small differences are jitter of the speaker's clock; behind silence nobody hears
    // that the place is the right one again.
    if (!speaks_ || error > max_voice_error)
        silence(std::max<std::int64_t>(steps_of(error), 0), write);
    write({voice_step * next_, false, packet.level_db, packet.opus});
    next_ += length;
    ++figures_.packets;
    speaks_ = !packet.pauses;
}

void VoiceSequence::fill(TimePoint until, const Write& write) {
    const Duration gap = time_between(begin_, until) - voice_step * next_;
    const auto blocks = std::min(gap, most_at_once) / (voice_step * longest_silence);
    if (blocks <= 0)
        return;
    speaks_ = false;
    silence(blocks * longest_silence, write);
}

}  // namespace theatron::record
