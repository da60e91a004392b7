// SPDX-License-Identifier: Apache-2.0
// A relay's listener and its receivers, over real connections on this machine.
#include "relay/relay_server.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <vector>

#include "base/hex_text.h"
#include "base/steady_clock.h"
#include "client/relay_reception.h"
#include "net/client.h"
#include "net/sealed_media.h"
#include "wire/relay_greeting.h"

namespace theatron::relay {
namespace {

using namespace std::chrono_literals;

constexpr SettingId relayed_setting{3};
constexpr ParticipantId the_relay{8};

Bytes secret_of(int number) {
    return Bytes(wire::relay_secret_size, std::byte(number));
}
const Bytes session_key(net::media_seal_key_size, std::byte{77});

class Relayed : public ::testing::Test {
protected:
    Relayed()
        : server({"127.0.0.1", 0}, {[this](wire::RelayReport report) {
                                        const std::lock_guard lock(mutex);
                                        keys_asked += report.keys.size();
                                        if (!report.links.empty())
                                            links = std::move(report.links);
                                        changed.notify_all();
                                    },
                                    steady_now}),
          reception({[this](std::uint64_t link, Bytes& message) {
                         const std::lock_guard lock(mutex);
                         frames.push_back(wire::parse_media_header(message).value().frame);
                         newest_link = link;
                         size = message.size();
                         changed.notify_all();
                     },
                     [this] {
                         const std::lock_guard lock(mutex);
                         ++ended;
                         changed.notify_all();
                     }}) {}

    template <class Predicate>
    void wait_until(Predicate predicate) {
        std::unique_lock lock(mutex);
        changed.wait(lock, predicate);
    }
    void name(std::vector<int> receivers) {
        std::vector<wire::RelayReceiver> list;
        for (const int number : receivers)
            list.push_back({secret_of(number),
                            {relayed_setting},
                            ParticipantId(std::uint32_t(number)),
                            {std::byte{2}},
                            0});
        server.set_receivers(std::move(list));
    }
    wire::RelayGrant grant(int number) const {
        return {the_relay,         {"127.0.0.1"},
                server.port(),     bytes_of_hex(server.fingerprint()).value(),
                secret_of(number), 1,
                session_key};
    }
    static wire::MediaHeader header_of(FrameNumber frame, bool key) {
        wire::MediaHeader header;
        header.setting = relayed_setting;
        header.frame = frame;
        header.reference = key ? frame : frame - 1;
        header.key = key;
        return header;
    }
    void send(FrameNumber frame, bool key, std::size_t payload = 100) {
        auto message =
            std::make_shared<const Bytes>(sealer.seal(header_of(frame, key), Bytes(payload)));
        server.push(wire::parse_media_header(*message).value(), message);
    }
    // Sends key frames until one has come.
    void wait_for_a_frame(FrameNumber from = 1) {
        const std::size_t before = count();
        for (FrameNumber frame = from; count() == before; ++frame) {
            send(frame, true);
            std::unique_lock lock(mutex);
            changed.wait_for(lock, 20ms, [&] { return frames.size() > before; });
        }
    }
    std::size_t count() {
        const std::lock_guard lock(mutex);
        return frames.size();
    }

