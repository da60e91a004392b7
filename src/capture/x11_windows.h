// SPDX-License-Identifier: Apache-2.0
// The windows of this computer's X display, and connections to it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/source_inputs.h"
#include "image/view.h"

namespace theatron::capture {

struct X11Window {
    std::uint32_t number = 0;  // 0: the whole display
    std::string title;         // as its program wrote it, without control characters
    std::string program;       // its class, without what the title may tell
    Size size;
    std::uint32_t process = 0;  // 0: its program does not say
};

// True if `found` is the window that was shared before, or the one that the same program opened in
// its place: numbers and parts of titles are also those of other windows, which nobody agreed to
// show.
bool is_same_window(const X11Window& shared, const X11Window& found);

// "0x1e00003"
std::string number_text(std::uint32_t window);

// The visible windows of programs. Throws Error if there is no display.
std::vector<X11Window> list_windows();

// The window of this number, the only one with this text in its title or program, or for "display"
// the whole display. Throws Error.
X11Window find_window(const std::string& text);

struct X11Connection {
    SourceInput input;    // before its first byte
    std::string display;  // ":0"
    int screen = 0;
    std::string cookie_hex;  // MIT-MAGIC-COOKIE-1, which the server asks for; may be empty
};
// Throws Error.
X11Connection connect_to_x11();

}  // namespace theatron::capture
