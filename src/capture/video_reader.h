// SPDX-License-Identifier: Apache-2.0
// Decodes the video track of a file with libavformat and libavcodec, in a sandbox: both are large
// and the file is untrusted. The rest of the program uses video_camera.h.
#pragma once

#include "sandbox/inside.h"

namespace theatron::capture {

// Serves requests (video_answer.h) until the channel closes.
void serve_video(sandbox::Inside& inside);

}  // namespace theatron::capture
