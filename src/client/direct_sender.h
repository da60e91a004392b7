// SPDX-License-Identifier: Apache-2.0
// A publisher's own listener: it sends frames of its cameras to the receivers that the host names,
// and to nobody else (docs/decisions/direct-sending.md). Receivers that its link or theirs does not
// carry are left to the host (session/direct_load.h). From a receiver it reads a greeting and
// acknowledgements; another message of control or of media ends the connection.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "net/outbox.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::client {

class DirectSender {
public:
    // From the listener's own thread.
    struct Events {
        // A receiver can go on with this stream only at a key frame.
        std::function<void(StreamId, SettingId)> needs_key;
        // Session time; it never jumps.
        std::function<TimePoint()> now;
    };

    // Frames that wait for the listener's thread; one more is dropped.
    static constexpr std::size_t max_frames_waiting = 64;

    // Listens on a free port of all IPv4 addresses of this machine; null in a browser. Throws Error
    // with one sentence if that is not possible.
    static std::unique_ptr<DirectSender> open(Events events);
    ~DirectSender();

    // For the host: its port, addresses of this machine, and its certificate.
    wire::OfferDirect offer() const;

    // From any thread. Exactly these receivers may be connected from now on; the connections of
    // others end.
    void set_receivers(const std::vector<wire::DirectReceiver>& receivers);
    // From any thread; costs nothing while nobody is connected. `media` is as for the host, in
    // particular with a chain of its own for each setting.
    void send(const wire::MediaHeader& header, const net::Media& media);
    // That are connected now.
    std::size_t receivers() const;

private:
    struct Impl;
    explicit DirectSender(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::client
