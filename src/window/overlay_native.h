// SPDX-License-Identifier: Apache-2.0
// Draws the texts over the picture.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "geometry/vec.h"
#include "image/view.h"
#include "window/overlay_content.h"

namespace theatron::window {

// Needs the window's GL context current, also in the destructor.
class Overlay {
public:
    // Throws Error where the driver does not accept the shaders.
    Overlay();
    ~Overlay();

    // Draws into the window's framebuffer. `text_pixels` is the height of a normal text.
    void draw(const OverlayContent& content, Size window, double text_pixels);

    // The last picture at this place, in shares of the window's width and height.
    bool covers(Vec2 place) const;                    // a panel or a plain picture
    std::optional<int> command_at(Vec2 place) const;  // of a panel's button or a plain picture

    // All buttons in the order of the keyboard: those of the bar at the bottom, of offers, of
    // panels, in each of them as they are read. Rows that do not fit have theirs, too.
    std::size_t controls() const;
    // The first button of the panel to which the keyboard comes first; 0 without such a panel.
    std::size_t keyboard_begin() const;
    std::optional<std::size_t> control_at(Vec2 place) const;
    int command_of(std::size_t control) const;  // below controls()

    // A slider of a panel in the last picture: its command, and what the mouse chooses with it.
    struct Slider {
        int command = 0;
        double from = 0, to = 1;  // its ends, in shares of the window's width
        double lowest = 0, highest = 1;

        double value_at(Vec2 place) const {
            const double share = std::clamp((place.x - from) / (to - from), 0.0, 1.0);
            return lowest + share * (highest - lowest);
        }
    };
    std::optional<Slider> slider_at(Vec2 place) const;

    // Moves the rows of the panel at this place, which may have more of them than fit. `rows` > 0:
    // later ones come into sight. The next picture shows it.
    void scroll(Vec2 place, double rows);
    // The same by the keyboard, for the panel to which it comes first, as many rows as are in
    // sight. False if there is none, or all its rows are in sight. A control that gets the keyboard
    // comes into sight by itself.
    bool turn_page(int pages);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::window
