// SPDX-License-Identifier: Apache-2.0
// Host and viewer joined by a simulated link: outbox, flight, policy and sessions
// as they are in the program, cameras and network made up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/statistics.h"
#include "net/acknowledger.h"
#include "net/outbox.h"
#include "session/host_session.h"
#include "session/viewer_session.h"
#include "simulation/simulated_link.h"
#include "wire/envelope.h"

namespace theatron {
namespace {

using session::HostSession;
using testing::SimulatedLink;

constexpr double mbit = 125'000;
constexpr ParticipantId viewer_id{1};
constexpr Duration step = std::chrono::milliseconds(1);
constexpr Duration frame_period = Duration(33'333);

session::CodecSteps codec_steps() {
    session::CodecSteps steps;
    steps.layered = [](const std::string& depth) {
        return session::CodecSteps::Layered{depth, false, true};
    };
    steps.coarser = [](const std::string&) {
        return std::vector<session::CodecSteps::Coarser>{{"q60", 0.5}, {"q40", 0.4}, {"q20", 0.25}};
    };
    steps.lossy_outside_region = [](const std::string& depth) { return depth + ",loss"; };
    return steps;
}

// One camera in one host, one viewer. Depth takes two thirds of `need`.
class Simulation {
public:
    explicit Simulation(double need, unsigned seed = 1, wire::ChooseDelivery goal = {150, 0})
        : need_(need),
          down(seed),
          up(seed + 100),
          host_(config()),
          viewer_({"secret", "viewer", "depth", "q85", goal}) {
        host_.on_connected(viewer_id, now);
        host_.on_control(viewer_id, viewer_.begin(), now);
    }

    void run(double seconds) {
        const TimePoint end = now + seconds_to_duration(seconds);
        for (; now < end; now += step) {
            if (now >= next_frame_) {
                encode();
                next_frame_ += frame_period;
            }
            if (now >= next_tick_) {
                tick();
                next_tick_ += std::chrono::milliseconds(100);
            }
            carry();
        }
    }

    void draw_region(bool drawn) { host_.on_region(drawn); }
    // True if depth is being encoded with loss outside of the region.
    bool is_lossy() const {
        return std::any_of(host_.depth_settings().begin(), host_.depth_settings().end(),
                           [](const auto& s) { return s.codec.ends_with(",loss"); });
    }

    struct Arrived {
        TimePoint at;
        FrameNumber frame = 0;
        double age_ms = 0;
    };
    std::vector<Arrived> depth;  // decodable frames
    std::vector<std::pair<TimePoint, int>> levels;
    std::set<std::string> codecs;
    std::uint64_t bytes = 0;
    int undecodable = 0;
    TimePoint now = from_us(1'000'000);

    // Ages of depth in a part of the run.
    std::vector<double> ages(TimePoint from, TimePoint to) const {
        std::vector<double> result;
        for (const Arrived& a : depth)
            if (a.at >= from && a.at < to)
                result.push_back(a.age_ms);
        return result;
    }
    double longest_pause_ms(TimePoint from, TimePoint to) const {
        TimePoint last = from;
        Duration longest{};
        for (const Arrived& a : depth)
            if (a.at >= from && a.at < to) {
                longest = std::max(longest, a.at - last);
                last = a.at;
            }
        return to_ms(std::max(longest, to - last));
    }
    int level() const { return levels.empty() ? 0 : levels.back().second; }

private:
    double need_;

public:
    SimulatedLink down, up;

private:
    static HostSession::Config config() {
        wire::Camera camera;
        camera.depth_stream = depth_stream(CameraId{0});
        camera.color_stream = color_stream(CameraId{0});
        camera.has_color = true;
        camera.frames_per_second = 30;
        const auto check = [](const std::string& text) {
            return HostSession::CheckedCodec{text, ""};
        };
        HostSession::Config config;
        config.admission.tokens = {{"secret", session::Role::expert, {}}};
        config.admission.equal_secrets = [](std::string_view a, std::string_view b) {
            return a == b;
        };
        config.cameras = {camera};
        config.check_depth = config.check_color = check;
        config.streams.codecs = codec_steps();
        return config;
    }

    double color_size(const std::string& codec) const {
        for (const auto& coarser : codec_steps().coarser(""))
            if (coarser.codec == codec)
                return coarser.size;
        return 1;
    }

    void encode() {
        // The scene moves in waves.
        const double wave = 1 + 0.1 * std::sin(to_seconds(now.time_since_epoch()));
        const FrameNumber number = next_number_++;
        for (const auto& setting : host_.depth_settings()) {
            const bool key = keys_.erase({depth_stream(CameraId{0}), setting.id}) > 0 ||
                             !since_key_.contains(setting.id);
            std::uint32_t& position = since_key_[setting.id];
            position = key ? 0 : position + 1;
            wire::MediaHeader h;
            h.stream = depth_stream(CameraId{0});
            h.setting = setting.id;
            h.key = key;
            const std::uint32_t in_group = position % 4;
            h.temporal_layer = in_group == 0 ? 0 : in_group == 2 ? 1 : 2;
            h.reference = key             ? number
                          : in_group == 0 ? number - 4
                          : in_group == 2 ? number - 2
                                          : number - 1;
            const double loss = setting.codec.ends_with(",loss") ? 0.6 : 1;
            publish(h, number,
                    need_ / 30 * 0.67 * loss * wave *
                        (key             ? 1.3
                         : in_group == 0 ? 1.1
                                         : 1));
        }
        for (const auto& setting : host_.color_settings()) {
            wire::MediaHeader h;
            h.stream = color_stream(CameraId{0});
            h.setting = setting.id;
            h.key = true;
            h.reference = number;
            codecs.insert(setting.codec);
            publish(h, number, need_ / 30 * 0.33 * wave * color_size(setting.codec));
        }
    }

    void publish(wire::MediaHeader header, FrameNumber number, double size) {
        header.frame = number;
        header.captured = now - std::chrono::milliseconds(10);
        header.payload_size = std::uint32_t(size);
        auto message = std::make_shared<Bytes>(wire::media_header_size + header.payload_size);
        wire::write_media_header(header, message->data());
        for (const ParticipantId id : host_.on_media(header, message->size(), now).receivers) {
            ASSERT_EQ(id, viewer_id);
            const auto pushed =
                outbox_.push_media({message, header.stream, header.setting, number,
                                    header.reference, header.temporal_layer, header.key, now});
            if (pushed.needs_key)
                host_.on_broken_stream(header.stream, header.setting);
        }
    }

    void tick() {
        const auto f = outbox_.take_figures(now);
        host_.on_link(viewer_id,
                      {f.bytes_per_second, f.round_trip, f.delay, f.dropped, f.takes_nothing}, now);
        host_.on_tick(now);
    }

    void carry() {
        namespace action = session::action;
        for (const session::Action& next : host_.take_actions()) {
            if (const auto* send = std::get_if<action::Send>(&next))
                ASSERT_TRUE(outbox_.push_control(wire::wrap_control(wire::encode(send->message))));
            else if (std::holds_alternative<action::KeepEverything>(next))
                outbox_.keep_everything();
            else if (const auto* ceiling = std::get_if<action::SetCeiling>(&next))
                outbox_.set_ceiling(double(ceiling->bytes_per_second));
            else if (const auto* key = std::get_if<action::RequestKey>(&next))
                keys_.insert({key->key.stream, key->key.setting});
        }
        Bytes envelope;
        while (outbox_.next(envelope, now))
            down.send(envelope, now);
        while (down.receive(envelope, now))
            arrive(envelope);
        if (const auto acknowledgement = acknowledger_.due(now)) {
            wire::wrap_acknowledgement(*acknowledgement, envelope);
            up.send(envelope, now);
        }
        wire::Unwrapper host_side(wire::Unwrapper::Takes::all_but_media);
        while (up.receive(envelope, now))
            outbox_.acknowledge(*host_side.take(envelope)->acknowledgement, now);
    }

    void arrive(const Bytes& envelope) {
        const auto got = unwrapper_.take(envelope);
        ASSERT_TRUE(got);
        acknowledger_.came(envelope.size(), got->is_media, now);
        if (!got->control.empty()) {
            if (viewer_.on_control(got->control) == session::ViewerSession::Change::delivery)
                levels.push_back({now, viewer_.delivery().level});
            return;
        }
        bytes += envelope.size();
        if (!got->media)
            return;
        const auto header = wire::parse_media_header(*got->media);
        ASSERT_TRUE(header);
        if (!is_depth(header->stream))
            return;
        if (!header->key && !held_.contains(header->reference)) {
            ++undecodable;
            return;
        }
        if (header->key)
            held_.clear();
        held_.insert(header->frame);
        depth.push_back({now, header->frame, to_ms(now - header->captured)});
    }

    HostSession host_;
    session::ViewerSession viewer_;
    net::Outbox outbox_;
    wire::Unwrapper unwrapper_;
    net::Acknowledger acknowledger_;
    TimePoint next_frame_ = now, next_tick_ = now;
    FrameNumber next_number_ = 0;
    std::map<SettingId, std::uint32_t> since_key_;
    std::set<std::pair<StreamId, SettingId>> keys_;
    std::set<FrameNumber> held_;
};

TEST(AdaptiveSending, AFastLinkGetsEverything) {
    Simulation s(40 * mbit);
    s.down.bytes_per_second = 80 * mbit;
    s.run(20);
    EXPECT_EQ(s.level(), 0);
    EXPECT_GE(s.depth.size(), 595u);
    EXPECT_LT(percentile(s.ages(s.now - 15s, s.now), 1), 80);
}

TEST(AdaptiveSending, AThrottledLinkStaysMovingAndNewAndComesBack) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(seed);
        Simulation s(40 * mbit, seed);
        s.down.bytes_per_second = 80 * mbit;
        s.run(10);
        const TimePoint throttled = s.now;
        s.down.bytes_per_second = 10 * mbit;
        s.run(10);
        const TimePoint back = s.now;
        s.down.bytes_per_second = 80 * mbit;
        s.run(20);
        EXPECT_LE(percentile(s.ages(throttled + 1s, back), 0.95), 250);
        EXPECT_LE(percentile(s.ages(throttled, s.now), 1), 700);
        EXPECT_LE(s.longest_pause_ms(throttled, back), 500);
        EXPECT_LE(percentile(s.ages(back + 3s, s.now), 0.95), 80);
        EXPECT_EQ(s.level(), 0);
        EXPECT_LE(s.levels.size(), 16u);
    }
}

TEST(AdaptiveSending, DoesNotSwingOnALinkThatStaysSlow) {
    for (const double megabits : {9.0, 12.0, 18.0, 28.0}) {
        SCOPED_TRACE(megabits);
        Simulation s(40 * mbit);
        s.down.bytes_per_second = megabits * mbit;
        s.run(20);
        const std::size_t before = s.levels.size();
        s.run(60);
        EXPECT_LE(s.levels.size() - before, 8u);
        EXPECT_LE(percentile(s.ages(s.now - 60s, s.now), 0.95), 260);
        EXPECT_LE(s.longest_pause_ms(s.now - 60s, s.now), 600);
    }
}

TEST(AdaptiveSending, LossesHoldUpButDoNotRuin) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(seed);
        Simulation s(20 * mbit, seed);
        s.down.bytes_per_second = 60 * mbit;
        s.down.loss = 0.002;
        s.run(60);
        EXPECT_LE(percentile(s.ages(s.now - 50s, s.now), 0.95), 250);
        EXPECT_GE(s.depth.size(), 60u * 15);
    }
}

