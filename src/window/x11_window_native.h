// SPDX-License-Identifier: Apache-2.0
// The number of a window of SDL on X11.
#pragma once

#include <cstdint>

struct SDL_Window;

namespace theatron::window {

// 0 on other desktops.
std::uint32_t x11_window(SDL_Window* window);

}  // namespace theatron::window
