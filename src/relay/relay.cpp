// SPDX-License-Identifier: Apache-2.0
#include "relay/relay.h"

#include <utility>

#include "base/error.h"
#include "base/hex_text.h"
#include "base/steady_clock.h"
#include "net/own_addresses.h"

namespace theatron::relay {

Relay::Relay(Options options)
    : addresses_(options.addresses.empty() ? net::own_addresses(wire::max_relay_addresses)
                                           : std::move(options.addresses)) {
    if (addresses_.empty())
        throw Error("This machine has no address in a network; name one with --address.");
    RelayServer::Events events;
    events.report = [this](wire::RelayReport report) {
        const std::lock_guard lock(mutex_);
        if (to_host_)
            to_host_->report(std::move(report));
    };
    events.now = [this] {
        const std::lock_guard lock(mutex_);
        return to_host_ ? to_host_->now() : steady_now();
    };
    server_ = std::make_unique<RelayServer>(options.listen, std::move(events));
    Upstream::Events from_host;
    from_host.receivers = [this](std::vector<wire::RelayReceiver> receivers) {
        server_->set_receivers(std::move(receivers));
    };
    from_host.media = [this](const wire::MediaHeader& header,
                             std::shared_ptr<const Bytes> message) {
        server_->push(header, std::move(message));
    };
    from_host.remark = std::move(options.remark);
    wire::OfferRelay offer{addresses_, server_->port(),
                           bytes_of_hex(server_->fingerprint()).value_or(Bytes()),
                           std::move(options.networks)};
    upstream_ = std::make_unique<Upstream>(std::move(options.link), options.name, std::move(offer),
                                           std::move(from_host));
    const std::lock_guard lock(mutex_);
    to_host_ = upstream_.get();
}

Relay::~Relay() {
    {
        const std::lock_guard lock(mutex_);
        to_host_ = nullptr;
    }
    upstream_.reset();
}

}  // namespace theatron::relay
