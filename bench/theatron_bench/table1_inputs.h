// SPDX-License-Identifier: Apache-2.0
// The input of Table 1 from any camera: its pictures' sizes, and how a host plays it.
#pragma once

#include <string>

#include "capture/crop.h"

namespace theatron::bench {

// The specification with which a host plays the same pictures again and again: recordings get
// loop=1 and preload=1 unless they say otherwise, generated cameras preload=1.
std::string played_for_long(const std::string& camera);

// The middle part of a picture that is to it what the paper's cropped picture is to its full one,
// with even sides of at least two pixels, which video codecs need. `full` has such sides, too.
capture::Crop paper_crop(Size full);

// "640x576".
std::string size_text(Size size);

}  // namespace theatron::bench
