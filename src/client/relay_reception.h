// SPDX-License-Identifier: Apache-2.0
// A receiver's connections to relays that the host has named: each on a thread of its own, made
// again with growing pauses as long as the host's permission holds. Pictures come sealed and are
// opened here. Nothing waits for them, since the host sends all frames that do not come here
// (docs/decisions/relays.md).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "wire/control.h"

namespace theatron::client {

class RelayReception {
public:
    // False in a browser, where a page cannot trust a relay's own certificate.
    static bool is_possible();

    // For one address, until the relay's certificate is checked.
    static constexpr Duration connect_patience = std::chrono::seconds(2);
    // A connection that gives no frame for this time is made anew.
    static constexpr Duration silence = std::chrono::seconds(2);
    static constexpr Duration first_pause = std::chrono::seconds(1);
    static constexpr Duration longest_pause = std::chrono::seconds(30);
    // A connection that has lasted for this time begins again with the first pause.
    static constexpr Duration proven = std::chrono::seconds(10);
    // Frames of one relay that are not yet taken; one more is dropped.
    static constexpr std::size_t max_frames_waiting = 64;
    // Frames in a row with a key that the receiver does not know, and old ones; then the connection
    // ends. A forged one ends it at once.
    static constexpr int max_unopened = 500;

    // From the connections' threads.
    struct Events {
        // A media message that the session has sealed, opened; it may be moved away. taken() must
        // be called with its size later.
        std::function<void(std::uint64_t link, Bytes& message)> media;
        // A relay's connection has ended.
        std::function<void()> ended;
    };
    explicit RelayReception(Events events);
    ~RelayReception();

    // For one thread. Connects to exactly these relays; the others' connections end at once.
    void set_grants(const std::vector<wire::RelayGrant>& grants);
    // From any thread. Links that have ended are ignored.
    void taken(std::uint64_t link, std::size_t bytes);

private:
    class Link;
    Events events_;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::client
