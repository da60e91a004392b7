// SPDX-License-Identifier: Apache-2.0
// DejaVu Sans as a TrueType file, part of the program. Empty in a browser's page.
#pragma once

#include <cstddef>
#include <span>

namespace theatron::window {

std::span<const std::byte> text_font();

}  // namespace theatron::window
