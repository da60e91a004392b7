// SPDX-License-Identifier: Apache-2.0
#include "window/x11_window_native.h"

#define SDL_MAIN_HANDLED
#include <SDL.h>
#include <SDL_syswm.h>

namespace theatron::window {

std::uint32_t x11_window(SDL_Window* window) {
    SDL_SysWMinfo info;
    SDL_VERSION(&info.version);
    if (!SDL_GetWindowWMInfo(window, &info) || info.subsystem != SDL_SYSWM_X11)
        return 0;
    return std::uint32_t(info.info.x11.window);
}

}  // namespace theatron::window
