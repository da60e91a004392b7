// SPDX-License-Identifier: Apache-2.0
// A host's door in the World: it lets in all who come, and hands them on with their first message,
// without TLS, HTTP and strangers (net/door.cpp has them).
#include <condition_variable>
#include <mutex>
#include <set>

#include "base/error.h"
#include "base/fault.h"
#include "net/door.h"
#include "net/https_get.h"
#include "net/server.h"

namespace theatron::net {

void require_free(const Endpoint& endpoint) {
    if (endpoint.port != 0 && !world::Network::instance().is_free(endpoint.port))
        throw Error("Port " + std::to_string(endpoint.port) + " is used already.");
}

// Pages are for programs outside of the World.
HttpsAnswer https_get(const Link& link, const std::string&, Duration) {
    throw Error("Nobody answers at " + link.host + ".");
}

struct Door::Impl {
    boost::asio::io_context& inside;
    std::string fingerprint;
    Events events;
    std::uint16_t port = 0;
    std::set<std::shared_ptr<world::Plug>> strangers;
    std::mutex mutex;
    std::condition_variable changed;
    bool is_stopped = false;  // guarded by mutex

    void accept(const std::shared_ptr<world::Plug>& plug, const std::string& address) {
        strangers.insert(plug);
        world::Schedule::instance().after(first_message_deadline, [this, weak = std::weak_ptr(plug),
                                                                   loop = inside.get_executor()] {
            if (const auto there = weak.lock();
                there && !loop->is_stopped() && strangers.erase(there) > 0)
                there->close();
        });
        plug->read([this, plug, address, loop = inside.get_executor()](world::Fault fault,
                                                                       ByteView envelope) {
            if (loop->is_stopped() || strangers.erase(plug) == 0)
                return;
            wire::Unwrapper unwrapper(wire::Unwrapper::Takes::all_but_media);
            const auto first = unwrapper.take(envelope);
            if (fault != world::Fault::none || !first || first->control.empty() ||
                envelope.size() > wire::max_first_envelope_size)
                return plug->close();
            const auto visitor =
                std::make_shared<Visitor>(Visitor{WebSocket(inside, plug),
                                                  address,
                                                  {first->control.begin(), first->control.end()},
                                                  events.invited(first->control)});
            boost::asio::post(inside, [this, visitor] {
                (void)contain("net", [&] { events.entered(std::move(*visitor)); });
            });
        });
    }
};

Door::Door(boost::asio::io_context& inside, const Endpoint& endpoint,
           const Certificate& certificate, Access, Events events)
    : impl_(new Impl{inside, certificate.fingerprint, std::move(events)}) {
    require_free(endpoint);
    impl_->port = world::Network::instance().listen(
        endpoint.port,
        {[impl = impl_.get()](std::shared_ptr<world::Plug> plug, const std::string& address) {
             impl->accept(plug, address);
         },
         [impl = impl_.get()] { return impl->fingerprint; }});
}

Door::~Door() {
    close_all();
}

std::uint16_t Door::port() const {
    return impl_->port;
}

void Door::set_certificate(const Certificate& certificate) {
    impl_->fingerprint = certificate.fingerprint;
}

void Door::run() {
    std::unique_lock lock(impl_->mutex);
    impl_->changed.wait(lock, [this] { return impl_->is_stopped; });
}

void Door::stop() {
    const std::lock_guard lock(impl_->mutex);
    impl_->is_stopped = true;
    impl_->changed.notify_all();
}

void Door::close_all() {
    world::Network::instance().stop_listening(impl_->port);
    for (const auto& plug : std::exchange(impl_->strangers, {}))
        plug->close();
}

std::size_t Door::poll() {
    return 0;
}

}  // namespace theatron::net
