// SPDX-License-Identifier: Apache-2.0
// A relay's listener: it sends frames of the host to the receivers that the host names, and to
// nobody else (docs/decisions/relays.md). From a receiver it reads a greeting and acknowledgements;
// another message of control or of media ends the connection.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "net/link.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::relay {

class RelayServer {
public:
    // From the listener's own thread.
    struct Events {
        // Ten times a second while somebody is connected, and when a key frame is needed.
        std::function<void(wire::RelayReport)> report;
        // Session time; it may jump when it becomes known.
        std::function<TimePoint()> now;
    };
    struct Figures {
        std::size_t receivers = 0;  // that are connected
        std::size_t named = 0;      // that may be
        std::uint64_t frames_in = 0, bytes_in = 0;
        std::uint64_t bytes_out = 0;   // given to connections
        std::uint64_t dropped = 0;     // frames that links were too slow for
        std::uint64_t keys_asked = 0;  // of the host
        std::uint64_t lost = 0;        // frames that this machine was too slow for
        std::uint64_t strangers = 0;   // connections that the host has not named
        std::size_t cached_bytes = 0;
    };

    // Frames that wait for the listener's thread; one more is dropped.
    static constexpr std::size_t max_frames_waiting = 256;

    // Listens. Throws Error with one sentence if that is not possible.
    RelayServer(const net::Endpoint& endpoint, Events events);
    ~RelayServer();

    std::uint16_t port() const;
    std::string fingerprint() const;  // of its certificate, 64 hex digits

    // From any thread. Exactly these receivers may be connected from now on; the connections of
    // others end.
    void set_receivers(std::vector<wire::RelayReceiver> receivers);
    // From any thread: a frame of the host.
    void push(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message);
    Figures figures() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::relay
