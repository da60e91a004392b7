// SPDX-License-Identifier: Apache-2.0
// A mark that a person is drawing, from its first press to its last release. A stroke follows the
// pointer while the button is down. An arrow and a distance do, too, or have a press at each end.
//
// Pure. Not thread safe.
#pragma once

#include <optional>
#include <utility>

#include "phrases/phrase.h"
#include "room/measured_distance.h"
#include "session/mark.h"
#include "session/room_object.h"

namespace theatron::viewer {

// A place that can be drawn on.
struct MarkedPlace {
    session::MarkedSurface surface{};
    session::ObjectId object{};  // the part of an organ or the screen; none of the cloud
    session::ObjectId organ{};   // to which the part belongs
    session::MarkPoint point;    // in the frame of the surface
    std::optional<room::MeasuredPoint> measured;  // of the cloud
};

class MarkDraft {
public:
    explicit MarkDraft(session::MarkKind kind) : kind_(kind) {}

    bool is_open() const { return mark_.has_value(); }
    bool is_pressed() const { return is_open() && is_pressed_; }
    // As it is so far, without its author. Precondition: is_open().
    const session::Mark& mark() const { return *mark_; }

    // Begins a mark, or gives the other end of one. Nullopt is nothing that can be drawn on: then
    // what was begun is dropped. True if the press was taken.
    bool press(const std::optional<MarkedPlace>& place);
    // The pointer is there now. Other surfaces than the first one draw nothing.
    void move_to(const MarkedPlace& place);
    // The mark, if it is complete. A click alone is none, except of a pin.
    std::optional<session::Mark> release();
    void drop() { mark_.reset(); }
    // Tells a person who only clicked the next step. Given once.
    std::optional<Phrase> take_advice() { return std::exchange(advice_, std::nullopt); }

private:
    bool has_two_ends() const;
    bool is_complete() const;

    session::MarkKind kind_;
    std::optional<session::Mark> mark_;
    MarkedPlace first_;
    bool is_pressed_ = false;
    std::optional<Phrase> advice_;
};

}  // namespace theatron::viewer
