// SPDX-License-Identifier: Apache-2.0
// Photos that lie on their side in a file, as most telephones store them.
#pragma once

#include "base/bytes.h"
#include "image/image.h"

namespace theatron::files {

// The orientation in the EXIF data of a JPEG file, 1 (upright) to 8 (CIPA DC-008, 4.6.4); 1 where
// it has none. Safe for any bytes.
int exif_orientation(ByteView jpeg);

// A picture as it is meant to be seen, out of the pixels of a file with this orientation.
ColorImage upright(ColorImage picture, int orientation);

}  // namespace theatron::files
