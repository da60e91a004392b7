// SPDX-License-Identifier: Apache-2.0
// A publisher's listener and its receivers, over real connections on this machine.
#include <gtest/gtest.h>

#include <condition_variable>
#include <map>
#include <mutex>

#include "base/hex_text.h"
#include "base/steady_clock.h"
#include "client/direct_reception.h"
#include "client/direct_sender.h"
#include "net/client.h"
#include "wire/direct_greeting.h"

namespace theatron::client {
namespace {

using namespace std::chrono_literals;

constexpr SettingId direct_setting{3};
constexpr ParticipantId direct_publisher{8};

Bytes secret_of(int number) {
    return Bytes(wire::direct_secret_size, std::byte(number));
}

class Direct : public ::testing::Test {
protected:
    Direct()
        : sender(DirectSender::open({[this](StreamId, SettingId) {
                                         const std::lock_guard lock(mutex);
                                         ++keys_asked;
                                         changed.notify_all();
                                     },
                                     steady_now})),
          reception({[this](std::uint64_t link, ParticipantId publisher, Bytes& message) {
                         const std::lock_guard lock(mutex);
                         EXPECT_EQ(publisher, direct_publisher);
                         frames.push_back(wire::parse_media_header(message).value().frame);
                         newest_link = link;
                         size = message.size();
                         changed.notify_all();
                     },
                     [this](ParticipantId) {
                         const std::lock_guard lock(mutex);
                         ++ended;
                         changed.notify_all();
                     }}) {}

    template <class Predicate>
    void wait_until(Predicate predicate) {
        std::unique_lock lock(mutex);
        changed.wait(lock, predicate);
    }
    wire::DirectGrant grant(int number) const {
        const wire::OfferDirect offer = sender->offer();
        return {direct_publisher, {"127.0.0.1"}, offer.port, offer.fingerprint, secret_of(number)};
    }
    void send(FrameNumber frame, bool key, std::size_t payload = 100) {
        wire::MediaHeader header;
        header.setting = direct_setting;
        header.frame = frame;
        header.reference = key ? frame : frame - 1;
        header.key = key;
        header.payload_size = std::uint32_t(payload);
        auto message = std::make_shared<Bytes>(wire::media_header_size + payload);
        wire::write_media_header(header, message->data());
        sender->send(header, {message,
                              StreamId(std::uint16_t(header.setting)),
                              header.setting,
                              header.frame,
                              header.reference,
                              0,
                              key,
                              {}});
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
    std::uint64_t newest_link = 0;
    std::size_t size = 0;
    int keys_asked = 0, ended = 0;
    std::unique_ptr<DirectSender> sender;
    DirectReception reception;
};

TEST_F(Direct, AGrantedReceiverGetsFramesFromAKeyFrameOn) {
    sender->set_receivers({{secret_of(1), {direct_setting}}});
    reception.set_grants({grant(1)});
    // Frames that refer to others ask for a key frame as soon as somebody is connected.
    FrameNumber frame = 1;
    for (bool asked = false; !asked; ++frame) {
        send(frame, false);
        std::unique_lock lock(mutex);
        asked = changed.wait_for(lock, 20ms, [&] { return keys_asked > 0; });
    }
    EXPECT_EQ(count(), 0u);
    send(frame, true);
    send(frame + 1, false);
    wait_until([&] { return frames.size() == 2; });
    EXPECT_EQ(frames, (std::vector{frame, frame + 1}));
    EXPECT_EQ(sender->receivers(), 1u);
}

TEST_F(Direct, WhoIsNoLongerNamedIsDisconnected) {
    sender->set_receivers({{secret_of(1), {direct_setting}}, {secret_of(2), {direct_setting}}});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    sender->set_receivers({{secret_of(2), {direct_setting}}});
    wait_until([&] { return ended > 0; });
    EXPECT_EQ(sender->receivers(), 0u);
}

TEST_F(Direct, AStrangerGetsNothing) {
    sender->set_receivers({{secret_of(1), {direct_setting}}});
    wire::DirectGrant forged = grant(2);
    reception.set_grants({forged});
    wait_until([&] { return ended > 0; });
    EXPECT_EQ(sender->receivers(), 0u);
    EXPECT_EQ(count(), 0u);
}

TEST_F(Direct, AnotherCertificateIsNotTrusted) {
    sender->set_receivers({{secret_of(1), {direct_setting}}});
    wire::DirectGrant other = grant(1);
    other.fingerprint = Bytes(wire::fingerprint_size);
    reception.set_grants({other});
    wait_until([&] { return ended > 0; });
    EXPECT_EQ(sender->receivers(), 0u);
}

TEST_F(Direct, AReceiverThatSaysMoreThanItsGreetingIsDisconnected) {
    sender->set_receivers({{secret_of(1), {direct_setting}}});
    const wire::OfferDirect offer = sender->offer();
    net::Client::Handler handler;
    net::Client* running = nullptr;
    handler.connected = [&] {
        running->send_control(wire::encode_direct_greeting(secret_of(1)));
        running->send_control(wire::encode_direct_greeting(secret_of(1)));
    };
    handler.control = [](ByteView) {};
    handler.now = steady_now;
    net::Client client({"127.0.0.1", offer.port, "", hex_text(offer.fingerprint)}, handler);
    running = &client;
    EXPECT_NE(client.run().why, "");
    EXPECT_EQ(sender->receivers(), 0u);
}

TEST_F(Direct, AReceiverThatCannotFollowIsLeftToTheHost) {
    sender->set_receivers({{secret_of(1), {direct_setting}}});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    // It acknowledges nothing, so the window fills and frames are dropped.
    for (FrameNumber frame = 1000; true; ++frame) {
        send(frame, true, 100'000);
        std::unique_lock lock(mutex);
        if (changed.wait_for(lock, 5ms, [&] { return ended > 0; }))
            break;
        ASSERT_LT(frame, 5000u);
    }
}

TEST_F(Direct, TakenFramesKeepTheWindowOpen) {
    sender->set_receivers({{secret_of(1), {direct_setting}}});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    for (FrameNumber frame = 1000; frame < 1200; ++frame) {
        const std::size_t before = count();
        send(frame, true, 100'000);
        wait_until([&] { return frames.size() > before; });
        reception.taken(newest_link, size);
    }
    EXPECT_EQ(ended, 0);
}

TEST_F(Direct, WithdrawnGrantsEndTheConnection) {
    sender->set_receivers({{secret_of(1), {direct_setting}}});
    reception.set_grants({grant(1)});
    wait_for_a_frame();
    reception.set_grants({});
    EXPECT_GT(ended, 0);
    reception.taken(newest_link, size);
}

}  // namespace
}  // namespace theatron::client
