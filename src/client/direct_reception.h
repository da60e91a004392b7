// SPDX-License-Identifier: Apache-2.0
// A receiver's connections to publishers that the host has named: each on a thread of its own, made
// again with growing pauses as long as the host's permission holds. Nothing waits for them, since
// the host sends all frames that do not come here (docs/decisions/direct-sending.md).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "wire/control.h"

namespace theatron::client {

class DirectReception {
public:
    // False in a browser, where a page cannot trust a publisher's own certificate.
    static bool is_possible();

    // For one address, until the publisher's certificate is checked.
    static constexpr Duration connect_patience = std::chrono::seconds(2);
    // A connection that gives no frame for this time is made anew.
    static constexpr Duration silence = std::chrono::seconds(2);
    static constexpr Duration first_pause = std::chrono::seconds(1);
    static constexpr Duration longest_pause = std::chrono::seconds(30);
    // A connection that has lasted for this time begins again with the first pause.
    static constexpr Duration proven = std::chrono::seconds(10);
    // Frames of one publisher that are not yet taken; one more is dropped.
    static constexpr std::size_t max_frames_waiting = 64;

    // From the connections' threads.
    struct Events {
        // A media message, which may be moved away. taken() must be called with its size later.
        std::function<void(std::uint64_t link, ParticipantId publisher, Bytes& message)> media;
        // A publisher's connection has ended.
        std::function<void(ParticipantId publisher)> ended;
    };
    explicit DirectReception(Events events);
    ~DirectReception();

    // For one thread. Connects to exactly these publishers; the others' connections end at once.
    void set_grants(const std::vector<wire::DirectGrant>& grants);
    // From any thread. Links that have ended are ignored.
    void taken(std::uint64_t link, std::size_t bytes);

private:
    class Link;
    Events events_;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::client
