// SPDX-License-Identifier: Apache-2.0
// Covers a window whose drawing stands still, from a thread and a connection to the desktop of its
// own: whatever the thread that draws waits for, its last picture does not look live.
//
// On X11 (also that of a Wayland desktop) a dark window inside of the other one hides it and says
// since when. No program may cover another's window on other desktops; there the owner is told.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "pace/drawing_watch.h"

namespace theatron::window {

// From any thread.
class WindowCover {
public:
    // `x11_window` by its number, 0 where there is none; it must outlive the cover. From the
    // cover's thread: `words` says what stands on it, `cannot_cover` is called once, when a window
    // has stood still for uncovered_end_after and cannot be covered.
    WindowCover(std::uint32_t x11_window, std::function<std::string(Duration still)> words,
                std::function<void()> cannot_cover);
    // Ends its thread.
    ~WindowCover();
    WindowCover(const WindowCover&) = delete;
    WindowCover& operator=(const WindowCover&) = delete;

    // As pace::DrawingWatch, now.
    void beat();
    void rest();

private:
    void run();

    const std::uint32_t window_;
    const std::function<std::string(Duration)> words_;
    const std::function<void()> cannot_cover_;
    std::mutex mutex_;
    std::condition_variable changed_;
    pace::DrawingWatch watch_;  // with mutex_, as the next
    bool stops_ = false;
    std::thread thread_;
};

}  // namespace theatron::window