    std::mutex mutex;
    std::condition_variable changed;
    std::vector<FrameNumber> frames;
    std::vector<wire::RelayLink> links;
    std::uint64_t newest_link = 0;
    std::size_t size = 0, keys_asked = 0;
    int ended = 0;
    net::MediaSealer sealer{1, session_key};
    RelayServer server;
    client::RelayReception reception;
};

TEST_F(Relayed, ANamedReceiverGetsWhatWasSealedAndItsLinkIsMeasured) {
    name({1});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    wait_until([&] { return !links.empty(); });
    EXPECT_EQ(links.at(0).participant, ParticipantId{1});
    EXPECT_EQ(server.figures().receivers, 1u);
    EXPECT_EQ(size, wire::media_header_size + 100);
}

TEST_F(Relayed, ALatecomerBeginsWithTheChainThatIsHere) {
    name({1});
    send(1, true);
    send(2, false);
    send(3, false);
    reception.set_grants({grant(1)});
    wait_until([&] { return frames.size() == 3; });
    EXPECT_EQ(frames, (std::vector<FrameNumber>{1, 2, 3}));
    EXPECT_EQ(keys_asked, 0u);
}

TEST_F(Relayed, WhoIsNoLongerNamedIsDisconnected) {
    name({1, 2});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    name({2});
    wait_until([&] { return ended > 0; });
    EXPECT_EQ(server.figures().receivers, 0u);
}

TEST_F(Relayed, AStrangerGetsNothing) {
    name({1});
    reception.set_grants({grant(2)});
    wait_until([&] { return ended > 0; });
    EXPECT_EQ(server.figures().receivers, 0u);
    EXPECT_EQ(count(), 0u);
}

TEST_F(Relayed, AnotherCertificateIsNotTrusted) {
    name({1});
    wire::RelayGrant other = grant(1);
    other.fingerprint = Bytes(wire::fingerprint_size);
    reception.set_grants({other});
    wait_until([&] { return ended > 0; });
    EXPECT_EQ(server.figures().receivers, 0u);
}

TEST_F(Relayed, AReceiverThatSaysMoreThanItsGreetingIsDisconnected) {
    name({1});
    net::Client::Handler handler;
    net::Client* running = nullptr;
    handler.connected = [&] {
        running->send_control(wire::encode_relay_greeting(secret_of(1)));
        running->send_control(wire::encode_relay_greeting(secret_of(1)));
    };
    handler.control = [](ByteView) {};
    handler.now = steady_now;
    net::Client client({"127.0.0.1", server.port(), "", server.fingerprint()}, handler);
    running = &client;
    EXPECT_NE(client.run().why, "");
    EXPECT_EQ(server.figures().receivers, 0u);
}

TEST_F(Relayed, AForgedPictureEndsTheConnection) {
    name({1});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    Bytes forged = sealer.seal(header_of(2000, true), Bytes(100));
    forged[wire::media_header_size] ^= std::byte{1};
    server.push(wire::parse_media_header(forged).value(), std::make_shared<const Bytes>(forged));
    wait_until([&] { return ended > 0; });
    EXPECT_NE(frames.back(), 2000u);
}

TEST_F(Relayed, AnOldPictureIsLeftOut) {
    name({1});
    reception.set_grants({grant(1)});
    const auto old = std::make_shared<const Bytes>(sealer.seal(header_of(5000, true), Bytes(100)));
    wait_for_a_frame();
    server.push(wire::parse_media_header(*old).value(), old);
    wait_for_a_frame(6000);
    EXPECT_EQ(std::count(frames.begin(), frames.end(), 5000u), 0);
    EXPECT_EQ(ended, 0);
}

TEST_F(Relayed, AnotherKeyOfTheSessionNeedsNoNewConnection) {
    name({1});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    wire::RelayGrant renewed = grant(1);
    renewed.key_number = 2;
    renewed.key = Bytes(net::media_seal_key_size, std::byte{78});
    reception.set_grants({renewed});
    net::MediaSealer second(2, renewed.key);
    const auto message =
        std::make_shared<const Bytes>(second.seal(header_of(7000, true), Bytes(100)));
    server.push(wire::parse_media_header(*message).value(), message);
    wait_until([&] { return frames.back() == 7000; });
    EXPECT_EQ(ended, 0);
}

TEST_F(Relayed, AReceiverThatCannotFollowCostsTheOthersNothing) {
    name({1, 2});
    reception.set_grants({grant(1)});  // it never says that a frame was taken
    std::vector<FrameNumber> got;
    client::RelayReception* other_ = nullptr;
    client::RelayReception other({[&](std::uint64_t link, Bytes& message) {
                                      const std::size_t taken = message.size();
                                      {
                                          const std::lock_guard lock(mutex);
                                          got.push_back(
                                              wire::parse_media_header(message).value().frame);
                                          changed.notify_all();
                                      }
                                      other_->taken(link, taken);
                                  },
                                  [] {}});
    other_ = &other;
    other.set_grants({grant(2)});
    wait_for_a_frame();
    wait_until([&] { return !got.empty(); });
    for (FrameNumber frame = 10'000; frame < 10'400; ++frame) {
        send(frame, true, 100'000);
        wait_until([&] { return got.back() == frame; });
    }
    EXPECT_GT(server.figures().dropped, 0u);
    other.set_grants({});
}

TEST_F(Relayed, TakenFramesKeepTheWindowOpen) {
    name({1});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    for (FrameNumber frame = 10'000; frame < 10'200; ++frame) {
        const std::size_t before = count();
        send(frame, true, 100'000);
        wait_until([&] { return frames.size() > before; });
        reception.taken(newest_link, size);
    }
    EXPECT_EQ(ended, 0);
}

TEST_F(Relayed, WithdrawnGrantsEndTheConnection) {
    name({1});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    reception.set_grants({});
    EXPECT_GT(ended, 0);
    reception.taken(newest_link, size);
}

}  // namespace
}  // namespace theatron::relay
