// SPDX-License-Identifier: Apache-2.0
#include "relay/relay_server.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <mutex>
#include <string_view>
#include <thread>

#include "base/fault.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "net/certificate.h"
#include "net/server.h"
#include "relay/fan_out.h"
#include "wire/relay_greeting.h"

namespace theatron::relay {
namespace {

using Receivers = std::map<Bytes, wire::RelayReceiver>;  // by their secrets

std::string_view text_of(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Compares with all, so that the time that it takes says nothing about any of them.
const wire::RelayReceiver* find(const Receivers& receivers, ByteView greeting) {
    const auto secret = wire::read_relay_greeting(greeting);
    const wire::RelayReceiver* found = nullptr;
    for (const auto& [known, receiver] : receivers)
        if (secret && net::equal_secrets(text_of(known), text_of(*secret)))
            found = &receiver;
    return found;
}

net::HttpAnswer nothing_here() {
    return {.status = 404,
            .body =
                "This is a relay of Theatron, which shows nothing itself: open the link of the "
                "host.\n"};
}

std::uint32_t kbit_per_s(double bytes_per_second) {
    return std::uint32_t(std::clamp(bytes_per_second / 125, 0.0, 4e9));
}

}  // namespace

struct RelayServer::Impl {
    Impl(const net::Endpoint& endpoint, Events given)
        : events(std::move(given)),
          certificate(net::make_certificate()),
          fan_out(
              {[this](ParticipantId id, net::Media media) { return send(id, std::move(media)); },
               [this](ParticipantId id, StreamId stream) {
                   return server.is_behind(connections.at(id), stream);
               }}),
          server(endpoint, certificate, handler()),
          thread([this] {
              name_this_thread("relay");
              (void)contain("relay", [this] { server.run(); });
          }) {}
    ~Impl() {
        server.stop();
        thread.join();
    }

    net::Server::Handler handler() {
        net::Server::Handler h;
        h.invited = [this](ByteView first) {
            const std::lock_guard lock(mutex);
            return find(named, first) != nullptr;
        };
        h.http = [](const net::HttpRequest&) { return nothing_here(); };
        h.connected = [this](net::PeerId peer, const std::string&, bool is_invited) {
            if (is_invited)
                return;
            ++strangers;
            server.close(peer, "the host has not named it");
        };
        h.control = [this](net::PeerId peer, ByteView message) { greet(peer, message); };
        h.frame_left = [this](net::PeerId peer) {
            if (const auto found = people.find(peer); found != people.end())
                fan_out.on_left(found->second);
        };
        h.closed = [this](net::PeerId peer, const std::string& why) { forget(peer, why); };
        h.now = events.now;
        h.tick = [this] { report(); };
        return h;
    }

    void greet(net::PeerId peer, ByteView message) {
        wire::RelayReceiver receiver;
        {
            const std::lock_guard lock(mutex);
            const auto* known = find(named, message);
            if (!known || people.contains(peer)) {
                forget(peer, "");
                return server.close(peer, "it sent something else than one greeting");
            }
            receiver = *known;
        }
        // It has come again, before its last connection was seen to be gone.
        if (const auto before = connections.find(receiver.participant); before != connections.end())
            end(before->second, "it has connected again");
        people[peer] = receiver.participant;
        connections[receiver.participant] = peer;
        connected = people.size();
        server.set_ceiling(peer, receiver.max_kbit_per_s * 125.0);
        log::info("relay", "receiver connected",
                  {{"participant", int(receiver.participant)}, {"receivers", people.size()}});
        fan_out.come(receiver.participant, steady_now());
    }

    void end(net::PeerId peer, const std::string& why) {
        forget(peer, why);
        server.close(peer, why);
    }

    void forget(net::PeerId peer, const std::string& why) {
        const auto found = people.find(peer);
        if (found == people.end())
            return;
        const ParticipantId id = found->second;
        people.erase(found);
        connections.erase(id);
        fan_out.leave(id);
        connected = people.size();
        log::info(
            "relay", "receiver left",
            {{"participant", int(id)}, log::outside("why", why), {"receivers", people.size()}});
    }

