// SPDX-License-Identifier: Apache-2.0
// A window on the desktop that OpenGL ES 3 draws into (a core profile where the driver has no
// ES), and its input events.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "image/view.h"
#include "window/form_input.h"
#include "window/window_input.h"

namespace theatron::window {

// One at a time. Use from the thread that made it, but for wake().
class DesktopWindow {
public:
    // Opens the window and makes its GL context current. `size` is in the desktop's
    // units, which are several pixels each on some screens. Throws Error where
    // there is no display, or none that can do OpenGL ES 3 or OpenGL 4.2.
    // `instead`: a sentence on what a person without one can do, which the error ends with.
    DesktopWindow(const std::string& title, Size size, const std::string& instead = "");
    // No object of the GL context may be left.
    ~DesktopWindow();
    DesktopWindow(const DesktopWindow&) = delete;
    DesktopWindow& operator=(const DesktopWindow&) = delete;

    // Returns at the next input event of the window, after wake(), or when the timeout
    // is over.
    void wait(Duration timeout);
    // From any thread; also remembered for the next wait().
    void wake();
    // The input since the last call.
    WindowInput poll();
    // The same as input into a form.
    FormInput poll_form();
    // While it takes text, keys are letters: they are in WindowInput::typed.
    void take_text(bool takes);
    // The text of the desktop's clipboard; empty where there is none.
    std::string clipboard() const;
    void set_clipboard(const std::string& text);

    // False while the window cannot be seen, for example minimised.
    bool is_visible() const;
    Size pixels() const;
    // Height of a text of normal size on this screen, in pixels.
    double text_pixels() const;
    // The shortest time between two pictures that the screen can show.
    Duration picture_time() const;

    // By which other connections know it: a number of X11, 0 on other desktops.
    std::uint32_t x11_number() const;

    void set_title(const std::string& title);
    void toggle_full_screen();
    bool is_full_screen() const;
    // For a screen that nobody handles: all of it, also where no window manager runs, and without
    // a pointer.
    void fill_screen();

    // Presents the drawn picture. Waits for the screen if the driver does so.
    void present();

    // Errors that the GL driver reported, and the text of the first.
    int gl_errors() const;
    std::string first_gl_error() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::window
