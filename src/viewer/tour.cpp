// SPDX-License-Identifier: Apache-2.0
#include "viewer/tour.h"

#include "session/permissions.h"

namespace theatron::viewer {

void Tour::follow(bool sees_session) {
    if (!sees_session)
        step_ = 0;
    else if (is_due_ && step_ == 0)
        step_ = 1;
}

void Tour::next() {
    if (step_ < steps)
        ++step_;
    else
        skip();
}

void Tour::skip() {
    step_ = 0;
    is_due_ = false;
}

Phrase tour_text(int step, wire::Role role) {
    if (step == 1)
        return Phrase::tour_look;
    if (step == 2)
        return session::may(role, session::Right::point) ? Phrase::tour_act : Phrase::tour_watch;
    return Phrase::tour_leave;
}

}  // namespace theatron::viewer
