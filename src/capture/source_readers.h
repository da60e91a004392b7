// SPDX-License-Identifier: Apache-2.0
// The readers of live sources, each in a sandbox. The rest of the program uses source_camera.h.
#pragma once

#include "sandbox/inside.h"

namespace theatron::capture {

// A network stream: the input is a connection to the server, the text its URL (rtsp_text.h).
// Everything that the server sends is read here: RTSP by rtsp_text.h, the rest by FFmpeg.
void serve_rtsp(sandbox::Inside& inside);

// A window or the whole screen: the input is a connection to the X server, the text is
// "SCREEN WINDOW CURSOR COOKIE" (x11_reader.cpp).
void serve_x11(sandbox::Inside& inside);

// A video device: the input is the open device, the text is empty.
void serve_v4l2(sandbox::Inside& inside);

}  // namespace theatron::capture
