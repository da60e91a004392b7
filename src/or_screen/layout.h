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
#include "render/label_place.h"

namespace theatron::or_screen {

using render::label_place;
using render::Rect;

// The largest rectangle of these proportions in the middle of `room`.
Rect fitted(Size proportions, const Rect& room);

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

// The places of the monitor's slice, with the proportions of `slice`, and of this number of lines
// of text below it.
struct MonitorPlaces {
    Rect picture;
    Rect letters;  // at whose edges the letters of sides stand: around a picture that is too flat
    std::vector<Rect> lines;
};
MonitorPlaces monitor_places(const Rect& monitor, Size slice, std::size_t lines, double letter);
// The factor of the letters' size with which a text of `width` pixels fits into `most` pixels: 1 at
// most, and not less than letters that can be read.
double scale_to_fit(double width, double most);
// The place of this number of letters inside of `area`, at its edge in the direction `towards`, of
// which one coordinate is 0 and the other -1 or 1.
Rect letters_place(const Rect& area, Vec2 towards, std::size_t letters, double letter);

// By how much all of it is moved at this moment, in units of Layout::letter, at most
// largest_drift along each axis; layout() keeps that much free at the edges. It moves slower than
// a letter's height in half a minute, and no edge rests, so that nothing burns into a screen.
inline constexpr double largest_drift = 0.45;
Vec2 drift(TimePoint now);
Rect moved(Rect rect, Vec2 by);

}  // namespace theatron::or_screen
