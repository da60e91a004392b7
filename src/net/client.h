// SPDX-License-Identifier: Apache-2.0
// A participant's side of the network: one connection to the host of a link,
// whose certificate must be the one that the link names.
// client.cpp is the native one with a thread, client_web.cpp that of a browser's page.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/bytes.h"
#include "base/time.h"
#include "net/link.h"
#include "net/outbox.h"
#include "wire/envelope.h"

namespace theatron::net {

class Client {
public:
    // Called on the thread that runs the client. A call that throws ends the connection.
    struct Handler {
        std::function<void()> connected;
        std::function<void(ByteView)> control;
        // See Connection::Events. May be empty.
        std::function<bool(Bytes&)> media;
        std::function<void(const wire::State&)> state;  // may be empty
        std::function<void(const wire::Voice&)> voice;  // may be empty
        std::function<TimePoint()> now;                 // a steady clock of this machine
        std::function<void()> tick;                     // ten times a second
    };

    Client(Link link, Handler handler);
    ~Client();

    // The reason for the end of run().
    struct End {
        std::string why;  // one sentence, empty after stop() and leave()
        bool final =
            false;  // another attempt is useless: another certificate, a proxy without a password
    };

    // Connects and serves until the connection ends, or stop() or leave() is called. Not in a
    // browser.
    End run();

    // In a browser only, which owns the thread: returns at once. `ended` is called once, from one
    // of the browser's events, and must not destroy this. Destroying it before ends the connection.
    // The browser checks the host's certificate by its own rules, not against the link.
    void start(std::function<void(const End&)> ended);

    // Before run(): the host is in an own network, and reached without an outgoing proxy. Not in a
    // browser.
    void go_directly();

    // Before run(): the longest time for connecting and the TLS handshake. Not in a browser.
    void set_patience(Duration patience);

    // From any thread. Not in a browser. leave() sends the control messages that are queued first,
    // and waits for the host's end of the connection, both at most for Connection::max_farewell.
    void stop();
    void leave();
    void post(std::function<void()> work);  // runs `work` on the client's thread

    // On the client's thread only.
    void end(const std::string& why);  // ends the connection; `why` as in End
    void send_control(ByteView control);
    void send_states(std::span<const wire::State> states);
    void send_voice(const wire::Voice& voice);
    // A media message of this size that waited has been taken.
    void taken(std::size_t bytes);
    Outbox::Pushed send_media(Media media);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::net
