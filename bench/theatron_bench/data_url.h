// SPDX-License-Identifier: Apache-2.0
// Pictures within a page.
#pragma once

#include <string>

#include "base/bytes.h"
#include "image/image.h"

namespace theatron::bench {

// RFC 4648, with padding.
std::string base64(ByteView bytes);

// The picture as JPEG in the text of an <img src>. Throws Error for a picture without pixels.
std::string picture_url(const ColorImage& picture);

}  // namespace theatron::bench
