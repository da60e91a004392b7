// SPDX-License-Identifier: Apache-2.0
// A session of many in made-up time: publishers with cameras join and leave at random, viewers
// with different codecs watch, links have delay and losses. No camera that stays loses a frame or
// gets it late because of another.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "geometry/calibration.h"
#include "session/host_session.h"
#include "session/viewer_session.h"
#include "simulation/simulated_link.h"

namespace theatron {
namespace {

using session::HostSession;
using session::ViewerSession;
using testing::SimulatedLink;

constexpr Duration step = std::chrono::milliseconds(5);
constexpr Duration frame_period = std::chrono::milliseconds(35);
constexpr std::size_t picture_bytes = 200;

Bytes calibration() {
    Calibration c;
    c.depth.size = c.color.size = {64, 48};
    c.depth.fx = c.depth.fy = c.color.fx = c.color.fy = 60;
    return encode_calibration(c);
}

HostSession::Config config() {
    HostSession::Config config;
    config.admission.tokens = {{"watch", session::Role::expert, {}},
                               {"publish", session::Role::publisher, {}}};
    config.admission.equal_secrets = [](std::string_view a, std::string_view b) { return a == b; };
    config.check_depth = config.check_color = [](const std::string& text) {
        return HostSession::CheckedCodec{text, ""};
    };
    config.streams.usual = {"strata", "jpeg"};
    return config;
}

// Messages, each with its kind in front, over links of both directions.
struct Peer {
    Peer(ParticipantId number, ViewerSession::Wishes wishes)
        : id(number),
          viewer(std::move(wishes)),
          up(2 * unsigned(number)),
          down(2 * unsigned(number) + 1) {
        for (SimulatedLink* link : {&up, &down}) {
            link->bytes_per_second = 50e6;
            link->delay = std::chrono::milliseconds(15);
        }
    }
    static Bytes tagged(bool media, ByteView message) {
        Bytes result{std::byte(media)};
        result.insert(result.end(), message.begin(), message.end());
        return result;
    }
    ParticipantId id;
    ViewerSession viewer;
    SimulatedLink up, down;
};

struct Publisher : Peer {
    using Peer::Peer;
    struct Stream {
        FrameNumber next = 0;
        bool key = true;
    };
    // By stream and setting: what the host wants encoded.
    std::map<std::pair<StreamId, SettingId>, Stream> encoders;
    std::set<CameraId> cameras;
    bool asked = false;  // an offer is not answered yet
};

struct Viewer : Peer {
    using Peer::Peer;
    struct Stream {
        SettingId setting{};
        FrameNumber newest = 0;
        bool begun = false;
    };
    std::map<StreamId, Stream> streams;
    std::uint64_t frames = 0, lost = 0, undecodable = 0, foreign = 0;
    Duration oldest{};
    std::map<ParticipantId, Duration> oldest_of;  // by publisher
};

class Simulation {
public:
    explicit Simulation(unsigned seed) : random_(seed), host_(config()) {
        const char* const codecs[] = {"strata", "zstd", "rvl"};
        for (int i = 0; i < 3; ++i) {
            viewers.push_back(std::make_unique<Viewer>(new_id(), wishes("watch", codecs[i])));
            connect(*viewers.back());
        }
    }

    void run(Duration length) {
        const TimePoint end = now + length;
        for (; now < end; now += step) {
            if (now >= next_event_) {
                change();
                next_event_ = now + std::chrono::milliseconds(200 + random_() % 1800);
            }
            if (now >= next_frame_) {
                for (const auto& publisher : publishers)
                    encode(*publisher);
                next_frame_ += frame_period;
            }
            if (now >= next_tick_) {
                host_.on_tick(now);
                next_tick_ += std::chrono::milliseconds(100);
            }
            carry();
        }
    }

    std::vector<std::unique_ptr<Viewer>> viewers;
    std::vector<std::unique_ptr<Publisher>> publishers;
    TimePoint now = from_us(1'000'000);
    int came = 0, left = 0;
    std::size_t most_cameras = 0;
    const HostSession& host() const { return host_; }
    void join(Peer& peer) { connect(peer); }

private:
    static ViewerSession::Wishes wishes(const char* token, const char* depth) {
        ViewerSession::Wishes wishes;
        wishes.token = token;
        wishes.depth_codec = depth;
        wishes.color_codec = "jpeg";
        wishes.features = {wire::Feature::publish};
        return wishes;
    }
    ParticipantId new_id() { return ParticipantId(++last_id_); }
    void connect(Peer& peer) {
        host_.on_connected(peer.id, now);
        peer.up.send(Peer::tagged(false, peer.viewer.begin()), now);
    }

