// SPDX-License-Identifier: Apache-2.0
// Two participants that follow a script in the demo's room: they look around, point, hold a brick,
// hand it over and put it back.
#pragma once

#include <array>
#include <memory>

#include "client/participant.h"

namespace theatron::app {

// Use from one thread.
class ScriptedPeople {
public:
    // Joins the session of `link` twice.
    explicit ScriptedPeople(const net::Link& link);

    // Call it often, so that motion is smooth. A brick in another participant's hand is not taken.
    void on_tick();

private:
    void handle(const client::Participant::Room& room, session::ObjectId brick, double seconds);

    std::array<std::unique_ptr<client::Participant>, 2> people_;
    TimePoint begin_, created_, moved_;
};

}  // namespace theatron::app
