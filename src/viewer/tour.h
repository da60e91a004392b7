// SPDX-License-Identifier: Apache-2.0
// Three steps for a person who is here for the first time: how to look around, to speak and point,
// to leave. They stand above the picture, beside buttons that go on or skip the rest.
#pragma once

#include "phrases/phrase.h"
#include "wire/role.h"

namespace theatron::viewer {

class Tour {
public:
    static constexpr int steps = 3;

    // Due: the first step comes by itself.
    explicit Tour(bool is_due) : is_due_(is_due) {}

    // `sees_session`: the person is in a session and has a picture of it. A tour that the end of
    // the connection has broken off comes again.
    void follow(bool sees_session);
    // From the first step, also for a person who has seen it.
    void begin() { step_ = 1; }
    // The step behind the last one ends it.
    void next();
    void skip();

    // 1 to `steps`; 0: it is not shown.
    int step() const { return step_; }
    bool is_seen() const { return !is_due_; }

private:
    bool is_due_;
    int step_ = 0;
};

// The words of a step for a person of this role. They name no button that the role does not have.
Phrase tour_text(int step, wire::Role role);

}  // namespace theatron::viewer