    // One publisher more or less, or one camera, about eight and sixteen in the middle.
    void change() {
        const auto choice = random_() % 6;
        if (choice == 0 && publishers.size() < 8) {
            publishers.push_back(
                std::make_unique<Publisher>(new_id(), wishes("publish", "strata")));
            connect(*publishers.back());
            ++came;
        } else if (choice == 1 && publishers.size() > 4) {
            const auto at = publishers.begin() + std::ptrdiff_t(random_() % publishers.size());
            host_.on_closed((*at)->id);
            publishers.erase(at);
            ++left;
        } else if (!publishers.empty()) {
            Publisher& publisher = *publishers[random_() % publishers.size()];
            if (choice < 5 && !publisher.asked && publisher.viewer.joined() &&
                host_.streams().cameras().size() < 16) {
                publisher.asked = true;
                publisher.up.send(
                    Peer::tagged(
                        false, wire::encode(wire::Publish{{{"camera", true, 10, calibration()}}})),
                    now);
                ++came;
            } else if (choice == 5 && publisher.cameras.size() > 1) {
                const CameraId camera = *publisher.cameras.begin();
                publisher.cameras.erase(camera);
                std::erase_if(publisher.encoders, [&](const auto& entry) {
                    return camera_of(entry.first.first) == camera;
                });
                publisher.up.send(Peer::tagged(false, wire::encode(wire::Unpublish{{camera}})),
                                  now);
                ++left;
            }
        }
        most_cameras = std::max(most_cameras, host_.streams().cameras().size());
    }

    // Each encoder refers to its own frame before.
    void encode(Publisher& publisher) {
        for (auto& [which, stream] : publisher.encoders) {
            wire::MediaHeader h;
            h.stream = which.first;
            h.setting = which.second;
            h.frame = stream.next++;
            h.key = std::exchange(stream.key, false);
            h.reference = h.key ? h.frame : h.frame - 1;
            h.captured = h.moment = now;
            h.payload_size = picture_bytes;
            Bytes message(wire::media_header_size + picture_bytes);
            wire::write_media_header(h, message.data());
            publisher.up.send(Peer::tagged(true, message), now);
        }
    }

    void carry() {
        Bytes message;
        const auto from = [&](Peer& peer) {
            while (peer.up.receive(message, now)) {
                const ByteView content = ByteView(message).subspan(1);
                if (message[0] == std::byte{0}) {
                    host_.on_control(peer.id, content, now);
                } else {
                    for (const ParticipantId receiver :
                         host_.on_media_from(peer.id, content, now).receivers)
                        find(receiver)->down.send(message, now);
                }
                obey();
            }
        };
        for (const auto& publisher : publishers)
            from(*publisher);
        for (const auto& viewer : viewers)
            from(*viewer);
        obey();
        for (const auto& publisher : publishers)
            while (publisher->down.receive(message, now))
                hear(*publisher, ByteView(message).subspan(1));
        for (const auto& viewer : viewers)
            while (viewer->down.receive(message, now)) {
                const ByteView content = ByteView(message).subspan(1);
                if (message[0] == std::byte{0})
                    hear(*viewer, content);
                else
                    see(*viewer, content);
            }
    }

    Peer* find(ParticipantId id) {
        for (const auto& viewer : viewers)
            if (viewer->id == id)
                return viewer.get();
        for (const auto& publisher : publishers)
            if (publisher->id == id)
                return publisher.get();
        return nullptr;
    }

    void obey() {
        for (const session::Action& next : host_.take_actions()) {
            if (const auto* send = std::get_if<session::action::Send>(&next)) {
                if (Peer* peer = find(send->participant))
                    peer->down.send(Peer::tagged(false, wire::encode(send->message)), now);
            } else if (const auto* close = std::get_if<session::action::Close>(&next)) {
                ADD_FAILURE() << close->why;
            }
        }
    }

    void hear(Publisher& publisher, ByteView message) {
        using Change = ViewerSession::Change;
        switch (publisher.viewer.on_control(message)) {
            case Change::published:
                publisher.asked = false;
                for (const CameraId camera : publisher.viewer.published().cameras)
                    publisher.cameras.insert(camera);
                break;
            case Change::encode: {
                std::map<std::pair<StreamId, SettingId>, Publisher::Stream> encoders;
                for (const auto& s : publisher.viewer.encode().settings)
                    if (publisher.cameras.contains(camera_of(s.stream)))
                        encoders[{s.stream, s.setting}] = publisher.encoders[{s.stream, s.setting}];
                publisher.encoders = std::move(encoders);
                break;
            }
            case Change::encode_key: {
                const auto& key = publisher.viewer.encode_key();
                const auto found = publisher.encoders.find({key.stream, key.setting});
                if (found != publisher.encoders.end())
                    found->second.key = true;
                break;
            }
            default:
                break;
        }
    }

