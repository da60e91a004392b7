// SPDX-License-Identifier: Apache-2.0
// The places of everything on the OR screen.
//
// Pure functions; pixels, x to the right and y down from the screen's upper left corner.
#pragma once

#include <cstddef>
#include <vector>

#include "base/time.h"
#include "geometry/vec.h"
#include "image/view.h"

namespace theatron::or_screen {

struct Rect {
    double x = 0, y = 0, width = 0, height = 0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
    bool operator==(const Rect&) const = default;
};

// The largest rectangle of these proportions in the middle of `room`.
Rect fitted(Size proportions, const Rect& room);

// The place for a label of this size beside `at`: inside of `area`, so far away, and where it
// covers the least of what is there already.
Rect label_place(Vec2 at, Vec2 size, double apart, const Rect& area,
                 const std::vector<Rect>& there);

struct LayoutFacts {
    Size screen;
    Size picture;  // of the camera that is shown; empty: none
    std::size_t people = 0;
    bool has_monitor = false;
};

struct Layout {
    // The height of the smallest capital letters: on a screen of 27 inches 11 mm, which is 12.5
    // minutes of arc at 3 m.
    static constexpr double letter_share = 0.0325;  // of the screen's smaller side
    static constexpr std::size_t most_cards = 8;

    double letter = 0;
    Rect picture;              // of the camera, with its proportions
    Rect caption;              // one line of text below it
    Rect room;                 // the virtual room from above
    Rect monitor;              // empty without one
    std::vector<Rect> cards;   // of people, at least one
    bool two_lines = true;     // in a card
    std::size_t left_out = 0;  // people without a card; the last card tells how many
};

Layout layout(const LayoutFacts& facts);

// By how much all of it is moved at this moment, in units of Layout::letter, at most
// largest_drift along each axis; layout() keeps that much free at the edges. It moves slower than
// a letter's height in half a minute, and no edge rests, so that nothing burns into a screen.
inline constexpr double largest_drift = 0.45;
Vec2 drift(TimePoint now);
Rect moved(Rect rect, Vec2 by);

}  // namespace theatron::or_screen
