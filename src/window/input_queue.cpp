// SPDX-License-Identifier: Apache-2.0
#include "window/input_queue.h"

#include <utility>

namespace theatron::window {
namespace {

bool has_button(const WindowInput& input) {
    return input.grabbed || input.released;
}

// The input that follows: what is held stays, what happened does not.
WindowInput states_of(const WindowInput& input) {
    WindowInput next;
    next.pointer = input.pointer;
    next.aims_teleport = input.aims_teleport;
    next.points = input.points;
    next.talks = input.talks;
    next.steering.fly = input.steering.fly;
    next.steering.fast = input.steering.fast;
    return next;
}

}  // namespace

// False if no more may wait.
bool InputQueue::begin_next() {
    if (waiting_.size() == max_waiting)
        return false;
    waiting_.push_back(states_of(newest()));
    return true;
}

void InputQueue::press(const KeyPress& key) {
    if (has_button(newest()) && !begin_next())
        return;
    if (newest().keys.size() < max_waiting)
        newest().keys.push_back(key);
}

void InputQueue::type(const FormKeyPress& key) {
    if (newest().typed.size() < max_waiting)
        newest().typed.push_back(key);
}

void InputQueue::grab(Vec2 place, bool left) {
    if ((has_button(newest()) || !newest().keys.empty()) && !begin_next())
        return;
    newest().grabbed = place;
    newest().grabbed_left = left;
}

void InputQueue::move(Vec2 place) {
    if (newest().released)
        (void)begin_next();
    newest().pointer = place;
}

void InputQueue::release() {
    if (has_button(newest()) || !newest().keys.empty())
        (void)begin_next();
    newest().released = true;
}

bool InputQueue::has_more() const {
    const WindowInput& oldest = waiting_.front();
    const Steering& way = oldest.steering;
    const bool moves = way.turn != Vec2{} || way.slide != Vec2{} || way.approach != 0;
    return waiting_.size() > 1 || has_button(oldest) || !oldest.keys.empty() ||
           !oldest.typed.empty() || moves || oldest.redraw || oldest.close;
}

WindowInput InputQueue::take() {
    WindowInput oldest = std::move(waiting_.front());
    waiting_.pop_front();
    if (waiting_.empty())
        waiting_.push_back(states_of(oldest));
    return oldest;
}

}  // namespace theatron::window
