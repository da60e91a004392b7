// SPDX-License-Identifier: Apache-2.0
// A relay as a library: joins a host's session, takes each setting that somebody uses once, and
// serves it to many receivers (docs/relays.md). It sees no picture: they are sealed.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "net/link.h"
#include "relay/relay_server.h"
#include "relay/upstream.h"

namespace theatron::relay {

class Relay {
public:
    struct Options {
        net::Link link;
        net::Endpoint listen;
        // Names or addresses under which receivers reach it; empty: the addresses of this machine.
        std::vector<std::string> addresses;
        // As in wire::OfferRelay.
        std::vector<std::string> networks;
        std::string name = "relay";
        std::function<void(const std::string&)> remark;  // from its threads
    };

    // Throws Error with one sentence if it cannot listen, or has no address.
    explicit Relay(Options options);
    // Receivers go back to the host.
    ~Relay();

    Upstream::Status status() const { return upstream_->status(); }
    RelayServer::Figures figures() const { return server_->figures(); }
    const std::vector<std::string>& addresses() const { return addresses_; }
    std::uint16_t port() const { return server_->port(); }

private:
    std::vector<std::string> addresses_;
    // The server's thread reports to the connection, and that one gives frames to the server.
    mutable std::mutex mutex_;
    Upstream* to_host_ = nullptr;  // guarded by mutex_
    std::unique_ptr<RelayServer> server_;
    std::unique_ptr<Upstream> upstream_;
};

}  // namespace theatron::relay
