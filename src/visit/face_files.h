// SPDX-License-Identifier: Apache-2.0
// Files and ports of faces that commands share.
#pragma once

#include <string>

#include "face/network.h"
#include "face/recording.h"

namespace theatron::visit {

struct FacePort {
    std::string address = "127.0.0.1";
    int port = 9001;
};

// Throw Error with a sentence that repeats nothing of the file's content.
face::Recording read_face_recording(const std::string& file);
face::Network read_face_network(const std::string& file);
face::Source face_source(const std::string& name);

}  // namespace theatron::visit
