// SPDX-License-Identifier: Apache-2.0
// The kind of a camera, before it is opened.
#pragma once

#include <string_view>

namespace theatron::capture {

// Throws Error with one clear sentence if open_camera() knows no kind of this specification.
void check_camera_kind(std::string_view specification);

}  // namespace theatron::capture