    void hear(Viewer& viewer, ByteView message) {
        using Change = ViewerSession::Change;
        const Change change = viewer.viewer.on_control(message);
        if (change == Change::settings)
            for (const auto& s : viewer.viewer.settings())
                viewer.streams[s.stream].setting = s.setting;
        if (change == Change::cameras)
            std::erase_if(viewer.streams, [&](const auto& entry) {
                const auto& cameras = viewer.viewer.cameras();
                return std::none_of(cameras.begin(), cameras.end(), [&](const wire::Camera& c) {
                    return c.id == camera_of(entry.first);
                });
            });
    }

    void see(Viewer& viewer, ByteView message) {
        const auto header = wire::parse_media_header(message);
        const auto found = viewer.streams.find(header->stream);
        if (found == viewer.streams.end() || found->second.setting != header->setting) {
            ++viewer.foreign;
            return;
        }
        Viewer::Stream& stream = found->second;
        viewer.oldest = std::max(viewer.oldest, now - header->captured);
        for (const wire::Camera& camera : viewer.viewer.cameras())
            if (camera.id == camera_of(header->stream)) {
                Duration& oldest = viewer.oldest_of[camera.publisher];
                oldest = std::max(oldest, now - header->captured);
            }
        ++viewer.frames;
        if (stream.begun && header->frame != stream.newest + 1)
            ++viewer.lost;
        if (!header->key && (!stream.begun || header->reference != stream.newest))
            ++viewer.undecodable;
        stream.begun = true;
        stream.newest = header->frame;
    }

    std::mt19937 random_;
    HostSession host_;
    std::uint32_t last_id_ = 0;
    TimePoint next_event_ = now, next_frame_ = now, next_tick_ = now;
};

TEST(SessionOfMany, NoFrameOfACameraThatStaysIsLostOrLateBecauseOfAnother) {
    Simulation s(1);
    s.run(std::chrono::minutes(10));
    EXPECT_EQ(s.most_cameras, 16u);
    EXPECT_GE(s.came, 100);
    EXPECT_GE(s.left, 60);
    for (const auto& viewer : s.viewers) {
        EXPECT_GE(viewer->frames, 300'000u);
        EXPECT_EQ(viewer->lost, 0u);
        EXPECT_EQ(viewer->undecodable, 0u);
        EXPECT_EQ(viewer->foreign, 0u) << "in the order of the settings";
        EXPECT_LE(to_ms(viewer->oldest), 2 * 15 + 100);
        EXPECT_LE(viewer->viewer.settings().size(), 2 * s.host().streams().cameras().size())
            << "nothing is kept of cameras that left";
    }
}

// Losses of one publisher's link hold up its own cameras alone.
TEST(SessionOfMany, ASlowPublisherMakesNobodyElseLate) {
    Simulation s(2);
    s.run(std::chrono::seconds(60));
    const auto slow = s.publishers.front()->id;
    for (const auto& publisher : s.publishers)
        if (publisher->id == slow)
            publisher->up.loss = 0.2;
    s.run(std::chrono::seconds(60));
    for (const auto& viewer : s.viewers) {
        EXPECT_EQ(viewer->lost, 0u) << "late, but whole";
        EXPECT_GT(viewer->oldest_of.size(), 3u);
        for (const auto& [publisher, oldest] : viewer->oldest_of) {
            if (publisher == slow)
                EXPECT_GT(to_ms(oldest), 2 * 15 + 20);
            else
                EXPECT_LE(to_ms(oldest), 2 * 15 + 20) << int(publisher);
        }
    }
}

TEST(SessionOfMany, AViewerThatJoinsLateSeesEveryCamera) {
    Simulation s(3);
    s.run(std::chrono::seconds(120));
    s.viewers.push_back(std::make_unique<Viewer>(ParticipantId{5000}, [] {
        ViewerSession::Wishes wishes;
        wishes.token = "watch";
        wishes.depth_codec = "lz4";  // a place is not free; the nearest is given
        wishes.color_codec = "jpeg";
        return wishes;
    }()));
    Viewer& late = *s.viewers.back();
    s.join(late);
    s.run(std::chrono::seconds(30));
    EXPECT_TRUE(late.viewer.joined());
    EXPECT_EQ(late.viewer.cameras().size(), s.host().streams().cameras().size());
    EXPECT_EQ(late.lost, 0u);
    std::set<CameraId> seen;
    for (const auto& [stream, state] : late.streams)
        if (state.begun)
            seen.insert(camera_of(stream));
    EXPECT_GE(seen.size() + 1, s.host().streams().cameras().size()) << "one may have come just now";
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(s.viewers[i]->lost, 0u) << "the others noticed nothing";
}

}  // namespace
}  // namespace theatron
