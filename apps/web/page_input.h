// SPDX-License-Identifier: Apache-2.0
// A browser's keys as the window's actions: the keys of docs/keys.md.
#pragma once

#include <optional>
#include <string_view>

#include "window/window_input.h"

namespace theatron::web {

// `key`: KeyboardEvent.key in lower case; `code`: KeyboardEvent.code. Safe for any text.
std::optional<window::KeyPress> pressed(std::string_view key, std::string_view code);

}  // namespace theatron::web
