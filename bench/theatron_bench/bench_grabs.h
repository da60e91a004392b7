// SPDX-License-Identifier: Apache-2.0
// Times between an action of one participant in the room and its effect at another one.
#pragma once

#include <atomic>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "client/participant.h"

namespace theatron::bench {

// The actor moves an object that it holds, and grabs and releases another one; the partner answers
// each movement at once by moving an object of its own. Both are participants of this process.
class Grabs {
public:
    // Sets what the two need; call it before they are constructed.
    void prepare_actor(client::Participant::Options& options);
    void prepare_partner(client::Participant::Options& options);

    // Creates the objects and takes hold of two. Waits until both participants know it. Throws
    // Error if that takes more than some seconds.
    void begin(client::Participant& actor, client::Participant& partner);

    // The actor's next action, unless the one before has not come back yet.
    void act();
    // Forgets what was measured.
    void reset();

    // {move_ms, there_and_back_ms, grab_ms, lost}: each {p50,p95,p99,max,count}; from an action to
    // the partner's state, to the actor's state after the partner's answer, from a grab or a
    // release to the partner's state; actions without an effect within a second.
    nlohmann::json result() const;

private:
    void on_partner();
    void on_actor();
    session::ObjectId create(client::Participant& owner, std::uint8_t color);
    void hold(client::Participant& owner, session::ObjectId object);
    void finish(std::vector<double>& times);

    client::Participant *actor_ = nullptr, *partner_ = nullptr;
    std::atomic<bool> running_ = false;
    session::ObjectId moved_{}, answer_{}, grabbed_{};

    mutable std::mutex mutex_;  // guards all below
    enum class Waiting { nothing, move, answer, grab };
    Waiting waiting_ = Waiting::nothing;
    std::uint32_t number_ = 0;  // of the action; the place of a moved object
    std::uint32_t grip_ = 0;    // 0: not held
    TimePoint acted_;
    std::vector<double> move_ms_, back_ms_, grab_ms_;
    std::uint64_t lost_ = 0;
};

}  // namespace theatron::bench
