// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <thread>

#include "base/error.h"
#include "base/fault.h"
#include "base/hex_text.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "client/direct_sender.h"
#include "net/certificate.h"
#include "net/own_addresses.h"
#include "net/server.h"
#include "session/direct_load.h"
#include "session/key_gate.h"
#include "wire/direct_greeting.h"

namespace theatron::client {
namespace {

using Receivers = std::map<Bytes, std::set<SettingId>>;  // by their secrets

std::string_view text_of(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Compares with all, so that the time that it takes says nothing about any of them.
const Receivers::value_type* find(const Receivers& receivers, ByteView greeting) {
    const auto secret = wire::read_direct_greeting(greeting);
    const Receivers::value_type* found = nullptr;
    for (const auto& receiver : receivers)
        if (secret && net::equal_secrets(text_of(receiver.first), text_of(*secret)))
            found = &receiver;
    return found;
}

// A frame is late if it takes this much longer than the link's delay.
constexpr Duration late = std::chrono::milliseconds(100);

net::HttpAnswer nothing_here() {
    return {.status = 404, .body = "Nothing is shown here.\n"};
}

}  // namespace

struct DirectSender::Impl {
    explicit Impl(Events given)
        : events(std::move(given)),
          certificate(net::make_certificate()),
          server({"0.0.0.0", 0}, certificate, handler()),
          thread([this] {
              name_this_thread("direct");
              (void)contain("direct", [this] { server.run(); });
          }) {}
    ~Impl() {
        server.stop();
        thread.join();
    }

    struct Peer {
        Bytes secret;
        std::set<SettingId> settings;
        session::KeyGate gate;
    };

    net::Server::Handler handler() {
        net::Server::Handler h;
        h.invited = [this](ByteView first) {
            const std::lock_guard lock(mutex);
            return find(allowed, first) != nullptr;
        };
        h.http = [](const net::HttpRequest&) { return nothing_here(); };
        h.connected = [this](net::PeerId peer, const std::string&, bool is_invited) {
            if (!is_invited)
                server.close(peer, "it was not granted");
        };
        h.control = [this](net::PeerId peer, ByteView message) { greet(peer, message); };
        h.closed = [this](net::PeerId peer, const std::string&) { forget(peer); };
        h.now = events.now;
        h.tick = [this] { look_for_losses(); };
        return h;
    }

    void greet(net::PeerId peer, ByteView message) {
        Peer greeted;
        {
            const std::lock_guard lock(mutex);
            const auto* receiver = find(allowed, message);
            if (!receiver || peers.contains(peer)) {
                forget(peer);
                return server.close(peer, "it sent something else than one greeting");
            }
            greeted.secret = receiver->first;
            greeted.settings = receiver->second;
        }
        if (!load.may_come(greeted.secret, events.now()))
            return server.close(peer, "its link was too slow for direct pictures");
        // The receiver has come again, before its last connection was seen to be gone.
        close_if([&](const Peer& other) { return other.secret == greeted.secret; },
                 "the receiver has connected again");
        load.on_come(greeted.secret, events.now());
        peers[peer] = std::move(greeted);
        connected = peers.size();
        log::info("direct", "receiver connected", {{"receivers", peers.size()}});
    }

    void close_if(const auto& is_meant, const char* why) {
        std::vector<net::PeerId> gone;
        for (const auto& [peer, state] : peers)
            if (is_meant(state))
                gone.push_back(peer);
        for (const net::PeerId peer : gone) {
            forget(peer);
            server.close(peer, why);
        }
    }

    void forget(net::PeerId peer) {
        if (const auto found = peers.find(peer); found != peers.end())
            load.on_left(found->second.secret);
        peers.erase(peer);
        connected = peers.size();
    }

    void follow_receivers() {
        const std::lock_guard lock(mutex);
        close_if([&](const Peer& peer) { return !allowed.contains(peer.secret); },
                 "it is no longer granted");
        std::vector<Bytes> granted;
        for (const auto& [secret, settings] : allowed)
            granted.push_back(secret);
        load.keep_only(granted);
        for (auto& [peer, state] : peers)
            state.settings = allowed.at(state.secret);
    }

    // A late frame counts as a loss, too: the host would send fewer, but new ones.
    void look_for_losses() {
        std::vector<Bytes> behind;
        for (const auto& [peer, state] : peers) {
            const net::SendingFigures figures = server.take_figures(peer);
            if (figures.delay > figures.round_trip + late)
                behind.push_back(state.secret);
        }
        for (const Bytes& secret : load.on_tick(behind, events.now())) {
            close_if([&](const Peer& peer) { return peer.secret == secret; },
                     "its link is too slow for direct pictures");
            log::info("direct", "receiver is left to the host, frames came too late",
                      {{"receivers", peers.size()}});
        }
    }

    void push(const wire::MediaHeader& header, const net::Media& media) {
        if (has_lost.exchange(false))
            for (auto& [peer, state] : peers)
                state.gate = {};
        for (auto& [peer, state] : peers) {
            if (!state.settings.contains(header.setting))
                continue;
            if (!state.gate.passes(header)) {
                events.needs_key(header.stream, header.setting);
                continue;
            }
            const auto pushed = server.send_media(peer, media);
            if (pushed.dropped > 0)
                load.on_loss(state.secret);
            if (pushed.needs_key) {
                state.gate.interrupt(header.setting);
                events.needs_key(header.stream, header.setting);
            }
        }
    }

    const Events events;
    const net::Certificate certificate;
    std::mutex mutex;
    Receivers allowed;  // guarded by mutex
    std::atomic<std::size_t> connected = 0, waiting = 0;
    std::atomic<bool> has_lost = false;  // frames, before the next one
    std::map<net::PeerId, Peer> peers;   // the listener's thread, as is the next
    session::DirectLoad load;
    net::Server server;
    std::thread thread;
};

std::unique_ptr<DirectSender> DirectSender::open(Events events) {
    return std::unique_ptr<DirectSender>(
        new DirectSender(std::make_unique<Impl>(std::move(events))));
}

DirectSender::DirectSender(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DirectSender::~DirectSender() = default;

wire::OfferDirect DirectSender::offer() const {
    return {net::own_addresses(wire::max_direct_addresses), impl_->server.port(),
            bytes_of_hex(impl_->certificate.fingerprint).value_or(Bytes())};
}

void DirectSender::set_receivers(const std::vector<wire::DirectReceiver>& receivers) {
    Receivers allowed;
    for (const wire::DirectReceiver& receiver : receivers)
        allowed[receiver.secret] = {receiver.settings.begin(), receiver.settings.end()};
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->allowed = std::move(allowed);
    }
    impl_->server.post([impl = impl_.get()] { impl->follow_receivers(); });
}

void DirectSender::send(const wire::MediaHeader& header, const net::Media& media) {
    if (impl_->connected == 0)
        return;
    if (impl_->waiting >= max_frames_waiting) {
        impl_->has_lost = true;
        return;
    }
    ++impl_->waiting;
    impl_->server.post([impl = impl_.get(), header, media] {
        --impl->waiting;
        impl->push(header, media);
    });
}

std::size_t DirectSender::receivers() const {
    return impl_->connected;
}

}  // namespace theatron::client
