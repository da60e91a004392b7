// SPDX-License-Identifier: Apache-2.0
// JPEG pictures of files that no camera writes: progressive ones, and those in four inks. Native
// builds only.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/image.h"

namespace theatron::video {

// Decodes any picture that libjpeg-turbo does. Decoding may take the time of hundreds of ordinary
// pictures (read_jpeg_size): not for bytes that strangers send. Malformed: damaged, or it ends
// early. Prints nothing.
Status decode_jpeg_file(ByteView jpeg, ColorImage& out);

}  // namespace theatron::video
