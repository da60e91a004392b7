// SPDX-License-Identifier: Apache-2.0
// FFmpeg's libraries, loaded at their first use instead of being linked.
//
// The program starts and streams without them (Strata, JPEG, OpenH264); H.264 decoding, videos,
// Matroska recordings of other programs, RTSP and V4L2 cameras need them. Code that uses FFmpeg
// includes FFmpeg's own headers and calls its functions by their names: functions.h lists them, and
// entries.cpp defines each as a jump into the loaded library. Thread-safe.
#pragma once

#include <string>

namespace theatron::ffmpeg {

// Loads libavutil, libavcodec, libavformat and libswscale at the first call. Empty if they are
// there; otherwise one sentence that names what is missing and what to install. Until it has
// returned an empty text, a call of a function of FFmpeg ends the program.
const std::string& problem();

// Returns `user`, what is about to use FFmpeg, or throws Error with problem() if there is one.
const char* needed_by(const char* user);

// Loads them if they are there. For sandboxed readers, which cannot open libraries later.
void load_if_there();

}  // namespace theatron::ffmpeg