TEST(AdaptiveSending, AShortStallIsNoSlowLink) {
    Simulation s(40 * mbit);
    s.down.bytes_per_second = 80 * mbit;
    for (int i = 0; i < 6; ++i) {
        s.run(3);
        s.down.stall(200ms, s.now);
    }
    EXPECT_TRUE(s.levels.empty());
    EXPECT_GE(s.depth.size(), 500u);
}

// A browser's page that loads on a busy machine takes nothing for tenths of a second, several
// times.
TEST(AdaptiveSending, AReceiverThatIsBusyWhileItLoadsSoonGetsEverything) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(seed);
        Simulation s(30 * mbit, seed);
        s.down.bytes_per_second = 400 * mbit;
        s.down.delay = s.up.delay = 1ms;
        for (int i = 0; i < 5; ++i) {
            s.down.stall(300ms, s.now);
            s.run(0.35);
        }
        const TimePoint loaded = s.now;
        s.run(10);
        EXPECT_EQ(s.level(), 0);
        ASSERT_FALSE(s.levels.empty());
        EXPECT_LT(to_seconds(s.levels.back().first - loaded), 1.5);
    }
}

TEST(AdaptiveSending, KeepsToACeiling) {
    Simulation s(40 * mbit, 1, {150, 15'000});
    s.down.bytes_per_second = 200 * mbit;
    s.run(5);
    const std::uint64_t before = s.bytes;
    s.run(20);
    EXPECT_LE(double(s.bytes - before) / 20, 15 * mbit);
    EXPECT_GE(double(s.bytes - before) / 20, 8 * mbit);
    EXPECT_LE(percentile(s.ages(s.now - 20s, s.now), 0.95), 250);
}

TEST(AdaptiveSending, DepthIsLossyOnlyWhileARegionIsDrawn) {
    Simulation s(40 * mbit);
    s.down.bytes_per_second = 5 * mbit;
    s.run(20);
    const int last = s.level();
    EXPECT_FALSE(s.is_lossy());
    s.draw_region(true);
    s.run(10);
    EXPECT_TRUE(s.is_lossy());
    EXPECT_EQ(s.level(), last + 1);
    s.draw_region(false);
    EXPECT_FALSE(s.is_lossy());
    s.run(1);
    EXPECT_EQ(s.level(), last);
    s.draw_region(true);
    s.down.bytes_per_second = 80 * mbit;
    s.run(20);
    EXPECT_FALSE(s.is_lossy());
    EXPECT_EQ(s.level(), 0);
}

TEST(AdaptiveSending, AViewerThatStopsReadingFindsLittleWhenItWakes) {
    Simulation s(40 * mbit);
    s.down.bytes_per_second = 80 * mbit;
    s.run(5);
    // Answers come late enough to look like a stop; what was sent still arrives.
    s.up.delay = std::chrono::seconds(5);
    const std::uint64_t before = s.bytes;
    s.run(4);
    EXPECT_LE(s.bytes - before, 3u << 20);
}

}  // namespace
}  // namespace theatron
