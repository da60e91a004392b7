// SPDX-License-Identifier: Apache-2.0
// A participant's connections, one after the other, on a thread of its own.
#include <thread>

#include "base/fault.h"
#include "base/thread_name.h"
#include "client/participant_shared.h"

namespace theatron::client {

struct Participant::ThreadLoop : Loop {
    explicit ThreadLoop(Participant& participant)
        : thread([&participant] {
              // run() connects again by itself after a fault of the connection.
              if (!contain("participant", [&] { run(participant); }))
                  participant.give_up();
          }) {}
    ~ThreadLoop() override { thread.join(); }

    static void run(Participant& participant) {
        name_this_thread("net");
        Shared& shared = *participant.shared_;
        while (true) {
            net::Client client(participant.options_.link, participant.handler());
            if (!participant.begin_connection(client))
                return;
            const auto wait = participant.end_connection(client.run());
            std::unique_lock lock(shared.mutex);
            if (!wait || shared.changed.wait_for(lock, *wait, [&] { return shared.stopping; }))
                return;
        }
    }

    std::thread thread;
};

void Participant::start() {
    loop_ = std::make_unique<ThreadLoop>(*this);
}

Participant::~Participant() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->stopping = true;
        if (shared_->client) {
            shared_->client->post([this] { withdraw(); });
            shared_->client->leave();
        }
    }
    shared_->changed.notify_all();
    loop_.reset();
}

}  // namespace theatron::client