    void follow_receivers() {
        std::map<ParticipantId, std::uint32_t> ceilings;
        FanOut::Wishes wishes;
        {
            const std::lock_guard lock(mutex);
            for (const auto& [secret, receiver] : named) {
                ceilings[receiver.participant] = receiver.max_kbit_per_s;
                std::map<SettingId, int>& settings = wishes[receiver.participant];
                for (std::size_t i = 0; i < receiver.settings.size(); ++i)
                    settings[receiver.settings[i]] =
                        i < receiver.layers.size() ? int(receiver.layers[i]) : 0;
            }
        }
        std::vector<net::PeerId> gone;
        for (const auto& [peer, id] : people)
            if (!ceilings.contains(id))
                gone.push_back(peer);
            else
                server.set_ceiling(peer, ceilings[id] * 125.0);
        for (const net::PeerId peer : gone)
            end(peer, "the host no longer names it");
        fan_out.set_wishes(std::move(wishes), steady_now());
        ask_for_keys();
    }

    net::Outbox::Pushed send(ParticipantId id, net::Media media) {
        bytes_out += media.bytes->size();
        const auto pushed = server.send_media(connections.at(id), std::move(media));
        dropped += std::uint64_t(pushed.dropped);
        return pushed;
    }

    void push(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message) {
        if (has_lost.exchange(false))
            fan_out.on_lost();
        fan_out.on_media(header, std::move(message), steady_now());
        cached = fan_out.cached_bytes();
        ask_for_keys();
    }

    void ask_for_keys() {
        wire::RelayReport report;
        for (const auto& key : fan_out.take_keys(steady_now()))
            if (report.keys.size() < wire::max_encodings)
                report.keys.push_back({key.stream, key.setting});
        if (report.keys.empty())
            return;
        keys_asked += report.keys.size();
        events.report(std::move(report));
    }

    void report() {
        ask_for_keys();
        wire::RelayReport report;
        for (const auto& [peer, id] : people) {
            const net::SendingFigures figures = server.take_figures(peer);
            report.links.push_back({id, kbit_per_s(figures.bytes_per_second), figures.round_trip,
                                    std::max(figures.delay, Duration(0)),
                                    std::uint32_t(figures.dropped), figures.takes_nothing});
        }
        if (!report.links.empty())
            events.report(std::move(report));
    }

    const Events events;
    const net::Certificate certificate;
    std::mutex mutex;
    Receivers named;  // guarded by mutex
    std::atomic<std::size_t> connected = 0, waiting = 0, cached = 0;
    std::atomic<std::uint64_t> frames_in = 0, bytes_in = 0, bytes_out = 0, dropped = 0,
                               keys_asked = 0, lost = 0, strangers = 0;
    std::atomic<bool> has_lost = false;           // frames, before the next one
    std::map<net::PeerId, ParticipantId> people;  // the listener's thread, as are the next
    std::map<ParticipantId, net::PeerId> connections;
    FanOut fan_out;
    net::Server server;
    std::thread thread;
};

RelayServer::RelayServer(const net::Endpoint& endpoint, Events events)
    : impl_(std::make_unique<Impl>(endpoint, std::move(events))) {}
RelayServer::~RelayServer() = default;

std::uint16_t RelayServer::port() const {
    return impl_->server.port();
}
std::string RelayServer::fingerprint() const {
    return impl_->certificate.fingerprint;
}

void RelayServer::set_receivers(std::vector<wire::RelayReceiver> receivers) {
    Receivers named;
    for (wire::RelayReceiver& receiver : receivers) {
        const Bytes secret = receiver.secret;
        named[secret] = std::move(receiver);
    }
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->named = std::move(named);
    }
    impl_->server.post([impl = impl_.get()] { impl->follow_receivers(); });
}

void RelayServer::push(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message) {
    ++impl_->frames_in;
    impl_->bytes_in += message->size();
    if (impl_->waiting >= max_frames_waiting) {
        ++impl_->lost;
        impl_->has_lost = true;
        return;
    }
    ++impl_->waiting;
    impl_->server.post([impl = impl_.get(), header, message = std::move(message)] {
        --impl->waiting;
        impl->push(header, message);
    });
}

RelayServer::Figures RelayServer::figures() const {
    std::size_t named = 0;
    {
        const std::lock_guard lock(impl_->mutex);
        named = impl_->named.size();
    }
    return {impl_->connected, named,          impl_->frames_in,  impl_->bytes_in,
            impl_->bytes_out, impl_->dropped, impl_->keys_asked, impl_->lost,
            impl_->strangers, impl_->cached};
}

}  // namespace theatron::relay
