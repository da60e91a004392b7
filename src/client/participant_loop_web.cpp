// SPDX-License-Identifier: Apache-2.0
// A participant's connections, one after the other, in the events of a browser's page.
#include <emscripten/eventloop.h>

#include "base/fault.h"
#include "client/participant_shared.h"

namespace theatron::client {

struct Participant::EventLoop : Loop {
    explicit EventLoop(Participant& p) : participant(p) {}
    ~EventLoop() override {
        if (timer != 0)
            emscripten_clear_timeout(timer);
    }

    void connect() {
        const bool begun = contain("participant", [this] {
            client =
                std::make_unique<net::Client>(participant.options_.link, participant.handler());
            if (participant.begin_connection(*client))
                client->start([this](const net::Client::End& end) { on_end(end); });
        });
        if (!begun)
            participant.give_up();
    }

    // The client still runs: connect() destroys it.
    void on_end(const net::Client::End& end) {
        if (const auto wait = participant.end_connection(end))
            timer = emscripten_set_timeout(
                [](void* data) {
                    auto& self = *static_cast<EventLoop*>(data);
                    self.timer = 0;
                    self.connect();
                },
                to_ms(*wait), this);
    }

    Participant& participant;
    std::unique_ptr<net::Client> client;
    long timer = 0;
};

void Participant::start() {
    auto loop = std::make_unique<EventLoop>(*this);
    loop->connect();
    loop_ = std::move(loop);
}

Participant::~Participant() {
    if (shared_->client)
        withdraw();
    shared_->stopping = true;
    loop_.reset();
}

}  // namespace theatron::client
