// SPDX-License-Identifier: Apache-2.0
// States and voice beside more media than a link carries: how long they wait behind it, and how
// much media they displace. Outbox, flight and acknowledgements are those of the program, the link
// is simulated.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/statistics.h"
#include "net/acknowledger.h"
#include "net/outbox.h"
#include "simulation/simulated_link.h"
#include "wire/envelope.h"

namespace theatron {
namespace {

constexpr double mbit = 125'000;
constexpr Duration step = Duration(250);
constexpr double measured_s = 10;

struct Waits {
    std::vector<double> state_ms, voice_ms;  // beyond the link's own delay
    double media_share = 0;                  // of the bytes that the link carries
};

// Twice as much media as the link carries, after the link has been learned.
Waits wait_behind_media(double rate, Duration delay) {
    net::Outbox outbox;
    net::Acknowledger acknowledger;
    wire::Unwrapper viewer, host(wire::Unwrapper::Takes::all_but_media);
    testing::SimulatedLink down(1), up(2);
    down.bytes_per_second = rate;
    down.delay = up.delay = delay;
    up.bytes_per_second = 1e9;
    Waits waits;
    std::uint64_t media_bytes = 0;
    TimePoint now = from_us(1'000'000), next_frame = now, next_pose = now, next_voice = now;
    const TimePoint begin = now + 5s, end = begin + seconds_to_duration(measured_s);
    FrameNumber frame = 0;
    Bytes envelope;
    const auto stamp = [&] {
        Bytes bytes(40);
        store_le(bytes.data(), to_us(now));
        return bytes;
    };
    const auto waited = [&](ByteView stamped) {
        return to_ms(now - from_us(load_le<std::int64_t>(stamped.data())) - delay);
    };
    for (; now < end; now += step) {
        if (now >= next_frame) {
            next_frame += Duration(33'333);
            ++frame;
            for (const int stream : {0, 1, 2, 3}) {
                wire::MediaHeader header;
                header.payload_size = std::uint32_t(2 * rate / 30 / 4);
                auto bytes = std::make_shared<Bytes>(wire::media_header_size + header.payload_size);
                wire::write_media_header(header, bytes->data());
                (void)outbox.push_media({bytes, StreamId(stream), {}, frame, frame, 0, true, now});
            }
        }
        if (now >= next_pose) {
            next_pose += Duration(11'111);
            outbox.put_state({{wire::StateTopic::pose, 1}, stamp()});
        }
        if (now >= next_voice) {
            next_voice += 20ms;
            outbox.push_voice({ParticipantId{1}, stamp()});
        }
        while (up.receive(envelope, now))
            outbox.acknowledge(*host.take(envelope)->acknowledgement, now);
        while (outbox.next(envelope, now))
            down.send(envelope, now);
        while (down.receive(envelope, now)) {
            const auto got = viewer.take(envelope);
            if (!got) {
                ADD_FAILURE() << to_text(got.error());
                return waits;
            }
            acknowledger.came(envelope.size(), got->is_media, now);
            if (now < begin)
                continue;
            media_bytes += got->is_media ? envelope.size() : 0;
            wire::StateReader states(got->states);
            for (wire::State state; states.next(state);)
                waits.state_ms.push_back(waited(state.body));
            if (got->voice)
                waits.voice_ms.push_back(waited(got->voice->packet));
        }
        if (const auto acknowledgement = acknowledger.due(now)) {
            wire::wrap_acknowledgement(*acknowledgement, envelope);
            up.send(envelope, now);
        }
    }
    waits.media_share = double(media_bytes) / measured_s / rate;
    return waits;
}

TEST(Interaction, WaitsLittleBehindMedia) {
    struct Case {
        double megabits, most_ms;
    };
    for (const auto& [megabits, most_ms] : {Case{10, 45}, Case{50, 15}})
        for (const Duration delay : {Duration(1ms), Duration(10ms), Duration(40ms)}) {
            SCOPED_TRACE(std::to_string(megabits) + " Mbit/s, " + std::to_string(to_ms(delay)) +
                         " ms");
            const Waits waits = wait_behind_media(megabits * mbit, delay);
            ASSERT_GT(waits.state_ms.size(), 850u);
            ASSERT_GT(waits.voice_ms.size(), 480u);
            EXPECT_LE(percentile(waits.state_ms, 0.99), most_ms);
            EXPECT_LE(percentile(waits.voice_ms, 0.99), most_ms);
            EXPECT_GE(waits.media_share, 0.9);
        }
}

// A fast link whose receiver stalls once: media bytes per second afterwards.
double bytes_per_second_after_a_stall(Duration stall) {
    net::Outbox outbox;
    net::Acknowledger acknowledger;
    wire::Unwrapper viewer, host(wire::Unwrapper::Takes::all_but_media);
    testing::SimulatedLink down(1), up(2);
    down.bytes_per_second = up.bytes_per_second = 1e9;
    down.delay = up.delay = Duration(50);
    const TimePoint begin = from_us(1'000'000), stalls = begin + 2s, goes_on = stalls + stall;
    const TimePoint end = goes_on + 2s;
    TimePoint next_frame = begin;
    std::uint64_t media_bytes = 0;
    FrameNumber frame = 0;
    Bytes envelope;
    for (TimePoint now = begin; now < end; now += Duration(100)) {
        const bool is_behind = now > stalls;
        if (now >= next_frame) {
            next_frame += is_behind ? Duration(1000) : Duration(33'333);
            ++frame;
            for (const int stream : {0, 1}) {
                wire::MediaHeader header;
                header.payload_size = 100'000;
                auto bytes = std::make_shared<Bytes>(wire::media_header_size + header.payload_size);
                wire::write_media_header(header, bytes->data());
                (void)outbox.push_media({bytes, StreamId(stream), {}, frame, frame, 0, true, now});
            }
        }
        while (up.receive(envelope, now))
            outbox.acknowledge(*host.take(envelope)->acknowledgement, now);
        while (outbox.next(envelope, now))
            down.send(envelope, now);
        if (now > stalls && now < goes_on)
            continue;
        while (down.receive(envelope, now)) {
            const auto got = viewer.take(envelope);
            acknowledger.came(envelope.size(), got->is_media, now);
            media_bytes += now > goes_on ? envelope.size() : 0;
        }
        if (const auto acknowledgement = acknowledger.due(now)) {
            wire::wrap_acknowledgement(*acknowledgement, envelope);
            up.send(envelope, now);
        }
    }
    return double(media_bytes) / 2;
}

TEST(Interaction, MediaIsFastAgainSoonAfterAReceiverStoodStill) {
    for (const Duration stall : {Duration(500ms), Duration(4s)})
        EXPECT_GT(bytes_per_second_after_a_stall(stall), 50e6);
}

}  // namespace
}  // namespace theatron
