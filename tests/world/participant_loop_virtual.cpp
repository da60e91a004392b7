// SPDX-License-Identifier: Apache-2.0
// A participant's connections in the World, one after the other, as events of the Schedule.
#include "base/fault.h"
#include "client/participant_shared.h"
#include "world/schedule.h"

namespace theatron::client {

struct Participant::EventLoop : Loop {
    explicit EventLoop(Participant& p) : participant(p) {}
    ~EventLoop() override {
        if (timer)
            world::Schedule::instance().cancel(*timer);
    }

    void connect() {
        timer.reset();
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
            timer = world::Schedule::instance().after(*wait, [this] { connect(); });
    }

    Participant& participant;
    std::unique_ptr<net::Client> client;
    std::optional<world::Schedule::Key> timer;
};

void Participant::start() {
    auto loop = std::make_unique<EventLoop>(*this);
    loop->connect();
    loop_ = std::move(loop);
}

Participant::~Participant() {
    if (shared_->client)
        withdraw();
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->stopping = true;
        shared_->client = nullptr;
    }
    loop_.reset();
}

}  // namespace theatron::client
